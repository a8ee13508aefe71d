"""Finish classes: ranges of printed charts, and numbers that belong together."""

import re

import numpy as np
import pytest
from scipy import stats

from refusals import refusal
from stiction.records.sources import bibliography
from stiction.surfaces.finishes import NUMBERS, Finish, finish, finish_names, finishes

FINISHES = {
    "polished",
    "lapped",
    "ground",
    "turned",
    "milled",
    "blasted",
    "wafer",
    "sputtered film",
    "worn",
    "as deposited",
    "printed",
    "moulded",
}


def test_every_finish_has_its_numbers_with_source_and_grade():
    assert set(finish_names()) == FINISHES and [row["name"] for row in finishes()] == finish_names()
    for name in finish_names():
        one = finish(name)
        assert set(one.range) == set(one.source) == set(one.grade) == set(NUMBERS)
        for number, text in one.source.items():
            assert set(re.findall(r"\[(\w+)\]", text)) <= bibliography().keys(), (name, number)
            assert one.grade[number] == "C" or "[" in text, (name, number)
            assert one.grade[number] == "C" or not text.startswith("from memory"), (name, number)


# Ra in um as the charts print it, times 1.25 for Sq; run-in DLC in nm as table 1 of Salinas Ruiz et al. 2021 prints it.
@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("lapped", 0.05e-6, 0.4e-6),
        ("ground", 0.1e-6, 1.6e-6),
        ("turned", 0.4e-6, 6.3e-6),
        ("milled", 0.8e-6, 6.3e-6),
        ("moulded", 0.05e-6, 0.55e-6),
    ],
)
def test_heights_are_those_of_the_chart(name, low, high):
    assert finish(name).range["rms_height"] == pytest.approx((1.25 * low, 1.25 * high), rel=0.06)


def test_run_in_surfaces_lie_within_worn_ones():
    heights = [5.0, 6.7, 13.4, 26.5, 3.9, 9.0, 3.8, 9.1, 10.9, 10.4]  # nm, cylinders and discs
    slopes = [0.051, 0.087, 0.072, 0.131, 0.025, 0.054, 0.044, 0.078, 0.099, 0.080]
    low, high = finish("worn").range["rms_height"]
    assert sum(low <= 1e-9 * height <= high for height in heights) >= 8
    low, high = finish("worn").range["rms_slope"]
    assert sum(low <= slope <= high for slope in slopes) >= 9


@pytest.mark.parametrize("name", sorted(FINISHES))
def test_height_slope_and_radius_are_those_of_one_gaussian_surface(name):
    """Nayak's bandwidth from R = (3/8) (pi/m4)^(1/2) (McCool 1986) gives N R sigma of the summits; both must be possible."""
    height, radius, slope, parameter = (float(finish(name).quantile(number, 0.5)) for number in NUMBERS)
    m0, m2, m4 = height**2, slope**2 / 2, np.pi * (3 / 8 / radius) ** 2
    bandwidth = m0 * m4 / m2**2
    assert 2 < bandwidth < 20
    density, spread = m4 / m2 / (6 * np.pi * 3**0.5), ((1 - 0.8968 / bandwidth) * m0) ** 0.5
    assert density * radius * spread == pytest.approx(parameter, rel=0.2)


def test_quantiles_are_lognormal():
    level = np.linspace(0.01, 0.99, 33)
    low, high = finish("ground").range["asperity_radius"]
    width = np.log(high / low) / (2 * stats.norm.ppf(0.95))
    expected = stats.lognorm(s=width, scale=(low * high) ** 0.5).ppf(level)
    np.testing.assert_allclose(finish("ground").quantile("asperity_radius", level), expected, rtol=1e-12)


def test_what_is_not_known_is_refused_in_one_line():
    with refusal("finish", "grounded", "ground"):
        finish("grounded")
    with refusal("quantity", "Ra", "rms_height"):
        finish("ground").quantile("Ra", 0.5)
    with refusal("range.rms_slope"):
        Finish(
            surface_kind="lay", range={"rms_height": ["1 um", "2 um"], "asperity_radius": ["1 um", "2 um"]}, source={}, grade={}
        )
