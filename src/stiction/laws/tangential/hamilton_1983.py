"""Tangential force at which a Hertz contact first yields anywhere, on its surface or below: Hamilton's stresses, von Mises.

With s = p0/Y and q = q0/Y, the largest pressure and shear traction over the yield stress, a contact yields at the least q at
which the von Mises stress is Y at some place. The place is one of three, in turn as s grows:
- inside the contact, from the centre (s = 0, q = 1/sqrt(3)) towards the trailing edge. There s counts only as (1 - 2 nu) s;
- the trailing edge itself, a closed form; Poisson's ratios above 0.39 or so skip it;
- below the surface, ahead of the axis, until the load alone yields (s = F, q = 0), where q vanishes like sqrt(F - s).
The first and the third have no closed form. They are Chebyshev series in s and nu, made once from the stresses themselves.
"""

import math
from dataclasses import replace
from functools import cache, lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.joining import coordinates
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.laws.registry import TangentialLaw
from stiction.laws.sources import Source
from stiction.laws.tangential.shared.edge_yield import yield_resistance
from stiction.laws.tangential.shared.hamilton_field import Stress, dragged, least_over, pressed, von_mises

# Terms of the series in s, and in nu from 0 to 0.5.
INSIDE, BELOW, IN_NU = 14, 15, 20


def inside_reach(nu):
    """Up to this (1 - 2 nu) p0/Y the series for a place inside the contact is made: it is in use up to 1 to 7 % less."""
    return 0.205 + 0.33 * nu


def below_reach(nu):
    """The series for a place below the surface is made from p0/Y = (1 - this) F on, which is up to 2 % of F too early."""
    return 0.012 + 0.22 * nu


def shear_at_yield(s, nu, x, z) -> np.ndarray:
    """q0/Y at which the place (x, z) over a yields at p0/Y = s (infinite if never): the square of the von Mises stress is a
    square form in s and q."""
    return _root(s, *_forms(nu, x, z))


def _forms(nu, x, z) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What s^2, 2 s q and q^2 are multiplied by in the square of the von Mises stress at a place, over Y^2."""
    normal, tangential = pressed(x, 0.0, z, nu), dragged(x, 0.0, z, nu)
    return _product(normal, normal), _product(normal, tangential), _product(tangential, tangential)


def _root(s, of_s, of_both, C) -> np.ndarray:
    """The larger root q of C q^2 + 2 B q + A = 0, in whichever way does not cancel."""
    A, B = s * s * of_s - 1.0, s * of_both
    root = np.sqrt(np.maximum(B * B - A * C, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(C > 0.0, np.where(B > 0.0, -A / (B + root), (root - B) / C), np.inf)


def _product(one: Stress, other: Stress) -> np.ndarray:
    """Of two stresses: 3/2 of their deviators' double contraction; of one with itself, the square of its von Mises stress."""
    shear = one[3] * other[3] + one[4] * other[4] + one[5] * other[5]
    mean = (one[0] + one[1] + one[2]) * (other[0] + other[1] + other[2]) / 3.0
    return 1.5 * (one[0] * other[0] + one[1] * other[1] + one[2] * other[2] - mean) + 3.0 * shear


@cache
def first_yield_of_load() -> np.ndarray:
    """F = p0/Y at which the load alone yields: coefficients (IN_NU,) of a Chebyshev series in 4 nu - 1."""
    nu = (1.0 + chebyshev.chebpts1(IN_NU)) / 4.0
    largest = least_over(lambda x, z: -von_mises(pressed(x, 0.0, z, nu[:, None])), np.zeros(IN_NU), 0.48, 0.0, 0.1)[2]
    return _fit(-1.0 / largest[None, :])[0]


