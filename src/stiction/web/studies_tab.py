"""The tab Studies: what to measure better, design for an objective, calibration; those that take less than a minute."""

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
from stiction.web.asked import Query, case_asked
from stiction.web.drawn import attributes, upload_button
from stiction.web.explorer import Explorer
from stiction.web.fields import ENDINGS, Number, got, numbers_of, parts_of, placed
from stiction.web.number_fields import label_of
from stiction.web.pictures import Shown
from stiction.web.studying import Study
from stiction.web.working import Progress

_NONE = ""  # the choice of no free number


def what_matters(question: Query, progress: Progress) -> View:
    """Which input should be measured better. Raises InputError."""
    from stiction.report.views.sensitivity import sensitivity_view
    from stiction.studies.sensitivity.run import sensitivity

    return sensitivity_view(sensitivity(case_in(question.tables, question.folder), progress=progress))


def designed(question: Query, load: str | float, objective: float, free: dict[str, Any], progress: Progress) -> View:
    """The numbers, between their ends, at which the friction coefficient meets an objective at a load. Raises InputError."""
    from stiction.report.views.design import design_view
    from stiction.studies.design.plan import make_design_plan
    from stiction.studies.design.run import run_design

    if not 0.0 < objective < math.inf:
        raise InputError("target mu", objective, "a number above 0")
    table = {
        "objective": {"target": "friction_coefficient", "value": objective},
        "choose": free,
        "validity": "possible",
        "effort": 30,
    }
    tables = {**question.at_load(load).tables, "design": table}
    return design_view(run_design(make_design_plan(tables, question.folder), progress.tell))


def calibrated(question: Query, load: str | float, data: Path, free: dict[str, Any], progress: Progress) -> View:
    """Numbers of the case, fitted to measured series; load: at which a prediction is made. Raises InputError."""
    from stiction.report.views.fit import fit_view
    from stiction.report.views.prediction import prediction_view
    from stiction.studies.fit.plan import make_fit_plan
    from stiction.studies.fit.predicted import fit_prediction
    from stiction.studies.fit.run import run_fit

    table = {"fit": {"free": free}} if free else {}
    tables = {**question.tables, **table}
    here = {**question.at_load(load).tables, **table}
    if (answer := fit_prediction(here, data, question.folder)) is not None:
        rows = answer_lines(answer[1])
        return replace(prediction_view(*answer, "case.toml"), parts=lambda: [facts(rows)])
    return fit_view(run_fit(make_fit_plan(tables, data, question.folder), progress))


