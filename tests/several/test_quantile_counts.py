"""Quantiles from counts: their stated error, against numpy's; and counts of parts, which add up to the last one."""

import numpy as np
import pytest

from stiction.studies.sweep import quantile_counts
from stiction.studies.sweep.quantile_counts import PERCENTILES, bin_centres, bin_numbers, histogram, quantiles_of

# Sizes of every kind: of both signs, over many decades, few and many, equal, not numbers.
CHANCE = np.random.default_rng(3)
KINDS = {
    "positive": CHANCE.lognormal(size=(997, 3)),
    "of both signs": CHANCE.standard_normal((500, 2)) * 1e-9,
    "many decades": 10.0 ** CHANCE.uniform(-300, 300, (400, 2)),
    "negative": -CHANCE.lognormal(size=(50, 2)),
    "equal": np.full((20, 2), 0.3),
    "two": np.array([[1.0, 5.0], [2.0, 5.0]]),
    "with gaps": np.where(CHANCE.uniform(size=(300, 2)) < 0.3, np.nan, CHANCE.uniform(size=(300, 2))),
}


@pytest.mark.parametrize("kind", KINDS)
def test_quantiles_are_those_of_all_values_within_the_stated_error(kind):
    values = KINDS[kind]
    shares = list(PERCENTILES.values())
    found = quantiles_of([histogram(values)], values.shape[1], shares)
    wanted = np.array(
        [[np.quantile(one[np.isfinite(one)], share, method="inverted_cdf") for one in values.T] for share in shares]
    )
    np.testing.assert_allclose(found, wanted, rtol=1 / 256)


def test_counts_of_parts_add_up_in_any_order():
    values = KINDS["positive"]
    parts = [histogram(values[at : at + 100]) for at in range(0, 997, 100)]
    whole = quantiles_of([histogram(values)], 3, [0.05, 0.5, 0.95])
    for some in (parts, parts[::-1]):
        np.testing.assert_array_equal(quantiles_of(some, 3, [0.05, 0.5, 0.95]), whole)
    assert sum(int(part[1].sum()) for part in parts) == int(histogram(values)[1].sum()) == values.size


def test_counts_that_are_added_bit_by_bit_are_those_added_at_once(monkeypatch):
    values = KINDS["of both signs"]
    parts = [histogram(values[at : at + 50]) for at in range(0, 500, 50)]
    whole = quantiles_of(parts, 2, [0.05, 0.5, 0.95])
    monkeypatch.setattr(quantile_counts, "_AT_ONCE", 1)
    np.testing.assert_array_equal(quantiles_of(parts, 2, [0.05, 0.5, 0.95]), whole)


def test_counts_are_as_wide_as_the_most_sizes_of_a_point():
    values = np.array([[1.0, 1.0], [1.0, 2.0], [1.0, 3.0], [np.nan, 3.0]])
    sizes, many = histogram(values)
    assert many.tolist() == [[3, 0, 0], [1, 1, 2]] and (sizes > 0).tolist() == [[True, False, False], [True] * 3]


def test_sizes_are_in_the_order_of_the_values_and_hold_them():
    values = np.sort(np.concatenate([-KINDS["many decades"].ravel(), [0.0, -0.0, 5e-324], KINDS["many decades"].ravel()]))
    sizes = bin_numbers(values)
    assert (np.diff(sizes.astype(int)) >= 0).all() and sizes.min() > 0
    np.testing.assert_allclose(bin_centres(sizes), values, rtol=1 / 256, atol=1e-307)
    assert bin_centres(bin_numbers(np.array([0.0]))) == 0.0


def test_no_values_have_no_quantile():
    values = np.array([[np.nan, 1.0], [np.inf, 3.0]])
    found = quantiles_of([histogram(values)], 2, [0.5])
    assert np.isnan(found[0, 0]) and found[0, 1] == pytest.approx(1.0, rel=1 / 256)
    assert np.isnan(quantiles_of([histogram(np.full((3, 1), np.nan))], 1, [0.5])).all()
