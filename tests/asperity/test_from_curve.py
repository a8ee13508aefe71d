"""Segments from plain functions of the displacement; their sums over Gaussian heights against adaptive quadrature."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.stats import norm

from stiction.engine.heights import gaussian
from stiction.engine.summation import on_grid
from stiction.laws.asperity import hertz
from stiction.laws.joining import Law
from stiction.laws.segment import from_curve

SEPARATIONS = np.array([-1.0, 0.5, 3.0])


def power(w, factor, exponent):
    return factor * w**exponent


def held(w, start, factor):
    return factor * math.sqrt(w - start) - 0.4


def twice(w, factor, exponent):
    return 2.0 * w


def summed(*segments):
    """Load and contact area of the segments of one contact, at SEPARATIONS."""
    law = Law(replace(hertz.RECORD, segments=lambda groups: segments))
    return on_grid(law.regimes(None), SEPARATIONS, gaussian()).sum(axis=0)[0, 1:3]


def integral(curve, start, end=math.inf):
    """Of a curve of the displacement between two displacements, over Gaussian heights."""

    def at(h):
        low, high = max(h + start, -8.0), min(h + end, 14.0)
        inner = [z for z in (-2.0, 0.0, 2.0, 4.0) if low < z < high]
        return quad(lambda z: curve(z - h) * norm.pdf(z), low, high, points=inner or None, epsabs=0, epsrel=1e-12, limit=200)[0]

    return [at(h) for h in SEPARATIONS]


@pytest.mark.parametrize("exponent", [1.5, 1.0, 1.263, 2.5])
def test_powers_of_the_displacement(exponent):
    segment = from_curve(power, twice, np.zeros(1), parameters=(np.array([0.7]), np.array([exponent])))
    load, area = summed(segment)
    assert_allclose(load, integral(lambda w: 0.7 * w**exponent, 0.0), rtol=1e-8)
    assert_allclose(area, integral(lambda w: 2.0 * w, 0.0), rtol=1e-8)


def test_segments_that_adjoin_and_one_that_holds_on_below_zero():
    first = from_curve(held, twice, np.array([-0.8]), np.array([0.5]), parameters=(np.array([-0.8]), np.ones(1)))
    second = from_curve(power, twice, np.array([0.5]), parameters=(np.array([0.3]), np.array([1.425])), state="plastic")
    expected = np.add(integral(lambda w: math.sqrt(w + 0.8) - 0.4, -0.8, 0.5), integral(lambda w: 0.3 * w**1.425, 0.5))
    assert (first.state, second.state, first.lowest) == ("elastic", "plastic", -0.8)
    assert_allclose(summed(first, second)[0], expected, rtol=1e-8)


def test_coordinate_is_the_inverse():
    segment = from_curve(held, twice, np.array([-0.8]), parameters=(np.array([-0.8]), np.ones(1)))
    for w in (-0.8, -0.3, 0.0, 2.0):
        assert segment.normal(segment.coordinate(w, -0.8, -0.8, 1.0), -0.8, -0.8, 1.0)[0] == pytest.approx(w, abs=1e-15)


def test_the_same_functions_give_the_same_formulas():
    """Kernels are compiled once for all contacts."""
    first, second = (from_curve(power, twice, np.zeros(n), parameters=(np.ones(n), np.ones(n))) for n in (1, 3))
    assert (first.normal, first.coordinate) == (second.normal, second.coordinate)
