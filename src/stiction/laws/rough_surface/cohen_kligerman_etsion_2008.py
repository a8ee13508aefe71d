r"""Asperities in full stick with Gaussian heights: Cohen, Kligerman & Etsion 2008.

*Assumes*: asperities of [`brizmer_kligerman_etsion_2006`](#brizmer_kligerman_etsion_2006) are independent and slide in full
stick, [`brizmer_kligerman_etsion_2007`](#brizmer_kligerman_etsion_2007). *Source*: [cohen_kligerman_etsion_2008]. The friction
coefficient at the mean separation $h$ (in units of $\sigma$) is

$$
\mu(h)=\frac{\int_0^\infty\mu(P)P(w)\,\varphi(h+w)\,dw}{\int_0^\infty P(w)\,\varphi(h+w)\,dw}
$$

with the load $P$ and the friction coefficient $\mu(P)$ of one asperity at the displacement $w$, and the density $\varphi$ of
heights. *Unknown*: the empirical formulas that the authors fitted to their sums; the sums themselves are computed here. *Not
included*: adhesion. *Check*: [the three models of static friction side by
side](#the-elastic-plastic-models-of-static-friction-side-by-side).
"""

from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="cohen_kligerman_etsion_2008",
    title="Contact and static friction of rough surfaces in full stick",
    grade="C",
    sources=(
        Source("cohen_kligerman_etsion_2008", "", "the integrals, not the empirical formulas fitted to them"),
        Source("greenwood_williamson_1966", "the sum over heights"),
    ),
    asperity="brizmer_kligerman_etsion_2006",
    tangential="brizmer_kligerman_etsion_2007",
    verified="sums over Gaussian heights, integrated independently",
)
