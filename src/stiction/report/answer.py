"""Put the answer of a prediction into words and JSON.

Terminal, web page, report and notebook use the same text.
"""

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from stiction.quantities.shown import show
from stiction.records.registry import GRADES
from stiction.report.html_words import letters
from stiction.solving.choice import LAWS
from stiction.studies.prediction.measured import CONTRADICTS, USUAL_ERROR
from stiction.studies.prediction.regime import without_commands
from stiction.studies.prediction.uncertainty_sources import sources_in_words

if TYPE_CHECKING:
    import xarray


# Result of a prediction -> head of its column.
PREDICTION_HEADS = {
    "load": "load",
    "friction_coefficient_low": "mu low",
    "friction_coefficient": "mu",
    "friction_coefficient_high": "mu high",
    "friction_force": "friction force",
    "contact_area": "contact area",
}
_MU, _FORCE, _AREA = "friction_coefficient", "friction_force", "contact_area"
_MUCH_WIDER = 1.5  # ratio of the upper ends above which the widest interval over the loads is printed too
_ENOUGH = 2 / 3  # fraction of handbook contacts that must agree
_CONFIDENCE = {1.5: "high", 3.0: "fair", math.inf: "low"}  # largest factor from mu to an end of its interval -> word
_FEW_VALUES = 3  # number of measured values below which the confidence is at most fair
_NO_WIDTH = 1e-9  # relative width of an interval that is only round-off


def at_working_load(data: "xarray.Dataset") -> "xarray.Dataset":
    """Return a prediction at its working load only.

    data: result of `predict`, for one load or over the dimension `load`. Its attribute `working_load` [N] names the load.
    """
    if data["load"].ndim == 0:
        return data
    return data.isel(load=int(np.argmin(np.abs(data["load"].values - data.attrs["working_load"]))))  # loads may be equal


def ends_of_mu(data: "xarray.Dataset") -> list[float]:
    """Return the predicted mu at the working load and the two ends of its interval, as [mu, low, high].

    data: result of `predict`.
    """
    point = at_working_load(data)
    return [float(point[f"{_MU}{end}"]) for end in ("", "_low", "_high")]


def confidence(mu: float, low: float, high: float) -> str:
    """Return the confidence in a predicted friction coefficient: "high", "fair" or "low".

    low, high: ends of the prediction interval of mu. The larger of the ratios high / mu and mu / low decides: up to 1.5 is
    high, up to 3 is fair, and more is low. A lower end of 0 is low.
    """
    factor = max(high / mu, mu / low) if low > 0.0 else math.inf
    return next(word for most, word in _CONFIDENCE.items() if factor <= most)


def confidence_in(data: "xarray.Dataset") -> str:
    """Return the confidence in mu of a prediction at its working load: "high", "fair" or "low".

    The width of the interval decides, see `confidence`. With a warning the confidence is at most "fair". It is "low" in any
    case if predictions for this interface state agree with fewer than two thirds of the contacts whose friction is printed in
    handbooks. That condition does not apply if friction measured by the user is part of the prediction. With fewer than three
    measured values the confidence is at most "fair"; it is "low" if they contradict the stated contact.

    data: result of `predict`.
    """
    held, contacts = data.attrs["in_handbooks"]
    if "measured" not in data.attrs and held < _ENOUGH * contacts:
        return "low"
    if CONTRADICTS in data.attrs["warnings"]:
        return "low"
    word = confidence(*ends_of_mu(data))
    few = data.attrs.get("measured", _FEW_VALUES) < _FEW_VALUES
    return "fair" if word == "high" and (few or data.attrs["warnings"]) else word


def confidence_in_words(data: "xarray.Dataset") -> str:
    """Return the confidence in mu of a prediction, with the reason for a low one, such as "low (wide interval)".

    data: result of `predict`.
    """
    word, (held, contacts) = confidence_in(data), data.attrs["in_handbooks"]
    if word != "low":
        return word
    if confidence(*ends_of_mu(data)) == "low":
        return "low (wide interval)"
    if "measured" in data.attrs:
        return "low (measured friction contradicts the contact)"
    return f"low (only {held} of {contacts} handbook contacts agree)"


def confidence_scale(word: str) -> str:
    """Return a text with a confidence, "high", "fair" or "low", and an explanation of these three words."""
    high, fair, _ = (f"{factor:g}" for factor in _CONFIDENCE)
    scale = f"high: the interval ends within a factor of {high} of mu, without a warning; fair: within a factor of {fair}"
    return f"{word} ({scale}; low: wider, or fewer than two of three handbook contacts agree)"


