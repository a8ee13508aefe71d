"""The matrix in tiles, and the search along segments: what the sums of every model rest on, against sums one by one and exact
arithmetic."""

import math
from fractions import Fraction

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.engine.bisection import halving, up_to
from stiction.engine.compiled import formula
from stiction.engine.heights import gaussian
from stiction.engine.regime import Regime, columns
from stiction.engine.summation import on_grid, scattered, totals_on_grid
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import largest_root, unit_roots
from stiction.laws.joining import with_kinks


@formula
def hertz(u, start):
    w = u * u
    return w + start, 2.0 * u, w * u - 0.5, w, w, 0.5 * w * w


@formula
def hertz_coordinate(w, start):
    return math.sqrt(max(w - start, 0.0))


@pytest.mark.parametrize("laws", (1, 2, 3, 301))
@pytest.mark.parametrize("separations", (1, 8, 127, 128, 129, 300))
def test_every_shape_of_the_matrix(always_grid, laws, separations):
    """Numbers of rows that are no multiple of four, and of separations that fill no tile."""
    h = np.random.default_rng(3).uniform(-4.0, 5.0, separations)
    starts = np.linspace(0.0, 1.0, laws)
    regime = Regime(hertz, hertz_coordinate, (starts,), np.tile([0.0, math.inf], (laws, 1)), "elastic")
    alone = scattered([regime], np.tile(h, laws), gaussian(), np.repeat(np.arange(laws), separations))
    alone = np.moveaxis(alone.reshape(laws, separations, 5), 1, 2)
    size = alone[:, 1] + alone[:, 0]  # of the load, which changes its sign: without the half that is taken off
    found, totals = on_grid([regime], h, gaussian())[0], totals_on_grid([regime], h, gaussian())
    for load, rest, whole in ((found[:, 1], found[:, 2:], alone[:, 2:]), (totals[:, 0], totals[:, 1:], None)):
        assert np.abs((load - alone[:, 1]) / size).max() < 1e-10
        expected = whole if whole is not None else np.stack([alone[:, 2], alone[:, 3] + alone[:, 4]], axis=1)
        assert_allclose(rest, expected, rtol=1e-10)


def test_kinks_at_an_end_but_for_rounding_make_no_segment():
    """They are put at the end; others stay, on segments without end too."""
    edges = np.array([[1.0, 3.0], [1.0, math.inf], [0.0, 2.0]])
    kinks = np.array([[1.0 + 4e-16, 3.0 - 9e-16, 2.0], [1.0 - 3e-16, 1e300, 5.0], [1e-30, 0.0, 2.0]])
    expected = [[1.0, 1.0, 2.0, 3.0, 3.0], [1.0, 1.0, 5.0, 1e300, math.inf], [0.0, 0.0, 1e-30, 2.0, 2.0]]
    assert with_kinks(edges, kinks).tolist() == expected


def test_columns_of_arrays_and_numbers():
    assert columns((np.array([1.0, 2.0]), 3.0), 2).tolist() == [[1.0, 3.0], [2.0, 3.0]]
    assert columns((), 2).shape == (2, 0)


def test_roots_of_the_cubic_to_the_last_digits():
    """v^3 + a v - 1 = 0 changes its sign between neighbours of v, in exact arithmetic; and so for another constant."""
    rng = np.random.default_rng(4)
    a = np.concatenate([[0.0, -3.0 / 4.0 ** (1.0 / 3.0), 3.0], *(sign * 10 ** rng.uniform(-12, 12, 200) for sign in (-1, 1))])
    for one, v in zip(a, unit_roots(a), strict=True):
        assert _rises_through_zero(float(one), 1.0, float(v))
        assert _rises_through_zero(float(one), 7.0, largest_root(one, 7.0))


def _rises_through_zero(a, c, v):
    low, high = (Fraction(v) * (1 + Fraction(sign, 10**15)) for sign in (-1, 1))
    return low**3 + Fraction(a) * low < Fraction(c) < high**3 + Fraction(a) * high


@formula
def below(u, given):
    return u * u < given


def test_search_along_a_segment():
    """The place where u^2 passes a number: on a segment with an end and without; its ends where it does not."""
    search, halve = up_to(below), halving(below)
    assert search(0.5, math.inf, 1.0, 1e100, 2.0) == pytest.approx(math.sqrt(2.0), rel=3e-16)
    assert search(0.5, 9.0, 1.0, 1e100, 1e20) == 9.0
    assert search(0.5, math.inf, 1.0, 1e6, math.inf) == math.inf
    assert search(2.0, math.inf, 1.0, 1e6, 1.0) == 2.0
    assert halve(1.0, 2.0, 2.0) ** 2 >= 2.0 > np.nextafter(halve(1.0, 2.0, 2.0), 0.0) ** 2
