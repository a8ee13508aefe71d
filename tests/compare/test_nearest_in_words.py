"""Text that describes how a contact differs from the nearest benchmark surface."""

import numpy as np
import pytest

from stiction.solving.accuracy.solved_near import Difference, nearest_in_words


def difference(name, squared):
    return Difference(np.array([name]), np.array([1.0]), np.array([[2.0]]), np.array([[squared]]))


@pytest.mark.parametrize(
    ("squared", "named"),
    [
        ((0.5, 0.3, 0.1, 0.06, 0.04), "ab"),
        ((0.19, 0.21, 0.2, 0.2, 0.2), "b"),  # none has a quarter of the squared distance
    ],
)
def test_the_largest_difference_is_always_named(squared, named):
    parts = [difference(name, square) for name, square in zip("abcde", squared, strict=True)]
    assert nearest_in_words(parts, 0, 0) == "the nearest has " + " and ".join(f"{name} 2 instead of 1" for name in named)
