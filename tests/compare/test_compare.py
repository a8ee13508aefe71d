"""Every model on one contact: the comparison agrees with single solutions, and says what it leaves out, and why."""

import csv
import json
import math
import re
import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import stiction as st
from cases import STEEL_ON_STEEL
from refusals import refusal
from stiction.case.read import read_case
from stiction.cli import app
from stiction.records.registry import AsperityLaw, FilmLaw, RoughSurface, TangentialLaw, find, of_kind
from stiction.report.model_pictures import models_figure
from stiction.report.views.comparison import at_working_load, comparison, groups_of
from stiction.studies.case_results import compare_case
from stiction.studies.comparison.compare import candidates, compare, working_load

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
    said = set(data["model"].values) | {line.split(": ")[0] for line in data.attrs["not_applicable"].splitlines()}
    taken = {record.asperity for record in of_kind(RoughSurface).values()}
    asked = {key for key, one in of_kind(RoughSurface).items() if not one.on_film}
    growing = {key for key, one in of_kind(TangentialLaw).items() if one.yielded == "junction growth"}
    assert said == asked | (set(of_kind(AsperityLaw)) - taken) | growing
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


def test_a_status_says_whether_the_contact_fits_and_why_not(data):
    said = dict(zip(data["model"].values, data["status"].values, strict=True))
    for name, text in said.items():
        assert (text.split(",")[0] == "fits") == (data.sel(model=name)["outside_validity"].item() == ""), name
    sharp = compare(on(asperity_radius="1 um"), load="1 N")
    assert any(text.startswith("does not fit: ") for text in sharp["status"].values)
    far = compare(SHEARED, load="1e9 N")
    assert any(text.startswith("no answer: carries only loads up to") for text in far["status"].values)


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
    """Plasticity index, Tabor parameter and pull of adhesion: a smooth, clean contact and sharp asperities leave them."""
    smooth = " ".join(compare(on(asperity_height_deviation="5 nm"), load="1 N")["outside_validity"].values)
    assert "n P_0/P = " in smooth and "mu_T = " in smooth and "adhesion is left out" in smooth
    sharp = " ".join(compare(on(asperity_radius="1 um"), load="1 N")["outside_validity"].values)
    assert "psi = " in sharp


def test_films():
    """On a coated contact: the paper's film and the others, each once; theories without asperities say why they are silent."""
    coated = contact(coating=st.Coating(**FILM), interfacial_shear_strength="50 MPa")
    names = [one.name for one in candidates(coated)]
    assert len(names) == len(set(names))
    assert "printed" not in names  # one variant of its model, and no answer of its own
    data = compare(coated, load="1 N")
    assert {"soft_coating_2015 + sequential", "graded"} <= set(data["model"].values)
    for film in of_kind(FilmLaw).values():
        shown = sum(str(name).endswith(film.key) for name in data["model"].values)
        assert shown > 1 if film.key == "sequential" or film.solved_as_one else shown == film.interchangeable
    assert data.sel(model="jackson_green_2005 + layered")["outside_validity"].item() == ""
    assert "kogut_etsion_2004 + layered: " in data.attrs["not_applicable"]
    assert "persson_2001: " in data.attrs["not_applicable"] and "this contact has a film" in data.attrs["not_applicable"]


def test_a_film_solved_with_its_body_takes_the_friction_of_its_model_or_its_like():
    """One answer for each asperity law; the film by itself is the plain sum of it."""
    coated = contact(coating=st.Coating(**FILM))
    known = {one.name: one.choice for one in candidates(coated)}
    assert known["chang_etsion_bogy_1988 + layered"].tangential == "layered_first_yield"
    assert known["soft_coating_2015 + layered"].tangential is None and known["layered"].asperity is None
    assert "greenwood_williamson_1966 + layered" not in known
    given = compare(coated, load="1 N").sel(model="soft_coating_2015 + layered")
    single = st.solve(coated, load="1 N", model="soft_coating_2015", film="layered")
    assert float(given["friction_coefficient_at_load"]) == pytest.approx(float(single["friction_coefficient"]), rel=1e-9)