class PredictionAnswer(TypedDict):
    """Define the JSON answer of a prediction at its working load, in SI units.

    Every interval is a list [low, high]. level: coverage probability of the intervals. efficiency: friction force over the
    summed strength of all contact spots, or None. lowered_by: changes that would lower mu. shares: fraction of the variance of
    ln mu by source of uncertainty. next: recommended next step. after_measuring: expected interval of mu after one measurement
    of mu, or None. models: weight of each combined model of the contact area. excluded: fraction of the samples that were
    excluded as impossible. bare_metal: interval of mu after film or oxide has worn through, or None. checked_against: text on
    the benchmarks and measurements that support the prediction.
    """

    load: float
    friction_coefficient: float
    interval: list[float]
    level: float
    confidence: str
    friction_force: float
    friction_force_interval: list[float]
    contact_area: float
    contact_area_interval: list[float]
    efficiency: float | None
    regime: str
    lowered_by: str
    shares: dict[str, float]
    warnings: list[str]
    inputs_not_used: list[str]
    next: str
    after_measuring: list[float] | None
    models: dict[str, float]
    excluded: float
    bare_metal: list[float] | None
    checked_against: str


class ModelAnswer(TypedDict):
    """Define the JSON answer of one model at one load, in SI units.

    friction_coefficient: None if the model gives no friction. interval: ends of the interval of mu over the uncertain inputs.
    level: coverage probability of that interval. interval and level are None if mu has no interval, see `model_record`.
    """

    load: float
    friction_coefficient: float | None
    interval: list[float] | None
    level: float | None


def answer_record(data: "xarray.Dataset") -> PredictionAnswer:
    """Return the answer of a prediction at its working load as a dict for JSON.

    data: result of `predict`.
    """
    point = at_working_load(data)

    def ends(name: str) -> list[float]:
        return [float(point[f"{name}_low"]), float(point[f"{name}_high"])]

    return {
        "load": float(point["load"]),
        "friction_coefficient": float(point[_MU]),
        "interval": ends(_MU),
        "level": data.attrs["level"],
        "confidence": confidence_in(data),
        "friction_force": float(point[_FORCE]),
        "friction_force_interval": ends(_FORCE),
        "contact_area": float(point[_AREA]),
        "contact_area_interval": ends(_AREA),
        "efficiency": float(point["friction_efficiency"]) if "friction_efficiency" in point else None,
        "regime": data.attrs["regime"],
        "lowered_by": data.attrs["lowered_by"],
        "shares": dict(data.attrs["shares"]),
        "warnings": list(data.attrs["warnings"]),
        "inputs_not_used": list(data.attrs["inputs_not_used"]),
        "next": data.attrs["next_step"],
        "after_measuring": list(data.attrs["after_measuring"]) or None,
        "models": dict(data.attrs["models"]),
        "excluded": data.attrs["excluded"],
        "bare_metal": list(data.attrs["bare_metal"]) or None,
        "checked_against": data.attrs["checked_against"],
    }


