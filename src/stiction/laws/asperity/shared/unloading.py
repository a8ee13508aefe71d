r"""Load of a yielded asperity without adhesion during unloading.

`st.unload` computes contact during unloading. JKR asperities follow their unloading branch. Asperities with the law
[`thornton_ning_1998`](#thornton_ning_1998) unload by the equations of its paper. For yielded asperities without adhesion this
project uses its own law. Unloading starts at the turning point, with displacement $w_m$, load $P_m$ and contact area $A_m$.
From there the asperity unloads elastically, as a sphere that plastic flow has flattened: it follows Hertz with the larger
radius $\bar R$ and the residual displacement $w_\text{res}$,

$$
\bar R/R=A_m^{3/2}/P_m,\qquad w_\text{res}=w_m-\frac{P_m}{\sqrt{A_m}}\ \text{(not below 0)},\qquad
P=P_m\left(\frac{w-w_\text{res}}{w_m-w_\text{res}}\right)^{3/2}
$$

Load and area are then continuous at the turning point. In SI units $\bar R=4E^*a_m^3/(3P_m)$ and
$\omega_\text{res}=\omega_m-3P_m/(4E^*a_m)$, with the contact radius $a_m$. The residual displacement of
[etsion_kligerman_kadin_2005] is not used, because its exponents could not be confirmed. In that law
$w_\text{res}/w_m=(1-r^{-0.28})(1-r^{-0.69})$ with $r=w_m/w_c$, where $w_c$ is the displacement at first yield. For copper, that
residual displacement exceeds the residual displacement used here by 0 to $0.11\,w_m$ (asperity law of Kogut and Etsion,
$r\le110$), by $-0.10$ to $0.19\,w_m$ (law of Chang, Etsion and Bogy, $r\le300$), or by $-0.04$ to $0.10\,w_m$ (law of Jackson
and Green, $r\le300$).

*Symbols*: displacements $w$ are in units of $\sigma$, loads $P$ in units of $KR^{1/2}\sigma^{3/2}$ and areas $A$ in units of
$\pi R\sigma$, with the tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$ ($E^*$ contact
modulus).
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.engine.bisection import up_to
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.joining import within
from stiction.laws.segment import NormalSegment


@formula
def residual(w_max, load_max, area_max):
    """Return the displacement that remains after unloading, w_max - load_max/sqrt(area_max), at least 0, in units of sigma.

    w_max, load_max, area_max: displacement, load and contact area of a yielded asperity at the turning point, where unloading
    begins. In SI the formula is omega_max - 3 P/(4 E* a). Where a published load jumps up at yield, or an area jumps down, the
    formula can be negative; the result is then 0. This happens for Kogut and Etsion's law up to 1.58 times the displacement at
    first yield. It is also 0 if area_max is not positive.
    """
    if not area_max > 0.0:
        return 0.0
    return max(w_max - load_max / math.sqrt(area_max), 0.0)


@formula
def unloading_response(w, w_max, w_res, load_max, area_max):
    """Return load and contact area of an asperity during unloading, at the displacement w <= w_max; both are 0 below w_res.

    w_max, load_max, area_max: displacement, load and area at the turning point, where unloading begins. w_res: displacement
    that remains at zero load. With s = (w - w_res)/(w_max - w_res) load and area are load_max s^(3/2) and area_max s,
    continuous with loading at w_max. Unless w_res was clipped at 0 (see `residual`), this is Hertz's law P = (4/3) E*
    R'^(1/2) (omega - omega_res)^(3/2) with the flattened radius R' = 4 E* a_max^3/(3 P_max).
    """
    if w <= w_res:
        return 0.0, 0.0
    share = min((w - w_res) / (w_max - w_res), 1.0)
    return load_max * share * math.sqrt(share), area_max * share


_STEP = 1e-6  # for a numerical slope, relative: coordinates are of the order of one, or of the segment's first value
_FARTHEST = 1e6  # the search on an endless segment ends this far beyond its first coordinate


@formula
def _recovery(state):
    return state[0] - residual(state[0], state[2], state[3])


@formula
def _overshoots(state):
    """Return whether the elastic recovery of an asperity during unloading would exceed its displacement; `residual` is then 0.

    state: displacement, its derivative with respect to the coordinate, load and contact area at the end of loading. Differences
    within rounding error are ignored.
    """
    return state[3] > 0.0 and state[2] > (1.0 + 1e-12) * state[0] * math.sqrt(state[3])


@cache
def _unloading_formulas(normal: Callable, coordinate: Callable, parameters: int) -> tuple[Any, Any]:
    """Return the formulas `normal` and `coordinate` of an asperity after unloading.

    normal, coordinate: formulas of its loading law, with `parameters` parameters. The returned formulas take these parameters,
    then the increase of the separation in units of sigma, and the loading coordinate below which asperities have lost contact.
    """

    @formula
    def released(v, *row):
        """Return displacement w, dw/dv, load and contact area of the asperity with the coordinate v after unloading.

        The asperity was loaded to the coordinate u = free + v^2 of the loading law. free: u below which contact is lost, as
        `fill_free` computes it. Just above it the load grows like (u - free)^(3/2), which is smooth in v. row: parameters of
        the loading law, increase of the separation, free.
        """
        w_max, stretch, load_max, area_max = normal(row[parameters + 1] + v * v, *row[:parameters])
        w = w_max - row[parameters]
        load, area = unloading_response(w, w_max, residual(w_max, load_max, area_max), load_max, area_max)
        return w, 2.0 * v * stretch, load, area

    @formula
    def released_coordinate(w, *row):
        return math.sqrt(max(coordinate(w + row[parameters], *row[:parameters]) - row[parameters + 1], 0.0))

    return released, released_coordinate


@cache
def _contact_loss(normal: Callable, parameters: int) -> Any:
    @formula
    def lost_contact(u, arguments):
        row, distance = arguments
        return _recovery(normal(u, *row)) < distance

    search = up_to(lost_contact)

    @lazy_kernel(worth=300)
    def fill_free(distance, table, edges, out):
        """Fill `out` (n,) with the loading coordinate of the asperity that has just lost contact after unloading.

        distance (n,): increase of the separation in units of sigma. table, edges: parameters and edges of the loading segment.
        If all asperities of the segment have lost contact, `out` is its last coordinate. If even the first asperity of the
        segment is still in contact, `out` is extrapolated below the segment along a straight line, or set to the start of the
        segment if the line leads too far. The coordinate after unloading, sqrt(u - out[i]) at the loading coordinate u, is then
        smooth on the segment.
        """
        for i in range(distance.size):
            row = unpack(table[i], parameters)
            low, high = edges[i, 0], edges[i, edges.shape[1] - 1]
            first = _recovery(normal(low, *row))
            if first < distance[i]:
                out[i] = search(low, high, 1.0, _FARTHEST, (row, distance[i]))
                continue
            out[i] = low
            step = _STEP * max(abs(low), 1e-3)
            if high > low + step:
                slope = (_recovery(normal(low + step, *row)) - first) / step
                away = first - distance[i]
                if slope > 0.0 and away < slope * max(abs(low), 1.0):
                    out[i] = low - away / slope

    return fill_free


@cache
def _residual_limit(normal: Callable, parameters: int) -> Any:
    @formula
    def clamped(u, row):
        return _overshoots(normal(u, *row))

    search = up_to(clamped)

    @lazy_kernel(worth=300)
    def fill_clamped(table, edges, out):
        """Fill `out` (n,) with the loading coordinate up to which the residual displacement is limited to 0.

        The limit is explained in `_overshoots`. The coordinate is the first coordinate of the segment if the residual
        displacement is never limited. table, edges: parameters and edges of the loading segment.
        """
        for i in range(out.size):
            low, last = edges[i, 0], edges[i, edges.shape[1] - 1]
            row = unpack(table[i], parameters)
            out[i] = search(low, last, 1e-3, _FARTHEST, row) if last > low else low

    return fill_clamped


def unloaded_segments(segments: list[NormalSegment], distance: np.ndarray) -> list[NormalSegment]:
    """Return the segments of an asperity after loading and an increase of the separation by `distance`.

    distance (n,): in units of sigma. segments: the loading law of an asperity without adhesion. A segment is split where its
    residual displacement begins to be above 0. Summed over heights at the separation h, the returned segments give load and
    area of a surface that was first loaded to the separation h - distance.
    """
    far = np.ascontiguousarray(distance, dtype=float)
    unloaded = []
    for segment in segments:
        laws, count = len(segment.edges), len(segment.parameters)
        released, released_coordinate = _unloading_formulas(segment.normal, segment.coordinate, count)
        table, clamped, free = columns(segment.parameters, laws), np.empty(laws), np.empty(laws)
        _residual_limit(segment.normal, count)(table, np.ascontiguousarray(segment.edges), clamped)
        first, last = segment.edges[:, 0], segment.edges[:, -1]
        parts = [within(segment, first, clamped), within(segment, clamped, last)] if (clamped > first).any() else [segment]
        for part in parts:
            edges = np.ascontiguousarray(part.edges)
            _contact_loss(segment.normal, count)(far, table, edges, free)
            empty = np.isinf(free) | ~(edges[:, -1] > edges[:, 0])
            origin = np.where(empty, 0.0, free)
            edges = np.where(empty[:, None], 0.0, np.sqrt(np.maximum(edges - origin[:, None], 0.0)))
            unloaded.append(
                NormalSegment(released, released_coordinate, (*segment.parameters, far, origin), edges, segment.state)
            )
    return unloaded
