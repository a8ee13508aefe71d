"""Power spectrum and its averages: against closed forms, and against SurfaceTopography on generated and measured surfaces."""

import math

import numpy as np
import pytest
from comparing import AREAS, PROFILES, near

from stiction.quantities.errors import InputError
from stiction.surfaces import spectrum as spectra
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.spectrum import power_spectrum, radial_average, tip_cutoff


def noise(shape, seed=1, size=(2e-6, 3e-6), deviation=1e-9):
    heights = deviation * np.random.default_rng(seed).standard_normal(shape)
    return HeightMap(heights, size)


def wave(periods, amplitude=2e-9, count=64, size=(1e-6, 1e-6)):
    """amplitude cos(q_y y + q_x x) with whole numbers of periods (y, x)."""
    y, x = np.arange(count)[:, None] / count, np.arange(count) / count
    return HeightMap(amplitude * np.cos(2.0 * math.pi * (periods[0] * y + periods[1] * x)), size)


@pytest.mark.parametrize("shape", [(64, 64), (63, 65), (48, 81), (81, 48), (1, 200), (1, 201)])
def test_parseval(shape):
    surface = noise(shape)
    spectrum = power_spectrum(surface, window="none")
    square = (spectrum.density * spectrum.waves).sum() / spectrum.extent
    assert square == near(np.var(surface.heights), rel=1e-12)


def test_a_wave_has_its_power_at_two_wavevectors():
    """cos: A^2/4 of its mean square at q and at -q, so C = (A^2/4) area there."""
    spectrum = power_spectrum(wave((3, 5)), window="none")
    qy, qx = spectrum.wavevectors
    assert spectrum.density[3, 5] == near(1e-18 * 1e-12, rel=1e-12)
    assert (qy[3], qx[5]) == near((6e6 * math.pi, 1e7 * math.pi))
    rest = spectrum.density.copy()
    rest[3, 5] = 0.0
    assert rest.max() < 1e-28 * spectrum.density[3, 5]


def test_white_noise_is_flat():
    """C = variance pitch_x pitch_y of independent points, to 4 standard errors of the mean over the waves."""
    surface = noise((256, 300), size=(2e-6, 2e-6))
    average = radial_average(power_spectrum(surface, window="none"))
    expected = 1e-18 * surface.pitch[0] * surface.pitch[1]
    error = np.sqrt(2.0 / average.waves)  # exponentially distributed, q and -q alike
    assert (np.abs(average.density / expected - 1.0) < 4.0 * error).all()


@pytest.mark.parametrize("window", ["hann", "radial hann"])
def test_windows_keep_the_mean_square(window):
    """Of white noise, within the sampling error of the part of the map the window leaves."""
    spectrum = power_spectrum(noise((512, 512)), window=window)
    square = (spectrum.density * spectrum.waves).sum() / spectrum.extent
    assert square == near(1e-18, rel=0.03)


@pytest.mark.parametrize("columns, rows", [(64, 1), (64, 64), (50, 64)])
def test_hann_window_of_a_wave(columns, rows):
    """A cosine of k whole periods under Hann's window: amplitudes 1, 1/2, 1/2 at k, k - 1, k + 1 over a mean square of 3/8."""
    x = np.arange(columns) / columns
    surface = HeightMap(np.tile(1e-9 * np.cos(2.0 * math.pi * 9 * x), (rows, 1)), (1e-6, 1e-6))
    spectrum = power_spectrum(surface, window="hann")
    row = spectrum.density[0]
    assert row[8] / row[9] == near(0.25, rel=1e-10)
    assert row[10] / row[9] == near(0.25, rel=1e-10)
    assert (spectrum.density * spectrum.waves).sum() / spectrum.extent == near(0.5e-18, rel=1e-12)


