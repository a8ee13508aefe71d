"""Cohen, Kligerman & Etsion 2008: asperities in full stick (Brizmer, Kligerman & Etsion) under a Gaussian of heights.

The authors give empirical formulas of their sums, which are not known here; the sums themselves are made in their place.
"""

from stiction.laws.registry import RoughSurface, Validity
from stiction.laws.sources import Source

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
    verified="integrals over Gaussian heights by an independent quadrature",
    validity=(Validity("theta", 10.0, float("inf"), "adhesion is left out"),),
)
