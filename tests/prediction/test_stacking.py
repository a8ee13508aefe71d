"""Weights of area laws against another way of finding them, and intervals against maps that are in no set of the package."""

import csv
import importlib
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import norm

from stiction.solving.accuracy.errors_near import LEVELS
from stiction.solving.accuracy.solved_set import solved_set
from stiction.studies.prediction.area_weights import FILE

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def stack():
    sys.path.insert(0, str(ROOT / "truth"))
    yield importlib.import_module("stack")
    sys.path.remove(str(ROOT / "truth"))


@pytest.mark.parametrize("known", ["numbers", "kind"])
def test_weights_are_those_of_a_direct_search(stack, known):
    """The mean log density of the mixture, maximised over the simplex by SLSQP in place of expectation and maximisation."""
    laws, scores, counts = stack.cases(solved_set(), known)
    rows = json.loads(FILE.read_text())[known]
    names = [row["asperity"] or row["model"] for row in rows]
    chances = np.exp(scores[:, [[law.split("|")[0] for law in laws].index(name) for name in names]])
    counts = counts / counts.sum()
    found = minimize(
        lambda weights: -counts @ np.log(chances @ weights),
        np.full(len(names), 1.0 / len(names)),
        method="SLSQP",
        bounds=[(0.0, 1.0)] * len(names),
        constraints={"type": "eq", "fun": lambda weights: weights.sum() - 1.0},
    )
    assert [row["weight"] for row in rows] == pytest.approx(found.x.tolist(), abs=0.01)


def test_the_density_of_normal_quantiles_is_normal(stack):
    levels = 0.3 + 0.2 * norm.ppf(LEVELS)
    for value in (-0.4, 0.1, 0.3, 0.55, 1.0):
        expected = norm.logpdf(value, 0.3, np.hypot(0.2, 0.015))
        assert stack.log_density(value, levels) == pytest.approx(expected, abs=1e-3)


@pytest.mark.parametrize("known", ["map", "numbers", "kind"])
def test_intervals_hold_solved_areas_as_often_as_they_say(known):
    """90 % of maps with other seeds and spectra than those of the set, of five kinds, elastic, plastic and on films."""
    with (ROOT / "validation" / "maps" / "scored.csv").open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["known"] == known]
    held = [float(row["q5"]) <= 1.005 * float(row["area"]) and 0.995 * float(row["area"]) <= float(row["q95"]) for row in rows]
    assert len(rows) > 500 and 0.85 <= np.mean(held) <= 0.95
