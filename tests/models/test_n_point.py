"""n-point asperities: on profiles made by hand, against simulated profiles (reference/make_n_point.py), and in limits."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.stats import multivariate_normal, norm

from refusals import refusal
from stiction.laws.rough_surface import hariri_zu_ben_mrad_2006 as model
from stiction.quantities.errors import InputError
from stiction.surfaces.theory import n_point
from stiction.surfaces.theory.moments import bandwidth, reduced_pressure, summit_height
from stiction.surfaces.theory.n_point import mean_height, n_point_asperities, points_above, rate_of_rows
from tables import column, groups, read

SIMULATED = read("hariri_zu_ben_mrad_2006.csv")


def row_probabilities(level: float, correlation: float, sizes: int, height: float = math.inf) -> np.ndarray:
    """Rows of m = 1 to `sizes` points (n = 3 to sizes + 2) whose height is `height` at most, per sampled point; (sizes,).

    P(y_0 < D; D < y_1 ... y_m < D + height; y_m+1 < D), by handing the density on from point to point: the distribution of the
    heights of n-point asperities, and with R = L^2 / (8 t) that of their radii.
    """
    top = min(level + height, max(level, 0.0) + 9.0)
    width = math.sqrt(1.0 - correlation * correlation)
    node, weight = n_point._gauss(40 + math.ceil(4.0 * (top - level) / width))
    x = level + (top - level) * (1.0 + node) / 2.0
    root = np.sqrt((top - level) / 2.0 * weight)
    falls = root * n_point._falls(x, level, correlation)
    hand_on = root[:, None] * root * n_point._kernel(x[:, None], x, correlation)
    found, state = np.empty(sizes), falls
    for m in range(sizes):
        found[m] = falls @ state
        state = hand_on @ state
    return found


def simulated(quantity):
    rows = [row for row in SIMULATED if row["quantity"] == quantity]
    assert rows
    return rows


def assert_within_errors(found, rows):
    """No more than four standard errors off anywhere, and not one and a half on average; the rare may not be seen."""
    error = np.maximum(column(rows, "error"), 2e-8)
    off = np.abs(np.asarray(found) - column(rows, "value")) / error
    assert off.max() < 4.0 and off.mean() < 1.5


# ---- measured profiles


def test_by_hand():
    """Rows of 1, 3 and 2 points above 1; the first point of all is above, too, and its row is cut, as the last one is."""
    profile = [2, 0, 3, 1, 2, 5, 1.5, 0, 0, 4, 4, -1, 7]
    found = n_point_asperities(profile, 0.5, 1.0)
    assert found.points.tolist() == [3, 5, 4]
    assert found.height.tolist() == [2.0, 4.0, 3.0]
    assert_allclose(found.radius, [1.0**2 / 16, 2.0**2 / 32, 1.5**2 / 24])


def test_a_parabola_is_itself():
    """Sampled from a parabola of radius R with the level through two of its points, the asperity has its height and radius."""
    x = np.linspace(-1.0, 1.0, 41)
    found = n_point_asperities(3.0 - x * x / (2 * 7.0), 0.05, 3.0 - 0.6**2 / (2 * 7.0))
    assert found.points.tolist() == [25]
    assert_allclose((found.height[0], found.radius[0]), (0.6**2 / 14, 7.0), rtol=1e-12)


@pytest.mark.parametrize("profile", ([], [1.0], [0, 0, 0], [2, 2, 2], [0, 2, 2], [2, 2, 0], [2, 0, 2], [1, 1, 1]))
def test_no_asperity(profile):
    found = n_point_asperities(profile, 1.0, 1.0)
    assert len(found.points) == len(found.height) == len(found.radius) == 0


def test_one_by_one():
    """The same as walking along the profile."""
    profile = np.random.default_rng(3).standard_normal(4000)
    profile[1:] += profile[:-1]
    row, expected = None, []
    for z in profile:
        if z <= 0.2:
            if row:
                L = (len(row) + 1) * 0.3
                expected.append((len(row) + 2, max(row) - 0.2, L * L / 8 / (max(row) - 0.2)))
            row = []
        elif row is not None:
            row.append(z)
    found = n_point_asperities(profile, 0.3, 0.2)
    assert len(expected) > 500 and max(expected)[0] > 8
    assert_allclose(np.column_stack([found.points, found.height, found.radius]), expected, rtol=1e-14)


@pytest.mark.parametrize(("profile", "spacing"), (([[0, 1, 0]], 1.0), ([0, math.nan, 0], 1.0), ([0, 1, 0], 0.0)))
def test_refused_profiles(profile, spacing):
    with pytest.raises(InputError):
        n_point_asperities(profile, spacing, 0.5)


# ---- Gaussian profiles


def test_rates():
    """Rows per point by the upcrossings (a bivariate Gaussian integral), and simulated; the points in them."""
    for level, correlation in ((0.0, 0.5), (1.3, 0.9), (-2.0, 0.2)):
        both_below = multivariate_normal(cov=[[1, correlation], [correlation, 1]]).cdf([level, level])
        assert rate_of_rows(level, correlation) == pytest.approx(norm.cdf(level) - both_below, rel=1e-7)
    assert rate_of_rows(0.0, 0.5) == pytest.approx(math.acos(0.5) / (2 * math.pi), rel=1e-14)
    rows = simulated("rows")
    assert_within_errors(rate_of_rows(column(rows, "level"), column(rows, "correlation")), rows)
    rows = simulated("points_above")
    assert_within_errors(points_above(column(rows, "level")), rows)


@pytest.mark.parametrize(("level", "correlation"), ((-1.0, 0.0), (-0.5, 0.6), (0.5, 0.9), (2.0, 0.98), (4.0, 0.3)))
def test_rows_of_all_sizes(level, correlation):
    """Over all n they are the rows, and the points above the level."""
    size = np.arange(1, 1201)
    share = row_probabilities(level, correlation, 1200)
    assert share.sum() == pytest.approx(float(rate_of_rows(level, correlation)), rel=1e-10)
    assert (size * share).sum() == pytest.approx(float(points_above(level)), rel=1e-10)


def test_rows_of_one_point():
    """m = 1 as one integral; uncorrelated points as a geometric series."""
    for level, correlation, height in ((0.3, 0.8, math.inf), (-1.0, 0.4, 0.7), (2.0, 0.995, 0.05)):
        width = math.sqrt(1 - correlation**2)

        def alone(z, level=level, correlation=correlation, width=width):
            return norm.pdf(z) * norm.cdf((level - correlation * z) / width) ** 2

        expected = quad(alone, level, min(level + height, 12.0), epsabs=0, epsrel=1e-12, limit=500)[0]
        assert row_probabilities(level, correlation, 1, height)[0] == pytest.approx(expected, rel=1e-10)
    # neighbours so alike that the kernel is 0.014 wide: panels must be as narrow
    level, correlation = 1.0, 0.9999
    width = math.sqrt(1 - correlation**2)
    expected = quad(lambda z: alone(z, level, correlation, width), level, level + 0.2, epsabs=0, epsrel=1e-12, limit=500)[0]
    assert row_probabilities(level, correlation, 1)[0] == pytest.approx(expected, rel=1e-9)
    below, inside = norm.cdf(0.4), norm.cdf(1.1) - norm.cdf(0.4)
    assert_allclose(row_probabilities(0.4, 0.0, 6, 0.7), below**2 * inside ** np.arange(1, 7), rtol=1e-12)


def test_rows_of_n():
    for quantity in ("rows_of_n", "rows_of_n_up_to"):
        rows = simulated(quantity)
        found = [
            row_probabilities(float(r["level"]), float(r["correlation"]), 5, float(r["height"] or "inf"))[int(r["points"]) - 3]
            for r in rows
        ]
        assert_within_errors(found, rows)


def test_larger_n_as_the_surfaces_come_closer():
    """The one thing that the abstract says of the numbers: mean n - 2 is the points above over the rows."""
    level = np.linspace(4.0, -4.0, 33)
    for correlation in (0.0, 0.5, 0.99):
        mean = points_above(level) / rate_of_rows(level, correlation)
        assert (np.diff(mean) > 0.0).all() and mean[0] < (1.1 if correlation < 0.9 else 4.5)


def test_mean_height_simulated():
    rows = simulated("mean_height")
    assert_within_errors(mean_height(column(rows, "level"), column(rows, "correlation")), rows)


@pytest.mark.parametrize(("level", "correlation"), ((-1.0, 0.2), (0.0, 0.7), (1.5, 0.95), (3.0, 0.0)))
def test_mean_height_by_sizes(level, correlation):
    """The integral equation against the sum over all n: the heights' mean is the integral of how many are higher."""
    node, weight = np.polynomial.legendre.leggauss(40)
    t = 4.5 * (1 + node)
    rate = float(rate_of_rows(level, correlation))
    higher = [1 - row_probabilities(level, correlation, 400, one).sum() / rate for one in t]
    assert mean_height(level, correlation) == pytest.approx(float(4.5 * weight @ higher), rel=5e-6)


