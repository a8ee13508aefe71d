"""Greenwood & Williamson 1966: elastic asperities of one radius, heights distributed, no adhesion."""

import math

import numpy as np

from ..asperity import hertz
from ..asperity.regime import Regime
from ..groups import Groups
from ..registry import Record, Validity
from ..sources import Source


def regimes(groups: Groups) -> list[Regime]:
    """P = Int w^(3/2) phi(h + w) dw, A = Int w phi(h + w) dw over w > 0."""
    edges = np.tile([0.0, np.inf], (len(groups), 1))
    return [Regime(hertz.along, hertz.coordinate, (), edges, "elastic")]


RECORD = Record(
    key="greenwood_williamson_1966",
    kind="rough surface",
    title="Elastic contact of nominally flat surfaces",
    grade="B",
    sources=(Source("greenwood_williamson_1966", "load, area and number of contacts"), ),
    regimes=regimes,
    validity=(
        Validity("plasticity_index", 0.0, 0.6, "above, asperities turn plastic at ordinary loads (section 5 of the source)"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    verified="integrals F_n(h) at 30 digits; closed forms for exponential heights",
    friction=False,
)
