"""Tangential force at which a Hertz contact first yields, on its axis or at its trailing edge: Chang, Etsion & Bogy 1988.

Hamilton's stresses under P and Q = mu P, von Mises, Y = 0.354 H; as restated by Eriten et al. 2010. w_ratio = omega/omega_c.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula, kernel
from stiction.laws.asperity.chang_etsion_bogy_1987 import critical_interference, hardness_coefficient
from stiction.laws.joining import coordinates
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.laws.registry import TangentialLaw, Validity
from stiction.laws.sources import Source

# Both come from Y/H = 0.354 and are kept as rounded in print: 0.354/sqrt(3) and 4.5 (0.354)^2 would be 0.20438 and 0.56392.
_ON_AXIS, _AT_EDGE = 0.2045, 0.56


@formula
def axis_coefficient(nu):
    """c1 = -1 + (3/2) z atan(1/z) - z^2 / (2 (1 + z^2)), tangential shear stress on the axis at the depth z a of first yield;
    z = 0.48 is that depth for nu = 0.3, which the authors keep for all."""
    z = 0.48
    return -1.0 + 1.5 * z * math.atan(1.0 / z) - z * z / (2.0 * (1.0 + z * z))


@formula
def on_axis(w_ratio, nu, K_H):
    """Q/P at which the axis yields: (f p0)^2 + 3 (c1 q0)^2 = Y^2."""
    return _ON_AXIS / (K_H * abs(axis_coefficient(nu))) * math.sqrt(max(1.0 / w_ratio - 1.0, 0.0))


@formula
def at_edge(w_ratio, nu, K_H):
    """Q/P at which the trailing edge yields: c3 mu^2 + c4 mu + c5 = 0."""
    c3 = 9.0 * math.pi * math.pi / 16.0 * (2.0 - nu / 2.0 + 7.0 / 8.0 * nu * nu)
    c4 = 9.0 * math.pi / 4.0 * (1.0 - 2.0 * nu) * (1.0 - nu / 2.0)
    c5 = 1.5 * (1.0 - 2.0 * nu) * (1.0 - 2.0 * nu) - _AT_EDGE / (K_H * K_H * w_ratio)
    return (math.sqrt(max(c4 * c4 - 4.0 * c3 * c5, 0.0)) - c4) / (2.0 * c3)


@formula
def friction_coefficient(w_ratio, nu, K_H):
    """Q/P of one asperity at the onset of yield under both forces; zero where P alone yields (w_ratio >= 1)."""
    return min(on_axis(w_ratio, nu, K_H), at_edge(w_ratio, nu, K_H)) if w_ratio < 1.0 else 0.0


@kernel
def _fill_first_on_axis(nu, K_H, out):
    for i in range(nu.size):
        low, high = 0.5, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            if on_axis(middle, nu[i], K_H[i]) > at_edge(middle, nu[i], K_H[i]):
                low = middle
            else:
                high = middle
        out[i] = high


def first_on_axis(nu: np.ndarray, K_H: np.ndarray) -> np.ndarray:
    """omega/omega_c (n,) from which the axis yields before the edge: 0.9512 for nu = 0.3. Bisection; there is one."""
    out = np.empty_like(nu)
    _fill_first_on_axis(nu, K_H, out)
    return out


@formula
def resistance(u, w, load, area, w_c, nu, K_H):
    """mu P, all of it limited by yield; nothing before first touch, where mu has no bound, nor from w_c on."""
    return 0.0, load * friction_coefficient(w / w_c, nu, K_H) if 0.0 < w < w_c else 0.0


def tangential_resistance(piece: NormalPiece, groups: Groups) -> TangentialResistance | None:
    """On any piece that starts elastic: the condition is on Hertz's stresses, and nothing withstands beyond first yield."""
    if piece.state == "plastic":
        return None
    K_H = hardness_coefficient(groups.nu)
    w_c = critical_interference(groups.eta, K_H)
    # The yielding place moves from the edge to the axis; there the resistance ends like a square root of w_c - w.
    kinks = [coordinates(piece, w) for w in (first_on_axis(groups.nu, K_H) * w_c, w_c)]
    return TangentialResistance(resistance, (w_c, groups.nu, K_H), np.stack(kinks, axis=1), kinks[1][:, None])


RECORD = TangentialLaw(
    key="chang_etsion_bogy_1988",
    title="First yield of a Hertz contact under load and shear, on its axis or at its trailing edge",
    grade="B",
    sources=(
        Source("chang_etsion_bogy_1988", "", "stress criteria as restated by Eriten, Polycarpou & Bergman 2010"),
        Source("hamilton_1983", "stresses on the axis and at the edge"),
    ),
    tangential_resistance=tangential_resistance,
    wants={
        "Hertz": "the stresses are those of a Hertz contact",
        "no adhesion": "adhesion of the 1988 papers is left out",
    },
    verified="friction of single asperities tabulated independently; evaluation at 30 digits",
    needs=("theta", "lam", "nu"),
    validity=(Validity("plasticity_index", 0.0, 0.6, "plastic asperities are given no friction: mu falls to nothing above"),),
    notes="The critical interference is that of Chang, Etsion and Bogy, whichever law carries the load; from there on an "
    "asperity resists nothing. Only two places are asked whether they yield: the axis at one depth, and the trailing edge.",
)
