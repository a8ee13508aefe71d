"""What the page says in words: the answer in one sentence, its doubts, what else a user should know."""

from collections.abc import Sequence

import numpy as np

from stiction.records.claims import KINDS_OF_DOUBT
from stiction.report.answer import answer_lines
from stiction.report.honest_digits import rounded
from stiction.report.model_line import grade_line, model_line
from stiction.report.tables import shown
from stiction.web.asked import Answer

__all__ = ["doubt_in_words", "headline", "named", "remarks"]


def named(answer: Answer, name: str, at: int) -> str:
    """One result at a point, with its unit; "" where there is no such result."""
    curve = answer.curve
    if name not in curve:
        return ""
    value = _at(answer, name, at)
    if curve[name].attrs.get("normalised_by"):
        return f"{value:.4g} (over {curve[name].attrs['normalised_by']})"
    if curve[name].attrs.get("units", "1") == "1":
        return f"{value:.4g}" if np.isfinite(value) else "not defined"
    return shown(value, name)


def headline(answer: Answer, at: int, known: Sequence[float] = ()) -> tuple[str, str]:
    """Return the number and where it holds: of a prediction with its interval, of one model with as many digits as its doubt
    leaves it. known: what it may be by models that were compared, beside what is uncertain of the inputs."""
    if answer.prediction is not None:
        return answer_lines(answer.prediction)[0]
    load = named(answer, "load", at)
    if "friction_coefficient" not in answer.curve:
        return f"real contact area {named(answer, 'contact_area', at)}", f"at a load of {load}; this model is of contact only"
    mu = named(answer, "friction_coefficient", at)
    where = [f"at a load of {load}", f"real contact area {named(answer, 'contact_area', at)}"]
    if separation := named(answer, "mean_separation", at):
        where.append(f"mean separation {separation}")
    if mu == "not defined":
        return "mu is not defined: the surfaces hold themselves together", ", ".join(where)
    said = rounded(_at(answer, "friction_coefficient", at), [*_ends(answer, at), *known])
    return f"mu ≈ {said}", ", ".join([*where, f"mu to four digits {mu}"])


def _at(answer: Answer, name: str, at: int) -> float:
    return float(np.broadcast_to(answer.curve[name].values, answer.curve["load"].shape)[at])


def _ends(answer: Answer, at: int) -> list[float]:
    """What friction may be at a point, as far as is known: by what is uncertain of the inputs, by the ways to find
    asperities."""
    curve = answer.curve
    ends = [_at(answer, name, at) for name in ("friction_coefficient_low", "friction_coefficient_high") if name in curve]
    if "friction_coefficient_quantile" in curve:
        band = curve["friction_coefficient_quantile"]
        ends += [float(np.broadcast_to(band.values[end], curve["load"].shape)[at]) for end in (0, -1)]
    return [end for end in ends if np.isfinite(end)]


def doubt_in_words(kind: str, text: str) -> str:
    """A doubt with what it means."""
    return f"{KINDS_OF_DOUBT[kind].capitalize()}: {text}"


def remarks(answer: Answer) -> list[str]:
    """What else is to be said of an answer: model, grade, questions about numbers, inputs that change nothing."""
    assert answer.data is not None
    said = answer.data.attrs
    found = [] if answer.prediction is not None else [f"Model {model_line(said)}; grade {grade_line(said)}."]
    found += [f"Warning: {one}" for one in said.get("warnings", [])[1:]]
    found += [f"Questioned: {one}" for one in answer.questions]
    found += [f"Not used: {said['inputs_not_used']}"] if said.get("inputs_not_used") else []
    found += [f"Remark: {one}" for one in str(said.get("remarks", "")).splitlines() if one]
    return [*found, *([answer.left_out] if answer.left_out else [])]
