"""Full stick of asperities that yield early: the force grows as a broken power of the load, which the sum has to resolve though
the segment that has yielded begins beyond it. Summed here anew, between many places that crowd there."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

import stiction as st

NU, RATIO, SEPARATION, SHARE = 0.3, 2.8, 1.5, 0.5


def summed(force, yields: float) -> float:
    places = [*(yields * 10.0 ** np.arange(-13, 0)), 0.5 * yields, yields, *(yields + np.geomspace(0.01 * yields, 9.0, 24))]

    def one(w):
        return force(w) * math.exp(-0.5 * (SEPARATION + w) ** 2) / math.sqrt(2.0 * math.pi)

    return math.fsum(quad(one, *ends, epsabs=0.0, epsrel=1e-12)[0] for ends in pairwise(places))


@pytest.mark.parametrize("eta", [0.3, 0.1, 0.03, 0.01])
@pytest.mark.parametrize("law", ["brizmer_kligerman_etsion_2007", "junction_growth"])
def test_sums_over_yielded_asperities(law, eta):
    mean = 0.454 + 0.41 * NU  # of the hardness: the pressure after Chang, Etsion and Bogy
    yields = (2.0 / 3.0 * mean * eta) ** 2
    first = (8.88 * NU - 10.13 * (NU**2 + 0.089)) * (2.0 / 3.0 * (1.234 + 1.256 * NU) * eta / RATIO) ** 3
    strength = SHARE / math.sqrt(3.0 * RATIO**2)

    def force(w):
        area = w if w < yields else 2.0 * w - yields
        load = w**1.5 if w < yields else eta * mean * area
        stuck = 0.27 / math.tanh(0.27 * (load / first) ** 0.35) * load
        if law == "brizmer_kligerman_etsion_2007":
            return stuck
        return 1.0 / math.sqrt((1.0 - SHARE**2) / (strength * eta * area) ** 2 + 1.0 / stuck**2)

    contact = st.Indices(hardness_group=eta, shear_strength=strength)
    laws = {"model": "greenwood_williamson_1966", "asperity": "chang_etsion_bogy_1987", "tangential": law}
    result = st.solve(contact, separation=SEPARATION, **laws)
    assert float(result["friction_force"]) == pytest.approx(summed(force, yields), rel=1e-10)
