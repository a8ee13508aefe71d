"""The tab Contact: the prediction of the case, or one model's result with its validity warnings, and curves along the load."""

from typing import Any

from nicegui import ui

from stiction.laws.validity import warnings_of
from stiction.records.claims import KINDS_OF_WARNING
from stiction.report.answer import answer_lines
from stiction.report.share_pictures import stacks
from stiction.web.asked import remarks
from stiction.web.charts import curve_chart, share_chart
from stiction.web.drawn import Picture, Rows, attributes
from stiction.web.explorer import Explorer

_ICONS = {
    "impossible": "block",
    "effect": "warning",
    "assumption": "help_outline",
    "fit": "straighten",
    "statistics": "scatter_plot",
}
_WITHIN = ("check_circle", "Within the ranges that the authors of its laws claim.")


class ContactTab:
    """Drawn anew with every answer."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._headline()
        with ui.row().classes("w-full items-center gap-4") as self._choices:
            ui.toggle({"load": "against load", "mean_separation": "against separation"}, value="load",
                      on_change=lambda event: self._look("against", event.value)).props("dense no-caps")  # fmt: skip
            self._point = ui.slider(min=0, max=1, value=0).classes("grow").style("min-width: 160px")
            self._point.props('dense aria-label="point of the curve described in words"')
            self._point.on("update:model-value", lambda event: self._look("here", int(event.args)), throttle=0.05)
            self._stack = ui.select([], label="shares of", on_change=self._draw).classes("w-64").props("dense outlined")
        with ui.grid().classes("charts w-full answer"):
            names = "friction_coefficient", "shares", "friction_force", "contact_area", "load"
            self._charts = {name: Picture(name.replace("_", " ")) for name in names}
        explorer.listen(self.show)
        self.show()

    def _headline(self) -> None:
        with ui.row().classes("w-full items-start gap-6 no-wrap-wide"):
            with ui.column().classes("gap-0 answer").props('role="status" aria-live="polite"'):
                self._number = ui.label().classes("text-3xl font-bold")
                self._where = ui.label().classes("text-sm where")
                self._old = ui.label("Of the last case that could be solved: see the field in red.").classes("text-negative")
            column = ui.column().classes("gap-1 grow text-sm answer").props('aria-label="what is doubtful"')
            self._doubts = Rows(column, _add_doubt)
        self._rows = Rows(ui.element("div").classes("w-full rows text-sm answer"), _add_row)
        ui.label("Computing: the numbers shown are of the case before.").classes("text-sm text-negative pending")
        with ui.expansion("What was computed").classes("w-full").props("dense"):
            self._remarks = Rows(ui.column().classes("gap-1 text-sm"), ui.label)

    def _look(self, name: str, value: Any) -> None:
        setattr(self._explorer.view, name, value)
        self._explorer.redraw()

    def show(self) -> None:
        """The newest answer; where it is an error, what was right before, and that it is old."""
        answer, here = self._explorer.good, self._explorer.here
        number, where = self._explorer.headline
        self._number.set_text(number)
        self._where.set_text(where)
        self._old.set_visibility(self._explorer.answer.error is not None)
        assert answer.data is not None
        doubts = [(_ICONS[one.kind], f"{KINDS_OF_WARNING[one.kind].capitalize()}: {one}") for one in warnings_of(answer.data)]
        predicted = answer.prediction is not None
        self._rows.show(answer_lines(answer.prediction)[1:] if answer.prediction is not None else [])
        self._doubts.show([] if predicted else doubts or [_WITHIN])
        self._remarks.show(remarks(answer))
        for one in (self._choices, self._doubts.element):
            one.set_visibility(not predicted)
        attributes(self._point, max=answer.curve["load"].size - 1, aria_valuetext=where)
        self._point.set_value(here)
        stacked = [] if predicted else list(stacks(answer.curve))
        if self._stack.options != stacked:
            self._stack.set_options(stacked, value=next(iter(stacked), None))
        self._stack.set_visibility(bool(stacked))
        self._draw()

    def _draw(self) -> None:
        """Draw results against load or separation, of a model that knows it, and shares; the load against the separation."""
        curve, view, here = self._explorer.good.curve, self._explorer.view, self._explorer.here
        separated = "mean_separation" if "mean_separation" in curve else "load"
        against = separated if view.against == "mean_separation" else "load"
        predicted = self._explorer.good.prediction is not None
        drawn = {"friction_coefficient": against, "contact_area": against}
        drawn |= {"friction_force": "load"} if predicted else {"load": separated}
        for name, chart in self._charts.items():
            there = name in curve and drawn.get(name, name) != name
            chart.show(curve_chart(curve, name, drawn[name], here, view.dark) if there else None)
        if self._stack.value:
            self._charts["shares"].show(share_chart(curve, self._stack.value, against, view.dark))


def _add_doubt(doubt: tuple[str, str]) -> None:
    icon, text = doubt
    with ui.row().classes("items-start gap-2 no-wrap"):
        ui.icon(icon).props('aria-hidden="true"')
        ui.label(text)


def _add_row(row: tuple[str, str]) -> None:
    head, text = row
    ui.label(head).classes("font-bold")
    ui.label(text)
