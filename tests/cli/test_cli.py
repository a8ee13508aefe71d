"""The command line: what it prints and writes, and one line for bad input."""

import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

from stiction import cli
from stiction.case.case_tables import json_schema
from stiction.case.read import read_case
from stiction.engine.tiers import all_compiled
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import AsperityLaw, FilmLaw, RoughSurface, find, incompatibility, of_kind
from stiction.solving.solve import solve

EXAMPLES = Path(__file__).parents[2] / "examples"
SILVER = EXAMPLES / "silver_on_steel.toml"
PAPER = EXAMPLES / "paper_figure.toml"
PNG = b"\x89PNG\r\n\x1a\n"


def command(*words, code=0):
    """Run the command in this process."""
    result = CliRunner().invoke(cli.app, [str(word) for word in words])
    assert result.exit_code == code, (result.output, result.exception)
    return result


def strict(text):
    """What a strict reader of JSON makes of it: NaN and Infinity are refused."""

    def refuse(word):
        raise ValueError(word)

    return json.loads(text, parse_constant=refuse)


@pytest.fixture(scope="module", autouse=True)
def _compiled():
    """Bits are compared: results of plain Python and of compiled loops differ in the last one."""
    with all_compiled():
        yield


@pytest.fixture(scope="module")
def solved():
    case = read_case(SILVER)
    return solve(case.subject, separation=case.separation)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What `stiction run` writes, into a folder that holds something already."""
    folder = tmp_path_factory.mktemp("parent") / "out"
    folder.mkdir()
    (folder / "mine.txt").write_text("kept")
    result = command("run", SILVER, "--model", "soft_coating_2015", "--out", folder)
    assert "written to" in result.stdout and result.stderr == ""
    return folder


def test_help_lists_the_commands_and_the_version_is_the_packages():
    text = command("--help").stdout
    assert all(word in text for word in ("run", "figures", "models", "cite", "schema"))
    assert command("--version").stdout == "stiction 0.1.0\n"


@pytest.mark.parametrize("columns", ["80", "120"])
def test_the_help_of_run_takes_60_lines_at_most(columns, monkeypatch):
    monkeypatch.setenv("COLUMNS", columns)
    shown = command("run", "--help").stdout.splitlines()
    assert len(shown) <= 60 and max(map(len, shown)) <= int(columns)
    assert any("Rarely used" in line for line in shown)


def test_models_take_a_line_each(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    rows, piped = json.loads(command("models", "--json").stdout), command("models").stdout.splitlines()
    monkeypatch.setenv("FORCE_COLOR", "1")  # as on a terminal
    shown = [re.sub(r"\x1b\[[\d;]*m", "", line) for line in command("models").stdout.splitlines()]
    for lines in (piped, shown):
        assert all(sum(row["key"] in line.split() for line in lines) >= 1 for row in rows)
        assert len(lines) <= len(rows) + len({row["kind"] for row in rows}) + 5
    assert max(map(len, shown)) <= 80 and all(any(row["title"] in line for line in piped) for row in rows)


def test_an_unknown_preset_is_refused_in_25_words(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(SILVER.read_text().replace('"hardened_steel_52100"', '"unobtainium"'))
    said = command("run", case, code=2).stderr
    assert "stiction materials" in said and len(said.split()) <= 25


def test_presets_have_three_digits():
    numbers = re.findall(r"[\d.]+(?= [GMk]?Pa| [mk]?J)", command("materials", "hardened_steel_52100").stdout)
    assert numbers and all(len(number.replace(".", "").strip("0")) <= 3 for number in numbers[:4])


def test_slow_libraries_wait_until_they_are_needed():
    slow = {"numba", "xarray", "pydantic", "matplotlib", "pint", "scipy", "pandas"}
    code = "import sys, stiction.cli; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not slow & set(loaded)


def test_the_schema_states_the_numbers_of_a_case_file():
    names = set()

    def collect(part):
        if isinstance(part, dict):
            names.update(part.get("properties", {}))
            for value in part.values():
                collect(value)
        elif isinstance(part, list):
            for value in part:
                collect(value)

    collect(json_schema())
    assert len(names & set(QUANTITIES)) > 30
    schema = command("schema").stdout
    assert "asperity tip radius" in schema and "50 um" in schema and "stiction schema" in command("run", "--help").stdout
    assert "theta" in command("figures", "--help").stdout


@pytest.mark.parametrize(
    ("words", "tables"),
    [("fit", ["[fit]", "[fit.free]"]), ("design", ["[design]", "[design.choose]", "[design.limits]"]),
     ("sweep", ["[sweep]"]), ("validate", ["[contact]", "[measured]"])],
)  # fmt: skip
def test_help_and_errors_name_the_tables_of_a_case(words, tables):
    text = command(words, "--help").stdout
    assert [name for name in tables if name not in text] == [] and "\\" not in text
    missing = command(words, code=2).stderr
    assert "not given" in missing and "\\" not in missing
    assert tables[0] in missing or words in ("sweep", "validate")


def test_run_prints_table_summary_and_what_is_outside_validity():
    text = command("run", SILVER, "--model", "soft_coating_2015", "--details").stdout
    assert "Silver film" in text and "E = 210 GPa" in text and "elastic adhesion index = 228.8" in " ".join(text.split())
    assert "separation" in text and "touching" in text
    assert "outside the range of validity" in text
    assert "jumps where it becomes plastic" in " ".join(text.split())
    rows = [line for line in text.splitlines() if "µN" in line or "mN" in line or " N " in line]
    assert 10 <= len(rows) <= 16


def test_run_writes_three_files_and_leaves_the_others(folder):
    assert sorted(path.name for path in folder.iterdir()) == ["curve.csv", "curve.nc", "curve.png", "mine.txt", "regimes.png"]
    assert list(folder.parent.iterdir()) == [folder]
    assert (folder / "curve.png").read_bytes().startswith(PNG)


def test_csv_holds_every_variable_with_its_unit(folder, solved):
    with (folder / "curve.csv").open(encoding="utf-8", newline="") as file:
        heads, *rows = csv.reader(line for line in file if not line.startswith("#"))
    table = dict(zip(heads, np.array(rows, dtype=float).T, strict=True))
    assert {head.partition(" [")[0] for head in heads} == set(map(str, solved.variables))
    assert {"load [N]", "contact_area [m^2]", "mean_separation [m]", "friction_coefficient"} <= set(heads)
    for head, column in table.items():
        values = solved[head.partition(" [")[0]].values
        np.testing.assert_array_equal(column, np.broadcast_to(values, column.shape))


def test_netcdf_opens_again_with_its_attributes(folder, solved):
    with xarray.open_dataset(folder / "curve.nc", engine="h5netcdf") as data:
        for name in solved.variables:
            np.testing.assert_array_equal(data[name].values, solved[name].values)
            assert dict(data[name].attrs) == dict(solved[name].attrs)
        for name, value in solved.attrs.items():
            assert data.attrs[name] == value
        assert data.attrs["program"] == "stiction 0.1.0"
        assert data.attrs["theta"] == pytest.approx(228.8, rel=1e-3)


def test_json_is_strict_and_agrees_with_solve(solved):
    result = command("run", SILVER, "--model", "soft_coating_2015", "--json")
    content = strict(result.stdout)
    assert result.stderr == ""
    assert content["attrs"]["model"] == "soft_coating_2015" and content["groups"]["tau"] == pytest.approx(200 / 48)
    assert set(content["variables"]) == set(map(str, solved.variables))
    load = content["variables"]["load"]
    assert (load["name"], load["unit"], load["dims"]) == ("load", "N", ["mean_separation"])
    np.testing.assert_array_equal(load["values"], solved["load"].values)


def adhesive(tmp_path, solving="separation = { start = 4, stop = -4, count = 9 }"):
    path = tmp_path / "adhesive.toml"
    path.write_text(f"[indices]\ntheta = 3\nlam = 100\n[solve]\n{solving}\n")
    return path


def test_undefined_friction_is_null_in_json_and_a_dash_in_the_table(tmp_path):
    content = strict(command("run", adhesive(tmp_path), "--json").stdout)
    loads, mu = (content["variables"][name]["values"] for name in ("load", "friction_coefficient"))
    assert [value is None for value in mu] == [load <= 0 for load in loads] and None in mu
    text = command("run", adhesive(tmp_path), "--details").stdout
    assert " - " in text and "mu is not defined" in text and "per asperity" in text


def test_options_override_the_case_and_a_model_without_them_is_not_asked(tmp_path):
    read = strict(command("run", PAPER, "--variant", "published", "--json").stdout)["attrs"]
    assert (read["variant"], read["film"]) == ("published", "printed")
    other = strict(command("run", adhesive(tmp_path), "--model", "greenwood_williamson_1966", "--json").stdout)
    assert other["attrs"]["model"] == "greenwood_williamson_1966"
    assert "friction_coefficient" not in other["variables"]
    assert (
        "computes no friction" in command("run", adhesive(tmp_path), "--model", "greenwood_williamson_1966", "--details").stdout
    )
    asperity = find(find("soft_coating_2015", RoughSurface).asperity, AsperityLaw)
    suitable = [law for law in of_kind(FilmLaw).values() if law.interchangeable and "2015" in law.required_traits]
    assert suitable and not any(incompatibility(law, asperity) for law in suitable)
    for key in ["sequential", *(law.key for law in suitable)]:
        read = strict(command("run", PAPER, "--film", key, "--json").stdout)["attrs"]
        assert (read["film"], read["model"]) == (key, "soft_coating_2015")


def test_laws_in_place_of_the_models_own(tmp_path):
    laws = "--model", "greenwood_williamson_1966", "--asperity", "jkr", "--branch", "unloading"
    read = strict(command("run", adhesive(tmp_path), *laws, "--tangential", "soft_coating_2015", "--json").stdout)
    used = [read["attrs"][name] for name in ("model", "asperity", "tangential", "film", "branch")]
    assert used == ["greenwood_williamson_1966", "jkr", "soft_coating_2015", "none", "unloading"]
    assert "friction_coefficient" in read["variables"]
    alone = strict(command("run", adhesive(tmp_path), "--tangential", "none", "--json").stdout)
    assert alone["attrs"]["tangential"] == "none" and "friction_coefficient" not in alone["variables"]
    refused = command("run", adhesive(tmp_path), "--asperity", "hertz", code=2)
    assert "asperity: 'hertz'" in refused.stderr and len(refused.stderr.splitlines()) == 1


@pytest.mark.usefixtures("no_pictures")
def test_a_curve_over_loads_is_written_too(tmp_path):
    case = adhesive(tmp_path, 'load = { start = 0.1, stop = 5, count = 5, spacing = "log" }')
    command("run", case, "--out", tmp_path / "new" / "folder")
    with (tmp_path / "new" / "folder" / "curve.csv").open(encoding="utf-8", newline="") as file:
        heads, *rows = csv.reader(line for line in file if not line.startswith("#"))
    assert heads[0].startswith("load [K R^(1/2)")
    np.testing.assert_allclose([float(row[0]) for row in rows], np.geomspace(0.1, 5, 5))


GOOD = SILVER.read_text(encoding="utf-8")
BAD = {
    "negative modulus": (GOOD.replace('preset = "silver"', 'preset = "silver", youngs_modulus = "-1 GPa"'), "youngs_modulus"),
    "nu at the limit": (GOOD.replace('preset = "silver"', 'preset = "silver", poissons_ratio = 0.5'), "poissons_ratio"),
    "thickness without unit": (GOOD.replace('thickness = "200 nm"', "thickness = 200e-9"), "thickness"),
    "unknown key": (GOOD.replace("thickness =", "thicknes ="), "thicknes"),
    "not a number": (GOOD.replace('preset = "silver"', 'preset = "silver", poissons_ratio = nan'), "poissons_ratio"),
    "unreachable load": (GOOD.partition("[solve]")[0] + '[solve]\nload = "1 GN"\n', "load"),
    "not TOML": ("theta: 40\n", "case file"),
    "unknown model": (GOOD + 'model = "amontons"\n', "model"),
    "unknown variant": (GOOD + 'variant = "own"\n', "variant"),
    "a model that knows no films": (GOOD + 'model = "greenwood_williamson_1966"\n', "model"),
    "an option that the model does not have": (
        "[indices]\ntheta = 40\nlam = 10\n[solve]\nseparation = 1\nmodel = 'rough_dmt'\nvariant = 'published'\n",
        "variant",
    ),
}


def refused(*words, field):
    result = command(*words, code=2)
    assert result.stdout == ""
    assert result.stderr.startswith("stiction: ") and result.stderr.count("\n") == 1
    assert field in result.stderr and ("; allowed: " in result.stderr or "; not supported" in result.stderr)
    return result.stderr


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line_and_nothing_is_written(name, tmp_path):
    text, field = BAD[name]
    case, out = tmp_path / "case.toml", tmp_path / "out"
    case.write_text(text, encoding="utf-8")
    refused("run", case, "--out", out, field=field)
    refused("run", case, "--json", field=field)
    assert [path.name for path in tmp_path.iterdir()] == ["case.toml"]


def test_bad_input_of_the_other_commands(tmp_path):
    file = tmp_path / "file"
    file.write_text("mine")
    refused("run", tmp_path / "none.toml", field="none.toml")
    refused("run", tmp_path, field="directory")
    refused("run", PAPER, "--out", file, field="--out")
    refused("run", PAPER, "--out", file / "below", field="--out")
    refused("figures", "--theta", "-1", "--out", tmp_path / "figures", field="theta")
    refused("figures", "--lam", "nan", "--out", tmp_path / "figures", field="lam")
    refused("figures", "--variant", "own", "--out", tmp_path / "figures", field="variant")
    refused("cite", "nobody_1900", field="nobody_1900")
    refused("schema", "--out", tmp_path, field="--out")
    assert [path.name for path in tmp_path.iterdir()] == ["file"] and file.read_text() == "mine"


def test_wrong_usage_is_exit_code_two():
    for words in (["run"], ["run", PAPER, "--no-such-option"], ["no-such-command"], ["figures", "--theta", "many"]):
        assert "Traceback" not in command(*words, code=2).stderr


def test_the_command_itself_prints_one_line_and_no_traceback(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text("[indices]\ntheta = -1\nlam = 10\n[solve]\nseparation = 1\n")
    code = "from stiction.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", code, "run", str(case)], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("stiction: indices.theta: -1") and done.stderr.endswith("; allowed: >= 1e-12 and <= 1e+40\n")
    assert done.stderr.count("\n") == 1


def test_interruption_is_exit_code_130(monkeypatch):
    def interrupt(path, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("stiction.case.read.read_case", interrupt)
    assert command("run", PAPER, code=130).stderr == "stiction: interrupted\n"


def test_half_written_results_are_not_left_behind(tmp_path, monkeypatch):
    def fail(figure, path):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("stiction.report.view.write_picture", fail)
    refused("run", PAPER, "--out", tmp_path / "out", field="No space left")
    assert list(tmp_path.iterdir()) == []


def test_models_as_records_and_as_a_table():
    records = strict(command("models", "--json").stdout)
    assert len(records) >= 7
    for record in records:
        assert {"key", "kind", "grade", "source", "validity"} <= set(record)
        assert record["grade"] in "ABC" and record["source"]
    text = command("models").stdout
    assert all(record["key"] in text for record in records) and "reconstructed" in text


def test_a_model_in_full_has_what_its_file_says():
    """Assumptions and equations, beside the record."""
    text = command("models", "dmt").stdout
    assert "checked against" in text and "Assumes: " in text and "P = w^(3/2)" in text
    (row,) = strict(command("models", "dmt", "--json").stdout)
    assert row["text"].startswith("One elastic asperity") and "$$" in row["text"]


def test_cite_prints_entries():
    text = command("cite", "soft_coating_2015").stdout
    assert "{soft_coating_2015," in text and "{savkoor_briggs_1977," in text
    assert "{greenwood_williamson_1966," in text and "{fuller_tabor_1975," not in text
    assert command("cite").stdout.count("\n@") > text.count("\n@")
    assert "{hamilton_1983," in command("cite", "hamilton_1983").stdout


def test_cite_prints_the_sources_of_a_case(tmp_path):
    """Of the models and the interface of its prediction, or of the model that it names."""
    path = tmp_path / "copper.toml"
    path.write_text(
        'contact.first = "copper"\ncontact.second = "copper"\ncontact.interface = "oxidised metal"\n'
        'contact.roughness = { rms_height = "0.2 um", finish = "ground" }\n'
        'contact.nominal_area = "1 cm^2"\nsolve.load = "10 N"\n',
        encoding="utf-8",
    )
    text = command("cite", path, "hamilton_1983").stdout
    assert all(f"{{{key}," in text for key in ("persson_2001", "wheeler_1976", "tabor_1959", "hamilton_1983"))
    path.write_text(path.read_text(encoding="utf-8") + 'solve.model = "persson_2001"\n', encoding="utf-8")
    named = command("cite", path).stdout
    assert "{persson_2001," in named and "{wheeler_1976," not in named
    refused("cite", tmp_path / "none.toml", field="case file")


def test_schema_to_the_screen_or_a_file(tmp_path):
    printed = strict(command("schema").stdout)
    assert printed["title"] == "stiction case"
    assert command("schema", "--out", tmp_path / "case.json").stdout == ""
    assert strict((tmp_path / "case.json").read_text(encoding="utf-8")) == printed


def test_figures_writes_pictures_curves_and_the_map_of_the_claims(tmp_path, monkeypatch):
    few = np.array([10.0, 1000.0])
    monkeypatch.setattr("stiction.studies.paper.claims.claim_map.__defaults__", (few, few, iter))
    content = strict(command("figures", "--out", tmp_path / "figures", "--json").stdout)
    assert (content["theta"], content["lambda"]) == (40.0, 10.0)
    names = {path.name for path in (tmp_path / "figures").iterdir()}
    pictures = {"fig1a.png", "fig1b.png", "fig2a.png", "fig2b.png", "fig3.png", "claims.png"}
    assert names == pictures | {"curves.csv", "claims.csv"}
    assert all((tmp_path / "figures" / name).read_bytes().startswith(PNG) for name in pictures)
    with (tmp_path / "figures" / "claims.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 5 * 3 * 2 * 2
    assert {row["claim"] for row in rows} == set("abcde")
    # Theory, section 6: these indices show (a) to (c) in both readings.
    here = {(row["claim"], row["variant"]): row["share_here"] for row in content["claims"]}
    assert all(here[claim, variant] == 1.0 for claim in "abc" for variant in ("corrected", "published"))


@pytest.mark.usefixtures("empty_pictures")
def test_figures_prints_what_each_claim_means_and_that_its_indices_were_chosen(tmp_path, monkeypatch):
    monkeypatch.setattr("stiction.studies.paper.claims.claim_map.__defaults__", (np.array([40.0]), np.array([10.0]), iter))
    text = command("figures", "--variant", "published", "--out", tmp_path / "figures").stdout
    assert "(a)" in text and "holds if" in text and "paper does not state theta and lambda" in text
