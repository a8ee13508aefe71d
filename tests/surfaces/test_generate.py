"""Generated surfaces: closed forms of the spectrum, an independent library, and sampling error over seeds."""

import itertools
import math

import numpy as np
import pytest
from comparing import near
from scipy import integrate, stats

from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.surfaces.generate import gaussian_surface, non_gaussian_surface, rms_slope, with_slope
from stiction.surfaces.johnson import johnson
from stiction.surfaces.read import read_scan
from stiction.surfaces.targets import GaussianCorrelation, SelfAffine

SIZE = (10e-6, 10e-6)
TARGET = SelfAffine(hurst=0.8, rolloff=1e-6, shortest=200e-9, deviation=5e-9)
NORMAL = stats.norm.ppf((np.arange(200_000) + 0.5) / 200_000)


def profile_moments(surface):
    """m0, m2, m4 along x and along y of the trigonometric interpolant, by derivatives in Fourier space."""
    heights = surface.heights
    found = []
    for axis in (1, 0):
        count, length = heights.shape[axis], surface.size[axis]
        q = 2.0 * np.pi * np.fft.fftfreq(count, length / count)
        q = q[np.newaxis, :] if axis == 1 else q[:, np.newaxis]
        waves = np.fft.fft(heights, axis=axis)
        slope, bend = (np.fft.ifft(waves * factor, axis=axis).real for factor in (1j * q, -(q**2)))
        found.append([np.mean(heights**2), np.mean(slope**2), np.mean(bend**2)])
    return np.array(found)


def three(moments):
    return np.array([moments.m0, moments.m2, moments.m4])


# ---- the closed forms


@pytest.mark.parametrize("hurst", [0.0, 0.3, 0.8, 1.0])
@pytest.mark.parametrize("longest", [math.inf, 4e-6])
@pytest.mark.parametrize("dimensions", [1, 2])
def test_closed_moments_are_the_integrals_of_the_spectrum(hurst, longest, dimensions):
    """Over q and the direction of the wave, as a line along x sees them."""
    target = SelfAffine(hurst, 1e-6, 50e-9, 5e-9, longest, dimensions)
    edges = [2.0 * np.pi / longest, 2.0 * np.pi / 1e-6, 2.0 * np.pi / 50e-9]
    weights = {1: (1, 1, 1), 2: (1, 1 / 2, 3 / 8)}[dimensions]
    for power, weight, expected in zip((0, 2, 4), weights, three(target.moments), strict=True):
        measure = {1: 1.0 / math.pi, 2: 1.0 / (2.0 * math.pi)}[dimensions]
        found = sum(
            integrate.quad(
                lambda q, p=power: float(target(q)) * q ** (p + dimensions - 1), a, b, epsabs=0.0, epsrel=1e-11, limit=200
            )[0]
            for a, b in itertools.pairwise(edges)
        )
        assert found * measure * weight == near(expected, rel=1e-9)


@pytest.mark.parametrize("dimensions", [1, 2])
def test_gaussian_correlation_has_the_moments_of_its_derivatives(dimensions):
    target = GaussianCorrelation(3e-9, 200e-9, dimensions)
    m = target.moments
    assert m.alpha == near(3.0)
    solid = {1: 1.0 / math.pi, 2: 1.0 / (2.0 * math.pi)}[dimensions]
    weights = {1: (1, 1, 1), 2: (1, 1 / 2, 3 / 8)}[dimensions]
    for power, weight, expected in zip((0, 2, 4), weights, three(m), strict=True):
        q = np.linspace(0.0, 16.0 / 200e-9, 20001)
        assert integrate.simpson(target(q) * q ** (power + dimensions - 1), x=q) * solid * weight == near(expected)


def test_the_shape_of_the_self_affine_spectrum():
    q = 2.0 * np.pi / np.array([20e-6, 2e-6, 1e-6, 0.5e-6, 0.2e-6, 0.19e-6])
    c = TARGET(q)
    assert c[0] == c[1] == near(c[2])
    assert c[3] / c[2] == near(2.0 ** (-2.0 - 2.0 * 0.8)) and c[5] == 0.0 < c[4]
    assert TARGET.with_slope(0.1).rms_slope == near(0.1)
    assert TARGET.with_slope(0.1).moments.m2 == near(0.005)