def model_record(data: "xarray.Dataset") -> ModelAnswer:
    """Return the result of one model as a dict for JSON, at the middle load of its curve.

    data: result of `solve`. The entry `interval` is the interval of mu over the uncertain inputs. It is None if no input is
    uncertain, if no sample has a result, or if mu is the same in all samples.
    """
    point = data.isel({str(dim): size // 2 for dim, size in data["load"].sizes.items()})
    mu = float(point[_MU]) if _MU in point else None
    answer: ModelAnswer = {"load": float(point["load"]), "friction_coefficient": mu, "interval": None, "level": None}
    if f"{_MU}_quantile" not in point:
        return answer
    ends = point[f"{_MU}_quantile"]
    low, high = float(ends[0]), float(ends[-1])
    if not high - low > _NO_WIDTH * high:
        return answer
    return answer | {"interval": [low, high], "level": round(float(ends["quantile"][-1] - ends["quantile"][0]), 12)}


def number(value: float) -> str:
    """Format a number with two significant digits, e.g. 0.1234 as "0.12"."""
    return f"{float(f'{value:.2g}'):g}"


def span(point: "xarray.Dataset", name: str, quantity: str | None = None) -> str:
    """Format the prediction interval of a result as "low to high".

    name: name of the result, for example "friction_coefficient". quantity: key of the table of quantities, for the unit; None
    gives no unit.
    """
    low, high = (float(point[f"{name}_{end}"]) for end in ("low", "high"))
    if quantity is None:
        return f"{number(low)} to {number(high)}"
    return f"{show(low, quantity, 2)} to {show(high, quantity, 2)}"


def headline(data: "xarray.Dataset") -> str:
    """Return one line with mu and its interval, at the working load of a prediction (result of `predict`)."""
    point = at_working_load(data)
    return f"mu = {number(float(point[_MU]))}, {data.attrs['level']:.0%} interval {span(point, _MU)}"


def working_load_in_words(data: "xarray.Dataset") -> str:
    """Format the working load of a prediction, with the range of its loads if there are several.

    For example "1 N (middle of the loads 0.1 N to 10 N)".
    """
    load, *ends = (
        show(float(value), "load", 3) for value in (at_working_load(data)["load"], data["load"].min(), data["load"].max())
    )
    return load if data["load"].size < 2 else f"{load} (middle of the loads {' to '.join(ends)})"


def beside_area(attrs: dict[str, Any]) -> str:
    """Return the names of the meniscus and contamination laws of a prediction, each after "; ", or "" if there are none.

    attrs: attributes of the prediction. The text is appended to the list of contact area models.
    """
    return "".join(f"; {name}" for name in attrs["beside_area"])


def answer_lines(data: "xarray.Dataset", terminal: bool = True) -> list[tuple[str, str]]:
    """Return the answer of a prediction at its working load as pairs (heading, text); headings without text are left out.

    data: result of `predict`. terminal: whether the reader is at a terminal. Other readers get Greek letters, no commands, and
    a row on the scale of confidence.
    """
    point, attrs = at_working_load(data), data.attrs
    force = show(float(point[_FORCE]), _FORCE, 2)
    area = show(float(point[_AREA]), _AREA, 2).replace("m^2", "m²")
    warnings, worn = attrs["warnings"], worn_through(attrs["bare_metal"])
    at = f"at {working_load_in_words(data)}; confidence: {confidence_in_words(data)}"
    rows = [
        (f"mu = {number(float(point[_MU]))}", f"{attrs['level']:.0%} interval {span(point, _MU)}, {at}"),
        ("confidence", "" if terminal else confidence_scale(confidence_in(data))),
        ("friction force", f"{force} ({span(point, _FORCE, _FORCE)}); real contact {area}"),
        ("along the load", _along(data)),
        ("measured", _of_measured(data)),
        ("its error", attrs.get("measured_error", "")),
        ("state", attrs["regime"]),
        ("lower mu by", attrs["lowered_by"]),
        ("uncertainty from", sources_in_words(attrs["shares"])),
        ("sliding", _sliding(point)),
        ("model", models_in_words(attrs["models"]) + beside_area(attrs)),
        ("if worn through", f"{worn} (clean metals); not in the interval" if worn else ""),
        ("checked against", "" if "measured" in attrs else attrs["checked_against"]),
        ("warning", warnings[0] if warnings else ""),
        ("not used", "; ".join(attrs["inputs_not_used"])),
        ("next", next_in_words(data, terminal)),
    ]
    typeset = str if terminal else letters
    return [(typeset(head), typeset(text)) for head, text in rows if text]


def _sliding(point: "xarray.Dataset") -> str:
    """State which fraction of the summed strength of all contact spots the friction force reaches.

    point: prediction at one load. The text is empty if the prediction has no friction efficiency.
    """
    if "friction_efficiency" not in point:
        return ""
    share = f"{float(point['friction_efficiency']):.0%}"
    return f"contact spots slip one after another: friction reaches {share} of the sum of their strengths"


def _along(data: "xarray.Dataset") -> str:
    """State mu with its interval at the smallest and at the largest load of a prediction; "" for a single load.

    The widest interval is stated too, if its upper end is more than 1.5 times the upper ends at both of these loads.
    """
    if data["load"].ndim == 0 or data["load"].size < 2:
        return ""
    ordered = data[[_MU, f"{_MU}_low", f"{_MU}_high"]].sortby("load")  # the many samples would take long to sort
    ends = (ordered.isel(load=place) for place in (0, -1))
    texts = [f"mu = {number(float(end[_MU]))} ({span(end, _MU)}) at {show(float(end['load']), 'load', 3)}" for end in ends]
    ratios = (ordered[f"{_MU}_high"] / ordered[f"{_MU}_low"]).values
    widest = ordered.isel(load=int(np.nanargmax(ratios))) if np.isfinite(ratios).any() else ordered.isel(load=0)
    wide, others = (float(point[f"{_MU}_high"]) for point in (widest, ordered.isel(load=[0, -1]).max("load")))
    if wide > _MUCH_WIDER * others:
        texts.append(f"widest, {span(widest, _MU)}, at {show(float(widest['load']), 'load', 3)}")
    return "; ".join(texts)


def _of_measured(data: "xarray.Dataset") -> str:
    """State the interface strength and other inputs after they were updated with measured friction.

    The text is empty if the prediction uses no measured friction.
    """
    if "measured" not in data.attrs:
        return ""
    count = data.attrs["measured"]
    values = "1 value" if count == 1 else f"{count} values"
    middle, low, high = (show(strength_value, "interfacial_shear_strength", 2) for strength_value in data.attrs["strength"])
    strength = f"interface strength {middle} ({low} to {high})"
    middle, low, high = (number(value) for value in data.attrs["pressure_coefficient"])
    if data.attrs.get("fixed_strength"):
        strength += ", fixed by the case" + ("" if "parameter" in data.dims else " (state an error to fit it)")
    if high != "0":
        strength += f" at zero pressure, pressure coefficient {middle}{f' ({low} to {high})' if low != high else ''}"
    if "parameter" not in data.dims:
        return f"{values}: {strength}"
    names = data["parameter"].values.tolist()
    texts = [] if "interfacial_shear_strength" in names else [strength]
    for index, name in enumerate(names):
        middle, low, high = (show(float(data[key][index]), name.rpartition(".")[2], 2) for key in ("value", "low", "high"))
        texts.append(f"{name.replace('_', ' ')} {middle} ({low} to {high})")
    return "; ".join(filter(None, [f"{values}: {', '.join(texts)}", data.attrs["verdict"].replace("_", " ")]))


def models_in_words(names: Iterable[str]) -> str:
    """Return the names of contact area models that a prediction combines, as one text.

    >>> models_in_words(["persson_2001", "hertz + bowden_tabor_1943"])
    '2 combined: persson_2001; hertz with bowden_tabor_1943'
    """
    texts = [name.replace(" + ", " with ") for name in names]
    return f"{len(texts)} combined: {'; '.join(texts)}" if len(texts) > 1 else "".join(texts)


def worn_through(interval: list[float]) -> str:
    """Format the interval [low, high] of mu after film or oxide has worn through to the bare metals; "" for an empty list."""
    if not interval:
        return ""
    return f"mu = {number(interval[0])} to {number(interval[1])} at most"


def next_in_words(data: "xarray.Dataset", terminal: bool = True) -> str:
    """Return the recommended next step after a prediction, as text.

    If the step is to measure mu once, the text also states the interval of mu that would remain after that measurement.
    terminal: whether the reader is at a terminal, where the step includes its command.
    """
    point, ends, step = at_working_load(data), data.attrs["after_measuring"], str(data.attrs["next_step"])
    step = step if terminal else without_commands(step)
    if not ends or "measure mu once" not in step:
        return step
    found = f"a measured {number(float(point[_MU]))} with {USUAL_ERROR:.0%} standard error"
    return f"{step}; {found} would narrow mu to {number(ends[0])} to {number(ends[1])}"


def model_line(used: Mapping[str, Any]) -> str:
    """Return one line that names the model, laws, options and height distribution of a result.

    used: attributes of the result.
    >>> model_line({"model": "greenwood_williamson_1966", "asperity": "hertz", "film": "none"})
    'greenwood_williamson_1966, asperity law hertz'
    """
    laws = [f"{kind} law {used[kind]}" for kind in LAWS if kind != "model" and used.get(kind, "none") != "none"]
    options = [f"{name.replace('_', ' ')} {used[name]}" for name in str(used.get("options", "")).split() if name in used]
    heights = [f"{used['heights']} heights"] if "heights" in used else []
    return ", ".join([str(used["model"]), *laws, *options, *heights])


def grade_line(used: Mapping[str, Any]) -> str:
    """Return the grade of a result, a letter, with the meaning of that grade.

    used: attributes of the result.
    """
    return f"{used['grade']}: {GRADES[used['grade']]}"
