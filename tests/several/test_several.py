"""Numbers of a case that are several: what they mean, what the result is, and one line about everything that is wrong."""

import csv
import json

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

from cases import BARE
from refusals import refusal
from stiction import cli
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case
from stiction.quantities.errors import InputError
from stiction.solving.solve import solve
from stiction.studies.case_results import compare_case, solve_case


def case(changes, **solved):
    """The bare contact with some of its numbers changed, by dotted name."""
    contact = json.loads(json.dumps(BARE))
    for name, value in changes.items():
        *path, last = name.split(".")
        table = contact
        for key in path:
            table = table[key]
        table[last] = value
    return parse_case({"contact": contact, "solve": solved or {"load": ["10 mN", "1 N"]}})


def one_by_one(changes, **solved):
    return solve_case(case(changes, **solved))["friction_coefficient"].values


def test_a_list_is_what_each_number_alone_gives():
    both = solve_case(case({"work_of_adhesion": ["0.5 J/m^2", "1 J/m^2"]}))
    assert both["friction_coefficient"].dims == ("work_of_adhesion", "load")
    assert both["work_of_adhesion"].attrs["units"] == "J/m^2" and both["work_of_adhesion"].values.tolist() == [0.5, 1.0]
    for at, text in enumerate(("0.5 J/m^2", "1 J/m^2")):
        np.testing.assert_allclose(both["friction_coefficient"][at], one_by_one({"work_of_adhesion": text}), rtol=1e-9)


def test_ranges_have_both_ends_and_their_spacing():
    evenly = {"start": "40 nm", "stop": "80 nm", "count": 3}
    by_ratio = {"start": "10 um", "stop": "1 mm", "count": 3, "spacing": "log"}
    found = case({"roughness.asperity_height_deviation": evenly, "roughness.asperity_radius": by_ratio}).subject.roughness
    np.testing.assert_allclose(found.asperity_height_deviation.values, [40e-9, 60e-9, 80e-9], rtol=1e-14)
    np.testing.assert_allclose(found.asperity_radius.values, [1e-5, 1e-4, 1e-3], rtol=1e-14)


def test_numbers_inside_materials_and_films_may_be_several():
    film = {"material": {"preset": "gold", "hardness": ["0.5 GPa", "1 GPa"]}, "thickness": ["100 nm", "1 um", "2 um"]}
    changes = {"coating": film, "second.hardness": ["6 GPa", "7 GPa"]}
    data = solve_case(case(changes))
    assert dict(data["friction_coefficient"].sizes) == {
        "second.hardness": 2, "coating.material.hardness": 2, "thickness": 3, "load": 2,
    }  # fmt: skip
    assert data["second.hardness"].attrs["units"] == "Pa" and data["second.hardness"].attrs["long_name"].startswith("second: ")
    alone = {"preset": "gold", "hardness": "1 GPa"}
    single = one_by_one({"coating": {"material": alone, "thickness": "1 um"}, "second.hardness": "6 GPa"})
    at = data.sel({"second.hardness": 6e9, "coating.material.hardness": 1e9, "thickness": 1e-6})
    np.testing.assert_allclose(at["friction_coefficient"], single, rtol=1e-9)


def test_numbers_of_a_material_of_the_cases_own_may_be_several():
    contact = {**BARE, "first": {"preset": "mine", "hardness": ["1 GPa", "2 GPa"]}}
    mine = {"youngs_modulus": "83 GPa", "poissons_ratio": 0.37, "hardness": "1 GPa"}
    content = {"contact": contact, "materials": {"mine": mine}, "solve": {"load": "1 N"}}
    both = solve_case(parse_case(content))["friction_coefficient"].values
    for at, text in enumerate(("1 GPa", "2 GPa")):
        alone = {**content, "contact": {**contact, "first": {**mine, "hardness": text}}}
        np.testing.assert_allclose(both[at], solve_case(parse_case(alone))["friction_coefficient"].values, rtol=1e-9)


