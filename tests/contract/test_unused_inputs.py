"""Inputs that do not count are named, for every model: what is named changes nothing, and what is not named does."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from stiction.case.read import parse_case
from stiction.cli import app
from stiction.records.registry import FilmLaw, RoughSurface, of_kind
from stiction.solving.problem import make_problem
from stiction.studies.comparison.compare import working_load
from stiction.studies.prediction.predict import is_predicted
from stiction.web.query import Query, solved

PAPER = "soft_coating_2015"
ROUGHNESS = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="5 um", asperity_density="1.7e11 1/m^2")
STEEL = st.Material(
    name="steel",
    youngs_modulus="210 GPa",
    poissons_ratio=0.3,
    hardness="2 GPa",
    yield_stress="0.7 GPa",
    tangent_modulus="4 GPa",
)
BARE = st.Contact(
    first=STEEL,
    second=STEEL,
    roughness=ROUGHNESS,
    work_of_adhesion="2 J/m^2",
    nominal_area="1 mm^2",
    interfacial_shear_strength="20 MPa",
    pressure_coefficient=0.1,
    peeling=0.5,
)
FILM = st.Coating(
    material=STEEL.replace(name="film", hardness="0.8 GPa", youngs_modulus="80 GPa", yield_stress="0.28 GPa"),
    thickness="100 nm",
    work_of_adhesion="1 J/m^2",
)


def changed(contact: st.Contact, name: str) -> st.Contact:
    """The contact with another value of this input, in both bodies where it is of one."""
    where, _, field = name.rpartition(".")
    if where in ("first", "second"):
        body = STEEL.replace(**{field: 0.8 * getattr(STEEL, field)})
        return contact.replace(first=body, second=body)
    if where == "coating":
        return contact.replace(coating=contact.coating.replace(**{field: 0.8 * getattr(contact.coating, field)}))
    if where == "coating.material":
        film = contact.coating.material
        return contact.replace(coating=contact.coating.replace(material=film.replace(**{field: 0.8 * getattr(film, field)})))
    return contact.replace(**{field: 0.8 * getattr(contact, field)})


def differ(one, other) -> bool:
    names = [name for name in one.variables if one[name].dtype.kind == "f" and name != "load_residual"]
    with np.errstate(invalid="ignore"):
        return not all(np.allclose(one[name], other[name], rtol=1e-7, atol=0.0, equal_nan=True) for name in names)


def harder(contact: st.Contact) -> st.Contact:
    """Of bodies that hardly yield: then slip counts."""
    body = STEEL.replace(hardness="400 GPa", yield_stress="140 GPa")
    coating = contact.coating and contact.coating.replace(
        material=FILM.material.replace(hardness="300 GPa", yield_stress="100 GPa")
    )
    return contact.replace(first=body, second=body, coating=coating)


def check(contact: st.Contact, **laws) -> None:
    given = {"load": ["0.5 N", "20 N"]}
    result = st.solve(contact, **given, **laws)
    named = {row["input"] for row in json.loads(result.attrs["unused_inputs"])}
    asked = set(contact.optional_inputs())
    assert named <= asked
    for name in asked:
        does = differ(result, st.solve(changed(contact, name), **given, **laws))
        if name == "peeling" and not does:  # of asperities that yield before they slip it changes nothing
            one = harder(contact)
            does = differ(st.solve(one, **given, **laws), st.solve(changed(one, name), **given, **laws))
        assert does == (name not in named), (name, named)


# Of full contact the work of adhesion decides whether there is an answer, and not which.
MODELS = [key for key, one in of_kind(RoughSurface).items() if one.of_map is None and key != "persson_tosatti_2001"]


@pytest.mark.parametrize("model", MODELS)
def test_of_a_contact(model):
    check(BARE.replace(coating=FILM) if of_kind(RoughSurface)[model].on_film else BARE, model=model)


@pytest.mark.parametrize("film", [key for key, one in of_kind(FilmLaw).items() if one.interchangeable])
def test_of_a_coated_contact(film):
    record = of_kind(FilmLaw)[film]
    laws = {"asperity": record.asperity or None}
    if record.tangential == "interface":
        laws |= {"tangential": "briscoe_tabor_1978"}
    model = "soft_coating_2015" if record.tangential == "soft_coating_2015" else "greenwood_williamson_1966"
    check(BARE.replace(coating=FILM), model=model, film=film, **laws)


def test_of_the_reading_to_the_letter():
    check(BARE.replace(coating=FILM), model=PAPER, variant="published")
    check(BARE, model=PAPER, variant="published")


def test_what_a_preset_brings_was_not_given():
    contact = BARE.replace(first="iron", second=st.material("iron"))
    assert not {"first.yield_stress", "second.yield_stress", "first.tangent_modulus"} & set(contact.optional_inputs())
    own = contact.replace(first=st.material("iron", yield_stress="0.1 GPa"))
    assert "first.yield_stress" in own.optional_inputs()


def test_the_laws_that_would_use_it_are_named_and_do():
    said = json.loads(st.solve(BARE, load="1 N", model=PAPER).attrs["unused_inputs"])
    laws = {row["input"]: row["laws"] for row in said}["interfacial_shear_strength"]
    assert list(laws) == ["tangential"] and {"bowden_tabor_1943", "briscoe_tabor_1978", "tabor_1959"} <= set(laws["tangential"])
    for key in laws["tangential"]:
        words = st.solve(BARE, load="1 N", tangential=key).attrs["inputs_not_used"]
        assert "interfacial_shear_strength" not in words
    of_adhesion = json.loads(st.solve(BARE, load="1 N", model="greenwood_williamson_1966").attrs["unused_inputs"])
    for key in {row["input"]: row["laws"] for row in of_adhesion}["work_of_adhesion"]["asperity"]:
        words = st.solve(BARE, load="1 N", model="greenwood_williamson_1966", asperity=key).attrs["inputs_not_used"]
        assert "work_of_adhesion" not in words


def test_groups_that_do_not_count():
    result = st.solve(st.Indices(theta=40, lam=10, shear_strength=0.1, hardening=0.01), load=1e-3, model=PAPER)
    assert [row["input"] for row in json.loads(result.attrs["unused_inputs"])] == ["shear_strength", "hardening"]
    assert st.solve(st.Indices(theta=40, lam=10), load=1e-3).attrs["inputs_not_used"] == ""


CASE = """
[contact]
first = "iron"
second = "iron"
work_of_adhesion = "0.1 J/m^2"
nominal_area = "1 mm^2"
interfacial_shear_strength = "200 MPa"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
[solve]
model = "soft_coating_2015"
load = ["1 N", "2 N"]
"""


def run(*words):
    result = CliRunner().invoke(app, ["run", *map(str, words)], terminal_width=300)
    assert result.exit_code == 0, result.output
    return " ".join(result.output.split())


def test_the_command_says_it(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    case = tmp_path / "case.toml"
    said = "interfacial_shear_strength is not used by this model; --tangential bowden_tabor_1943 or "
    assert said in run(case, "--details") and "interfacial_shear_strength is not used" in run(case)
    assert said not in run(case, "--details", "--tangential", "bowden_tabor_1943")
    assert "film sequential is not used: this contact has no film" in run(case, "--film", "sequential")
    assert (
        "film"
        not in json.loads(CliRunner().invoke(app, ["run", str(case), "--json"]).stdout)["attrs"]["unused_inputs"][0]["input"]
    )
    result = CliRunner().invoke(app, ["run", str(case), "--film", "nonsense"])
    assert result.exit_code == 2


def unnamed(**tables):
    """The tables of the case without a model, and with these."""
    found = tomllib.loads(CASE)
    del found["solve"]["model"]
    return found | tables


REFUSED = {
    "solve": lambda: st.solve(parse_case(unnamed()).subject, load="1 N"),
    "slide": lambda: st.slide(parse_case(unnamed()).subject, load="1 N", asperity="jkr"),
    "solve_case": lambda: st.solve_case(parse_case(unnamed())),
}


@pytest.mark.parametrize("study", REFUSED)
def test_a_strength_that_the_default_model_ignores_is_refused(study, tmp_path, monkeypatch):
    """Adhesive junctions of the 2015 paper carry no stated strength: unless its model is named, that is an error."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(st.InputError) as caught:
        REFUSED[study]()
    said = str(caught.value)
    assert said.startswith("interfacial_shear_strength: 200 MPa; allowed: no value with the default model, soft_coating_2015")
    assert "--model recommended" in said and len(said.split()) <= 27 and not list(tmp_path.iterdir())


