"""How much of the work of adhesion opens the edge of a contact while shear is released there too.

At the edge of an adhesive contact that is sheared, pressure releases the energy G_N per area and shear G_T. With x = G_T/w and
the phase angle tan^2(psi) = x/y, where y = G_N/w is what the normal contact still has to release, the edge rests where

    x + y = f(psi)                                                                                                        (1)

The functions f are those of Hutchinson & Suo (1992, Adv. Appl. Mech. 29, 63, section III), written from memory and not compared
with print (grade C), with the share zeta of G_T that opens the edge, 0 to 1:

    savkoor_briggs_1977         1/[1 + (zeta - 1) sin^2 psi]        y = 1 - zeta x                                        (2)
    waters_guduru_2010          1 + tan^2[(1 - zeta) psi]           y = (cos psi/cos[(1 - zeta) psi])^2                   (3)
    papangelo_ciavarella_2018   1 + (1 - zeta) tan^2 psi            y = {1 - x + [(1 - x)^2 + 4 (1 - zeta) x]^(1/2)}/2    (4)
    menga_carbone_dini_2018     shear releases nothing              y = 1                                                 (5)

zeta = 1 in (2) is Savkoor & Briggs (1977), a brittle edge. (2) to (4) are the three that Papangelo & Ciavarella compare
(2018, arXiv:1809.10676; abstract read), which end in different ways: in a leap, at Hertz's contact, or never. (5): under a
uniform shear stress the area stays (Menga, Carbone & Dini 2018, J. Mech. Phys. Solids 112, 145, with the corrigendum of 2019,
133, 103744). The physics is disputed (Cricri & Ciavarella 2019, arXiv:1908.04490, find with the same energies that the area
falls), and measured contacts shrink less than (2) says with zeta = 1. None is recommended.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

__all__ = ["MODE_MIXITIES", "ModeMixity"]

_ANGLES = np.linspace(0.0, 0.5 * math.pi, 4001)


@dataclass(frozen=True)
class ModeMixity:
    """A law of the edge.

    share: returns y from x = G_T/w, of any shape, and zeta; grade and source: of the law; evidence: what it was compared with.
    """

    share: Callable[[np.ndarray, float], np.ndarray]
    grade: str
    source: str
    evidence: str


def _brittle(x: np.ndarray, zeta: float) -> np.ndarray:
    return np.maximum(1.0 - zeta * x, 0.0)


def _by_phase(x: np.ndarray, zeta: float) -> np.ndarray:
    narrow = np.cos((1.0 - zeta) * _ANGLES)
    if zeta == 0.0:  # cos psi in both: nothing opens the edge
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
"""Laws of the edge by their key; without one, shear leaves the adhesion alone."""
