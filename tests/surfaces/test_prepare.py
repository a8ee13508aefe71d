"""Preparing surfaces: polynomials, harmonic functions and waves, whose levelled, filled and filtered heights are known."""

import math

import numpy as np
import pytest
from scipy.special import erf

from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.filters import filter_band, filter_period
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import level, remove_form
from stiction.surfaces.spikes import mask_spikes, spikes


def grid(rows, columns):
    return np.mgrid[:rows, :columns].astype(float)


def rough(rows=60, columns=90, seed=1):
    return 1e-7 * np.random.default_rng(seed).standard_normal((rows, columns))


def holed(heights, seed=2, share=0.1):
    result = heights.copy()
    result[np.random.default_rng(seed).random(heights.shape) < share] = np.nan
    result[20:30, 25:45] = np.nan
    return result


# ---- form


@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_polynomials_are_removed_to_nothing(order, missing):
    y, x = grid(60, 90)
    heights = 5e-3 + sum(
        (-1.0) ** j * 1e-6 * (i + 1) * (x / 50.0) ** i * (y / 50.0) ** j for i in range(5) for j in range(5) if i + j <= order
    )
    surface = HeightMap(holed(heights) if missing else heights, (60e-6, 90e-6))
    flat = level(surface) if order == 1 else remove_form(surface, order)
    there = flat.heights[~np.isnan(surface.heights)]
    assert np.abs(there).max() < 1e-12 * 5e-3 and flat.missing == surface.missing and flat.size == surface.size
    assert flat.history[-1].startswith("levelled" if order == 1 else "form removed")


@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize("order", [1, 3])
def test_form_is_that_of_the_plain_normal_equations(order, missing):
    heights = holed(rough()) if missing else rough()
    y, x = grid(*heights.shape) / 40.0
    there = ~np.isnan(heights)
    terms = np.stack([(x**i * y**j)[there] for i in range(order + 1) for j in range(order + 1 - i)], axis=1)
    expected = heights[there] - terms @ np.linalg.lstsq(terms, heights[there], rcond=None)[0]
    found = remove_form(HeightMap(heights, (1.0, 2.0)), order).heights
    np.testing.assert_allclose(found[there], expected, rtol=0.0, atol=1e-12 * 1e-7)


def test_profile_is_levelled_as_a_line():
    x = np.arange(100.0)
    heights = rough(1, 100) + 1e-6 * x
    expected = heights[0] - np.polyval(np.polyfit(x, heights[0], 1), x)
    flat = level(HeightMap(heights, (1e-6, 1e-4)))
    np.testing.assert_allclose(flat.heights[0], expected, rtol=0.0, atol=1e-18)
    assert "line" in flat.history[-1]
    np.testing.assert_allclose(remove_form(HeightMap(heights, (1e-6, 1e-4)), 1).heights, flat.heights)


def test_form_of_points_on_one_line():
    """A plane through one column of points is not determined, but what it leaves of them is."""
    heights = np.full((20, 20), np.nan)
    heights[:, 7] = 3e-6 * np.arange(20) + 1e-6
    assert np.nanmax(np.abs(level(HeightMap(heights, (1.0, 1.0))).heights)) < 1e-18


def test_form_that_cannot_be_removed():
    for order in (0, 5, 2.5, True, "2"):
        with refusal("order", "1, 2, 3"):
            remove_form(HeightMap(rough(), (1.0, 1.0)), order)
    few = np.full((20, 20), np.nan)
    few[0, :5] = 1e-6
    with refusal("scan", "5", "6"):
        remove_form(HeightMap(few, (1.0, 1.0)), 2)


# ---- missing points


def test_harmonic_functions_are_restored():
    """x^2 - y^2 and x y are harmonic, in the discrete equations too; the pitch differs along x and y."""
    y, x = grid(60, 90) * np.array([2e-6, 1e-6])[:, None, None]
    heights = 3e-5 + x * y + 0.5 * (x * x - y * y) + 1e-2 * x
    surface = HeightMap(holed(heights, share=0.0), (120e-6, 90e-6))
    filled = fill_missing(surface)
    assert filled.complete and filled.history[-1] == "200 missing points filled: harmonic"
    assert np.abs(filled.heights - heights).max() < 1e-7 * np.ptp(heights)


@pytest.mark.parametrize("stretch", [1.0, 3.0])
def test_wide_holes_are_filled_to_the_same_accuracy(stretch):
    """x^2 - y^2 is harmonic for differences too; here in one hole of many points and in many small ones."""
    y, x = grid(160, 200)
    heights = 1e-9 * ((x - 90.0) ** 2 - (stretch * (y - 70.0)) ** 2)
    missing = np.random.default_rng(5).random(heights.shape) < 0.2
    missing[30:120, 40:170] = True
    missing[[0, -1]] = missing[:, [0, -1]] = False  # an edge would be taken as level
    filled = fill_missing(HeightMap(np.where(missing, np.nan, heights), (160.0 * stretch, 200.0))).heights
    assert np.abs(filled - heights).max() < 1e-7 * np.ptp(heights)


