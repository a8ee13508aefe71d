"""Loads so small beside the pull-off force that they are lost in its rounding: what is carried is said."""

import numpy as np
import pytest

import stiction as st
from stiction.laws.validity import warnings_of
from stiction.solving.problem import lost_in_rounding, with_requested_load

STICKY = st.Indices(theta=1.0, lam=10.0)  # pull-off force of 3.8 in its unit


def lost(data):
    return [str(one) for one in warnings_of(data) if "round-off" in str(one)]


def test_the_load_is_the_one_that_is_carried():
    asked, carried = np.array([1.0, 1e-12, 0.0]), np.array([1.0 + 1e-9, 1.5e-12, 3e-17])
    results = with_requested_load({"load": carried, "friction_force": np.full(3, 2.0)}, asked)
    np.testing.assert_array_equal(lost_in_rounding(carried, asked), [False, True, False])
    np.testing.assert_array_equal(results["load"], [1.0, 1.5e-12, 0.0])
    np.testing.assert_array_equal(results["friction_coefficient"], [2.0, 2.0 / 1.5e-12, np.nan])


def test_a_load_lost_in_rounding_is_said():
    data = st.solve(STICKY, load=1e-18)
    assert len(lost(data)) == 1 and "below round-off here" in data.attrs["outside_validity"]
    at_it = st.solve(STICKY, separation=data["mean_separation"].item())
    assert data["load"].item() == pytest.approx(at_it["load"].item(), abs=1e-15) and data["load"].item() != 1e-18
    ratio = data["friction_force"].item() / data["load"].item() if data["load"].item() > 0.0 else np.nan
    np.testing.assert_allclose(data["friction_coefficient"].item(), ratio, rtol=1e-12)


def test_along_a_curve_the_loads_carried_stand_beside_those_asked_for():
    data = st.solve(STICKY, load=[1e-18, 1.0])
    assert "in 1 of 2 points" in lost(data)[0]
    assert abs(data["load_carried"].values[0] / 1e-18 - 1.0) > 1e-6
    assert data["load_carried"].values[1] == pytest.approx(1.0, rel=1e-12)
    assert data["load_carried"].attrs["units"] == data["load"].attrs["units"]


@pytest.mark.parametrize("load", [0.0, 1e-6, 1.0])
def test_other_loads_are_carried_as_asked(load):
    data = st.solve(STICKY, load=load)
    assert data["load"].item() == load and lost(data) == [] and "load_carried" not in data
