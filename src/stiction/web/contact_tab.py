"""The tab Contact: the prediction of the case, or one model's result with its validity warnings, and curves along the load."""

from typing import Any

from nicegui import ui

from stiction.report.answer import answer_lines
from stiction.web.charts import curve_chart, prediction_chart, share_chart, stacks
from stiction.web.drawn import Picture, attributes
from stiction.web.explorer import Explorer
from stiction.web.words import doubt_in_words, remarks

__all__ = ["ContactTab"]

_ICONS = {
    "impossible": "block",
    "effect": "warning",
    "assumption": "help_outline",
    "fit": "straighten",
    "statistics": "scatter_plot",
}


class ContactTab:
    """Drawn anew with every answer."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._kinds: list[str] = []
        self._texts: list[ui.label] = []
        self._told: list[str] = []
        self._rows_told: list[tuple[str, str]] = []
        self._headline()
        with ui.row().classes("w-full items-center gap-4") as self._choices:
            ui.toggle({"load": "against load", "mean_separation": "against separation"}, value="load",
                      on_change=self._against).props("dense no-caps")  # fmt: skip
            self._point = ui.slider(min=0, max=1, value=0).classes("grow").style("min-width: 160px")
            self._point.props('dense aria-label="point of the curve described in words"')
            self._point.on("update:model-value", self._moved, throttle=0.05)
            self._stack = ui.select([], label="shares of", on_change=self._stacked).classes("w-64").props("dense outlined")
        with ui.grid().classes("charts w-full answer"):
            self._mu = Picture("friction coefficient")
            self._shares = Picture("shares")
            self._force = Picture("friction force")
            self._area = Picture("contact area")
            self._load = Picture("load")
        explorer.listen(self.show)
        self.show()

    def _headline(self) -> None:
        with ui.row().classes("w-full items-start gap-6 no-wrap-wide"):
            with ui.column().classes("gap-0 answer").props('role="status" aria-live="polite"'):
                self._number = ui.label().classes("text-3xl font-bold")
                self._where = ui.label().classes("text-sm where")
                self._old = ui.label("Of the last case that could be solved: see the field in red.").classes("text-negative")
            self._doubts = ui.column().classes("gap-1 grow text-sm answer").props('aria-label="what is doubtful"')
        self._rows = ui.element("div").classes("w-full rows text-sm answer")
        ui.label("Computing: the numbers shown are of the case before.").classes("text-sm text-negative pending")
        with ui.expansion("What was computed").classes("w-full").props("dense"):
            self._remarks = ui.column().classes("gap-1 text-sm")

    def _against(self, event: Any) -> None:
        self._explorer.view.against = event.value
        self._explorer.redraw()

    def _moved(self, event: Any) -> None:
        self._explorer.view.here = int(event.args)
        self._explorer.redraw()

    def _stacked(self, event: Any) -> None:
        self._explorer.view.stack = event.value or ""
        self._draw()

    def show(self) -> None:
        """The newest answer; where it is an error, what was right before, and that it is old."""
        answer, here = self._explorer.good, self._explorer.here
        number, where = self._explorer.headline
        self._number.set_text(number)
        self._where.set_text(where)
        self._old.set_visibility(self._explorer.answer.error is not None)
        self._tell()
        for one in (self._choices, self._doubts):
            one.set_visibility(answer.prediction is None)
        last = answer.curve["load"].size - 1
        attributes(self._point, max=last, aria_valuetext=where)
        self._point.set_value(here)
        self._draw()

    def _tell(self) -> None:
        """Doubts and remarks. While a knob moves it is mostly their numbers that change: then only these are sent."""
        answer = self._explorer.good
        self._tell_rows([] if answer.prediction is None else answer_lines(answer.prediction)[1:])
        doubts = [] if answer.prediction is not None else answer.doubts() or [("", "")]
        kinds = [kind for kind, _ in doubts]
        if kinds != self._kinds:
            self._kinds = kinds
            self._doubts.clear()
            with self._doubts:
                self._texts = [self._doubt(kind) for kind in kinds]
        for label, (kind, text) in zip(self._texts, doubts, strict=True):
            label.set_text(doubt_in_words(kind, text) if kind else "Within the ranges that the authors of its laws claim.")
        said = remarks(answer)
        if said != self._told:
            self._told = said
            self._remarks.clear()
            with self._remarks:
                for one in said:
                    ui.label(one)

    def _tell_rows(self, rows: list[tuple[str, str]]) -> None:
        """Show the rows of a prediction; none of one model."""
        if rows == self._rows_told:
            return
        self._rows_told = rows
        self._rows.clear()
        with self._rows:
            for head, text in rows:
                ui.label(head).classes("font-bold")
                ui.label(text)

    @staticmethod
    def _doubt(kind: str) -> ui.label:
        with ui.row().classes("items-start gap-2 no-wrap"):
            ui.icon(_ICONS.get(kind, "check_circle")).props('aria-hidden="true"')
            return ui.label()

    def _draw(self) -> None:
        curve, view, here = self._explorer.good.curve, self._explorer.view, self._explorer.here
        if self._explorer.good.prediction is not None:
            self._draw_prediction()
            return
        self._force.show(None)
        against = view.against if view.against in curve else "load"
        for picture, name in ((self._mu, "friction_coefficient"), (self._area, "contact_area"), (self._load, "load")):
            other = "mean_separation" if name == "load" and "mean_separation" in curve else against
            picture.show(curve_chart(curve, name, other, here, view.dark) if name in curve and other != name else None)
        known = stacks(curve)
        stack = view.stack if view.stack in known else next(iter(known), "")
        if self._stack.options != list(known):
            self._stack.set_options(list(known), value=stack or None)
        self._stack.set_visibility(bool(known))
        self._shares.show(share_chart(curve, stack, against, view.dark) if stack else None)

    def _draw_prediction(self) -> None:
        """Draw medians with their bands along the load."""
        curve, dark = self._explorer.good.curve, self._explorer.view.dark
        drawn = (self._mu, "friction_coefficient"), (self._force, "friction_force"), (self._area, "contact_area")
        for picture, name in drawn:
            picture.show(prediction_chart(curve, name, dark))
        for picture in (self._load, self._shares):
            picture.show(None)