def test_quantities_along_one_dimension_go_together():
    changes = {
        "roughness.asperity_height_deviation": {"values": ["40 nm", "80 nm"], "along": "finish"},
        "roughness.asperity_radius": {"start": "60 um", "stop": "30 um", "count": 2, "along": "finish"},
    }
    data = solve_case(case(changes))
    assert data["friction_coefficient"].dims == ("finish", "load")
    assert data["asperity_radius"].dims == data["asperity_height_deviation"].dims == ("finish",)
    assert data["asperity_radius"].values.tolist() == [60e-6, 30e-6]
    second = one_by_one({"roughness.asperity_height_deviation": "80 nm", "roughness.asperity_radius": "30 um"})
    np.testing.assert_allclose(data["friction_coefficient"][1], second, rtol=1e-9)


def test_plain_separations_are_over_each_sigma():
    sigma = {"roughness.asperity_height_deviation": ["40 nm", "80 nm"]}
    data = solve_case(case(sigma, separation={"start": 2, "stop": 1, "count": 2}))
    np.testing.assert_allclose(data["mean_separation"], [[80e-9, 40e-9], [160e-9, 80e-9]], rtol=1e-14)
    lengths = solve_case(case(sigma, separation=["80 nm"]))
    np.testing.assert_allclose(
        lengths["friction_coefficient"].values[:, 0], [data["friction_coefficient"][0, 0], data["friction_coefficient"][1, 1]]
    )


def test_groups_that_vary_are_results_and_the_others_attributes():
    data = solve_case(case({"work_of_adhesion": ["0.5 J/m^2", "1 J/m^2"]}))
    np.testing.assert_allclose(data["theta"].values[0] / data["theta"].values[1], 2.0)  # theta is K .../gamma
    assert data["theta"].dims == ("work_of_adhesion",) and "theta" not in data.attrs
    assert data.attrs["sharpness"] == pytest.approx((50e-9 / 50e-6) ** 0.5)


def test_indices_may_be_several():
    content = {"indices": {"theta": [40, 80], "lam": 10}, "solve": {"load": 0.01}}
    data = solve_case(parse_case(content))
    alone = solve(parse_case({**content, "indices": {"theta": 80, "lam": 10}}).subject, load=0.01)
    assert float(data["friction_coefficient"][1, 0]) == pytest.approx(float(alone["friction_coefficient"]), rel=1e-9)


