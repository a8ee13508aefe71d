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


@pytest.hookimpl(tryfirst=True)  # before xdist reads the marks
def pytest_collection_modifyitems(items):
    """What one process does alone, as the browser, begins where two thirds are done: kernels are compiled by then, and the
    other process has enough left to do meanwhile. Tests that share a fixture of their module run in one process, which makes
    it once."""
    alone = [item for item in items if item.get_closest_marker("xdist_group")]
    others = [item for item in items if not item.get_closest_marker("xdist_group")]
    for item in others:
        if group := _shared_by(item):
            item.add_marker(pytest.mark.xdist_group(group))
    done = 2 * len(others) // 3
    items[:] = [*others[:done], *alone, *others[done:]]


def _shared_by(item):
    """Return the module of a test with the parameters of the module's fixtures that it uses; "" if it uses none."""
    fixtures = getattr(item, "_fixtureinfo", None)
    found = {name for name, known in fixtures.name2fixturedefs.items() if known[-1].scope == "module"} if fixtures else set()
    chosen = getattr(getattr(item, "callspec", None), "indices", {})
    return "-".join([item.module.__name__, *(str(chosen[name]) for name in sorted(found & chosen.keys()))]) if found else ""


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
