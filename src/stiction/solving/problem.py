"""A model, its contacts and its heights, ready to be summed: what every way of solving starts from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from stiction.contact.contact import Contact, Indices
from stiction.contact.groups import Groups
from stiction.engine.heights import Heights, gaussian, height_distribution
from stiction.engine.summation import on_grid, scattered, totals_on_grid
from stiction.laws.joining import Law, resistances
from stiction.laws.registry import (
    CHOICES,
    AsperityLaw,
    FilmLaw,
    Presliding,
    Record,
    RoughSurface,
    find,
    friction_incompatibility,
    incompatibility,
    resolve_options,
    select_options,
)
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.solving.choice import Choice

_AT_ONCE = 500_000  # pairs of a law and a separation; bounds the memory of the sums by regime
_COUNT, _LOAD, _AREA, _SLIP_LIMITED, _YIELD_LIMITED = range(5)  # as summation.QUANTITIES
# A group that a law needs -> what a Contact calls it.
_GIVEN_AS = {"shear_strength": "interfacial_shear_strength", "hardening": "tangent_modulus"}


@dataclass(frozen=True)
class Problem:
    """n contacts under one model.

    subject: the Contact or Indices, as_taken by the model; None where only groups were given. groups: their dimensionless
    groups, flat. dims: named dimensions of the contacts, name -> size; n is the product. coords: what the dimensions' points
    are called.
    """

    record: RoughSurface
    law: Law
    film: FilmLaw | None
    options: Mapping[str, str]
    groups: Groups
    heights: Heights
    dims: dict[str, int]
    coords: dict[str, Any]
    presliding: Presliding | None = None
    subject: Any = None

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(self.dims.values())

    @property
    def friction(self) -> bool:
        """Whether there is a tangential law."""
        return self.law.tangential is not None

    @property
    def adheres(self) -> bool:
        """Whether asperities attract."""
        return "no adhesion" not in self.law.asperity.traits

    @cached_property
    def regimes(self) -> list:
        if self.record.regimes is not None:
            return self.record.regimes(self.groups, self.law, self.film, **select_options(self.record, self.options))
        if self.film is not None:
            return self.film.regimes(self.groups, self.law, **select_options(self.film, self.options))
        return self.law.regimes(self.groups)

    def records(self) -> list[Record]:
        """The records of all that answers."""
        asperity = None if self.film is not None and self.film.own_asperity else self.law.asperity
        laws = self.record, asperity, self.law.tangential, self.film, self.presliding
        return [one for one in laws if one is not None]

    def with_groups(self, rows: slice) -> "Problem":
        """The same for some of the contacts."""
        return replace(self, groups=self.groups[rows])

    def on_branch(self, branch: str) -> "Problem":
        """The same problem on another branch, if it has that for this contact; otherwise itself."""
        if "branch" not in self.options:
            return self
        options = {**self.options, "branch": branch}
        other = replace(self, options=options, law=replace(self.law, options=options))
        try:
            return other if other.regimes else self
        except InputError:
            return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Net load per asperity at pairs of separation and law."""
        pieces = range(0, h.size, _AT_ONCE)
        parts = [
            scattered(self.regimes, h[at : at + _AT_ONCE], self.heights, law[at : at + _AT_ONCE])[..., _LOAD].sum(axis=0)
            for at in pieces
        ]
        return np.concatenate(parts) if parts else np.empty(0)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Net load per asperity (n, H) at separations that all laws share."""
        return totals_on_grid(self.regimes, h, self.heights)[:, 0]

    def stiffness(self, h: np.ndarray) -> np.ndarray:
        """Tangential stiffness per asperity (n, m) at the separations h (n, m), before anything slides."""
        presliding = self.presliding
        assert presliding is not None
        if self.film is not None:
            raise InputError("presliding", presliding.key, "nothing: how film and substrate share it is not known")
        law = replace(self.law, tangential=presliding)
        other = replace(self, law=law, record=replace(self.record, regimes=None))
        rows = np.repeat(np.arange(len(h)), h.shape[1])
        return scattered(other.regimes, h.reshape(-1), self.heights, rows)[..., _SLIP_LIMITED].sum(axis=0).reshape(h.shape)

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, H), normalised, at separations that all laws share."""
        results = self._by_name(np.moveaxis(on_grid(self.regimes, h, self.heights), 2, -1))
        return self._with_stiffness(results, np.tile(h, (len(self.groups), 1)))

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, m), normalised, at the separations h (n, m)."""
        law = np.repeat(np.arange(len(h)), h.shape[1])
        sums = scattered(self.regimes, h.reshape(-1), self.heights, law).reshape(len(self.regimes), *h.shape, 5)
        return self._with_stiffness(self._by_name(sums), h)

    def _with_stiffness(self, results: dict[str, np.ndarray], h: np.ndarray) -> dict[str, np.ndarray]:
        return results if self.presliding is None else results | {"tangential_stiffness": self.stiffness(h)}

    def _by_name(self, sums: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, m) from the sums (regimes, n, m, 5) by what the regimes are labelled."""
        regimes = self.regimes
        total = sums.sum(axis=0)
        results = {
            "load": total[..., _LOAD],
            "contact_area": total[..., _AREA],
            "touching_asperities": sums[[regime.touching for regime in regimes], ..., _COUNT].sum(axis=0),
        }
        for state in _states(regimes):
            chosen = [regime.state == state for regime in regimes]
            name = state.replace("-", "_")
            results[f"load_{name}"] = sums[chosen, ..., _LOAD].sum(axis=0)
            results[f"contact_area_{name}"] = sums[chosen, ..., _AREA].sum(axis=0)
        bodies = ("film", "substrate") if self.film is not None else ()
        for body in bodies:
            results[f"load_{body}"] = sums[[regime.body == body for regime in regimes], ..., _LOAD].sum(axis=0)
        if not all(regime.in_half_space for regime in regimes):
            results["load_share_beyond_film"] = _share_beyond(regimes, sums[..., _LOAD])
        if not self.friction:
            return results
        tangential_resistance = sums[..., _SLIP_LIMITED] + sums[..., _YIELD_LIMITED]
        results |= with_coefficient(results["load"], tangential_resistance.sum(axis=0))
        results["friction_slip_limited"] = total[..., _SLIP_LIMITED]
        results["friction_yield_limited"] = total[..., _YIELD_LIMITED]
        for body in bodies:
            results[f"friction_{body}"] = tangential_resistance[[regime.body == body for regime in regimes]].sum(axis=0)
        if "load_share_beyond_film" in results:
            results["friction_share_beyond_film"] = _share_beyond(regimes, tangential_resistance)
        return results