def test_filled_heights_stay_between_their_neighbours_and_the_others_as_they_were():
    surface = HeightMap(holed(rough()), (1e-4, 1e-4))
    for way in ("harmonic", "nearest"):
        filled = fill_missing(surface, way).heights
        there = ~np.isnan(surface.heights)
        np.testing.assert_allclose(filled[there], surface.heights[there], rtol=0.0, atol=1e-22)
        assert np.nanmin(surface.heights) <= filled.min() and filled.max() <= np.nanmax(surface.heights)


def test_nearest_and_the_edge_of_the_map():
    profile = HeightMap(np.array([[np.nan, 1.0, 2.0, np.nan, np.nan, np.nan, 6.0, np.nan]]), (1.0, 8.0))
    assert fill_missing(profile, "nearest").heights[0, [0, 3, 5, 7]].tolist() == [1.0, 2.0, 6.0, 6.0]
    np.testing.assert_allclose(fill_missing(profile).heights[0], [1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.0], rtol=1e-7)


def test_nothing_to_fill_and_nothing_to_fill_from():
    surface = HeightMap(rough(), (1.0, 1.0))
    assert np.array_equal(fill_missing(surface).heights, surface.heights)
    level_hole = HeightMap(holed(np.full((60, 90), 4.0)), (1.0, 1.0))
    assert np.array_equal(fill_missing(level_hole).heights, np.full((60, 90), 4.0))
    with refusal("scan", "81"):
        fill_missing(HeightMap(np.full((9, 9), np.nan), (1.0, 1.0)))
    with refusal("fill", "zeros", "harmonic", "nearest"):
        fill_missing(surface, "zeros")


# ---- filter


@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize("ratio", [0.25, 0.5, 1.0, 2.0, 4.0])
def test_waves_pass_as_the_standard_says(ratio, missing):
    """exp(-ln 2 (cutoff / wavelength)^2) far from edges, 50 % at the cutoff; in any direction."""
    rows, columns, pitch, cutoff = 400, 500, 0.5e-6, 20e-6
    y, x = grid(rows, columns) * pitch
    wavelength, angle = cutoff / ratio, 0.6
    wave = 1e-7 * np.cos(2.0 * math.pi / wavelength * (x * math.cos(angle) + y * math.sin(angle)) + 0.3)
    heights = wave.copy()
    if missing:
        heights[:30, :] = np.nan  # outside what is looked at, but on the way of the other algorithm
    surface = HeightMap(heights, (rows * pitch, columns * pitch))
    inside = np.s_[120:-80, 80:-80]
    passed = math.exp(-math.log(2.0) * ratio**2)
    found = filter_band(surface, shortest=cutoff)
    np.testing.assert_allclose(found.heights[inside], passed * wave[inside], rtol=0.0, atol=1e-8 * 1e-7)
    rest = filter_band(surface, longest="20 um")
    np.testing.assert_allclose(rest.heights[inside], (1.0 - passed) * wave[inside], rtol=0.0, atol=1e-8 * 1e-7)
    assert found.missing == surface.missing and "50 % at the cutoffs" in found.history[-1]


def test_waves_of_a_period_pass_as_the_standard_says_up_to_its_ends():
    """exp(-ln 2 (cutoff / wavelength)^2) of every wave that goes on over the ends: a sum of two, by each of its own."""
    rows, columns, size, cutoff = 60, 90, (30e-6, 60e-6), 8e-6
    y, x = grid(rows, columns) * [[[size[0] / rows]], [[size[1] / columns]]]
    waves = [(3, 1), (2, 11)]
    parts = [1e-7 * np.cos(2.0 * math.pi * (i * y / size[0] + j * x / size[1]) + 0.4) for i, j in waves]
    passed = [math.exp(-math.log(2.0) * cutoff**2 * ((i / size[0]) ** 2 + (j / size[1]) ** 2)) for i, j in waves]
    surface = HeightMap(sum(parts), size, periodic=True)
    found = filter_period(surface, shortest=cutoff)
    expected = sum(share * part for share, part in zip(passed, parts, strict=True))
    np.testing.assert_allclose(found.heights, expected, rtol=0.0, atol=1e-13 * 1e-7 * 1e2)
    assert found.periodic
    rest = filter_period(surface, longest=cutoff)
    np.testing.assert_allclose(rest.heights, surface.heights - expected, rtol=0.0, atol=1e-13 * 1e-7 * 1e2)


