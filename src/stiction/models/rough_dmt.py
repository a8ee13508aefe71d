"""DMT asperities under Greenwood & Williamson's sum: weak adhesion of hard, sharp, not too adhesive asperities."""

import numpy as np

from ..asperity import dmt
from ..asperity.regime import Regime
from ..groups import Groups
from ..registry import Limit, Record, Validity
from ..sources import Source


def regimes(groups: Groups) -> list[Regime]:
    """P = Int (w^(3/2) - 2 pi/theta) phi(h + w) dw, A = Int w phi(h + w) dw over w > 0."""
    edges = np.tile([0.0, np.inf], (len(groups), 1))
    return [Regime(dmt.along, dmt.coordinate, (groups.theta,), edges, "elastic")]


RECORD = Record(
    key="rough_dmt",
    kind="rough surface",
    title="DMT asperities on a rough surface",
    grade="B",
    sources=(
        Source("derjaguin_muller_toporov_1975", "", "load less 2 pi gamma R, in the form of Maugis 1992"),
        Source("greenwood_williamson_1966", "the sum over heights"),
    ),
    regimes=regimes,
    verified="independent integrals at 30 digits; Greenwood-Williamson without adhesion",
    needs=("theta",),
    validity=(
        Validity("tabor_parameter", 0.0, 0.1, "adhesion acts around the contact only for stiff, small asperities"),
        Validity("plasticity_index", 0.0, 0.6, "asperities are taken as elastic"),
    ),
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-9),),
    friction=False,
)
