"""Numbers of a case that are uncertain: what each form means, what is drawn, and one line about everything that is wrong."""

import contextlib
import json
import tomllib

import numpy as np
import pytest
import scipy.stats

from cases import BARE
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case, read_case
from stiction.case.text import as_toml
from stiction.case.uncertain import read_distribution
from stiction.quantities.errors import InputError
from stiction.studies.case_results import solve_case
from stiction.studies.sweep.plan import make_plan

SHARES = np.array([0.02, 0.3, 0.5, 0.8, 0.99])


def case(changes, folder=None, **tables):
    """The bare contact with some of its numbers changed, by dotted name."""
    contact = {**BARE, "second": dict(BARE["second"]), "roughness": dict(BARE["roughness"])}
    for name, value in changes.items():
        *path, last = name.split(".")
        table = contact
        for key in path:
            table = table[key]
        table[last] = value
    content = {"contact": contact, "solve": {"load": ["10 mN", "1 N"]}, **tables}
    return parse_case(content) if folder is None else parse_case(content, folder)


def _drawn(found, shares):
    return found.at(found.numbers_at(shares))


@pytest.mark.parametrize(
    ("entry", "wanted", "nominal"),
    [
        ("7 +/- 0.5 GPa", scipy.stats.norm(7e9, 0.5e9), 7e9),
        ("(7 ± 0.5) GPa", scipy.stats.norm(7e9, 0.5e9), 7e9),
        ("7 GPa +/- 500 MPa", scipy.stats.norm(7e9, 0.5e9), 7e9),
        ("7 GPa +/- 10 %", scipy.stats.norm(7e9, 0.7e9), 7e9),
        ("7e9 +- 5e8 Pa", scipy.stats.norm(7e9, 0.5e9), 7e9),
        ({"low": "6 GPa", "high": "8 GPa"}, scipy.stats.uniform(6e9, 2e9), 7e9),
        ({"low": "1 GPa", "high": "100 GPa", "spacing": "log"}, scipy.stats.loguniform(1e9, 1e11), 1e10),
        ({"median": "2 GPa", "factor": 3}, scipy.stats.lognorm(np.log(3.0), 0, 2e9), 2e9),
        (scipy.stats.gamma(9.0, scale=1e9), scipy.stats.gamma(9.0, scale=1e9), scipy.stats.gamma(9.0, scale=1e9).median()),
    ],
)
def test_every_form_is_its_distribution(entry, wanted, nominal):
    found = read_distribution(entry, "hardness", "hardness")
    np.testing.assert_allclose(found.ppf(SHARES), wanted.ppf(SHARES), rtol=1e-9)
    assert found.nominal == pytest.approx(nominal, rel=1e-9)


def test_a_distribution_of_scipy_stands_in_the_tables_of_a_case():
    """In SI units, where a plain number is refused as it has no unit."""
    found = case({"second.hardness": scipy.stats.norm(7e9, 0.5e9)})
    assert found.subject.second.hardness == 7e9 and found.subject == case({"second.hardness": "7 GPa"}).subject
    drawn = _drawn(found, SHARES[:, None]).subject.second.hardness
    np.testing.assert_allclose(drawn, scipy.stats.norm(7e9, 0.5e9).ppf(SHARES), rtol=1e-9)
    with refusal("contact.second.hardness", "7000000000.0", ">= 1000 Pa"):
        case({"second.hardness": 7e9})
    written = as_toml({"contact": {"second": {"hardness": scipy.stats.norm(7e9, 0.5e9), "poissons_ratio": 0.3}}})
    assert tomllib.loads(written) == {"contact": {"second": {"hardness": "7000000000 Pa", "poissons_ratio": 0.3}}}


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        (scipy.stats.gamma, ("x", "scipy.stats.gamma_gen")),
        (scipy.stats.norm(np.nan, 1e9), ("x",)),
        (scipy.stats.norm(7e9, 9e9), ("x", "21.8%")),
        ({"median": "0 GPa", "factor": 3}, ("x.median", "0 GPa", "0")),
    ],
)
def test_a_distribution_that_is_none(entry, said):
    with refusal(*said) as caught:
        read_distribution(entry, "interfacial_shear_strength", "x")
    assert "\n" not in str(caught.value)


