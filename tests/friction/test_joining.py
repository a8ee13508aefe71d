"""An asperity law and a tangential law joined: what of a response counts, and where its segments are cut."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from stiction.engine.compiled import formula
from stiction.laws.asperity import hertz
from stiction.laws.joining import Law, Weights, with_kinks, within
from stiction.laws.segment import TangentialResistance
from stiction.records.registry import TangentialLaw
from tables import groups

W, U = 1.69, 1.3  # w = u^2: load u^3 and area u^2 of Hertz


@formula
def both(u, w, load, area, share):
    """Not a law: its two forces are told apart, and each from load and area."""
    return share * load, 7.0 * area


def law(interfacial):
    return TangentialLaw(
        key="both", title="", grade="B", sources=(), verified="", interfacial=interfacial,
        tangential_resistance=lambda segment, groups: TangentialResistance(both, (np.array([0.3]),)),
    )  # fmt: skip


def joined(tangential, weights):
    asperity = Law(hertz.RECORD, tangential)
    (regime,) = asperity.regimes(groups(theta=10.0, lam=1.0), weights)
    row = [float(np.ravel(one)[0]) for one in regime.parameters]
    return regime, regime.along(U, *row), row


WEIGHTS = Weights(shift=0.7, unit=3.0, load=0.25, area=0.5, friction=2.0)


def test_what_of_a_response_counts():
    """Of a body: its forces by their weights, in the unit of the whole contact; the law sees all of the load and area."""
    regime, found, row = joined(law(False), WEIGHTS)
    expected = (0.7 + W, 2.0 * U, 3.0 * 0.25 * U**3, 0.5 * W, 3.0 * 2.0 * 0.3 * U**3, 3.0 * 2.0 * 7.0 * W)
    assert_allclose(found, expected, rtol=1e-14)
    assert regime.coordinate(0.7 + W, *row) == pytest.approx(U, rel=1e-14) and regime.lowest == 0.7


def test_the_interface_sees_only_what_counts():
    _, found, _ = joined(law(True), WEIGHTS)
    expected = (0.7 + W, 2.0 * U, 3.0 * 0.25 * U**3, 0.5 * W, 3.0 * 0.3 * 0.25 * U**3, 3.0 * 7.0 * 0.5 * W)
    assert_allclose(found, expected, rtol=1e-14)


def test_by_default_all_of_it_counts_and_nothing_resists_without_a_law():
    assert_allclose(joined(law(False), Weights())[1], (W, 2.0 * U, U**3, W, 0.3 * U**3, 7.0 * W), rtol=1e-14)
    assert_allclose(joined(None, Weights(load=0.0))[1], (W, 2.0 * U, 0.0, W, 0.0, 0.0), rtol=1e-14)


@pytest.mark.parametrize(
    ("kinks", "expected"),
    [
        ([[]], [1.0, 2.0, 4.0]),
        ([[3.0]], [1.0, 2.0, 3.0, 4.0]),
        ([[3.0, 1.5]], [1.0, 1.5, 2.0, 3.0, 4.0]),
        ([[-7.0, 9.0]], [1.0, 1.0, 2.0, 4.0, 4.0]),
        ([[1.0 + 4e-16, 4.0 - 9e-16]], [1.0, 1.0, 2.0, 4.0, 4.0]),
    ],
)
def test_kinks_stand_in_order_between_the_ends(kinks, expected):
    edges = np.array([[1.0, 2.0, 4.0]])
    assert_array_equal(with_kinks(edges, np.array(kinks)), [expected])
    assert with_kinks(edges, None) is edges


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(1.5, 3.0, [1.5, 2.0, 3.0]), (-1.0, 9.0, [1.0, 2.0, 4.0]), (2.5, 3.0, [2.5, 2.5, 3.0]), (3.0, np.inf, [3.0, 3.0, 4.0])],
)
def test_a_part_of_a_segment(low, high, expected):
    """Of each of two laws its own part."""
    (whole,) = hertz.RECORD.segments(groups(theta=[10.0, 10.0], lam=1.0))
    whole = replace(whole, edges=np.array([[1.0, 2.0, 4.0], [5.0, 6.0, 7.0]]))
    found = within(whole, np.array([low, 5.5]), np.array([high, 6.5])).edges
    assert_array_equal(found, [expected, [5.5, 6.0, 6.5]])
    assert (np.diff(within(whole, 3.0, 2.5).edges[0]) <= 0.0).all()