def test_radial_average_of_a_known_spectrum():
    """A Gaussian surface made here from independent waves of a self-affine spectrum has it again: slope -2 (1 + H)."""
    count, hurst = 512, 0.7
    rng = np.random.default_rng(4)
    q = 2.0 * math.pi * np.hypot(np.fft.fftfreq(count, 1e-9)[:, None], np.fft.fftfreq(count, 1e-9))
    q[0, 0] = np.inf
    density = 1e-30 * (q / 1e8) ** (-2.0 - 2.0 * hurst)
    area = (count * 1e-9) ** 2
    spectrum = density
    waves = np.fft.fft2(rng.standard_normal((count, count))) / count * np.sqrt(density * area)
    surface = HeightMap(np.fft.ifft2(waves).real * count**2 / area, (count * 1e-9, count * 1e-9))
    average = radial_average(power_spectrum(surface, window="none"), bins="linear")
    band = average.reliable
    q, density = np.log(average.wavevector[band] / 1e8), np.log(average.density[band] / 1e-30)
    slope, level = np.polyfit(q, density, 1, w=np.sqrt(average.waves[band]))
    assert slope == pytest.approx(-2.0 * (1.0 + hurst), abs=0.03)
    assert level == pytest.approx(0.0, abs=0.05)  # the mean of logarithms of few waves is low
    even = np.fft.fft2(surface.heights)  # and with amplitudes that do not scatter
    even[1:, 1:] *= (np.sqrt(spectrum * area) * count**2 / area)[1:, 1:] / np.abs(even[1:, 1:])
    surface = HeightMap(np.fft.ifft2(even).real, surface.size)
    average = radial_average(power_spectrum(surface, window="none"), bins="linear")
    over = average.density[band] / (1e-30 * (average.wavevector[band] / 1e8) ** (-2.0 - 2.0 * hurst))
    assert np.average(over, weights=average.waves[band]) == pytest.approx(1.0, abs=0.005)


def test_radial_average_of_an_isotropic_surface():
    """A Gaussian correlation s^2 exp(-r^2/2l^2) has C = 2 pi s^2 l^2 exp(-q^2 l^2/2)."""
    count, pitch, length, deviation = 512, 1e-9, 4e-9, 3e-10
    rng = np.random.default_rng(2)
    q = 2.0 * math.pi * np.hypot(np.fft.fftfreq(count, pitch)[:, None], np.fft.fftfreq(count, pitch))
    area = (count * pitch) ** 2
    plane = 2.0 * math.pi * (deviation * length) ** 2 * np.exp(-((q * length) ** 2) / 2.0)
    waves = np.fft.fft2(rng.standard_normal((count, count))) / count * np.sqrt(plane * area)
    surface = HeightMap(np.fft.ifft2(waves).real * count**2 / area, (count * pitch, count * pitch))
    average = radial_average(power_spectrum(surface), bins="linear")
    part = average.reliable & (average.wavevector * length < 3.0)
    front = 2.0 * math.pi * (deviation * length) ** 2
    ratio = average.density[part] / (front * np.exp(-((average.wavevector[part] * length) ** 2) / 2.0))
    assert part.sum() > 40
    assert np.average(ratio, weights=average.waves[part]) == pytest.approx(1.0, abs=0.02)
    assert ratio == pytest.approx(1.0, abs=0.5)  # a bin scatters by a fifth: a ring of few waves


@pytest.mark.parametrize("bins", ["log", "linear"])
def test_every_wave_up_to_nyquist_is_in_one_bin(bins):
    spectrum = power_spectrum(noise((64, 64), size=(1e-6, 1e-6)))
    qy, qx = spectrum.wavevectors
    inside = np.hypot(qy[:, None], qx) <= math.pi * 64e6 * (1.0 + 1e-12)
    average = radial_average(spectrum, bins=bins)
    assert average.waves.sum() == (inside * spectrum.waves).sum() - 1
    assert (np.diff(average.wavevector) > 0.0).all()


def test_reliable_band():
    """From a third of the shorter side to four of the larger pitches."""
    surface = noise((128, 100), size=(2e-6, 3e-6))
    average = radial_average(power_spectrum(surface), bins="linear")
    assert average.longest == near(2e-6 / 3.0)
    assert average.shortest == near(4.0 * 3e-8)
    inside = average.wavelength[average.reliable]
    assert inside.max() <= average.longest * 1.001 and inside.min() >= average.shortest * 0.999
    assert 0 < average.reliable.sum() < len(average.wavevector)


