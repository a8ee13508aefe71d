r"""Elastic-plastic asperities (2002) that begin to slide when they yield (2003), summed over heights: Kogut & Etsion 2004.

*Assumes*: asperities of [`kogut_etsion_2002`](#kogut_etsion_2002) are independent, and begin to slide when yield reaches their
surface ([`kogut_etsion_2003`](#kogut_etsion_2003)). *Source*: [kogut_etsion_2004]. The friction coefficient at the mean
separation $h$ (in units of $\sigma$) is

$$
\mu(h)=\frac{\int_0^{6w_c}\mu(w)P(w)\,\varphi(h+w)\,dw}{\int_0^\infty P(w)\,\varphi(h+w)\,dw}
$$

with the load $P$ and the friction coefficient $\mu(w)$ of one asperity at the displacement $w$, its displacement $w_c$ at
first yield and the density $\varphi$ of heights. *Reconstructed*: the fits of [`kogut_etsion_2003`](#kogut_etsion_2003). The
sums themselves are computed, not the authors' empirical formulas for them.
*Not included*: adhesion. *Check*: [the three models of static friction side by
side](#the-elastic-plastic-models-of-static-friction-side-by-side).
"""

from stiction.laws.shared_claims import elastic_limit
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="kogut_etsion_2004",
    title="Static friction of rough surfaces: elastic-plastic asperities that slide when they fail by yield",
    grade="C",
    sources=(
        Source("kogut_etsion_2004", "", "integrals of the laws of 2002 and 2003, not the empirical formulas fitted to them"),
        Source("greenwood_williamson_1966", "the sum over heights"),
    ),
    asperity="kogut_etsion_2002",
    tangential="kogut_etsion_2003",
    verified="sums over Gaussian heights, integrated independently; comparison with two other models in a table",
    limits=(elastic_limit("greenwood_williamson_1966"),),
    notes="The adhesion of elastic-plastic asperities (2003) is not included, because its coefficients could not be checked.",
)
