"""Many contacts at once, of which some may be refused or carry less than is asked: not a number there, and why as data."""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from stiction.contact.subject import Subject
from stiction.laws.claims import Validity
from stiction.quantities.dimensions import aligned
from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice
from stiction.solving.conditions import rules_left, rules_of
from stiction.solving.inversion import Inversion, pull_off, solved_at
from stiction.solving.problem import Problem, as_asked, lost_in_rounding, make_problem
from stiction.solving.results import as_variables, summary_of, with_shares
from stiction.solving.solve import all_dims, convergence, points_asked, pull_off_variables, summed

__all__ = ["NOT_COMPUTED", "WHY_NOT", "Pointwise", "Region", "bisected", "solve_pointwise"]

T = TypeVar("T")
# Some of many contacts: dimension -> slice.
Region = dict[str, slice]

# The first doubts of every point: bit 0 to 2. What is refused or not carried has no results.
WHY_NOT = (
    "the contact is refused: a number of it is out of bounds, or the model does not converge",
    "the load is nowhere carried",
    "the load is lost in the rounding of the adhesion and pressure that it is the difference of",
)
_REFUSED, _NOT_CARRIED, _LOST = range(3)
# The last bit: nothing is known of a point yet.
NOT_COMPUTED = np.uint32(1 << 31)


@dataclass(frozen=True)
class Pointwise:
    """Results of many contacts.

    variables: name -> dimensions, values in the units of the contact, attributes. doubts: the dimensions, and bits (uint32):
    the first are WHY_NOT, then one for each of the rules. subject: the contacts as the model takes them; attributes:
    what was used, as `solve` says it, where all results are kept.
    """

    variables: dict[str, tuple]
    doubts: tuple[tuple[str, ...], np.ndarray]
    rules: list[Validity]
    subject: Subject
    attributes: dict[str, str]


def solve_pointwise(
    subject: Subject, choice: Choice, *, separation: Any = None, load: Any = None, keep: Collection[str] | None = None
) -> Pointwise:
    """What `solve` gives, point by point, without a dataset; keep: names of results, by default all.

    Where `solve` refuses a load that is nowhere carried, there it is not a number, and so are the results of contacts that the
    model refuses or does not converge for, unless it is all of them. Raises InputError for what is refused of the contacts as a
    whole, ArithmeticError where no contact converges.
    """
    problem = make_problem(subject, choice)
    given = "load" if separation is None else "mean_separation"
    if problem.needs_load and load is None:
        raise InputError("separation", separation, f"a load in its place: {problem.record.key} knows no separation")
    point = points_asked(problem.subject, given, load if separation is None else separation)
    factors = problem.subject.scales().factors()
    dims = all_dims(problem, [point, *factors.values()])
    unit = aligned(factors["N" if given == "load" else "m"], dims)
    wanted = np.broadcast_to(aligned(point, dims) / unit, tuple(dims.values()))
    tables, why_not, found = _tables(problem, given, wanted, aligned(point, dims) / unit)
    tables = with_shares(problem, tables)
    kept = {name: table for name, table in tables.items() if keep is None or name in keep}
    variables = as_variables(problem.subject, kept, factors, dims)
    if found is not None and (keep is None or "load_residual" in keep):
        variables |= convergence(found, dims)
    if "mean_separation" in tables and (keep is None or {"pull_off_force", "pull_off_separation"} & set(keep)):
        variables |= _pull_off(problem, factors, found, np.all(why_not & (1 << _REFUSED), axis=1))
    doubts = why_not.astype(np.uint32)
    for bit, left in enumerate(rules_left(problem, tables), start=len(WHY_NOT)):
        doubts |= left.astype(np.uint32) << np.uint32(bit)
    doubts = np.where(why_not & (1 << _REFUSED), np.uint32(1 << _REFUSED), doubts).reshape(wanted.shape)
    attributes = summary_of(problem.subject, problem, tables) if keep is None else {}
    return Pointwise(variables, (tuple(dims), doubts), rules_of(problem), problem.subject, attributes)


def _tables(problem: Problem, given: str, wanted: np.ndarray, unbroadcast: np.ndarray) -> tuple[dict, np.ndarray, Any]:
    """Normalised results of the full shape, bits of WHY_NOT (contacts, points), and the inversion, if there was one."""
    try:
        return _together(problem, given, wanted, unbroadcast)
    except (InputError, ArithmeticError):
        if len(problem.groups) == 1:
            raise
    return _in_parts(problem, given, wanted)


