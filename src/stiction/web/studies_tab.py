"""Build the tab Studies: sensitivity to the inputs, design for a target mu, and calibration by measured values.

Each study is limited to one minute.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from nicegui import ui

from stiction.case.read import case_in
from stiction.quantities.errors import InputError
from stiction.report.answer import answer_lines
from stiction.report.table import facts
from stiction.report.view import View
from stiction.web.background import Progress
from stiction.web.elements import attributes, upload_button
from stiction.web.explorer import Explorer
from stiction.web.fields import ENDINGS, Number, numbers_of, parts_of, value_at, with_value_at
from stiction.web.number_fields import label_of
from stiction.web.pictures import Shown
from stiction.web.query import Query, read_query
from stiction.web.study_button import Study

_NONE = ""  # value of the choice that searches no number


def run_sensitivity_study(query: Query, progress: Progress) -> View:
    """Return the view (tables and pictures) of a sensitivity study, which shows which input to measure better.

    query: the case. progress: records the progress. Raises InputError if the case is invalid.
    """
    from stiction.report.views.sensitivity import sensitivity_view
    from stiction.studies.sensitivity.run import sensitivity

    return sensitivity_view(sensitivity(case_in(query.tables, query.folder), progress=progress))


def run_design_study(query: Query, load: str | float, target: float, free: dict[str, Any], progress: Progress) -> View:
    """Return the view (tables and pictures) of a search for numbers of the case with which mu equals `target`.

    load: load at which mu must reach the target, in N, normalised, or a text with a unit. free: table [design.choose] of a case
    file, with the numbers to search and their limits. Raises InputError if `target` is not above 0, or if the case, the load or
    the limits are invalid.
    """
    from stiction.report.views.design import design_view
    from stiction.studies.design.plan import make_design_plan
    from stiction.studies.design.run import run_design

    if not 0.0 < target < math.inf:
        raise InputError("target mu", target, "a number above 0")
    objective = {"target": "friction_coefficient", "value": target}
    design = {"objective": objective, "choose": free, "validity": "possible", "effort": 30}
    tables = {**query.at_load(load).tables, "design": design}
    return design_view(run_design(make_design_plan(tables, query.folder), progress.tell))


def run_fit_study(query: Query, load: str | float, data: Path, free: dict[str, Any], progress: Progress) -> View:
    """Return the view (tables and pictures) of a fit of numbers of the case to measured series.

    load: load of the prediction after the fit. data: file of the measured values. free: table [fit.free] of a case file, with
    the numbers to fit and their limits; {} fits the interface strength of a prediction. Raises InputError if the case, the data
    or the limits are invalid.
    """
    from stiction.report.views.fit import fit_view
    from stiction.report.views.prediction import prediction_view
    from stiction.studies.fit.plan import make_fit_plan
    from stiction.studies.fit.predicted import fit_prediction
    from stiction.studies.fit.run import run_fit

    fit = {"fit": {"free": free}} if free else {}
    if (answer := fit_prediction({**query.at_load(load).tables, **fit}, data, query.folder)) is not None:
        rows = answer_lines(answer[1], terminal=False)
        return replace(prediction_view(*answer, "case.toml", measured=data), parts=lambda: [facts(rows)])
    return fit_view(run_fit(make_fit_plan({**query.tables, **fit}, data, query.folder), progress))


class StudiesTab:
    """Show one card for each study, with its fields and its button."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        ui.label("A study on this page stops after one minute; run the command shown to complete it.").classes("text-sm")
        with _card("How sure, and what to measure better", "stiction run case.toml; stiction sensitivity case.toml"):
            self._sensitivity()
        with _card("Design for a friction coefficient", "stiction design case.toml, with a table [design]"):
            self._design()
        with _card("Fit to measured series", "stiction fit case.toml --data measured.csv"):
            self._calibration()

    def _study(self, label: str, work: Callable[[Query, Progress], View]) -> None:
        """Add the button of a study, and a place below it for the result.

        work: function that computes the view of the result.
        """
        view = self._explorer.view

        def result(progress: Progress) -> Shown:
            query = self._explorer.answer.query
            read_query(query)  # refuses a case that is too large
            return Shown.of(work(query, progress), view.narrow)

        def show(shown: Shown) -> None:
            below.clear()
            with below:
                shown.show(view.narrow)

        Study(self._explorer, label, result, show)
        below = ui.column().classes("w-full")

    def _load(self, query: Query) -> str | float:
        """Return the load of the shown point of the curve in the form of a case file: a number, or a text with the unit N."""
        load = self._explorer.load
        return load if "indices" in query.tables else f"{load!r} N"

    def _sensitivity(self) -> None:
        label = "numbers of materials vary within their ranges"
        ranges = attributes(ui.switch(label, value=True), aria_label=label)

        def work(query: Query, progress: Progress) -> View:
            varied = with_value_at(query.tables, ("uncertainty", "ranges"), True)
            return run_sensitivity_study(query.with_tables(varied) if ranges.value else query, progress)

        self._study("Sensitivity", work)

    def _free_number(self, *likely: str, alone: str = "") -> Callable[[], dict[str, Any]]:
        """Add fields for a number to search and its limits; return a function that returns them as a table of a case file.

        likely: numbers to list first, if the case has them. alone: text of the choice that searches no number.
        """

        def numbers() -> dict[str, tuple[Number, float]]:
            tables = self._explorer.answer.query.tables
            each = [(one, one.si(value_at(tables, one.path))) for part in parts_of(tables) for one in numbers_of(part)]
            named = {".".join(one.path[1:]): (one, value) for one, value in each if value is not None}
            return {name: named[name] for name in (*likely, *named) if name in named}

        def fill() -> None:
            if which.value in numbers():
                number, value = numbers()[which.value]
                low.set_value(number.text(value / 3.0))
                high.set_value(number.text(min(3.0 * value, 0.99 * number.quantity.upper)))

        def free() -> dict[str, Any]:
            if which.value == _NONE:
                return {}
            if which.value not in numbers():
                raise InputError("free number", which.value, "a number of the case")
            number, _ = numbers()[which.value]
            limits = {name: number.written(str(text.value)) for name, text in (("low", low), ("high", high))}
            return with_value_at({}, number.path[1:], limits)

        labels = {_NONE: alone} if alone else {}
        labels |= {name: _human_name(number) for name, (number, _) in numbers().items()}
        with ui.row().classes("items-center gap-2 w-full"):
            which = ui.select(labels, value=next(iter(labels), None), label="free number", on_change=fill).classes("w-72")
            low, high = (ui.input(label).classes("w-28") for label in ("from", "to"))
            for element in (which, low, high):
                element.props("dense outlined")
        fill()
        return free

    def _design(self) -> None:
        mu = self._explorer.answer.at(self._explorer.point).get("friction_coefficient")
        near = 0.1 if mu is None or not float(mu) > 0.0 else float(f"{0.9 * float(mu):.2g}")
        target = ui.number("target μ", value=near, min=0.0, format="%.4g").props("dense outlined")
        free = self._free_number("coating.thickness", "roughness.asperity_height_deviation")

        def work(query: Query, progress: Progress) -> View:
            value = math.nan if target.value is None else float(target.value)
            return run_design_study(query, self._load(query), value, free(), progress)

        self._study("Design", work)

    def _calibration(self) -> None:
        text = ui.label().classes("text-sm").props('role="status"')
        uploads: list[tuple[str, str]] = []  # path and name of the last upload

        async def uploaded(path: str, name: str) -> None:
            uploads[:] = [(path, name)]
            text.set_text(f"{name} is stored until the page is closed")

        upload_button(self._explorer, "Upload measured series, .csv", uploaded, text.set_text, 2**21)
        alone = "interface strength alone" if self._explorer.answer.is_prediction else ""
        free = self._free_number("interfacial_shear_strength", "work_of_adhesion", alone=alone)

        def work(query: Query, progress: Progress) -> View:
            if not uploads:
                raise InputError("measured series", None, "a .csv file with loads and measured values")
            ((path, name),) = uploads
            try:
                return run_fit_study(query, self._load(query), Path(path), free(), progress)
            except InputError as error:
                value = error.value.replace(path, name) if isinstance(error.value, str) else error.value
                raise InputError(error.field.replace(path, name), value, error.allowed, error.hint) from None

        self._study("Calibrate", work)


def _human_name(number: Number) -> str:
    """Return the label of a number of the form, followed by the body that it belongs to."""
    return ", ".join([label_of(number.path), *(ENDINGS[key] for key in number.path[1:-1] if key in ENDINGS)])


def _card(title: str, command: str) -> ui.card:
    with ui.card().classes("w-full") as card:
        ui.label(title).classes("text-lg")
        ui.label(command).classes("text-sm font-mono")
    return card
