"""Models against measured series: what an entry has to say, what is made of it, and the entries that are there."""

import json
import math
import runpy
import shutil
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from cases import STEEL_ON_STEEL
from refusals import refusal
from stiction import cli
from stiction.case.read import read_case
from stiction.studies.validation import LEVELS, entries_in, read_entry

VALIDATION = Path(__file__).parents[2] / "validation"
SYNTHETIC = VALIDATION / "synthetic_boundary_film.toml"
CHALLENGE = VALIDATION / "contact_mechanics_challenge.toml"
MEASURED = """
[measured]
file = "values.csv"
kind = "measured"
read = "printed"
source = "Somebody, Journal 1 (2000)"
place = "p. 2, Table 3"
"""
VALUES = "load [N],friction_coefficient,friction_coefficient_error\n0.1,0.3,0.03\n1,0.2,0.01\n"


def written(folder, entry=MEASURED + STEEL_ON_STEEL, values=VALUES):
    (folder / "entry.toml").write_text(entry)
    (folder / "values.csv").write_text(values)
    return folder / "entry.toml"


def command(*words, code=0):
    result = CliRunner().invoke(cli.app, [str(word) for word in words])
    assert result.exit_code == code, (result.output, result.exception)
    return result


# ---- what is made of a series


def steel():
    rough = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    steels = dict.fromkeys(("first", "second"), "hardened_steel_52100")
    given = {"work_of_adhesion": "0.1 J/m^2", "nominal_area": "1 mm^2", "interfacial_shear_strength": "200 MPa"}
    return st.Contact(**steels, **given, roughness=rough)


def test_how_far_off(tmp_path):
    """Mean ratio, factor and difference in errors, from what `solve` says at the loads of the series."""
    found = st.validate(written(tmp_path)).sel(model="chang_etsion_bogy_1988")
    said = st.solve(steel(), load=[0.1, 1.0], model="chang_etsion_bogy_1988")["friction_coefficient"].values
    np.testing.assert_allclose(found["predicted"].values, said, rtol=1e-12)
    logs = [math.log(said[0] / 0.3), math.log(said[1] / 0.2)]
    assert float(found["bias"]) == pytest.approx(math.exp(sum(logs) / 2), rel=1e-12)
    assert float(found["factor"]) == pytest.approx(math.exp(math.hypot(*logs) / math.sqrt(2)), rel=1e-12)
    off = [(said[0] - 0.3) / 0.03, (said[1] - 0.2) / 0.01]
    assert float(found["in_errors"]) == pytest.approx(math.hypot(*off) / math.sqrt(2), rel=1e-12)
    assert int(found["answered"]) == 2


def test_a_model_with_its_own_values_is_the_first(tmp_path):
    """Three times its area and friction: a mean ratio of 1/3 and a factor of 3, and no errors where none are given."""
    said = st.solve(steel(), load=[0.1, 1.0], model="hariri_zu_ben_mrad_2006", tangential="bowden_tabor_1943")
    rows = [f"{load},{3e12 * float(area)!r},{3 * float(force)!r}" for load, area, force in
            zip((0.1, 1.0), said["contact_area"].values, said["friction_force"].values, strict=True)]  # fmt: skip
    found = st.validate(written(tmp_path, values="\n".join(["load [N],contact_area [um^2],friction_force [N]", *rows])))
    one = found.sel(model="hariri_zu_ben_mrad_2006")
    assert float(one["bias"]) == pytest.approx(1 / 3, rel=1e-9) and float(one["factor"]) == pytest.approx(3.0, rel=1e-9)
    assert math.isnan(float(one["in_errors"])) and int(one["answered"]) == 4
    factors = found["factor"].values[found["answered"].values == 4]
    assert np.all(np.diff(factors) >= 0) and factors.size > 10


