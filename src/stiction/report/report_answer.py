"""The answer of a case in words: a question, a sentence with its doubt, and what is known of its error."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.laws.validity import Doubt, doubts_of
from stiction.quantities.table import QUANTITIES
from stiction.report import answer
from stiction.report.honest_digits import rounded
from stiction.report.number_table import shown
from stiction.report.report_inputs import plain_name, with_powers
from stiction.report.several_tables import coordinates_along, of_point, of_value, points_dimension, shown_quantity, varied
from stiction.report.uncertainty_tables import MEANINGS
from stiction.studies.findings import Findings

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"
_FAR = 1.5  # a factor between two models' friction that a reader has to be told of
_COUNTED = {2: "two", 3: "three", 4: "four", 5: "five"}


@dataclass(frozen=True)
class Spread:
    """By how much friction at the working load differs, and by what: low and high end, and their ratio, not a number where
    nothing is known."""

    name: str
    words: str
    low: float
    high: float
    factor: float

    @property
    def known(self) -> bool:
        return bool(np.isfinite([self.low, self.high]).all())


def value_in_words(variable: "xarray.DataArray", value: float, digits: int = 3) -> str:
    """A result with its unit, or what it is divided by; "not defined" of what is no number."""
    if not np.isfinite(value):
        return "not defined"
    if variable.attrs.get("normalised_by"):
        return f"{value:.{digits}g} {variable.attrs['normalised_by']}"
    name = str(variable.name)
    plain = variable.attrs.get("units", "1") == "1" or name not in QUANTITIES
    return f"{value:.{digits}g}" if plain else shown(value, name, digits)


def spreads(findings: Findings) -> list[Spread]:
    """What is known of the error, each part by itself; those of which nothing is known among them. None where there is no
    working load, or no friction."""
    data = findings.answer.data
    if "spread_factor" not in data:
        return []
    share = f"{findings.case.uncertainty.coverage:.0%}"
    said = {
        "inputs": f"{MEANINGS['inputs']} ({share} of what is drawn)",
        "methods": f"{MEANINGS['methods']} (all of them)",
        "models": f"{MEANINGS['models']} ({share} of their weight, in the recommended family)",
    }
    each = ((str(name), data.sel(spread=name)) for name in data["spread"].values)
    return [Spread(name, said[name], *(float(one[f"spread_{end}"]) for end in ("low", "high", "factor"))) for name, one in each]


def question(findings: Findings) -> str:
    """What is asked."""
    subject, data = findings.case.subject, findings.answer.data
    what = "static friction coefficient" if _MU in data else "real contact area"
    if not isinstance(subject, Contact):
        groups = ", ".join(f"{QUANTITIES[name].symbol} = {value:g}" for name, value in _given_groups(subject))
        return f"What is the {what} of the contact with {groups}, {_where(findings)}?"
    film = ""
    if (coating := subject.coating) is not None:
        thickness = dict(subject.listed())["coating.thickness"]
        where = "both bodies" if coating.bodies == "both" else f"the {coating.bodies} body"
        film = f", with a film of {plain_name(coating.material.name)} ({thickness}) on {where}"
    bodies = f"{plain_name(subject.first.name)} against {plain_name(subject.second.name)}{film}"
    area = with_powers(dict(subject.listed())["nominal_area"])
    return f"What is the {what} of {bodies}, rough, with a nominal area of {area}, {_where(findings)}?"


def _given_groups(subject: Any) -> list[tuple[str, float]]:
    return [(name, value) for name, value in subject.groups().items() if name in subject.model_fields_set]


def _where(findings: Findings) -> str:
    load = findings.answer.load
    return "at its loads" if load is None else f"pressed together with {_load_in_words(findings)}"


def _load_in_words(findings: Findings) -> str:
    load = findings.answer.load
    assert load is not None  # who asks has looked
    return value_in_words(findings.answer.data["load"], load)


def headline(findings: Findings) -> str:
    """The number, with as many digits as its doubt leaves it; the ends of several."""
    if findings.prediction is not None:
        return answer.headline(findings.prediction).replace("mu", "μ", 1)
    data, here = findings.answer.data, findings.answer.here
    name = shown_quantity(data)
    if here is not None:
        value = float(here[name])
        if name != _MU:
            return f"real contact area {value_in_words(here[name], value)}"
        ends = [end for one in spreads(findings) if one.known for end in (one.low, one.high)]
        return f"μ ≈ {rounded(value, ends)}" if np.isfinite(value) else "μ is not defined"
    low, high = _ends(data[name])
    if not np.isfinite([low, high]).all():
        return f"{'μ' if name == _MU else 'the contact area'} is not defined"
    if name == _MU:
        return f"μ ≈ {_alike(low, high)}"
    return f"real contact area {value_in_words(data[name], low)} to {value_in_words(data[name], high)}"


def beside_headline(findings: Findings) -> str:
    """What the recommended model says, where it is another one; "" where it is not."""
    best, here = best_of(findings), findings.answer.here
    if findings.prediction is not None or best is None or here is None or _MU not in here:
        return ""
    mu = float(best[f"{_MU}_at_load"])
    if abs(mu - float(here[_MU])) <= 1e-9 * abs(mu):
        return ""
    said = rounded(mu, [])
    agrees = said == rounded(float(here[_MU]), [])
    return (
        "by the model of the case; the recommended one agrees" if agrees else f"by the model of the case; recommended: {said}"
    )


def _alike(low: float, high: float) -> str:
    return " to ".join(dict.fromkeys((rounded(low, []), rounded(high, []))))


def _ends(values: "xarray.DataArray") -> tuple[float, float]:
    known = values.values[np.isfinite(values.values)]
    return (float(known.min()), float(known.max())) if known.size else (np.nan, np.nan)


def answer_in_words(findings: Findings) -> str:
    """One sentence with its doubt, and one more where another model is recommended."""
    if findings.prediction is not None:
        return f"{answer.headline(findings.prediction)}. {findings.prediction.attrs['regime']}"
    data, here = findings.answer.data, findings.answer.here
    model = data.attrs["model"]
    if here is None:
        return f"{_along(findings)} by the model {model}{_trusted(findings)}."
    if _MU not in here:
        area = value_in_words(here["contact_area"], float(here["contact_area"]))
        text = f"Under {_load_in_words(findings)} the bodies touch on {area} by the model {model}{_trusted(findings)}"
        return f"{text}; it is of contact only, and says nothing of friction."
    value = headline(findings).removeprefix("μ ≈ ")
    if value == headline(findings):
        return f"Pressed together with {_load_in_words(findings)}, {value}{_trusted(findings)}."
    start = f"Pressed together with {_load_in_words(findings)}, the contact has a static friction coefficient of about {value}"
    return f"{start} by the model {model}{_trusted(findings)}; {_error_in_words(findings)}.{_recommended(findings)}"


def _along(findings: Findings) -> str:
    """What there is to say of a curve, or of numbers that are several, without a working load."""
    data = findings.answer.data
    dim = points_dimension(data)
    ends = list(dict.fromkeys(of_point(data, at) for at in (0, -1))) if dim else []
    over = f"from {ends[0]} to {ends[1]}" if len(ends) > 1 else f"at {ends[0]}" if ends else "at the point of the case"
    names = [name for each in varied(data) for name in coordinates_along(data, each)]
    several = f", with {' and '.join(_span(data, name) for name in names)}," if names else ""
    text = headline(findings).replace("μ ≈ ", "the static friction coefficient is about ")
    text = text.replace("μ", "the static friction coefficient")
    why = ", where nothing presses," if "not defined" in text else ""
    return f"{text[0].upper()}{text[1:]} {over}{why}{several}"


def _span(data: "xarray.Dataset", name: str) -> str:
    """What a quantity goes through: "thickness = 100 nm to 1 µm"."""
    quantity = name.rpartition(".")[2]
    symbol = QUANTITIES[quantity].symbol if quantity in QUANTITIES else name
    return f"{symbol} = {of_value(data, name, 0)} to {of_value(data, name, -1)}"


def _of_inputs(findings: Findings) -> str:
    """What is said of errors of the inputs where they spread nothing."""
    if not findings.case.uncertain:
        return "the case states no errors of its inputs, so what they do is not known"
    told = any(one.name == "inputs" and one.known for one in spreads(findings))
    return "what the case states as uncertain of its inputs " + ("does not change it" if told else "has no known effect on it")


def _error_in_words(findings: Findings) -> str:
    """What is known of the error, and what is not: from one sentence to the next."""
    known = {one.name: one for one in spreads(findings) if one.known and one.high > one.low}
    said = {
        "inputs": "with what is uncertain of the inputs it is {} in {:.0%} of the draws",
        "methods": "by other ways of finding asperities in the scans it is {}",
        "models": "the models that count here say {} ({:.0%} of their weight)",
    }
    share = findings.case.uncertainty.coverage
    parts = [text.format(_alike(known[name].low, known[name].high), share) for name, text in said.items() if name in known]
    silent = [] if "inputs" in known else [_of_inputs(findings)]
    if "models" not in known:
        silent.append("how far models differ is not known, as fewer than two count here")
    return "; ".join([*parts, *silent])


def doubts_here(findings: Findings) -> list[Doubt]:
    """What is doubtful of the result that is the answer."""
    return doubts_of(findings.result)


def _trusted(findings: Findings) -> str:
    doubts = doubts_here(findings)
    if any(one.kind == "impossible" for one in doubts):
        return ", but what it says cannot be so (see Validity), and this is no answer"
    if doubts:
        respects = "one respect" if len(doubts) == 1 else f"{_COUNTED.get(len(doubts), len(doubts))} respects"
        return f", which is used outside its range of validity in {respects}"
    return ", within the range that its authors claim"


def best_of(findings: Findings) -> "xarray.Dataset | None":
    """What the comparison recommends; None where it recommends nothing."""
    told = findings.answer.told
    name = "none" if told is None else told.attrs.get("recommended", "none")
    return None if told is None or name == "none" else told.sel(model=name)


def _recommended(findings: Findings) -> str:
    """What the comparison recommends in place of the model of the case."""
    told, best = findings.answer.told, best_of(findings)
    if told is None:
        return ""
    if best is None:
        return f" Of all models none is recommended: {told.attrs.get('reason', 'none holds here')}."
    mu = float(best[f"{_MU}_at_load"])
    here = float(findings.result[_MU])
    if abs(mu - here) <= 1e-9 * abs(mu):
        return " It is what the comparison of all models recommends."
    apart = max(mu, here) / min(mu, here) if min(mu, here) > 0.0 else np.inf
    warned = f": the two differ by a factor of {apart:.2g}" if apart > _FAR else ""
    return (
        f" The comparison of all models recommends {best['model'].item()} in its place, which says {rounded(mu, [])}{warned}."
    )
