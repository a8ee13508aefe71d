"""Sobol points are those of SciPy, also from disk; rows, samples and coverage of uncertain numbers."""

import numpy as np
import pytest
from scipy.stats import qmc

from refusals import refusal
from stiction.case.distribution import _Values
from stiction.case.read import parse_case
from stiction.quantities.cache import cache_folder
from stiction.quantities.sampling import sobol_points, spread_rows


@pytest.fixture(autouse=True)
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))


def files():
    return sorted(cache_folder("points").glob("*.npz"))


def test_points_are_those_of_scipy_before_and_after_they_are_kept():
    expected = qmc.Sobol(3, rng=np.random.default_rng(7)).random(64)
    np.testing.assert_array_equal(sobol_points(3, 64, 7), expected)
    assert len(files()) == 1
    np.testing.assert_array_equal(sobol_points(3, 64, 7), expected)


def test_points_of_two_seeds_differ():
    first, second = np.random.SeedSequence(1).spawn(2)
    assert not np.array_equal(sobol_points(2, 16, first), sobol_points(2, 16, second))


def test_a_damaged_file_is_made_anew():
    expected = sobol_points(2, 16, 1)
    file = files()[0]
    content = bytearray(file.read_bytes())
    middle = len(content) // 2
    content[middle : middle + 8] = bytes(255 - byte for byte in content[middle : middle + 8])
    file.write_bytes(content)
    np.testing.assert_array_equal(sobol_points(2, 16, 1), expected)
    assert file.read_bytes() != bytes(content)


def test_rows_are_spread_from_the_first_to_the_last():
    np.testing.assert_array_equal(spread_rows(10, 4), [0, 3, 6, 9])
    np.testing.assert_array_equal(spread_rows(3, 5), [0, 1, 2])


def test_quantiles_of_samples_are_the_samples_in_their_order():
    samples = _Values(np.array([3.0, 1.0, 2.0, 5.0]))
    np.testing.assert_array_equal(samples.ppf([0.0, 0.25, 0.5, 0.99, 1.0]), [3.0, 1.0, 2.0, 5.0, 5.0])


@pytest.mark.parametrize("coverage", [0.0, 1.0, 1.005])
def test_a_coverage_of_nothing_or_everything_is_refused(coverage):
    case = {"indices": {"theta": 10.0, "lam": 5.0}, "solve": {"load": [1e-3]}, "uncertainty": {"coverage": coverage}}
    with refusal("uncertainty.coverage", coverage):
        parse_case(case)
