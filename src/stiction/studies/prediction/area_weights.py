"""Read the weights of the area models, determined by stacking on benchmark surfaces (truth/stack.py)."""

import json
from functools import cache
from pathlib import Path

from stiction.solving.choice import Choice

FILE = Path(__file__).parent / "area_weights.json"


@cache
def area_weights(known: str) -> tuple[tuple[Choice, float], ...]:
    """Return the area models and their weights, as pairs (Choice, weight).

    known: what is known of the surface: "numbers" (only roughness parameters), "shape" (these and skewness, kurtosis or
    texture), "kind" (roughness parameters and the kind of surface) or "map" (a height map).
    """
    rows = json.loads(FILE.read_text(encoding="utf-8"))[known]
    return tuple((Choice(row["model"], asperity=row["asperity"], tangential="none"), row["weight"]) for row in rows)