def test_a_distribution_is_cut_off_at_the_bounds_of_its_quantity():
    found = read_distribution("0.46 +/- 0.02", "poissons_ratio", "nu")
    assert found.ppf(1.0) < 0.5 and found.ppf(0.0) > 0.3
    cut = scipy.stats.truncnorm((0.0 - 0.46) / 0.02, 2.0, 0.46, 0.02)
    np.testing.assert_allclose(found.ppf(SHARES), cut.ppf(SHARES), rtol=1e-9)
    strength = read_distribution("10 MPa +/- 5 MPa", "interfacial_shear_strength", "tau")
    cut = scipy.stats.truncnorm(-2.0, np.inf, 10e6, 5e6)
    np.testing.assert_allclose(strength.ppf(SHARES), cut.ppf(SHARES), rtol=1e-9)


def test_a_fortieth_may_be_beyond_the_bounds():
    for share, allowed in ((0.0249, True), (0.0251, False)):
        entry = scipy.stats.norm(1e7, 1e7 / scipy.stats.norm.isf(share))
        with contextlib.nullcontext() if allowed else refusal("tau", "2.5%"):
            read_distribution(entry, "interfacial_shear_strength", "tau")


@pytest.mark.parametrize(
    ("text", "kind"), [("1.0\n2.0\n\n# one more\n4.0\n", {}), ("rig H\n1 1\n2 2\n3 4\n", {"column": "H"}), ("H\n1\n2\n4\n", {})]
)
def test_values_of_a_file_are_as_likely_each(tmp_path, text, kind):
    (tmp_path / "h.txt").write_text(text, encoding="utf-8")
    found = read_distribution({"samples": "h.txt", "unit": "GPa", **kind}, "hardness", "hardness", tmp_path)
    assert found.ppf([0.1, 0.3, 0.5, 0.9]).tolist() == [1e9, 1e9, 2e9, 4e9] and found.nominal == 2e9


def test_rows_of_one_file_stay_together(tmp_path):
    (tmp_path / "both.csv").write_text("R,sigma\n50,40\n20,80\n30,60\n", encoding="utf-8")
    one = {"samples": "both.csv", "along": "spot"}
    changes = {
        "roughness.asperity_radius": {**one, "unit": "um", "column": "R"},
        "roughness.asperity_height_deviation": {**one, "unit": "nm", "column": "sigma"},
    }
    found = case(changes, tmp_path)
    assert list(found.unknowns) == ["spot"]
    rough = _drawn(found, np.linspace(0.01, 0.99, 30)[:, None]).subject.roughness
    pairs = set(zip(rough.asperity_radius.values.round(9), rough.asperity_height_deviation.values.round(12), strict=True))
    assert pairs == {(50e-6, 40e-9), (20e-6, 80e-9), (30e-6, 60e-9)}


def test_files_whose_rows_go_together_have_as_many(tmp_path):
    for name, text in (("two", "50\n20\n"), ("three", "40\n80\n60\n")):
        (tmp_path / f"{name}.txt").write_text(text, encoding="utf-8")
    changes = {
        "roughness.asperity_radius": {"samples": "two.txt", "along": "spot", "unit": "um"},
        "roughness.asperity_height_deviation": {"samples": "three.txt", "along": "spot", "unit": "nm"},
    }
    with refusal("contact.roughness.asperity_radius.samples", "2", "3", "contact.roughness.asperity_height_deviation"):
        case(changes, tmp_path)
    changes["roughness.asperity_radius"]["along"] = "place"
    assert list(case(changes, tmp_path).unknowns) in (["place", "spot"], ["spot", "place"])


def test_the_plain_value_is_the_nominal_one():
    changes = {
        "second.hardness": "7 +/- 0.5 GPa",
        "work_of_adhesion": {"median": "0.5 J/m^2", "factor": 2},
        "roughness.asperity_radius": {"low": "40 um", "high": "60 um"},
    }
    plain = case({"second.hardness": "7 GPa"})
    found = case(changes)
    assert found.subject == plain.subject and not found.is_swept
    assert list(found.unknowns) == ["hardness", "work_of_adhesion", "asperity_radius"]


