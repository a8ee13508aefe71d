"""Which body is called the first changes no result: bodies unlike in one property at a time, as hard as each other, under every
model, law and film; and what is taken of two that are as hard is what the description of Contact says."""

from dataclasses import replace

import numpy as np
import pytest

import stiction as st
from stiction.laws.presliding.kind import Presliding
from stiction.quantities.errors import InputError
from stiction.records.registry import AsperityLaw, FilmLaw, RoughSurface, TangentialLaw, of_kind
from stiction.solving.problem import make_problem
from stiction.studies.comparison.compare import candidates

ROUGH = {"asperity_height_deviation": 1e-7, "asperity_radius": 2e-5, "asperity_density": 1.2e10}
ONE = {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "hardness": 2e9, "yield_stress": 0.7e9, "tangent_modulus": 2e9}
OTHERS = {
    "stiffer": {"youngs_modulus": 300e9},
    "Poisson's ratio": {"poissons_ratio": 0.42},
    "yield stress": {"yield_stress": 1.1e9},
    "no yield stress": {"yield_stress": None},
    "tangent modulus": {"tangent_modulus": 9e9},
    "no tangent modulus": {"tangent_modulus": None},
    "all": {"youngs_modulus": 90e9, "poissons_ratio": 0.2, "yield_stress": 0.8e9, "tangent_modulus": 1e9},
    "harder": {"hardness": 3e9, "poissons_ratio": 0.2, "yield_stress": 0.6e9},
}
FILM = {"youngs_modulus": 80e9, "poissons_ratio": 0.37, "hardness": 2e9, "yield_stress": 0.9e9}
COATED = {"bare": None, "first": "second", "second": "first", "both": "both"}  # where the film is -> where it is after a swap
GIVEN = {"interfacial_shear_strength": 5e7, "pressure_coefficient": 0.05, "work_of_adhesion": 0.05, "nominal_area": 1e-7}


def both_ways(other, bodies):
    """The contact of ONE and the other, and of the other and ONE."""

    def contact(first, second, coated):
        coating = {} if bodies == "bare" else {"coating": {"material": FILM, "thickness": 2e-7, "bodies": coated}}
        return st.Contact(first=first, second=second, roughness=ROUGH, **GIVEN, **coating)

    other = ONE | OTHERS[other]
    return contact(ONE, other, bodies), contact(other, ONE, COATED[bodies])


def choices(contact, bodies):
    """Every model as it is compared; pairs of an asperity and a tangential law or a film; what does not suit is left to refuse.
    Where there is a film each pair is asked at one of three places of it, and each law at all three."""
    place = None if bodies == "bare" else ("first", "second", "both").index(bodies)

    def here(*pair):
        return place is None or sum(pair) % 3 == place

    known = [one.choice for one in candidates(contact)]
    interface = next(one.key for one in of_kind(TangentialLaw).values() if one.interfacial)
    for choice in known:
        yield choice
        if of_kind(RoughSurface)[choice.model_key].tangential == "none":
            yield replace(choice, tangential=interface)
    plain = known[[one.model for one in known].index("greenwood_williamson_1966")]
    for row, asperity in enumerate(of_kind(AsperityLaw)):
        for column, tangential in enumerate(of_kind(TangentialLaw)):
            if here(row, column):
                yield replace(plain, asperity=asperity, tangential=tangential)
        for presliding in () if contact.has_film else of_kind(Presliding):
            yield replace(plain, asperity=asperity, beside={"presliding": presliding})
        for column, film in enumerate(of_kind(FilmLaw) if contact.has_film else ()):
            if here(row, column):
                yield replace(plain, asperity=asperity, tangential=interface, film=film)


def said(contact, choice):
    """Normalised results with the scales of the contact, or the refusal."""
    try:
        problem = make_problem(contact, choice)
        results = problem.at_load(np.array([[0.05]])) if problem.needs_load else problem.on_grid(np.array([0.0, 1.5]))
    except InputError as error:
        return str(error)
    scales = vars(contact.scales())
    return {name: np.asarray(value, dtype=float) for name, value in {**results, **scales}.items()}


@pytest.mark.parametrize("bodies", COATED)
def test_no_model_knows_which_body_is_the_first(bodies):
    contact, swapped = both_ways("all", bodies)
    answered = 0
    for choice in choices(contact, bodies):
        found, expected = said(swapped, choice), said(contact, choice)
        assert isinstance(found, str) == isinstance(expected, str), choice
        if isinstance(found, str):
            assert found == expected
            continue
        answered += 1
        assert found.keys() == expected.keys()
        for name in found:
            np.testing.assert_allclose(found[name], expected[name], rtol=1e-12, atol=0, err_msg=f"{name}: {choice}")
    assert answered > 40


@pytest.mark.parametrize("bodies", COATED)
@pytest.mark.parametrize("other", OTHERS)
def test_no_group_and_no_property_knows(other, bodies):
    """All that any model is given, and what ranges of validity are stated in: bit for bit, or to the last digit."""
    contact, swapped = both_ways(other, bodies)
    found, expected = swapped.groups(), contact.groups()
    assert found.keys() == expected.keys()
    for name in found:
        assert found[name] == pytest.approx(expected[name], rel=4e-16), name
    assert swapped.tabor_parameter() == contact.tabor_parameter()


def test_what_yields_first_is_taken_of_two_as_hard():
    """The lower yield stress, then the lower Poisson's ratio, then the lower tangent modulus."""
    taken = {name: both_ways(name, "bare")[0].indices() for name in OTHERS}
    assert taken["yield stress"].hardness_to_yield == pytest.approx(2.0 / 0.7)
    assert taken["no yield stress"].hardness_to_yield == pytest.approx(2.0 / 0.7)  # 2.8 stands for the unknown one
    assert taken["Poisson's ratio"].nu == 0.3
    assert taken["tangent modulus"].hardening == pytest.approx(2 / 200)
    assert taken["no tangent modulus"].hardening is None
    assert taken["all"].nu == 0.3 and taken["all"].hardening == pytest.approx(2 / 200)
    assert taken["harder"].nu == 0.3


def test_along_a_sweep_the_choice_is_made_point_by_point():
    """A body that is as hard as the other at one point of a sweep."""
    hardness = st.axis("hardness", [1e9, 2e9, 3e9])
    first = {**ONE, "hardness": hardness, "poissons_ratio": 0.2}
    contacts = [
        st.Contact(first=one, second=two, roughness=ROUGH, **GIVEN)
        for one, two in ((first, ONE), (ONE, first))
    ]  # fmt: skip
    for contact in contacts:
        # H/Y is 1.43, 2.86 and 4.29 along it, 2.86 of the other; of Poisson's ratio the lower is taken in the middle.
        assert contact.indices().nu.values.tolist() == [0.2, 0.2, 0.3]
        assert contact.indices().hardness_to_yield.values == pytest.approx([1 / 0.7, 2 / 0.7, 2 / 0.7])