@cache
def series_inside() -> np.ndarray:
    """q/Y where the place is inside the contact: Chebyshev coefficients (INSIDE, IN_NU) in 2 y - 1 and 4 nu - 1, with
    y = (1 - 2 nu) s / inside_reach(nu)."""
    y, nu = _nodes(INSIDE)
    # At nu = 0.5 every y but 0 is beyond reach, yet the stresses on the surface know s only as (1 - 2 nu) s.
    s = y * inside_reach(nu) / (1.0 - 2.0 * nu)
    return _fit(_least(s, nu, np.linspace(-0.8, 0.1, 19), 0.0, 0.05, 0.0))


@cache
def series_below() -> np.ndarray:
    """(q/Y)^2/y where the place is below the surface: Chebyshev coefficients (BELOW, IN_NU) in 2 y - 1 and 4 nu - 1, with
    y = (1 - s/F) / below_reach(nu)."""
    y, nu = _nodes(BELOW)
    s = chebyshev.chebval(4.0 * nu - 1.0, first_yield_of_load()) * (1.0 - y * below_reach(nu))

    return _fit(_least(s, nu, np.linspace(0.0, 1.0, 11), np.linspace(0.3, 0.6, 4)[:, None], 0.1, 0.1) ** 2 / y)


def _least(s, nu, x, z, reach_x: float, reach_z: float) -> np.ndarray:
    """The least shear at which any place yields, of those near the best of x, z: an array like s and nu."""

    def shear(x, z):
        return shear_at_yield(s[..., None], nu[..., None], x, z)

    x, z = (one.ravel() for one in np.broadcast_arrays(x, z))
    best = shear(x, z).argmin(axis=-1)
    return least_over(shear, x[best], z[best], reach_x, reach_z)[2]


def _nodes(terms: int) -> tuple[np.ndarray, np.ndarray]:
    """y (terms, 1) and nu (1, IN_NU) at Chebyshev's points of [0, 1] and [0, 0.5], broadcast against each other."""
    y, nu = (1.0 + chebyshev.chebpts1(terms)) / 2.0, (1.0 + chebyshev.chebpts1(IN_NU)) / 4.0
    return np.meshgrid(y, nu, indexing="ij")


def _fit(values: np.ndarray) -> np.ndarray:
    """Chebyshev coefficients of what has these values (y, nu) at the nodes."""
    for axis in (0, 1):
        count = values.shape[axis]
        basis = chebyshev.chebvander(chebyshev.chebpts1(count), count - 1)
        values = np.moveaxis(np.tensordot(np.linalg.inv(basis), values, axes=(1, axis)), 0, axis)
    return values


@formula
def _sum_inside(y, series):
    """The series of INSIDE terms at 2 y - 1, after Clenshaw."""
    t = 4.0 * y - 2.0
    last = before = 0.0
    for at in range(INSIDE - 1, 0, -1):
        last, before = series[at] + t * last - before, last
    return series[0] + 0.5 * t * last - before


@formula
def _sum_below(y, series):
    """The series of BELOW terms, which follows that of INSIDE terms."""
    t = 4.0 * y - 2.0
    last = before = 0.0
    for at in range(BELOW - 1, 0, -1):
        last, before = series[INSIDE + at] + t * last - before, last
    return series[INSIDE] + 0.5 * t * last - before


@formula
def resistance(u, w, load, area, eta, k, nu, inside_until, below_from, end, to_inside, to_below, *series):
    """Q = (q0/p0) P. s = p0/Y = 1.5 k P/(eta x): the mean pressure is H where P = eta x (docs/theory.md), and H = k Y."""
    strength = eta * area / k  # the load at which the mean pressure is Y
    s = 1.5 * load / strength if area > 0.0 else 0.0
    if s >= end:
        return 0.0, 0.0
    if s >= below_from:
        y = (1.0 - s / end) * to_below
        return 0.0, strength / 1.5 * (y * _sum_below(y, series)) ** 0.5
    if s >= inside_until:
        return 0.0, yield_resistance(load, strength / math.pi, nu)
    return 0.0, strength / 1.5 * _sum_inside(s * to_inside, series)


