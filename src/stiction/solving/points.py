"""Compute normalised results at requested loads or separations.

`solve`, `slide`, `unload`, `compare` and all studies use these functions.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.subject import Subject
from stiction.engine.blocks import in_blocks
from stiction.engine.summation import FARTHEST
from stiction.quantities.dimensions import aligned, coordinate, coordinates, dimensions, from_series, values_along, variable
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.units import is_series
from stiction.solving.inversion import Inversion, Unreachable, solved_at
from stiction.solving.problem import Problem, with_requested_load


@dataclass(frozen=True)
class Points:
    """Store the loads or mean separations at which the contacts of a problem are solved.

    name: "load" or "mean_separation". value: the requested number or array with named dimensions, in the units of the
    contact. factors: by unit ("N", "m"), the number by which normalised values are multiplied. dims: dimensions of the
    results with their sizes, those of the contacts first. wanted: normalised values in the shape of dims. narrow: the same
    values, with length 1 along dimensions on which they do not depend.
    """

    problem: Problem
    name: str
    value: Any
    factors: Mapping[str, Any]
    dims: dict[str, int]
    wanted: np.ndarray
    narrow: np.ndarray

    @property
    def table(self) -> np.ndarray:
        """Return the requested normalised values (contacts, points)."""
        return self.wanted.reshape(len(self.problem.groups), -1)

    @property
    def coords(self) -> dict[str, Any]:
        """Return the coordinates of the contacts and of the requested points, by name."""
        return self.problem.coords | coordinates_of(self.value)

    def rows(self, rows: np.ndarray) -> "Points":
        """Return the points of the contacts with these indices; their only contact dimension is "contact"."""
        some = self.table[rows]
        problem = replace(self.problem.with_groups(rows), dims={"contact": len(rows)})
        return replace(self, problem=problem, wanted=some, narrow=some)


def points_of(problem: Problem, load: Any = None, separation: Any = None) -> Points:
    """Return the points at which results are requested, from either a load or a separation in the units of the contact.

    Raises InputError if both or neither are given, and for a separation if the model does not compute separations.
    """
    if (separation is None) == (load is None):
        given = InWords("both given") if load is not None else None
        raise InputError("separation and load", given, "exactly one of the two")
    if problem.needs_load and load is None:
        raise InputError(
            "separation", separation, f"a load instead, because {problem.record.key} does not compute a separation"
        )
    name, value = ("load", load) if separation is None else ("mean_separation", separation)
    value = requested_points(problem.subject, name, value)
    factors = problem.subject.scales().factors()
    dims = dimensions([value, *factors.values()], problem.dims)
    narrow = aligned(value, dims) / aligned(factors["N" if name == "load" else "m"], dims)
    return Points(problem, name, value, factors, dims, np.broadcast_to(narrow, tuple(dims.values())), narrow)


def normalised(value: Any, unit: Any, dims: Mapping[str, int]) -> np.ndarray:
    """Return a value divided by its unit, broadcast to the shape of these dimensions.

    value, unit: numbers or arrays with named dimensions. dims: names and sizes of the dimensions.
    """
    return np.broadcast_to(aligned(value, dims) / aligned(unit, dims), tuple(dims.values()))


def requested_points(subject: Subject, name: str, value: Any) -> Any:
    """Validate the requested separations or loads; return a number, or an array with named dimensions.

    subject: the contact. name: quantity of the value. A plain sequence becomes a Variable with one dimension, named
    after the quantity; its values are also the coordinate.
    """
    if is_series(value) and isinstance(subject, Contact):
        return from_series(value, name)
    read = subject.read(value, name)
    if not isinstance(read, np.ndarray):
        return read
    return variable((name,), values_along(name, read) if isinstance(subject, Contact) else read)


def coordinates_of(*values: Any) -> dict[str, Any]:
    """Return the coordinates of arrays with named dimensions, by name; load and mean_separation only if they are dimensions.

    The values of a one-dimensional Variable are the coordinate of its dimension.
    """
    named = coordinates((str(value.name or ""), value) for value in values if hasattr(value, "coords"))
    rows = [value for value in values if hasattr(value, "dims") and not hasattr(value, "coords")]
    named |= {value.dims[0]: coordinate(value.dims[0], value.values) for value in rows}
    results = ("load", "mean_separation")
    return {name: variable for name, variable in named.items() if name not in results or variable.dims == (name,)}


@dataclass(frozen=True)
class Solved:
    """Store normalised results at points.

    tables: arrays by name, in the shape of the points. found: for requested loads, the `Inversion` with the separations.
    carried: loads computed at these separations. Both are None for requested separations, and for models that compute no
    separations.
    """

    tables: dict[str, np.ndarray]
    found: Inversion | None = None
    carried: np.ndarray | None = None


def solve_points(points: Points, refuse: bool = True) -> Solved:
    """Solve a problem at the requested loads or separations, and return the normalised results.

    A load that cannot be carried raises Unreachable. With refuse=False the separation of such a load is NaN, and the results
    are those at separation 0. Raises InputError for loads or separations that the model does not support.
    """
    problem, wanted = points.problem, points.wanted
    if points.name == "mean_separation":
        check_reach(wanted)
        return Solved({"mean_separation": wanted} | _summed(points))
    if problem.needs_load:
        return Solved({name: table.reshape(wanted.shape) for name, table in _at_loads(points).items()})
    found, results = solved_at(problem, points.table, refuse)
    results = {name: table.reshape(wanted.shape) for name, table in results.items()}
    return Solved(
        {"mean_separation": found.h.reshape(wanted.shape)} | with_requested_load(results, wanted), found, results["load"]
    )


def check_reach(separation: np.ndarray, name: str = "separation") -> None:
    """Raise InputError for separations, in units of sigma, whose magnitude exceeds the largest value that can be computed.

    name: field named in the error message.
    """
    farthest = float(np.abs(separation).max(initial=0.0))
    if not farthest <= FARTHEST:
        raise InputError(name, InWords(f"{farthest:.4g} sigma"), f"at most {FARTHEST:g} sigma")


@contextmanager
def in_words(points: Points) -> Iterator[None]:
    """Convert the exception Unreachable, raised inside a with-block, to an InputError that states which loads can be carried.

    points: the requested points, which also give the units in which loads are shown.
    """
    try:
        yield
    except Unreachable as error:
        target = points.table[error.law, error.at]
        unit = np.broadcast_to(aligned(points.factors["N"], points.dims), points.wanted.shape)
        scale = unit.reshape(points.table.shape)[error.law, error.at]

        def text(load: float) -> str:
            return points.problem.subject.show(load * scale, "load")

        if target <= error.high:
            bound = f"at least {text(error.low)}" if error.low else f"> {text(0.0)}"
        elif error.high >= 0.0:
            bound = f"at most {text(error.high)}"
            if points.problem.needs_load is False and points.problem.heights.listed.size:
                bound += f" (pressed {FARTHEST:g} standard deviations below the mean of the listed heights)"
        else:
            bound = f"at most {text(error.high)} (separations up to {FARTHEST:g} sigma were tried)"
        raise InputError("load", text(target), f"{bound} under this model, for this contact") from None


def _at_loads(points: Points) -> dict[str, np.ndarray]:
    """Return the results (contacts, points) by name of a model that computes no separations.

    Raises InputError for a tensile load if the model neglects adhesion.
    """
    problem = points.problem
    if (points.wanted < 0.0).any() and not problem.adheres:
        least = float(np.min(points.value))
        allowed = f"0 or more, because {problem.record.key} neglects adhesion"
        raise InputError("load", problem.subject.show(least, "load"), allowed)
    return problem.at_load(points.table)


def _summed(points: Points) -> dict[str, np.ndarray]:
    """Return the results at the requested separations, by name, in the shape of the points.

    If all contacts have the same separations, the faster sums on a grid are used.
    """
    problem, shape = points.problem, points.wanted.shape
    contacts, own = len(problem.groups), len(problem.shape)
    per_contact = points.table.shape[1]
    if all(length == 1 for length in points.narrow.shape[:own]):
        grid = np.broadcast_to(points.narrow, (1,) * own + shape[own:]).reshape(-1)
        tables = in_blocks(lambda rows: problem.with_groups(rows).on_grid(grid), contacts, per_contact)
    else:
        tables = in_blocks(lambda rows: problem.with_groups(rows).at(points.table[rows]), contacts, per_contact)
    return {name: table.reshape(shape) for name, table in tables.items()}