def test_numbers_of_the_contact_may_differ_from_row_to_row(tmp_path):
    heads = "load [N],roughness.asperity_radius [um],sample,friction_coefficient\n"
    found = st.validate(written(tmp_path, values=heads + "1,50,a,0.2\n1,100,b,0.2\n0.1,50,a,0.3\n"))
    assert found["sample"].values.tolist() == ["a", "b", "a"]
    predicted = found["predicted"].sel(model="persson_2001").values
    for radius, load, value in ((50e-6, 1.0, predicted[0]), (100e-6, 1.0, predicted[1]), (50e-6, 0.1, predicted[2])):
        contact = steel()
        contact = contact.replace(roughness=contact.roughness.replace(asperity_radius=radius))
        said = st.solve(contact, load=load, model="persson_2001", tangential="bowden_tabor_1943")["friction_coefficient"]
        assert value == pytest.approx(float(said), rel=1e-12)


def test_who_refuses_is_left_out_with_the_reason(tmp_path):
    found = st.validate(written(tmp_path, MEASURED + STEEL_ON_STEEL.replace('interfacial_shear_strength = "200 MPa"', "")))
    assert "persson_2001" not in found["model"].values
    assert "\npersson_2001: " in found.attrs["not_applicable"]
    assert found.attrs["place"] == "p. 2, Table 3"


def test_a_load_that_is_not_carried_leaves_the_others(tmp_path):
    """Asperity models carry no 100 kN on a square millimetre of such steel; what they say at 1 N counts."""
    found = st.validate(written(tmp_path, values="load [N],friction_coefficient\n1,0.2\n1e5,0.2\n"))
    one = found.sel(model="chang_etsion_bogy_1988")
    assert np.isfinite(one["predicted"].values).tolist() == [True, False] and int(one["answered"]) == 1
    assert np.all(np.diff(found["answered"].values) <= 0)


# ---- ranges in place of points, and the prediction

BAND = """
[measured]
kind = "measured"
read = "printed"
source = "Somebody, Journal 1 (2000)"
place = "abstract"
"""


def with_bands(folder, *bands, contact=STEEL_ON_STEEL):
    tables = [f'[[measured.band]]\nload = "{load}"\nlow = {low!r}\nhigh = {high!r}\n' for load, low, high in bands]
    (folder / "band.toml").write_text(BAND + "".join(tables) + contact)
    return folder / "band.toml"


def test_which_interval_holds_a_range(tmp_path):
    """Ranges that are made from quantiles of the prediction lie where they were put."""
    samples = st.predict(steel(), load="1 N")["friction_coefficient_samples"].values
    ends = ((0.3, 0.7), (0.1, 0.2), (0.2, 0.3), (0.01, 0.5), (0.97, 0.99))
    bands = [("1 N", *np.nanquantile(samples, pair).tolist()) for pair in ends]
    found = st.validate(with_bands(tmp_path, *bands))
    assert found["within_50"].values.tolist() == ["inside", "outside", "partly", "partly", "outside"]
    assert found["within_90"].values.tolist() == ["inside", "inside", "inside", "partly", "outside"]
    np.testing.assert_allclose(found["prediction"].values[:, 0], np.nanquantile(samples, LEVELS), rtol=1e-9)
    np.testing.assert_allclose(found["measured"], [math.sqrt(low * high) for _, low, high in bands], rtol=1e-12)


def test_a_point_is_a_range_without_width(tmp_path):
    found = st.validate(written(tmp_path, values="load [N],friction_coefficient\n1,1e-9\n"))
    assert (found["within_90"].item(), found["measured_low"].item()) == ("outside", 1e-9)
    found = st.validate(written(tmp_path, values="load [N],contact_area [um^2]\n1,100\n"))
    assert found["within_90"].item() == "" and np.isnan(found["prediction"]).all()


def test_an_uncertain_number_widens_the_prediction(tmp_path):
    dry = STEEL_ON_STEEL.replace('work_of_adhesion = "0.1 J/m^2"\n', "") + 'kind = "ground"\n'
    wide = dry.replace('"200 MPa"', '{ low = "20 MPa", high = "2 GPa" }')
    assert wide != dry
    known, unknown = (st.validate(with_bands(tmp_path, ("1 N", 0.1, 0.2), contact=one)) for one in (dry, wide))
    ratio = [float(one["prediction"][-1, 0] / one["prediction"][0, 0]) for one in (known, unknown)]
    assert ratio[1] > 1.3 * ratio[0]


