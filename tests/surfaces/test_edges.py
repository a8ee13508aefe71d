"""Where a limit, a rounding or a second pass decides: on surfaces made so that it does."""

import math

import numpy as np
import pytest
from comparing import near
from scipy import stats

from refusals import refusal
from stiction.studies.scans.resolution import resolution_study
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.filters import filter_band
from stiction.surfaces.finding import asperities
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap, metres
from stiction.surfaces.johnson import johnson
from stiction.surfaces.prepare import level, remove_form
from stiction.surfaces.read import read_scan
from stiction.surfaces.spectrum import power_spectrum, radial_average
from stiction.surfaces.statistics import moments_by_differences, moments_by_spectrum
from stiction.surfaces.targets import GaussianCorrelation, SelfAffine


def grid(rows, columns):
    return np.mgrid[:rows, :columns].astype(float)


# ---- heights of a given skewness and kurtosis


@pytest.mark.parametrize("shape", (0.2, 0.5))
@pytest.mark.parametrize("over", (-1.9e-3, -5e-4, 5e-4, 1.9e-3))
def test_a_pair_beside_the_lognormal_line_is_taken_as_on_it(shape, over):
    """Within 2e-3 of kurtosis; the neighbouring curves end on the line, and would be sought in vain."""
    known = stats.lognorm(shape)
    skewness, excess = (float(value) for value in known.stats("sk"))
    z = np.linspace(-4.0, 4.0, 41)
    expected = (np.exp(shape * z) - known.mean()) / known.std()
    np.testing.assert_allclose(johnson(skewness, excess + 3.0 + over)(z), expected, atol=1e-9)


@pytest.mark.parametrize("shape", (0.2, 0.5))
@pytest.mark.parametrize("over", (-1e-2, -2.5e-3, 2.5e-3, 1e-2))
def test_a_pair_farther_from_it_has_its_own_curve(shape, over):
    """Moments by a rule that is exact for what falls off like a Gaussian."""
    skewness, excess = (float(value) for value in stats.lognorm(shape).stats("sk"))
    z, step = np.linspace(-14.0, 14.0, 2801, retstep=True)
    weight = stats.norm.pdf(z) * step
    heights = johnson(skewness, excess + 3.0 + over)(z)
    assert weight @ heights == pytest.approx(0.0, abs=1e-12) and weight @ heights**2 == pytest.approx(1.0, abs=1e-12)
    assert weight @ heights**3 == pytest.approx(skewness, abs=1e-5)
    assert weight @ heights**4 == pytest.approx(excess + 3.0 + over, abs=1e-5)


@pytest.mark.parametrize("over", (-1.5e-3, 1.5e-3))
def test_next_to_nothing_of_skewness_and_excess_is_gaussian(over):
    z = np.linspace(-4.0, 4.0, 41)
    np.testing.assert_array_equal(johnson(1.5e-3, 3.0 + over)(z), z)


# ---- missing points


@pytest.mark.parametrize("pitch", ((3.0, 1.0), (1.0, 3.0)))
def test_the_nearest_point_is_nearest_in_metres(pitch):
    """A hole of one point: of its neighbours those along the finer pitch are nearest, and of a wider one the first that is
    there along it, though three pitches away."""
    heights = np.arange(81.0).reshape(9, 9)
    along = 1 if pitch[1] < pitch[0] else 0
    heights[4, 4] = np.nan
    one = fill_missing(HeightMap(heights, (9 * pitch[0], 9 * pitch[1])), "nearest").heights[4, 4]
    assert one in ((39.0, 41.0) if along == 1 else (31.0, 49.0))
    heights[(slice(4, 5), slice(3, 6)) if along == 1 else (slice(3, 6), slice(4, 5))] = np.nan
    wider = fill_missing(HeightMap(heights, (9 * pitch[0], 9 * pitch[1])), "nearest").heights[4, 4]
    assert wider in ((38.0, 42.0) if along == 1 else (22.0, 58.0))


@pytest.mark.parametrize("pitch", ((4.0, 1.0), (1.0, 4.0)))
def test_the_harmonic_height_of_one_hole(pitch):
    """One point missing among four neighbours: the Laplacian's difference is nothing, (a + b)/dx^2 + (c + d)/dy^2 over the
    weights. At the edge of the map without the neighbour that is not there."""
    heights = np.random.default_rng(4).standard_normal((9, 9))
    dy, dx = pitch
    known = heights.copy()
    heights[4, 4] = heights[0, 6] = np.nan
    filled = fill_missing(HeightMap(heights, (9 * dy, 9 * dx))).heights
    inside = (known[4, 3] + known[4, 5]) / dx**2 + (known[3, 4] + known[5, 4]) / dy**2
    assert filled[4, 4] == pytest.approx(inside / (2.0 / dx**2 + 2.0 / dy**2), rel=1e-8)
    edge = (known[0, 5] + known[0, 7]) / dx**2 + known[1, 6] / dy**2
    assert filled[0, 6] == pytest.approx(edge / (2.0 / dx**2 + 1.0 / dy**2), rel=1e-8)


