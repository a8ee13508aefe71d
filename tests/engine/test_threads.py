"""Threads share the work and change nothing: the same bits, whatever their number, also more than there is work for."""

from dataclasses import replace
from importlib import import_module

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.engine.heights import weibull
from stiction.engine.summation import in_threads
from stiction.solving.choice import Choice
from stiction.solving.problem import make_problem

H = np.linspace(-4.0, 5.0, 40)
THETA, LAM = np.geomspace(0.1, 1e3, 60)[:, None], np.geomspace(0.01, 1e3, 100)
FILM = {"n_E": 0.5, "n_H": 0.4, "tau": 2.0}


@pytest.fixture
def small_parts(monkeypatch):
    """Parts so small that there are many; 6000 laws in blocks of 256 as always."""
    module = import_module("stiction.solving.evaluate")
    monkeypatch.setattr(module, "_POINTS", 500)
    monkeypatch.setattr(module, "_LAWS", 700)


@pytest.fixture(autouse=True)
def compiled(force_loops):
    """What Python runs at first and compiled code later agrees to 1e-13, not in every bit."""
    force_loops("shared")


@pytest.mark.parametrize("film", ({}, FILM))
@pytest.mark.parametrize("threads", (2, 3, 64))
def test_evaluate_gives_the_same_bits(small_parts, film, threads):
    h = np.random.default_rng(1).uniform(-6.0, 8.0, (60, 100))
    for separation, theta, lam in ((h, THETA, LAM), (H, THETA[..., None], LAM[:, None])):
        alone = st.evaluate(separation, theta, lam, **film)
        together = st.evaluate(separation, theta, lam, **film, threads=threads)
        for one, other in zip(alone, together, strict=True):
            assert np.array_equal(one, other) and np.isfinite(one).all()


@pytest.mark.parametrize("heights", (None, weibull(2.0)))
@pytest.mark.parametrize("threads", (2, 5))
def test_a_problem_gives_the_same_bits(heights, threads):
    indices = st.Indices(theta=st.axis("theta", np.geomspace(1.0, 1e3, 300)), lam=20.0)
    alone = make_problem(indices, Choice(), heights)
    together = replace(alone, threads=threads)
    separations = np.random.default_rng(2).uniform(-3.0, 4.0, (300, 3))
    for one, other in ((alone.on_grid(H), together.on_grid(H)), (alone.at(separations), together.at(separations))):
        assert one.keys() == other.keys()
        for name in one:
            assert np.array_equal(one[name], other[name], equal_nan=True), name
    assert np.array_equal(alone.loads_on_grid(H), together.loads_on_grid(H))


@pytest.mark.parametrize("threads", (0, -1, 1.5, "2"))
def test_threads_that_are_no_number_are_refused(threads):
    with refusal("threads", "1"):
        st.evaluate(0.0, 10.0, 10.0, threads=threads)
    with refusal("threads", "1"):
        st.solve(st.Indices(theta=10, lam=10), separation=1.0, threads=threads)


@pytest.mark.parametrize("threads", (1, 2))
def test_what_goes_wrong_in_a_thread_is_raised(threads):
    def fail(part):
        raise ArithmeticError(part)

    with pytest.raises(ArithmeticError, match="7"):
        in_threads(fail, [7], threads)