@dataclass(frozen=True)
class ClosedForm(Problem):
    """n contacts under a theory that is no sum over asperity laws; friction, if any, is of the interface."""

    regimes = ()  # type: ignore[assignment]

    @property
    def needs_load(self) -> bool:
        """Whether the theory knows the load only, and no separation."""
        return self.record.curve is None

    @property
    def adheres(self) -> bool:
        return False

    def records(self) -> list[Record]:
        return [self.record] + ([self.law.tangential] if self.law.tangential is not None else [])

    def on_branch(self, branch: str) -> "Problem":
        return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        result = np.empty(h.size)
        for one in np.unique(law):
            chosen = law == one
            result[chosen] = self._curve(h[chosen], self.groups[one : one + 1])[0][0]
        return result

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        return self._curve(h, self.groups)[0]

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        return self._results(*self._curve(h, self.groups))

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        rows = [self._curve(one, self.groups[i : i + 1]) for i, one in enumerate(h)]
        return self._results(*(np.concatenate(parts) for parts in zip(*rows, strict=True)))

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, m) at normalised loads (n, m), of a theory that knows no separation."""
        assert self.record.area_at_load is not None
        if not (load >= 0.0).all():
            raise InputError("load", float(load.min()), f">= 0: {self.record.key} knows no adhesion")
        return self._results(load, self.record.area_at_load(load, self.groups, **select_options(self.record, self.options)))

    def _curve(self, h, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
        if self.record.curve is None:
            raise InputError("separation", None, f"a load: {self.record.key} knows no separation")
        return self.record.curve(h, groups, **select_options(self.record, self.options))

    def _results(self, load: np.ndarray, area: np.ndarray) -> dict[str, np.ndarray]:
        results = {"load": load, "contact_area": area}
        if self.law.tangential is None:
            return results
        return results | with_coefficient(load, resistances(self.law.tangential, self.groups, load, area))


def with_coefficient(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """The friction force, and its ratio to the load: not a number where the load is not compressive."""
    ratio = np.divide(friction, load, where=load > 0.0, out=np.full(load.shape, np.nan))
    return {"friction_force": friction, "friction_coefficient": ratio}


def as_asked(results: dict[str, np.ndarray], load: np.ndarray) -> dict[str, np.ndarray]:
    """Normalised results at the loads that were asked for: these are the load, and what friction is compared to. What the
    search for a separation leaves of no load makes no friction coefficient."""
    exact = results | {"load": load}
    return exact | with_coefficient(load, results["friction_force"]) if "friction_force" in results else exact


def _states(regimes) -> list[str]:
    """Elastic and plastic, and whatever else there is."""
    return list(dict.fromkeys(["elastic", "plastic", *(one.state for one in regimes if one.state == "elastic-plastic")]))


def _share_beyond(regimes: list, parts: np.ndarray) -> np.ndarray:
    """Share (n, m) of the sizes of `parts` (regimes, n, m) that is beyond the film's half-space; 0 where all is nothing."""
    sizes = np.abs(parts)
    whole = sizes.sum(axis=0)
    beyond = sizes[[not regime.in_half_space for regime in regimes]].sum(axis=0)
    return np.divide(beyond, whole, where=whole > 0.0, out=np.zeros_like(whole))


