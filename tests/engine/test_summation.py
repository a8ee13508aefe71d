"""The summation engine, with laws made here whose sums are known in closed form: it must know nothing of any model."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import erfc, gamma

from stiction.engine.compiled import formula
from stiction.engine.heights import empirical, exponential_heights, gaussian, weibull
from stiction.engine.regime import Regime
from stiction.engine.sum_kernels import map_segment
from stiction.engine.summation import QUANTITIES, on_grid, scattered, totals_on_grid
from tables import column, read

# The five sums of the law below are F_0, F_(1/2), F_1, F_2 and F_(5/2), F_n(h) = Int_h^inf (z - h)^n f(z) dz.
POWERS = (0.0, 0.5, 1.0, 2.0, 2.5)


@formula
def powers(u, start):
    """Powers of the displacement w = u^2 - start, in the coordinate u."""
    w = u * u
    return w - start, 2.0 * u, u, w, w * w, w * w * u


@formula
def powers_coordinate(w, start):
    return math.sqrt(max(w + start, 0.0))


def power_law(laws=1, edges=(0.0, math.inf), start=0.0):
    return Regime(powers, powers_coordinate, (np.full(laws, start),), np.tile(edges, (laws, 1)), "elastic", lowest=-start)


def distribution(key, shape):
    return {"gaussian": gaussian, "exponential": exponential_heights}[key]() if key != "weibull" else weibull(shape)


@pytest.mark.usefixtures("always_grid")
@pytest.mark.parametrize("way", (scattered, on_grid))
def test_truncated_moments_of_every_distribution(way):
    """reference/greenwood_williamson_1966.csv: F_n(h) at 30 digits. 1e-10 of each, whatever its size."""
    rows = read("greenwood_williamson_1966.csv")
    seen = 0
    for key, shape in sorted({(row["heights"], row["shape"]) for row in rows}):
        heights = distribution(key, float(shape or "nan"))
        for at, n in enumerate(POWERS):
            mine = [row for row in rows if (row["heights"], row["shape"], float(row["n"])) == (key, shape, n)]
            h, expected = column(mine, "h"), column(mine, "F_n")
            if way is scattered:
                found = scattered([power_law(h.size)], h, heights)[0, :, at]
            else:
                found = on_grid([power_law()], h, heights)[0, 0, at]
            assert_allclose(found, expected, rtol=1e-10, err_msg=f"{key} {shape} F_{n}")
            seen += h.size
    assert seen == 378 - 4 * 21  # the table has F_(3/2) too: Hertz, tested with the models


def test_exponential_heights_have_closed_forms():
    """Greenwood & Williamson 1966, section 3: F_n(h) = n! exp(-(h + 1)) for h >= -1, so all ratios stand still."""
    h = np.linspace(-1.0, 20.0, 50)
    sums = scattered([power_law(h.size)], h, exponential_heights())[0]
    for at, n in enumerate(POWERS):
        assert_allclose(sums[:, at], gamma(n + 1.0) * np.exp(-(h + 1.0)), rtol=1e-11)


def polygon_moment(heights, h, n):
    """Int_h^inf (z - h)^n f(z) dz for a piecewise linear f, knot by knot in closed form, from the knots and their density."""
    knots, values = heights.knots, heights.shape[2:]
    total = 0.0
    for a, b, fa, fb in zip(knots[:-1], knots[1:], values[:-1], values[1:], strict=True):
        slope = (fb - fa) / (b - a)
        low, high = max(a, h) - h, max(b, h) - h
        level = fa + slope * (h - a)  # of the line, at z = h
        total += level * (high ** (n + 1) - low ** (n + 1)) / (n + 1) + slope * (high ** (n + 2) - low ** (n + 2)) / (n + 2)
    return total


@pytest.mark.parametrize("cells", (12, 60))
def test_empirical_heights(cells):
    """The engine's sums over a polygon against its closed form: 1e-10, also where few samples lie above."""
    heights = empirical(np.random.default_rng(17).gumbel(size=5000), cells)
    h = np.linspace(-2.0, 3.0, 21)
    sums = scattered([power_law(h.size)], h, heights)[0]
    for at, n in enumerate(POWERS):
        assert_allclose(sums[:, at], [polygon_moment(heights, one, n) for one in h], rtol=1e-10)
    assert_allclose(on_grid([power_law()], h, heights)[0, 0].T, sums, rtol=1e-13)


@pytest.mark.parametrize(
    ("origins", "two_sided", "origin"),
    [((), True, None), ((0.95,), False, 0.95), ((1.0,), False, 1.0), ((3.1, 0.9), True, 0.9), ((3.1, 0.5), True, 3.1),
     ((3.0,), True, 3.0), ((3.1,), False, None), ((2.0, 0.5, 3.5), True, None)],
)  # fmt: skip
def test_segments_are_mapped_from_end_to_end_by_the_root_of_the_distance_to_a_near_branch(origins, two_sided, origin):
    low, high = 1.0, 3.0
    linear, square = map_segment(low, high, np.array(origins), two_sided)
    t = np.linspace(0.0, 1.0, 5)
    u = low + linear * t + square * t**2
    along = u if origin is None else np.sqrt(np.abs(u - origin))
    assert_allclose(u[[0, -1]], [low, high], rtol=1e-14)
    assert_allclose(along, np.linspace(along[0], along[-1], 5), atol=1e-7)


