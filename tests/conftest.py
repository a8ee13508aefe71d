"""Fixtures that several folders use. This file also puts tests/ on the import path, where `tables` is."""

import os
import signal

# Tests run in processes side by side: with as many threads each, they would wait for each other. Before numpy is there.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest

from stiction.engine import summation

# A shell has what it starts in the background ignore Ctrl-C, of which there are tests.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def no_silent_nan():
    """Arithmetic that makes NaN or infinity is an error in every test; underflow to zero is meant."""
    with np.errstate(all="raise", under="ignore"):
        yield


@pytest.fixture
def always_grid(monkeypatch):
    """Small grids are cheaper one by one; here the grid's own way answers for them too."""
    monkeypatch.setattr(summation, "_MANY", 0)
