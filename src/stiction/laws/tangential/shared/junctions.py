"""Junctions whose interface has a share of the strength of what they join: that share, and where pressures are reached.

A junction under the mean pressure p and the mean shear stress tau is fully plastic where p^2 + alpha tau^2 = H^2, so that its
bulk shears without any pressure at H/sqrt(alpha).
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.crossings import crossing
from stiction.engine.regime import columns
from stiction.laws.joining import coordinates
from stiction.laws.piece import NormalPiece

# alpha: of a bulk that shears at Y/sqrt(3) (von Mises), 3 (H/Y)^2; or the 9 that is quoted from Tabor's experiments.
ALPHA: dict[str, Callable[[np.ndarray], np.ndarray]] = {"von_mises": lambda k: 3.0 * k * k, "9": lambda k: 9.0 + 0.0 * k}
_DEEPEST = 100.0  # over sigma: no asperity that counts is pressed so far
_ROUNDING = 1e-13  # a plastic piece is at its pressure everywhere, to rounding: that is no crossing
_SAMPLES = 12  # pressures rise, and fall slowly if they do
_MOST = 2  # on a piece: where the pressure rises above, and where a hardness that falls brings it back


def share_of_bulk(groups: Groups, alpha: str) -> np.ndarray:
    """c = sqrt(alpha) tau_0/H (n,): the strength of the interface over the shear strength of the bulk."""
    return np.sqrt(ALPHA[alpha](groups.hardness_to_yield)) * groups.shear_strength


@cache
def _above(normal: Callable, parameters: int) -> Any:
    @formula
    def above(u, row):
        _, _, load, area = normal(u, *row[:parameters])
        return load - row[parameters] * area

    return above


def where_pressure_is(piece: NormalPiece, pressure: np.ndarray) -> np.ndarray:
    """Coordinates (n, 2) at which the load of a piece is this pressure (n,) times its area; the first of the piece for none."""
    last = np.minimum(piece.edges[:, -1], coordinates(piece, _DEEPEST))
    edges = np.ascontiguousarray(np.minimum(piece.edges, last[:, None]))
    parameters = (*piece.parameters, pressure * (1.0 + _ROUNDING))
    out = np.empty((len(edges), _MOST))
    find = crossing(_above(piece.normal, len(piece.parameters)), len(parameters), _SAMPLES)
    find(columns(parameters, len(edges)), edges, out)
    return out
