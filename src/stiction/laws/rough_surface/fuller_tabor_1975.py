"""Fuller & Tabor 1975: JKR asperities under Greenwood & Williamson's sum; elastic throughout."""

from stiction.laws.registry import Limit, RoughSurface
from stiction.laws.sources import Source

RECORD = RoughSurface(
    key="fuller_tabor_1975",
    title="Adhesion of elastic solids with rough surfaces",
    grade="B",
    sources=(Source("fuller_tabor_1975", "", "pull-off on the unloading branch"),),
    asperity="jkr",
    verified="pull-off curve and integrals at 30 digits; Greenwood-Williamson without adhesion",
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-4),),
)
