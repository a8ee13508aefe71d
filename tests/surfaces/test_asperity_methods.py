"""Asperities by five methods, against arrays of paraboloids, sinusoids, brute force, and Nayak's statistics."""

import math

import numpy as np
import pytest
from comparing import near
from scipy import fft, ndimage, stats

import stiction
from refusals import refusal
from stiction import InputError
from stiction.surfaces.asperity_method.n_point import _rises
from stiction.surfaces.asperity_method.persistence import persistent_maxima
from stiction.surfaces.asperity_method.shared.summits import FITS
from stiction.surfaces.asperity_set import Asperities, of_samples
from stiction.surfaces.finding import asperities, methods, methods_for
from stiction.surfaces.gaussian_asperities import combine, of_moments
from stiction.surfaces.height_model import exponent_of_skewness, height_model, roughness
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import GaussianCorrelation
from stiction.surfaces.theory.moments import Moments

RADIUS, PITCH, CELL, SIDE = 2e-6, (3e-8, 2e-8), 16, 5

# Of what is exact but for rounding: numbers of 1e-16 are added up, and second differences are 1/60 of the heights or more.
ROUNDING = 1e-12
FACTOR = 2.0 * math.pi / (3.0 * math.sqrt(3.0))


def surface_of(heights, pitch=PITCH, **more):
    heights = np.atleast_2d(heights)
    return HeightMap(heights, (heights.shape[0] * pitch[0], heights.shape[1] * pitch[1]), **more)


@pytest.mark.parametrize("method", ["three_point", "eight_neighbour", "persistence", "n_point"])
def test_every_asperity_says_where_it_is(method):
    rng = np.random.default_rng(7)
    heights = ndimage.gaussian_filter(rng.standard_normal((60, 90)), 2.0) * 1e-7
    heights[20:23, 40:44] = np.nan
    surface = surface_of(heights)
    found = asperities(surface, method)
    row, column = found.places.T
    there = heights[row, column] - np.nanmean(heights)
    assert len(found.places) == found.count > 20
    if method == "n_point":  # of a row of points the middle one, which is no higher than the highest
        assert np.all((there > 0.0) & (there <= found.heights + 1e-20))
    else:
        np.testing.assert_allclose(there, found.heights, rtol=1e-9, atol=1e-20)


def test_the_place_of_a_row_of_points_is_its_middle():
    line = np.array([-1.0, 1.0, 2.0, 1.0, -1.0, np.nan, -1.0, 1.0, 2.0, 3.0, 2.0, 1.0, -1.0, -7.0]) * 1e-8
    assert asperities(surface_of(line), "n_point").places.tolist() == [[0, 2], [0, 9]]


