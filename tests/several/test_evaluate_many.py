"""The batch evaluator of all studies: contacts together are as alone, and a refused one is told apart from its neighbours."""

import numpy as np
from xarray import DataArray

import stiction as st
from refusals import refusal
from stiction.case.read import case_of
from stiction.solving.choice import Choice
from stiction.solving.pointwise import bisected
from stiction.studies import evaluate_many as module
from stiction.studies.evaluate_many import evaluate_many, evaluate_together

CASE = case_of({"indices": {"theta": 40, "lam": 10}, "solve": {"load": [0.01, 0.1]}})
THETA, LAM, MODEL = ("indices", "theta"), ("indices", "lam"), Choice()
KEEP = ["friction_coefficient"]


def test_a_refused_contact_is_parted_from_all_others():
    theta = np.array([20.0, 30.0, -1.0, 50.0, 60.0])  # above 0 is allowed
    found = list(evaluate_many(CASE, {THETA: DataArray(theta, dims="n")}, None, MODEL, KEEP, along=("n",)))
    refused = [region["n"] for region, _, results in found if results is None]
    assert refused == [slice(2, 3)]
    mu = np.full((5, 2), np.nan)
    for region, case, results in found:
        if results is not None:
            mu[region["n"]] = results.variables["friction_coefficient"][1]
            np.testing.assert_array_equal(case.subject.theta, theta[region["n"]])
    for row in (0, 1, 3, 4):
        alone = st.solve(st.Indices(theta=theta[row], lam=10.0), load=[0.01, 0.1], model=MODEL.model)
        np.testing.assert_allclose(mu[row], alone["friction_coefficient"], rtol=1e-12)
    assert np.isnan(mu[2]).all()


def test_only_the_dimensions_that_are_named_are_cut():
    """A value that is refused takes with it what it stands together with along other dimensions."""
    numbers = {THETA: DataArray([20.0, 30.0], dims="n"), LAM: DataArray([1.0, -1.0, 2.0], dims="m")}
    assert [x for x in evaluate_many(CASE, numbers, None, MODEL, KEEP, along=("n",)) if x[2] is not None] == []
    found = list(evaluate_many(CASE, numbers, None, MODEL, KEEP, along=("m", "n")))
    refused = [(region["m"], region["n"]) for region, _, results in found if results is None]
    assert refused == [(slice(1, 2), slice(0, 1)), (slice(1, 2), slice(1, 2))]


def test_points_are_cut_with_the_numbers():
    numbers, load = {THETA: DataArray([20.0, -1.0, 30.0], dims="n")}, np.array([0.01, 0.1, 0.2])
    for region, _, results in evaluate_many(CASE, numbers, {"load": DataArray(load, dims="n")}, MODEL, along=("n",)):
        if results is not None:
            np.testing.assert_allclose(results.variables["load"][1], load[region["n"]], rtol=1e-12)


def test_nothing_to_cut_is_one_contact():
    ((region, _, results),) = evaluate_many(CASE, {THETA: 20.0}, {"separation": 1.0}, MODEL, KEEP, along=("n",))
    assert region == {} and np.isfinite(results.variables["friction_coefficient"][1])
    assert [*evaluate_many(CASE, {THETA: -1.0}, None, MODEL, KEEP, along=("n",))] == [({}, None, None)]
    with refusal("indices.theta"):
        evaluate_together(CASE, {THETA: -1.0}, None, MODEL)


def test_each_refusal_costs_two_attempts_at_each_halving(monkeypatch):
    asked = []
    solve = module.solve_batch
    monkeypatch.setattr(module, "solve_batch", lambda subject, *a, **b: (asked.append(1), solve(subject, *a, **b))[1])
    theta = np.full(64, 20.0)
    theta[17] = -1.0
    numbers = {THETA: DataArray(theta, dims="n")}
    parts = [region for region, _, _ in evaluate_many(CASE, numbers, None, MODEL, KEEP, along=("n",))]
    assert len(parts) == 7 and len(asked) == 6  # halves, quarters, ...: each has one part that is taken whole


def test_a_region_is_bisected_along_its_longest_dimension():
    def refused(region):
        if region["x"].start <= 2 < region["x"].stop and region["y"].start <= 0 < region["y"].stop:
            raise ArithmeticError
        return (region["x"].stop - region["x"].start) * (region["y"].stop - region["y"].start)

    found = list(bisected({"x": slice(0, 4), "y": slice(0, 2)}, refused))
    assert [size for _, size in found if not isinstance(size, Exception)] == [4, 1, 2]
    ((where, why),) = [(region, size) for region, size in found if isinstance(size, Exception)]
    assert where == {"x": slice(2, 3), "y": slice(0, 1)} and isinstance(why, ArithmeticError)
