"""State the question and the answer of a report in sentences, with validity warnings."""

import re
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.contact import Contact
from stiction.laws.validity import warnings_of
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.records.validity_warning import ValidityWarning
from stiction.report import answer
from stiction.report.html_words import letters
from stiction.report.significant_digits import rounded
from stiction.report.swept_tables import coordinates_along, of_point, of_value, points_dimension, shown_quantity, varied
from stiction.report.table import Column, Table, with_signs, with_unit
from stiction.solving.choice import RECOMMENDED
from stiction.studies.report_data import ReportData, stated_in
from stiction.surfaces.finished import Finished

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"
_LONG = re.compile(r"\d+\.\d{3,}")  # a number with more digits than a reader needs
_COUNTED = {2: "two", 3: "three", 4: "four", 5: "five"}


def plain_name(name: str) -> str:
    """Return the readable name of a material: "hardened steel 52100" for "hardened_steel_52100"."""
    return name.replace("_", " ")


def value_in_words(variable: "xarray.DataArray", value: float, digits: int = 3) -> str:
    """Format a value of a result with its unit or, if it is normalised, with the formula of its divisor.

    variable: the result. value: in SI units or normalised; NaN gives "not defined".
    """
    if not np.isfinite(value):
        return "not defined"
    if variable.attrs.get("normalised_by"):
        return f"{value:.{digits}g} {variable.attrs['normalised_by']}"
    return with_unit(variable, value, digits)


def interval_of(point: "xarray.Dataset") -> list[float]:
    """Return both ends of the interval of mu of one model at one load; [] if it has no interval.

    The interval is over the uncertain inputs. Without uncertain inputs it is over the methods of finding asperities.
    """
    if f"{_MU}_quantile" in point:
        ends = [float(point[f"{_MU}_quantile"].isel(quantile=place)) for place in (0, -1)]
    else:
        ends = [float(point[f"{_MU}_{end}"]) for end in ("low", "high") if f"{_MU}_{end}" in point]
    return [end for end in ends if np.isfinite(end)]


def question(findings: ReportData) -> str:
    """Return the question that a report answers, as a sentence with contact and load."""
    subject, data = findings.case.subject, findings.data
    what = "static friction coefficient" if _MU in data else "real contact area"
    if not isinstance(subject, Contact):
        stated = ((name, value) for name, value in subject.groups().items() if name in subject.model_fields_set)
        groups = ", ".join(f"{QUANTITIES[name].symbol} = {value:g}" for name, value in stated)
        return f"What is the {what} of the contact with {groups}, {_where(findings)}?"
    film = ""
    if (coating := subject.coating) is not None:
        thickness = with_signs(inputs_as_stated(findings)["coating.thickness"])
        where = "both bodies" if coating.bodies == "both" else f"the {coating.bodies} body"
        film = f", with a film of {plain_name(coating.material.name)} ({thickness}) on {where}"
    between = f", interface: {subject.interface.name}" if subject.interface is not None else ""
    bodies = f"{plain_name(subject.first.name)} against {plain_name(subject.second.name)}{film}{between}"
    area = with_signs(inputs_as_stated(findings)["nominal_area"])
    return f"What is the {what} of {bodies}, with a nominal area of {area}, {_where(findings)}?"


def inputs_as_stated(findings: ReportData) -> dict[str, str]:
    """Return the inputs of a report as texts by dotted name: as the case file writes them, otherwise with a suitable unit."""
    subject, stated = findings.case.subject, stated_in(findings.text)
    table = "contact" if isinstance(subject, Contact) else "indices"
    texts = ((dotted, text, stated.get((table, *dotted.split(".")))) for dotted, text in subject.listed())
    return {dotted: written if isinstance(written, str) else text for dotted, text, written in texts}


def stated_roughness(contact: Contact) -> str:
    """Return the finishes or scans that the roughness of a contact was derived from, as text.

    The text is "" if the user specified the numbers sigma, R and N.
    """
    bodies = {name: body for name in ("first", "second") if isinstance(body := contact.roughness.part(name), Finished)}
    stated = [f"{name} body " * (len(bodies) > 1) + _finish_in_words(body) for name, body in bodies.items()]
    if contact.measured is not None:
        stated += [f"scan of the {name} body" for name in contact.measured.history]
    return ", ".join(stated)


def main_inputs(findings: ReportData) -> Table | None:
    """Return a table of the main inputs; None for a contact that is given by dimensionless groups."""
    subject = findings.case.subject
    if not isinstance(subject, Contact):
        return None
    texts = inputs_as_stated(findings)

    def in_short(start: str, *names: str) -> str:
        known = ((QUANTITIES[name], texts.get(f"{start}{name}")) for name in names)
        return ", ".join(f"{row.symbol} = {text}" for row, text in known if text)

    def body(start: str, name: str) -> str:
        return ", ".join(filter(None, [plain_name(name), in_short(f"{start}.", "youngs_modulus", "hardness")]))

    strength = "interfacial_shear_strength"
    rows = [("first body", body("first", subject.first.name)), ("second body", body("second", subject.second.name))]
    if (film := subject.coating) is not None:
        rows.append(("film", f"{body('coating.material', film.material.name)}, {in_short('coating.', 'thickness')}"))
    rows.append(("nominal area", texts["nominal_area"]))
    sizes = in_short("roughness.", "asperity_height_deviation", "asperity_radius", "asperity_density")
    stated = stated_roughness(subject)
    sizes, kind = f"{stated}: {sizes}" if stated else sizes, "" if stated else texts.get("roughness.kind")
    rows.append(("roughness", ", ".join(filter(None, [sizes, kind]))))
    rows.append(("interface", getattr(subject.interface, "name", "") or in_short("", strength) or "not stated"))
    rows += [("work of adhesion", texts["work_of_adhesion"])] if "work_of_adhesion" in texts else []
    rows.append(("load", load_in_words(findings) if findings.load is not None else "the loads or separations of the case"))
    cells = [(name, letters(_LONG.sub(lambda match: f"{float(match[0]):.3g}", text)).replace("e+", "e")) for name, text in rows]
    return Table([Column("input"), Column("value")], cells, "Main inputs; the appendix lists all inputs", stacked=True)


