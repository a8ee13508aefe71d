"""What the page says in words: the answer in one sentence, and what else a user should know."""

from stiction.report.answer import answer_lines
from stiction.report.honest_digits import rounded
from stiction.report.model_line import grade_line, model_line
from stiction.report.report_answer import interval_of, value_in_words
from stiction.web.asked import Answer

_MU = "friction_coefficient"
_WHERE = {"load": "at a load of", "contact_area": "real contact area", "mean_separation": "mean separation"}


def headline(answer: Answer, at: int) -> tuple[str, str]:
    """Return the number and where it holds: of a prediction with its interval, of one model with as many digits as its doubt
    leaves it."""
    if answer.prediction is not None:
        return answer_lines(answer.prediction)[0]
    here = answer.at(at)
    said = {name: value_in_words(here[name], float(here[name]), 4) for name in (_MU, *_WHERE) if name in here}
    if _MU not in said:
        return f"real contact area {said['contact_area']}", f"at a load of {said['load']}; this model is of contact only"
    where = ", ".join(f"{head} {said[name]}" for name, head in _WHERE.items() if name in said)
    if said[_MU] == "not defined":
        return "mu is not defined: the surfaces hold themselves together", where
    return f"mu ≈ {rounded(float(here[_MU]), interval_of(here))}", f"{where}, mu to four digits {said[_MU]}"


def remarks(answer: Answer) -> list[str]:
    """What else is to be said of an answer: model, grade, questions about numbers, inputs that change nothing."""
    assert answer.data is not None
    said, (*several, _) = answer.data.attrs, answer.data["load"].dims or ("",)
    found = [] if answer.prediction is not None else [f"Model {model_line(said)}; grade {grade_line(said)}."]
    found += [f"Warning: {one}" for one in said.get("warnings", [])[1:]]
    found += [f"Questioned: {one}" for one in answer.questions]
    found += [f"Not used: {said['inputs_not_used']}"] if said.get("inputs_not_used") else []
    found += [f"Remark: {one}" for one in str(said.get("remarks", "")).splitlines() if one]
    return [
        *found,
        *([f"numbers are several along {', '.join(map(str, several))}: the first of each is drawn"] if several else []),
    ]
