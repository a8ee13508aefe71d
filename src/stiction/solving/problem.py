"""Combine a model, contacts and a height distribution into a problem to be solved."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject, as_subject
from stiction.engine.blocks import blocks
from stiction.engine.heights import Heights, gaussian, height_distribution
from stiction.engine.own_separations import sums_of_each
from stiction.engine.regime import MENISCUS, Regime
from stiction.engine.starting_separations import Approach
from stiction.engine.summation import Scattered, check_threads, on_grid, totals_on_grid
from stiction.laws.joining import Law
from stiction.quantities.dimensions import coordinates
from stiction.quantities.errors import InputError
from stiction.quantities.quotient import quotient
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import JUNCTIONS, NO_JUNCTIONS, RoughSurface, TangentialLaw, find, select_options
from stiction.solving.candidates import with_interface
from stiction.solving.choice import DEFAULT_MODEL, Choice
from stiction.solving.chosen import resolve_laws
from stiction.solving.closed_form import ClosedFormProblem
from stiction.solving.laplace import bounded, most_pull, pull_and_bound
from stiction.solving.on_map import MapProblem
from stiction.solving.parts import share_beyond, share_without, states_of, sum_selected
from stiction.solving.problem_base import Problem, with_coefficient
from stiction.solving.unused import refuse_ignored_strength

_RESOLVED = 1e-6  # relative difference of computed and requested load that is accepted without a warning
_ROUNDING = 1e-14  # relative round-off error of the pull of menisci
_KEPT = 8  # number of cached problems of a contact, enough for a few models
_FEW = 16  # largest number of contacts of a cached problem; more take much memory, and more time to solve than to prepare
_COUNT, LOAD, _AREA, SLIP_LIMITED, _YIELD_LIMITED = range(5)  # in the order of summation.QUANTITIES


@dataclass(frozen=True)
class AsperitySum(Problem):
    """Represent contacts that are solved by a sum over asperities.

    The engine integrates the regimes (smooth parts) of the asperity law over the distribution of asperity heights.
    """

    @property
    def law(self) -> Law:
        return self.chosen.law

    @property
    def needs_load(self) -> bool:
        return False

    @property
    def adheres(self) -> bool:
        return "no adhesion" not in self.law.asperity.traits

    @cached_property
    def regimes(self) -> list[Regime]:
        """Return the regimes of the laws of the solids, followed by the regimes of additional laws such as menisci."""
        return [*self._solids(), *(regime for law in self.chosen.additions.values() for regime in law.regimes(self.groups))]

    def _solids(self) -> list[Regime]:
        record, film = self.record, self.chosen.film
        if record.regimes is not None:
            return record.regimes(self.groups, self.law, film, **select_options(record, self.options))
        if film is not None:
            return film.regimes(self.groups, self.law, **select_options(film, self.options))
        return self.law.regimes(self.groups)

    def on_branch(self, branch: str) -> "AsperitySum":
        if "branch" not in self.options or self.options["branch"] == branch:
            return self
        return self._on_other_branch

    @cached_property
    def _on_other_branch(self) -> "AsperitySum":
        branch = "unloading" if self.options["branch"] == "loading" else "loading"
        other = replace(self, chosen=self.chosen.with_option("branch", branch))
        try:
            return other if other.regimes else self
        except InputError:
            return self

    @cached_property
    def load_alone(self) -> "AsperitySum":
        """Return the problem without its tangential law, whose kinks would split the integrals for the load.

        If the model needs the tangential law, the problem itself is returned.
        """
        if self.chosen.tangential is None:
            return self
        alone = replace(self, chosen=replace(self.chosen, tangential=None))
        try:
            return alone if alone.regimes else self
        except InputError:
            return self

    @cached_property
    def approach(self) -> Approach:
        """Return the fast solver for the separations at given loads; it is valid for Gaussian heights only."""
        return Approach(self.load_alone.regimes)

    @cached_property
    def largest_tension(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the largest tension (n,) on approach, its separation (n,), and a mask (n,) of contacts with valid values.

        Heights are Gaussian. Tensions are per asperity and normalised, separations in units of sigma. The values are invalid
        where the pull of menisci reaches its upper bound, because this fast method neglects the bound, or where the searched
        separations do not cover the whole approach.
        """
        estimate, where, plain = self.approach.lowest
        tension, holds, adheres = np.zeros_like(estimate), plain.copy(), np.flatnonzero(estimate > 0.0)
        if adheres.size:
            sums = self.sums(where[adheres], adheres)
            tension[adheres] = -sums[..., LOAD].sum(axis=0)
            if self.most_pull is not None:
                pull, most = pull_and_bound(sums, self.regimes, self.most_pull[:, adheres])
                holds[adheres] &= pull < most * (1.0 - _ROUNDING)
        return tension, where, holds & (tension >= 0.0)

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        return np.concatenate([self.sums(h[some], law[some])[..., LOAD].sum(axis=0) for some in blocks(h.size)])

    def forces(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the slip-limited and yield-limited tangential force per asperity (2, k), normalised.

        h, law (k,): separations in units of sigma, and indices of the contacts.
        """
        return self.sums(h, law)[..., [SLIP_LIMITED, _YIELD_LIMITED]].sum(axis=0).T

    def sums_at(self, h: np.ndarray) -> np.ndarray:
        """Return the sums over asperities (regimes, n, m, 5) of n contacts at the separations h (n, m) in units of sigma.

        The five values, per asperity: fraction touching, load, area, slip-limited and yield-limited tangential force.
        """
        sums = sums_of_each(self._scattered, np.ascontiguousarray(h, dtype=float), self.threads)
        return sums if self.most_pull is None else bounded(sums, self.regimes, self.most_pull[..., None])

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        if self.most_pull is None:
            return totals_on_grid(self.regimes, h, self.heights, threads=self.threads)[:, 0]
        return self._on_grid(h)[..., LOAD].sum(axis=0)

    def _summed_alone(self, law: TangentialLaw, h: np.ndarray) -> np.ndarray:
        """Return the friction force per asperity (n, m) at the separations h (n, m), with `law` as the only tangential law."""
        plain = replace(self.chosen, additions={}, model=replace(self.record, regimes=None), tangential=law)
        return replace(self, chosen=plain).sums_at(h)[..., SLIP_LIMITED].sum(axis=0)

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        results = self._by_name(self._on_grid(h))
        if (published := self._as_published()) is not None:
            friction = totals_on_grid(published.regimes, h, self.heights, threads=self.threads)[:, 2]
            results |= _published(results["load"], friction)
        return self._with_additions(results, np.tile(h, (len(self.groups), 1)))

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        return self._at_sums(h, self.sums_at(h))

    def with_sums(self, h: np.ndarray, sums: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, m) by name at the separations h (n, m), from known sums over asperities (regimes, n, m, 5).

        Sums that are NaN are computed and filled in, in place.
        """
        law, at = np.nonzero(np.isnan(sums[0, ..., LOAD]))
        if law.size:
            sums[:, law, at] = self.sums(h[law, at], law)
        return self._at_sums(h, sums)

    def _at_sums(self, h: np.ndarray, sums: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, m) by name from the sums over asperities (regimes, n, m, 5) at the separations h (n, m)."""
        results = self._by_name(sums)
        if (published := self._as_published()) is not None:
            sums = published.sums_at(h).sum(axis=0)
            results |= _published(results["load"], sums[..., SLIP_LIMITED] + sums[..., _YIELD_LIMITED])
        return self._with_additions(results, h)

    @cached_property
    def most_pull(self) -> np.ndarray | None:
        """Return the factors (2, n) of `laplace.most_pull`, which limits the pull of menisci; None without menisci.

        The result is also None if the asperity density is unknown.
        """
        return most_pull(self.groups) if "meniscus" in self.chosen.additions else None

    def sums(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the sums over asperities (regimes, k, 5) for k pairs of a separation h, in units of sigma, and a contact.

        law (k,): indices of the contacts. The five values, per asperity: fraction touching, load, area, slip-limited and
        yield-limited tangential force. The pull of menisci is limited to its upper bound.
        """
        sums = self._scattered(h, law, self.threads)
        return sums if self.most_pull is None else bounded(sums, self.regimes, self.most_pull[:, law])

    @cached_property
    def _scattered(self) -> Scattered:
        return Scattered(self.regimes, self.heights)

    def _on_grid(self, h: np.ndarray) -> np.ndarray:
        """Return the sums over asperities (regimes, n, H, 5) at the separations h (H,) of all contacts, in units of sigma."""
        sums = np.moveaxis(on_grid(self.regimes, h, self.heights, self.threads), 2, -1)
        return sums if self.most_pull is None else bounded(sums, self.regimes, self.most_pull[..., None])

    def _as_published(self) -> "AsperitySum | None":
        """Return the problem with its tangential law as published; None if it already uses the published law.

        The option `plastic_junctions` can give yielded junctions the resistance of another law.
        """
        if self.options.get(JUNCTIONS, NO_JUNCTIONS) == NO_JUNCTIONS:
            return None
        return replace(self, chosen=self.chosen.with_option(JUNCTIONS, NO_JUNCTIONS))

    def _with_additions(self, results: dict[str, np.ndarray], h: np.ndarray) -> dict[str, np.ndarray]:
        for law in self.chosen.additions.values():
            results |= law.results(results, lambda law: self._summed_alone(law, h), number_of_asperities(self.groups))
        return results

    def _by_name(self, sums: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, m) by name from the sums over asperities (regimes, n, m, 5).

        Besides totals, the results include load and area by state (elastic, plastic, ...), and load and friction by body (film,
        substrate).
        """
        regimes, loads, areas = self.regimes, sums[..., LOAD], sums[..., _AREA]
        total = sums.sum(axis=0)
        results = {
            "load": total[..., LOAD],
            "contact_area": total[..., _AREA],
            "touching_asperities": sum_selected(sums[..., _COUNT], [regime.touching for regime in regimes]),
        }
        for state in states_of(regimes):
            chosen = [regime.state == state for regime in regimes]
            name = state.replace("-", "_")
            results[f"load_{name}"] = sum_selected(loads, chosen)
            results[f"contact_area_{name}"] = sum_selected(areas, chosen)
        if "meniscus" in self.chosen.additions:
            results["load_meniscus"] = sum_selected(loads, [regime.state == MENISCUS for regime in regimes])
        bodies = ("film", "substrate") if self.chosen.film is not None else ()
        for body in bodies:
            results[f"load_{body}"] = sum_selected(loads, [regime.body == body for regime in regimes])
        if bodies:
            film, substrate = (np.abs(results[f"load_{body}"]) for body in bodies)
            results["load_share_substrate"] = quotient(substrate, film + substrate, 0.0)
        if not all(regime.in_half_space for regime in regimes):
            results["load_share_beyond_film"] = share_beyond(regimes, loads)
        if not self.friction:
            return results
        friction = sums[..., SLIP_LIMITED] + sums[..., _YIELD_LIMITED]
        if not self.law.interfacial:
            solid = [index for index, regime in enumerate(regimes) if regime.state != MENISCUS]
            some = [regimes[index] for index in solid]
            results["load_share_without_friction"] = share_without(some, loads[solid], friction[solid])
        results |= with_coefficient(results["load"], friction.sum(axis=0))
        results["friction_slip_limited"] = total[..., SLIP_LIMITED]
        results["friction_yield_limited"] = total[..., _YIELD_LIMITED]
        for body in bodies:
            results[f"friction_{body}"] = sum_selected(friction, [regime.body == body for regime in regimes])
        if "load_share_beyond_film" in results:
            results["friction_share_beyond_film"] = share_beyond(regimes, friction)
        return results


def _wanted(name: str) -> str:
    """Return a text for error messages that states which values of a required quantity are allowed.

    If `name` is not a quantity but a part of a contact, the text names that part. A work of adhesion must be above 0.
    """
    if name not in QUANTITIES:
        return f"a {name}"
    quantity = QUANTITIES[name]
    return replace(quantity, lower_included=False).wanted if name == "work_of_adhesion" else quantity.wanted


def _others(model: str) -> str:
    """Return advice to name another model if `model` is the default model; "" for any other model.

    For errors about a missing input: the user may not know that the default model needs it.
    """
    if model != DEFAULT_MODEL:
        return ""
    return "or name a model that does not need it with --model: `stiction compare CASE.toml` shows them"


def with_requested_load(results: dict[str, np.ndarray], load: np.ndarray) -> dict[str, np.ndarray]:
    """Replace the computed load by the requested load, recompute the friction coefficient, and return all results.

    results: normalised arrays by name. load: requested loads. Where round-off makes the requested load unattainable, the
    computed load is kept. At a requested load of 0, the replacement prevents a friction coefficient based on a load of
    round-off size.
    """
    exact = results | {"load": np.where(lost_in_rounding(results["load"], load), results["load"], load)}
    return exact | with_coefficient(exact["load"], results["friction_force"]) if "friction_force" in results else exact


def lost_in_rounding(carried: np.ndarray, asked: np.ndarray) -> np.ndarray:
    """Return a mask of the requested loads that round-off makes unattainable.

    Such loads are small differences of large tension and compression. A load counts as unattainable if the computed load
    differs by more than 1e-6 of the requested load; a requested load of 0 never counts. carried, asked: computed and requested
    loads.
    """
    return (np.abs(carried - asked) > _RESOLVED * np.abs(asked)) & (asked != 0.0)


def _published(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """Return the friction coefficient of the published law as a dictionary with the key friction_coefficient_published."""
    return {"friction_coefficient_published": with_coefficient(load, friction)["friction_coefficient"]}


def with_surface_moments(subject: Subject, model: str) -> Subject:
    """Return the contact with the roughness numbers that a model needs.

    For a theory of the whole surface these are asperity numbers computed from the spectral moments of the surface. For other
    models the contact is returned unchanged.
    """
    return subject.with_surface_moments() if find(model, RoughSurface).takes_surface_moments else subject


def make_problem(subject: Subject, choice: Choice, heights: Heights | str | None = None, threads: int = 1) -> Problem:
    """Combine contacts, a model and a height distribution into a problem, and return it.

    subject: the contacts. choice: model, laws and options. threads: number of threads of the engine. heights: distribution or
    its name; None for the distribution of the contact. The last eight problems of a subject are cached if they are sums over
    asperities of at most 16 contacts without scans, because preparing such a problem takes longer than solving it. Raises
    InputError for values that the model does not support.
    """
    check_threads(threads)
    if not (heights is None or isinstance(heights, str | Heights)):
        raise InputError("heights", type(heights).__name__, "a height distribution or its name, e.g. gaussian")
    subject, asked = as_subject(subject), (choice, heights, threads)
    prepared: list[Any] = subject.prepared
    for earlier, problem in tuple(prepared):
        if earlier == asked:
            return problem
    problem = _prepared(subject, *asked)
    if isinstance(problem, AsperitySum) and len(problem.groups) <= _FEW and subject.measured is None:
        prepared.append((asked, problem))
        del prepared[:-_KEPT]
    return problem


def _prepared(subject: Subject, choice: Choice, heights: Heights | str | None, threads: int) -> Problem:
    """Return a new problem for the arguments of `make_problem`, without using the cache."""
    subject = with_surface_moments(subject, choice.model_key)
    own_heights = heights is None
    if heights is None:
        name, parameters = subject.heights
        heights = height_distribution(name, **parameters)  # type: ignore[arg-type]
    elif isinstance(heights, str):
        heights = height_distribution(heights)
    groups, dims = Groups.of(subject.unlabelled.indices())
    problem = problem_of(groups, choice, heights, subject)
    problem = replace(problem, dims=dims, coords=coordinates(subject.arrays()), threads=threads)
    if isinstance(problem, MapProblem) and not own_heights:
        raise InputError("heights", heights.key, f"no distribution, because {problem.record.key} uses the heights of the map")
    if isinstance(problem, ClosedFormProblem) and heights.key != "gaussian":
        raise InputError("heights", heights.key, f"gaussian, because {problem.record.key} supports no other distribution")
    refuse_ignored_strength(problem, choice)
    return problem


def number_of_asperities(groups: Groups) -> np.ndarray | None:
    """Return the number of asperities on the nominal area (n, 1), or None if unknown.

    The number is N A_n = N R sigma (A_n/sigma^2) (sigma/R), with asperity density N, nominal area A_n, asperity radius R
    and rms height sigma.
    """
    if groups.nominal_width is None or groups.sharpness is None or groups.roughness_parameter is None:
        return None
    return (groups.roughness_parameter * (groups.nominal_width * groups.sharpness) ** 2)[:, None]


def problem_of(groups: Groups, choice: Choice, heights: Heights | None = None, subject: Subject | None = None) -> Problem:
    """Build the problem of contacts given by dimensionless groups; its only dimension is "contact".

    heights: distribution; None for Gaussian heights. subject: the Contact or Indices of the user, or None. Raises InputError
    for a quantity that the laws need and the groups do not contain.
    """
    chosen = resolve_laws(with_interface(choice, groups), groups.has_film, groups)
    for record in chosen.records():
        for name in record.needs:
            if not groups.has(name):
                given = subject.given_as(name) if subject is not None else name
                whose = "" if record is chosen.model else f", which {chosen.model.key} uses here,"
                allowed = f"{_wanted(given)}, because {record.key}{whose} needs it"
                raise InputError(given, getattr(subject, given, None), allowed, _others(choice.model_key))
    kind: type[Problem] = (
        AsperitySum if chosen.asperity is not None else MapProblem if chosen.model.of_map is not None else ClosedFormProblem
    )
    for law in chosen.additions.values():
        groups = law.changed(groups)
    return kind(chosen, groups, heights or gaussian(), {"contact": len(groups)}, {}, subject)
