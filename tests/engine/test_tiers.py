"""Shared loops in stages and loops compiled for a regime give the same sums; which of them run is decided by counting."""

import os
import subprocess
import sys

import numpy as np
import pytest

import stiction as st
from refusals import refusal
from stiction.contact.indices import Groups, stiffness_group
from stiction.engine.heights import empirical, exponential_heights, gaussian, weibull
from stiction.engine.starting_separations import Approach
from stiction.engine.summation import on_grid, scattered, totals_on_grid
from stiction.engine.tiers import VARIABLE, Allowance, all_compiled, interpreted, specialised
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of

RNG = np.random.default_rng(7)
# Of three regimes, of one, and of three between which loads jump.
MODELS = ("soft_coating_2015", "greenwood_williamson_1966", "kogut_etsion_2004")
HEIGHTS = {
    "gaussian": gaussian(),
    "exponential": exponential_heights(),
    "weibull": weibull(2.0),
    "empirical": empirical(RNG.normal(size=400)),
}


def regimes(model, count=60):
    ones, theta, lam = np.ones(count), 10 ** RNG.uniform(0, 3, count), 10 ** RNG.uniform(-2, 3, count)
    nu = 0.3 * ones
    film = {"n_E": 0.5 * ones, "n_H": 0.4 * ones, "tau": RNG.uniform(0, 4, count), "n_g": ones, "film_aspect": 0.5 * ones}
    film |= {"film_nu": nu, "film_K_beta": stiffness_group(nu)}
    film = film if model == "soft_coating_2015" else {}
    groups = Groups(theta=theta, lam=lam, nu=nu, hardness_to_yield=2.8 * ones, K_beta=stiffness_group(nu), **film)
    return problem_of(groups, Choice(model)).regimes


def by_both(force_loops, compute, tiers=("shared", "specialised")):
    found = []
    for tier in tiers:
        force_loops(tier)
        found.append(compute())
    return found


def assert_same(one, other, axis):
    """Within 1e-13 of the largest part: of loads that are differences of larger ones the parts decide."""
    size = np.maximum(np.abs(other).max(axis=axis, keepdims=True), 1e-200)
    assert np.isfinite(other).all() and other.any()
    assert np.max(np.abs(one - other) / size) < 1e-13


# Every distribution of heights with one regime, and every model with one distribution: a loop takes a second to compile.
ONE_REGIME = "greenwood_williamson_1966"
PAIRS = [(ONE_REGIME, heights) for heights in HEIGHTS] + [(model, "gaussian") for model in MODELS if model != ONE_REGIME]


@pytest.mark.parametrize(("model", "heights"), PAIRS)
def test_single_pairs_are_the_same(force_loops, model, heights):
    parts, h = regimes(model), RNG.uniform(-4.0, 5.0, 240)
    law = RNG.integers(0, 60, 240)
    shared, alone = by_both(force_loops, lambda: scattered(parts, h, HEIGHTS[heights], law))
    assert_same(shared, alone, (0, 1))


@pytest.mark.parametrize("model", MODELS)
def test_python_gives_what_compiled_loops_give(force_loops, model):
    parts, h = regimes(model, 3), RNG.uniform(-4.0, 5.0, 6)
    law = RNG.integers(0, 3, 6)
    plain, compiled = by_both(force_loops, lambda: scattered(parts, h, gaussian(), law), ("interpreted", "shared"))
    assert_same(plain, compiled, (0, 1))
    plain, compiled = by_both(
        force_loops, lambda: Approach(parts).starts(np.full((3, 2), [0.01, 0.1])).h, ("interpreted", "shared")
    )
    np.testing.assert_allclose(plain, compiled, rtol=1e-9, atol=1e-12)


ALONE = """
import sys
import stiction as st
st.solve(st.Indices(theta=40, lam=10), load=[0.5, 1.0])
print(sorted({"numba", "dask.array", "pint"} & sys.modules.keys()))
"""


def test_one_contact_needs_no_compiler():
    """Nor what takes long to import and is not used."""
    given = {name: value for name, value in os.environ.items() if name != VARIABLE}
    done = subprocess.run([sys.executable, "-c", ALONE], env=given, check=True, capture_output=True, text=True)
    assert done.stdout == "[]\n"


def test_much_work_ends_the_allowance_of_python():
    allowance = Allowance(100)
    assert allowance.take(60) and allowance.take(40) and not allowance.take(1) and not allowance.take(0)


@pytest.mark.parametrize("model", MODELS[:2])
def test_grids_are_the_same(force_loops, model):
    parts, h = regimes(model), np.linspace(-3.0, 5.0, 100)
    for summed in (on_grid, totals_on_grid):
        shared, alone = by_both(force_loops, lambda summed=summed: summed(parts, h, gaussian()))
        assert_same(shared, alone, tuple(range(alone.ndim - 2)))


@pytest.mark.parametrize("model", MODELS[:2])
def test_starts_are_the_same(force_loops, model):
    parts, targets = regimes(model), np.tile(np.geomspace(1e-4, 1.0, 5), (60, 1))
    shared, alone = by_both(force_loops, lambda: Approach(parts).starts(targets))
    for name in ("tension", "where", "h", "slope", "size"):
        one, other = getattr(shared, name), getattr(alone, name)
        assert np.array_equal(np.isnan(one), np.isnan(other))
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)


def test_much_work_is_worth_compiling(force_loops):
    force_loops(None)
    assert not specialised(512, 512 * 21)
    assert specialised(12_500) and specialised(1, 100_000)
    force_loops("shared")
    assert not specialised(10**9)
    force_loops("specialised")
    assert specialised(1)
    force_loops("fast")
    with refusal("STICTION_LOOPS", "fast", "auto", "interpreted", "shared", "specialised"):
        specialised(1)


def test_within_all_compiled_python_runs_nothing(force_loops):
    force_loops(None)
    assert interpreted(little=True)
    with all_compiled():
        assert not interpreted(little=True)
    assert interpreted(little=True)


@pytest.mark.parametrize("tier", ["auto", "interpreted", "shared", "specialised"])
def test_the_tier_is_shown(force_loops, monkeypatch, tmp_path, tier):
    force_loops(tier)
    monkeypatch.setenv("STICTION_CACHE_DIR", str(tmp_path))
    shown = st.show_config()
    assert shown["loops"] == tier and shown["cache"].startswith(str(tmp_path)) and shown["compiler"] in ("on", "off")
