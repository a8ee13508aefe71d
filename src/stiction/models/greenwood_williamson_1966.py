"""Greenwood & Williamson 1966: elastic asperities of one radius, heights distributed, no adhesion."""

import numpy as np

from ..asperity import hertz
from ..asperity.regime import Regime
from ..groups import Groups
from ..registry import Record
from ..sources import Source


def regimes(groups: Groups) -> list[Regime]:
    """P = Int w^(3/2) phi(h + w) dw, A = Int w phi(h + w) dw over w > 0."""
    edges = np.tile([0.0, np.inf], (len(groups), 1))
    return [Regime(hertz.along, hertz.coordinate, (), edges, "elastic")]


RECORD = Record(
    key="greenwood_williamson_1966",
    kind="rough surface",
    title="Elastic contact of nominally flat surfaces",
    grade="A",
    sources=(Source("greenwood_williamson_1966", "load, area and number of contacts"), ),
    regimes=regimes,
    verified="integrals F_n(h) at 30 digits; closed forms for exponential heights",
    friction=False,
)