def _in_parts(problem: Problem, given: str, wanted: np.ndarray) -> tuple[dict, np.ndarray, Any]:
    """The same of contacts of which some are refused: not a number there. Raises what the last one is refused for if it is all
    of them."""
    contacts = len(problem.groups)
    points = wanted.reshape(contacts, -1)
    found: dict[str, np.ndarray] = {}
    why_not, inverted = np.full(points.shape, 1 << _REFUSED, dtype=np.uint32), _no_inversion(points.shape)
    for rows, (tables, why, inversion) in _parts(problem, given, points):
        for name, table in tables.items():
            found.setdefault(name, np.full(points.shape, np.nan))[rows] = table.reshape(len(rows), -1)
        why_not[rows] = why
        for name in ("h", "residual", "tension", "where") if inversion is not None else ():
            getattr(inverted, name)[rows] = getattr(inversion, name)
        inverted = inverted if inversion is None else replace(inverted, evaluations=inversion.evaluations)
    return {name: table.reshape(wanted.shape) for name, table in found.items()}, why_not, (
        inverted if given == "load" and not problem.needs_load else None
    )  # fmt: skip


def _parts(problem: Problem, given: str, points: np.ndarray) -> Iterator[tuple[np.ndarray, tuple]]:
    """Rows that the model takes, with what `_together` says of them. Raises the last refusal if it takes none."""
    taken, refusal, every = False, None, np.arange(len(points))

    def solved(region: Region) -> tuple:
        rows = every[region["contact"]]
        some = replace(problem.with_groups(rows), dims={"contact": len(rows)})
        return _together(some, given, points[rows], points[rows])

    for region, found in bisected({"contact": slice(0, len(points))}, solved):
        if isinstance(found, Exception):
            refusal = found
            continue
        taken = True
        yield every[region["contact"]], found
    if refusal is not None and not taken:
        raise refusal


def bisected(region: Region, solve: Callable[[Region], T]) -> Iterator[tuple[Region, T | Exception]]:
    """Yield (part, result) for a region of contacts. A part that raises is bisected along its longest dimension; a single
    refused contact yields its InputError or ArithmeticError."""
    waiting = [region]
    while waiting:
        part = waiting.pop()
        try:
            found: T | Exception = solve(part)
        except (InputError, ArithmeticError) as error:
            halves = _halves(part)
            waiting += halves
            if halves:
                continue
            found = error
        yield part, found


def _halves(region: Region) -> list[Region]:
    """The two halves along the longest dimension, the second one first; none of a single contact."""
    dim = max(region, key=lambda name: region[name].stop - region[name].start, default="")
    if not dim or region[dim].stop - region[dim].start == 1:
        return []
    middle = (region[dim].start + region[dim].stop) // 2
    return [region | {dim: slice(middle, region[dim].stop)}, region | {dim: slice(region[dim].start, middle)}]


def _no_inversion(shape: tuple[int, ...]) -> Inversion:
    h, tension = np.full(shape, np.nan), np.full(shape[:1], np.nan)
    return Inversion(h, h.copy(), 0, tension, tension.copy())


def _pull_off(problem: Problem, factors: Mapping[str, Any], found: Inversion | None, refused: Any) -> dict[str, tuple]:
    """The largest tension of each contact, and where it is; not a number of those that are refused (contacts,)."""
    apart = problem.on_branch("unloading")
    if not refused.any() or (found is not None and apart is problem):
        return pull_off_variables(problem, factors, found)
    of_each, taken = _no_inversion((len(refused), 0)), np.flatnonzero(~refused)
    of_each.tension[taken], of_each.where[taken] = pull_off(apart.with_groups(taken))
    return pull_off_variables(apart, factors, of_each)


def _together(problem: Problem, given: str, wanted: np.ndarray, unbroadcast: np.ndarray) -> tuple[dict, np.ndarray, Any]:
    """The same of contacts that are all taken."""
    contacts = len(problem.groups)
    if given == "mean_separation":
        why_not = np.zeros((contacts, wanted.size // contacts), dtype=np.uint32)
        return {"mean_separation": wanted} | summed(problem, unbroadcast, wanted.shape), why_not, None
    targets = wanted.reshape(contacts, -1)
    if problem.needs_load:
        lost = targets < 0.0
        tables = problem.at_load(np.where(lost, 0.0, targets))
        return _without({n: t.reshape(wanted.shape) for n, t in tables.items()}, lost), lost << _NOT_CARRIED, None
    found, at_loads = solved_at(problem, targets, refuse=False)
    lost = np.isnan(found.h)
    h = np.where(lost, 0.0, found.h).reshape(wanted.shape)
    results = {name: table.reshape(wanted.shape) for name, table in at_loads.items()}
    rounded = lost_in_rounding(results["load"], wanted).reshape(targets.shape) & ~lost
    tables = {"mean_separation": h} | as_asked(results, wanted)
    return _without(tables, lost), (lost << _NOT_CARRIED) | (rounded << _LOST), found


def _without(tables: Mapping[str, np.ndarray], lost: np.ndarray) -> dict[str, np.ndarray]:
    """The tables with not a number at the points (contacts, points) that are lost; the load asked for stays."""
    if not lost.any():
        return dict(tables)
    return {
        name: np.where(lost.reshape(table.shape), np.nan, table) if name != "load" else table for name, table in tables.items()
    }
