"""Build the summary card above the tabs: mu, its interval, confidence and sources of uncertainty; "Why" shows details."""

import re
from html import escape

import xarray
from nicegui import ui

from stiction.laws.validity import warnings_of
from stiction.quantities.shown import show
from stiction.records.claims import KINDS_OF_WARNING
from stiction.report.answer import answer_lines, at_working_load, confidence_in_words
from stiction.report.card import Card, card_of, shortened
from stiction.report.html_words import letters, unbroken
from stiction.studies.prediction.regime import without_commands
from stiction.web.background import Latest
from stiction.web.elements import Rows, folded
from stiction.web.explorer import Explorer
from stiction.web.query import Answer, predicted_beside, remarks

# What a click on a button in the card sends to the server.
_NAME_OF_TAB = "(event) => event.target.dataset.tab && emit(event.target.dataset.tab)"


class AnswerCard:
    """Show the newest answer in one card; if the case names a model, show the prediction in it as well.

    explorer: state of the visitor, whose answers are shown.
    """

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._before = explorer.answer
        self._beside: tuple[tuple[Answer, float], xarray.Dataset | None] | None = None
        self._predicted = Latest(_beside, self._show_beside)
        with ui.element("div").classes("w-full answer").props('role="status" aria-live="polite"'):
            self._card = ui.html("", sanitize=False).classes("where")
            self._card.on("click", lambda event: explorer.open_tab(event.args), js_handler=_NAME_OF_TAB)
            self._load_moved = ui.label().classes("text-sm")
            self._old = ui.label("This is the last answer without an error: see the field in red.").classes("text-negative")
        self._why = folded("Why", self._add_rows)
        self._why.on_value_change(self._draw)
        self._load_moved.set_visibility(False)
        explorer.listen(self.show)
        self.show()

    def show(self) -> None:
        """Show the newest answer; after an error keep the answer before it, marked as old."""
        answer = self._explorer.answer
        self._old.set_visibility(self._explorer.error is not None)
        if answer is not self._before:
            self._show_moved_load(answer)
        self._draw()
        wanted = answer, self._explorer.load
        if not answer.is_prediction and (self._beside is None or self._beside[0] != wanted):
            ui.timer(0.0, lambda: self._predicted.ask(*wanted), once=True)

    def _add_rows(self) -> None:
        self._rows = Rows(ui.element("div").classes("w-full rows text-sm answer"), _add_row)

    def _draw(self) -> None:
        answer, (number, where) = self._explorer.answer, self._explorer.headline
        number, prediction = letters(number), self._prediction(answer)
        named = "" if answer.is_prediction else f"{number} by {_model(answer)}"
        warnings = [] if answer.is_prediction else warnings_of(answer.data)
        if prediction is None:
            html = f'<div class="card"><p><span class="text-3xl font-bold">{escape(number)}</span> {escape(where)}</p></div>'
        else:
            card = card_on_page(prediction, named)
            html = (card._replace(warning=shortened(warnings[0].why)) if warnings else card).html(why=False)
            html = re.sub(r": (tab (\w+))", r': <button type="button" data-tab="\2">\1</button>', html)
        self._card.set_content(html)
        if self._why.value:  # rows that nobody sees would take time
            rows = [] if answer.is_prediction else [(_model(answer), where)]
            rows += [(KINDS_OF_WARNING[one.kind], str(one)) for one in warnings]
            rows += [] if prediction is None else answer_lines(prediction, terminal=False)[1:]
            self._rows.show([*rows, *(("computed", letters(one)) for one in remarks(answer))])

    def _prediction(self, answer: Answer) -> xarray.Dataset | None:
        """Return the prediction of a case or, if it names a model, the one beside its answer; None while that is missing."""
        if answer.is_prediction:
            return answer.data
        return self._beside[1] if self._beside is not None and self._beside[0] == (answer, self._explorer.load) else None

    def _show_beside(self, found: tuple[tuple[Answer, float], xarray.Dataset | None]) -> None:
        self._beside = found
        self._draw()

    def _show_moved_load(self, answer: Answer) -> None:
        """Tell the visitor that the load changed, if the case states separations and its contact was changed.

        answer: the newest answer.
        """
        pair, self._before = (self._before, answer), answer
        before, after = (one.query.tables for one in pair)
        solve = after.get("solve", {})
        moved = False
        if "contact" in after and "load" not in solve and solve == before.get("solve", {}):
            loads = [float(one.at(self._explorer.point)["load"]) for one in pair]
            moved = abs(loads[1] - loads[0]) > 1e-3 * abs(loads[0])
            was, now = (show(load, "load", 3) for load in loads)
            self._load_moved.set_text(f"The load changed from {was} to {now}, because the case states separations.")
        self._load_moved.set_visibility(moved)


def card_on_page(prediction: xarray.Dataset, named: str = "") -> Card:
    """Return the short summary card of a prediction for the page, which names tabs in place of commands.

    A warning is left out if the next step states the same. named: result of the model that the case names, as text, or "". With
    such a result, the card shows no sources of uncertainty and no next step, and names handbook contacts only as the reason for
    a low confidence.
    """
    card = card_of(at_working_load(prediction), named)  # without the range of loads: the form shows the load
    if named:
        return card._replace(decides="", next_step="", confidence=confidence_in_words(prediction))
    # the interval after a measurement stands below "Why"
    action = without_commands(str(prediction.attrs["next_step"]), ": tab Studies", ": tab Surface")
    repeated = action.startswith("state") and card.warning.removesuffix(" is not stated").lower() in action
    return card._replace(next_step=action, warning="" if repeated else card.warning)


def _model(answer: Answer) -> str:
    return str(answer.data.attrs["model"]).replace("_", " ")


def _beside(answer: Answer, load: float) -> tuple[tuple[Answer, float], xarray.Dataset | None]:
    return (answer, load), predicted_beside(answer, load)


def _add_row(row: tuple[str, str]) -> None:
    head, text = row
    ui.label(head).classes("font-bold")
    ui.label(unbroken(text))
