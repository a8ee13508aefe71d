"""A piece: one smooth part of an asperity's behaviour under normal load, before any tangential law is joined to it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

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
    """What a tangential law adds to a piece: the force at which one asperity is sheared off.

    resistance(u, displacement, load, area, *parameters) -> (slip-limited, yield-limited) tangential force, one of which is
    zero wherever the other is not; in the unit of the load. parameters: arrays (n,).
    kinks: array (n, k), coordinates of the piece at which the resistance is not smooth, in any order (those outside the
    piece do not matter), or None. branch: as in Regime, coordinates at which it starts like a broken power; or None.
    """

    resistance: Callable
    parameters: tuple[np.ndarray, ...]
    kinks: np.ndarray | None = None
    branch: np.ndarray | None = None
