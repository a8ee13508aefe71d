"""Every tangential law with every asperity law and film: combined, or refused with the reason, by the records; and the laws of
growing junctions on every film that they go with."""

import itertools

import numpy as np
import pytest

from stiction.engine.heights import gaussian, height_distribution
from stiction.engine.summation import scattered
from stiction.quantities.errors import InputError
from stiction.records.registry import (
    JUNCTIONS,
    AsperityLaw,
    FilmLaw,
    TangentialLaw,
    find,
    friction_incompatibility,
    incompatibility,
    of_kind,
)
from stiction.solving.choice import Choice
from stiction.solving.chosen import resolve_laws
from stiction.solving.problem import problem_of
from tables import groups

PLAIN = "greenwood_williamson_1966"
FILMS = [None, *(one for one in of_kind(FilmLaw).values() if one.interchangeable)]
GROWING = [one for one in of_kind(TangentialLaw).values() if one.yielded == "junction growth"]
FILM = {"n_E": 0.5, "n_H": 0.5, "tau": 3.0, "film_aspect": 0.5, "film_nu": 0.3, "n_g": 1.0}


def refusal(choice, coated):
    """What is said against a choice; "" if nothing is."""
    try:
        resolve_laws(choice, coated)
    except InputError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("tangential", of_kind(TangentialLaw).values(), ids=lambda law: law.key)
def test_every_tangential_law_with_every_asperity_law_and_film(tangential):
    """Refused where a record is against it and nowhere else, in one line with what does not suit what, and why."""
    for asperity, film in itertools.product(of_kind(AsperityLaw).values(), FILMS):
        against = [incompatibility(tangential, asperity)]
        if film is not None:
            against += [incompatibility(film, asperity), friction_incompatibility(film, tangential)]
        said = refusal(Choice(PLAIN, asperity.key, tangential.key, film.key if film else None), film is not None)
        assert bool(said) == any(against), (asperity.key, film and film.key)
        assert not said or (any(one and one in said for one in against) and "\n" not in said)


@pytest.mark.parametrize("film", FILMS[1:], ids=lambda film: film.key)
@pytest.mark.parametrize("tangential", GROWING, ids=lambda law: law.key)
def test_growing_junctions_on_every_film(film, tangential):
    """Friction, where the records let it have some; or the reason why there is none."""
    given = groups(theta=1e3, lam=100.0, nu=0.3, hardness_to_yield=2.8, shear_strength=0.05, sharpness=0.03, **FILM)
    asperity = "brizmer_kligerman_etsion_2006"
    choice = Choice(PLAIN, asperity, tangential.key, film.key)
    against = incompatibility(film, find(asperity, AsperityLaw)) or friction_incompatibility(film, tangential)
    assert bool(refusal(choice, True)) == bool(against)
    if against:
        assert against in refusal(choice, True)
        return
    h = np.linspace(-1.0, 2.0, 4)
    for heights in (gaussian(), height_distribution("exponential")):
        found = scattered(problem_of(given, choice).regimes, h, heights, np.zeros(4, int)).sum(axis=0)
        friction = found[:, 3:].sum(axis=1)
        assert np.isfinite(found).all() and (friction > 0.0).all() and (np.diff(friction) < 0.0).all()


def test_other_laws_for_plastic_junctions_on_every_film():
    """Refused where they cannot go with the film, with the record's reason; combined elsewhere."""
    for law in (one for one in of_kind(TangentialLaw).values() if one.junctions):
        asperity = next(one for one in of_kind(AsperityLaw).values() if not incompatibility(law, one))
        for film, key in itertools.product(FILMS[1:], law.junctions):
            if incompatibility(film, asperity) or friction_incompatibility(film, law):
                continue
            against = friction_incompatibility(film, find(key, TangentialLaw))
            said = refusal(Choice(PLAIN, asperity.key, law.key, film.key, options={JUNCTIONS: key}), True)
            assert bool(said) == bool(against) and against in said