def test_the_command_shows_intervals(tmp_path):
    path = with_bands(tmp_path, ("1 N", 0.1, 0.2))
    shown = command("validate", path, "--out", tmp_path / "out")
    assert "90% interval" in shown.stdout and "0.1 to 0.2" in shown.stdout
    assert (tmp_path / "out" / "band.png").exists()
    told = json.loads(command("validate", path, "--json").stdout)["band"]["rows"]
    assert told["measured_high"] == [0.2] and set(told["prediction"]) == {f"{level:g}" for level in LEVELS}


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (BAND, ("measured.file and band",)),
        (BAND + '[[measured.band]]\nload = "1 N"\nlow = 0.4\nhigh = 0.3\n', ("measured.band.0.low", "0.4")),
        (BAND + '[[measured.band]]\nload = "-1 N"\nlow = 0.2\nhigh = 0.3\n', ("measured.band.0.load", "-1 N")),
        (MEASURED + '[[measured.band]]\nload = "1 N"\nlow = 0.2\nhigh = 0.3\n', ("measured.file and band", "both given")),
    ],
)
def test_bad_ranges_are_refused(tmp_path, entry, said):
    with refusal(*said):
        read_entry(written(tmp_path, entry + STEEL_ON_STEEL))


def test_pages_say_how_many_measured_values_are_inside():
    """README and the page of measurements print what the entries give."""
    entries = [read_entry(path) for path in entries_in(VALIDATION)]
    found = [st.validate(one) for one in entries if one.origin.kind == "measured"]
    held = {share: sum(int((one[f"within_{share}"] == "inside").sum()) for one in found) for share in (50, 90)}
    counts = f"Of {sum(one.sizes['row'] for one in found)} ", f"{len(found)} measured series"
    inside = f"{held[90]} are inside the 90 % interval and {held[50] or 'none is'} inside the 50 % interval"
    for page in ("README.md", "docs/explanation/compared-with-measurements.md"):
        text = " ".join((VALIDATION.parent / page).read_text(encoding="utf-8").split())
        assert all(words in text for words in (*counts, inside)), (page, counts, inside)


# ---- what an entry has to say


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (STEEL_ON_STEEL, ("measured",)),
        (MEASURED.replace('place = "p. 2, Table 3"', "") + STEEL_ON_STEEL, ("measured.place",)),
        (MEASURED.replace("Somebody, Journal 1 (2000)", " ") + STEEL_ON_STEEL, ("measured.source",)),
        (MEASURED.replace('"measured"', '"guessed"') + STEEL_ON_STEEL, ("measured.kind",)),
        (MEASURED.replace('"measured"', '"synthetic"') + STEEL_ON_STEEL, ("measured.read",)),
        (MEASURED.replace('"printed"', '"computed"') + STEEL_ON_STEEL, ("measured.read",)),
        (MEASURED.replace("values.csv", "other.csv") + STEEL_ON_STEEL, ("--data", "other.csv")),
        (MEASURED + STEEL_ON_STEEL + "[solve]\nload = '1 N'\n", ("solve",)),
        (MEASURED + STEEL_ON_STEEL.replace('"0.1 J/m^2"', '["0.1 J/m^2", "1 J/m^2"]'), ("contact.work_of_adhesion",)),
        (MEASURED + STEEL_ON_STEEL.replace("nominal_area", "nominal_aera"), ("contact.nominal_aera",)),
    ],
)
def test_what_is_missing_is_said_in_one_line(tmp_path, entry, said):
    path = written(tmp_path, entry)
    with refusal(*said) as refused:
        read_entry(path)
    assert "\n" not in str(refused.value)
    result = command("validate", path, code=2)
    assert result.stderr.startswith("stiction: ") and result.stderr.count("\n") == 1


@pytest.mark.parametrize(("value", "place"), (("0", "values.csv, line 3"), ("-0.1", "line 3")))
def test_a_ratio_needs_a_value_above_zero(tmp_path, value, place):
    with refusal(f"{place}, friction_coefficient", value):
        read_entry(written(tmp_path, values=f"load [N],friction_coefficient\n1,0.2\n2,{value}\n"))