def test_mean_height_of_uncorrelated_points():
    """In closed form: on either side the point is followed by a lower one before a higher one with Phi(D)/(Phi(D) + Q(z))."""
    for level in (-2.5, -1.0, 0.0, 2.0, 8.0):
        low, high = norm.cdf(level), norm.sf(level)

        def higher(z, low=low):
            return low * norm.sf(z) / (low + norm.sf(z))

        whole = sum(quad(higher, a, a + 4.0, epsabs=0, epsrel=1e-11)[0] for a in level + np.arange(0.0, 20.0, 4.0))
        assert mean_height(level, 0.0) == pytest.approx(whole / (low * high), rel=5e-6)


def test_table():
    """The table against its integral equation, solved with twice as many points."""
    for level in (-3.0, -2.2, -0.7, 0.4, 1.9, 6.0, 10.0):
        for correlation in (0.0, 0.37, 0.9, 0.997):
            fine = n_point.solved_mean_height(level, correlation, 80, 3.0, 4)
            assert mean_height(level, correlation) == pytest.approx(fine, rel=5e-6)


def test_the_stored_table_is_the_computed_one():
    assert n_point.make() == pytest.approx(n_point._table(), abs=1e-10)


def test_beyond_the_table():
    """Continuous and finite; a height of 1/D far above."""
    for edge in (-3.0, 10.0):
        assert mean_height(edge * (1 + 1e-9), 0.5) == pytest.approx(float(mean_height(edge, 0.5)), rel=1e-7)
    assert mean_height(30.0, 0.5) * 30.0 == pytest.approx(1.0, rel=0.03)
    assert np.isfinite(mean_height(np.linspace(-40.0, 40.0, 9), 0.9)).all()
    for correlation in (-0.1, 1.0, math.nan):
        with refusal("correlation", "0.99924"):
            mean_height(0.0, correlation)


