"""Where few asperities touch a prediction counts them and scatters with them, against sums and draws made here."""

import re

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

import stiction as st

SIGMA, RADIUS, NUMBER, HEIGHT = 2e-7, 2e-4, 100, 1.55
MODULUS = 1e12 / (2.0 * (1.0 - 0.3**2))
BODY = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e11}


def gaussian_sum(power):
    return quad(lambda gap: gap**power * norm.pdf(gap + HEIGHT), 0.0, 12.0)[0]


def scatter_of_spots():
    """The variance of ln of the area of n Hertz spots of exponential depths, at the load they carry together, times n."""
    depths = np.random.default_rng(5).exponential(size=(20_000, 60))
    return 60 * np.var(np.log(depths.sum(axis=1)) - np.log((depths**1.5).sum(axis=1)))


def test_few_asperities_are_counted_and_scatter():
    """About six touch: the law of large numbers does not hold, and ln mu varies by .395/n. Errors of the area hold
    .395/m of it, of the m spots of solved maps of some 300 asperities under this pressure."""
    rough = {"asperity_height_deviation": SIGMA, "asperity_radius": RADIUS, "asperity_density": 1e9}
    contact = st.Contact(first=BODY, second=BODY, roughness=rough, nominal_area=NUMBER / 1e9, interfacial_shear_strength=1e8)
    load = NUMBER * 4.0 / 3.0 * MODULUS * RADIUS**0.5 * SIGMA**1.5 * gaussian_sum(1.5)
    found = st.predict(contact, load=load)
    touching = NUMBER * gaussian_sum(0.0)
    (shown,) = re.findall(r"About (\d+) asperit(?:y touches|ies touch)", found.warnings[-1])
    assert float(shown) == pytest.approx(touching, rel=0.4)
    variance = np.var(np.log(found.friction_coefficient_samples.values))
    more = 1.0 / float(shown) - 1.0 / (300 * float(shown) / NUMBER)
    assert found.shares["chance"] * variance == pytest.approx(scatter_of_spots() * more, rel=0.3)


def test_a_contact_as_small_as_solved_surfaces_has_their_scatter_alone():
    """Before, the scatter of its few spots was counted twice: within the errors of the area, and beside them."""
    rough = {"asperity_height_deviation": SIGMA, "asperity_radius": RADIUS, "asperity_density": 1e9, "kind": "gaussian"}
    shares = []
    for number in (30, 300):
        contact = st.Contact(
            first=BODY, second=BODY, roughness=rough, nominal_area=number / 1e9, interfacial_shear_strength=1e8
        )
        load = number * 4.0 / 3.0 * MODULUS * RADIUS**0.5 * SIGMA**1.5 * gaussian_sum(1.5)
        shares.append(st.predict(contact, load=load).shares.get("chance", 0.0))
    assert shares[0] > 0.2 and shares[1] == 0.0


def test_a_contact_smaller_than_an_atom_is_told():
    """An area of a tenth of a square nanometre: the plastic load over the hardness of copper, some 1 GPa."""
    rough = {"asperity_height_deviation": "0.2 um", "asperity_radius": "20 um", "asperity_density": "1e10 1/m^2"}
    contact = st.Contact(first="copper", second="copper", roughness=rough, nominal_area="1 cm^2", interface="oxidised metal")
    told = [
        "smaller than an atom" in " ".join(st.predict(contact, load=load).warnings) for load in ("1e-29 N", "1e-11 N", "1e-9 N")
    ]
    assert told == [True, True, False]
