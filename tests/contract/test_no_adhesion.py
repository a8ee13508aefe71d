"""A contact that does not adhere: models that know no adhesion answer, as they do for the least adhesion there is; the others
refuse in one line, and nothing is ever not a number that was one."""

import itertools
import pickle
import tomllib
from dataclasses import replace

import numpy as np
import pytest

import stiction as st
from cases import STEEL_ON_STEEL
from refusals import refusal
from stiction.case.case_tables import json_schema
from stiction.case.read import parse_case
from stiction.contact.indices import Groups
from stiction.quantities.errors import InputError
from stiction.records.registry import AsperityLaw, FilmLaw, TangentialLaw, of_kind
from stiction.solving.choice import Choice
from stiction.solving.chosen import resolve_laws
from stiction.solving.problem import make_problem
from stiction.studies.case_results import compare_case, solve_case

ROUGH = {"asperity_height_deviation": 1e-7, "asperity_radius": 2e-5, "asperity_density": 1.2e10}
BODY = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 2e9, "tangent_modulus": 2e9}
FILM = {"youngs_modulus": 80e9, "poissons_ratio": 0.37, "hardness": 0.9e9}
GIVEN = {"interfacial_shear_strength": 5e7, "pressure_coefficient": 0.05, "nominal_area": 1e-7}


def contact(coated=False, **more):
    coating = {"coating": {"material": FILM, "thickness": 2e-7, "bodies": "first"}} if coated else {}
    return st.Contact(**{"first": BODY, "second": BODY, "roughness": ROUGH} | GIVEN | coating | more)


def choices(film):
    """Every asperity law with every tangential law under the plain sum; with a film as many of them as every law of both
    kinds that goes with it needs to be there once."""
    met = set()
    for pair in itertools.product(of_kind(AsperityLaw), of_kind(TangentialLaw)):
        choice = Choice("greenwood_williamson_1966", *pair, film)
        if film and met.issuperset(pair):
            continue
        if together(choice):
            met.update(pair)
        yield choice


def together(choice):
    try:
        resolve_laws(choice, choice.film is not None)
    except InputError:
        return False
    return True


def said(subject, choice):
    try:
        return make_problem(subject, choice).on_grid(np.array([-0.5, 1.0, 3.0]))
    except InputError as error:
        return error


@pytest.mark.parametrize("film", [None, *(key for key, one in of_kind(FilmLaw).items() if one.interchangeable)])
def test_laws_without_adhesion_answer_and_the_others_say_what_they_need(film):
    """With hardly any adhesion they answer too: what asks for none then gives the same, to what theta^(-1/3) leaves; what
    refuses here names the work of adhesion and itself, unless its laws never go together."""
    none, hardly = contact(film is not None), contact(film is not None, work_of_adhesion=1e-12)
    answered = refused = 0
    for choice in choices(film):
        found, expected = said(none, choice), said(hardly, choice)
        if isinstance(expected, InputError):
            assert isinstance(found, InputError)
        elif isinstance(found, InputError):
            refused += 1
            assert found.field == "work_of_adhesion" and "> 0 J/m^2" in found.allowed and "needs it" in found.allowed
            assert any(key in found.allowed for key in (choice.asperity, choice.tangential, choice.film or "")), choice
        else:
            answered += 1
            for name, values in found.items():
                assert np.isfinite(values[~np.isnan(expected[name])]).all(), name
                np.testing.assert_allclose(values, expected[name], rtol=1e-9, err_msg=f"{name}: {choice}")
    assert answered + refused > 0 and (film or (answered > 30 and refused > 10))


@pytest.mark.parametrize("zero", [{}, {"work_of_adhesion": 0}, {"work_of_adhesion": "0 J/m^2"}, {"work_of_adhesion": None}])
def test_zero_and_nothing_are_the_same(zero):
    bare = contact(**zero)
    groups = bare.groups()
    assert not {"theta", "lam", "tabor_parameter"} & groups.keys()
    # H = 2 GPa, K = (4/3) 200 GPa/(2 (1 - 0.09)), R/sigma = 200
    assert groups["hardness_group"] == pytest.approx(np.pi * 2e9 * 200**0.5 / (200e9 / (2 * 0.91) * 4 / 3), rel=1e-12)
    assert bare.tabor_parameter() == 0.0
    with pytest.raises(InputError) as caught:
        st.solve(bare, load="1 mN")
    line = str(caught.value)
    assert line.startswith("work_of_adhesion: ") and "roy_chowdhury_ghosh_1994, which soft_coating_2015 uses here" in line
    assert "--model" in line and line.endswith("`stiction compare CASE.toml` shows them")
    assert str(pickle.loads(pickle.dumps(caught.value))) == line
    with pytest.raises(InputError) as caught:
        st.solve(bare, load="1 mN", model="fuller_tabor_1975")
    assert "--model" not in str(caught.value)  # somebody chose that one
    assert "named" not in st.compare(bare, load="1 mN").attrs["not_applicable"]
    assert st.solve(bare, load="1 mN", model="chang_etsion_bogy_1988")["pull_off_force"] == 0.0


def test_the_hardness_group_is_what_theta_and_lambda_make_together():
    """pi H sqrt(R/sigma)/K from materials, against that of the groups of an adhesive contact (theory 1)."""
    adhesive = contact(work_of_adhesion=0.3).indices()
    assert Groups.of(adhesive)[0].eta == pytest.approx(contact().indices().hardness_group, rel=1e-14)
    film = Groups.of(contact(True, work_of_adhesion=0.3).indices())[0].film().eta
    assert film == pytest.approx(Groups.of(contact(True).indices())[0].film().eta, rel=1e-14)


