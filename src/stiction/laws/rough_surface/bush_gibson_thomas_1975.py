r"""The summits of an isotropic Gaussian surface as elastic paraboloids of two curvatures: Bush, Gibson & Thomas 1975.

*Assumes*: the asperities are the summits of an isotropic Gaussian surface with the spectral moments $m_0$, $m_2$, $m_4$ of its
profile. Each is an elastic paraboloid with two principal curvatures and has a Hertzian elliptic contact. *Source*:
[bush_gibson_thomas_1975], and [nayak_1971] for the number of summits per area by height $z$, mean curvature $\kappa_m$ and
half-difference $r$ of the principal curvatures. This density is integrated here ($\phi$ is the joint Gaussian density of $z$
and $\kappa_m$ with the variances $m_0$ and $2s^2$, the covariance $m_2$ and $s^2=m_4/3$):

$$
\frac1{2\pi m_2}\,\phi(z,\kappa_m)\,\frac r{s^2}e^{-r^2/(2s^2)}\,(\kappa_m^2-r^2),\qquad0<r<\kappa_m
$$

Its summits have the height deviation $\sigma$, the number per area $N$ and the mean curvature $1/R$ of the contact. Below
$\rho=NR\sigma=0.01581$ no such surface exists, and an error is raised. The paper's own result is that area and load become
proportional: $\kappa$ in $A/A_n=\kappa\,p/(E^*h')$ tends to $\sqrt{2\pi}=2.5066$ at light load, slowly and from below, so that
area and load are proportional only at separations larger than in any real contact. $A/A_n$ is contact area divided by nominal
area, $p$ the nominal pressure, $E^*$ the contact modulus and $h'$ the root mean square gradient. *Check*: $\kappa$ of this and
of the simplified model [`greenwood_2006`](#greenwood_2006) for the bandwidth parameter $\alpha=m_0m_4/m_2^2$ at the separation
$h$ (in units of $\sigma$, from the mean summit height):

| $\alpha$ ($\rho$) | $\kappa$ at $h=0$ | 1 | 2 | 3 | 4 |
|---|---|---|---|---|---|
| 2 (0.02138), Bush et al. | 2.271 | 2.375 | 2.427 | 2.453 | 2.468 |
| 2, Greenwood | 2.336 | 2.424 | 2.462 | 2.479 | 2.487 |
| 5 (0.04124), Bush et al. | 1.841 | 2.054 | 2.214 | 2.321 | 2.388 |
| 5, Greenwood | 1.914 | 2.125 | 2.278 | 2.375 | 2.430 |
| 10 (0.06142), Bush et al. | 1.560 | 1.781 | 1.970 | 2.120 | 2.232 |
| 10, Greenwood | 1.628 | 1.852 | 2.041 | 2.187 | 2.292 |
"""

import math
from functools import cache

import numpy as np
from scipy.special import ellipe, ellipkm1

from stiction.contact.indices import Groups
from stiction.laws.shared_claims import ELASTIC, ENOUGH_SUMMITS
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source
from stiction.surfaces.theory import summits
from stiction.surfaces.theory.start_table import separation_of_summits
from stiction.surfaces.theory.summits import Shapes


@cache
def ellipses() -> Shapes:
    """Return Hertz's elliptic contacts of summits, tabulated against the asymmetry t of the principal curvatures of a summit.

    t = r/kappa is half the difference of the curvatures divided by their mean: 0 for a round summit, 1 for a ridge. Johnson
    1985, section 4.2(c): with the semi-axes b <= a of the ellipse, e^2 = 1 - b^2/a^2, complete elliptic integrals K(e) and
    E(e), overlap w, largest pressure p0, and half the principal curvatures, A = (kappa - r)/2 and B = (kappa + r)/2,

        w = (p0 / E*) b K,   A = (p0 / E*) b (K - E) / (e^2 a^2),   B = (p0 / E*) b (E a^2/b^2 - K) / (e^2 a^2).

    A + B = kappa gives a^2 = w E / (K kappa b^2/a^2), and so the area pi a b and the load (2/3) pi a b p0; B - A = r gives t.
    As t tends to 1, the ellipse becomes long and the integrand of stiction.surfaces.theory.summits tends to zero. The values
    of t are Gauss points in (b/a)^(1/3).
    """
    node, weight = np.polynomial.legendre.leggauss(120)
    root = (1.0 + node) / 2.0
    ratio, dratio = root**3, 1.5 * root**2 * weight
    m1 = ratio * ratio  # b^2/a^2
    m = 1.0 - m1  # e^2
    K, E = ellipkm1(m1), ellipe(m)
    dK, dE = (E - m1 * K) / (2.0 * m * m1), (E - K) / (2.0 * m)  # derivatives with respect to m
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
    """Return load and contact area (n, H) per asperity at H separations of n contacts.

    h: separation in units of sigma from the mean summit height, (H,) or (n, H). Units: loads in K R^(1/2) sigma^(3/2), areas in
    pi R sigma. Raises InputError if no isotropic Gaussian surface has the N R sigma of a contact.
    """
    return summits.curve(h, groups.roughness_parameter, ellipses)


def separation_near(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return approximate separations (n, H), in units of sigma, at the loads (n, H), as starting values for a search.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). The result is NaN for loads of 0 or less. Raises InputError as
    `curve` does.
    """
    return separation_of_summits(load, groups.roughness_parameter, ellipses)


RECORD = RoughSurface(
    key="bush_gibson_thomas_1975",
    title="Elastic contact of a rough surface: elliptic summits of a Gaussian surface",
    grade="B",
    sources=(
        Source(
            "bush_gibson_thomas_1975",
            "",
            "integrated here over Nayak's density; area proportional to light load by the authors",
        ),
        Source("nayak_1971", "", "joint density of height and curvatures of the summits"),
        Source("johnson_1985", "section 4.2(c), Hertz's ellipse"),
    ),
    curve=curve,
    separation_near=separation_near,
    takes_surface_moments=True,
    verified="independent adaptive integration over height and both curvatures; A/A0 = sqrt(2 pi) p/(E* h') at light load",
    needs=("roughness_parameter",),
    validity=(
        ENOUGH_SUMMITS,
        ELASTIC,
    ),
    notes=(
        "The asperities are the summits of an isotropic Gaussian surface with the given sigma, N and mean curvature 1/R. "
        "The separation is from the mean summit height. Area is proportional to load only at very large separations."
    ),
)