def test_a_material_of_the_case_varies_together_wherever_it_is():
    steel = {"youngs_modulus": "210 +/- 5 GPa", "poissons_ratio": 0.3, "hardness": "7 +/- 0.5 GPa"}
    own = {"first": "steel", "second": {"preset": "steel", "hardness": "6 GPa"}}
    found = case(own, materials={"steel": steel})
    assert list(found.unknowns) == ["steel.youngs_modulus", "steel.hardness"]
    drawn = _drawn(found, np.array([[0.1, 0.2], [0.9, 0.7]])).subject
    np.testing.assert_array_equal(drawn.first.youngs_modulus, drawn.second.youngs_modulus)
    np.testing.assert_allclose(drawn.first.youngs_modulus, scipy.stats.norm(210e9, 5e9).ppf([0.1, 0.9]), rtol=1e-12)
    assert drawn.second.hardness == 6e9 and drawn.first.hardness.dims == ("sample",)


def test_ranges_of_materials_vary_where_that_is_asked_for(tmp_path):
    assert not case({}).unknowns
    found = case({"second.hardness": "7 +/- 0.5 GPa"}, uncertainty={"ranges": True})
    assert "silver.hardness" in found.unknowns and "hardened_steel_52100.hardness" not in found.unknowns
    ends = found.subject.first.range["hardness"]
    (silver,) = found.unknowns["silver.hardness"]
    np.testing.assert_allclose(silver.at(np.array([0.0, 0.5, 1.0])), [ends[0], (ends[0] * ends[1]) ** 0.5, ends[1]], rtol=1e-9)
    assert silver.distribution.nominal == found.subject.first.hardness
    both = case({"second": "silver"}, uncertainty={"ranges": True})
    drawn = _drawn(both, np.full((1, len(both.unknowns)), 0.3)).subject
    assert drawn.first.hardness == drawn.second.hardness and len(both.unknowns["silver.hardness"]) == 2
    path = tmp_path / "case.toml"
    path.write_text('[contact]\nfirst = "silver"\nsecond = "silver"\nnominal_area = "1 mm^2"\nwork_of_adhesion = "1 J/m^2"\n'
                    'roughness = { asperity_height_deviation = "50 nm", asperity_radius = "50 um", '
                    'asperity_density = "1e10 1/m^2" }\n[solve]\nload = "1 N"\n', encoding="utf-8")  # fmt: skip
    assert read_case(path, ranges=True).unknowns and not read_case(path).unknowns


@pytest.mark.parametrize("body", ["second", "first"])
@pytest.mark.parametrize("given", [[], 5, True, {}, "no such metal", {"preset": "no such metal"}], ids=repr)
def test_what_is_no_body_is_refused_by_its_name_where_ranges_are_asked_for(body, given):
    with pytest.raises(InputError) as error:
        case({body: given}, uncertainty={"ranges": True})
    assert str(error.value).startswith(f"contact.{body}")


def test_separations_over_sigma_follow_the_sigma_that_is_drawn():
    found = case({"roughness.asperity_height_deviation": "50 +/- 5 nm"}, solve={"separation": [1.0, 2.0]})
    drawn = _drawn(found, np.array([[0.2], [0.5], [0.8]]))
    np.testing.assert_allclose(drawn.separation / drawn.subject.roughness.asperity_height_deviation, [[1, 1, 1], [2, 2, 2]])


def test_indices_may_be_uncertain():
    content = {"indices": {"theta": "40 +/- 4", "lam": {"median": 10, "factor": 2}}, "solve": {"load": 0.01}}
    found = parse_case(content)
    assert found.subject.theta == 40.0 and found.subject.lam == 10.0
    np.testing.assert_allclose(_drawn(found, np.array([[0.5, 0.5], [0.8413447, 0.8413447]])).subject.theta, [40, 44], rtol=1e-6)
    assert np.isfinite(solve_case(found)["friction_coefficient"]).all()