# ---- Gaussian surfaces


def test_the_spectrum_is_that_of_an_independent_library():
    """Radially averaged; the exponent of its falling part is -2 (1 + H). Of amplitudes that do not scatter what is left are the
    bins, whose mean is above what a falling spectrum has in their middle; over seeds those that do scatter have the same."""
    library = pytest.importorskip("SurfaceTopography", reason="the optional extra `scans` is not installed")
    target = SelfAffine(0.6, 2e-6, 60e-9, 5e-9)

    def found(seed, **more):
        surface = gaussian_surface((512, 512), SIZE, target, seed, **more)
        topography = library.Topography(surface.heights, SIZE, periodic=True)
        q, c = topography.power_spectrum_from_area(nb_points=60)
        inside = (q > 2.0 * np.pi / 1.5e-6) & (q < 2.0 * np.pi / 70e-9) & np.isfinite(c)
        assert inside.sum() > 20
        return surface, topography, np.log(q[inside]), c[inside] / target(q[inside])

    surface, topography, log_q, ratio = found(1, random_amplitudes=False)
    np.testing.assert_allclose(ratio, 1.0, rtol=0.01)
    assert np.polyfit(log_q, np.log(ratio), 1)[0] == pytest.approx(0.0, abs=0.002)
    forward = [np.roll(surface.heights, -1, axis) - surface.heights for axis in (0, 1)]
    assert topography.rms_gradient() == near(math.sqrt(sum(np.mean(one**2) for one in forward)) / surface.pitch[0], rel=1e-9)
    assert rms_slope(surface) == near(target.rms_slope, rel=1e-3)
    ratios = np.array([found(seed)[3] for seed in range(12)])
    assert ratios.mean() == pytest.approx(1.0, abs=0.015)
    np.testing.assert_allclose(ratios.mean(axis=0), 1.0, rtol=0.1)  # one bin of a dozen maps


def test_moments_scatter_about_the_closed_form():
    """Mean over seeds within four of its standard errors, which are half of a percent at most, of the sum over the lattice of
    waves; and that within a percent of the integral."""
    found = np.array([profile_moments(gaussian_surface((160, 160), SIZE, TARGET, seed)).mean(axis=0) for seed in range(100)])
    error = found.std(axis=0, ddof=1) / math.sqrt(len(found))
    q = 2.0 * np.pi * np.fft.fftfreq(160, SIZE[0] / 160)
    qx, qy = np.meshgrid(q, q)
    c = TARGET(np.hypot(qx, qy)) / (SIZE[0] * SIZE[1])
    c[0, 0] = 0.0
    expected = np.array([np.sum(c), np.sum(c * qx**2), np.sum(c * qx**4)])
    assert (np.abs(found.mean(axis=0) - expected) < 4.0 * error).all() and (error < 0.005 * expected).all()
    np.testing.assert_allclose(expected, three(TARGET.moments), rtol=0.01)


def test_the_scatter_of_the_mean_square_is_that_of_gaussian_waves():
    """var(m0) = 2 sum (C / A)^2 over all waves of a real Gaussian process."""
    target = GaussianCorrelation(1.0, 0.1)
    squares = [np.mean(gaussian_surface((64, 64), (1.0, 1.0), target, seed).heights ** 2) for seed in range(400)]
    q = 2.0 * np.pi * np.fft.fftfreq(64, 1.0 / 64)
    shares = target(np.hypot(*np.meshgrid(q, q)))
    shares[0, 0] = 0.0
    assert np.mean(squares) == pytest.approx(shares.sum(), abs=4.0 * np.std(squares) / 20.0)
    assert np.std(squares) == near(math.sqrt(2.0 * np.sum(shares**2)), rel=4.0 / math.sqrt(2 * 400))


def test_random_phases_have_exactly_the_moments_of_the_sum_over_waves():
    found = profile_moments(gaussian_surface((160, 160), SIZE, TARGET, 5, random_amplitudes=False))
    q = 2.0 * np.pi * np.fft.fftfreq(160, SIZE[0] / 160)
    qx, qy = np.meshgrid(q, q)
    c = TARGET(np.hypot(qx, qy)) / (SIZE[0] * SIZE[1])
    c[0, 0] = 0.0
    np.testing.assert_allclose(found[0], [np.sum(c), np.sum(c * qx**2), np.sum(c * qx**4)], rtol=1e-9)
    np.testing.assert_allclose(found.mean(axis=0), three(TARGET.moments), rtol=0.01)  # their limit


