"""A designed case."""

from collections.abc import Mapping
from typing import Any

from stiction.case.text import show_exactly, with_written
from stiction.quantities.table import QUANTITIES
from stiction.studies.design.plan import LOAD


def with_numbers(content: Any, numbers: Mapping[tuple[str, ...], Any]) -> Any:
    """Return the tables of a case with the numbers of a design in their places."""
    for path, entry in sorted(numbers.items(), key=lambda one: one[0][-1] in QUANTITIES):  # a material before numbers of it
        if path == LOAD:
            text = show_exactly(entry, "load") if "contact" in content else float(entry)
            solve = {key: value for key, value in content["solve"].items() if key != "separation"}
            content = {**content, "solve": {**solve, "load": text}}
        elif path[-1] in QUANTITIES:
            content = with_written(content, {path: entry})
        else:
            content = _placed(content, path, entry)
    return content


def _placed(content: Any, path: tuple[str, ...], entry: Any) -> Any:
    return {**content, path[0]: _placed(content.get(path[0], {}), path[1:], entry)} if path else entry
