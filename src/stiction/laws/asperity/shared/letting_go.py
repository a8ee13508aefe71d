"""What an asperity that was pressed beyond yield carries while it is let go, without adhesion.

It unloads elastically, as a sphere that the plastic flow has flattened, to an interference that stays. Two ways to that
residual interference: from the load and area at the turning point, so that the flattened sphere is Hertz's in both; or the fit
of Etsion, Kligerman & Kadin 2005. Everything is a formula of scalars in the units of docs/theory.md: interferences over sigma
(w_max the largest so far, with load_max and area_max there), loads over K R^(1/2) sigma^(3/2), areas over pi R sigma.
`drawn_apart` makes pieces of them, for sums over heights.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from numba.np.unsafe.ndarray import to_fixed_tuple

from stiction.engine.compiled import bind, formula, kernel
from stiction.laws.joining import within
from stiction.laws.piece import NormalPiece


@formula
def radius(load_max, area_max):
    """Radius of the flattened sphere over R: 4 E* a^3/(3 P), Hertz's for the load and contact radius at the turning point."""
    return area_max * math.sqrt(area_max) / load_max


@formula
def residual(w_max, load_max, area_max):
    """Interference that stays: omega_max - 3 P/(4 E* a) at the turning point; not below zero.

    It would be below zero where a published law lets the load jump up, or the area down, at yield, as that of Kogut and
    Etsion does up to 1.58 omega_c.
    """
    if not area_max > 0.0:
        return 0.0
    return max(w_max - load_max / math.sqrt(area_max), 0.0)


@formula
def residual_etsion(w_max, w_c):
    """The fit of Etsion, Kligerman & Kadin 2005: omega_res/omega_max = (1 - r^-0.28)(1 - r^-0.69), r = omega_max/omega_c.

    The exponents are as commonly remembered, not looked up. Zero where nothing has yielded (r <= 1).
    """
    shrink = math.log(min(w_c / w_max, 1.0)) if w_max > 0.0 else 0.0
    return w_max * math.expm1(0.28 * shrink) * math.expm1(0.69 * shrink)


@formula
def let_go(w, w_max, w_res, load_max, area_max):
    """Load and area at w <= w_max: P_max s^(3/2) and A_max s, s = (w - w_res)/(w_max - w_res); nothing below w_res.

    With `residual` above zero this is P = (4/3) E* R'^(1/2) (omega - omega_res)^(3/2) on the flattened radius R'. Both are
    continuous with loading at w_max whatever the residual is.
    """
    if w <= w_res:
        return 0.0, 0.0
    share = min((w - w_res) / (w_max - w_res), 1.0)
    return load_max * share * math.sqrt(share), area_max * share


@formula
def recovered(w_max, w_res, load_max):
    """Work done by the asperity from w_max to w_res, Int P dw: the elastic energy that it gives back."""
    return 0.4 * load_max * (w_max - w_res)


# The functions named _*_template are compiled anew for each asperity law, with these names bound.
normal = coordinate = None
NORMAL = PARAMETERS = 0
_residual, _let_go = residual, let_go


def _drawn_template(v, *row):
    """`normal` of a piece, let go by the distance row[NORMAL]; u = free + v^2, for the load starts like (u - free)^(3/2)."""
    w_max, stretch, load_max, area_max = normal(row[NORMAL + 1] + v * v, *row[:NORMAL])
    w = w_max - row[NORMAL]
    load, area = _let_go(w, w_max, _residual(w_max, load_max, area_max), load_max, area_max)
    return w, 2.0 * v * stretch, load, area


def _drawn_coordinate_template(w, *row):
    return math.sqrt(max(coordinate(w + row[NORMAL], *row[:NORMAL]) - row[NORMAL + 1], 0.0))


@formula
def _recovery(state):
    return state[0] - _residual(state[0], state[2], state[3])


@formula
def _overshoot(state):
    """Whether the flattened sphere would have recovered more than it was pressed in, by more than rounding."""
    return state[3] > 0.0 and state[2] > (1.0 + 1e-12) * state[0] * math.sqrt(state[3])


_STEP = 1e-6  # to the side, for a slope: the coordinates of pieces are of the order of one, or of their own first value