# ---- form


def test_what_form_leaves_is_rounding_alone():
    """A polynomial of the fourth order, where a third of the map is missing and much else: what is left of it is no more than
    the rounding of the heights themselves, to which one fit by normal equations does not come."""
    y, x = grid(400, 500) / np.array([400.0, 500.0])[:, None, None]
    heights = x + 0.3 * y + x**4 + y**3 * x
    missing = np.random.default_rng(0).random(heights.shape) < 0.1
    missing[:, :160] = True
    left = remove_form(HeightMap(np.where(missing, np.nan, heights), (1.0, 1.0)), 4).heights
    assert np.sqrt(np.nanmean(left**2)) < 5e-16 * np.ptp(heights[~missing])


# ---- summits


@pytest.mark.parametrize("tilt", (1e-3, 1.0))
@pytest.mark.parametrize("turned", (False, True))
def test_the_ridge_of_a_groove_has_no_summits(tilt, turned):
    """Levelling leaves differences of its rounding along a ridge: these are no peaks."""
    y, x = grid(64, 96)
    heights = 1e-7 * (np.cos(2.0 * math.pi * x / 12.0) + tilt * (0.3 * x / 96.0 + y / 64.0))
    surface = HeightMap(heights.T.copy(), (96e-6, 64e-6)) if turned else HeightMap(heights, (64e-6, 96e-6))
    flat = level(surface)
    along = flat.heights.T if turned else flat.heights
    assert 0.0 < np.ptp(along[:, 48]) < 1e-12 * np.ptp(along)  # the ridge is not level to the last digit
    with refusal("asperities by eight_neighbour", "0", "2"):
        asperities(flat, "eight_neighbour")


def test_a_summit_higher_than_rounding_is_one():
    """Bumps of 1e-9 of the height of the ridge are found, each of them."""
    y, x = grid(64, 96)
    heights = 1e-7 * (np.cos(2.0 * math.pi * x / 12.0) + 1e-9 * np.cos(2.0 * math.pi * y / 8.0))
    found = asperities(HeightMap(heights, (64e-6, 96e-6)), "eight_neighbour")
    assert found.count == 7 * 7  # those at the edges are left out


# ---- moments