def with_surface_moments(subject: Contact | Indices, model: str) -> Contact | Indices:
    """What was given, as the model of this key takes it: a theory of the whole surface, with the asperities of its moments."""
    return subject.with_surface_moments() if isinstance(subject, Contact) and takes_surface_moments(model) else subject


def takes_surface_moments(model: str) -> bool:
    """Whether the model of this key is a theory of the whole surface."""
    return _record(Choice(model)).takes_surface_moments


def make_problem(subject: Contact | Indices, choice: Choice, heights: Heights | str | None = None) -> Problem:
    """The problem of this contact under this model. Raises InputError for what the model does not know or refuses."""
    subject = with_surface_moments(subject, choice.model)
    if isinstance(subject, Contact):
        indices = subject.indices()
        roughness = subject.roughness
        given = height_distribution(roughness.height_distribution, **roughness.height_parameters)
    elif isinstance(subject, Indices):
        indices, given = subject, gaussian()
    else:
        raise InputError("contact", type(subject).__name__, "a stiction.Contact or stiction.Indices")
    if heights is not None:
        given = height_distribution(heights) if isinstance(heights, str) else heights
    groups, dims, coords = _flatten(indices.resolved())
    problem = problem_of(groups, choice, given, isinstance(subject, Contact))
    problem = replace(problem, dims=dims, coords=coords, subject=subject)
    if isinstance(problem, ClosedForm) and given.key != "gaussian":
        raise InputError("heights", given.key, f"gaussian: {problem.record.key} knows no other heights")
    return problem


def problem_of(groups: Groups, choice: Choice, heights: Heights | None = None, of_contact: bool = False) -> Problem:
    """The problem of these groups, with one dimension, "contact". of_contact: a user gave a Contact, not its groups."""
    kind, law, film, options = _choose(choice, groups.coated)
    presliding: Any = find(choice.presliding, "presliding") if choice.presliding else None
    dims = {"contact": len(groups)}
    problem = kind(_record(choice), law, film, options, groups, heights or gaussian(), dims, {}, presliding)
    _refuse_missing(problem, of_contact)
    return problem


def _record(choice: Choice) -> RoughSurface:
    record = find(choice.model, "rough surface")
    assert isinstance(record, RoughSurface)
    return record