def _free_template(distance, parameters, edges, out):
    """The coordinate at which the asperities are just free once they are let go by the distance: it grows along a piece. Where
    the first of the piece is not free yet, the straight continuation to where it would be: the square root of the distance to
    it is then smooth along the piece."""
    for i in range(distance.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        low, high = edges[i, 0], edges[i, edges.shape[1] - 1]
        first = _recovery(normal(low, *row))
        if not first < distance[i]:
            out[i] = low
            step = _STEP * max(abs(low), 1e-3)
            if high > low + step:
                slope = (_recovery(normal(low + step, *row)) - first) / step
                away = first - distance[i]
                if slope > 0.0 and away < slope * max(abs(low), 1.0):
                    out[i] = low - away / slope
            continue
        if high == np.inf:
            step = 1.0
            while step < 1e6 and _recovery(normal(low + step, *row)) < distance[i]:
                step *= 4.0
            high = low + step
        if not _recovery(normal(high, *row)) > distance[i]:
            out[i] = edges[i, edges.shape[1] - 1]
            continue
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if _recovery(normal(middle, *row)) < distance[i]:
                low = middle
            else:
                high = middle
        out[i] = high


def _clamped_template(parameters, edges, out):
    """Up to which coordinate nothing stays because the law overshoots, see `residual`; the first where it does not."""
    for i in range(out.size):
        row = to_fixed_tuple(parameters[i], PARAMETERS)
        low, last = edges[i, 0], edges[i, edges.shape[1] - 1]
        out[i] = low
        if not (last > low and _overshoot(normal(low, *row))):
            continue
        high = last
        if last == np.inf:
            step = 1e-3
            while step < 1e6 and _overshoot(normal(low + step, *row)):
                step *= 4.0
            high = low + step
        if _overshoot(normal(high, *row)):
            out[i] = last
            continue
        for _ in range(100):
            middle = 0.5 * (low + high)
            if not low < middle < high:
                break
            if _overshoot(normal(middle, *row)):
                low = middle
            else:
                high = middle
        out[i] = high


@cache
def _drawn(normal: Callable, coordinate: Callable, parameters: int):
    """Formulas of the piece that is let go, and the kernels that find where it begins and what of it overshoots; the same
    objects for the same law."""
    names = {"normal": normal, "coordinate": coordinate, "NORMAL": parameters, "PARAMETERS": parameters}
    formulas = [formula(bind(one, **names)) for one in (_drawn_template, _drawn_coordinate_template)]
    return *formulas, *(kernel(bind(one, **names)) for one in (_free_template, _clamped_template))


def drawn_apart(pieces: list[NormalPiece], distance: np.ndarray) -> list[NormalPiece]:
    """The asperities after the surfaces were drawn apart, without adhesion, by the distance (n,) over sigma, not negative.

    pieces: of an asperity law without adhesion, as it is pressed. Summed over heights at the mean separation h, the returned
    pieces give the load and contact area at h of a surface that was pressed to h - distance before.
    """
    far = np.ascontiguousarray(distance, dtype=float)
    found = []
    for piece in pieces:
        held, coordinate_of, free_of, clamped_of = _drawn(piece.normal, piece.coordinate, len(piece.parameters))
        laws = len(piece.edges)
        columns = [np.broadcast_to(column, laws) for column in piece.parameters]
        parameters = np.ascontiguousarray(np.reshape(columns, (len(columns), laws)).T)
        clamped, free = np.empty(laws), np.empty(laws)
        clamped_of(parameters, np.ascontiguousarray(piece.edges), clamped)
        first, last = piece.edges[:, 0], piece.edges[:, -1]
        parts = [within(piece, first, clamped), within(piece, clamped, last)] if (clamped > first).any() else [piece]
        for part in parts:
            edges = np.ascontiguousarray(part.edges)
            free_of(far, parameters, edges, free)
            empty = np.isinf(free) | ~(edges[:, -1] > edges[:, 0])
            origin = np.where(empty, 0.0, free)
            edges = np.where(empty[:, None], 0.0, np.sqrt(np.maximum(edges - origin[:, None], 0.0)))
            found.append(NormalPiece(held, coordinate_of, (*piece.parameters, far, origin), edges, piece.state))
    return found
