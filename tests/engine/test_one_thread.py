"""Linear algebra of films that are solved is on one thread, whatever is usual elsewhere, and only there."""

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.curves import _solved


def threads():
    return [one["num_threads"] for one in ThreadpoolController().select(user_api="blas").info()]


@on_one_thread
def seen(value, *, of=1.0):
    return threads(), value / of


def test_one_thread_inside_and_as_before_outside():
    with ThreadpoolController().limit(limits=2, user_api="blas"):
        inside, half = seen(1.0, of=2.0)
        assert inside and set(inside) == {1} and half == 0.5
        assert set(threads()) == {2}


def test_threads_come_back_after_an_error():
    before = threads()
    with pytest.raises(ZeroDivisionError):
        seen(1.0, of=0.0)
    assert threads() == before


def test_a_film_has_the_same_bits_with_any_number_of_threads():
    pair = (Layer(0.5, 0.3, 0.1),)
    found = []
    for count in (1, 2):
        with ThreadpoolController().limit(limits=count, user_api="blas"):
            found.append(_solved.__wrapped__(pair))
    np.testing.assert_array_equal(*found)
