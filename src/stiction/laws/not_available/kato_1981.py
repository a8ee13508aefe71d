"""Plastic film between a rigid ball and a rigid substrate: Kato, Yamaguchi, Marui & Tachi 1981, 1982; abstracts known."""

from stiction.laws.registry import Unavailable
from stiction.laws.sources import Source

RECORD = Unavailable(
    key="kato_1981",
    title="Soft metal film that flows between a hard protuberance and a hard surface",
    grade="C",
    sources=(
        Source("kato_1981", "abstract", "experiments on one protuberance, and an empirical expression"),
        Source("kato_1982", "abstract", "analysis: plastic flow of the film out of the gap"),
    ),
    unknown="the empirical expression of part 1; of part 2 the pressure at the edge and the shear stress on both faces, which "
    "with the flow of the film to the side decide the pressure. The abstracts say that the pressure becomes extremely high and "
    "that the load dependence of friction comes from it. A rigid substrate can besides not be met by heights without bound: "
    "asperities higher than the film is thick would carry any load.",
    nearest="chang_1997: up to omega = t it is a plastic film at its own hardness on a substrate that is not felt, without the "
    "pressure of the flow to the side.",
)
