"""The model that answered, in one line: the same text on terminal, report, page and files."""

from collections.abc import Mapping
from typing import Any

from stiction.records.registry import GRADES
from stiction.solving.choice import LAWS


def model_line(used: Mapping[str, Any]) -> str:
    """Return the model of a result, by its attributes, with all laws and options that answered and its heights.

    >>> model_line({"model": "greenwood_williamson_1966", "asperity": "hertz", "film": "none"})
    'greenwood_williamson_1966, asperity law hertz'
    """
    laws = [f"{kind} law {used[kind]}" for kind in LAWS if kind != "model" and used.get(kind, "none") != "none"]
    options = [f"{name.replace('_', ' ')} {used[name]}" for name in str(used.get("options", "")).split() if name in used]
    heights = [f"{used['heights']} heights"] if "heights" in used else []
    return ", ".join([str(used["model"]), *laws, *options, *heights])


def grade_line(used: Mapping[str, Any]) -> str:
    """Return the grade of a result, by its attributes, with what it means."""
    return f"{used['grade']}: {GRADES[used['grade']]}"
