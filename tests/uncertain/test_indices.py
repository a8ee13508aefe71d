"""Sobol indices and Morris effects of functions whose indices and effects are known in closed form."""

import numpy as np
import pytest
import scipy.stats

from stiction.studies.sensitivity import indices_of_variance
from stiction.studies.sensitivity.indices_of_variance import PARTS, effects, points_of_indices, sobol_indices, trajectories


def ishigami(u, a=7.0, b=0.1):
    x = np.pi * (2.0 * u - 1.0)
    return np.sin(x[..., 0]) + a * np.sin(x[..., 1]) ** 2 + b * x[..., 2] ** 4 * np.sin(x[..., 0])


def exact_ishigami(a=7.0, b=0.1):
    """Ishigami & Homma 1990: the variances in closed form."""
    first, second = 0.5 * (1.0 + b * np.pi**4 / 5.0) ** 2, a**2 / 8.0
    both = b**2 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    whole = first + second + both
    return np.array([first, second, 0.0]) / whole, np.array([first + both, second, both]) / whole


A = np.array([0.0, 0.5, 3.0, 9.0, 99.0])


def g_function(u):
    return np.prod((np.abs(4.0 * u - 2.0) + A) / (1.0 + A), axis=-1)


def exact_g():
    """Saltelli & Sobol 1995: V_i = 1/(3 (1 + a_i)^2), and the total is V_i times the product of the others' 1 + V_j."""
    each = 1.0 / (3.0 * (1.0 + A) ** 2)
    whole = np.prod(1.0 + each) - 1.0
    return each / whole, each / (1.0 + each) * np.prod(1.0 + each) / whole


@pytest.mark.parametrize(("function", "exact"), [(ishigami, exact_ishigami()), (g_function, exact_g())])
def test_indices_are_within_their_intervals(function, exact):
    """As often as they say: 95 % of all intervals, here of 40 seeds, and never far off."""
    first, total = exact
    held = []
    for seed in range(40):
        found = sobol_indices(function(points_of_indices(first.size, 1024, seed)))
        held += [(found["first_order_low"] <= first) & (first <= found["first_order_high"])]
        held += [(found["total_order_low"] <= total) & (total <= found["total_order_high"])]
        np.testing.assert_allclose(found["first_order"], first, atol=0.15)
        np.testing.assert_allclose(found["total_order"], total, atol=0.15)
    assert 0.92 <= np.mean(held) <= 0.995


def test_intervals_narrow_with_more_points():
    wide, narrow = (sobol_indices(ishigami(points_of_indices(3, count, 1))) for count in (256, 16384))
    assert np.all(
        narrow["total_order_high"] - narrow["total_order_low"] < 0.3 * (wide["total_order_high"] - wide["total_order_low"])
    )
    np.testing.assert_allclose(narrow["total_order"], exact_ishigami()[1], atol=0.003)


def test_what_does_not_matter_has_no_index_and_a_constant_none_at_all():
    points = points_of_indices(3, 256, 0)
    found = sobol_indices(points[..., 0] * 2.0 + 1.0)
    np.testing.assert_allclose(found["total_order"], [1.0, 0.0, 0.0], atol=0.02)
    assert not sobol_indices(np.full((8, 5, 32), 3.0))["total_order"].any()


def test_unknown_values_are_left_out_and_too_many_are_said():
    points = points_of_indices(3, 4096, 0)
    values = ishigami(points)
    values[:, 0, ::7] = np.nan
    found = sobol_indices(values)
    assert found["points"] == 2048
    np.testing.assert_allclose(found["total_order"], exact_ishigami()[1], atol=0.05)
    values[:, 0, ::2] = np.nan
    assert np.isnan(sobol_indices(values)["total_order"]).all()


def test_two_points_of_each_part_are_the_fewest_for_an_interval():
    weights = np.array([3.0, 1.0])
    two = points_of_indices(2, 2 * PARTS, 0) @ weights
    assert two.shape == (PARTS, 4, 2)
    found = sobol_indices(two)
    assert found["points"] == 2 * PARTS and np.isfinite([found["first_order_low"], found["total_order_high"]]).all()
    assert found["total_order"][0] > found["total_order"][1]
    two[0, 0, 0] = np.nan
    assert np.isnan(sobol_indices(two)["total_order"]).all() and sobol_indices(two)["points"] == 0


def test_trajectories_take_one_step_at_a_time():
    points = trajectories(6, 50, 3)
    steps = np.diff(points, axis=1)
    np.testing.assert_allclose(np.abs(steps).sum(axis=2), 2.0 / 3.0)
    assert np.all((np.abs(steps) > 0.0).sum(axis=1) == 1)  # every column once
    assert set(points.round(9).ravel()) == {0.0, 0.333333333, 0.666666667, 1.0}
    assert 0.3 < (steps > 0.0).any(axis=1).mean() < 0.7


