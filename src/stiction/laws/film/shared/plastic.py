"""Describe an asperity pressed into a plastic body: the pressure is constant on the area 2 pi R omega."""

import numpy as np

from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, displaced, edges_at


@formula
def normal(w, pressure):
    """Return displacement w, dw/du = 1, load p A and area A = 2 w of a plastic asperity; the coordinate u is w itself.

    pressure: p over the hardness of the substrate, times eta.
    """
    return w, 1.0, 2.0 * pressure * w, 2.0 * w


def at_pressure(pressure: np.ndarray, low: np.ndarray | float, high: np.ndarray | float) -> NormalSegment:
    """Return a plastic segment with this pressure (n,) between the displacements low and high (n,)."""
    return NormalSegment(normal, displaced, (pressure,), edges_at(low, high), "plastic")