def _finish_in_words(body: Finished) -> str:
    return body.finish if body.height is None else f"{body.finish}, Sq = {show(float(body.height), 'rms_height', 3)}"


def _where(findings: ReportData) -> str:
    load = findings.load
    return "at the loads of the case" if load is None else f"pressed together with {load_in_words(findings)}"


def load_in_words(findings: ReportData) -> str:
    load = findings.load
    assert load is not None  # callers make sure that there is a working load
    return value_in_words(findings.data["load"], load)


def headline(findings: ReportData) -> str:
    """Return the headline of a report: mu, or the contact area of a model without friction.

    mu is rounded to its significant digits. Without a working load the headline states the smallest and the largest value.
    """
    if findings.prediction is not None:
        return answer.headline(findings.prediction).replace("mu", "μ", 1)
    data, point = findings.data, findings.working_results
    name = shown_quantity(data)
    if point is not None:
        value = float(point[name])
        if name != _MU:
            return f"real contact area {value_in_words(point[name], value)}"
        return f"μ ≈ {rounded(value, interval_of(point))}" if np.isfinite(value) else "μ is not defined"
    low, high = _ends(data[name])
    if not np.isfinite([low, high]).all():
        return f"{'μ' if name == _MU else 'the contact area'} is not defined"
    if name == _MU:
        return f"μ ≈ {_alike(low, high)}"
    return f"real contact area {value_in_words(data[name], low)} to {value_in_words(data[name], high)}"


def _alike(low: float, high: float) -> str:
    return " to ".join(dict.fromkeys((rounded(low, []), rounded(high, []))))


def _ends(values: "xarray.DataArray") -> tuple[float, float]:
    known = values.values[np.isfinite(values.values)]
    return (float(known.min()), float(known.max())) if known.size else (np.nan, np.nan)


def answer_in_words(findings: ReportData) -> str:
    """Return the answer of a report as one sentence, with the state of the contact or the validity of the model."""
    if findings.prediction is not None:
        return f"{answer.headline(findings.prediction)}. {findings.prediction.attrs['regime']}"
    data, point = findings.data, findings.working_results
    model = data.attrs["model"]
    if point is None:
        by = "by the prediction" if model == RECOMMENDED else f"by the model {model}{_trusted(findings)}"
        return f"{_along(findings)} {by}."
    if _MU not in point:
        area = value_in_words(point["contact_area"], float(point["contact_area"]))
        text = f"Under a load of {load_in_words(findings)} the real contact area is {area}"
        return f"{text} by the model {model}{_trusted(findings)}. This model gives the contact area only, no friction."
    value = headline(findings).removeprefix("μ ≈ ")
    if value == headline(findings):
        return f"Pressed together with {load_in_words(findings)}, {value}{_trusted(findings)}."
    start = f"Pressed together with {load_in_words(findings)}, the contact has a static friction coefficient of about {value}"
    ends = interval_of(point)
    band = f"; the uncertain inputs give {_alike(ends[0], ends[1])}" if ends else ""
    return f"{start} by the model {model}{_trusted(findings)}{band}."


def _along(findings: ReportData) -> str:
    """Return the answer as a sentence for a result without a working load: a curve, or array parameters."""
    data = findings.data
    dim = points_dimension(data)
    ends = list(dict.fromkeys(of_point(data, end) for end in (0, -1))) if dim else []
    over = f"from {ends[0]} to {ends[1]}" if len(ends) > 1 else f"at {ends[0]}" if ends else "at the point of the case"
    names = [name for each in varied(data) for name in coordinates_along(data, each)]
    several = f", with {' and '.join(_span(data, name) for name in names)}," if names else ""
    text = headline(findings).replace("μ ≈ ", "the static friction coefficient is about ")
    text = text.replace("μ", "the static friction coefficient")
    why = ", where no load is compressive," if "not defined" in text else ""
    return f"{text[0].upper()}{text[1:]} {over}{why}{several}"


def _span(data: "xarray.Dataset", name: str) -> str:
    """State the first and the last value of a quantity that the case varies: "t = 100 nm to 1 µm"."""
    quantity = name.rpartition(".")[2]
    symbol = QUANTITIES[quantity].symbol if quantity in QUANTITIES else name
    return f"{symbol} = {of_value(data, name, 0)} to {of_value(data, name, -1)}"


def warnings_here(findings: ReportData) -> list[ValidityWarning]:
    """Return the validity warnings of a report at its working load."""
    return warnings_of(findings.result)


def _trusted(findings: ReportData) -> str:
    warnings = warnings_here(findings)
    if any(warning.kind == "impossible" for warning in warnings):
        return ", but this result is physically impossible (see Validity)"
    if warnings:
        respects = "one respect" if len(warnings) == 1 else f"{_COUNTED.get(len(warnings), len(warnings))} respects"
        return f", which is used outside its range of validity in {respects}"
    return ", within the range that its authors claim"
