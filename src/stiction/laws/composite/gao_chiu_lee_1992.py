r"""Modulus of a film and its substrate together, by perturbation of the homogeneous half-space: Gao, Chiu & Lee 1992.

*Assumes*: film and substrate differ little in modulus; the solution is a perturbation of the homogeneous half-space under a
flat punch. *Source*: [gao_chiu_lee_1992], as restated by the documentation of the NIMS toolbox. $E'=E/(1-\nu^2)$ is the reduced
modulus; indices $f$ and $s$ denote film and substrate, no index both together. With the film thickness $t$, the punch radius
$a$ and $\xi=t/a$, $I_0$ is the weight of the film in the modulus and $I_1$ its weight in Poisson's ratio:

$$
\frac{E'}{E'_s}=1+\left(\frac{E'_f}{E'_s}-1\right)I_0,\qquad
I_0=\frac2\pi\arctan\xi+\frac1{2\pi(1-\nu)}\left[(1-2\nu)\,\xi\ln\frac{1+\xi^2}{\xi^2}-\frac\xi{1+\xi^2}\right]
$$

$$
1-\nu=\frac{(1-\nu_s)(1-\nu_f)}{1-(1-I_1)\nu_f-I_1\nu_s},\qquad I_1=\frac2\pi\arctan\xi+\frac\xi\pi\ln\frac{1+\xi^2}{\xi^2}
$$

*Trap*: the restatement has two misprints, $\nu=1+[\ldots]$ for $1-[\ldots]$ and $a/t$ for $\xi$. The film law
[`graded`](#graded) uses the mean of both Poisson's ratios instead. If the moduli differ by more than a factor of two, the
formula deviates from numerical solutions.
"""

import math

from stiction.engine.compiled import formula
from stiction.engine.vectorised import arctan, log_quotient
from stiction.records.registry import Composite, Validity
from stiction.records.sources import Source

_LEAST, _MOST = 1e-100, 1e100  # bounds of t/a, whose squares neither vanish nor overflow


@formula
def modulus_share(v, nu):
    """Return the film's weight I0 in the modulus, between 0 and 1, and its derivative with respect to ln v.

    v: contact radius divided by film thickness, a/t >= 0. nu: Poisson's ratio of film and substrate together. Source: Gao,
    Chiu & Lee 1992 (S5.12).
    """
    r = 1.0 / (1.0 + v * v)
    quotient = log_quotient(v * v)
    b, c = 1.0 / (2.0 * math.pi * (1.0 - nu)), 1.0 - 2.0 * nu
    share = 1.0 - 2.0 / math.pi * arctan(v) + b * v * (c * quotient - r)
    slope = v * (-2.0 / math.pi * r + b * (c * (2.0 * r - quotient) - r * (2.0 * r - 1.0)))
    return min(max(share, 0.0), 1.0), slope


@formula
def ratio_share(thickness_over_radius):
    """Return the film's weight I1 in Poisson's ratio of film and substrate together.

    I1 = (2/pi) arctan(t/a) + (t/a)/pi ln(1 + (a/t)^2). thickness_over_radius: film thickness divided by contact radius,
    t/a.
    """
    xi = min(max(thickness_over_radius, _LEAST), _MOST)
    return 2.0 / math.pi * arctan(xi) + log_quotient(1.0 / xi / xi) / (math.pi * xi)


@formula
def poissons_ratio(thickness_over_radius, nu_film, nu_substrate):
    """Return Poisson's ratio nu of film and substrate together.

    1 - nu = (1 - nu_s)(1 - nu_f) / (1 - (1 - I1) nu_f - I1 nu_s), with the film's weight I1 from `ratio_share`.
    thickness_over_radius: film thickness divided by contact radius.
    """
    share = ratio_share(thickness_over_radius)
    mixed = 1.0 - (1.0 - share) * nu_film - share * nu_substrate
    return 1.0 - (1.0 - nu_substrate) * (1.0 - nu_film) / mixed


@formula
def value(film_over_substrate, thickness_over_radius, nu_film, nu_substrate):
    """Return E'/E'_s, the reduced modulus of film and substrate together divided by the substrate's, 1 + (E'_f/E'_s - 1) I0.

    E' = E/(1 - nu^2). I0 is the film's weight, from `modulus_share`. film_over_substrate: E'_f/E'_s. thickness_over_radius:
    film thickness divided by contact radius.
    """
    nu = poissons_ratio(thickness_over_radius, nu_film, nu_substrate)
    share, _ = modulus_share(1.0 / min(max(thickness_over_radius, _LEAST), _MOST), nu)
    return 1.0 + (film_over_substrate - 1.0) * share


RECORD = Composite(
    key="gao_chiu_lee_1992",
    title="Modulus of film and substrate together: average weighted by a function of thickness over contact radius",
    grade="B",
    property="modulus",
    value=value,
    sources=(Source("gao_chiu_lee_1992", "I0, I1", "as restated by the documentation of the NIMS toolbox"),),
    verified="independent evaluation; limits of the film alone and of the substrate alone",
    needs=("n_E", "film_aspect", "nu", "film_nu"),
    validity=(Validity("n_E", 0.5, 2.0, "the formula deviates from numerical solutions (Perriot & Barthel 2004)"),),
    notes="Derived for a flat punch. The restatement misprints 1 + [...] for 1 - [...] in Poisson's ratio.",
)
