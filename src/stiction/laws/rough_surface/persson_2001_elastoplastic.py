"""Persson 2001, elastic and plastic: as persson_2001, but the pressure nowhere exceeds the hardness H.

The distribution of pressures P(p, G) obeys dP/dG = d^2P/dp^2 from a spike at the nominal pressure p0 (G = (E* h')^2 / 8 for
all the roughness), with P = 0 at p = 0, where contact is lost, and at p = H, where it turns plastic and stays in contact. In
sines of n pi p / H that is

    elastic  A_el/A0 = sum over odd n of (4 / (n pi)) sin(n pi p0/H) exp(-n^2 pi^2 G/H^2)
    plastic  A_pl/A0 = p0/H + sum over all n of (-1)^n (2 / (n pi)) sin(n pi p0/H) exp(-n^2 pi^2 G/H^2)

the second from what flows out at H; both carry the load: Int p P dp + H A_pl/A0 = p0. With much roughness all contact is
plastic and A/A0 = p0/H; with little, or without a limit H, it is elastic.
"""

import math

import numpy as np
from scipy.special import erf, erfc

from stiction.contact.indices import Groups
from stiction.laws.registry import Limit, RoughSurface, Validity
from stiction.laws.sources import Source
from stiction.surfaces.theory.moments import reduced_pressure, slope_over_sharpness

# Where H > 13 sqrt(G), less than erfc(13/2) = 4e-20 ever comes from one boundary to the other, and each acts as if alone; else
# 27 terms leave less than that out.
_APART, _TERMS = 13.0, 27


def area_shares(share: np.ndarray, hardness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(elastic, plastic) contact area over the nominal area. Source: Persson 2001 (Phys. Rev. Lett.), in the sums above.

    share: p0/H; from 1 on everything is plastic. hardness: H / (E* h'). Arrays alike in shape.
    """
    p, root_G = np.clip(share, 0.0, 1.0), 1.0 / (math.sqrt(8.0) * hardness)  # both over H
    plastic = erfc((1.0 - p) / (2.0 * root_G))
    elastic = erf(p / (2.0 * root_G)) - plastic
    mixed = root_G * _APART > 1.0
    n = np.arange(1, _TERMS + 1)
    x = math.pi * p[mixed][:, None]
    term = 2.0 / (n * math.pi) * np.sin(n * x) * np.exp(-((n * math.pi * root_G[mixed][:, None]) ** 2))
    elastic[mixed] = 2.0 * np.sum(term[:, ::2], axis=1)
    # odd terms are taken off p0/H and even ones added: what is small is small by cancellation, to 1e-16 of A0
    plastic[mixed] = np.maximum(p[mixed] - np.sum(term[:, ::2], axis=1) + np.sum(term[:, 1::2], axis=1), 0.0)
    full = share >= 1.0
    elastic[full], plastic[full] = 0.0, 1.0
    return np.maximum(elastic, 0.0), plastic


def hardness_over_slope(groups: Groups) -> np.ndarray:
    """H / (E* h') (n,): H/E* is (4/3) eta sqrt(sigma/R) / pi (docs/theory.md, section 1)."""
    eta = groups.eta
    return 4.0 / 3.0 * eta / math.pi / slope_over_sharpness(groups.roughness_parameter)


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Area, elastic and plastic, per asperity over pi R sigma (n, H) at loads per asperity (n, H); none under tension."""
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
        Source("nayak_1971", "", "the gradient that belongs to sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    verified="the diffusion equation by finite differences; balance of the load; persson_2001 for great hardness",
    needs=("theta", "lam", "roughness_parameter"),
    validity=(Validity("theta", 10.0, math.inf, "adhesion is left out"),),
    limits=(Limit("persson_2001", {"theta": 1.0, "lam": 1e24}, ("contact_area",), 1e-12),),
    notes=(
        "The hardness is the same at all scales, that of the softer body. A nominal pressure above it gives full contact. "
        "h' is that of the isotropic Gaussian surface whose summits have this R and N: h'^2 = sqrt(3) / (64 N R^2)."
    ),
)