SIGMA = "roughness.asperity_height_deviation"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({SIGMA: []}, f"contact.{SIGMA}: []; allowed: a list with at least one value"),
        ({SIGMA: [48]}, f"contact.{SIGMA}: 48; allowed: text with a unit"),
        ({SIGMA: ["48 nm", "-1 nm"]}, f"contact.{SIGMA}: '-1 nm'; allowed: > 0 m"),
        ({SIGMA: ["48 nm", "1 N"]}, f"contact.{SIGMA}: '1 N'; allowed: > 0 m"),
        ({SIGMA: [["48 nm"]]}, f"contact.{SIGMA}.values.0: ['48 nm']; allowed: a number, or text"),
        ({SIGMA: {"start": "1 nm", "stop": "9 nm"}}, f"contact.{SIGMA}.count: not given; allowed: a whole number, 2 to"),
        ({SIGMA: {"start": "1 nm", "stop": "9 nm", "count": 1}}, f"contact.{SIGMA}.count: 1; allowed: a whole number, 2 to"),
        ({SIGMA: {"start": "1 nm", "count": 3}}, f"contact.{SIGMA}.stop: not given; allowed: the last point"),
        ({SIGMA: {"start": "1 nm", "stop": 2, "count": 3}}, f"contact.{SIGMA}.stop: 2; allowed: text with a unit"),
        ({SIGMA: {"start": "1 nm", "stop": "2 nm", "number": 3}}, f"contact.{SIGMA}.number: unknown key; allowed: "),
        ({SIGMA: {"values": ["1 nm"], "along": "load"}}, f"contact.{SIGMA}.along: 'load'; allowed: a name of letters"),
        ({SIGMA: {"values": ["1 nm"], "along": "a/b"}}, f"contact.{SIGMA}.along: 'a/b'; allowed: a name of letters"),
        ({"first": {"preset": "silver", "poissons_ratio": [0.3, 0.5]}}, "contact.first.poissons_ratio: 0.5; allowed: >= 0 and"),
        ({SIGMA: {"values": ["40 nm", "50 nm"], "along": "one"}, "work_of_adhesion": {"values": ["1 J/m^2"], "along": "one"}},
         "length"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_line(changes, message):
    with pytest.raises(InputError) as error:
        case(changes)
    assert message in str(error.value) and "\n" not in str(error.value)


def test_logarithms_want_ends_above_zero():
    with refusal("contact.pressure_coefficient.start", "0"):
        case({"pressure_coefficient": {"start": 0, "stop": 1, "count": 3, "spacing": "log"}})


def test_a_length_among_separations_over_several_sigmas_is_refused():
    with refusal("solve.separation", "1 nm", "sigma"):
        case({SIGMA: ["40 nm", "50 nm"]}, separation=[1, "1 nm"])


def test_what_does_not_fit_in_memory_is_left_to_a_sweep():
    thousand = {"start": "40 nm", "stop": "80 nm", "count": 1001}
    with refusal("contact", "1002001000", "1000000", "stiction sweep"):
        radius = thousand | {"start": "40 um", "stop": "50 um"}
        solve_case(case({SIGMA: thousand, "roughness.asperity_radius": radius}, load=["1 N"] * 1000))


def test_models_are_compared_on_one_contact():
    with refusal("work_of_adhesion", "2 numbers", "500 mJ/m^2", "1 J/m^2"):
        compare_case(case({"work_of_adhesion": ["0.5 J/m^2", "1 J/m^2"]}), 1.0)


def test_the_schema_lets_every_number_be_several():
    definitions = json_schema()["$defs"]
    for table, name in (("Coating", "thickness"), ("Material", "hardness"), ("Indices", "theta"), ("Contact", "peeling")):
        kinds = definitions[table]["properties"][name]["anyOf"]
        told = [kind.get("type") or kind["$ref"] for kind in kinds]
        assert told[0] in ("string", "number") and told[1] in ("array", "string")
        assert {"array", "#/$defs/RangeOfNumbers", "#/$defs/ListAlong"} <= set(told)
    assert "[m]; > 0 m" in definitions["Coating"]["properties"]["thickness"]["description"]


TWO = """
title = "two quantities"
[indices]
theta = [20, 40, 80]
lam = {start = 1, stop = 100, count = 4, spacing = "log"}
[solve]
load = [0.001, 0.01]
"""


def run(tmp_path, text, *words):
    path = tmp_path / "case.toml"
    path.write_text(text, encoding="utf-8")
    result = CliRunner().invoke(cli.app, ["run", str(path), *map(str, words)])
    assert result.exit_code == 0, (result.output, result.exception)
    return result.stdout


def test_run_writes_the_same_files_and_the_same_json(tmp_path):
    shown = run(tmp_path, TWO, "--details", "--out", tmp_path / "out")
    assert "mu at" in shown and "lambda" in shown
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"curve.csv", "curve.nc", "curve.png"}
    variables = json.loads(run(tmp_path, TWO, "--json"))["variables"]
    mu = variables["friction_coefficient"]
    assert mu["dims"] == ["theta", "lam", "load"] and np.shape(mu["values"]) == (3, 4, 2)
    assert variables["lam"]["symbol"] == "lambda" and variables["lam"]["unit"] == "1"
    with xarray.open_dataset(tmp_path / "out" / "curve.nc", engine="h5netcdf") as again:
        np.testing.assert_array_equal(again["friction_coefficient"], mu["values"])
    with (tmp_path / "out" / "curve.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert len(rows) == 24 and float(rows[-1]["theta"]) == 80.0
    assert float(rows[-1]["friction_coefficient"]) == mu["values"][-1][-1][-1]
