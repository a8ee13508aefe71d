r"""Summits of a Gaussian surface as spheres of their geometric mean curvature: Greenwood 2006.

*Assumes*: as [`bush_gibson_thomas_1975`](#bush_gibson_thomas_1975), with the same density of summits. A summit with the
principal curvatures $\kappa_1$ and $\kappa_2$ is replaced by a sphere whose curvature is their geometric mean,

$$
\sqrt{\kappa_1\kappa_2}=\sqrt{\kappa_m^2-r^2}
$$

($\kappa_m$ is their mean, $r$ half of their difference). Greenwood found that Hertz's elliptic contact differs little from
this circular contact. *Source*: [greenwood_2006], [nayak_1971]. *Check*: loads and areas agree with Bush et al. within 3 % for
$\rho=NR\sigma$ from 0.017 to 0.3. The ratio $\kappa$ of area to load at light load tends to $\sqrt{2\pi}$ in both models;
values are in the table of [`bush_gibson_thomas_1975`](#bush_gibson_thomas_1975).
"""

from functools import cache

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.shared_claims import ELASTIC, ENOUGH_SUMMITS
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source
from stiction.surfaces.theory import summits
from stiction.surfaces.theory.start_table import separation_of_summits
from stiction.surfaces.theory.summits import Shapes


@cache
def spheres() -> Shapes:
    """Return the spherical contacts that replace elliptic ones, tabulated against the asymmetry t of a summit's curvatures.

    t is half the difference of the principal curvatures divided by their mean kappa. A summit becomes a sphere of curvature g =
    kappa sqrt(1 - t^2). If it is compressed by w, its contact area is pi w / g and its load (4/3) E* w^(3/2) / sqrt(g). The
    values of t are Gauss points in (1 - t)^(1/4).
    """
    node, weight = np.polynomial.legendre.leggauss(120)
    root = (1.0 + node) / 2.0
    t = 1.0 - root**4
    share = root**4 * (2.0 - root**4)  # 1 - t^2 = (g / kappa)^2
    return Shapes(t=t, weight=2.0 * root**3 * weight, load=share**-0.25, area=share**-0.5)


def curve(h: np.ndarray, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
    """Return load and contact area (n, H) per asperity at H separations of n contacts.

    h: separation in units of sigma from the mean summit height, (H,) or (n, H). Units: loads in K R^(1/2) sigma^(3/2), areas in
    pi R sigma. Raises InputError if no isotropic Gaussian surface has the N R sigma of a contact.
    """
    return summits.curve(h, groups.roughness_parameter, spheres)


def separation_near(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return approximate separations (n, H), in units of sigma, at the loads (n, H), as starting values for a search.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). The result is NaN for loads of 0 or less. Raises InputError as
    `curve` does.
    """
    return separation_of_summits(load, groups.roughness_parameter, spheres)


RECORD = RoughSurface(
    key="greenwood_2006",
    title="Elastic contact of a rough surface: summits as spheres of their geometric mean curvature",
    grade="B",
    sources=(
        Source("greenwood_2006", "", "geometric mean curvature in place of the ellipse; integrated here over Nayak's density"),
        Source("nayak_1971", "", "joint density of height and curvatures of the summits"),
    ),
    curve=curve,
    separation_near=separation_near,
    takes_surface_moments=True,
    verified="independent integration over height and geometric mean curvature, whose density has a closed form; A/A0 = "
    "sqrt(2 pi) p/(E* h') at light load",
    needs=("roughness_parameter",),
    validity=(
        ENOUGH_SUMMITS,
        ELASTIC,
    ),
    notes=(
        "The asperities are the summits of an isotropic Gaussian surface with the given sigma, N and mean curvature 1/R. "
        "The separation is from the mean summit height. Load and area are within 3 % of bush_gibson_thomas_1975."
    ),
)
