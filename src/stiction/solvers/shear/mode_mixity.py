"""Define how shear lowers the work of adhesion at the edge of a contact (mode mixity).

At the sheared edge of an adhesive contact, pressure releases the energy G_N per area and shear releases G_T. w is the work of
adhesion. With x = G_T/w, y = G_N/w and the phase angle psi, tan^2(psi) = x/y, the edge is in equilibrium where

    x + y = f(psi)                                                                                                        (1)

y is the fraction of w that remains for the normal contact. The functions f are those of Hutchinson & Suo (1992, Adv. Appl.
Mech. 29, 63, section III), written from memory and not compared with the printed equations (grade C, (2) grade B). zeta is the
fraction of G_T that opens the edge, 0 to 1:

    savkoor_briggs_1977         1/[1 + (zeta - 1) sin^2 psi]        y = 1 - zeta x                                        (2)
    waters_guduru_2010          1 + tan^2[(1 - zeta) psi]           y = (cos psi/cos[(1 - zeta) psi])^2                   (3)
    papangelo_ciavarella_2018   1 + (1 - zeta) tan^2 psi            y = {1 - x + [(1 - x)^2 + 4 (1 - zeta) x]^(1/2)}/2    (4)
    menga_carbone_dini_2018     shear releases nothing              y = 1                                                 (5)

(2) with zeta = 1 is Savkoor & Briggs (1977), a brittle edge. Papangelo & Ciavarella (2018, arXiv:1809.10676; abstract read)
compare the laws (2), (3) and (4), under which contact ends by a jump, at Hertz's contact, or never. (5): under a uniform shear
stress the area does not change (Menga, Carbone & Dini 2018, J. Mech. Phys. Solids 112, 145, with the corrigendum of 2019, 133,
103744). The physics is disputed: Cricri & Ciavarella (2019, arXiv:1908.04490) find with the same energies that the area falls.
Measured contacts shrink less than (2) with zeta = 1. No law is recommended.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

__all__ = ["MODE_MIXITIES", "ModeMixity"]

_ANGLES = np.linspace(0.0, 0.5 * math.pi, 4001)


@dataclass(frozen=True)
class ModeMixity:
    """Define a law of mode mixity: how shear lowers the work of adhesion at the edge of a contact.

    share: function (x, zeta) that returns the remaining fraction of the work of adhesion. x (any shape) is the energy that
    shear releases per area divided by the work of adhesion, zeta the fraction of this energy that opens the edge, 0 to 1.
    grade: a key of `claims.GRADES`, which states how the law was checked. source: publication. evidence: what the law was
    compared with.
    """

    share: Callable[[np.ndarray, float], np.ndarray]
    grade: str
    source: str
    evidence: str


def _brittle(x: np.ndarray, zeta: float) -> np.ndarray:
    return np.maximum(1.0 - zeta * x, 0.0)


def _by_phase(x: np.ndarray, zeta: float) -> np.ndarray:
    narrow = np.cos((1.0 - zeta) * _ANGLES)
    if zeta == 0.0:  # shear does not open the edge, and the interpolation below would divide by zero
        return np.ones_like(x)
    return np.interp(x, (np.sin(_ANGLES) / narrow) ** 2, (np.cos(_ANGLES) / narrow) ** 2)


def _endless(x: np.ndarray, zeta: float) -> np.ndarray:
    left = 1.0 - x
    return 0.5 * (left + np.sqrt(left**2 + 4.0 * (1.0 - zeta) * x))


def _unchanged(x: np.ndarray, zeta: float) -> np.ndarray:
    return np.ones_like(x)


MODE_MIXITIES: Mapping[str, ModeMixity] = {
    "savkoor_briggs_1977": ModeMixity(_brittle, "B", "Savkoor & Briggs 1977", "measured contacts shrink less with zeta = 1"),
    "waters_guduru_2010": ModeMixity(_by_phase, "C", "Waters & Guduru 2010", "function from memory; not compared with data"),
    "papangelo_ciavarella_2018": ModeMixity(
        _endless, "C", "Papangelo & Ciavarella 2018", "function from memory; not compared with data"
    ),
    "menga_carbone_dini_2018": ModeMixity(
        _unchanged,
        "C",
        "Menga, Carbone & Dini 2018, corrigendum 2019",
        "PDMS spheres that slide slowly keep JKR's area; disputed",
    ),
}
"""Laws of mode mixity by their key; if none is chosen, shear does not change the adhesion."""