def test_heights_are_gaussian_with_zero_mean():
    """Of one map skewness and kurtosis scatter by a few hundredths; of forty together by less than one."""
    heights = gaussian_surface((512, 512), (40e-6, 40e-6), TARGET, 2).heights
    assert abs(heights.mean()) < 1e-12 * heights.std()
    assert abs(stats.skew(heights, axis=None)) < 0.1 and abs(stats.kurtosis(heights, axis=None)) < 0.15
    maps = [gaussian_surface((256, 256), (20e-6, 20e-6), TARGET, seed).heights for seed in range(40)]
    skewness, excess = (np.mean([of(one, axis=None) for one in maps]) for of in (stats.skew, stats.kurtosis))
    assert abs(skewness) < 0.02 and abs(excess) < 0.03


def test_a_profile():
    """Its own spectrum, over seeds; of a surface the spectrum is refused."""
    target = SelfAffine(0.8, 1e-6, 100e-9, 5e-9, dimensions=1)
    surfaces = [gaussian_surface((1, 2000), (1e-6, 50e-6), target, seed) for seed in range(60)]
    assert surfaces[0].is_profile and surfaces[0].history[0].startswith("made: Gaussian profile, seed 0")
    found = np.array([profile_moments(surface)[0] for surface in surfaces])
    error = found.std(axis=0, ddof=1) / math.sqrt(len(found))
    expected = three(target.moments)
    assert (np.abs(found.mean(axis=0) - expected) < 4.0 * error + 0.02 * expected).all()
    with refusal("spectrum", "dimensions=1", "(1, 2000)"):
        gaussian_surface((1, 2000), (1e-6, 50e-6), TARGET, 0)


def test_any_function_is_a_spectrum():
    """Two rings of waves; a power law without value at 0 is asked nowhere for it."""
    ring = gaussian_surface((64, 64), (1.0, 1.0), lambda q: np.where(np.abs(q / (2 * np.pi) - 8.0) < 0.5, 1e-6, 0.0), 1)
    waves = np.abs(np.fft.fft2(ring.heights))
    k = np.hypot(*np.meshgrid(np.fft.fftfreq(64, 1 / 64), np.fft.fftfreq(64, 1 / 64)))
    assert waves[np.abs(k - 8.0) >= 0.5].max() < 1e-12 * waves.max()
    assert np.isfinite(gaussian_surface((64, 64), (1.0, 1.0), lambda q: q**-4.0, 1).heights).all()


@pytest.mark.parametrize("angle, axis", [(0.0, 0), (math.pi / 2.0, 1)])
def test_stretched_surfaces(angle, axis):
    """Along the lay m2 falls by s^2 and m4 by s^4, across it nothing changes, and heights keep their mean square."""
    arguments = ((320, 320), (20e-6, 20e-6), TARGET, 3)
    found = profile_moments(gaussian_surface(*arguments, stretch=2.0, angle=angle, random_amplitudes=False))
    m0, m2, m4 = three(TARGET.moments)
    np.testing.assert_allclose(found[axis], [m0, m2 / 4.0, m4 / 16.0], rtol=0.01)
    np.testing.assert_allclose(found[1 - axis], [m0, m2, m4], rtol=0.01)


def test_the_lay_turns_from_x_towards_y():
    """At 30 degrees the mean of the products of slopes is (m2_along - m2_across) sin 30 cos 30."""
    surface = gaussian_surface((320, 320), (20e-6, 20e-6), TARGET, 3, stretch=2.0, angle=math.pi / 6.0, random_amplitudes=False)
    q = 2.0 * np.pi * np.fft.fftfreq(320, 20e-6 / 320)
    waves = np.fft.fft2(surface.heights)
    along_y, along_x = (np.fft.ifft2(1j * k * waves).real for k in (q[:, None], q[None, :]))
    m2 = TARGET.moments.m2
    expected = (m2 / 4.0 - m2) * math.sin(math.pi / 6.0) * math.cos(math.pi / 6.0)
    assert np.mean(along_x * along_y) == near(expected, rel=0.01)


