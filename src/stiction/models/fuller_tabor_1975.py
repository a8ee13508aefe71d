"""Fuller & Tabor 1975: JKR asperities under Greenwood & Williamson's sum; elastic throughout."""

import math

import numpy as np

from ..asperity import jkr
from ..asperity.regime import Regime
from ..compiled import formula
from ..groups import Groups
from ..registry import Limit, Record, Validity
from ..sources import Source

_adhesion, _displacement, _stretch, _load, _area = jkr.adhesion, jkr.displacement, jkr.stretch, jkr.load, jkr.area
_coordinate = jkr.coordinate


@formula
def along(u, theta):
    S = _adhesion(theta)
    return _displacement(u, S), _stretch(u, S), _load(u, S), _area(u), 0.0, 0.0


@formula
def coordinate(w, theta):
    return _coordinate(w, _adhesion(theta))


def regimes(groups: Groups, branch: str) -> list[Regime]:
    """Loading: asperities touch from w = 0 on (4 u^3 = 4 s). Unloading: they hold until dw/du = 0 (4 u^3 = s)."""
    s = 2.0 / 3.0 * np.sqrt(6.0 * math.pi / groups.theta)
    first = np.cbrt(s if branch == "loading" else s / 4.0)
    edges = np.stack([first, np.full(len(groups), np.inf)], axis=1)
    lowest = float(np.min(first * (first**3 - s)))
    return [Regime(along, coordinate, (groups.theta,), edges, "elastic", lowest=lowest)]


RECORD = Record(
    key="fuller_tabor_1975",
    kind="rough surface",
    title="Adhesion of elastic solids with rough surfaces",
    grade="B",
    sources=(
        Source("fuller_tabor_1975", "", "pull-off on the unloading branch"),
        Source("johnson_kendall_roberts_1971", "load and displacement of one contact"),
    ),
    regimes=regimes,
    verified="pull-off curve and integrals at 30 digits; Greenwood-Williamson without adhesion",
    needs=("theta",),
    validity=(
        Validity("tabor_parameter", 5.0, math.inf, "adhesion acts inside the contact only for soft, large asperities"),
        Validity("plasticity_index", 0.0, 0.6, "asperities are taken as elastic"),
    ),
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-4),),
    own_options={"branch": ("loading", "unloading")},
    friction=False,
    load_falls=False,
)
