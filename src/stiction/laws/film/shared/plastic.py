"""Describe an asperity pressed into a plastic body, with constant pressure on the area 2 pi R omega.

R is the tip radius and omega the displacement.
"""

import numpy as np

from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, displaced, edges_at


@formula
def normal(w, pressure):
    """Return displacement w, dw/du = 1, load p A and contact area A = 2 w of a plastic asperity; the coordinate u is w.

    pressure: p, the mean pressure divided by the hardness of the substrate, times the hardness group eta. Units: w in
    sigma, load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    return w, 1.0, 2.0 * pressure * w, 2.0 * w


def at_pressure(pressure: np.ndarray, low: np.ndarray | float, high: np.ndarray | float) -> NormalSegment:
    """Return the segment of a plastic asperity with a constant mean pressure, between the displacements low and high.

    pressure (n,): mean pressure divided by the hardness of the substrate, times the hardness group eta. low, high: in units
    of sigma, numbers or arrays (n,).
    """
    return NormalSegment(normal, displaced, (pressure,), edges_at(low, high), "plastic")
