"""Join an asperity law and a tangential law into regimes.

A regime is a segment of an asperity law together with the tangential force on it: a smooth part of the asperity's response to
displacement. The engine sums regimes over the heights of the asperities.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, TypeVar

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import up_to
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.nodes import values_at
from stiction.engine.regime import Regime, columns
from stiction.engine.sorting import sort_few
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import AsperityLaw, TangentialLaw, select_options

# A kink closer than this, relative to its coordinate, to an end of its segment is moved to that end.
_AT_END = 4e-15
# The search for a contact area on an endless segment ends at this coordinate.
_FARTHEST = 1e100


@dataclass(frozen=True)
class Weights:
    """Hold the shift and the factors by which `Law.join` turns an asperity's response into a `Regime`.

    Each field is a number or an array (n,), one value for each of n contacts. shift: added to the displacement, in units of
    sigma. unit: factor that converts the forces of this body to the unit of force of the contact. load, area, friction:
    factors of load, contact area and tangential force, usually 1 (included) or 0 (not included). `friction` has no effect
    with a law of the interface, whose force follows from the load and area that these factors give.
    """

    shift: np.ndarray | float = 0.0
    unit: np.ndarray | float = 1.0
    load: np.ndarray | float = 1.0
    area: np.ndarray | float = 1.0
    friction: np.ndarray | float = 1.0


@formula
def none(u, w, load, area):
    """Return (0, 0): the slip-limited and the yield-limited force of an asperity without resistance to sliding.

    The arguments are not used.
    """
    return 0.0, 0.0


@cache
def _joined(normal: Callable, coordinate: Callable, resistance: Callable, interfacial: bool, parameters: int, own: int) -> Any:
    """Return the formulas `along` and `coordinate` of a `Regime`, made of an asperity law and a tangential law.

    `along` computes the response at a coordinate u, `coordinate` computes u at a displacement.

    normal, coordinate: formulas of a `NormalSegment`. resistance: formula of a `TangentialResistance`. interfacial: whether the
    tangential law describes the interface. If True, it receives load and area multiplied by the factors `load` and `area` of
    `Weights`; if False, without these factors. parameters, own: number of parameters of the asperity law and of the tangential
    law. The function is cached, so that the same laws give the same formulas and kernels are compiled once.
    """
    joined = parameters + own

    @formula
    def along(u, *row):
        """Return displacement w, dw/du, load, contact area, slip-limited and yield-limited force at the coordinate u.

        row: parameters of the asperity law and of the tangential law, then the five numbers of `Weights`. The tangential
        law receives load and area before they are weighted.
        """
        w, stretch, load, area = normal(u, *row[:parameters])
        slip_limited, yield_limited = resistance(u, w, load, area, *row[parameters:joined])
        shift, unit, of_load, of_area, of_friction = row[joined:]
        factor = unit * of_friction
        return shift + w, stretch, unit * of_load * load, of_area * area, factor * slip_limited, factor * yield_limited

    @formula
    def along_interface(u, *row):
        """Return displacement w, dw/du, load, contact area, slip-limited and yield-limited force at the coordinate u.

        row: parameters of the asperity law and of the tangential law, then the five numbers of `Weights`. The tangential
        law, a law of the interface, receives load and area times the factors `load` and `area` of `Weights`.
        """
        w, stretch, load, area = normal(u, *row[:parameters])
        shift, unit, of_load, of_area, _ = row[joined:]
        load, area = of_load * load, of_area * area
        slip_limited, yield_limited = resistance(u, w, load, area, *row[parameters:joined])
        return shift + w, stretch, unit * load, area, unit * slip_limited, unit * yield_limited

    @formula
    def back(w, *row):
        return coordinate(w - row[joined], *row[:parameters])

    return along_interface if interfacial else along, back


@dataclass(frozen=True)
class Law:
    """Combine an asperity law with a tangential law and with the options chosen for both.

    tangential: tangential law; with None, only load and contact area are computed. options: option name -> chosen value;
    each law reads only its own options.
    """

    asperity: AsperityLaw
    tangential: TangentialLaw | None = None
    options: Mapping[str, str] = field(default_factory=dict)

    @property
    def interfacial(self) -> bool:
        """Return whether the tangential law describes the interface rather than the bodies; False without a tangential law."""
        return self.tangential is not None and self.tangential.interfacial

    def segments(self, groups: Groups) -> list[NormalSegment]:
        return self.asperity.segments(groups, **select_options(self.asperity, self.options))

    def regimes(self, groups: Groups, weights: Weights = Weights(), **labels) -> list[Regime]:
        """Return one `Regime` for each segment of the asperity law, with its tangential resistance and with `weights` applied.

        groups: dimensionless groups of n contacts. labels: further fields of each Regime, such as body="film" or
        touching=False. The tangential forces are 0 as in `join`.
        """
        return [self.join(segment, groups, weights, **labels) for segment in self.segments(groups)]

    def join(self, segment: NormalSegment, groups: Groups, weights: Weights = Weights(), **labels) -> Regime:
        """Return the `Regime` of one segment of the asperity law, with its tangential resistance and with `weights` applied.

        groups: dimensionless groups of n contacts. labels: further fields of the Regime, such as body="film" or touching=False.
        Both tangential forces are 0 if there is no tangential law, or if the law gives the segment no resistance.
        """
        tangential_resistance = None
        if self.tangential is not None:
            tangential_resistance = self.tangential.tangential_resistance(
                segment, groups, **select_options(self.tangential, self.options)
            )
        tangential_resistance = tangential_resistance or TangentialResistance(none, ())
        along, coordinate = _joined(
            segment.normal,
            segment.coordinate,
            tangential_resistance.resistance,
            self.interfacial,
            len(segment.parameters),
            len(tangential_resistance.parameters),
        )
        parameters = (
            *segment.parameters,
            *tangential_resistance.parameters,
            weights.shift,
            weights.unit,
            weights.load,
            weights.area,
            weights.friction,
        )
        return Regime(
            along,
            coordinate,
            parameters,
            with_kinks(segment.edges, tangential_resistance.kinks),
            segment.state,
            branch=tangential_resistance.branch,
            lowest=segment.lowest + float(np.min(weights.shift, initial=np.inf, where=np.isfinite(weights.shift))),
            **labels,
        )


def with_kinks(edges: np.ndarray, kinks: np.ndarray | None) -> np.ndarray:
    """Return the edges of n segments with kinks inserted in ascending order, (n, m + k).

    edges (n, m): coordinates of start, kinks and end of each segment. kinks (n, k): coordinates in any order, or None for
    no kinks. A kink outside the segment is moved to the nearer end, which adds a part of zero length.
    """
    if kinks is None or kinks.shape[1] == 0:
        return edges
    out = np.empty((len(edges), edges.shape[1] + kinks.shape[1]))
    _fill_sorted(np.ascontiguousarray(edges), np.ascontiguousarray(kinks), out)
    return out


@lazy_kernel(worth=30_000)
def _fill_sorted(edges, kinks, out):
    for i in range(out.shape[0]):
        first, last, row = edges[i, 0], edges[i, edges.shape[1] - 1], out[i]
        for j in range(row.size):
            value = edges[i, j] if j < edges.shape[1] else min(max(kinks[i, j - edges.shape[1]], first), last)
            # A kink within rounding of an end is moved to it, because the tiny part between them would need nodes of its own.
            value = first if value <= first + _AT_END * abs(first) else value
            row[j] = last if value >= last - _AT_END * abs(last) else value
        sort_few(row)


Part = TypeVar("Part", NormalSegment, Regime)


def within(part: Part, low: np.ndarray | float, high: np.ndarray | float) -> Part:
    """Return a copy of a segment or regime that is restricted to the coordinates from `low` to `high`.

    low, high: numbers or arrays (n,). The copy is empty (all its edges are equal) if high < low, or if the range from low to
    high lies outside the segment.
    """
    low = np.maximum(np.reshape(low, (-1, 1)), part.edges[:, :1])
    high = np.minimum(np.reshape(high, (-1, 1)), part.edges[:, -1:])
    return replace(part, edges=np.minimum(np.maximum(part.edges, low), high))


@cache
def _coordinates(normal: Callable, coordinate: Callable, parameters: int) -> Any:
    @lazy_kernel(worth=3_000)
    def fill_coordinates(w, table, edges, out):
        for i in range(w.size):
            row = unpack(table[i], parameters)
            first, last = edges[i, 0], edges[i, edges.shape[1] - 1]
            if not normal(first, *row)[0] < w[i]:
                out[i] = first
            elif w[i] == np.inf or not (last == np.inf or normal(last, *row)[0] > w[i]):
                out[i] = last
            else:
                out[i] = min(max(coordinate(w[i], *row), first), last)

    return fill_coordinates


@cache
def _coordinates_at_area(normal: Callable, parameters: int) -> Any:
    @formula
    def narrower(u, arguments):
        row, area = arguments
        return normal(u, *row)[3] < area

    search = up_to(narrower)

    @lazy_kernel(worth=300)
    def fill_coordinates_at_area(area, table, edges, out):
        for i in range(area.size):
            row = unpack(table[i], parameters)
            out[i] = search(edges[i, 0], edges[i, edges.shape[1] - 1], 1.0, _FARTHEST, (row, area[i]))

    return fill_coordinates_at_area


@cache
def _resistances(resistance: Callable, parameters: int) -> Any:
    @lazy_kernel(worth=3_000)
    def fill_resistances(load, area, table, out):
        for i in range(load.shape[0]):
            row = unpack(table[i], parameters)
            for j in range(load.shape[1]):
                slip_limited, yield_limited = resistance(0.0, 0.0, load[i, j], area[i, j], *row)
                out[i, j] = slip_limited + yield_limited

    return fill_resistances


def coordinates(segment: NormalSegment, w: np.ndarray | float) -> np.ndarray:
    """Return the coordinates u (n,) of a segment at the displacements w, clipped to the segment.

    w: displacement in units of sigma, a number or an array (n,).
    """
    edges, out = np.ascontiguousarray(segment.edges), np.empty(len(segment.edges))
    compiled = _coordinates(segment.normal, segment.coordinate, len(segment.parameters))
    compiled(_one_each(w, edges), columns(segment.parameters, len(edges)), edges, out)
    return out


def coordinates_at_area(segment: NormalSegment, area: np.ndarray | float) -> np.ndarray:
    """Return the coordinates u (n,) of a segment at the contact areas `area`, clipped to the segment.

    area: contact area in units of pi R sigma, a number or an array (n,). The area must grow along the segment. The
    coordinate is infinite if an endless segment does not reach the area before u = 1e100.
    """
    edges, out = np.ascontiguousarray(segment.edges), np.empty(len(segment.edges))
    compiled = _coordinates_at_area(segment.normal, len(segment.parameters))
    compiled(_one_each(area, edges), columns(segment.parameters, len(edges)), edges, out)
    return out


def states(regime: Regime, u: np.ndarray) -> np.ndarray:
    """Return six values (n, 6) of a regime at the coordinates u (n,), one coordinate for each of n contacts.

    Columns: displacement, its derivative with respect to u, load, contact area, slip-limited tangential force, yield-limited
    tangential force.
    """
    return _values(regime.along, regime.parameters, u, 6)


def normal_states(segment: NormalSegment, u: np.ndarray) -> np.ndarray:
    """Return displacement w, dw/du, load and contact area (n, 4) of a segment at the coordinates u (n,).

    Units: displacement in sigma, load in K R^(1/2) sigma^(3/2) with K = (4/3) E*, area in pi R sigma.
    """
    return _values(segment.normal, segment.parameters, u, 4)


def _values(along: Callable, parameters: tuple, u: np.ndarray, values: int) -> np.ndarray:
    return values_at(along, columns(parameters, len(u)), np.reshape(u, (-1, 1)), values)[..., 0]


def _one_each(values: np.ndarray | float, edges: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(np.broadcast_to(np.asarray(values, dtype=float), len(edges)))


def resistances(
    tangential: TangentialLaw, groups: Groups, load: np.ndarray, area: np.ndarray, state: str = "elastic"
) -> np.ndarray:
    """Return the tangential force (n, m) of whole contacts of known load and contact area, by a law of the interface.

    The law's formula returns a slip-limited and a yield-limited force, one of them 0; the result is their sum. groups:
    dimensionless groups of n contacts. load, area (n, m): m states of each contact. state: "elastic" or "plastic". Units: loads
    and forces in K R^(1/2) sigma^(3/2) with K = (4/3) E*, areas in pi R sigma.
    """
    anywhere = NormalSegment(none, none, (), np.zeros((len(groups), 1)), state)
    tangential_resistance = tangential.tangential_resistance(anywhere, groups)
    out = np.empty(load.shape)
    table = columns(tangential_resistance.parameters, len(groups))
    _resistances(tangential_resistance.resistance, len(tangential_resistance.parameters))(
        np.ascontiguousarray(load), np.ascontiguousarray(area), table, out
    )
    return out