def series_for(nu: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What `resistance` wants for each Poisson's ratio (n,): inside_until, below_from, end, to_inside and to_below (5, n), and
    the series (INSIDE + BELOW, n)."""
    known, which = np.unique(nu, return_inverse=True)
    steps, series = _series_for(known.tobytes())
    return steps[:, which], series[:, which]


@lru_cache(maxsize=16)
def _series_for(nu_bytes: bytes) -> tuple[np.ndarray, np.ndarray]:
    nu = np.frombuffer(nu_bytes)
    t = 4.0 * nu - 1.0
    inside, below = chebyshev.chebval(t, series_inside().T), chebyshev.chebval(t, series_below().T)
    end = chebyshev.chebval(t, first_yield_of_load())

    def q_inside(s):
        return chebyshev.chebval(2.0 * s * (1.0 - 2.0 * nu) / inside_reach(nu) - 1.0, inside, tensor=False)

    def q_below(s):
        y = (1.0 - s / end) / below_reach(nu)
        return np.sqrt(y * chebyshev.chebval(2.0 * y - 1.0, below, tensor=False))

    at_edge = _forms(nu, -1.0, 0.0)

    # Each of the three falls with s, that below the surface from above the others to zero, that at the edge least steeply.
    first = end * (1.0 - below_reach(nu))
    reach = np.minimum(inside_reach(nu) / np.maximum(1.0 - 2.0 * nu, 1e-300), end)
    inside_until = _crossing(lambda s: q_inside(s) >= _root(s, *at_edge), np.zeros_like(nu), reach)

    def is_below(s):
        return q_below(s) <= np.minimum(np.where(s < reach, q_inside(s), np.inf), _root(s, *at_edge))

    below_from = _crossing(is_below, first, end)
    scale = (1.0 - 2.0 * nu) / inside_reach(nu), 1.0 / below_reach(nu)
    return np.stack([np.minimum(inside_until, below_from), below_from, end, *scale]), np.concatenate([inside, below])


def _crossing(passed, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Where `passed` turns true between low and high, or high if it does not: bisection of arrays. To 1e-10 of the
    range: the resistance is continuous, so a kink put wrong by that much is felt in the square of it only."""
    for _ in range(34):
        middle = 0.5 * (low + high)
        beyond = passed(middle)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return high


def tangential_resistance(piece: NormalPiece, groups: Groups) -> TangentialResistance | None:
    """The force at which an elastic asperity first yields; one that has yielded resists nothing."""
    if piece.state != "elastic":
        return None
    eta, k = groups.eta, groups.hardness_to_yield
    steps, series = series_for(groups.nu)
    endless = replace(piece, edges=np.stack([piece.edges[:, 0], np.full(len(eta), np.inf)], axis=1))
    # Hertz: p0/Y = 1.5 k sqrt(w)/eta. A kink beyond the piece is left where it is: near its end it is still felt.
    kinks = np.stack([coordinates(endless, (s * eta / (1.5 * k)) ** 2) for s in steps[:3]], axis=1)
    return TangentialResistance(resistance, (eta, k, groups.nu, *steps, *series), kinks, branch=kinks[:, 2:])


RECORD = TangentialLaw(
    key="hamilton_1983",
    title="First yield anywhere in a pressed and sheared Hertz contact",
    grade="B",
    sources=(Source("hamilton_1983", "stresses under the normal and the tangential load", "with the von Mises criterion"),),
    tangential_resistance=tangential_resistance,
    verified="stresses: equilibrium, tractions, point loads integrated independently; first yield found by search",
    needs=("theta", "lam", "nu", "hardness_to_yield"),
    accuracy=1e-9,
    wants={
        "Hertz": "Hamilton's stresses are those of Hertz's pressure and a traction proportional to it",
        "no adhesion": "adhesion changes the pressure and its stresses",
    },
    notes="The largest shear force without yield anywhere in the asperity; one that yields under its load alone bears none.",
)
