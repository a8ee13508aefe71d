"""Sobol points are those of SciPy, also where they are read from disk."""

import numpy as np
import pytest
from scipy.stats import qmc

from stiction.quantities.cache import cache_folder
from stiction.quantities.sampling import sobol_points


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
