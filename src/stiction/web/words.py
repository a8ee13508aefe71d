"""What the page says in words: the answer in one sentence, its doubts, what else a user should know."""

import numpy as np

from stiction.laws.claims import KINDS_OF_DOUBT
from stiction.laws.registry import GRADES
from stiction.report.tables import shown
from stiction.web.asked import Answer

__all__ = ["doubt_in_words", "headline", "named", "remarks"]


def named(answer: Answer, name: str, at: int) -> str:
    """One result at a point, with its unit; "" where there is no such result."""
    curve = answer.curve
    if name not in curve:
        return ""
    value = float(np.broadcast_to(curve[name].values, curve["load"].shape)[at])
    if curve[name].attrs.get("normalised_by"):
        return f"{value:.4g} (over {curve[name].attrs['normalised_by']})"
    if curve[name].attrs.get("units", "1") == "1":
        return f"{value:.4g}" if np.isfinite(value) else "not defined"
    return shown(value, name)


def headline(answer: Answer, at: int) -> tuple[str, str]:
    """The number and where it holds."""
    load = named(answer, "load", at)
    if "friction_coefficient" not in answer.curve:
        return f"real contact area {named(answer, 'contact_area', at)}", f"at a load of {load}; this model is of contact only"
    mu = named(answer, "friction_coefficient", at)
    said = f"mu = {mu}" if mu != "not defined" else "mu is not defined: the surfaces hold themselves together"
    where = [f"at a load of {load}", f"real contact area {named(answer, 'contact_area', at)}"]
    if separation := named(answer, "mean_separation", at):
        where.append(f"mean separation {separation}")
    return said, ", ".join(where)


def doubt_in_words(kind: str, text: str) -> str:
    """A doubt with what it means."""
    return f"{KINDS_OF_DOUBT[kind].capitalize()}: {text}"


def remarks(answer: Answer) -> list[str]:
    """What else is to be said of an answer: model, grade, questions about numbers, inputs that change nothing."""
    assert answer.data is not None
    said = answer.data.attrs
    laws = [f"{kind} law {said[kind]}" for kind in ("asperity", "tangential", "film") if said.get(kind, "none") != "none"]
    found = [f"Model {', '.join([said['model'], *laws])}; grade {said['grade']}: {GRADES[said['grade']]}."]
    found += [f"Questioned: {one}" for one in answer.questions]
    found += [f"Not used: {said['inputs_not_used']}"] if said.get("inputs_not_used") else []
    found += [f"Remark: {one}" for one in str(said.get("remarks", "")).splitlines() if one]
    return [*found, *([answer.left_out] if answer.left_out else [])]
