"""Build the tab Contact: curves over load or separation, with the interval of a prediction or the parts of one model."""

from typing import Any

from nicegui import ui

from stiction.report.share_pictures import stacks
from stiction.web.charts import curve_chart, curve_legend, share_chart
from stiction.web.elements import Picture, attributes
from stiction.web.explorer import Explorer


class ContactTab:
    """Draw the curves of the current answer, and redraw them after every new one."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        with ui.row().classes("w-full items-center gap-4") as self._choices:
            ui.toggle({"load": "load", "mean_separation": "separation"}, value="load",
                      on_change=lambda event: self._look("against", event.value)).props("dense no-caps")  # fmt: skip
            self._point = ui.slider(min=0, max=1, value=0).style("flex: 1 1 160px; width: auto")
            self._point.props('dense aria-label="working load of the answer"')
            self._point.on("update:model-value", lambda event: self._look("point", int(event.args)), throttle=0.05)
            self._stack = ui.select([], label="shares", on_change=self._draw).classes("w-64").props("dense outlined")
        self._legend = ui.html("", sanitize=False).classes("w-full")
        with ui.grid().classes("charts w-full answer") as self._grid:
            names = "friction_coefficient", "shares", "friction_force", "contact_area", "load"
            self._charts = {name: Picture(name.replace("_", " ")) for name in names}
        self._one = ui.label(
            "The case has one load: the bar above shows the interval of mu. Enter a range of loads under Points of the curve."
        )
        explorer.listen(self.show)
        self.show()

    def _look(self, name: str, value: Any) -> None:
        setattr(self._explorer.view, name, value)
        self._explorer.redraw()

    def show(self) -> None:
        """Draw the curves of the newest answer that has no error."""
        answer = self._explorer.answer
        self._choices.set_visibility(not answer.is_prediction)
        attributes(self._point, max=answer.curve["load"].size - 1, aria_valuetext=self._explorer.headline[1])
        self._point.set_value(self._explorer.point)
        stacked = [] if answer.is_prediction else list(stacks(answer.curve))
        if self._stack.options != stacked:
            self._stack.set_options(stacked, value=next(iter(stacked), None))
        self._stack.set_visibility(bool(stacked))
        self._draw()

    def _draw(self) -> None:
        answer, view, point = self._explorer.answer, self._explorer.view, self._explorer.point
        curve, drawn = answer.curve, {}
        alone = curve["load"].size == 1
        self._one.set_visibility(alone)
        if not alone:
            separated = "mean_separation" if "mean_separation" in curve else "load"
            against = separated if view.against == "mean_separation" else "load"
            axes = {"friction_coefficient": against, "contact_area": against}
            axes |= {"friction_force": "load"} if answer.is_prediction else {"load": separated}
            there = {name: x for name, x in axes.items() if name in curve and name != x}
            drawn = {name: curve_chart(curve, name, x, point, view.dark) for name, x in there.items()}
            if self._stack.value:
                drawn["shares"] = share_chart(curve, self._stack.value, against, view.dark)
        self._legend.set_content("" if alone else curve_legend(curve, view.dark))
        self._grid.classes(**{"add" if answer.is_prediction else "remove": "of-three"})
        for name, chart in self._charts.items():
            chart.show(drawn.get(name))