SIGMA = "roughness.asperity_height_deviation"


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("48 +/- 5", f"contact.{SIGMA}: '48 +/- 5'; allowed: a number with its unit"),
        ("48 +/- 5 %", f"contact.{SIGMA}: '48 +/- 5 %'; allowed: "),
        ("48 +/- nm", f"contact.{SIGMA}: '48 +/- nm'; allowed: a number and its standard deviation, e.g. \"48 +/- 4.8 nm\""),
        ("48 +/- 0 nm", f"contact.{SIGMA}: '48 +/- 0 nm'; allowed: a standard deviation above 0"),
        ("48 +/- 5 N", f"contact.{SIGMA}: '48 +/- 5 N'; allowed: > 0 m"),
        ("48 +/- 30 nm", f"contact.{SIGMA}: '48 +/- 30 nm'; allowed: > 0 m for all but 2.5% of values, here 5.5%"),
        ({"low": "48 nm"}, f"contact.{SIGMA}.high: not given; allowed: the high end"),
        ({"low": "48 nm", "high": "8 nm"}, f"contact.{SIGMA}.high: '8 nm'; allowed: above the low end, 48 nm"),
        ({"low": "48 nm", "hi": "8 nm"}, f"contact.{SIGMA}.hi: unknown key; allowed: "),
        ({"low": 4, "high": "8 nm"}, f"contact.{SIGMA}.low: 4; allowed: text with a unit"),
        ({"median": "48 nm"}, f"contact.{SIGMA}.factor: not given; allowed: a factor above 1"),
        ({"median": "48 nm", "factor": 0.5}, f"contact.{SIGMA}.factor: 0.5; allowed: a factor above 1"),
        ({"median": "48 nm", "factor": "2"}, f"contact.{SIGMA}.factor: '2'; allowed: a factor above 1"),
        ({"factor": 2}, f"contact.{SIGMA}.median: not given; allowed: the median"),
        ({"samples": "none.txt", "unit": "nm"}, f"contact.{SIGMA}.samples: 'none.txt'; allowed: a file of numbers"),
        ({"samples": "some.txt"}, f"contact.{SIGMA}.unit: not given; allowed: the unit of the numbers in the file, e.g."),
        ({"samples": "some.txt", "unit": "N"}, f"contact.{SIGMA}.samples: '1 N'; allowed: > 0 m"),
        ({"samples": "word.txt", "unit": "nm"}, f"contact.{SIGMA}.samples: 'two'; allowed: a number; this is value 2 of"),
        ({"samples": "both.txt", "unit": "nm"}, f"contact.{SIGMA}.column: not given; allowed: a, b"),
        ({"samples": "both.txt", "unit": "nm", "column": "c"}, f"contact.{SIGMA}.column: 'c'; allowed: a, b"),
        ({"samples": "bad.txt", "unit": "nm"}, f"contact.{SIGMA}.samples: -2e-09; allowed: > 0 m"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_line(tmp_path, entry, message):
    for name, text in (("some", "1\n2\n"), ("word", "1\ntwo\n"), ("both", "a b\n1 2\n3 4\n"), ("bad", "1\n-2\n")):
        (tmp_path / f"{name}.txt").write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as error:
        case({SIGMA: entry}, tmp_path)
    assert message in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("table", "message"),
    [({"count": 1000}, "uncertainty.count: 1000; allowed: a power of two"), ({"coverage": 90}, "uncertainty.coverage: 90; al"),
     ({"ranges": 1}, "uncertainty.ranges: 1; allowed: true"), ({"points": 64}, "uncertainty.points: unknown key; allowed")],
)  # fmt: skip
def test_what_is_wrong_in_the_table_is_one_line(table, message):
    with pytest.raises(InputError) as error:
        case({}, uncertainty=table)
    assert message in str(error.value)


def test_a_sweep_draws_from_distributions_and_says_where_it_cannot():
    content = {
        "contact": {**BARE, "second": {"preset": "hardened_steel_52100", "hardness": "7 +/- 0.5 GPa"}},
        "solve": {"load": "1 N", "model": "greenwood_williamson_1966"},
        "sweep": {"sample": {"method": "sobol", "count": 256}},
    }
    plan = make_plan(content)
    hardness = plan.case.at(plan.arrays(plan.region(0))).subject.second.hardness
    np.testing.assert_allclose([hardness.mean(), hardness.std()], [7e9, 0.5e9], rtol=0.02)
    other = json.loads(json.dumps(content).replace("0.5 GPa", "0.6 GPa"))
    assert plan.identity() == make_plan(content).identity() != make_plan(other).identity()
    with refusal("contact.second.hardness", "7 GPa ± 500 MPa", "sobol"):
        make_plan({**content, "sweep": {}})


def test_the_schema_knows_uncertain_numbers():
    definitions = json_schema()["$defs"]
    kinds = definitions["Material"]["properties"]["poissons_ratio"]["anyOf"]
    assert {"$ref": "#/$defs/WithinFactor"} in kinds and {"type": "string", "pattern": r"\+/-|±"} in kinds
    assert "factor" in definitions["WithinFactor"]["properties"] and "Uncertainty" in definitions
