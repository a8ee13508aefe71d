"""Bush, Gibson & Thomas 1975: the summits of an isotropic Gaussian surface as elastic paraboloids of two curvatures.

Each summit is pressed as Hertz's ellipse. Nayak's density of height and curvatures (surfaces.theory.summits) sums them. The
paper's own result for the light load is that area and load become proportional, A/A0 = sqrt(2 pi) p / (E* h').
"""

import math
from functools import cache

import numpy as np
from scipy.special import ellipe, ellipkm1

from stiction.contact.indices import Groups
from stiction.laws.registry import RoughSurface, Validity
from stiction.laws.sources import Source
from stiction.surfaces.theory import summits
from stiction.surfaces.theory.moments import LEAST_DENSITY
from stiction.surfaces.theory.summits import Shapes


@cache
def ellipses() -> Shapes:
    """Hertz's ellipse with the axes b <= a, against the flatness t of the summit; Gauss points in (b/a)^(1/3).

    Johnson 1985, section 4.2(c): with e^2 = 1 - b^2/a^2, complete elliptic integrals K(e) and E(e), overlap w, greatest
    pressure p0, and half the principal curvatures, A = (kappa - r)/2 and B = (kappa + r)/2,
        w = (p0 / E*) b K,   A = (p0 / E*) b (K - E) / (e^2 a^2),   B = (p0 / E*) b (E a^2/b^2 - K) / (e^2 a^2).
    A + B = kappa gives a^2 = w E / (K kappa b^2/a^2), hence the area pi a b and the load (2/3) pi a b p0; B - A = r gives t.
    The ellipse grows long, and the integrand of surfaces.theory.summits falls to zero, as t goes to 1.
    """
    node, weight = np.polynomial.legendre.leggauss(120)
    root = (1.0 + node) / 2.0
    ratio, dratio = root**3, 1.5 * root**2 * weight
    m1 = ratio * ratio  # b^2/a^2
    m = 1.0 - m1  # e^2
    K, E = ellipkm1(m1), ellipe(m)
    dK, dE = (E - m1 * K) / (2.0 * m * m1), (E - K) / (2.0 * m)  # by m
    t = (E * (1.0 + m1) - 2.0 * K * m1) / (E * m)
    # t = (1 + m1 - 2 m1 K/E) / m and dm/dratio = -2 ratio
    dt = (-1.0 + 2.0 * K / E - 2.0 * m1 * (dK * E - K * dE) / (E * E) - t) / m
    return Shapes(
        t=t,
        weight=dratio * 2.0 * ratio * dt,
        load=math.pi / (2.0 * K) * np.sqrt(E / (K * m1)),
        area=E / (K * ratio),
    )


def curve(h: np.ndarray, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Load and area (n, H) at separations h (H,) from the mean of the summits."""
    return summits.curve(h, groups.roughness_parameter, ellipses)


RECORD = RoughSurface(
    key="bush_gibson_thomas_1975",
    title="Elastic contact of a rough surface: elliptic summits of a Gaussian surface",
    grade="B",
    sources=(
        Source("bush_gibson_thomas_1975", "", "summed here from Nayak's density; the proportional light load is theirs"),
        Source("nayak_1971", "", "joint density of height and curvatures of the summits"),
        Source("johnson_1985", "section 4.2(c), Hertz's ellipse"),
    ),
    curve=curve,
    takes_surface_moments=True,
    verified="adaptive integrals over height and both curvatures; A/A0 = sqrt(2 pi) p/(E* h') at light load",
    needs=("roughness_parameter",),
    validity=(
        Validity(
            "roughness_parameter", LEAST_DENSITY, math.inf, "no isotropic Gaussian surface has fewer asperities N R sigma"
        ),
        Validity("plasticity_index", 0.0, 0.6, "summits are taken as elastic"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    notes=(
        "The asperities are the summits of an isotropic Gaussian surface with the same sigma, N and mean curvature 1/R. "
        "Separation is from the mean of the summits. Area is proportional to load only at very large separations."
    ),
)