def test_band_is_both_filters_and_says_so():
    surface = HeightMap(rough(), (60e-6, 90e-6))
    band = filter_band(surface, "4 um", "40 um")
    after = filter_band(filter_band(surface, shortest="4 um"), longest="40 um")
    np.testing.assert_allclose(band.heights, after.heights, rtol=0.0, atol=1e-20)
    assert "wavelengths 4 µm to 40 µm" in band.history[-1]


@pytest.mark.parametrize("missing", [False, True])
def test_constant_stays_constant_to_the_edge_and_beside_holes(missing):
    heights = np.full((60, 90), 2e-6)
    surface = HeightMap(holed(heights) if missing else heights, (60e-6, 90e-6))
    filtered = filter_band(surface, shortest="15 um").heights
    np.testing.assert_allclose(filtered[~np.isnan(surface.heights)], 2e-6, rtol=1e-12)
    assert np.isnan(filtered).sum() == surface.missing


def test_profile_with_a_step():
    """A step becomes an error function of the standard's Gaussian."""
    count, cutoff = 4000, 200.0
    place = np.arange(count) - count / 2 + 0.5
    profile = HeightMap(np.where(place > 0.0, 1.0, 0.0)[None, :], (1.0, float(count)))
    alpha = math.sqrt(math.log(2.0) / math.pi)
    expected = 0.5 * (1.0 + erf(math.sqrt(math.pi) * place / (alpha * cutoff)))
    np.testing.assert_allclose(filter_band(profile, shortest=cutoff).heights[0], expected, rtol=0.0, atol=2e-5)


def test_weights_left_out_and_renormalised():
    """Against the plain sum of the definition, at the corner of a map and beside missing points."""
    heights = holed(rough())
    surface = HeightMap(heights, (60.0, 90.0))
    cutoff, (y, x) = 12.0, grid(60, 90)
    filtered = filter_band(surface, shortest=cutoff).heights
    for row, column in ((0, 0), (59, 40), (31, 33), (30, 89)):
        if np.isnan(heights[row, column]):
            continue
        distance = ((y - row) ** 2 + (x - column) ** 2) / cutoff**2
        weight = np.where(np.isnan(heights), 0.0, np.exp(-(math.pi**2) / math.log(2.0) * distance))
        expected = np.nansum(weight * heights) / weight.sum()
        assert filtered[row, column] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("shortest", "longest", "field"),
    [
        (None, None, "band"), ("1 um", None, "shortest"), ("2 m", None, "shortest"), (None, "95 um", "longest"),
        ("20 um", "20 um", "longest"), ("20 um", "10 um", "longest"), ("0 um", None, "shortest"), ("9 s", None, "shortest"),
    ],
)  # fmt: skip
def test_bands_that_cannot_be(shortest, longest, field):
    with refusal(field):
        filter_band(HeightMap(rough(), (60e-6, 90e-6)), shortest, longest)


# ---- spikes


def test_robust_deviation_is_the_standard_one_of_a_gaussian_surface():
    """Of standard normal heights, 0.27 % are beyond 3: a binomial count, within four of its deviations."""
    surface = HeightMap(np.random.default_rng(3).standard_normal((400, 400)), (1.0, 1.0))
    expected = 160_000 * 0.0026998
    assert abs(np.count_nonzero(spikes(surface, 3.0)) - expected) < 4.0 * np.sqrt(expected) + 0.01 * expected
    assert not spikes(surface).any()


def test_spikes_are_masked_and_nothing_else():
    heights = np.random.default_rng(3).standard_normal((60, 60)) * 1e-9
    heights[[3, 40], [7, 9]] += [60e-9, -80e-9]
    heights[5, 5] = np.nan
    masked = mask_spikes(HeightMap(heights, (1e-5, 1e-5)), 10.0)
    assert set(zip(*np.nonzero(np.isnan(masked.heights)), strict=True)) == {(3, 7), (5, 5), (40, 9)}
    there = ~np.isnan(masked.heights)
    np.testing.assert_array_equal(masked.heights[there], heights[there])
    assert masked.history[-1] == "2 points further than 10 robust deviations from the median masked"


def test_half_of_the_points_alike_say_nothing_of_spikes():
    assert not spikes(HeightMap(np.where(np.arange(100) < 60, 0.0, 1.0)[None], (1.0, 1.0))).any()


@pytest.mark.parametrize("times", [0.0, -1.0, np.nan, np.inf, "many"])
def test_bounds_of_spikes(times):
    with pytest.raises(InputError) as caught:
        mask_spikes(HeightMap(np.eye(9), (1.0, 1.0)), times)
    assert caught.value.field == "spikes"