def test_a_folder_without_entries(tmp_path):
    shutil.copy(CHALLENGE, tmp_path)
    with refusal("entry", "[measured]"):
        entries_in(tmp_path)


# ---- the command


def test_the_command(tmp_path):
    out = tmp_path / "out"
    shown = command("validate", VALIDATION, "--out", out)
    assert "SYNTHETIC: these values were made up; they were not measured." in shown.stdout
    assert "persson_2001" in shown.stdout and "not applicable: ghaednia_2019" in shown.stdout
    rows = (out / "synthetic_boundary_film.csv").read_text().splitlines()
    levels = ",".join(f"prediction_{level}" for level in LEVELS)
    assert rows[0].startswith(f"quantity,sample,load,measured,error,{levels},persson_2001") and len(rows) == 7
    assert not (out / "contact_mechanics_challenge.csv").exists()


def test_the_command_for_programs(tmp_path):
    shown = json.loads(command("validate", written(tmp_path), "--json").stdout)
    assert shown["entry"]["kind"] == "measured" and shown["entry"]["rows"]["measured"] == [0.3, 0.2]
    first = shown["entry"]["models"][0]
    assert first["factor"] >= 1.0 and len(first["predicted"]) == 2


# ---- the entries that are there


def test_every_entry_says_what_it_is():
    for path in entries_in(VALIDATION):
        entry = read_entry(path)
        synthetic = entry.origin.kind == "synthetic"
        assert path.stem.startswith("synthetic") == synthetic == entry.title.startswith("SYNTHETIC")
        assert synthetic == (entry.origin.place == "")


def test_the_synthetic_values_are_those_of_their_script(tmp_path):
    shutil.copy(VALIDATION / "make_synthetic.py", tmp_path)
    runpy.run_path(str(tmp_path / "make_synthetic.py"), run_name="__main__")
    made = tmp_path / "synthetic_boundary_film.csv"
    assert made.read_text() == SYNTHETIC.with_suffix(".csv").read_text()


def test_the_synthetic_values_are_found_again():
    """Made with Persson's area and 5 % scatter: he is first, off by that, and by about one error; others are off by more."""
    found = st.validate(SYNTHETIC)
    assert str(found["model"].values[0]) == "persson_2001"
    first = found.isel(model=0)
    assert 1.02 < float(first["factor"]) < 1.1 and 0.4 < float(first["in_errors"]) < 1.6
    assert float(found["factor"].sel(model="greenwood_williamson_1966")) > 1.3


def test_the_challenge_without_its_map():
    with refusal("contact.roughness.first.file", "contact_mechanics_challenge.npy"):
        read_case(CHALLENGE)
    shown = command("run", CHALLENGE, code=2)
    assert shown.stderr.startswith("stiction: contact.roughness.first.file") and shown.stderr.count("\n") == 1


def test_the_challenge_with_a_map(tmp_path):
    """A small periodic map of one wave in its place, pressed with the load of the challenge: light contact of a wavy surface
    (Johnson, Greenwood & Higginson 1985) is that of a Hertz paraboloid at the crest, R = L^2/(4 pi^2 h), and a little more."""
    side, height, points = 1e-4, 4e-6, 128
    x = np.arange(points) / points * 2 * np.pi
    np.save(tmp_path / "contact_mechanics_challenge.npy", height * (np.cos(x)[:, None] + np.cos(x)))
    shutil.copy(CHALLENGE, tmp_path)
    found = json.loads(command("run", tmp_path / CHALLENGE.name, "--json").stdout)
    radius = side**2 / (4 * math.pi**2 * height)
    hertz = math.pi * (3 * 2.5e-3 * radius / (4 * 25e6)) ** (2 / 3)
    (area,) = np.ravel(found["variables"]["contact_area"]["values"])
    assert 1.0 < area / hertz < 1.1  # a tenth of the area is in contact: the waves beside it push each other down
