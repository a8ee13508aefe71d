"""Compute the elastic compliance of a half-space with a film at each wavenumber, and of two coated bodies in contact.

A pressure p cos(kx) on the bonded film displaces its surface by u = C(k) p cos(kx). With x = k t, t the thickness,

    C = (2/(E1 k)) c(x),  c = [1 + 4 x K e - L K e^2] / [1 - (L + K + 4 K x^2) e + L K e^2],  e = exp(-2 x),

E1 and E2 are the plane-strain moduli E/(1 - nu^2) of film and substrate. Source: the frequency response of a layered half-space
of Nogi & Kato (1997) and O'Sullivan & King (1988), taken from secondary sources. It was re-derived from the continuity of
displacements and tractions at the interface (reference/make_layered.py solves these six equations for one wave at a time). L
and K depend on the elastic constants through Dundurs' two parameters only (Dundurs 1969): K = (alpha - beta)/(1 - beta), L =
(alpha + beta)/(1 + beta). c tends to 1 for short waves, which depend on the film alone, and to E1/E2 for long waves, which
depend on the substrate alone.

Without friction both bodies bear the same pressure and their displacements add. The compliance of a contact is therefore the
sum of the two compliances. This is exact for an elastic counterbody, and for films on two different bodies.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Layer:
    """Describe a film on one of the two bodies.

    share: fraction of the compliance of the two surface materials (as half-spaces) that belongs to this film's material, above
    0, at most 1. ratio: ratio of the plane-strain moduli of film and body below, finite; 0 if that body is rigid. excess: 4
    beta - alpha with Dundurs' parameters alpha and beta, -1 to 1; Poisson's ratios enter only through it.
    """

    share: float
    ratio: float
    excess: float

    @classmethod
    def of(cls, share: float, ratio: float, nu: float, nu_below: float) -> "Layer":
        """Return the Layer of a film with Poisson's ratio nu on a body with Poisson's ratio nu_below, each 0 to 0.5.

        share: compliance of the film material divided by the sum of the compliances of both surface materials. ratio: ratio of
        the plane-strain moduli of film and body.
        """
        return cls(share, ratio, float(poisson_excess(ratio, nu, nu_below)))


Pair = tuple[Layer, ...]
"""One film, or one on each body, all of the same thickness. If their shares sum to less than 1, one body has no film."""


def poisson_excess(ratio, nu, nu_below):
    """Return 4 beta - alpha for arrays, with Dundurs' parameters alpha and beta of a film on a body.

    ratio: E1/E2, the plane-strain moduli of film and body. nu, nu_below: their Poisson's ratios. The result lies in -1 to 1 for
    any ratio. alpha = (E1 - E2)/(E1 + E2); beta = (m (1 - 2 nu_2) - (1 - 2 nu_1))/(2 m (1 - nu_2) + 2 (1 - nu_1)), m the ratio
    of the shear moduli (Dundurs 1969, as commonly restated).
    """
    softness, softness_below = 1.0 - nu, 1.0 - nu_below
    shear = ratio * softness / softness_below
    beta = (shear * (2.0 * softness_below - 1.0) - (2.0 * softness - 1.0)) / (2.0 * (shear * softness_below + softness))
    return 4.0 * beta - (ratio - 1.0) / (ratio + 1.0)


def _film(x: np.ndarray, ratio: float, excess: float) -> np.ndarray:
    """Return the compliance c(x) of a film on a body relative to a half-space of film material.

    x: wavenumber times film thickness. ratio: ratio of the plane-strain moduli of film and body. excess: 4 beta - alpha with
    Dundurs' parameters.
    """
    alpha = (ratio - 1.0) / (ratio + 1.0)
    beta = (excess + alpha) / 4.0
    K, L = (alpha - beta) / (1.0 - beta), (alpha + beta) / (1.0 + beta)
    e = np.exp(-2.0 * x)
    return (1.0 + 4.0 * x * K * e - L * K * e * e) / (1.0 - (L + K + 4.0 * K * x * x) * e + L * K * e * e)


def compliance(x: np.ndarray, pair: Pair) -> np.ndarray:
    """Return the relative elastic compliance (n,) of two coated bodies at the wavenumbers k = x/t, for x (n,).

    t: film thickness (the same for all films). pair: the films. The compliance is divided by the compliance of half-spaces of
    the two surface materials.
    """
    total = np.full(np.shape(x), 1.0 - sum(layer.share for layer in pair))
    for layer in pair:
        total += layer.share * _film(x, layer.ratio, layer.excess)
    return total


def modulus_without_film(pair: Pair) -> float:
    """Return the contact modulus of the bodies without films relative to half-spaces of their surface materials.

    The result is infinite if both bodies are rigid.
    """
    long_waves = 1.0 - sum(layer.share * (1.0 - layer.ratio) for layer in pair)
    return 1.0 / long_waves if long_waves > 0.0 else np.inf