def test_a_film_law_is_asked_with_the_asperity_of_its_source():
    """Chang's film is of Chang, Etsion & Bogy's asperities."""
    coated = contact(coating=st.Coating(**FILM), interfacial_shear_strength="50 MPa")
    (film,) = (one for one in candidates(coated) if one.name == "chang_1997")
    assert film.choice.asperity == "chang_etsion_bogy_1987"


@pytest.mark.parametrize("model", ("persson_2001", "persson_2001_elastoplastic"))
def test_a_theory_without_separations_is_asked_at_the_loads_of_a_plain_sum(data, model):
    """Of Greenwood & Williamson's, in newtons, on a surface whose own moments are those of its asperities."""
    plain = data.sel(model="greenwood_williamson_1966")["load"].values
    assert_allclose(data.sel(model=model)["load"].values, plain, rtol=1e-12)
    assert data["load"].attrs["units"] == "N"
    assert np.isnan(data.sel(model=model)["mean_separation"].values).all()


def test_whether_a_surface_sticks_is_told_of_its_moments():
    """Not of the asperities that were found on it, where both are given."""
    rough = {"asperity_height_deviation": "10 nm", "asperity_radius": "20 um", "asperity_density": "1e12 1/m^2"}
    steel = {**STEEL, "work_of_adhesion": "1 J/m^2"}
    both = st.Contact(**steel, roughness=st.Roughness(**SURFACE, surface=st.Roughness(**rough)))
    moments, found = (st.Contact(**steel, roughness=st.Roughness(**one)) for one in (rough, SURFACE))
    told = [compare(one, separations=[0.0]).attrs["criteria"] for one in (both, moments, found)]
    assert told[0] == told[1] != told[2]


def test_an_unreachable_load_is_said_not_computed():
    data = compare(SHEARED, load="1e9 N")
    assert np.isnan(data["friction_coefficient_at_load"].sel(model="chang_etsion_bogy_1988"))
    assert all("carries only loads up to" in text for text in data["why_not"].values if "load" in text)


def test_indices_can_be_compared_too():
    data = compare(st.Indices(theta=100, lam=10), load=0.01)
    assert "soft_coating_2015" in data["model"].values
    assert "persson_2001: roughness_parameter is not given" in data.attrs["not_applicable"]


def test_a_model_that_is_left_out_for_a_number_says_that_number():
    """N R sigma = 1.7e7 5e-5 4.8e-8 = 4.08e-05."""
    sparse = SHEARED.replace(roughness=st.Roughness(**SURFACE | {"asperity_density": "1.7e7 1/m^2"}))
    (line,) = (one for one in compare(sparse, separations=[0.0]).attrs["not_applicable"].splitlines() if "hariri" in one)
    assert line.startswith("hariri_zu_ben_mrad_2006: roughness_parameter is 4.08e-05; allowed: 0.03965 to 1.015")


def test_bad_input():
    with refusal("theta", "2 numbers, 1 to 2"):
        compare(st.Indices(theta=st.axis("theta", [1, 2]), lam=1))
    with refusal("contact", "str", "stiction.Contact", "stiction.Indices"):
        compare("steel")
    with refusal("load", "10 m"):
        compare(SHEARED, load="10 m")


@pytest.mark.parametrize("separations", ([], 1.0, np.array(1.0), [[1.0, 2.0]], [0.0, math.nan], [2e6], "abc", [1j], [None]))
def test_separations_that_are_no_row_of_numbers_are_refused(separations):
    with refusal("separations", "-1e+06", "1e+06"):
        compare(st.Indices(theta=40, lam=10), separations=separations)


