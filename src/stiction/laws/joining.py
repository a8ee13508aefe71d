"""An asperity law and a tangential law, joined into the regimes that the engine sums."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from stiction.contact.indices import Groups
from stiction.engine.compiled import bind, formula, kernel
from stiction.engine.regime import Regime
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.laws.registry import AsperityLaw, TangentialLaw, select_options


@dataclass(frozen=True)
class Share:
    """What of an asperity's response counts; arrays (n,) or numbers.

    It starts at the displacement `shift`. unit: what the forces of this body are multiplied by to be in the unit of the whole
    contact. force, cover, grip: of its load, contact area and tangential resistance, 1 or 0 as a rule.
    """

    shift: np.ndarray | float = 0.0
    unit: np.ndarray | float = 1.0
    force: np.ndarray | float = 1.0
    cover: np.ndarray | float = 1.0
    tangential_resistance: np.ndarray | float = 1.0


# The functions named _*_template are compiled anew for each pair of laws, with these names bound.
normal = resistance = coordinate = None
NORMAL = JOINED = PARAMETERS = 0


def _joined_template(u, *row):
    """along(u) of a regime: the normal law, the resistance that it leaves room for, and what of both counts."""
    w, stretch, load, area = normal(u, *row[:NORMAL])
    slip_limited, yield_limited = resistance(u, w, load, area, *row[NORMAL:JOINED])
    shift, unit, force, cover, tangential_resistance = row[JOINED:]
    held = unit * tangential_resistance
    return shift + w, stretch, unit * force * load, cover * area, held * slip_limited, held * yield_limited


def _interfacial_template(u, *row):
    """The same for a resistance of the interface: it sees only the load and area that count."""
    w, stretch, load, area = normal(u, *row[:NORMAL])
    shift, unit, force, cover, _ = row[JOINED:]
    load, area = force * load, cover * area
    slip_limited, yield_limited = resistance(u, w, load, area, *row[NORMAL:JOINED])
    return shift + w, stretch, unit * load, area, unit * slip_limited, unit * yield_limited


def _coordinate_template(w, *row):
    return coordinate(w - row[JOINED], *row[:NORMAL])


@formula
def none(u, w, load, area):
    """No tangential law."""
    return 0.0, 0.0


@cache
def _joined(normal, coordinate, resistance, interfacial: bool, parameters: int, own_parameters: int):
    """Formulas of the joined regime; the same objects for the same laws, so that kernels are compiled once."""
    names = {"normal": normal, "resistance": resistance, "NORMAL": parameters, "JOINED": parameters + own_parameters}
    template = _interfacial_template if interfacial else _joined_template
    return formula(bind(template, **names)), formula(bind(_coordinate_template, coordinate=coordinate, **names))


@dataclass(frozen=True)
class Law:
    """How one asperity answers: an asperity law and a tangential law, or None for contact only, with their options."""

    asperity: AsperityLaw
    tangential: TangentialLaw | None = None
    options: Mapping[str, str] = field(default_factory=dict)

    @property
    def interfacial(self) -> bool:
        """Whether friction is of the interface, whichever body answers."""
        return self.tangential is not None and self.tangential.interfacial

    def pieces(self, groups: Groups) -> list[NormalPiece]:
        return self.asperity.pieces(groups, **select_options(self.asperity, self.options))

    def regimes(self, groups: Groups, share: Share = Share(), **labels) -> list[Regime]:
        """Every piece of the asperity law, joined."""
        return [self.join(piece, groups, share, **labels) for piece in self.pieces(groups)]

    def join(self, piece: NormalPiece, groups: Groups, share: Share = Share(), **labels) -> Regime:
        """One piece with the tangential law, of which `share` counts. labels: body, touching, in_half_space of the Regime."""
        tangential_resistance = None
        if self.tangential is not None:
            tangential_resistance = self.tangential.tangential_resistance(
                piece, groups, **select_options(self.tangential, self.options)
            )
        tangential_resistance = tangential_resistance or TangentialResistance(none, ())
        along, coordinate = _joined(
            piece.normal,
            piece.coordinate,
            tangential_resistance.resistance,
            self.interfacial,
            len(piece.parameters),
            len(tangential_resistance.parameters),
        )
        parameters = (
            *piece.parameters,
            *tangential_resistance.parameters,
            share.shift,
            share.unit,
            share.force,
            share.cover,
            share.tangential_resistance,
        )
        return Regime(
            along,
            coordinate,
            parameters,
            _with_kinks(piece.edges, tangential_resistance.kinks),
            piece.state,
            branch=tangential_resistance.branch,
            lowest=piece.lowest + float(np.min(share.shift, initial=np.inf, where=np.isfinite(share.shift))),
            **labels,
        )


def _with_kinks(edges: np.ndarray, kinks: np.ndarray | None) -> np.ndarray:
    """Edges (n, m) with the kinks (n, k) that are inside between them; the others make pieces without length."""
    if kinks is None or kinks.shape[1] == 0:
        return edges
    out = np.empty((len(edges), edges.shape[1] + kinks.shape[1]))
    _fill_sorted(np.ascontiguousarray(edges), np.ascontiguousarray(kinks), out)
    return out


@kernel
def _fill_sorted(edges, kinks, out):
    for i in range(out.shape[0]):
        first, last, row = edges[i, 0], edges[i, edges.shape[1] - 1], out[i]
        for at in range(row.size):
            value = edges[i, at] if at < edges.shape[1] else min(max(kinks[i, at - edges.shape[1]], first), last)
            place = at
            while place > 0 and row[place - 1] > value:
                row[place] = row[place - 1]
                place -= 1
            row[place] = value


def within(piece: NormalPiece, low: np.ndarray | float, high: np.ndarray | float) -> NormalPiece:
    """The part of a piece between two coordinates (n,); nothing where high < low, or where they are outside."""
    low = np.maximum(np.reshape(low, (-1, 1)), piece.edges[:, :1])
    high = np.minimum(np.reshape(high, (-1, 1)), piece.edges[:, -1:])
    return replace(piece, edges=np.minimum(np.maximum(piece.edges, low), high))


def _coordinates_template(w, parameters, edges, out):
    for i in range(w.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        first, last = edges[i, 0], edges[i, edges.shape[1] - 1]
        if not normal(first, *row)[0] < w[i]:
            out[i] = first
        elif w[i] == np.inf or not (last == np.inf or normal(last, *row)[0] > w[i]):
            out[i] = last
        else:
            out[i] = min(max(coordinate(w[i], *row), first), last)


def _states_template(u, parameters, out):
    for i in range(u.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        state = normal(u[i], *row)
        for at in range(len(state)):
            out[i, at] = state[at]


def _widths_template(area, parameters, edges, out):
    for i in range(area.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        low, high = edges[i, 0], edges[i, edges.shape[1] - 1]
        if not normal(low, *row)[3] < area[i]:
            out[i] = low
            continue
        if area[i] == np.inf:
            out[i] = high
            continue
        if high == np.inf:
            step = 1.0
            while normal(low + step, *row)[3] < area[i]:
                step *= 4.0
            high = low + step
        elif not normal(high, *row)[3] > area[i]:
            out[i] = high
            continue
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if normal(middle, *row)[3] < area[i]:
                low = middle
            else:
                high = middle
        out[i] = high


@cache
def _kernel(template: Callable, normal, coordinate, parameters: int):
    return kernel(bind(template, normal=normal, coordinate=coordinate, PARAMETERS=parameters))


def _columns(parameters, laws: int) -> np.ndarray:
    columns = [np.broadcast_to(column, laws) for column in parameters]
    return np.ascontiguousarray(np.reshape(columns, (len(columns), laws)).T)


def coordinates(piece: NormalPiece, w: np.ndarray | float) -> np.ndarray:
    """u (n,) where the displacement is w (n,); the nearer end where the piece does not have it."""
    edges = np.ascontiguousarray(piece.edges)
    compiled = _kernel(_coordinates_template, piece.normal, piece.coordinate, len(piece.parameters))
    out = np.empty(len(edges))
    compiled(_one_each(w, edges), _columns(piece.parameters, len(edges)), edges, out)
    return out


def coordinates_at_area(piece: NormalPiece, area: np.ndarray | float) -> np.ndarray:
    """u (n,) where the contact area, which grows along the piece, is this (n,); the nearer end where it nowhere is."""
    edges = np.ascontiguousarray(piece.edges)
    compiled = _kernel(_widths_template, piece.normal, piece.coordinate, len(piece.parameters))
    out = np.empty(len(edges))
    compiled(_one_each(area, edges), _columns(piece.parameters, len(edges)), edges, out)
    return out


def states(regime: Regime, u: np.ndarray) -> np.ndarray:
    """The six values (n, 6) of `along` at the coordinates u (n,)."""
    compiled = _kernel(_states_template, regime.along, regime.coordinate, len(regime.parameters))
    out = np.empty((len(u), 6))
    compiled(np.ascontiguousarray(u), _columns(regime.parameters, len(u)), out)
    return out


def normal_states(piece: NormalPiece, u: np.ndarray) -> np.ndarray:
    """Displacement, its derivative, load and contact area (n, 4) at the coordinates u (n,)."""
    compiled = _kernel(_states_template, piece.normal, piece.coordinate, len(piece.parameters))
    out = np.empty((len(u), 4))
    compiled(np.ascontiguousarray(u), _columns(piece.parameters, len(u)), out)
    return out


def _one_each(values, edges: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(np.broadcast_to(np.asarray(values, dtype=float), len(edges)))


def _resistances_template(load, area, parameters, out):
    for i in range(load.shape[0]):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        for at in range(load.shape[1]):
            slip_limited, yield_limited = normal(0.0, 0.0, load[i, at], area[i, at], *row)
            out[i, at] = slip_limited + yield_limited


def resistances(tangential: TangentialLaw, groups: Groups, load: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Tangential force (n, m) of a law of the interface under whole loads and contact areas (n, m)."""
    anywhere = NormalPiece(none, none, (), np.zeros((len(groups), 1)), "elastic")
    tangential_resistance = tangential.tangential_resistance(anywhere, groups)
    compiled = _kernel(_resistances_template, tangential_resistance.resistance, none, len(tangential_resistance.parameters))
    out = np.empty(load.shape)
    parameters = _columns(tangential_resistance.parameters, len(groups))
    compiled(np.ascontiguousarray(load), np.ascontiguousarray(area), parameters, out)
    return out
