"""Describe one smooth part of an asperity's behaviour (a regime) as data for the sums over asperity heights."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

# State of a regime that describes liquid bridges, not solid contact: its load is reported separately.
MENISCUS = "meniscus"


@dataclass(frozen=True)
class Regime:
    """Describe one smooth part of an asperity's behaviour, for n parameter sets ("laws") at once.

    along(u, *parameters) returns for one asperity at the coordinate u: displacement, derivative of the displacement with
    respect to u, load, contact area, and the slip-limited and the yield-limited part of its tangential resistance.
    coordinate(displacement, *parameters) -> u is the inverse of the displacement. Both are scalar formulas
    (`compiled.formula`). Displacements are in units of sigma, the standard deviation of the heights; loads, areas and
    resistances are in the units of the model.

    parameters: arrays (n,) or numbers, in the order in which `along` takes them.
    edges: array (n, m + 1) of coordinates. The regime reaches from the first to the last edge; the edges in between are kinks,
        at which the integration is split. A pair of edges that does not increase is an empty segment; with it one regime can
        describe segments that are not adjacent.
    branch: coordinates near which the resistance varies as the square root of the distance, or None. An array (n,) applies
        above the coordinate, an array (n, b) on both sides. Near a branch point the integration variable is this square root.
    lowest: lower bound of the displacement.
    state: state of the asperity, such as "elastic" or "plastic". body: "bare", "film" or "substrate", the body that deforms.
        Results are reported by state and body.
    touching: whether asperities here count as touching (False avoids counting an asperity on film and substrate twice).
    in_half_space: False if the coating law treats the film as infinitely thick, but the asperity is pressed in too deep
        for this.
    yields_by_degrees: True if a growing part of the contact flows plastically; this part has no tangential resistance.
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
    """Return the parameters of a law as one table (n, p), a column for each parameter; p may be 0.

    parameters: p arrays (n,) or numbers. laws: n, the number of parameter sets.
    """
    table = np.empty((laws, len(parameters)))
    for column, values in enumerate(parameters):
        table[:, column] = values
    return table
