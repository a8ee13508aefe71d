r"""DMT asperities in Greenwood & Williamson's sum, for weak adhesion of hard, sharp asperities.

*Assumes*: [`dmt`](#dmt) asperities of one radius are independent. *Source*: the sum of [greenwood_williamson_1966] over these
asperities. Load and area per asperity at the mean separation $h$ (in units of $\sigma$), with the integrals $F_n$ of
[`greenwood_williamson_1966`](#greenwood_williamson_1966) and the adhesion index $\theta$, are

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
    verified="sums over heights, computed independently at 30 digits; Greenwood & Williamson without adhesion",
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-9),),
)
