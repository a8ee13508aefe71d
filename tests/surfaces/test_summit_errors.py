"""What each method finds on Gaussian surfaces, against Nayak and McCool within sampling error; where not, by the error known.

Sampling error: the standard error of the mean over surfaces of different seeds, times four.
"""

import importlib.util
import math
from pathlib import Path

import numpy as np
import pytest

from stiction.moments import Moments
from stiction.surfaces.asperities import asperities
from stiction.surfaces.gaussian_asperities import combine
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import GaussianCorrelation, SelfAffine

LENGTH = 1e-7
SMOOTH = GaussianCorrelation(deviation=1e-8, length=LENGTH)
ROUGH = SelfAffine(hurst=0.8, rolloff=8.0 * LENGTH, shortest=LENGTH, deviation=1e-8)
SEEDS = range(8)
FACTOR = 2.0 * math.pi / (3.0 * math.sqrt(3.0))
DOCS = Path(__file__).parents[2] / "docs"


def over_seeds(target, points, side, method, **options):
    """sigma, R, N (seeds, 3) of periodic maps `side` lengths wide, with this many points to a length."""
    found = []
    for seed in SEEDS:
        surface = gaussian_surface((points * side,) * 2, (side * LENGTH,) * 2, target, seed)
        one = asperities(surface, method, **options)
        found.append((one.deviation, one.radius, one.density))
    return np.array(found)


def assert_within_sampling_error(found, expected, beside=0.0):
    """beside: relative error that is known to remain."""
    error = found.std(axis=0, ddof=1) / math.sqrt(len(found))
    apart = np.abs(found.mean(axis=0) - expected)
    assert (apart <= 4.0 * error + beside * np.abs(expected)).all(), (found.mean(axis=0) / expected, error / expected)
    assert (error < 0.03 * np.abs(expected)).all()  # or nothing is shown


# ---- fine maps: Nayak and McCool


@pytest.mark.parametrize("target", [SMOOTH, ROUGH], ids=["smooth", "rough"])
@pytest.mark.parametrize("method", ["eight_neighbour", "mccool"])
def test_summits_and_moments_are_those_of_nayak(method, target):
    """24 points to a wave; half a per cent of the curvature is what three points in a row do not see of it there."""
    assert_within_sampling_error(over_seeds(target, 24, 32, method), target.moments.asperities(), beside=0.005)


def test_all_summits_that_stand_out_by_nothing_are_those_of_nayak():
    found = over_seeds(SMOOTH, 24, 32, "persistence", threshold=0.0, fit_points=9)
    assert_within_sampling_error(found, SMOOTH.moments.asperities(), beside=0.005)


# ---- coarse maps: the error in closed form


def correlation(lag):
    return math.exp(-((lag / LENGTH) ** 2))


@pytest.mark.parametrize("points", [3, 6, 12])
def test_moments_by_differences_are_those_of_the_sampled_surface(points):
    """<(z1 - z0)^2> = 2 (1 - rho1), <(z1 - 2 z0 + z-1)^2> = 6 - 8 rho1 + 2 rho2, in mean squares of the height."""
    d, m0 = LENGTH / points, SMOOTH.deviation**2
    one, two = correlation(d), correlation(2.0 * d)
    seen = Moments(m0, 2.0 * m0 * (1.0 - one) / d**2, m0 * (6.0 - 8.0 * one + 2.0 * two) / d**4)
    assert_within_sampling_error(over_seeds(SMOOTH, points, 64, "mccool"), seen.asperities())


@pytest.mark.parametrize("points", [3, 6, 12])
def test_three_point_peaks_are_those_of_the_sampled_profile(points):
    """Both steps from a point down: two Gaussians of correlation r, P = 1/4 + asin(r) / (2 pi), and the mean of their sum."""
    d = LENGTH / points
    one, two = correlation(d), correlation(2.0 * d)
    r = (1.0 - 2.0 * one + two) / (2.0 * (1.0 - one))
    share = 0.25 + math.asin(r) / (2.0 * math.pi)
    second = SMOOTH.deviation * math.sqrt(2.0 * (1.0 - one)) * (1.0 + r) / (math.sqrt(2.0 * math.pi) * share)
    found = over_seeds(SMOOTH, points, 64, "three_point")[:, 1:]
    assert_within_sampling_error(found, np.array([d**2 / second, FACTOR * (share / d) ** 2]))


def test_fine_profiles_have_blunter_peaks_than_the_surface_has_summits():
    """8 sqrt(2) / (3 pi) = 1.2004: of the mean curvatures (8/3) sqrt(m4 / pi) and sqrt(pi m4 / 2). As many, by the relation."""
    _, radius, density = SMOOTH.moments.asperities()
    found = over_seeds(SMOOTH, 24, 32, "three_point")[:, 1:]
    assert_within_sampling_error(found, np.array([8.0 * math.sqrt(2.0) / (3.0 * math.pi) * radius, density]), beside=0.005)


@pytest.mark.parametrize("target", [SMOOTH, ROUGH], ids=["smooth", "rough"])
def test_there_are_fewer_n_point_asperities_than_summits_by_alpha(target):
    """Rice's crossings (1/2 pi) sqrt(m2 / m0) against (1/2 pi) sqrt(m4 / m2) peaks: squared, 1 / alpha."""
    found = over_seeds(target, 16, 64, "n_point")[:, 2:]
    moments = target.moments
    assert_within_sampling_error(found, np.array([moments.asperities()[2] / moments.alpha]), beside=0.005)


# ---- two surfaces


def test_the_sum_of_two_surfaces_has_the_asperities_of_their_moments():
    """Of two independent maps, added, and combined as numbers: what is between them is chance."""
    other = GaussianCorrelation(deviation=2e-8, length=3.0 * LENGTH)
    apart = []
    for seed in SEEDS:
        one, two = (gaussian_surface((512,) * 2, (64 * LENGTH,) * 2, target, seed + shift)
                    for target, shift in ((SMOOTH, 0), (other, 100)))  # fmt: skip
        both = asperities(HeightMap(one.heights + two.heights, one.size), "mccool")
        added = combine(asperities(one, "mccool"), asperities(two, "mccool"))
        apart.append([getattr(added, name) / getattr(both, name) for name in ("deviation", "radius", "density")])
    assert_within_sampling_error(np.array(apart), np.ones(3))


# ---- the tables of the page


def test_the_tables_of_errors_are_up_to_date():
    """The rows of the smallest maps; `python docs/measure_summits.py` writes all. Last digits may differ."""
    spec = importlib.util.spec_from_file_location("measure_summits", DOCS / "measure_summits.py")
    measure = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(measure)
    page = (DOCS / "surfaces.md").read_text(encoding="utf-8")
    for name, target in measure.TARGETS.items():
        start = page.index(f"<!-- errors, {name}: begin")
        table = page[start : page.index(f"<!-- errors, {name}: end")].splitlines()
        assert len(table) == 3 + 3 * len(measure.ROWS)
        smallest = [row for row in measure.ROWS if row[0] * row[1] <= 128]
        assert len(smallest) == 2
        for points, side in smallest:
            shown = [line for line in table if line.startswith(f"| {points} | {side} |")]
            for line, fresh in zip(shown, measure.lines(target, points, side), strict=True):
                assert numbers(line) == pytest.approx(numbers(fresh), abs=0.15, rel=0.01), f"{line}: out of date"


def numbers(line):
    cells = line.replace("−", "-").strip("|").split("|")
    return [float(part) for cell in cells[3:] for part in cell.split("±")]
