"""Height distributions: standardised, exact where a closed form exists, and refused where they make no sense."""

import math
from itertools import pairwise

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from numpy.testing import assert_allclose
from scipy import stats

from stiction.engine import heights as module
from stiction.engine.heights import DISTRIBUTIONS, empirical, height_distribution
from stiction.quantities.errors import InputError

RNG = np.random.default_rng(3)
SAMPLES = RNG.gamma(4.0, 2e-9, 3000)  # metres, skewed
KNOWN = {  # density of the same distribution in scipy, standardised there by its own moments
    "gaussian": ({}, stats.norm()),
    "exponential": ({}, stats.expon()),
    "weibull": ({"exponent": 2.0}, stats.weibull_min(2.0)),
    "weibull 3.4": ({"exponent": 3.4}, stats.weibull_min(3.4)),
    "weibull 1": ({"exponent": 1.0}, stats.expon()),
}


def density(heights, z):
    return np.array([heights.density(float(one), heights.shape) for one in z])


def moments(heights):
    """Integrals of 1, z, z^2 times the density over its window, by panels of Gauss-Legendre between the knots."""
    low, high = heights.window(-np.inf, np.inf, heights.shape)
    ends = np.unique(np.concatenate([[low, high], heights.knots[(heights.knots > low) & (heights.knots < high)]]))
    panels = np.concatenate([np.linspace(a, b, 9)[:-1] for a, b in pairwise(ends)] + [[high]])
    t, weight = leggauss(20)
    half = np.diff(panels)[:, None] / 2.0
    z = (panels[:-1, None] + half * (1.0 + t)).ravel()
    mass = (half * weight).ravel() * density(heights, z)
    return [float(np.sum(mass * z**power)) for power in range(3)]


@pytest.mark.parametrize("key", KNOWN)
def test_densities_against_scipy(key):
    parameters, frozen = KNOWN[key]
    heights = height_distribution(key.split()[0], **parameters)
    z = np.linspace(-3.0, 8.0, 400)
    expected = frozen.std() * frozen.pdf(frozen.mean() + frozen.std() * z)
    assert_allclose(density(heights, z), expected, rtol=1e-12, atol=1e-300)


def test_weibull_density_vanishes_where_no_double_holds_it():
    """At y = mean + deviation z = 30 an exponent of 2 gives 60 deviation exp(-900), less than any double."""
    heights = height_distribution("weibull", exponent=2.0)
    variable = stats.weibull_min(2.0)
    assert density(heights, [(30.0 - variable.mean()) / variable.std()]) == 0.0


@pytest.mark.parametrize("heights", [height_distribution(key.split()[0], **KNOWN[key][0]) for key in KNOWN], ids=list(KNOWN))
def test_standardised(heights):
    """Mass 1, mean 0, deviation 1. The window leaves out less than exp(-30); y^2.4 costs the quadrature digits."""
    assert_allclose(moments(heights), [1.0, 0.0, 1.0], atol=1e-10)


@pytest.mark.parametrize("cells", (None, 10, 37))
def test_empirical_is_standardised_exactly(cells):
    """A polynomial density between knots: the moments of the polygon are exact, and must be 1, 0 and 1."""
    heights = empirical(SAMPLES, cells)
    assert_allclose(moments(heights), [1.0, 0.0, 1.0], atol=2e-14)
    assert cells is None or len(heights.knots) == cells + 2


def test_empirical_follows_its_samples():
    """The frequency polygon of 10^6 draws lies on the density they are drawn from, within sampling error."""
    drawn = stats.weibull_min(2.0)
    heights = empirical(drawn.rvs(1_000_000, random_state=np.random.default_rng(5)), cells=60)
    z = np.linspace(-1.5, 3.0, 40)
    expected = drawn.std() * drawn.pdf(drawn.mean() + drawn.std() * z)
    assert_allclose(density(heights, z), expected, atol=0.01)  # of a largest value of 0.4; the cells are 0.1 wide


def test_empirical_does_not_depend_on_unit_or_origin():
    plain, moved = empirical(SAMPLES, 20), empirical(1e9 * SAMPLES + 7.0, 20)
    assert_allclose(plain.shape, moved.shape, rtol=1e-9)


def test_exponential_function():
    """Against the C library: 4e-16 down to -708, zero below."""
    x = -np.concatenate([np.linspace(0.0, 2.0, 400), np.geomspace(1e-12, 707.9, 800)])
    found = np.array([module.exponential(float(one)) for one in x])
    assert_allclose(found, [math.exp(one) for one in x], rtol=4e-16)
    assert module.exponential(0.0) == 1.0
    assert module.exponential(-708.5) == module.exponential(-1e300) == module.exponential(-math.inf) == 0.0


@pytest.mark.parametrize("key", KNOWN)
def test_windows_leave_out_nothing_that_counts(key):
    """Of any piece of the axis, the part left out holds less than 1e-12 of the mass of the piece."""
    parameters, frozen = KNOWN[key]
    heights = height_distribution(key.split()[0], **parameters)

    def mass(low, high):
        low, high = (frozen.mean() + frozen.std() * z for z in (low, high))
        return frozen.cdf(high) - frozen.cdf(low) if low < frozen.mean() else frozen.sf(low) - frozen.sf(high)

    for z_left in (-9.0, -2.0, -0.5, 0.3, 2.0, 5.0):
        for z_right in (z_left + 0.1, z_left + 3.0, 30.0, math.inf):
            low, high = heights.window(z_left, z_right, heights.shape)
            whole = mass(z_left, z_right)
            if high > low:
                assert z_left <= low < high <= z_right
                assert mass(low, high) == pytest.approx(whole, rel=1e-11, abs=1e-300)
            else:
                assert whole == 0.0


BAD = [
    ("lognormal", {}, "gaussian, exponential, weibull, empirical, discrete"),
    ("gaussian", {"exponent": 2.0}, "no parameter"),
    ("weibull", {}, "exponent"),
    ("weibull", {"exponent": 0.9}, "1 to 100"),
    ("weibull", {"exponent": math.nan}, "1 to 100"),
    ("empirical", {}, "samples"),
    ("empirical", {"samples": [1.0, 2.0]}, "10 or more"),
    ("empirical", {"samples": [1.0] * 20}, "not all equal"),
    ("empirical", {"samples": [1.0, math.nan] * 20}, "finite"),
    ("discrete", {}, "samples"),
    ("discrete", {"samples": [1.0]}, "2 or more"),
    ("discrete", {"samples": [2.0, 2.0]}, "not all equal"),
    ("discrete", {"samples": [1.0, math.inf]}, "finite"),
]


@pytest.mark.parametrize(("key", "parameters", "allowed"), BAD, ids=lambda one: str(one)[:30])
def test_refused(key, parameters, allowed):
    with pytest.raises(InputError) as caught:
        height_distribution(key, **parameters)
    assert allowed in caught.value.allowed and "\n" not in str(caught.value)


def test_table_of_distributions():
    assert list(DISTRIBUTIONS) == ["gaussian", "exponential", "weibull", "empirical", "discrete"]
    assert DISTRIBUTIONS["gaussian"]().entire