@pytest.mark.parametrize("shape", [(64, 64), (33, 48), (48, 33), (1, 65)])
def test_what_is_wanted_exactly_is_exact(shape):
    target = SelfAffine(0.5, 0.5, 0.1, 1e-3, dimensions=1 if shape[0] == 1 else 2)
    surface = gaussian_surface(shape, (1.0, 1.0), target, 9)
    steep = with_slope(surface, 0.25)
    found = profile_moments(steep)[:, 1]
    assert (found[0] if shape[0] == 1 else found.sum()) == near(0.0625, rel=1e-10)
    assert steep.history[0] == surface.history[0] and "0.25" in steep.history[1]


def test_one_seed_makes_the_same_bytes_and_says_so():
    one, same, other = (gaussian_surface((100, 120), SIZE, TARGET.with_slope(0.02), seed) for seed in (7, 7, 8))
    assert one.heights.tobytes() == same.heights.tobytes() != other.heights.tobytes()
    assert "seed 7" in one.history[0] and "H 0.8" in one.history[0] and "roll-off 1 µm" in one.history[0]
    assert one.size == SIZE and one.heights.shape == (100, 120) and one.complete


def test_a_saved_surface_is_read_again(tmp_path):
    surface = gaussian_surface((64, 128), (5e-6, 10e-6), GaussianCorrelation(3e-9, 500e-9), 1)
    np.save(tmp_path / "made.npy", surface.heights)
    again = read_scan(tmp_path / "made.npy", size="10 um", unit="m")
    np.testing.assert_array_equal(again.heights, surface.heights)
    assert again.size == near(surface.size)


# ---- non-Gaussian surfaces


@pytest.mark.parametrize(
    "skewness, kurtosis",
    [(0.0, 3.0), (0.0, 1.8), (0.0, 6.0), (1.0, 2.5), (1.0, 4.0), (-1.0, 6.0), (2.0, 9.0), (-0.3, 2.9), (0.5, 3.44)],
)
def test_johnson_has_the_skewness_and_kurtosis(skewness, kurtosis):
    """By the moments of a fine sample of the normal distribution; what its ends lack is within the tolerance."""
    heights = johnson(skewness, kurtosis)(NORMAL)
    assert (np.diff(heights) > 0.0).all()
    assert heights.mean() == pytest.approx(0.0, abs=1e-4) and heights.std() == pytest.approx(1.0, abs=1e-3)
    assert stats.skew(heights) == pytest.approx(skewness, abs=5e-3)
    assert stats.kurtosis(heights, fisher=False) == pytest.approx(kurtosis, rel=1e-2)


def test_johnson_is_the_curve_of_the_library():
    """scipy's closed moments of one unbounded distribution lead back to its quantiles."""
    known = stats.johnsonsu(-0.7, 1.9)
    skewness, excess = (float(value) for value in known.stats("sk"))
    z = np.linspace(-4.0, 4.0, 41)
    expected = (known.ppf(stats.norm.cdf(z)) - known.mean()) / known.std()
    np.testing.assert_allclose(johnson(skewness, excess + 3.0)(z), expected, atol=1e-4)


def test_johnson_on_the_lognormal_line():
    known = stats.lognorm(0.3)
    skewness, excess = (float(value) for value in known.stats("sk"))
    z = np.linspace(-4.0, 4.0, 41)
    np.testing.assert_allclose(johnson(skewness, excess + 3.0)(z), (np.exp(0.3 * z) - known.mean()) / known.std(), atol=1e-9)


@pytest.mark.parametrize("skewness, kurtosis", [(-1.0, 5.0), (0.8, 4.0), (0.0, 2.0)])
def test_non_gaussian_heights_with_the_spectrum_of_the_gaussian(skewness, kurtosis):
    arguments = ((256, 256), SIZE, TARGET, 4)
    gaussian = gaussian_surface(*arguments)
    exact_heights = non_gaussian_surface(*arguments, skewness=skewness, kurtosis=kurtosis)
    heights = exact_heights.heights.ravel()
    assert stats.skew(heights) == pytest.approx(skewness, abs=0.01)
    assert stats.kurtosis(heights, fisher=False) == pytest.approx(kurtosis, rel=0.01)
    assert heights.std() == near(gaussian.heights.std(), rel=1e-9)
    waves = np.abs(np.fft.fft2(exact_heights.heights)), np.abs(np.fft.fft2(gaussian.heights))
    assert np.linalg.norm(waves[0] - waves[1]) < 0.01 * np.linalg.norm(waves[1])
    assert "skewness" in exact_heights.history[0] and "seed 4" in exact_heights.history[0]

    exact_spectrum = non_gaussian_surface(*arguments, skewness=skewness, kurtosis=kurtosis, exact_spectrum=True)
    np.testing.assert_allclose(profile_moments(exact_spectrum), profile_moments(gaussian), rtol=1e-9)
    assert stats.skew(exact_spectrum.heights, axis=None) == pytest.approx(skewness, abs=0.02)


