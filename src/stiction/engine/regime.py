"""A regime: one smooth piece of an asperity's behaviour, as data for the summation engine."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

# The state of a regime that is no solid: what it pulls with is counted by itself.
MENISCUS = "meniscus"


@dataclass(frozen=True)
class Regime:
    """One smooth piece of one asperity's behaviour, for n parameter sets ("laws") at once.

    along(u, *parameters) -> (displacement, its derivative by u, load, contact area, slip-limited and yield-limited
    tangential resistance) of one asperity at the coordinate u; coordinate(displacement, *parameters) -> u is its inverse.
    Both are formulas (stiction.engine.compiled.formula) of scalars. Displacements are over sigma; loads, areas and resistances
    in the model's own units.

    parameters: arrays (n,) or numbers, in the order that `along` takes them.
    edges: array (n, m + 1). The regime reaches from the first to the last edge in its coordinate; the edges between are
        kinks, at which the engine splits. A pair of edges that does not increase is an empty piece, so that one
        regime may hold pieces that do not adjoin.
    branch: array (n,), a coordinate from which on the resistance grows like a square root; or (n, b), coordinates at which
        it does so on either side; or None. A piece that begins (or, for the second, ends) at or near one is integrated in
        the square root of the distance to it.
    lowest: no displacement of the regime is below this.
    state: "elastic", "plastic" ...; body: "bare", "film" or "substrate": what answers. Sums are reported by both.
    touching: whether an asperity here is counted as one that touches (a film and its substrate share asperities).
    in_half_space: False where a film's own law is used beyond the depth to which it is a half-space.
    yields_by_degrees: an asperity here flows in part, and only what does not yet flow of it resists.
    """

    along: Callable
    coordinate: Callable
    parameters: tuple[np.ndarray | float, ...]
    edges: np.ndarray
    state: str
    body: str = "bare"
    branch: np.ndarray | None = None
    touching: bool = True
    in_half_space: bool = True
    yields_by_degrees: bool = False
    lowest: float = 0.0


def columns(parameters: Sequence[np.ndarray | float], laws: int) -> np.ndarray:
    """Parameters, each an array (n,) or a number, as a table (n, p), which kernels take. A law may have none (Hertz)."""
    table = np.empty((laws, len(parameters)))
    for at, values in enumerate(parameters):
        table[:, at] = values
    return table