def test_the_page_refuses_it_too():
    with pytest.raises(st.InputError) as caught:
        solved(Query(unnamed(solve={"load": "1 N", "asperity": "jkr"})))
    assert caught.value.field == "interfacial_shear_strength"
    named = unnamed(solve={"load": "1 N", "model": PAPER})
    assert solved(Query(named)).data is not None


@pytest.mark.parametrize("words", [("--asperity", "jkr"), ("--load", "3 N", "--asperity", "jkr")])
def test_the_command_ends_in_one_line(words, tmp_path):
    (tmp_path / "case.toml").write_text(CASE.replace('model = "soft_coating_2015"\n', ""))
    result = CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), *words])
    assert result.exit_code == 2 and "which ignores it" in result.output and "\n" not in result.output.strip()


@pytest.mark.parametrize(
    "words", [("--model", PAPER), ("--model", "recommended"), ("--tangential", "bowden_tabor_1943"), ("--tangential", "none")]
)
def test_what_was_named_answers(words, tmp_path):
    (tmp_path / "case.toml").write_text(CASE.replace('model = "soft_coating_2015"\n', ""))
    assert run(tmp_path / "case.toml", *words)


def test_a_comparison_at_separations_asks_no_model_by_default(tmp_path):
    """All models are asked by name; the loads at the separations of the case do not depend on friction."""
    case = parse_case(unnamed(solve={"separation": [2.0, 1.0, 0.0]}))
    loads = st.solve(case.subject, separation=case.separation, model=PAPER)["load"].values
    assert working_load(case, None) == pytest.approx(loads[1])


