"""Tabulate the mean traction at which a coated asperity first yields, as a spline along its elastic segment.

The tables of `solvers.layered.first_yield` state whether film or body yields under a given mean pressure and mean traction;
the pressure follows from the segment. Knots are evenly spaced in 1 - sqrt(1 - y), where y is ln(1 + p) scaled to 1 at the end
and p is proportional to the square root of the contact radius. They are dense near y = 1, where the load alone causes yield,
because the traction falls to zero within the last few per cent of the pressure. The spline represents the square of the
traction, which is linear in the pressure there.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.bisection import halving
from stiction.engine.compiled import formula, lazy_kernel, unpack
from stiction.engine.regime import columns
from stiction.laws.segment import NormalSegment
from stiction.laws.tangential.shared.even_spline import SEGMENTS, spline, to_coefficients
from stiction.solvers.layered.bodies import Bodies, bodies_of, per_root
from stiction.solvers.layered.first_yield import ANGLES, PLACES, table_of_norms

# Largest p at the end of the spline, so that the knots stay dense near the end.
_FARTHEST = 50.0
_PER_PLACE = (PLACES.size - 1) / 2.0
_ANGLES, _COS, _SIN = ANGLES.size, np.cos(ANGLES), np.sin(ANGLES)
_BENDS = 3
_STEP, _LEAST, _MOST = 1.06, 1e-9, 1e30


@formula
def _norms_at(p, table, angle, film_strength, film):
    """Return the larger of two ratios, one for the film, one for the body: largest von Mises stress divided by yield stress.

    The stress belongs to a mean pressure s and a mean traction q with s^2 + q^2 = 1 in units of the body's yield stress. p:
    (a/t)^(1/2), with the contact radius a and the film thickness t. table: largest stresses in film and body as functions
    of p and angle. angle: index of a ratio q/s in ANGLES. film_strength: yield stress of the film divided by the body's.
    film: 1, or 0 without a film.
    """
    place = min((1.0 + (p - 1.0) / (p + 1.0)) * _PER_PLACE, 2.0 * _PER_PLACE - 1e-9) if p < 1e15 else 2.0 * _PER_PLACE - 1e-9
    knot = int(place)
    share = place - knot
    of_film = film * (table[0, knot, angle] * (1.0 - share) + table[0, knot + 1, angle] * share) / film_strength
    felt = p * p * p * p / (1.0 + p * p * p * p) if p < 1e30 else 1.0
    return max(of_film, felt * (table[1, knot, angle] * (1.0 - share) + table[1, knot + 1, angle] * share))


@formula
def _traction(p, s, table, film_strength, film):
    """Return the squared mean traction at first yield of film or body under a mean pressure s; 0 if s alone causes yield.

    Traction and pressure are in units of the body's yield stress. p, table, film_strength, film: as in `_norms_at`.
    """
    before_s = before_q = 0.0
    for angle in range(_ANGLES):
        norm = _norms_at(p, table, angle, film_strength, film)
        s_2, q_2 = (_COS[angle] / norm) ** 2, (_SIN[angle] / norm) ** 2
        if s_2 <= s * s or angle == _ANGLES - 1:
            if angle == 0:
                return 0.0
            return before_q + (q_2 - before_q) * (before_s - s * s) / (before_s - s_2)
        before_s, before_q = s_2, q_2
    return 0.0


@cache
def _filling(normal: Callable, parameters: int) -> Any:
    @formula
    def holds(u, arguments):
        """Return whether the mean pressure of the asperity at the coordinate u is too small to cause yield without traction.

        arguments: parameters of the asperity, scale and root as in `fill`, and the last arguments of `_norms_at`.
        """
        row, scale, root, table, film_strength, film = arguments
        _, _, load, area = normal(u, *row)
        return load / (scale * area) * _norms_at(root * area**0.25, table, 0, film_strength, film) < 1.0

    halve = halving(holds)

    @lazy_kernel(worth=300)
    def fill(rows, scale, root, film_strength, film, which, tables, place, out):
        """Fill out[i] with the squared mean traction at first yield at the knots of contact i.

        Tractions are in units of the body's yield stress. place[i] is filled with three numbers: u at which the load alone
        causes yield, the factor that converts u to p, and 1/ln(1 + p) at this u. rows: parameters of the elastic segments.
        scale: eta/k, the ratio of load/area to mean pressure/yield stress. root: factor that converts area^(1/4) to
        (a/t)^(1/2). which: index of the contact's table in `tables`. film_strength, film: as in `_norms_at`.
        """
        for i in range(scale.size):
            row, table = unpack(rows[i], parameters), tables[which[i]]
            arguments = row, scale[i], root[i], table, film_strength[i], film[i]
            low = high = _LEAST
            while high < _MOST and holds(high, arguments):
                low = high
                high *= _STEP
            high = halve(low, high, arguments)
            unit = min(root[i], _FARTHEST / high)
            place[i, 0], place[i, 1], place[i, 2] = high, unit, 1.0 / np.log1p(unit * high)
            for knot in range(SEGMENTS + 1):
                left = 1.0 - knot / SEGMENTS
                u = max(np.expm1((1.0 - left * left) / place[i, 2]) / unit, 1e-12 * high)
                _, _, load, area = normal(u, *row)
                s = load / (scale[i] * area)
                out[i, knot] = _traction(root[i] * area**0.25, s, table, film_strength[i], film[i])
            out[i, SEGMENTS] = 0.0

    return fill


def _bends(place: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the coordinates (n, _BENDS) of the knots with the largest second differences of the squared traction at yield.

    These knots are kinks: at them, first yield moves to another part of the asperity. place (n, 3): coordinate at which the
    load alone causes yield, factor from coordinate to p (see the module docstring), and 1/ln(1 + p) there. values (n,
    SEGMENTS + 1): squared traction at the knots.
    """
    bent = np.abs(np.diff(values, n=2, axis=1))
    knots = 1 + np.sort(np.argpartition(bent, -_BENDS, axis=1)[:, -_BENDS:], axis=1)
    left = 1.0 - knots / SEGMENTS
    return np.expm1((1.0 - left * left) / place[:, 2:]) / place[:, 1:2]


