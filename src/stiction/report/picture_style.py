"""Words, units and looks that the pictures of surfaces have in common."""

import math
from typing import Any

from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY

__all__ = ["look_of", "plain", "scale", "unit_for"]

_COLOURS = (BLUE, RED, GREEN, ORANGE, SKY, "black")
_MARKERS = ("o", "s", "^", "D", "v", "P")
_METHODS = {
    "three_point": "three-point peaks",
    "eight_neighbour": "eight-neighbour summits",
    "persistence": "persistent summits",
    "n_point": "n-point asperities",
    "mccool": "moments (McCool)",
}


def look_of(method: str, at: int) -> dict[str, Any]:
    """Colour and mark of a method, the same in all pictures; of anything else, of its place among the lines."""
    at = list(_METHODS).index(method) if method in _METHODS else at
    return {"color": _COLOURS[at % len(_COLOURS)], "marker": _MARKERS[at % len(_MARKERS)], "markersize": 5}


def plain(method: str) -> str:
    return _METHODS.get(method, method.replace("_", " "))


def unit_for(quantity: str, largest: float) -> tuple[float, str]:
    """What values up to this one, in SI, are to be multiplied by, and the unit they then have."""
    if quantity == "asperity_density":
        return next(((per, unit) for per, unit in ((1e-12, "1/µm²"), (1e-6, "1/mm²")) if largest * per >= 0.1), (1.0, "1/m²"))
    return scale(largest) if QUANTITIES[quantity].unit == "m" else (1.0, "")


def scale(length: float) -> tuple[float, str]:
    """What a length in metres is to be multiplied by, and the unit it then has, so that this one is 1 to 1000."""
    if not length > 0.0:
        return 1.0, "m"
    size = 10.0 ** math.floor(math.log10(length))
    text, _, unit = show(size, "mean_separation").partition(" ")
    return float(text) / size, unit
