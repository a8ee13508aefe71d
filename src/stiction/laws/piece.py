"""A piece: one smooth part of an asperity's behaviour under normal load, before any tangential law is joined to it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from stiction.engine.compiled import formula

# "elastic" up to first yield, "plastic" where the mean pressure is the hardness, "elastic-plastic" between.
STATES = ("elastic", "elastic-plastic", "plastic")


@dataclass(frozen=True)
class NormalPiece:
    """One smooth part of one asperity's normal behaviour, for n parameter sets ("laws") at once.

    normal(u, *parameters) -> (displacement, its derivative by u, load, contact area) at the coordinate u;
    coordinate(displacement, *parameters) -> u is its inverse. Both are formulas (engine.compiled.formula) of scalars, in
    the units of docs/theory.md: displacement over sigma, load over K R^(1/2) sigma^(3/2), area over pi R sigma.

    parameters: arrays (n,), in the order that `normal` takes them.
    edges: array (n, m + 1) in u, from where the piece starts to where it ends, which may be infinite; edges between are kinks.
    state: one of STATES. lowest: no displacement of the piece is below this.
    """

    normal: Callable
    coordinate: Callable
    parameters: tuple[np.ndarray, ...]
    edges: np.ndarray
    state: str
    lowest: float = 0.0


@dataclass(frozen=True)
class TangentialResistance:
    """Tangential resistance of a piece: the force at which one asperity is sheared off.

    resistance(u, displacement, load, area, *parameters) -> (slip-limited, yield-limited) tangential force, one of which is zero
    wherever the other is not; in the unit of the load. parameters: arrays (n,).

    kinks: array (n, k), coordinates of the piece at which the resistance is not smooth, in any order (those outside the piece
    do not matter), or None. branch: as in Regime, coordinates at which it starts like a broken power; or None.
    """

    resistance: Callable
    parameters: tuple[np.ndarray, ...]
    kinks: np.ndarray | None = None
    branch: np.ndarray | None = None


@formula
def displaced(w, *row):
    """Return the coordinate of a piece that is written in its displacement."""
    return w


@formula
def root_of(w, *row):
    """Return the coordinate of a piece that is written in the square root of its displacement."""
    return math.sqrt(max(w, 0.0))


def edges_at(*places: np.ndarray | float) -> np.ndarray:
    """Return the edges (n, m) of a piece at m places, each an array (n,) or a number."""
    return np.stack(np.broadcast_arrays(*places), axis=1)


def from_curve(
    load: Callable,
    area: Callable,
    start: np.ndarray,
    end: np.ndarray | float = math.inf,
    *,
    parameters: tuple[np.ndarray, ...] = (),
    state: str = "elastic",
) -> NormalPiece:
    """Return a piece from load and contact area as plain functions of the displacement.

    Slower than a piece with formulas in a coordinate of its own, and sums are good to 1e-8: the coordinate is the square root
    of the displacement beyond `start`, which smooths curves that begin there like a half-integer power.

    Parameters
    ----------
    load, area : functions of (displacement, *parameters)
        Of numbers, smooth between `start` and `end`; `math`, `if`, `min` and `max` may be used.
    start : array (n,)
        Displacement at which the piece starts, over sigma.
    end : array (n,) or float
        Displacement at which it ends, over sigma; infinite for the last piece.
    parameters : arrays (n,)
        In the order in which both functions take them.
    state : str
        One of STATES.
    """
    normal, coordinate = _curve(load, area)
    edges = np.sqrt(edges_at(0.0, end - start))
    return NormalPiece(normal, coordinate, (start, *parameters), edges, state, lowest=float(np.min(start, initial=0.0)))


@cache
def _curve(load: Callable, area: Callable) -> tuple[Callable, Callable]:
    """Return formulas for two functions of the displacement.

    The same objects are returned for the same functions, so that kernels compile once.
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
