"""Results are what they were before the code was rearranged.

These numbers come from the code that they test. They show only that nothing has changed, not that anything is right: that is
held by reference, by closed forms and by the contract over the registry. Where a number is meant to change, renew them
on purpose, with

    python tests/pinned/make_pinned.py

say in the commit which rows changed and why, and let no others change with them: `zdiff` shows which did.

Numbers agree to 1e-13 of the size that stands beside each, a few that processors round differently to 1e-11 (`within`). That
is the number's own size, except where it is what is left of larger ones: see `_sizes` in make_pinned.py.
"""

import ast
import csv
import gzip
import json
import math
import os

import pytest
from make_pinned import COLUMNS, FILE, ask

# Of the size of each result, which is in the file. With libraries of other versions films that are solved differ by some 1e-12:
# release/try_versions.py asks for less.
WITHIN = float(os.environ.get("PINNED_WITHIN", "1e-13"))
# Processors round differently what is left of much larger numbers: seen are 1.3e-12 of mu in a comparison on solved films, and
# 1.05e-13 of a pull-off force.
ON_ANY_PROCESSOR = 1e-11


def rows() -> dict[str, list[dict[str, str]]]:
    """What was asked -> the rows of its results."""
    found: dict[str, list[dict[str, str]]] = {}
    with gzip.open(FILE, "rt", encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["asked"], []).append(row)
    return found


ROWS = rows()
# In parts, so that several processes share them.
PARTS = {number: list(ROWS.items())[number::8] for number in range(8)}


def within(quantity: str, at: str) -> float:
    """By which share of its size a result may differ."""
    rounded = quantity == "pull_off_force" or (quantity == "friction_coefficient_at_load" and "+ layered" in at)
    return max(WITHIN, ON_ANY_PROCESSOR) if rounded else WITHIN


def agree(found, most: float, pinned: str) -> bool:
    """Whether a result is the pinned one: numbers to this difference at most, texts and refusals as they are."""
    value = math.nan if pinned == "nan" else ast.literal_eval(pinned)
    if isinstance(value, str) or isinstance(found, str):
        return found == value
    if math.isnan(value) or math.isnan(found):
        return math.isnan(value) and math.isnan(found)
    return abs(found - value) <= most


def test_there_are_enough():
    """2,000 results, and nothing in the file but results."""
    every = [row for some in ROWS.values() for row in some]
    assert len(every) >= 2000
    assert set(every[0]) == set(COLUMNS)


@pytest.mark.parametrize("part", PARTS)
def test_results_are_what_they_were(part):
    different = []
    for asked, results in PARTS[part]:
        found = ask(json.loads(asked))
        for row in results:
            value, _ = found.pop((row["quantity"], row["at"]), (None, 0.0))
            most = within(row["quantity"], row["at"]) * float(row["size"])
            if value is None or not agree(value, most, row["value"]):
                different.append(f"{row['quantity']} {row['at']} is {value!r}, was {row['value']}, size {row['size']}: {asked}")
        different += [f"{quantity} {at} is new: {asked}" for quantity, at in found]
    shown = "\n".join(different[:20])
    assert not different, f"{len(different)} results differ:\n{shown}"
