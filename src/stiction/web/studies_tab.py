"""The tab Studies: how sure, what to measure better, design for a wish, calibration; those that take less than a minute."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from nicegui import ui

from stiction.case.read import case_in
from stiction.quantities.errors import InputError
from stiction.web.asked import Question, case_asked
from stiction.web.drawn import attributes
from stiction.web.explorer import Explorer
from stiction.web.fields import Number, got, numbers_of, parts_of, placed
from stiction.web.pictures import image_of, show_image, text_of
from stiction.web.studying import Study
from stiction.web.uploading import upload_button
from stiction.web.working import Progress

if TYPE_CHECKING:
    from stiction.report.view import View

__all__ = ["Result", "StudiesTab", "calibrated", "designed", "how_sure", "what_matters"]


class Result(NamedTuple):
    """What a study shows: text as of the terminal, images, each with what it shows in words, and what is wrong with it."""

    text: str
    pictures: tuple[tuple[str, str], ...]
    warnings: tuple[str, ...]

    @classmethod
    def of(cls, view: "View", narrow: bool) -> "Result":
        """For a narrow page or a wide one."""
        images = tuple((image_of(picture.draw(), narrow), picture.told) for picture in view.pictures.values())
        return cls(text_of(view.parts()), images, view.warnings)


def how_sure(question: Question, ranges: bool, progress: Progress) -> "View":
    """The bands of what is uncertain, and what friction differs by. Raises InputError."""
    from stiction.report.views.uncertainty import uncertainty_view
    from stiction.studies.answered import uncertainty

    return uncertainty_view(uncertainty(_with_ranges(question, ranges), progress=progress))


def what_matters(question: Question, ranges: bool, progress: Progress) -> "View":
    """Which input should be measured better. Raises InputError."""
    from stiction.report.views.sensitivity import sensitivity_view
    from stiction.studies.sensitivity.run import sensitivity

    return sensitivity_view(sensitivity(_with_ranges(question, ranges), progress=progress))


def _with_ranges(question: Question, ranges: bool) -> Any:
    case_asked(question)  # refuses what is too large
    tables = question.tables
    if ranges:
        tables = {**tables, "uncertainty": {**tables.get("uncertainty", {}), "ranges": True}}
    return case_in(tables, question.folder)


def designed(
    question: Question, load: str | float, wish: float, free: dict[tuple[str, ...], Any], progress: Progress
) -> "View":
    """The numbers, between their ends, at which the friction coefficient is next to a wish at a load. Raises InputError."""
    from stiction.report.views.design import design_view
    from stiction.studies.design.plan import make_design_plan
    from stiction.studies.design.run import run_design

    case_asked(question)
    if not 0.0 < wish < math.inf:
        raise InputError("wished mu", wish, "a number above 0")
    solve = {name: one for name, one in question.tables.get("solve", {}).items() if name not in ("load", "separation")}
    table = {
        "wish": {"target": "friction_coefficient", "value": wish},
        "choose": _nested(free),
        "validity": "possible",
        "effort": 30,
    }
    tables = {**question.tables, "solve": {**solve, "load": [load]}, "design": table}
    return design_view(run_design(make_design_plan(tables, question.folder), progress.tell))


def calibrated(question: Question, data: Path, free: dict[tuple[str, ...], Any], progress: Progress) -> "View":
    """Numbers of the case, fitted to measured series. Raises InputError."""
    from stiction.report.views.fit import fit_view
    from stiction.studies.fit.plan import make_fit_plan
    from stiction.studies.fit.run import run_fit

    case_asked(question)
    plan = make_fit_plan({**question.tables, "fit": {"free": _nested(free)}}, data, question.folder)
    return fit_view(run_fit(plan, progress))


def _nested(free: dict[tuple[str, ...], Any]) -> dict[str, Any]:
    """Tables as [design.choose] and [fit.free] have them: places without the name of the subject."""
    tables: dict[str, Any] = {}
    for path, ends in free.items():
        tables = placed(tables, path[1:], ends)
    return tables


class StudiesTab:
    """A card for each study."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._data: Path | None = None
        self._named = ""
        ui.label("A study stops here after a minute; run the command shown to complete it.").classes("text-sm")
        self._sure()
        self._design()
        self._calibration()

    def _card(self, title: str, command: str) -> Any:
        card = ui.card().classes("w-full")
        with card:
            ui.label(title).classes("text-lg")
            ui.label(command).classes("text-sm font-mono")
        return card

    def _study(self, label: str, work: "Callable[[Progress], View]") -> None:
        view = self._explorer.view

        def result(progress: Progress) -> Result:
            return Result.of(work(progress), view.narrow)

        Study(self._explorer, label, result, lambda found: self._show(below, found))
        below = ui.column().classes("w-full")

    @staticmethod
    def _show(below: Any, found: Result) -> None:
        below.clear()
        with below:
            for words in found.warnings:
                ui.label(words).classes("text-lg text-negative").props('role="alert"')
            ui.label(found.text).classes("font-mono text-xs w-full overflow-auto").style("white-space: pre").props("tabindex=0")
            for source, told in found.pictures:
                show_image(source, told)

    def _sure(self) -> None:
        with self._card("How sure, and what to measure better", "stiction run case.toml; stiction sensitivity case.toml"):
            vary = "numbers of materials vary within their ranges"
            ranges = attributes(ui.switch(vary, value=True), aria_label=vary)
            self._study("Uncertainty", lambda progress: how_sure(self._explorer.good.question, ranges.value, progress))
            self._study("Sensitivity", lambda progress: what_matters(self._explorer.good.question, ranges.value, progress))

    def _places(self) -> dict[str, Number]:
        """The single numbers of the case by their names."""
        tables = self._explorer.good.question.tables
        found = {}
        for part in parts_of(tables):
            for number in numbers_of(part):
                if number.si(got(tables, number.path)) is not None:
                    found[".".join(number.path[1:])] = number
        return found

    def _choice(self) -> tuple[Any, Any, Any]:
        """Which number is free, between which ends."""
        names = list(self._places())
        with ui.row().classes("items-center gap-2 w-full"):
            which = ui.select(names, value=names[0] if names else None, label="free number").classes("w-72")
            low, high = (ui.input(label).classes("w-28") for label in ("from", "to"))
            for one in (which, low, high):
                one.props("dense outlined")

        def filled() -> None:
            number = self._places().get(which.value)
            if number is not None:
                value = number.si(got(self._explorer.good.question.tables, number.path)) or 0.0
                low.set_value(number.text(value / 3.0))
                high.set_value(number.text(min(3.0 * value, 0.99 * number.quantity.upper)))

        which.on_value_change(filled)
        filled()
        return which, low, high

    def _ends(self, choice: tuple[Any, Any, Any]) -> dict[tuple[str, ...], Any]:
        which, low, high = choice
        number = self._places().get(which.value)
        if number is None:
            raise InputError("free number", which.value, "a number of the case")
        return {number.path: {"low": number.written(str(low.value)), "high": number.written(str(high.value))}}

    def _design(self) -> None:
        with self._card("Design for a friction coefficient", "stiction design case.toml, with a table [design]"):
            wish = ui.number("wished mu", value=0.1, min=0.0, format="%.4g").props("dense outlined")
            choice = self._choice()

            def work(progress: Progress) -> "View":
                answer = self._explorer.good
                if wish.value is None:
                    raise InputError("wished mu", None, "a number above 0")
                load: Any = float(answer.curve["load"].values.reshape(-1)[self._explorer.here])
                load = load if "indices" in answer.question.tables else f"{load!r} N"
                return designed(answer.question, load, float(wish.value), self._ends(choice), progress)

            self._study("Design", work)

    def _calibration(self) -> None:
        with self._card("Calibration on measured series", "stiction fit case.toml --data measured.csv, with a table [fit]"):
            said = ui.label().classes("text-sm").props('role="status"')

            async def uploaded(path: str, name: str) -> None:
                self._data, self._named = Path(path), name
                said.set_text(f"{name} is here, until the page is closed")

            upload_button(self._explorer, "Upload measured series, .csv", uploaded, said.set_text, 2**21)
            choice = self._choice()

            def work(progress: Progress) -> "View":
                if self._data is None:
                    raise InputError("measured series", None, "a .csv file with load and what was measured at it")
                try:
                    return calibrated(self._explorer.good.question, self._data, self._ends(choice), progress)
                except InputError as error:
                    raise InputError(error.field.replace(str(self._data), self._named), error.value, error.allowed) from None

            self._study("Calibrate", work)
