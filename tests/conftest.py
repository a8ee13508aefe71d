"""Fixtures that several folders use. This file also puts tests/ on the import path, where `tables` is."""

import gc
import os
import signal
import sys

# Tests run in processes side by side: with as many threads each, they would wait for each other. Before numpy is there.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import pytest

from stiction.engine import summation, tiers

# What is imported stays, and compiling makes small objects without end: looking for rubbish among them took a seventh of it.
gc.freeze()
gc.set_threshold(100_000, 20, 100)


# Loops of a regime's own take two to three seconds each to compile, a tenth of a cold run of all tests, and save less than that
# below so many pairs. Tests of the tiers ask for them (STICTION_LOOPS), or for the threshold of the package.
WORTH_COMPILING, tiers._WORTH_COMPILING = tiers._WORTH_COMPILING, 10_000_000

# A shell starts what it puts into the background deaf to Ctrl-C, and so are the commands that tests start and interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items):
    """Move the tests of the page to where two thirds are done: the kernels that its servers need are compiled by then.

    Processes take whole files in this order. The browser takes minutes, and the other processes have enough left meanwhile.
    """
    page = [item for item in items if item.path.parent.name == "web"]
    others = [item for item in items if item.path.parent.name != "web"]
    page.sort(key=lambda item: item.path.name != "test_browser.py")
    done = 2 * len(others) // 3
    before = others[:done] + [item for item in others[done:] if item.path == others[done - 1].path]  # no file is split
    items[:] = [*before, *page, *others[len(before) :]]


@pytest.fixture(autouse=True)
def no_silent_nan():
    """Arithmetic that makes NaN or infinity is an error in every test; underflow to zero is meant."""
    with np.errstate(all="raise", under="ignore"):
        yield


@pytest.fixture
def no_pictures(monkeypatch):
    """Leave out pictures, as where matplotlib is not installed; they take longer than the numbers."""
    monkeypatch.setitem(sys.modules, "matplotlib", None)


@pytest.fixture
def empty_pictures(monkeypatch):
    """Write empty files in place of pictures, in tests that read only their names."""
    from stiction.report.view import Picture

    monkeypatch.setattr(Picture, "write", lambda picture, path: path.touch())


@pytest.fixture
def force_loops(monkeypatch):
    """A function that sets or, with None, removes STICTION_LOOPS for the rest of the test."""

    def force(tier):
        monkeypatch.delenv(tiers.VARIABLE, raising=False)
        if tier is not None:
            monkeypatch.setenv(tiers.VARIABLE, tier)
        tiers.tier.cache_clear()

    monkeypatch.setattr(tiers, "_WORTH_COMPILING", WORTH_COMPILING)
    yield force
    monkeypatch.undo()
    tiers.tier.cache_clear()


@pytest.fixture
def always_grid(monkeypatch):
    """Small grids are cheaper one by one; here the grid's own way answers for them too."""
    monkeypatch.setattr(summation, "_MANY", 0)