class StudiesTab:
    """A card for each study."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        ui.label("A study stops here after a minute; run the command shown to complete it.").classes("text-sm")
        with _card("How sure, and what to measure better", "stiction run case.toml; stiction sensitivity case.toml"):
            self._sure()
        with _card("Design for a friction coefficient", "stiction design case.toml, with a table [design]"):
            self._design()
        with _card("Calibration on measured series", "stiction fit case.toml --data measured.csv, with a table [fit]"):
            self._calibration()

    def _study(self, label: str, work: Callable[[Query, Progress], View]) -> None:
        """Add the button of a study; its result is shown below. work: from the question, which is not too large."""
        view = self._explorer.view

        def result(progress: Progress) -> Shown:
            question = self._explorer.good.question
            case_asked(question)
            return Shown.of(work(question, progress), view.narrow)

        def show(found: Shown) -> None:
            below.clear()
            with below:
                found.show(view.narrow)

        Study(self._explorer, label, result, show)
        below = ui.column().classes("w-full")

    def _load(self, question: Query) -> str | float:
        """Return the load of the Contact tab as a case has it."""
        load = self._explorer.load
        return load if "indices" in question.tables else f"{load!r} N"

    def _sure(self) -> None:
        vary = "numbers of materials vary within their ranges"
        ranges = attributes(ui.switch(vary, value=True), aria_label=vary)

        def asked(question: Query) -> Query:
            varied = placed(question.tables, ("uncertainty", "ranges"), True)
            return question.with_tables(varied) if ranges.value else question

        self._study("Sensitivity", lambda question, progress: what_matters(asked(question), progress))

    def _free_number(self, *likely: str, alone: str = "") -> Callable[[], dict[str, Any]]:
        """Ask which number is free, between which ends; return what tells them, as tables [design.choose] and [fit.free].
        likely: which numbers stand first, where the case has them; alone: the text for no free number."""

        def places() -> dict[str, tuple[Number, float]]:
            tables = self._explorer.good.question.tables
            each = [(one, one.si(got(tables, one.path))) for part in parts_of(tables) for one in numbers_of(part)]
            named = {_address(one): (one, value) for one, value in each if value is not None}
            return {name: named[name] for name in (*likely, *named) if name in named}

        def filled() -> None:
            if which.value in places():
                number, value = places()[which.value]
                low.set_value(number.text(value / 3.0))
                high.set_value(number.text(min(3.0 * value, 0.99 * number.quantity.upper)))

        def free() -> dict[str, Any]:
            if which.value == _NONE:
                return {}
            if which.value not in places():
                raise InputError("free number", which.value, "a number of the case")
            number, _ = places()[which.value]
            ends = {name: number.written(str(end.value)) for name, end in (("low", low), ("high", high))}
            return placed({}, number.path[1:], ends)

        names = {_NONE: alone} if alone else {}
        names |= {name: _human_name(number) for name, (number, _) in places().items()}
        with ui.row().classes("items-center gap-2 w-full"):
            which = ui.select(names, value=next(iter(names), None), label="free number", on_change=filled).classes("w-72")
            low, high = (ui.input(label).classes("w-28") for label in ("from", "to"))
            for one in (which, low, high):
                one.props("dense outlined")
        filled()
        return free

    def _design(self) -> None:
        mu = self._explorer.good.at(self._explorer.here).get("friction_coefficient")
        near = 0.1 if mu is None or not float(mu) > 0.0 else float(f"{0.9 * float(mu):.2g}")
        objective = ui.number("target mu", value=near, min=0.0, format="%.4g").props("dense outlined")
        free = self._free_number("coating.thickness", "roughness.asperity_height_deviation")

        def work(question: Query, progress: Progress) -> View:
            return designed(
                question,
                self._load(question),
                math.nan if objective.value is None else float(objective.value),
                free(),
                progress,
            )

        self._study("Design", work)

    def _calibration(self) -> None:
        said = ui.label().classes("text-sm").props('role="status"')
        data: list[tuple[str, str]] = []  # the path of the last upload, and its name

        async def uploaded(path: str, name: str) -> None:
            data[:] = [(path, name)]
            said.set_text(f"{name} is here, until the page is closed")

        upload_button(self._explorer, "Upload measured series, .csv", uploaded, said.set_text, 2**21)
        predicted = self._explorer.good.prediction is not None
        alone = "interface strength alone" if predicted else ""
        free = self._free_number("interfacial_shear_strength", "work_of_adhesion", alone=alone)

        def work(question: Query, progress: Progress) -> View:
            if not data:
                raise InputError("measured series", None, "a .csv file with load and what was measured at it")
            ((path, name),) = data
            try:
                return calibrated(question, self._load(question), Path(path), free(), progress)
            except InputError as error:
                raise InputError(error.field.replace(path, name), error.value, error.allowed) from None

        self._study("Calibrate", work)


def _address(number: Number) -> str:
    """Return where a number stands in the table of the contact or of the groups."""
    return ".".join(number.path[1:])


def _human_name(number: Number) -> str:
    """Return the label of a number, and of which body it is."""
    return ", ".join([label_of(number.path), *(ENDINGS[key] for key in number.path[1:-1] if key in ENDINGS)])


def _card(title: str, command: str) -> ui.card:
    with ui.card().classes("w-full") as card:
        ui.label(title).classes("text-lg")
        ui.label(command).classes("text-sm font-mono")
    return card