def paraboloids(tops):
    """One paraboloid of RADIUS in each cell of CELL points square, its top (m) on a point."""
    rows, columns = tops.shape
    y = (np.arange(CELL) - CELL // 2) * PITCH[0]
    x = (np.arange(CELL) - CELL // 2) * PITCH[1]
    dome = -(y[:, None] ** 2 + x**2) / (2.0 * RADIUS)
    return np.tile(dome, (rows, columns)) + np.kron(tops, np.ones((CELL, CELL)))


def gaussian_surface(seed, length, count=1024, deviation=1e-8):
    """Heights with the autocorrelation deviation^2 exp(-r^2 / length^2), length in points: alpha = 3. And its moments [SI]."""
    rng = np.random.default_rng(seed)
    q = np.hypot(np.fft.fftfreq(count)[:, None], np.fft.rfftfreq(count))  # per point
    waves = fft.rfft2(rng.standard_normal((count, count))) * np.exp(-((math.pi * length * q) ** 2) / 2.0)
    scale = deviation * length * math.sqrt(math.pi / 2.0) * math.sqrt(2.0)
    pitch = 1e-8
    across = length * pitch
    moments = Moments(deviation**2, 2.0 * deviation**2 / across**2, 12.0 * deviation**2 / across**4)
    return surface_of(scale * fft.irfft2(waves, (count, count)), (pitch, pitch)), moments


# ---- paraboloids


@pytest.mark.parametrize("fit_points", FITS)
@pytest.mark.parametrize("method", ["eight_neighbour", "persistence"])
def test_paraboloids_are_found_with_their_tops_and_radii(method, fit_points):
    tops = np.linspace(0.0, 2e-9, SIDE * SIDE).reshape(SIDE, SIDE)
    heights = paraboloids(tops)
    found = asperities(surface_of(heights), method, fit_points=fit_points)
    reach = {5: 1, 9: 1, 25: 2, 49: 3}[fit_points]
    area = (len(heights) - 2 * reach) ** 2 * PITCH[0] * PITCH[1]
    np.testing.assert_allclose(np.sort(found.heights), tops.ravel() - heights.mean(), rtol=ROUNDING)
    np.testing.assert_allclose(found.radii, RADIUS, rtol=ROUNDING)
    assert found.radius == near(RADIUS, ROUNDING)
    assert found.density == near(SIDE * SIDE / area, ROUNDING)
    assert found.deviation == near(tops.std(), ROUNDING)
    assert found.mean_height == near(tops.mean() - heights.mean(), ROUNDING)
    assert found.count == SIDE * SIDE and "fewer than 30" in found.note


def test_three_point_peaks_of_paraboloids():
    """Every row and every column cuts SIDE parabolas of the same radius."""
    heights = paraboloids(np.zeros((SIDE, SIDE)))
    found = asperities(surface_of(heights), "three_point")
    points = len(heights)
    assert found.count == 2 * points * SIDE
    np.testing.assert_allclose(found.radii, RADIUS, rtol=ROUNDING)
    inner = points - 2
    assert found.density == near(FACTOR * (SIDE / inner) ** 2 / (PITCH[0] * PITCH[1]), ROUNDING)
    one = asperities(surface_of(heights), "three_point", directions="y")
    assert one.density == near(FACTOR * (SIDE / inner / PITCH[0]) ** 2, ROUNDING)
    assert one.count == points * SIDE


def test_a_hill_stands_out_by_its_height_over_the_saddle():
    """Equal hills: along x they meet at half the distance, (CELL/2 pitch)^2 / (2 R) below, which is the shallower saddle."""
    heights = paraboloids(np.zeros((SIDE, SIDE)))
    depth = (CELL / 2 * PITCH[1]) ** 2 / (2.0 * RADIUS)
    assert asperities(surface_of(heights), "persistence", threshold=0.999 * depth).count == SIDE * SIDE
    # beyond it, rows merge: one summit each, the rows still being separate by (3/2)^2 the depth
    kept = persistent_maxima(heights, 1.001 * depth)
    assert len(kept) == SIDE and len(set(kept // heights.shape[1])) == SIDE
    assert len(persistent_maxima(heights, 2.26 * depth)) == 1


def brute_force_maxima(heights, threshold):
    """By definition, with another library: the highest level at which a maximum is connected to something higher."""
    found = []
    high = np.nan_to_num(heights, nan=-np.inf)
    for index in np.flatnonzero(np.isfinite(heights)):
        top = high.flat[index]
        saddle = -np.inf
        for level in np.unique(high[np.isfinite(high) & (high <= top)])[::-1]:
            labels, _ = ndimage.label(high >= level, structure=np.ones((3, 3)))
            if (high[labels == labels.flat[index]] > top).any():
                saddle = level
                break
        if top - saddle > threshold:
            found.append(index)
    return found


@pytest.mark.parametrize("seed", range(3))
def test_persistence_is_what_its_definition_says(seed):
    rng = np.random.default_rng(seed)
    heights = rng.permutation(12 * 9).reshape(12, 9).astype(float)
    heights[3, 4] = heights[7:9, 2] = np.nan
    for threshold in (0.0, 20.0, 60.0):
        assert persistent_maxima(heights, threshold).tolist() == brute_force_maxima(heights, threshold)


@pytest.mark.parametrize("seed", range(3))
def test_persistence_of_heights_that_are_often_equal(seed):
    """As many as of heights that differ, by less than any step, in the order in which equal ones count."""
    rng = np.random.default_rng(seed)
    heights = rng.integers(0, 12, (12, 9)).astype(float)
    heights[2, 5] = np.nan
    order = np.argsort(heights.ravel(), kind="stable")
    apart = heights.copy()
    apart.ravel()[order] += 1e-6 * np.arange(heights.size)
    for threshold in (0.0, 3.0, 7.0):
        assert persistent_maxima(heights, threshold).tolist() == brute_force_maxima(apart, threshold + 1e-3)


def test_a_plateau_is_one_summit_for_persistence_and_none_for_neighbours():
    heights = np.zeros((12, 24))
    heights[4:7, 4:7] = heights[5, 15:18] = 1e-9
    assert len(persistent_maxima(heights, 0.5e-9)) == 2
    with refusal("asperities by eight_neighbour", "0"):
        asperities(surface_of(heights), "eight_neighbour")


def test_the_curvature_is_that_of_a_least_squares_fit():
    """Against numpy's least squares with all six terms, at the summits of a rough map."""
    surface, _ = gaussian_surface(1, 5.0, count=96)
    z, (dy, dx) = surface.heights, surface.pitch
    for points, reach in ((9, 1), (25, 2), (49, 3)):
        found = asperities(surface, "eight_neighbour", fit_points=points)
        y, x = (one.ravel() for one in np.mgrid[-reach : reach + 1, -reach : reach + 1])
        y, x = y * dy, x * dx
        # lengths in pitches keep the matrix well conditioned
        terms = np.column_stack([np.ones_like(x), x / dx, y / dy, (x / dx) ** 2, x * y / (dx * dy), (y / dy) ** 2])
        expected = []
        for i in range(reach, 96 - reach):
            for j in range(reach, 96 - reach):
                around = z[i - 1 : i + 2, j - 1 : j + 2]
                if z[i, j] == around.max() and (around == z[i, j]).sum() == 1:
                    window = z[i - reach : i + reach + 1, j - reach : j + reach + 1].ravel()
                    fit = np.linalg.lstsq(terms, window, rcond=None)[0]
                    expected.append(-(fit[3] / dx**2 + fit[5] / dy**2))
        curvatures = np.where(np.isfinite(found.radii), 1.0 / found.radii, np.minimum(expected, 0.0))
        np.testing.assert_allclose(curvatures, expected, rtol=1e-8)
        assert found.radius == near(1.0 / np.mean(expected), rel=1e-8)


# ---- a lay


@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_summits_of_a_surface_with_a_lay_are_those_counted_one_by_one(angle):
    """Eight neighbours by scipy's filter. Standing out, for every such maximum: nothing higher is connected to it at a level
    lower by the threshold. Both of what is far enough from the border, per area where that is so."""
    target, length, threshold = GaussianCorrelation(deviation=1e-8, length=1e-7), 1e-7, 2e-9
    surface = stiction.gaussian_surface((192, 384), (24 * length, 48 * length), target, 3, stretch=5.0, angle=angle)
    z, (dy, dx) = surface.heights, surface.pitch
    around = np.ones((3, 3), dtype=bool)
    around[1, 1] = False
    higher = z > ndimage.maximum_filter(z, footprint=around, mode="constant", cval=-np.inf)
    standing = np.zeros_like(higher)
    for top in zip(*np.nonzero(higher), strict=True):
        hills, _ = ndimage.label(z >= z[top] - threshold, structure=np.ones((3, 3)))
        standing[top] = z[hills == hills[top]].max() == z[top]
    for method, own, reach, options in (
        ("eight_neighbour", higher, 1, {}), ("persistence", standing, 2, {"threshold": threshold}),
    ):  # fmt: skip
        inner = slice(reach, -reach), slice(reach, -reach)
        found = asperities(surface, method, **options)
        assert found.count == np.count_nonzero(own[inner]) > 30
        assert found.density == near(np.count_nonzero(own[inner]) / (own[inner].size * dy * dx), ROUNDING)
        np.testing.assert_array_equal(found.heights, (z - z.mean())[inner][own[inner]])
    assert np.count_nonzero(standing) < 0.7 * np.count_nonzero(higher)  # so that the threshold is tried


# ---- sinusoids

STEPS, WAVES, AMPLITUDE = 16, 6, 3e-9


def egg_crate():
    phase = 2.0 * math.pi / STEPS * np.arange(STEPS * WAVES)
    return surface_of(AMPLITUDE * np.cos(phase)[:, None] * np.cos(phase), (1e-8, 1e-8))


@pytest.mark.parametrize(("fit_points", "share"), [(5, 1.0), (9, (1.0 + 2.0 * math.cos(2.0 * math.pi / STEPS)) / 3.0)])
def test_summits_of_an_egg_crate(fit_points, share):
    """cos x cos y: two summits per period square; second differences see k^2 as 2 (1 - cos k d) / d^2."""
    found = asperities(egg_crate(), "eight_neighbour", fit_points=fit_points)
    curvature = AMPLITUDE * 2.0 * (1.0 - math.cos(2.0 * math.pi / STEPS)) / 1e-16
    assert found.radius == near(1.0 / (share * curvature), ROUNDING)
    # at the border half of the lattice is lost: (0, 0) and its like are in the first row and column
    assert found.count == (WAVES - 1) ** 2 + WAVES**2
    assert found.mean_height == near(AMPLITUDE, ROUNDING)
    assert found.deviation == found.skewness == 0.0
    assert height_model(found).name == "gaussian"


def test_moments_of_an_egg_crate():
    """m0, m2, m4 = A^2/4 {1, k^2, k^4}: alpha = 1, which no isotropic Gaussian surface has.

    Of the whole waves the slopes miss one sin^2, half a pitch beyond the last point, and the second derivatives two cos^2, at
    the ends. At this alpha what is left of m0 for the summits depends on that. In the cells, which miss the last of the whole
    waves along both, slopes along x and y are correlated by 1.6e-5, so that m2 may be less by half of its square, m4 by all.
    """
    found = asperities(egg_crate(), "mccool")
    points, phase = STEPS * WAVES, 2.0 * math.pi / STEPS
    k = 2.0 * math.sin(phase / 2.0) / 1e-8  # by differences
    m2 = AMPLITUDE**2 / 2.0 * k**2 * (points / 2 - math.sin(phase / 2.0) ** 2) / (points - 1)
    m4 = AMPLITUDE**2 / 2.0 * k**4 * (points / 2 - 1.0 - math.cos(phase) ** 2) / (points - 2)
    deficit = 1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)
    assert found.deviation == near(math.sqrt(AMPLITUDE**2 / 4.0 - deficit * m2**2 / m4), ROUNDING)
    sin_cos, half = math.sin(phase) / 2.0, points / 2
    correlation = sin_cos**2 / ((half - math.sin(phase / 2.0) ** 2) * (half - math.cos(phase / 2.0) ** 2))
    assert found.radius == near(3.0 / 8.0 * math.sqrt(math.pi / m4), correlation**2)
    assert found.density == near(m4 / m2 / (6.0 * math.pi * math.sqrt(3.0)), correlation**2)
    assert "no isotropic Gaussian surface has such a low value" in found.note


def test_n_point_asperities_of_a_sinusoid():
    """Of 16 points a wave 7 are above 0.1 A, the neighbours 8 pitches apart: R = 64 d^2 / (8 x 0.9 A)."""
    profile = AMPLITUDE * np.cos(2.0 * math.pi / STEPS * np.arange(STEPS * WAVES))
    found = asperities(surface_of(profile, (1.0, 1e-8)), "n_point", level=0.1 * AMPLITUDE)
    assert found.count == WAVES - 1  # the first begins before the profile, the last ends after it
    np.testing.assert_allclose(found.heights, AMPLITUDE, rtol=ROUNDING)
    np.testing.assert_allclose(found.radii, 64e-16 / (8.0 * 0.9 * AMPLITUDE), rtol=ROUNDING)
    assert found.density == near(FACTOR * (WAVES / ((STEPS * WAVES - 1) * 1e-8)) ** 2, ROUNDING)


# ---- Gaussian surfaces

SEEDS = range(4)


def mean_over_seeds(method, length, **options):
    found = [asperities(gaussian_surface(seed, length)[0], method, **options) for seed in SEEDS]
    return {name: np.mean([getattr(one, name) for one in found]) for name in ("deviation", "radius", "density", "mean_height")}


# Sampling: 4 maps with 1024^2 / (pi sqrt(3) 10^2) = 1900 summits each; 300 independent patches each for the heights.
@pytest.mark.parametrize(
    ("method", "options"),
    [
        ("mccool", {}),
        ("eight_neighbour", {"fit_points": 5}),
        ("persistence", {"threshold": 0.0, "fit_points": 9}),
    ],
)
def test_a_gaussian_surface_has_the_summits_of_nayak(method, options):
    _, moments = gaussian_surface(0, 10.0, count=8)
    deviation, radius, density = moments.asperities()
    found = mean_over_seeds(method, 10.0, **options)
    assert found["deviation"] == near(deviation, rel=0.03)
    assert found["radius"] == near(radius, rel=0.03)
    assert found["density"] == near(density, rel=0.03)
    assert found["mean_height"] == near(moments.summit_height, rel=0.03)


def test_peaks_of_a_gaussian_profile():
    """(1/2 pi) sqrt(m4/m2) peaks per length; their curvature is Rayleigh's and the height follows it by m2/m4."""
    _, moments = gaussian_surface(0, 10.0, count=8)
    m0, m2, m4 = moments.m0, moments.m2, moments.m4
    found = mean_over_seeds("three_point", 10.0)
    assert found["density"] == near(moments.asperities()[2], rel=0.02)
    assert found["radius"] == near(math.sqrt(2.0 / (math.pi * m4)), rel=0.02)
    assert found["mean_height"] == near(m2 * math.sqrt(math.pi / (2.0 * m4)), rel=0.03)
    assert found["deviation"] == near(math.sqrt(m0 - (math.pi / 2.0 - 1.0) * m2 * m2 / m4), rel=0.03)


def test_n_point_asperities_are_counted_by_the_zero_crossings():
    """Rice: (1/2 pi) sqrt(m2/m0) upward crossings of the mean per length."""
    _, moments = gaussian_surface(0, 10.0, count=8)
    crossings = math.sqrt(moments.m2 / moments.m0) / (2.0 * math.pi)
    assert mean_over_seeds("n_point", 10.0)["density"] == near(FACTOR * crossings**2, rel=0.04)


def test_a_threshold_leaves_fewer_and_higher_summits():
    surface, _ = gaussian_surface(0, 10.0)
    sets = [asperities(surface, "persistence", threshold=share * 1e-8) for share in (0.0, 0.2, 0.5, 1.0)]
    assert np.all(np.diff([one.density for one in sets]) < 0.0)
    assert np.all(np.diff([one.mean_height for one in sets]) > 0.0)
    default = asperities(surface, "persistence")
    whole = np.ptp(surface.heights)
    assert default.count == asperities(surface, "persistence", threshold=0.05 * whole).count


@pytest.mark.parametrize("method", ["three_point", "eight_neighbour", "persistence", "n_point"])
def test_skewness_follows_the_surface(method):
    surface, _ = gaussian_surface(2, 6.0, count=512)
    z = surface.heights / 1e-8
    peaked = asperities(surface_of(1e-8 * np.exp(0.7 * z), surface.pitch), method)
    worn = asperities(surface_of(-1e-8 * np.exp(-0.7 * z), surface.pitch), method)
    assert peaked.skewness > 0.8 > 0.4 > worn.skewness
    assert peaked.skewness == near(float(stats.skew(peaked.heights)), rel=1e-9)


# ---- missing points


@pytest.mark.parametrize("method", methods())
def test_missing_points_are_left_out(method):
    """A hole of missing points changes neither density nor heights by more than chance, a tenth of the map having 70 summits or
    more: 1 / (70 * 9)^(1/2) / 3; every number is finite."""
    surface, _ = gaussian_surface(3, 6.0, count=512)
    heights = surface.heights.copy()
    heights[100:200, 50:300] = np.nan
    heights[::37, ::41] = np.nan
    whole, holed = asperities(surface, method), asperities(surface_of(heights, surface.pitch), method)
    for name in ("density", "deviation", "radius", "mean_height"):
        assert getattr(holed, name) == near(getattr(whole, name), rel=0.02), name
    assert np.isfinite(holed.heights).all() and not np.isnan(holed.radii).any()


def test_a_summit_beside_a_missing_point_is_left_out_with_its_area():
    heights = paraboloids(np.linspace(0.0, 2e-9, SIDE * SIDE).reshape(SIDE, SIDE))
    heights[CELL // 2, CELL // 2 + 1] = np.nan
    found = asperities(surface_of(heights), "eight_neighbour")
    area = ((len(heights) - 2) ** 2 - 9) * PITCH[0] * PITCH[1]
    assert found.density == near((SIDE * SIDE - 1) / area, ROUNDING)


# ---- distribution of the heights


def set_of(samples):
    return of_samples("made", np.asarray(samples), np.ones(len(samples)), 1e12, "made")


def test_the_height_model_is_the_simplest_that_is_good_enough():
    rng = np.random.default_rng(5)
    gauss = height_model(set_of(1e-8 * rng.standard_normal(5000)))
    assert gauss.name == "gaussian" and gauss.parameters == {}
    assert gauss.allowed == near(0.886 / 10.0)  # of 100 independent heights, however many there are
    weibull = height_model(set_of(1e-8 * rng.weibull(1.15, 5000)))
    assert weibull.name == "weibull" and weibull.distances["gaussian"] > weibull.allowed
    assert weibull.parameters["exponent"] == near(1.15, rel=0.08)  # by the skewness of 5000, which scatters by 2 %
    many = height_model(set_of(1e-8 * np.random.default_rng(6).weibull(1.15, 400_000)))
    assert many.parameters["exponent"] == near(1.15, rel=0.01)
    milder = height_model(set_of(1e-8 * rng.weibull(1.8, 5000)), "weibull")
    assert milder.likelihoods["weibull"] > milder.likelihoods["gaussian"] and milder.reason.startswith("as wanted")
    both = 1e-8 * np.concatenate([rng.normal(-2.0, 0.5, 3000), rng.normal(2.0, 0.5, 3000)])
    empirical = height_model(set_of(both))
    assert empirical.name == "empirical" and len(empirical.parameters["samples"]) == 2000
    z = (both - both.mean()) / both.std()
    assert empirical.distances["gaussian"] == near(stats.kstest(z, "norm").statistic, rel=1e-9)
    for model in (gauss, weibull, empirical):
        assert roughness(set_of(both), model).height_distribution == model.name


@pytest.mark.parametrize(("count", "sets"), [(50, 400), (5000, 100)])
def test_one_in_twenty_true_samples_is_refused(count, sets):
    """Lilliefors' bound, with mean and deviation from the sample: 5 % of true Gaussian samples of 50 exceed it, within four
    deviations of a binomial count; of 5000 independent ones none, since no more than 100 are believed to be so."""
    rng = np.random.default_rng(11)
    refused = sum(height_model(set_of(rng.standard_normal(count))).name != "gaussian" for _ in range(sets))
    assert abs(refused - 20.0) < 4.0 * math.sqrt(19.0) if count == 50 else refused == 0


def test_the_highest_and_the_lowest_are_among_the_heights_as_found():
    both = np.concatenate([np.random.default_rng(5).normal(at, 0.1, 4000) for at in (-2.0, 2.0)])
    samples = height_model(set_of(both)).parameters["samples"]
    z = (both - both.mean()) / both.std()
    assert (samples[0], samples[-1]) == near((z.min(), z.max()), rel=1e-12)


def test_the_heights_of_a_skewed_surface_are_not_taken_for_gaussian():
    """exp of Gaussian heights: long ridges upwards. Its summits' skewness is theirs, and beyond what Weibull's heights have."""
    surface, _ = gaussian_surface(2, 6.0, count=512)
    model = height_model(asperities(surface_of(1e-8 * np.exp(surface.heights / 1e-8), surface.pitch), "eight_neighbour"))
    assert model.skewness > 2.0 and model.name == "empirical"
    assert min(model.distances.values()) > model.allowed


@pytest.mark.parametrize(("kind", "samples"), [
    ("gaussian", lambda rng: rng.standard_normal(5000)),
    ("weibull", lambda rng: rng.weibull(1.15, 5000)),
    ("empirical", lambda rng: np.concatenate([rng.normal(-2.0, 0.5, 3000), rng.normal(2.0, 0.5, 3000)])),
])  # fmt: skip
def test_a_contact_with_the_roughness_found_can_be_solved(kind, samples):
    found = of_samples("made", 2e-8 * samples(np.random.default_rng(5)), np.array([1e6]), 1e13, "made")
    rough = roughness(found)
    assert rough.height_distribution == kind and rough.asperity_height_deviation == found.deviation
    contact = stiction.Contact(
        first="silver", second="iron", roughness=rough, work_of_adhesion="0.1 J/m^2", nominal_area="1 mm^2",
    )  # fmt: skip
    solved = stiction.solve(contact, load="1 N")
    assert 0.0 < float(solved["friction_coefficient"]) < 10.0
    assert float(solved["load"]) == near(1.0, rel=1e-9)


def test_equal_heights_make_no_roughness():
    with refusal("asperity_height_deviation", "> 0 m"):
        roughness(of_samples("made", np.ones(40), np.ones(40), 1e12, "made"))


@pytest.mark.parametrize("exponent", [1.0, 1.5, 3.6, 20.0])
def test_exponent_of_a_skewness(exponent):
    skewness = float(stats.weibull_min.stats(exponent, moments="s"))
    assert exponent_of_skewness(skewness) == near(exponent, rel=1e-6)
    assert exponent_of_skewness(5.0) == 1.0 and exponent_of_skewness(-5.0) == 100.0


def test_few_heights_are_taken_for_gaussian():
    model = height_model(set_of(np.arange(20.0) * 1e-9))
    assert model.name == "gaussian" and "assumed" in model.reason


# ---- two surfaces


def test_two_surfaces_add_by_their_moments():
    """Of two surfaces alike m0, m2, m4 double: sigma grows by sqrt(2), R falls by it, N stays. A smooth one adds nothing."""
    surface, _ = gaussian_surface(0, 10.0, count=256)
    one = asperities(surface, "mccool")
    two = combine(one, one)
    assert two.deviation == near(math.sqrt(2.0) * one.deviation, ROUNDING)
    assert two.radius == near(one.radius / math.sqrt(2.0), ROUNDING)
    assert two.density == near(one.density, ROUNDING)
    smooth = Asperities("mccool", 5e13, 1e-12, 1e-3, 0.0, 0.0, "")  # N R sigma = 0.05; its sigma^2 is 1.7e-8 of the other
    assert combine(one, smooth).deviation == near(one.deviation, rel=1e-7)


# ---- what is refused


@pytest.mark.parametrize(
    ("call", "field"),
    [
        (lambda: asperities(egg_crate(), "no_such"), "method"),
        (lambda: asperities(egg_crate(), "mccool", threshold=1.0), "threshold"),
        (lambda: asperities(egg_crate(), "eight_neighbour", fit_points=7), "fit_points"),
        (lambda: asperities(egg_crate(), "persistence", threshold=-1.0), "threshold"),
        (lambda: asperities(egg_crate(), "persistence", threshold=math.nan), "threshold"),
        (lambda: asperities(egg_crate(), "three_point", directions="z"), "directions"),
        (lambda: asperities(egg_crate(), "n_point", level=math.nan), "level"),
        (lambda: asperities(surface_of(np.full((9, 9), np.nan)), "mccool"), "heights"),
        (lambda: asperities(surface_of(np.ones((2, 9))), "eight_neighbour"), "heights"),
        (lambda: of_moments("mccool", Moments(1.0, 1.0, 0.5), ""), "asperities by mccool"),
    ],
)
def test_what_will_not_do_is_one_clear_line(call, field):
    with pytest.raises(InputError) as raised:
        call()
    assert raised.value.field == field and "\n" not in str(raised.value)


@pytest.mark.parametrize("method", methods())
def test_a_constant_map_has_no_asperities(method):
    with pytest.raises(InputError):
        asperities(surface_of(np.ones((16, 16))), method)


def test_a_profile_has_the_methods_of_profiles():
    rng = np.random.default_rng(0)
    profile = surface_of(1e-9 * rng.standard_normal(400), (1e-6, 1e-8))
    assert methods_for(profile) == ("three_point", "n_point", "mccool")
    for method in methods():
        if method in methods_for(profile):
            assert asperities(profile, method).density > 0.0
        else:
            with refusal("heights", "(1, 400)", "3"):
                asperities(profile, method)


def test_lengths_may_be_text_with_a_unit():
    spectrum = stiction.SelfAffine(hurst=0.8, rolloff="5 um", shortest="1 um", deviation="10 nm")
    assert spectrum == stiction.SelfAffine(hurst=0.8, rolloff=5e-6, shortest=1e-6, deviation=1e-8)
    surface = stiction.gaussian_surface((64, 64), ("10 um", "10 um"), spectrum, seed=1)
    assert surface.size == (1e-5, 1e-5) == stiction.HeightMap(surface.heights, ("10 um", 1e-5)).size
    for method, name, text, number in (
        ("persistence", "threshold", "2 nm", 2e-9), ("mccool", "cutoff", "1 um", 1e-6), ("n_point", "level", "-3 nm", -3e-9),
    ):  # fmt: skip
        one, two = (stiction.asperities(surface, method, **{name: value}) for value in (text, number))
        assert (one.deviation, one.radius, one.density) == (two.deviation, two.radius, two.density)
        with refusal(name):
            stiction.asperities(surface, method, **{name: "2 kg"})
        with refusal(name):
            stiction.asperities(surface, method, **{name: [1.0]})
    assert stiction.resolution_study(surface, ["0.8 um"])["cutoff"].item() == 0.8e-6
    for size in ("10 um", ("10 um",), ("10 um", "far"), (1.0, np.inf), 3.0):
        with refusal("size", "(y, x)"):
            stiction.HeightMap(surface.heights, size)


def test_rises_through_a_level_are_of_the_neighbours_that_are_known():
    gap = np.nan
    assert _rises(np.array([[0.0, 2.0]]), 1.0) == 1.0 and _rises(np.array([[2.0, 0.0]]), 1.0) == 0.0
    assert _rises(np.array([[0.0, 2.0, 0.5, gap, 3.0, 0.0, 4.0]]), 1.0) == 2.0 / 4.0
    assert _rises(np.array([[gap, 2.0], [0.0, gap]]), 1.0) == 0.0