def test_compare_runs_what_it_can_and_says_why_not():
    for coated in (False, True):
        data = st.compare(contact(coated), load="1 mN")
        adhesive = st.compare(contact(coated, work_of_adhesion=1e-12), load="1 mN").sel(model=data["model"])
        found, expected = (one["friction_coefficient_at_load"].values for one in (data, adhesive))
        np.testing.assert_allclose(found, expected, rtol=1e-9)
        assert len(found) > 8
        for key in ("jkr", "dmt", "maugis_1992", "roy_chowdhury_ghosh_1994", "thornton_ning_1998"):
            assert key in data.attrs["not_applicable"]
        assert data.attrs["not_applicable"].count("work_of_adhesion") >= 5
        assert "pastewka" not in data.attrs["criteria"]


def test_groups_alone():
    """Indices with the hardness group in place of theta and lambda, in a sweep too."""
    plain = {"load": [0.01, 0.1], "model": "kogut_etsion_2004"}
    found = st.solve(st.Indices(hardness_group=2.0), **plain)
    lam = 2.0**4 * 1e12 / (18 * np.pi**2)  # eta = sqrt(pi) 18^(1/4) lambda^(1/4) theta^(-1/2) at theta = 1e6
    expected = st.solve(st.Indices(theta=1e6, lam=lam), **plain)
    np.testing.assert_allclose(found["friction_coefficient"], expected["friction_coefficient"], rtol=1e-12)
    swept = st.solve(st.Indices(hardness_group=st.axis("hardness_group", [1.0, 2.0])), **plain)
    np.testing.assert_allclose(swept["friction_coefficient"][1], found["friction_coefficient"], rtol=1e-12)
    with refusal("theta", "roy_chowdhury_ghosh_1994"):
        st.solve(st.Indices(hardness_group=2.0), load=0.1)


@pytest.mark.parametrize(
    ("given", "field"),
    [({}, "theta"), ({"theta": 1}, "lam"), ({"lam": 1}, "theta"), ({"theta": 1, "hardness_group": 1}, "hardness_group"),
     ({"theta": 1, "lam": 1, "hardness_group": 1}, "hardness_group")],
)  # fmt: skip
def test_either_adhesion_or_none(given, field):
    with pytest.raises(InputError) as caught:
        st.Indices(**given)
    assert caught.value.field == field and "hardness_group" in str(caught.value)


def test_film_and_bodies_adhere_or_neither():
    film = {"material": FILM, "thickness": 1e-7}
    with refusal("coating.work_of_adhesion"):
        contact(coating=film | {"work_of_adhesion": 0.1})
    with refusal("coating.work_of_adhesion"):
        contact(coating=film | {"work_of_adhesion": 0}, work_of_adhesion=0.1)
    assert contact(coating=film | {"work_of_adhesion": 0}).groups()["n_g"] == 1.0
    with refusal("work_of_adhesion", "a sweep from 0"):
        contact(work_of_adhesion=st.axis("work_of_adhesion", [0.0, 0.1]))
    with refusal("work_of_adhesion"):
        contact(work_of_adhesion=-0.1)


@pytest.mark.parametrize("gamma", [1e-30, 1e-100, 1e-160, 1e-320])
def test_adhesion_that_is_almost_none_is_no_nan(gamma):
    """Groups that grow without end are numbers or refused."""
    try:
        found = st.solve(contact(work_of_adhesion=gamma), load="1 mN", model="chang_etsion_bogy_1988")
    except InputError as error:
        assert gamma < 1e-30 and "\n" not in str(error)
    else:
        assert np.isfinite(float(found["friction_coefficient"]))


def test_heights_that_end():
    heights = st.height_distribution("empirical", samples=[0, 1, 2, 3, 3, 4, 5, 1, 2, 3, 2, 4])
    found, expected = (
        st.solve(one, load="1 mN", model="chang_etsion_bogy_1988", heights=heights)["friction_coefficient"]
        for one in (contact(), contact(work_of_adhesion=1e-12))
    )
    assert float(found) == pytest.approx(float(expected), rel=1e-9)


def test_unloading_without_adhesion():
    laws = {"asperity": "jackson_green_2005", "tangential": "bowden_tabor_1943"}
    found = st.unload(contact(), max_load="1 mN", separation_increase=1e-9, **laws)
    expected = st.unload(contact(work_of_adhesion=1e-12), max_load="1 mN", separation_increase=1e-9, **laws)
    assert float(found["load"]) == pytest.approx(float(expected["load"]), rel=1e-6)


def test_case_files():
    text = STEEL_ON_STEEL.replace('work_of_adhesion = "0.1 J/m^2"\n', "")
    case = parse_case(tomllib.loads(text + '[solve]\nload = "1 N"\nmodel = "cohen_kligerman_etsion_2008"\n'))
    assert solve_case(case)["friction_coefficient"].size == 1
    assert "jkr" in compare_case(case, 1.0).attrs["not_applicable"]
    with refusal("work_of_adhesion"):
        solve_case(replace(case, choice=Choice()))
    with refusal("contact.work_of_adhesion", "0"):
        parse_case(tomllib.loads(text.replace("nominal", "work_of_adhesion = 0\nnominal", 1) + '[solve]\nload = "1 N"\n'))


def test_schema():
    schema = json_schema()["$defs"]
    assert "work_of_adhesion" not in schema["Contact"]["required"]
    assert ">= 0 J/m^2" in schema["Contact"]["properties"]["work_of_adhesion"]["description"]
    assert {"required": ["hardness_group"]} in schema["Indices"]["oneOf"]
