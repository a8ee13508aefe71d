"""Persson 2001: the distribution of pressure diffuses as finer roughness comes in; elastic contact.

A surface in full contact has one pressure p. Each finer wave spreads the distribution of pressures, by a diffusion in p whose
time is G = (E* h')^2 / 8, h' being the root mean square gradient; where the pressure comes to zero, contact is lost. What is
left is A/A0 = erf(p / (2 sqrt(G))) = erf(sqrt(2) p / (E* h')). The theory needs no asperities and knows no separation here.
"""

import math

import numpy as np
from scipy.special import erf

from stiction.contact.indices import Groups
from stiction.laws.registry import RoughSurface, Validity
from stiction.laws.sources import Source
from stiction.surfaces.theory.moments import reduced_pressure


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Area per asperity over pi R sigma (n, H) at loads per asperity (n, H). Source: Persson 2001; no contact under tension."""
    density = groups.roughness_parameter[:, None]
    pressure = reduced_pressure(np.maximum(load, 0.0), density)
    return erf(math.sqrt(2.0) * pressure) / (math.pi * density)


RECORD = RoughSurface(
    key="persson_2001",
    title="Contact of randomly rough surfaces by diffusion of the pressure, elastic",
    grade="B",
    sources=(
        Source("persson_2001", "", "A/A0 = erf(p / (2 sqrt(G))), with G = (E* h')^2 / 8 for the gradient of the whole surface"),
        Source("nayak_1971", "", "the gradient that belongs to sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    verified="diffusion with an absorbing boundary, by finite differences; A/A0 = sqrt(8/pi) p/(E* h') at light load",
    needs=("roughness_parameter",),
    validity=(
        Validity("plasticity_index", 0.0, 0.6, "contact is taken as elastic"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    notes="h' is that of an isotropic Gaussian surface whose summits have this R and N: h'^2 = sqrt(3) / (64 N R^2).",
)
