"""Film penetrated by roughness: Dayson 1971, of which the abstract is known."""

from stiction.laws.registry import Unavailable
from stiction.laws.sources import Source

RECORD = Unavailable(
    key="dayson_1971",
    title="Friction of very thin solid films that roughness penetrates",
    grade="C",
    sources=(Source("dayson_1971", "abstract"),),
    unknown="how much of the contact penetrates a film of given thickness on a surface of given roughness, and the shear "
    "strengths of both parts. The abstract says that friction rises as films get thinner because roughness penetrates them "
    "more; the 2015 paper adds that the contact is plastic.",
    nearest="chang_1997 has the geometry, a plastic film that asperities higher than its thickness cut through; with a "
    "tangential law that resists on the substrate only, friction rises as the film thins. It lacks two shear strengths.",
)