def test_shipped_cases_state_nothing_that_is_ignored():
    for path in sorted((Path(__file__).parents[2] / "examples").glob("*.toml")):
        case = st.read_case(path)
        if not is_predicted(case):
            make_problem(case.subject.as_numbers(), case.choice)


@pytest.mark.parametrize(("hardness", "n_H"), [("9 GPa", 1.0), ("3 GPa", 1.5), ("1 GPa", 0.5)])
def test_a_counterbody_that_yields_first_is_said(hardness, n_H):
    """A film of these hardnesses on a body of 2 GPa, against one of 4 GPa or 2 GPa."""
    film = st.Coating(material=FILM.material.replace(hardness=hardness), thickness="100 nm", bodies="first")
    contact = BARE.replace(coating=film)  # against 2 GPa
    remarks = st.solve(contact, load="1 N", model=PAPER).attrs["remarks"]
    if n_H == 0.5:
        assert remarks == "" and contact.indices().n_H == pytest.approx(0.5)
        return
    assert "the counterbody steel is softer than the film film and yields first" in remarks and "(n_H = 1)" in remarks
    harder = contact.replace(coating=film.replace(material=film.material.replace(hardness="20 GPa")))
    assert harder.indices().n_H == contact.indices().n_H == 1.0  # the hardness of the film changes nothing
    both = contact.replace(coating=film.replace(bodies="both"))
    assert st.solve(both, load="1 N", model=PAPER).attrs["remarks"] == "" and both.indices().n_H != 1.0


def test_the_yield_stress_counts_where_it_caps_the_strength():
    """Silver of 30 MPa in shear under 20 MPa and 2 GPa."""
    for strength, counts in (("20 MPa", False), ("2 GPa", True)):
        contact = BARE.replace(coating=FILM, interfacial_shear_strength=strength)
        found = st.solve(contact, load="1 N", model="rough_on_film")
        assert ("first.yield_stress" in found.attrs["inputs_not_used"]) == (not counts)
