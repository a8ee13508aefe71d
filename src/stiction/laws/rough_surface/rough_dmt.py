r"""DMT asperities in Greenwood & Williamson's sum, for weak adhesion of hard, sharp asperities.

*Assumes*: [`dmt`](#dmt) asperities of one radius are independent. *Source*: the sum of [greenwood_williamson_1966] over these
asperities, with the same $F_n$,

$$
\bar P=F_{3/2}(h)-\frac{2\pi}\theta F_0(h),\qquad\bar A=F_1(h)
$$
"""

from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="rough_dmt",
    title="DMT asperities on a rough surface",
    grade="B",
    sources=(Source("greenwood_williamson_1966", "the sum over heights"),),
    asperity="dmt",
    verified="independent integrals at 30 digits; Greenwood-Williamson without adhesion",
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-9),),
)