def _choose(choice: Choice, coated: bool) -> tuple[type[Problem], Law, FilmLaw | None, dict[str, str]]:
    """The laws that are to answer, with their options; InputError, with the reason, where they do not suit each other."""
    record = _record(choice)
    tangential: Any = _tangential(choice.tangential or record.tangential)
    if not record.asperity:
        _refuse_parts(choice, record, tangential, coated)
        options = resolve_options([one for one in (record, tangential) if one is not None], choice.options)
        return ClosedForm, Law(_NO_ASPERITY, tangential, options), None, options
    asperity: Any = find(choice.asperity or record.asperity, "asperity")
    film = _film(choice, record) if coated else None
    for one in (tangential, film):
        if one is not None and (reason := incompatibility(one, asperity)):
            field, value = ("asperity", asperity.key) if choice.asperity else (CHOICES[one.kind], one.key)
            raise InputError(field, value, f"laws that go together: {reason}")
    if film is not None and (reason := friction_incompatibility(film, tangential)):
        raise InputError("tangential", tangential.key, f"laws that go together: {reason}")
    known = [one for one in (record, asperity, tangential, film) if one is not None]
    options = resolve_options(known, choice.options)
    return Problem, Law(asperity, tangential, options), film, options


def _tangential(key: str) -> Any:
    return None if key == "none" else find(key, "tangential")


def _film(choice: Choice, record: RoughSurface) -> Any:
    brought = [key for value, key in record.film_by_option.items() if value in choice.options.values()]
    if brought:
        if choice.coating_law not in (None, *brought):
            raise InputError("coating_law", choice.coating_law, f"{brought[0]}, with these options of {record.key}")
        return find(brought[0], "film")
    key = choice.coating_law or record.default_film
    if not key:
        raise InputError("model", record.key, "a model that knows films, or a coating_law beside it; this contact has a film")
    film = find(key, "film")
    if not film.interchangeable:  # type: ignore[attr-defined]
        raise InputError("coating_law", key, "another film law; this one belongs to one reading of its model")
    return film


# Stands where a theory has no asperities.
_NO_ASPERITY = AsperityLaw(key="none", title="No asperities", grade="A", sources=(), pieces=list, verified="nothing to verify")


def _refuse_parts(choice: Choice, record: RoughSurface, tangential: Any, coated: bool) -> None:
    """Refuse what a theory in closed form cannot be combined with."""
    if coated:
        raise InputError("model", record.key, "a model of asperities; this contact has a film")
    if choice.asperity:
        raise InputError("asperity", choice.asperity, f"nothing: {record.key} is not a sum over asperity laws")
    if choice.presliding:
        raise InputError("presliding", choice.presliding, f"nothing: {record.key} knows no single asperities")
    if tangential is not None and not tangential.interfacial:
        raise InputError("tangential", tangential.key, f"a law of the interface: {record.key} knows no single asperities")


def _refuse_missing(problem: Problem, is_contact: bool) -> None:
    for record in problem.records():
        for name in record.needs:
            if getattr(problem.groups, name) is None:
                given = _GIVEN_AS.get(name, name) if is_contact else name
                raise InputError(given, None, f"{QUANTITIES[given].wanted}: {record.key} needs it")


def _flatten(indices: Indices) -> tuple[Groups, dict[str, int], dict[str, Any]]:
    """Flat groups of all combinations of the named dimensions, and those dimensions."""
    values = {name: getattr(indices, name) for name in (one.name for one in fields(Groups))}
    if not indices.has_film:
        values |= {"n_g": None, "film_aspect": None}
    elif indices.film_aspect is None:
        values["film_aspect"] = math.inf
    labelled = {name: value for name, value in values.items() if hasattr(value, "dims")}
    dims: dict[str, int] = {}
    coords: dict[str, Any] = {}
    for value in labelled.values():
        dims |= {str(dim): size for dim, size in value.sizes.items()}
        coords |= {str(name): coordinate.variable for name, coordinate in value.coords.items()}
    shape = tuple(dims.values())
    flat: dict[str, np.ndarray | None] = {}
    for name, value in values.items():
        flat[name] = None if value is None else np.broadcast_to(spread(value, dims), shape).reshape(-1).astype(float)
    return Groups(**flat), dims, coords  # type: ignore[arg-type]


def spread(value: Any, dims: Mapping[str, int]) -> np.ndarray:
    """The value with its named dimensions in the order of `dims`, ready to broadcast; the missing ones have length 1."""
    if not hasattr(value, "dims"):
        return np.asarray(value, dtype=float)
    ordered = value.transpose(*(dim for dim in dims if dim in value.dims))
    return ordered.values.reshape([value.sizes.get(dim, 1) for dim in dims])
