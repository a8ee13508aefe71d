"""Changes of sign along segments: roots, jumps and flat places, to rounding."""

import math

import numpy as np

from stiction.engine.compiled import formula
from stiction.engine.crossings import MOST, crossing


@formula
def wave(u, row):
    return math.sin(row[0] * u) - row[1]


@formula
def fall(u, row):
    return 1.0 if u < row[0] else -1e-3 * row[1]


@formula
def flat(u, row):
    return row[1] * (u - row[0]) ** 3


def found(excess, table, edges):
    out = np.empty((len(table), MOST))
    crossing(excess, 2)(table, np.tile(np.array(edges, dtype=float), (len(table), 1)), out)
    return out


def test_every_root_of_a_wave():
    """sin(k u) = c on [0, 7]: the roots in order, and the first edge for those that are not there."""
    rng = np.random.default_rng(0)
    table = np.column_stack([rng.uniform(0.5, 1.3, 300), rng.uniform(0.05, 0.9, 300)])
    for (k, c), roots in zip(table, found(wave, table, [0.0, 7.0]), strict=True):
        first, turns = math.asin(c), 2.0 * math.pi * np.arange(3)
        expected = np.sort(np.concatenate([first + turns, math.pi - first + turns])) / k
        expected = expected[expected < 7.0]
        np.testing.assert_allclose(roots[: len(expected)], expected, rtol=1e-13)
        assert (roots[len(expected) :] == 0.0).all()


def test_a_root_at_a_sample_is_found_once():
    """Every whole number in [0, 24] is a sample; a line through zero rises or falls there."""
    rows = np.array([[5.0, 1.0], [5.0, -1.0], [23.0, 1.0]])
    roots = found(flat, rows, [0.0, 24.0])
    np.testing.assert_allclose(roots[:, 0], rows[:, 0], rtol=1e-14)
    assert (roots[:, 1:] == 0.0).all()


def test_a_jump_and_a_flat_place():
    rng = np.random.default_rng(1)
    table = np.column_stack([rng.uniform(0.01, 1.99, 300), rng.uniform(0.1, 9.0, 300)])
    for excess in (fall, flat):
        roots = found(excess, table, [0.0, 0.5, 2.0])
        np.testing.assert_allclose(roots[:, 0], table[:, 0], rtol=1e-14)
        assert (roots[:, 1:] == 0.0).all()
