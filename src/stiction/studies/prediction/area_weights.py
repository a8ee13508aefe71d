"""Weights of the area models, determined by stacking on benchmark surfaces (truth/stack.py)."""

import json
from functools import cache
from pathlib import Path

from stiction.solving.choice import Choice

FILE = Path(__file__).parent / "area_weights.json"


@cache
def area_weights(known: str) -> tuple[tuple[Choice, float], ...]:
    """Return the area models and their weights for a surface known by "numbers", "shape", "kind" or "map"."""
    rows = json.loads(FILE.read_text(encoding="utf-8"))[known]
    return tuple((Choice(row["model"], asperity=row["asperity"], tangential="none"), row["weight"]) for row in rows)