def strengths(segment: NormalSegment, groups: Groups) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
    """Return a spline of the squared mean traction at first yield along an elastic segment, and the coordinates of its kinks.

    The spline is a tuple of arrays (n,): u at which the load alone causes yield, then factor and scale of the coordinate
    and the spline coefficients, as `strength_at` takes them. The kinks are an array (n, k), see `_bends`. segment: asperity
    of a film law that solves film and body as one solid. groups: dimensionless groups of n contacts with a film, with all
    defaults filled in.
    """
    laws = len(groups)
    different, which = bodies_of(groups)
    tables = np.exp(np.stack([_table(materials) for materials in different]))
    place, values = np.empty((laws, 3)), np.empty((laws, SEGMENTS + 1))
    there = np.broadcast_to((groups.film_aspect > 0.0) & (groups.tau > 0.0), laws).astype(float)
    scale = np.ascontiguousarray(np.broadcast_to(groups.eta / groups.hardness_to_yield, laws))
    strength = np.ascontiguousarray(np.broadcast_to(groups.n_H, laws))
    fill = _filling(segment.normal, len(segment.parameters))
    fill(columns(segment.parameters, laws), scale, per_root(groups), strength, there, which, tables, place, values)
    return (*place.T, *(values @ to_coefficients().T).T), _bends(place, values)


def _table(bodies: Bodies) -> np.ndarray:
    return table_of_norms(bodies.pair, tuple(dict.fromkeys(bodies.coated)))


@formula
def strength_at(u, unit, scale, coefficients):
    """Return the square of q/Y for the mean tangential traction q at first yield, at the coordinate u.

    Y: yield stress of the body below the film. The result is the spline with `coefficients` at 1 - sqrt(1 - scale ln(1 + unit
    u)), or 0 where the spline is slightly negative near its end. unit, scale: factors from `strengths`.
    """
    y = 1.0 - max(1.0 - np.log1p(unit * u) * scale, 0.0) ** 0.5
    return max(spline(y, coefficients), 0.0)
