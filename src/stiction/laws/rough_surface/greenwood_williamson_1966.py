"""Greenwood & Williamson 1966: elastic asperities of one radius, heights distributed, no adhesion."""

from stiction.laws.registry import RoughSurface
from stiction.laws.sources import Source

RECORD = RoughSurface(
    key="greenwood_williamson_1966",
    title="Elastic contact of nominally flat surfaces",
    grade="B",
    sources=(Source("greenwood_williamson_1966", "load, area and number of contacts"),),
    asperity="hertz",
    verified="integrals F_n(h) at 30 digits; closed forms for exponential heights",
)
