"""An asperity pressed into what is plastic at one pressure: area 2 pi R omega, all of it at that pressure."""

import numpy as np

from stiction.engine.compiled import formula
from stiction.laws.piece import NormalPiece, displaced, edges_at


@formula
def normal(w, pressure):
    """Return A = 2 w, P = p A; pressure: over the hardness of the substrate, times eta."""
    return w, 1.0, 2.0 * pressure * w, 2.0 * w


def at_pressure(pressure: np.ndarray, low: np.ndarray | float, high: np.ndarray | float) -> NormalPiece:
    """Return a piece at this pressure (n,) between the displacements low and high (n,)."""
    return NormalPiece(normal, displaced, (pressure,), edges_at(low, high), "plastic")
