"""Every model on one contact: the comparison agrees with single solutions, and says what it leaves out, and why."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import stiction as st
from stiction.cli import app
from stiction.compare import candidates, compare, comparison
from stiction.registry import of_kind

SURFACE = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
STEEL = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2"}
FILM = {"material": {"preset": "silver", "hardness": "0.4 GPa"}, "thickness": "200 nm", "bodies": "first"}


def contact(**more):
    return st.Contact(**STEEL, roughness=st.Roughness(**SURFACE), **{"work_of_adhesion": "0.1 J/m^2"} | more)


SHEARED = contact(interfacial_shear_strength="200 MPa")


@pytest.fixture(scope="module")
def data():
    return compare(SHEARED, load="10 N")


def test_every_rough_surface_and_every_asperity_law_is_asked(data):
    said = set(data["model"].values) | {line.split(": ")[0] for line in data.attrs["left_out"].splitlines()}
    taken = {record.asperity for record in of_kind("rough surface").values()}
    assert said == set(of_kind("rough surface")) | (set(of_kind("asperity")) - taken)
    assert data.sizes["point"] == 80 and data.sizes["model"] >= 17


@pytest.mark.parametrize("model", ["soft_coating_2015", "kogut_etsion_2004", "chang_etsion_bogy_1988"])
def test_it_says_what_a_single_solution_says(data, model):
    one = data.sel(model=model)
    curve = st.solve(SHEARED, separation=one["mean_separation"].values, model=model)
    for name in ("load", "contact_area", "friction_force", "friction_coefficient"):
        assert_allclose(one[name].values, curve[name].values, rtol=1e-12)
        assert one[name].attrs["units"] == curve[name].attrs["units"]
    at_load = st.solve(SHEARED, load="10 N", model=model)
    for name in ("mean_separation", "contact_area", "friction_coefficient"):
        assert_allclose(float(one[f"{name}_at_load"]), float(at_load[name]), rtol=1e-9)


def test_models_of_contact_only_get_the_interface(data):
    """mu = tau_0 A/P where a model has no tangential law of its own; with a pressure coefficient, alpha more."""
    one = data.sel(model="greenwood_williamson_1966")
    assert_allclose(one["friction_force"].values, 200e6 * one["contact_area"].values, rtol=1e-12)
    more = compare(contact(interfacial_shear_strength="200 MPa", pressure_coefficient=0.05), load="10 N")
    there = more.sel(model="greenwood_williamson_1966")["friction_coefficient"].values
    assert_allclose(there, one["friction_coefficient"].values + 0.05, rtol=1e-12)


def test_without_an_interface_they_say_so():
    data = compare(contact(), load="10 N")
    one = data.sel(model="persson_2001")
    assert np.isnan(one["friction_coefficient_at_load"]) and "interfacial_shear_strength" in one["why_not"].item()
    assert float(one["contact_area_at_load"]) > 0.0
    assert np.isfinite(data.attrs["spread"]).all()


def test_spread_and_recommendation(data):
    mu = data["friction_coefficient_at_load"].values
    assert data.attrs["spread"] == [mu.min(), mu.max()]
    inside = mu[[not text for text in data["outside_validity"].values]]
    assert data.attrs["spread_within_validity"] == [inside.min(), inside.max()]
    chosen = data.sel(model=data.attrs["recommended"])
    assert chosen["outside_validity"].item() == "" and "within its validity" in data.attrs["reason"]
    assert data.attrs["working_load"] == pytest.approx(10.0)


def test_the_field_disagrees_by_an_order_of_magnitude(data):
    """What the comparison is for; and the order of the abstracts: full stick above failure by sliding above first yield."""
    mu = {name: float(data.sel(model=name)["friction_coefficient_at_load"]) for name in data["model"].values}
    assert mu["cohen_kligerman_etsion_2008"] > mu["kogut_etsion_2004"] > mu["chang_etsion_bogy_1988"]
    assert max(mu.values()) > 10.0 * min(mu.values())


def on(**surface):
    """The contact with another surface."""
    roughness = st.Roughness(**SURFACE | surface)
    return st.Contact(**STEEL, roughness=roughness, work_of_adhesion="1 J/m^2", interfacial_shear_strength="200 MPa")


def test_validity_is_judged_at_the_working_load():
    """Plasticity index, Tabor parameter and theta: a smooth, clean contact and one of sharp asperities leave them."""
    smooth = " ".join(compare(on(asperity_height_deviation="5 nm"), load="1 N")["outside_validity"].values)
    assert "theta = " in smooth and "mu_T = " in smooth and "adhesion is left out" in smooth
    sharp = " ".join(compare(on(asperity_radius="1 um"), load="1 N")["outside_validity"].values)
    assert "psi = " in sharp


def test_films():
    """On a coated contact: the paper's film and the others, each once; theories without asperities say why they are silent."""
    coated = contact(coating=st.Coating(**FILM), interfacial_shear_strength="50 MPa")
    names = [one.name for one in candidates(coated)]
    assert len(names) == len(set(names))
    data = compare(coated, load="1 N")
    assert {"soft_coating_2015 + sequential", "graded"} <= set(data["model"].values)
    for film in of_kind("film").values():
        shown = sum(str(name).endswith(film.key) for name in data["model"].values)
        assert shown > 1 if film.key == "sequential" else shown == film.interchangeable
    assert "persson_2001: " in data.attrs["left_out"] and "this contact has a film" in data.attrs["left_out"]


