"""List the models that can be applied to a contact, with their names in a comparison."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject
from stiction.quantities.errors import InputError, nearest
from stiction.records.registry import (
    AsperityLaw,
    FilmLaw,
    RoughSurface,
    TangentialLaw,
    find,
    friction_incompatibility,
    of_kind,
)
from stiction.solving.choice import RECOMMENDED, Choice

# The sum that accepts any asperity law, and the film law that accepts any asperity law.
_SUM, _SUITS_ALL = "greenwood_williamson_1966", "sequential"
# The asperity law used with laws of junction growth: it has plastic flow, and its error on benchmark surfaces is small.
_FLOWS = "zhao_maietta_chang_2000"
# Largest number of points of a map that is solved at a few loads within seconds.
_POINTS = 300_000


@dataclass(frozen=True)
class Candidate:
    """Store a model that a comparison can apply to a contact.

    name: its name in the comparison. choice: the keys of the model, its laws and options.
    """

    name: str
    choice: Choice


def candidates(subject: Subject) -> list[Candidate]:
    """Return every rough-surface model that a comparison tries, and the Greenwood-Williamson sum with each other asperity law.

    subject: the contact. Without a film and without a pressure coefficient, laws of junction growth are added, combined with an
    asperity law that has plastic flow. On a coated contact each model is combined with its own film law or "sequential". It is
    also combined with every film law that solves film and body as one elastic solid. Each other film law is a separate
    candidate. The model that solves the map uses all points of a small map, and a sample of the points of a large map.
    """
    models = of_kind(RoughSurface)
    taken = {model.asperity for model in models.values()}
    listed = [
        _of_map(model, subject) if model.of_map is not None else Candidate(key, Choice(key))
        for key, model in models.items()
        if subject.has_film or not model.on_film
    ]
    listed += [Candidate(key, Choice(_SUM, asperity=key)) for key in of_kind(AsperityLaw) if key not in taken]
    if not subject.has_film:
        if subject.known("pressure_coefficient") is not None:  # laws of junction growth would ignore it
            return listed
        return listed + [
            Candidate(key, Choice(_SUM, asperity=_FLOWS, tangential=key))
            for key, law in of_kind(TangentialLaw).items()
            if law.yielded == "junction growth"
        ]
    films = of_kind(FilmLaw)
    as_one = [
        _as_one(candidate, models[candidate.choice.model_key], film)
        for film in films.values()
        if film.solved_as_one
        for candidate in listed
        # The plain sum is omitted, because the film law combined with it is added on its own below.
        if models[candidate.choice.model_key].asperity and candidate.choice != Choice(_SUM)
    ]
    listed = [_with_film(candidate, models[candidate.choice.model_key]) for candidate in listed] + as_one
    return listed + [_alone(film) for film in films.values() if film.interchangeable and film.key != _SUITS_ALL]


def _of_map(model: RoughSurface, subject: Subject) -> Candidate:
    """Return the candidate that solves the height map, or only every k-th point of a large map (points="sampled")."""
    points = 0 if subject.measured is None else subject.measured.solvable.points
    if points <= _POINTS:
        return Candidate(model.key, Choice(model.key))
    return Candidate(f"{model.key} (sampled)", Choice(model.key, options={"points": "sampled"}))


def _with_film(candidate: Candidate, model: RoughSurface) -> Candidate:
    if not model.asperity:
        return candidate  # solving it raises the error that it supports no films
    film = model.default_film or _SUITS_ALL
    return Candidate(f"{candidate.name} + {film}", replace(candidate.choice, film=film))


def _as_one(candidate: Candidate, model: RoughSurface, film: FilmLaw) -> Candidate:
    """Return the candidate combined with a film law that solves film and body as one elastic solid.

    The candidate keeps its tangential law if it suits the film law; otherwise it gets the equivalent law for layered bodies.
    """
    tangential = find(model.tangential, TangentialLaw) if model.tangential != "none" else None
    like = tangential.like if tangential is not None and friction_incompatibility(film, tangential) else ""
    choice = replace(candidate.choice, film=film.key, tangential=like or candidate.choice.tangential)
    return Candidate(f"{candidate.name} + {film.key}", choice)


def _alone(film: FilmLaw) -> Candidate:
    """Return a candidate that combines a film law with the asperity law of its source.

    Its rough-surface model is the model with the same tangential law as the film law, or else the Greenwood-Williamson sum.
    """
    model = next(
        (key for key, one in of_kind(RoughSurface).items() if one.asperity and one.tangential == film.tangential), _SUM
    )
    return Candidate(film.key, Choice(model, asperity=film.asperity or None, film=film.key))


def choice_of(name: str | None, given: Mapping[str, Any], subject: Subject) -> Choice:
    """Return the `Choice` that corresponds to a model name and keyword arguments of the user.

    name: the key of a rough-surface model, or a name that a comparison shows for this contact; None for the default model.
    given: keys of laws and values of options by keyword. subject: the contact. Raises InputError for an unknown name.
    """
    if name is None:
        return Choice.of(None, given)
    if not isinstance(name, str):
        raise InputError(RoughSurface.keyword, name, "the key of a model, e.g. greenwood_2006 (all: run `stiction models`)")
    try:
        return Choice.of(find(name, RoughSurface).key, given)
    except InputError as error:
        known = {candidate.name: candidate.choice for candidate in candidates(subject)}
        # A name may omit film or sum, because the asperity law alone identifies the candidate.
        known |= {key: Choice(_SUM, asperity=key) for key in of_kind(AsperityLaw)} if name not in known else {}
        if name not in known:
            if name == RECOMMENDED:
                raise InputError(error.field, name, "the name of a model; `stiction compare --all` lists them") from None
            similar = nearest(name, dict.fromkeys([*of_kind(RoughSurface), *known]))
            raise InputError(error.field, name, f"the key of a model, e.g. {similar} (all: run `stiction models`)") from None
    asked = Choice.of(name, given)
    return known[name].with_changes(asked.laws() | {"model": None}, asked.options)


def with_interface(choice: Choice, groups: Groups) -> Choice:
    """Return the choice with the interface law that uses the most of the specified interface properties.

    groups: dimensionless groups of the contact. The law is "none" if no shear strength is specified. The choice stays unchanged
    if it names a tangential law, or if the model has one.
    """
    if choice.tangential is not None or find(choice.model_key, RoughSurface).tangential != "none":
        return choice
    laws = [law for law in of_kind(TangentialLaw).values() if law.interfacial]
    known = [law for law in laws if all(groups.has(name) for name in law.needs)]
    return replace(choice, tangential=max(known, key=lambda law: len(law.needs)).key if known else "none")
