"""Describe a segment, one smooth part of an asperity's normal response, and the tangential resistance on it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from stiction.engine.compiled import formula

# "elastic" up to first yield, "plastic" where the mean pressure is the hardness, "elastic-plastic" between.
STATES = ("elastic", "elastic-plastic", "plastic")


@dataclass(frozen=True)
class NormalSegment:
    """Describe one smooth part of the normal response of an asperity, for n contacts at once.

    normal(u, *parameters) returns displacement, its derivative with respect to u, load and contact area at the coordinate u.
    coordinate(displacement, *parameters) returns u; it is the inverse of the displacement. Both are scalar formulas
    (engine.compiled.formula). Units: displacement in sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma, with the tip
    radius R, the standard deviation sigma of the heights and K = (4/3) E*.

    parameters: arrays (n,), in the order in which `normal` takes them. edges: array (n, m + 1) of coordinates: start, kinks,
    and end of the segment; the end may be infinite. state: one of STATES. lowest: lower bound of the displacement.
    """

    normal: Callable
    coordinate: Callable
    parameters: tuple[np.ndarray, ...]
    edges: np.ndarray
    state: str
    lowest: float = 0.0


@dataclass(frozen=True)
class TangentialResistance:
    """Describe the tangential force at which one asperity slides, along one segment and for n contacts at once.

    resistance(u, displacement, load, area, *parameters) returns the slip-limited and the yield-limited force, in the unit
    of the load. Sliding begins at the smaller force, and the other is returned as 0. parameters: arrays (n,). Because the
    engine sums both numbers over all asperities, they may also be other quantities of an asperity, such as a stiffness.

    kinks: array (n, k) of coordinates at which the force is not smooth, in any order, or None; coordinates outside the
    segment are ignored. branch: coordinates at which the force starts like a fractional power, as in `Regime`, or None.
    """

    resistance: Callable
    parameters: tuple[np.ndarray, ...]
    kinks: np.ndarray | None = None
    branch: np.ndarray | None = None


@formula
def displaced(w, *row):
    """Return w, for segments whose coordinate u is the displacement w itself; row is not used."""
    return w


@formula
def root_of(w, *row):
    """Return sqrt(w), for segments whose coordinate u is the square root of the displacement w.

    The result is 0 if w is negative. row is not used.
    """
    return math.sqrt(max(w, 0.0))


def edges_at(*places: np.ndarray | float) -> np.ndarray:
    """Return the edges (n, m) of n segments; each argument is one column: an array (n,) of coordinates or a number.

    At least one argument is an array.
    """
    return np.stack(np.broadcast_arrays(*places), axis=1)


def from_curve(
    load: Callable,
    area: Callable,
    start: np.ndarray,
    end: np.ndarray | float = math.inf,
    *,
    parameters: tuple[np.ndarray, ...] = (),
    state: str = "elastic",
) -> NormalSegment:
    """Return a segment made from two plain functions of displacement, load and contact area.

    It is slower than a segment with formulas in a suitable coordinate, and sums of it are accurate to 1e-8. Its coordinate
    is the square root of the displacement beyond `start`, so that curves that begin like a half-integer power become
    smooth.

    Parameters
    ----------
    load, area : functions of (displacement, *parameters)
        Load in units of K R^(1/2) sigma^(3/2) and contact area in units of pi R sigma, at a displacement in units of sigma.
        The functions take and return single numbers and must be smooth between `start` and `end`; they may use `math`,
        `if`, `min` and `max`.
    start : array (n,)
        Displacement at which the segment starts, in units of sigma.
    end : array (n,) or float
        Displacement at which the segment ends, in units of sigma; infinite for the last segment.
    parameters : arrays (n,)
        Parameters of both functions, in the order in which they take them.
    state : str
        One of STATES.

    Returns
    -------
    NormalSegment
        The segment, for n contacts.
    """
    normal, coordinate = _curve(load, area)
    edges = np.sqrt(edges_at(0.0, end - start))
    return NormalSegment(normal, coordinate, (start, *parameters), edges, state, lowest=float(np.min(start, initial=0.0)))


@cache
def _curve(load: Callable, area: Callable) -> tuple[Callable, Callable]:
    """Return the formulas `normal` and `coordinate` of a segment whose load and area are functions of the displacement w.

    normal(u, start, *parameters) returns w = start + u^2, dw/du, load and area. coordinate(w, start, *parameters) returns
    u = sqrt(w - start). The function is cached, so that the same `load` and `area` give the same formulas and kernels are
    compiled once.
    """
    load, area = formula(load), formula(area)

    @formula
    def normal(u, start, *parameters):
        w = start + u * u
        return w, 2.0 * u, load(w, *parameters), area(w, *parameters)

    @formula
    def coordinate(w, start, *parameters):
        return math.sqrt(max(w - start, 0.0))

    return normal, coordinate
