r"""Elastic-plastic asperities (1987) that resist sliding only while they are elastic (1988): Chang, Etsion & Bogy.

*Assumes*: asperities of [`chang_etsion_bogy_1987`](#chang_etsion_bogy_1987) are independent and fail at [first
yield](#chang_etsion_bogy_1988-tangential-law). *Source*: [chang_etsion_bogy_1988]. The friction coefficient at the mean
separation $h$ (in units of $\sigma$) is

$$
\mu(h)=\frac{\int_0^{w_c}T(w)\,\varphi(h+w)\,dw}{\int_0^\infty P(w)\,\varphi(h+w)\,dw}
$$

with the load $P$ and the tangential force $T$ of one asperity at the displacement $w$, its displacement $w_c$ at first yield
and the density $\varphi$ of heights. *Not included*: the adhesion of the 1988 papers. *Check*: [the three models of static
friction side by
side](#the-elastic-plastic-models-of-static-friction-side-by-side).
"""

from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="chang_etsion_bogy_1988",
    title="Elastic-plastic contact (1987) and static friction (1988) of rough surfaces, without adhesion",
    grade="B",
    sources=(
        Source("chang_etsion_bogy_1988", "", "stress criteria as restated by Eriten, Polycarpou & Bergman 2010"),
        Source("greenwood_williamson_1966", "the sum over heights"),
    ),
    asperity="chang_etsion_bogy_1987",
    tangential="chang_etsion_bogy_1988",
    verified="sums over heights, computed independently at 30 digits; friction of single asperities tabulated independently",
    limits=(elastic_limit("greenwood_williamson_1966"),),
    notes="The adhesion of the 1988 papers is not included.",
)