def test_tip_cutoff_of_a_wave():
    """A cos(q x) has a root mean square curvature A q^2/(2 sqrt 2), half the Laplacian: too much for a tip of 1/(2 R) below."""
    amplitude, q = 2e-9, 2.0 * math.pi * 8e6
    spectrum = power_spectrum(wave((0, 8), amplitude), window="none")
    radius = 1.0 / (amplitude * q * q / math.sqrt(2.0))
    assert tip_cutoff(spectrum, 0.99 * radius) == 0.0
    waves = np.hypot(*np.meshgrid(np.fft.fftfreq(64, 1.0 / 64), np.fft.fftfreq(64, 1.0 / 64)))  # in 1/um
    ring = waves[(waves >= 7.5) & (waves < 8.5)].mean()  # the bin in which the wave of 8 is, by its mean
    assert tip_cutoff(spectrum, 1.01 * radius) == near(1e-6 / ring, rel=1e-9) == near(1.0 / 8e6, rel=0.01)
    assert radial_average(spectrum, tip_radius=1.01 * radius).shortest == near(1e-6 / ring, rel=1e-9)
    assert radial_average(spectrum, tip_radius=0.99 * radius).shortest == spectrum.shortest


def test_tip_cutoff_of_a_profile():
    """Of the surface that the profile is taken from the mean square Laplacian is 8/3 of the profile's m4, A^2 q^4 / 2: half of
    its root is A q^2 / sqrt 3."""
    amplitude, q = 2e-9, 2.0 * math.pi * 8e6
    profile = wave((0, 8), amplitude)
    spectrum = power_spectrum(profile.with_heights(profile.heights[:1], "first line"), window="none")
    radius = math.sqrt(3.0) / (2.0 * amplitude * q * q)
    assert tip_cutoff(spectrum, 0.999 * radius) == 0.0
    assert tip_cutoff(spectrum, 1.001 * radius) == near(1.0 / 8e6)


@pytest.mark.parametrize(
    "call, field",
    [
        (lambda: power_spectrum(HeightMap(np.where(np.eye(9) > 0, np.nan, 1.0), (1.0, 1.0))), "heights"),
        (lambda: power_spectrum(noise((7, 64))), "heights"),
        (lambda: power_spectrum(noise((1, 7))), "heights"),
        (lambda: power_spectrum(noise((9, 9)), window="hanning"), "window"),
        (lambda: radial_average(power_spectrum(noise((9, 9))), bins="many"), "bins"),
        (lambda: radial_average(power_spectrum(noise((9, 9))), tip_radius=-1e-9), "tip_radius"),
        (lambda: tip_cutoff(power_spectrum(noise((9, 9))), math.nan), "tip_radius"),
    ],
)
def test_refused(call, field):
    with pytest.raises(InputError) as refused:
        call()
    assert refused.value.field == field
    assert "\n" not in str(refused.value)


# ---- an independent library, on measured surfaces (conftest.py has their licence)


@pytest.mark.parametrize("bins", ["log", "linear"])
@pytest.mark.parametrize("name", AREAS)
def test_area_spectrum_of_a_scan_agrees_with_the_library(name, bins, measured):
    """Same normalisation and same window; in bins between our edges the library has the same waves."""
    surface, topography = measured(name)
    spectrum = power_spectrum(surface, window="radial hann")
    ours = radial_average(spectrum, bins=bins)
    edges = spectra.BINS[bins](spectrum.lowest, math.pi / spectrum.pitch)
    with np.errstate(all="ignore"):  # of its empty bins
        found = topography.power_spectrum_from_area(window="hann", collocation=edges, reliable=False, return_map=True)
    q, density, plane = found
    full = ~np.ma.getmaskarray(density)
    half = plane.T[:, : spectrum.density.shape[1]]
    assert spectrum.density == pytest.approx(half, rel=1e-6, abs=1e-9 * half.max())
    assert ours.density == near(np.asarray(density[full]), rel=1e-8)
    assert ours.wavevector == near(np.asarray(q[full]), rel=1e-9)


@pytest.mark.parametrize("name", PROFILES)
def test_spectrum_of_a_measured_profile_agrees_with_the_library(name, measured):
    surface, topography = measured(name)
    q, density = topography.power_spectrum_from_profile(window="hann", resampling_method=None, reliable=False)
    spectrum = power_spectrum(surface)
    count = len(q)
    assert count >= surface.heights.size // 2
    assert spectrum.wavevectors[1][1:count] == near(q[1:], rel=1e-12)
    assert spectrum.density[0, 1:count] == near(density[1:], rel=1e-8)