def test_without_steps_the_ranks_are_those_of_the_gaussian():
    arguments = ((100, 100), SIZE, TARGET, 4)
    gaussian = gaussian_surface(*arguments).heights.ravel()
    made = non_gaussian_surface(*arguments, skewness=-1.0, kurtosis=5.0, steps=0)
    assert (np.diff(made.heights.ravel()[np.argsort(gaussian)]) > 0.0).all() and "after 0 steps" in made.history[0]


# ---- what is refused


@pytest.mark.parametrize(
    "field, make",
    [
        ("hurst", lambda: SelfAffine(1.2, 1e-6, 1e-7, 1e-9)),
        ("rolloff", lambda: SelfAffine(0.8, 1e-8, 1e-7, 1e-9)),
        ("longest", lambda: SelfAffine(0.8, 1e-6, 1e-7, 1e-9, longest=5e-7)),
        ("longest", lambda: SelfAffine(0.8, 1e-6, 1e-6, 1e-9, longest=1e-6)),
        ("deviation", lambda: SelfAffine(0.8, 1e-6, 1e-7, -1e-9)),
        ("dimensions", lambda: SelfAffine(0.8, 1e-6, 1e-7, 1e-9, dimensions=3)),
        ("length", lambda: GaussianCorrelation(1e-9, math.nan)),
        ("slope", lambda: TARGET.with_slope(0.0)),
        ("shape", lambda: gaussian_surface((4, 64), SIZE, TARGET, 0)),
        ("shape", lambda: gaussian_surface((64.0, 64), SIZE, TARGET, 0)),
        ("size", lambda: gaussian_surface((64, 64), (0.0, 1e-6), TARGET, 0)),
        ("seed", lambda: gaussian_surface((64, 64), SIZE, TARGET, -1)),
        ("shortest", lambda: gaussian_surface((64, 64), SIZE, SelfAffine(0.8, 1e-6, 1e-7, 1e-9), 0)),
        ("stretch", lambda: gaussian_surface((64, 64), SIZE, TARGET, 0, stretch=0.0)),
        ("angle", lambda: gaussian_surface((64, 64), SIZE, GaussianCorrelation(1e-9, 1e-6), 0, angle=math.inf)),
        ("spectrum", lambda: gaussian_surface((64, 64), SIZE, lambda q: -q, 0)),
        ("spectrum", lambda: gaussian_surface((64, 64), SIZE, lambda q: 0.0 * q, 0)),
        ("spectrum", lambda: gaussian_surface((64, 64), SIZE, lambda q: 1.0, 0)),
        ("kurtosis", lambda: johnson(1.0, 1.9)),
        ("kurtosis", lambda: johnson(0.0, math.nan)),
        ("kurtosis", lambda: johnson(0.0, 60.0)),
        ("steps", lambda: non_gaussian_surface((64, 64), SIZE, TARGET, 0, skewness=0.0, kurtosis=4.0, steps=-1)),
    ],
)
def test_unusable_wishes_give_one_line(field, make):
    with pytest.raises(InputError) as error:
        make()
    assert error.value.field == field and "\n" not in str(error.value)


def test_missing_or_constant_heights_cannot_be_multiplied_to_a_slope():
    surface = gaussian_surface((64, 64), SIZE, GaussianCorrelation(1e-9, 1e-6), 0)
    holed = surface.heights.copy()
    holed[3, 3] = np.nan
    for heights in (holed, np.zeros((64, 64))):
        with refusal("heights"):
            with_slope(surface.with_heights(heights, "changed"), 0.1)
