"""Find the smaller of two tangential resistances in series: of a pressed-through film, and of its substrate."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.crossings import MOST, crossing
from stiction.engine.regime import Regime, columns
from stiction.laws.joining import Law, Weights, coordinates, states
from stiction.laws.segment import NormalSegment

_DEEPEST = 1e3  # displacement over sigma beyond which no asperity contributes


@cache
def _weaker(substrate: Callable, film: Callable, back: Callable, of_substrate: int, of_film: int) -> tuple[Any, Any]:
    """Return two formulas for the weaker of two resistances.

    The first returns displacement, its derivative, zero load, zero area, and the slip-limited and yield-limited resistance of
    film or substrate, whichever is weaker. The second returns the film's resistance minus the substrate's.

    substrate, film: formulas `along` of substrate and film. of_substrate, of_film: number of parameters of each. back: formula
    for the coordinate of the film at a displacement.
    """
    count = of_substrate + of_film

    @formula
    def both(u, row):
        w, stretch, _, _, slip, torn = substrate(u, *row[:of_substrate])
        _, _, _, _, film_slip, film_torn = film(back(w, *row[of_substrate:count]), *row[of_substrate:count])
        return w, stretch, slip, torn, film_slip, film_torn

    @formula
    def along(u, *row):
        w, stretch, slip, torn, film_slip, film_torn = both(u, row)
        if film_slip + film_torn < slip + torn:
            slip, torn = film_slip, film_torn
        return w, stretch, 0.0, 0.0, slip, torn

    @formula
    def excess(u, row):
        _, _, slip, torn, film_slip, film_torn = both(u, row)
        return film_slip + film_torn - slip - torn

    return along, excess


@cache
def _back(coordinate: Callable, of_substrate: int) -> Any:
    @formula
    def back(w, *row):
        return coordinate(w, *row[:of_substrate])

    return back


def weaker_regimes(law: Law, groups: Groups) -> list[Regime]:
    """Return regimes that add only the friction of the weaker of film and substrate where the film is pressed through.

    The film is pressed through where w > tau. Load and area of the regimes are zero. The resistance is the smaller of the
    film's at the displacement w and the substrate's at w - tau, in units of K R^(1/2) sigma^(3/2) with K = (4/3) E* of the
    substrate. w: displacement, tau: film thickness, both in units of sigma. law: asperity law, and a tangential law that
    does not describe the interface. groups: dimensionless groups of n coated contacts.
    """
    film_groups, substrate = groups.film(), groups.substrate()
    tau = np.broadcast_to(np.asarray(groups.tau, dtype=float), len(groups))
    film = [law.join(segment, film_groups, Weights(unit=groups.n_E)) for segment in law.segments(film_groups)]
    regimes = []
    for segment in law.segments(substrate):
        below = law.join(segment, substrate, Weights(shift=tau))
        deepest = coordinates(segment, _DEEPEST)
        for above in film:
            ends = [states(above, above.edges[:, side])[:, 0] for side in (0, -1)]
            start, end = (np.where(np.isfinite(above.edges[:, side]), ends[side], np.inf) for side in (0, -1))
            first, last = coordinates(segment, start - tau), coordinates(segment, end - tau)
            first = np.where(start <= tau, coordinates(segment, 0.0), first)
            regimes.append(_in_series(below, above, segment, tau, first, np.minimum(last, deepest)))
    return regimes


def _in_series(
    below: Regime, above: Regime, segment: NormalSegment, tau: np.ndarray, first: np.ndarray, last: np.ndarray
) -> Regime:
    """Return the regime of a substrate segment under a film regime, with the smaller of both resistances at each coordinate.

    below: regime of the substrate, made from `segment`. above: regime of the film. tau (n,): film thickness in units of sigma.
    first, last (n,): coordinates of the substrate segment between which both film and substrate resist. The edges of the
    returned regime are the kinks of film and substrate, and the coordinates at which their resistances are equal.
    """
    inner = [_edge_on_substrate(above, number, segment, tau) for number in range(above.edges.shape[1])]
    edges = np.sort(np.concatenate([below.edges, np.stack(inner, axis=1)], axis=1), axis=1)
    edges = np.minimum(np.maximum(edges, first[:, None]), np.maximum(first, last)[:, None])
    back = _back(above.coordinate, len(above.parameters))
    along, excess = _weaker(below.along, above.along, back, len(below.parameters), len(above.parameters))
    parameters = (*below.parameters, *above.parameters)
    out = np.empty((len(edges), MOST))
    crossing(excess, len(parameters))(columns(parameters, len(edges)), np.ascontiguousarray(edges), out)
    edges = np.sort(np.concatenate([edges, out], axis=1), axis=1)
    return Regime(
        along,
        _back(below.coordinate, len(below.parameters)),
        parameters,
        edges,
        below.state,
        "substrate",
        touching=False,
        branch=_branches(below, above, segment, tau),
        lowest=below.lowest,
    )


def _branches(below: Regime, above: Regime, segment: NormalSegment, tau: np.ndarray) -> np.ndarray | None:
    """Return the b branch points of film and substrate as coordinates (n, b) of the substrate; None if there are none.

    At a branch point a resistance varies as the square root of the distance from it. A point of the film is converted by its
    displacement, which exceeds that of the substrate by the film thickness. A coordinate is -inf where a contact has no such
    point. below, above: regimes of substrate and film. segment: segment of the substrate. tau (n,): film thickness in units of
    sigma.
    """
    branches = [] if below.branch is None else [np.reshape(below.branch, (len(tau), -1))]
    for point in () if above.branch is None else np.reshape(above.branch, (len(tau), -1)).T:
        there = np.isfinite(point) & (point >= above.edges[:, 0]) & (point <= above.edges[:, -1])
        w = states(above, np.where(there, point, above.edges[:, 0]))[:, 0] - tau
        branches.append(np.where(there & (w >= 0.0), coordinates(segment, w), -np.inf)[:, None])
    return np.concatenate(branches, axis=1) if branches else None


def _edge_on_substrate(above: Regime, number: int, segment, tau: np.ndarray) -> np.ndarray:
    """Return the coordinate (n,) on the substrate segment at which the film reaches an end of one of its segments.

    It is clipped to the segment. above: regime of the film. number: index of this end in `above.edges`. segment: segment of the
    substrate. tau (n,): film thickness in units of sigma; the substrate's displacement is smaller than the film's by this
    thickness.
    """
    edge = above.edges[:, number]
    finite = np.isfinite(edge)
    w = states(above, np.where(finite, edge, above.edges[:, 0]))[:, 0]
    return coordinates(segment, np.where(finite, w, np.inf) - tau)