# ---- the sampled profile of a surface


def test_peaks():
    for quantity, function in (("peaks", n_point.peaks_per_point), ("peak_curvature", n_point.peak_curvature)):
        rows = simulated(quantity)
        assert_within_errors(function(column(rows, "correlation")), rows)
    assert n_point.peaks_per_point(0.0) == pytest.approx(1 / 3, rel=1e-14)  # any of three may be the highest
    assert n_point.peaks_per_point(1.0) == pytest.approx(1 / 4, rel=1e-14)  # two independent steps


def test_correlation_of_a_surface():
    rows = simulated("load")
    assert_allclose(model.correlation_of(column(rows, "density")), column(rows, "correlation"), rtol=2e-3)  # 0.8968 there
    ends = np.array([model.LEAST_DENSITY, model.LARGEST_DENSITY])
    assert_allclose(bandwidth(ends), [n_point.LEAST_BANDWIDTH, n_point.LARGEST_BANDWIDTH], rtol=1e-12)
    assert n_point.LEAST_BANDWIDTH == pytest.approx((8 * math.pi**3) ** 2 / (2 * 81**2), rel=1e-14)
    assert_allclose(model.correlation_of(ends), [0.0, n_point.LARGEST_CORRELATION], atol=1e-7)


def test_refused_surfaces():
    for density in (0.039, 1.1):
        with refusal("roughness_parameter", "0.03965", "1.015"):
            model.curve(np.zeros(1), groups(roughness_parameter=[0.05, density]))


# ---- the model


def test_load_and_area():
    """Hertz's formulas over the asperities of simulated profiles, in metres and pascals."""
    for quantity, place in (("load", 0), ("area", 1)):
        rows = simulated(quantity)
        h = np.unique(column(rows, "level"))
        found = model.curve(h, groups(roughness_parameter=column(rows, "density")[:: len(h)]))[place]
        assert_within_errors(found.ravel(), rows)


def test_rows_and_columns():
    """Every contact by itself, whatever the other groups."""
    density, h = np.array([0.04, 0.05, 0.3]), np.array([-1.0, 0.0, 3.0])
    together = model.curve(h, groups(roughness_parameter=density, sharpness=[0.01, 0.1, 0.3], theta=[1.0, 10.0, 100.0]))
    for row, one in enumerate(density):
        for whole, single in zip(together, model.curve(h[::-1], groups(roughness_parameter=one)), strict=True):
            assert_allclose(whole[row], single[0, ::-1], rtol=1e-13)


def test_load_and_area_grow_on_approach():
    """The area always; the load down to the mean plane at least, and then it has a maximum, 0.3 to 0.7 deviations below."""
    density = np.array([0.04, 0.05, 0.1, 0.3, 0.9])
    h = np.linspace(6.0, -10.0, 1601)
    load, area = model.curve(h, groups(roughness_parameter=density))
    assert np.isfinite(load).all() and (load > 0.0).all()
    growth = np.diff(area, axis=1) / area[:, 1:]
    assert (growth[:, h[1:] > -6.0] > 0.0).all() and growth.min() > -1e-15
    below = -(h[load.argmax(axis=1)] + summit_height(density))
    assert ((below > 0.3) & (below < 0.7)).all()
    for one, last in zip(load, load.argmax(axis=1), strict=True):
        assert (np.diff(one[: last + 1]) > 0.0).all() and (np.diff(one[last:]) < 0.0).all()


def test_between_the_theories():
    """At N R sigma of measured surfaces the area that goes with a load is of the size of the others': 2.5 to 6 p/(E* h')."""
    density = np.array([0.04, 0.05, 0.07])
    load, area = model.curve(np.array([0.0, 1.0]), groups(roughness_parameter=density))
    kappa = math.pi * density[:, None] * area / reduced_pressure(load, density[:, None])
    assert ((kappa > 2.5) & (kappa < 6.0)).all()