def test_edges_between_cut_nothing_off(always_grid):
    """Segments, empty segments and displacements that start below zero: all sums stand."""
    h = np.linspace(-3.0, 3.0, 13)
    whole = on_grid([power_law(start=0.7)], h, gaussian())[0, 0]
    split = [0.0, 0.1, 0.1, 0.4, 0.4, 1.3, 2.5, math.inf]
    assert_allclose(on_grid([power_law(edges=split, start=0.7)], h, gaussian())[0, 0], whole, rtol=1e-11)
    assert_allclose(scattered([power_law(13, split, 0.7)], h, gaussian())[0].T, whole, rtol=1e-11)
    assert_allclose(whole[0], erfc((h - 0.7) / math.sqrt(2.0)) / 2.0, rtol=1e-13)


def test_a_regime_without_length_is_nothing(always_grid):
    h = np.linspace(0.0, 1.0, 12)
    for edges in ((2.0, 2.0), (3.0, 1.0)):
        assert not on_grid([power_law(edges=edges)], h, gaussian()).any()
        assert not scattered([power_law(12, edges)], h, gaussian()).any()


def test_order_and_blocks(always_grid):
    """More laws than one block, each with its own start; regimes apart and together; laws by number."""
    laws, h = 600, np.linspace(-4.0, 5.0, 19)
    starts = np.linspace(0.0, 2.0, laws)
    first = Regime(powers, powers_coordinate, (starts,), np.tile([0.0, 1.0], (laws, 1)), "elastic", lowest=-2.0)
    second = Regime(powers, powers_coordinate, (starts,), np.tile([1.0, math.inf], (laws, 1)), "plastic", lowest=-2.0)
    grid = on_grid([first, second], h, gaussian())
    assert grid.shape == (2, laws, len(QUANTITIES), h.size)
    low = (h - starts[:, None]) / math.sqrt(2.0)
    high = (h + 1.0 - starts[:, None]) / math.sqrt(2.0)
    # Whichever tail is small, so that the difference keeps its digits.
    expected = np.where(low > 0.0, erfc(low) - erfc(high), erfc(-high) - erfc(-low)) / 2.0
    assert_allclose(grid[0, :, 0], expected, rtol=1e-10)
    together = grid.sum(axis=0)
    totals = np.stack([together[:, 1], together[:, 2], together[:, 3] + together[:, 4]], axis=1)
    assert_allclose(totals_on_grid([first, second], h, gaussian()), totals, rtol=1e-10)
    law = np.array([599, 3, 3, 256])
    single = scattered([first, second], h[[0, 5, 18, 9]], gaussian(), law)
    assert_allclose(single, grid[:, law, :, [0, 5, 18, 9]].transpose(1, 0, 2), rtol=1e-10)


def test_separations_far_apart_and_beyond_all_heights(always_grid):
    """A grid wider than the expansion reaches, and separations at which nothing touches: relative digits are kept."""
    h = np.concatenate([np.linspace(-12.0, 12.0, 25), [20.0, 30.0, 36.0]])
    touching = on_grid([power_law()], h, gaussian())[0, 0, 0]
    assert_allclose(touching, erfc(h / math.sqrt(2.0)) / 2.0, rtol=1e-11)
    assert on_grid([power_law()], np.linspace(40.0, 50.0, 12), gaussian()).max() == 0.0


def test_separations_of_any_spread(always_grid):
    """Near each other and worlds apart, in any order: F_0 and F_1 in closed form, F_2 = (h^2 + 1) F_0 - h phi(h)."""
    h = np.concatenate([np.linspace(1e6, -1e6, 5), [3.0], np.linspace(-30.0, 5.0, 90), [-1e4, -1e4 + 0.5, 200.0]])
    laws = 300
    found = on_grid([power_law(laws)], h, gaussian())[0]
    touching, phi = erfc(h / math.sqrt(2.0)) / 2.0, np.exp(-(h**2) / 2.0) / math.sqrt(2.0 * math.pi)
    near = h < 3.5  # beyond, the closed forms lose their digits
    for at, expected in ((0, touching), (2, phi - h * touching), (3, (h**2 + 1.0) * touching - h * phi)):
        assert_allclose(found[:, at, near], np.tile(expected[near], (laws, 1)), rtol=1e-10)
        alone = scattered([power_law(h.size)], h, gaussian())[0, ~near, at]
        assert_allclose(found[:, at, ~near], np.tile(alone, (laws, 1)), rtol=1e-10)


def test_what_is_left_behind_far_below_the_mean(always_grid):
    """Where all is pressed far beyond a segment, the few asperities on it still count: they may carry all the friction."""
    h = np.linspace(-14.0, -20.0, 30)
    segment = on_grid([power_law(300, (0.0, 1.0))], h, gaussian())[0, :, 0]
    expected = (erfc(-(h + 1.0) / math.sqrt(2.0)) - erfc(-h / math.sqrt(2.0))) / 2.0
    assert expected.max() < 1e-30
    assert_allclose(segment, np.tile(expected, (300, 1)), rtol=1e-10)
