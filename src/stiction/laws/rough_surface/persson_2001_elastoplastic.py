r"""Elastic-plastic contact by diffusion of the pressure distribution, with pressures up to the hardness: Persson 2001.

*Assumes*: as [`persson_2001`](#persson_2001), with a second boundary at the hardness $H$, where the contact becomes plastic
and persists. The hardness is the same at all scales. *Source*: [persson_2001_elastoplastic]; solved again here. The
probability density $P$ of the pressure $p$ obeys $\partial P/\partial G=\partial^2P/\partial p^2$. It starts as a delta
function at the nominal pressure $p_0$ and is 0 at $p=0$ and at $p=H$. The solution as a series of sines of $n\pi p/H$ gives
the elastic and the plastic contact area, divided by the nominal area,

$$
\frac{A_\text{el}}{A_n}=\sum_{n\ \text{odd}}\frac4{n\pi}\sin\frac{n\pi p_0}H\,e^{-n^2\pi^2G/H^2},\qquad
\frac{A_\text{pl}}{A_n}=\frac{p_0}H+\sum_n(-1)^n\frac2{n\pi}\sin\frac{n\pi p_0}H\,e^{-n^2\pi^2G/H^2}
$$

with $G=(E^*h')^2/8$, the contact modulus $E^*$ and the root mean square gradient $h'$. The second formula follows from the
probability flux through the boundary at $H$. Both areas together carry the load, $\int pP\,dp+HA_\text{pl}/A_n=p_0$. *Check*
($A_\text{el}/A_n$ and $A_\text{pl}/A_n$):

| $H/(E^*h')$ | $p_0/H$ | elastic | plastic |
|---|---|---|---|
| 0.4 | 0.25 | 0.00040 | 0.24980 |
| 1 | 0.25 | 0.26219 | 0.12120 |
| 2 | 0.25 | 0.67999 | 0.00270 |
| 2 | 0.75 | 0.67999 | 0.31731 |

*Limits*: `persson_2001` for large hardness; $A/A_n=p_0/H$ for large roughness.
"""

import math

import numpy as np
from scipy.special import erf, erfc

from stiction.contact.indices import Groups
from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source
from stiction.surfaces.theory.moments import reduced_pressure, slope_over_sharpness

# For H > 13 sqrt(G) each boundary acts alone, because less than erfc(13/2) = 4e-20 diffuses from one to the other; else 27
# terms of the series have a smaller error.
_APART, _TERMS = 13.0, 27


def area_shares(share: np.ndarray, hardness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the elastic and the plastic contact area, each divided by the nominal area.

    share: nominal pressure divided by hardness, p0/H, an array; if it is 1 or more, the whole contact is plastic. hardness:
    H / (E* h'), same shape, with the contact modulus E* and the root mean square gradient h'. Source: Persson 2001 (Phys.
    Rev. Lett.); the sums are in the docstring of this module.
    """
    p, root_G = np.clip(share, 0.0, 1.0), 1.0 / (math.sqrt(8.0) * hardness)  # both over H
    plastic = erfc((1.0 - p) / (2.0 * root_G))
    elastic = erf(p / (2.0 * root_G)) - plastic
    mixed = root_G * _APART > 1.0
    n = np.arange(1, _TERMS + 1)
    x = math.pi * p[mixed][:, None]
    term = 2.0 / (n * math.pi) * np.sin(n * x) * np.exp(-((n * math.pi * root_G[mixed][:, None]) ** 2))
    elastic[mixed] = 2.0 * np.sum(term[:, ::2], axis=1)
    # Odd terms are subtracted from p0/H and even ones added; by cancellation the error is 1e-16 of the nominal area.
    plastic[mixed] = np.maximum(p[mixed] - np.sum(term[:, ::2], axis=1) + np.sum(term[:, 1::2], axis=1), 0.0)
    full = share >= 1.0
    elastic[full], plastic[full] = 0.0, 1.0
    return np.maximum(elastic, 0.0), plastic


def hardness_over_slope(groups: Groups) -> np.ndarray:
    """Return the reduced hardness H / (E* h') (n,), with the contact modulus E* and the root mean square gradient h'.

    H/E* is (4/3) eta sqrt(sigma/R) / pi (docs/explanation/theory.md, section 1), with the hardness group eta. The ratio
    does not depend on sqrt(sigma/R).
    """
    eta = groups.eta
    return 4.0 / 3.0 * eta / math.pi / slope_over_sharpness(groups.roughness_parameter)


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    The area is the sum of elastic and plastic area. load: per asperity, in units of K R^(1/2) sigma^(3/2).
    """
    density = groups.roughness_parameter[:, None]
    pressure = reduced_pressure(np.maximum(load, 0.0), density)
    hardness = np.broadcast_to(hardness_over_slope(groups)[:, None], pressure.shape)
    elastic, plastic = area_shares(pressure / hardness, hardness)
    return (elastic + plastic) / (math.pi * density)


RECORD = RoughSurface(
    key="persson_2001_elastoplastic",
    title="Contact of randomly rough surfaces by diffusion of the pressure, elastic-plastic with constant hardness",
    grade="B",
    sources=(
        Source("persson_2001_elastoplastic", "", "the diffusion and its boundaries; solved again here"),
        Source("persson_2001", "", "the diffusion, and G"),
        Source("nayak_1971", "", "gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    verified="the diffusion equation by finite differences; equilibrium of the load; persson_2001 for large hardness",
    needs=("hardness_group", "roughness_parameter"),
    limits=(Limit("persson_2001", {"theta": 1.0, "lam": 1e24}, ("contact_area",), 1e-12),),
    notes=(
        "The hardness is that of the softer body at all scales. A nominal pressure above it gives full contact. The gradient "
        "h' is that of the isotropic Gaussian surface whose summits have this R and N: h'^2 = sqrt(3) / (64 N R^2)."
    ),
)