CASE = f"""
title = "Steel on steel"
{STEEL_ON_STEEL}[solve]
model = "soft_coating_2015"
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
    assert found["working_load"] == pytest.approx(10.0)
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
    result = run(case, "--all", "--out", out)
    assert result.exit_code == 0
    said = " ".join(result.stdout.split())  # lines are folded to the width of the terminal
    for word in ("kogut_etsion_2004", "at 10 N", "yes", "does not stick"):
        assert word in said
    names = {"compare.csv", "compare_at_load.csv", "compare.nc", "compare.png"}
    assert {path.name for path in out.iterdir()} == names and all(name in said for name in names)
    lines = (out / "compare.csv").read_text().splitlines()
    assert lines[0] == "model,mean_separation [m],load [N],contact_area [m^2],friction_force [N],friction_coefficient"
    assert (len(lines) - 1) % 80 == 0


@pytest.mark.parametrize("width", [80, 100])
def test_what_is_to_be_copied_is_not_broken(case, width):
    """On a narrow terminal: keys of the table, each at the start of a line."""
    case.write_text(CASE + '[contact.coating]\nmaterial = "silver"\nthickness = "200 nm"\nbodies = "first"\n')
    said = CliRunner().invoke(app, ["compare", str(case), "--all"], env={"COLUMNS": str(width)}).stdout.splitlines()
    names = compare_case(read_case(case), 1.0)["model"].values
    assert len(names) > 25
    answered = [name for name in names if "+" not in name]
    for name in answered:
        assert any(re.match(f"{re.escape(name)}( |$)", line.strip()) for line in said), name


def test_command_refuses_in_one_line(case):
    result = CliRunner().invoke(app, ["compare", str(case), "--load", "2 m"])
    assert result.exit_code == 2 and len(result.output.strip().splitlines()) == 1 and "load" in result.output


def refused(*arguments):
    """What is said to bad input: one line."""
    result = run(*arguments)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    return result.stderr


@pytest.mark.parametrize("load", ("0 N", "-1 N"))
def test_a_working_load_presses(case, load, tmp_path):
    assert refused(case, "--load", load, "--out", tmp_path / "out") == f"stiction: --load: '{load}'; allowed: one load > 0 N\n"
    with refusal("load", load, "> 0 N"):
        compare(SHEARED, load=load)
    assert refused(case, "--load", "2 m").startswith("stiction: --load: '2 m'; ")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("load", (0, -1.0, float("nan"), "many"))
def test_a_normalised_working_load_presses_too(load):
    with refusal("load"):
        compare(st.Indices(theta=100, lam=10), load=load)


# Points of a case -> the working load by default.
MIDDLES = {
    'load = ["1 N", "10 N", "20 N"]': 10.0,
    'load = ["-1 mN", "0 N", "1 N"]': 1.0,
    'load = ["2 N", "1 N", "0 N", "-1 mN", "-2 mN"]': 1.0,
    'load = ["0 N", "-1 mN"]': None,
    'load = "0 N"': None,
}


@pytest.mark.parametrize("points", MIDDLES)
def test_the_working_load_of_a_case_is_its_middle_one_or_the_nearest_that_presses(case, points):
    case.write_text(CASE.partition("load =")[0] + points)
    assert working_load(read_case(case), None) == MIDDLES[points]
    assert working_load(read_case(case), "3 N") == 3.0


def adhesive(path, points):
    """A case of a contact that holds itself."""
    text = CASE.replace("48 nm", "5.8 nm").replace("50 um", "72 um").replace("1.7e10", "5.7e10").replace("0.1 J", "1 J")
    path.write_text(text.partition("load =")[0] + points)
    return read_case(path)


def test_where_separations_are_asked_for_it_is_carried_at_one_of_them(case):
    found = adhesive(case, "separation = [10, 8, 6, 4, 0]")
    loads = st.solve(found.subject, separation=found.separation, model="soft_coating_2015")["load"].values
    assert (loads[:4] < 0.0).all() and loads[4] > 0.0
    assert working_load(found, None) == loads[4]
    assert working_load(adhesive(case, "separation = [10, 8]"), None) is None


def test_without_a_load_that_presses_there_are_only_curves(case, tmp_path):
    adhesive(case, 'load = ["-1 mN", "0 N"]')
    result = run(case, "--out", tmp_path / "out")
    assert result.exit_code == 0 and result.stderr == "" and "no model gives friction" in " ".join(result.stdout.split())
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"compare.csv", "compare.nc"}
    assert "working_load" not in json.loads(run(case, "--json").stdout)


def test_the_table_at_the_working_load(case, tmp_path, data):
    assert run(case, "--out", tmp_path / "out").exit_code == 0
    with (tmp_path / "out" / "compare_at_load.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    results = ["friction_coefficient", "mean_separation [m]", "load [N]", "contact_area [m^2]", "friction_force [N]"]
    measured = ["measured_area_error", "measured_area_error_rms", "measured_friction_error"]
    assert list(rows[0]) == [
        "model",
        "grade",
        *results,
        *measured,
        "plastic_junctions_resist",
        "status",
        "outside_validity",
        "why_not",
    ]
    assert [row["model"] for row in rows] == list(data["model"].values)
    for head in results:
        values = data[f"{head.partition(' ')[0]}_at_load"].values
        assert_allclose([float(row[head]) for row in rows], values, rtol=1e-12)
    for name in ("grade", "plastic_junctions_resist", "status", "outside_validity", "why_not"):
        assert [row[name] for row in rows] == list(data[name].values)


def test_the_table_has_the_ends_over_methods_if_the_surface_is_measured(data):
    low, high = (data["friction_coefficient_at_load"] * factor for factor in (0.5, 2.0))
    with_range_over_methods = data.assign(friction_coefficient_at_load_low=low, friction_coefficient_at_load_high=high)
    table = at_working_load(with_range_over_methods)
    names = ["friction_coefficient", "friction_coefficient_low", "friction_coefficient_high"]
    assert list(table)[1:4] == names
    for name, factor in zip(names, (1.0, 0.5, 2.0), strict=True):
        assert_allclose(table[name], factor * data["friction_coefficient_at_load"])


# The picture ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("load", ("1e-15 N", "1 N", "5 kN", "1e9 N"))
@pytest.mark.parametrize("strength", ({}, {"interfacial_shear_strength": "200 MPa"}))
def test_the_picture_warns_of_nothing_and_keeps_its_names_on_the_page(load, strength):
    pair = contact(**strength)
    data = compare(pair, load=load)
    answer = st.predict(pair, load=load) if load in ("1 N", "5 kN") else None
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("error")
        figure = models_figure(data, groups_of(data), answer, "title")
        figure.draw_without_rendering()
    (axes,) = figure.axes
    page, labels = figure.bbox, [one for one in (axes.yaxis.label, axes.xaxis.label) if one.get_text()]
    for box in [one.get_window_extent() for one in (*labels, *figure.legends)]:
        assert page.x0 <= box.x0 < box.x1 <= page.x1 and page.y0 <= box.y0 < box.y1 <= page.y1


def test_the_picture_shows_the_prediction_its_interval_and_the_working_load(data):
    answer = st.predict(SHEARED, load="10 N")
    (axes,) = models_figure(data, groups_of(data), answer).axes
    assert "10 N" in axes.get_title()
    (bar,) = axes.containers[0].lines[2]
    (segment,) = bar.get_segments()
    ends = [float(answer["friction_coefficient_low"]), float(answer["friction_coefficient_high"])]
    assert segment[:, 1].tolist() == pytest.approx(ends) and segment[:, 0].tolist() == [10.0, 10.0]


# By what plastic junctions resist -------------------------------------------------------------------------------------------


def test_families_by_what_plastic_junctions_resist(data, case, tmp_path):
    """From the law of each model: in JSON and the table."""
    said = dict(zip(data["model"].values, data["plastic_junctions_resist"].values, strict=True))
    for key, record in of_kind(RoughSurface).items():
        if key in said and record.tangential != "none":
            assert said[key] == find(record.tangential, TangentialLaw).yielded
    assert set(said.values()) >= {"none", "interface", "full stick"}
    rows = comparison(data)["models"]
    assert {row["model"]: row["plastic_junctions_resist"] or "" for row in rows} == said
    assert list(at_working_load(data)["plastic_junctions_resist"].values) == list(said.values())


def test_a_status_names_what_a_model_ignores_of_the_interface():
    """Full stick computes its own strength; Tabor's law has no pressure coefficient; an area times tau_0 + alpha p has both."""
    silicon = {"first": "silicon", "second": "silicon", "interface": "monolayer", "interfacial_shear_strength": None}
    said = compare(contact().replace(**silicon), load="1 mN")["status"]
    status = {name: said.sel(model=name).item() for name in ("kogut_etsion_2004", "tabor_1959", "persson_widened")}
    assert "without the interface" in status["kogut_etsion_2004"] and "without alpha" in status["tabor_1959"]
    assert "without" not in status["persson_widened"]
