"""A designed case, and the model that is recommended for it."""

from collections.abc import Mapping
from typing import Any

from stiction.case.read import Case
from stiction.case.text import show_exactly, with_written
from stiction.quantities.table import QUANTITIES
from stiction.studies.comparison.compare import compare, working_load
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


def other_recommended(case: Case, model: str) -> str:
    """Return a sentence with both mu where another model than this one is recommended for a designed case; else ""."""
    data = compare(case.subject, load=working_load(case, None))
    best = data.attrs.get("recommended", "none")
    if best in (model, "none"):
        return ""
    mu = dict(zip(data["model"].values.tolist(), data["friction_coefficient_at_load"].values.tolist(), strict=True))
    searched = f"mu {mu[model]:.3g}" if model in mu else "no mu"
    return f"at this design {best} is recommended, with mu {mu[best]:.3g}; {model}, which was searched with, gives {searched}"


def _placed(content: Any, path: tuple[str, ...], entry: Any) -> Any:
    return {**content, path[0]: _placed(content.get(path[0], {}), path[1:], entry)} if path else entry
