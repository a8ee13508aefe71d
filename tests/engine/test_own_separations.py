"""Sums of laws that have several separations each, all with integration nodes that are placed once."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from test_summation import POWERS, power_law

from stiction.engine.heights import gaussian, weibull
from stiction.engine.own_separations import sums_of_each
from stiction.engine.summation import Scattered, scattered
from tables import column, read


def test_truncated_moments():
    """reference/greenwood_williamson_1966.csv: F_n(h) at 30 digits, for three laws with a third of the separations each."""
    rows = [row for row in read("greenwood_williamson_1966.csv") if row["heights"] == "gaussian"]
    for at, n in enumerate(POWERS):
        mine = [row for row in rows if float(row["n"]) == n]
        assert len(mine) % 3 == 0
        h, expected = (column(mine, name).reshape(-1, 3).T for name in ("h", "F_n"))
        found = sums_of_each(Scattered([power_law(3)], gaussian()), h)[0, :, :, at]
        assert_allclose(found, expected, rtol=1e-10)


def test_a_law_does_not_depend_on_others():
    """Each law has a start of its own: bits are those of other blocks, other threads and other orders."""
    starts, h = np.linspace(0.0, 2.0, 300), np.random.default_rng(3).uniform(-7.0, 9.0, (300, 5))

    def regimes(starts):
        split = power_law(300, edges=(0.0, 0.4, 3.0, np.inf))
        return [power_law(300), replace(split, parameters=(starts,), lowest=-2.0)]

    sums = sums_of_each(Scattered(regimes(starts), gaussian()), h)
    assert_array_equal(sums_of_each(Scattered(regimes(starts), gaussian()), h, threads=3), sums)
    turned = sums_of_each(Scattered(regimes(starts[::-1].copy()), gaussian()), h[::-1].copy())
    assert_array_equal(turned, sums[:, ::-1])
    single = scattered(regimes(starts), h.reshape(-1), gaussian(), np.repeat(np.arange(300), 5))
    assert_allclose(sums, single.reshape(sums.shape), rtol=1e-12)


@pytest.mark.parametrize(
    ("heights", "h"),
    [(gaussian(), [[0.0, 1.0, 30.0], [0.5, 2.0, 3.0]]), (gaussian(), [[0.0, 1.0, 2.0]]), (gaussian(), [[0.0], [1.0]]),
     (weibull(3.0), [[0.0, 1.0, 1.5], [0.5, 1.0, -1.0]])],
    ids=("a separation far away", "a single law", "a separation for each", "other heights"),
)  # fmt: skip
def test_what_is_summed_one_by_one(heights, h):
    h = np.array(h)
    regimes = [power_law(len(h))]
    single = scattered(regimes, h.reshape(-1), heights, np.repeat(np.arange(len(h)), h.shape[1]))
    assert_allclose(sums_of_each(Scattered(regimes, heights), h)[0], single.reshape(*h.shape, 5), rtol=1e-12)
