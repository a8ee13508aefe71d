"""The tab Contact: curves along the load, with the interval of a prediction, or the shares of one model."""

from typing import Any

from nicegui import ui

from stiction.report.share_pictures import stacks
from stiction.web.charts import curve_chart, share_chart
from stiction.web.drawn import Picture, attributes
from stiction.web.explorer import Explorer


class ContactTab:
    """Drawn anew with every answer."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        with ui.row().classes("w-full items-center gap-4") as self._choices:
            ui.toggle({"load": "against load", "mean_separation": "against separation"}, value="load",
                      on_change=lambda event: self._look("against", event.value)).props("dense no-caps")  # fmt: skip
            self._point = ui.slider(min=0, max=1, value=0).style("flex: 1 1 160px; width: auto")
            self._point.props('dense aria-label="working load of the answer"')
            self._point.on("update:model-value", lambda event: self._look("here", int(event.args)), throttle=0.05)
            self._stack = ui.select([], label="shares of", on_change=self._draw).classes("w-64").props("dense outlined")
        with ui.grid().classes("charts w-full answer"):
            names = "friction_coefficient", "shares", "friction_force", "contact_area", "load"
            self._charts = {name: Picture(name.replace("_", " ")) for name in names}
        self._one = ui.label("One load: the bar above is its interval. Ask for a range of loads under Points of the curve.")
        explorer.listen(self.show)
        self.show()

    def _look(self, name: str, value: Any) -> None:
        setattr(self._explorer.view, name, value)
        self._explorer.redraw()

    def show(self) -> None:
        """The newest answer that was right."""
        answer = self._explorer.good
        predicted = answer.prediction is not None
        self._choices.set_visibility(not predicted)
        attributes(self._point, max=answer.curve["load"].size - 1, aria_valuetext=self._explorer.headline[1])
        self._point.set_value(self._explorer.here)
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
        alone = curve["load"].size == 1
        self._one.set_visibility(alone)
        drawn = {"friction_coefficient": against, "contact_area": against}
        drawn |= {"friction_force": "load"} if predicted else {"load": separated}
        for name, chart in self._charts.items():
            there = not alone and name in curve and drawn.get(name, name) != name
            chart.show(curve_chart(curve, name, drawn[name], here, view.dark) if there else None)
        if self._stack.value and not alone:
            self._charts["shares"].show(share_chart(curve, self._stack.value, against, view.dark))