def test_effects_of_a_line_are_its_slopes():
    slopes = np.array([3.0, -2.0, 0.0, 0.5])
    points = trajectories(4, 20, 0)
    found = effects(points, points @ slopes + 1.0)
    np.testing.assert_allclose(found["mean"], slopes, atol=1e-12)
    np.testing.assert_allclose(found["effect"], np.abs(slopes), atol=1e-12)
    np.testing.assert_allclose(found["effect_deviation"], 0.0, atol=1e-12)


def test_effects_of_a_square_are_those_of_its_four_levels():
    """(x + 2/3)^2 - x^2 over 2/3 is 2 x + 2/3: of x = 0 and 1/3, as likely, 2/3 and 4/3."""
    points = trajectories(1, 4000, 1)
    found = effects(points, points[..., 0] ** 2)
    assert found["effect"][0] == pytest.approx(1.0, abs=4.0 / 3.0 / np.sqrt(4000.0)) and found["mean"][0] == found["effect"][0]
    assert found["effect_deviation"][0] == pytest.approx(1.0 / 3.0, rel=1e-3)


def test_screening_finds_the_inputs_of_morris():
    """The function of Morris 1991, section 4: of 20 inputs the first ten matter; eight to ten have effects of one size, one to
    seven such that depend on where they are."""
    rng = np.random.default_rng(7)
    beta, pairs = rng.normal(size=20), np.triu(rng.normal(size=(20, 20)), 1)
    beta[:10], pairs[:6, :6] = 20.0, np.triu(np.full((6, 6), -15.0), 1)

    def function(u):
        w = 2.0 * (u - 0.5)
        for at in (2, 4, 6):
            w[..., at] = 2.0 * (1.1 * u[..., at] / (u[..., at] + 0.1) - 0.5)
        third = sum(w[..., i] * w[..., j] * w[..., k] for i in range(5) for j in range(i + 1, 5) for k in range(j + 1, 5))
        return w @ beta + np.einsum("...i,ij,...j", w, pairs, w) - 10.0 * third + 5.0 * np.prod(w[..., :4], axis=-1)

    points = trajectories(20, 40, 5)
    found = effects(points, function(points))
    assert set(np.argsort(found["effect"])[10:]) == set(range(10))
    assert found["effect_deviation"][7:10].max() < 0.5 * found["effect_deviation"][:7].min()
    np.testing.assert_allclose(found["effect"][7:10], 40.0, rtol=0.2)  # 2 beta


def test_effects_that_are_not_known_are_left_out():
    points = trajectories(2, 40, 0)
    values = points @ np.array([2.0, 1.0])
    values[:5, 1] = np.nan
    np.testing.assert_allclose(effects(points, values)["effect"], [2.0, 1.0])
    values[:, 1] = np.nan
    assert np.isnan(effects(points, values)["effect"]).all()


def test_one_input_alone_has_all_of_the_variance():
    u = points_of_indices(1, 1024, 0)
    found = sobol_indices(np.exp(u[..., 0]))
    assert found["first_order"].shape == found["total_order"].shape == (1,)
    np.testing.assert_allclose([found["first_order"][0], found["total_order"][0]], 1.0, atol=0.02)


def test_effects_of_few_are_not_told():
    """Of less than half of the trajectories nothing is said."""
    points = trajectories(2, 40, 0)
    values = points @ np.array([2.0, 1.0])
    values[:19, 1] = np.nan
    np.testing.assert_allclose(effects(points, values)["effect"], [2.0, 1.0])
    values[:21, 1] = np.nan
    found = effects(points, values)
    assert all(np.isnan(found[name]).all() for name in ("effect", "effect_error", "mean", "effect_deviation"))


def test_the_error_of_an_effect_is_the_scatter_of_its_mean():
    """Of a function whose effects are exp of the other number: by numpy, over the trajectories."""
    points = trajectories(2, 40, 3)
    values = points[..., 0] * np.exp(points[..., 1])
    found = effects(points, values)
    moved = np.abs(np.diff(points, axis=1)).argmax(axis=2)
    slopes = np.array(
        [np.diff(v)[m == 0][0] / np.diff(p[:, 0])[m == 0][0] for p, v, m in zip(points, values, moved, strict=True)]
    )
    assert found["effect"][0] == pytest.approx(slopes.mean(), rel=1e-12)
    assert found["effect_error"][0] == pytest.approx(slopes.std(ddof=1) / np.sqrt(40), rel=1e-12)


def test_intervals_are_those_of_as_many_parts_as_there_are():
    assert indices_of_variance._T == pytest.approx(scipy.stats.t.ppf(0.975, PARTS - 1), rel=1e-6)
