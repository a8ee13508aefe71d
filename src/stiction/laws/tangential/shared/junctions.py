"""Compare the shear strengths of interface and bulk, and find where a segment reaches a given mean pressure.

A junction under the mean pressure p and the mean shear stress tau is fully plastic if p^2 + alpha tau^2 = H^2, with the
hardness H. Without pressure its bulk therefore shears at the stress H/sqrt(alpha).
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
from stiction.laws.segment import NormalSegment

# alpha is 3 (H/Y)^2 for a bulk that shears at Y/sqrt(3) (von Mises), or the 9 that is quoted from Tabor's experiments.
ALPHA: dict[str, Callable[[np.ndarray], np.ndarray]] = {"von_mises": lambda k: 3.0 * k * k, "9": lambda k: 9.0 + 0.0 * k}
_DEEPEST = 100.0  # displacement over sigma beyond which no asperity contributes
_ROUNDING = 1e-13  # a fully plastic segment may have the given pressure everywhere; rounding must not count as a crossing
_SAMPLES = 12  # few are enough, because pressures rise or fall slowly
_MOST = 2  # crossings on a segment: the pressure rises above the value, and may fall below it again with the limiting pressure


def interface_over_bulk(groups: Groups, alpha: str) -> np.ndarray:
    """Return c = sqrt(alpha) tau_0/H (n,), the ratio of the interface's shear strength to the bulk's.

    alpha: key of ALPHA, the factor in the yield criterion p^2 + alpha tau^2 = H^2 of a junction under the mean pressure p and
    the mean shear stress tau. H: hardness. tau_0: shear strength of the interface.
    """
    return np.sqrt(ALPHA[alpha](groups.hardness_to_yield)) * groups.shear_strength


@cache
def _above(normal: Callable, parameters: int) -> Any:
    @formula
    def above(u, row):
        _, _, load, area = normal(u, *row[:parameters])
        return load - row[parameters] * area

    return above


def where_pressure_is(segment: NormalSegment, pressure: np.ndarray) -> np.ndarray:
    """Return up to two coordinates of a segment, (n, 2), at which the mean pressure equals `pressure` (n,).

    pressure: ratio of load, in K R^(1/2) sigma^(3/2), to area, in pi R sigma; the hardness is eta in this unit. Displacements
    beyond 100 sigma are not searched. Unused entries are the first coordinate of the segment.
    """
    last = np.minimum(segment.edges[:, -1], coordinates(segment, _DEEPEST))
    edges = np.ascontiguousarray(np.minimum(segment.edges, last[:, None]))
    parameters = (*segment.parameters, pressure * (1.0 + _ROUNDING))
    out = np.empty((len(edges), _MOST))
    find = crossing(_above(segment.normal, len(segment.parameters)), len(parameters), _SAMPLES)
    find(columns(parameters, len(edges)), edges, out)
    return out