def test_an_unreachable_load_is_said_not_computed():
    data = compare(SHEARED, load="1e9 N")
    assert np.isnan(data["friction_coefficient_at_load"].sel(model="chang_etsion_bogy_1988"))
    assert all("carries loads up to" in text for text in data["why_not"].values if "load" in text)


def test_indices_can_be_compared_too():
    data = compare(st.Indices(theta=100, lam=10), load=0.01)
    assert "soft_coating_2015" in data["model"].values
    assert "persson_2001: density is not given" in data.attrs["left_out"]


def test_bad_input():
    with pytest.raises(st.InputError, match="single numbers"):
        compare(st.Indices(theta=st.axis("theta", [1, 2]), lam=1))
    with pytest.raises(st.InputError, match="Contact"):
        compare("steel")
    with pytest.raises(st.InputError, match="load"):
        compare(SHEARED, load="10 m")


CASE = """
title = "Steel on steel"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "0.1 J/m^2"
nominal_area = "1 mm^2"
interfacial_shear_strength = "200 MPa"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
[solve]
load = ["1 N", "10 N", "20 N"]
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path


def run(*arguments):
    return CliRunner().invoke(app, ["compare", *map(str, arguments)])


def test_command_in_json(case, data):
    found = json.loads(run(case, "--json").stdout)
    assert found["working_load"] == pytest.approx(10.0) and found["recommended"] == data.attrs["recommended"]
    assert found["units"]["load"] == "N"
    rows = {row["model"]: row for row in found["models"]}
    assert set(rows) == set(data["model"].values)
    for name in ("load", "contact_area", "friction_force", "friction_coefficient", "mean_separation"):
        assert len(rows["soft_coating_2015"]["curve"][name]) == 80
    assert rows["persson_2001"]["curve"]["mean_separation"] == [None] * 80  # it knows none
    assert json.loads(run(case, "--json", "--load", "2 N").stdout)["working_load"] == pytest.approx(2.0)
    assert comparison(data)["criteria"][0].startswith("pastewka_robbins_2014: ")


def test_command_for_people(case, tmp_path):
    out = tmp_path / "results"
    result = run(case, "--out", out)
    assert result.exit_code == 0
    said = " ".join(result.stdout.split())  # lines are folded to the width of the terminal
    for word in ("kogut_etsion_2004", "working load 10 N", "recommended: ", "within their validity", "does not stick"):
        assert word in said
    assert {path.name for path in out.iterdir()} == {"compare.csv", "compare.nc", "compare.png"}
    lines = (out / "compare.csv").read_text().splitlines()
    assert lines[0] == "model,mean_separation [m],load [N],contact_area [m^2],friction_force [N],friction_coefficient"
    assert (len(lines) - 1) % 80 == 0


def test_command_refuses_in_one_line(case):
    result = CliRunner().invoke(app, ["compare", str(case), "--load", "2 m"])
    assert result.exit_code == 2 and len(result.output.strip().splitlines()) == 1 and "load" in result.output