@pytest.mark.parametrize("length", (1e-4, 3.7e-5, 2.0 / 3.0))
def test_a_wave_at_the_cutoff_is_counted_in(length):
    """All waves of a line, each with its own wavelength for a cutoff: m0 = a^2/2, m2 and m4 with q^2 and q^4 before it. A
    cutoff that is longer by a millionth leaves it out."""
    count = 128
    x = np.arange(count) * length / count
    for waves in range(1, count // 2):
        q = 2.0 * math.pi * waves / length
        profile = HeightMap(1e-4 * length * np.cos(q * x)[None, :], (length / count, length))
        spectrum = power_spectrum(profile, window="none")
        found = moments_by_spectrum(spectrum, cutoff=length / waves).x
        m0 = 1e-8 * length**2 / 2.0
        assert (found.m0, found.m2, found.m4) == (near(m0, 1e-9), near(m0 * q**2, 1e-9), near(m0 * q**4, 1e-9)), waves
        if waves > 1:  # else no wave is left, which is refused
            assert moments_by_spectrum(spectrum, cutoff=length / waves * (1.0 + 1e-6)).x.m0 < 1e-12 * m0


# ---- the shortest line


def wavy(rows, columns):
    y, x = grid(rows, columns)
    return HeightMap(1e-8 * np.cos(x + 0.3 * y) + 1e-9 * np.sin(2.0 * y), (rows * 1e-6, columns * 1e-6))


def test_lines_of_eight_points_have_a_spectrum_and_of_seven_none():
    """Of maps and of profiles: LEAST_POINTS is allowed."""
    for shape in ((8, 8), (8, 20), (20, 8), (1, 8)):
        assert np.all(radial_average(power_spectrum(wavy(*shape))).density >= 0.0)
    for shape in ((7, 20), (20, 7), (1, 7)):
        with refusal("heights", "8"):
            power_spectrum(wavy(*shape))


def test_scans_of_eight_points_are_read_and_of_seven_not(tmp_path):
    for shape in ((8, 9), (9, 8), (1, 8)):
        np.save(tmp_path / "scan.npy", wavy(*shape).heights)
        assert read_scan(tmp_path / "scan.npy", size="9 um", unit="m").heights.shape == shape
    for shape in ((7, 9), (9, 7), (1, 7)):
        np.save(tmp_path / "scan.npy", wavy(*shape).heights)
        with refusal("scan", "8"):
            read_scan(tmp_path / "scan.npy", size="9 um", unit="m")
    for count in (8, 7):
        path = tmp_path / "profile.csv"
        path.write_text("".join(f"{i}.0,{10.0 + 0.1 * i * i}\n" for i in range(count)))
        if count == 8:
            assert read_scan(path, unit="um").heights.shape == (1, 8)
        else:
            with refusal("scan", "8"):
                read_scan(path, unit="um")


def test_the_shortest_wave_kept_may_be_just_two_pitches_and_the_longest_the_size():
    """Whatever the rounding of a pitch makes of it."""
    for count in range(8, 200):
        length = f"{count / 10:.1f} um"
        profile = HeightMap(wavy(1, count).heights, (1e-7, metres(length, "size")))
        assert filter_band(profile, shortest="0.2 um", longest=length).missing == 0
        for wrong in ({"shortest": "0.1999998 um"}, {"longest": f"{count / 10 * 1.000001:.8f} um"}):
            with refusal(*next(iter(wrong.items())), "200 nm"):
                filter_band(profile, **wrong)


def test_the_longest_step_of_differences_needs_three_points():
    """Second differences of points `step` apart want one more than two steps; the largest cutoff of a profile of 21 points has
    steps of ten, and one of steps of eleven is refused."""
    profile = wavy(1, 21)
    second = profile.heights[0, 20] - 2.0 * profile.heights[0, 10] + profile.heights[0, 0]
    assert moments_by_differences(profile, cutoff=20e-6).x.m4 == near((second / 1e-10) ** 2, 1e-9)
    with refusal("cutoff", "2.2e-05", "2e-05 m"):
        moments_by_differences(profile, cutoff=22e-6)


# ---- moments of a lay, without scatter


@pytest.mark.parametrize("angle", (0.0, 0.35, math.pi / 4.0, 1.2))
def test_the_equivalent_surface_of_a_lay_without_scatter(angle):
    """All waves with their mean amplitude: what the affine map says of m2 and m4 holds for the sums over waves as it does for
    the integral, and differences lack what 24 points to the length do not resolve."""
    stretch, target = 4.0, GaussianCorrelation(1e-8, 4e-7)
    surface = gaussian_surface((512, 512), (1e-5, 1e-5), target, 1, stretch=stretch, angle=angle, random_amplitudes=False)
    expected = target.moments.m2 / stretch, target.moments.m4 / stretch**2
    waves = moments_by_spectrum(power_spectrum(surface, window="none")).equivalent
    assert (waves.m2, waves.m4) == near(expected, 1e-6)
    differences = moments_by_differences(surface).equivalent
    assert (differences.m2, differences.m4) == near(expected, 0.01)


# ---- the fan, without scatter


SIZE, COUNT = 20e-6, 1024
FRACTAL = SelfAffine(hurst=0.3, rolloff=2e-6, shortest=80e-9, deviation=40e-9)


@pytest.fixture(scope="module")
def fractal():
    """All waves with their mean amplitude."""
    return gaussian_surface((COUNT, COUNT), (SIZE, SIZE), FRACTAL, 7, random_amplitudes=False)


def numbers_seen(cutoff, pitch):
    """sigma, R and N (Nayak 1971, McCool 1986) of the sum over waves after the filter, as differences of points a pitch apart
    see it: (2 / pitch) sin(q pitch / 2) in place of q."""
    q = 2.0 * math.pi * np.fft.fftfreq(COUNT, SIZE / COUNT)
    qx, qy = np.meshgrid(q, q)
    both = np.hypot(qx, qy)
    passed = np.exp(-2.0 * math.log(2.0) * (cutoff * both / (2.0 * math.pi)) ** 2)
    power = FRACTAL(both) * passed / SIZE**2
    power[0, 0] = 0.0
    seen = 2.0 / pitch * np.sin(qx * pitch / 2.0)
    m0, m2, m4 = (float(np.sum(power * seen**k)) for k in (0, 2, 4))
    deficit = 1.0 + 16.0 / math.pi - 3.0 * math.sqrt(3.0)
    return math.sqrt(m0 - deficit * m2**2 / m4), 3.0 / 8.0 * math.sqrt(math.pi / m4), m4 / m2 / (6.0 * math.pi * math.sqrt(3.0))


@pytest.mark.parametrize("cutoff", (0.2e-6, 0.45e-6))
def test_the_fan_follows_what_differences_see(fractal, cutoff):
    """To 1 %, which the edges take, where the filter has fewer points."""
    found = resolution_study(fractal, [cutoff], ["mccool"])
    assert [float(found[name][0, 0]) for name in ("sigma", "R", "N")] == near(numbers_seen(cutoff, SIZE / COUNT), 0.01)


def test_fewer_points_lose_what_differences_do_not_see(fractal):
    """At ten points to a cutoff of 1.2 um every sixth is taken: R is 3 % larger and N 4 % less."""
    all_points, some = (resolution_study(fractal, [1.2e-6], ["mccool"], points_per_cutoff=points) for points in (None, 10.0))
    pitch = SIZE / COUNT
    expected = np.divide(numbers_seen(1.2e-6, 6.0 * pitch), numbers_seen(1.2e-6, pitch))
    ratio = [float(some[name][0, 0]) / float(all_points[name][0, 0]) for name in ("sigma", "R", "N")]
    assert ratio == pytest.approx(expected, rel=0.01)
