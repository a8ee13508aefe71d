"""Words, units and looks that the pictures of surfaces have in common."""

import math
from typing import Any

from stiction.laws.finding import methods
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import show
from stiction.report.pictures import BLUE, GREEN, ORANGE, RED, SKY

__all__ = ["look_of", "plain", "scale", "unit_for"]

_COLOURS = (BLUE, RED, GREEN, ORANGE, SKY, "black")
_MARKERS = ("o", "s", "^", "D", "v", "P")


def look_of(method: str, at: int) -> dict[str, Any]:
    """Colour and mark of a method, the same in all pictures; of anything else, of its place among the lines."""
    known = list(methods())
    at = known.index(method) if method in known else at
    return {"color": _COLOURS[at % len(_COLOURS)], "marker": _MARKERS[at % len(_MARKERS)], "markersize": 5}


def plain(method: str) -> str:
    """What a method finds, in a few words; anything else as it is."""
    record = methods().get(method)
    return method.replace("_", " ") if record is None else record.label


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
