"""Weights of area laws against another way of finding them."""

import importlib
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import norm

from stiction.solving.accuracy.benchmark_set import benchmark_set
from stiction.solving.accuracy.errors_near import LEVELS
from stiction.studies.prediction.area_weights import FILE

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def stack():
    sys.path.insert(0, str(ROOT / "truth"))
    yield importlib.import_module("stack")
    sys.path.remove(str(ROOT / "truth"))


@pytest.fixture(scope="module")
def tables(stack):
    """What is known -> densities (n, k) of the laws of the package on the training areas, and the kind of surface of each."""
    found = {}
    for known in ("numbers", "kind"):
        laws, scores, kinds = stack.cases(benchmark_set(), known)
        names = [row["asperity"] or row["model"] for row in json.loads(FILE.read_text())[known]]
        found[known] = scores[:, [[law.split("|")[0] for law in laws].index(name) for name in names]], kinds
    return found


def searched(scores, counts):
    """The mean log density of the mixture, maximised over the simplex by SLSQP in place of expectation and maximisation."""
    number = scores.shape[1]
    chances = np.exp(scores - scores.max(axis=1, keepdims=True))
    found = minimize(
        lambda weights: -counts @ np.log(chances @ weights),
        np.full(number, 1.0 / number),
        jac=lambda weights: -(counts / (chances @ weights)) @ chances,
        method="SLSQP",
        bounds=[(0.0, 1.0)] * number,
        constraints={"type": "eq", "fun": lambda weights: weights.sum() - 1.0},
    )
    return found.x.tolist()


@pytest.mark.parametrize("known", ["numbers", "kind"])
def test_weights_are_those_of_a_direct_search(stack, tables, known):
    scores, kinds = tables[known]
    rows = json.loads(FILE.read_text())[known]
    assert [row["weight"] for row in rows] == pytest.approx(searched(scores, stack.alike(kinds)), abs=0.01)


@pytest.mark.parametrize("known", ["numbers", "kind"])
def test_weights_without_a_kind_of_surface(stack, tables, known):
    """Without it a direct search finds the same weights, and on the kind that was left out they score as well as equal ones."""
    scores, kinds = tables[known]
    for left_out in np.unique(kinds):
        rest = kinds != left_out
        counts = stack.alike(kinds[rest])
        weights = stack.stacked(scores[rest], counts)
        assert weights.tolist() == pytest.approx(searched(scores[rest], counts), abs=0.01)
        other = np.full(weights.shape, 1.0 / weights.size)
        mine, equal = (stack.score(scores[~rest], np.ones((~rest).sum()), one) for one in (weights, other))
        assert mine > equal - 0.05, left_out


def test_the_density_of_normal_quantiles_is_normal(stack):
    levels = 0.3 + 0.2 * norm.ppf(LEVELS)
    for value in (-0.4, 0.1, 0.3, 0.55, 1.0):
        expected = norm.logpdf(value, 0.3, np.hypot(0.2, 0.015))
        assert stack.log_density(value, levels) == pytest.approx(expected, abs=1e-3)
