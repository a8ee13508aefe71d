"""Chang, Etsion & Bogy: contact of elastic-plastic asperities (1987) and the static friction of those still elastic (1988)."""

from stiction.laws.registry import Limit, RoughSurface, Validity
from stiction.laws.sources import Source

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
    verified="independent integrals at 30 digits; friction of single asperities tabulated independently",
    validity=(Validity("plasticity_index", 0.0, 0.6, "plastic asperities are given no friction: mu falls to nothing above"),),
    limits=(Limit("greenwood_williamson_1966", {"theta": 1.0, "lam": 1e24}, ("load", "contact_area"), 1e-9),),
    notes="Adhesion of the 1988 papers is left out.",
)
