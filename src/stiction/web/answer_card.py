"""The answer card on top of every tab: mu, its interval, how sure it is, what decides it; "why" unfolds the rest."""

from html import escape

import xarray
from nicegui import ui

from stiction.laws.validity import warnings_of
from stiction.quantities.units import show
from stiction.records.claims import KINDS_OF_WARNING
from stiction.report.answer import answer_lines
from stiction.report.card import Card, briefly, card_of
from stiction.report.html_words import letters
from stiction.web.asked import Answer, predicted_beside, remarks
from stiction.web.drawn import Rows
from stiction.web.explorer import Explorer
from stiction.web.working import Latest


class AnswerCard:
    """Drawn anew with every answer; where a model is named, the prediction is asked for beside it."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._before = explorer.good
        self._beside: tuple[Answer, xarray.Dataset | None] | None = None
        self._predicted = Latest(_beside, self._show_beside)
        with ui.element("div").classes("w-full answer").props('role="status" aria-live="polite"'):
            self._card = ui.html("", sanitize=False).classes("where")
            self._load_moved = ui.label().classes("text-sm")
            self._old = ui.label("Of the last case that could be solved: see the field in red.").classes("text-negative")
        with ui.expansion("Why").classes("w-full").props("dense dense-toggle"):
            self._rows = Rows(ui.element("div").classes("w-full rows text-sm answer"), _add_row)
        self._load_moved.set_visibility(False)
        explorer.listen(self.show)
        self.show()

    def show(self) -> None:
        """The newest answer; where it is an error, what was right before, and that it is old."""
        answer = self._explorer.good
        self._old.set_visibility(self._explorer.answer.error is not None)
        if answer is not self._before:
            self._tell_load(answer)
        self._draw()
        if answer.prediction is None and (self._beside is None or self._beside[0] is not answer):
            ui.timer(0.0, lambda: self._predicted.ask(answer, self._explorer.load), once=True)

    def _draw(self) -> None:
        answer = self._explorer.good
        beside = self._beside[1] if self._beside is not None and self._beside[0] is answer else None
        number, where = self._explorer.headline
        number = letters(number)
        warnings = [] if answer.prediction is not None or answer.data is None else warnings_of(answer.data)
        said = [] if answer.prediction is not None else [(_model(answer), where)]
        said += [(KINDS_OF_WARNING[one.kind], str(one)) for one in warnings]
        predicted = answer.prediction if answer.prediction is not None else beside
        if predicted is None:
            html = f'<div class="card"><p><span class="text-3xl font-bold">{escape(number)}</span> {escape(where)}</p></div>'
        else:
            card = card_on_page(predicted, "" if answer.prediction is not None else f"{number} by {_model(answer)}")
            if warnings:
                card = card._replace(warning=briefly(warnings[0].why))
            html = card.html(why=False)
            said += answer_lines(predicted)[1:]
        self._card.set_content(html)
        self._rows.show([*said, *(("computed", one) for one in remarks(answer))])

    def _show_beside(self, found: tuple[Answer, xarray.Dataset | None]) -> None:
        self._beside = found
        self._draw()

    def _tell_load(self, answer: Answer) -> None:
        """Say that the load moved, where separations are given and the contact changed."""
        before, self._before = self._before, answer
        tables = [one.question.tables for one in (before, answer)]
        given = [one.get("solve", {}) for one in tables]
        loads = [float(one.at(self._explorer.here)["load"]) for one in (before, answer)] if given[0] == given[1] else [0.0, 0.0]
        moved = "contact" in tables[1] and "load" not in given[1] and abs(loads[1] - loads[0]) > 1e-3 * abs(loads[0])
        if moved:
            was, now = (show(load, "load", 3) for load in loads)
            self._load_moved.set_text(f"The load moved from {was} to {now}: the separations are given.")
        self._load_moved.set_visibility(moved)


def card_on_page(prediction: xarray.Dataset, named: str = "") -> Card:
    """Return the answer card; its next step names a tab in place of a command, as a visitor has no case file."""
    card = card_of(prediction, named)
    action, command, _ = card.next_step.partition(": stiction fit")
    return card._replace(next_step=f"{action} and enter it in Studies, Calibration") if command else card


def _beside(answer: Answer, load: float) -> tuple[Answer, xarray.Dataset | None]:
    return answer, predicted_beside(answer, load)


def _model(answer: Answer) -> str:
    return str(answer.data.attrs["model"]).replace("_", " ") if answer.data is not None else ""


def _add_row(row: tuple[str, str]) -> None:
    head, text = row
    ui.label(head).classes("font-bold")
    ui.label(text)
