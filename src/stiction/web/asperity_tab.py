"""Build the tab "One asperity": stresses below the asperity, first yield, and the film to scale."""

import math
from typing import Any

from nicegui import ui

from stiction.quantities.shown import show
from stiction.studies.stresses.one_asperity import OneAsperity, one_asperity
from stiction.web.background import Latest
from stiction.web.charts import COLOURS, SHADES, add_cells, chart, line, mark
from stiction.web.elements import Picture, attributes
from stiction.web.explorer import Explorer


class AsperityTab:
    """Draw the stresses under one asperity after each computed result and each move of the two sliders.

    The sliders set the contact radius and the ratio of tangential to normal force.
    """

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._latest = Latest(one_asperity, self._show, self._refuse)
        self._answer = ui.label().classes("text-lg").props('role="status" aria-live="polite"')
        self._sizes = ui.label().classes("text-sm")
        self._radius = self._slider("contact radius over √(Rσ), logarithmic", -2.0, 0.5, -0.5)
        self._traction = self._slider("tangential force over normal force", 0.0, 1.0, 0.2)
        self._picture = Picture("von Mises stress in section", "", 620)
        self._picture.element.classes("section")  # this class sets a height at which both axes have the same scale
        explorer.listen(lambda: ui.timer(0.0, self.opened, once=True))

    def _slider(self, label: str, low: float, high: float, value: float) -> ui.slider:
        ui.label(label).classes("text-sm")
        slider = attributes(ui.slider(min=low, max=high, step=0.01, value=value), aria_label=label)
        return slider.on("update:model-value", self.opened, throttle=0.05)

    async def opened(self) -> None:
        """Compute and show the stresses under an asperity of the newest case, for the values of both sliders."""
        subject = self._explorer.answer.case.subject
        await self._latest.ask(subject, 10.0 ** float(self._radius.value), float(self._traction.value))

    def _refuse(self, error: Exception) -> None:
        self._picture.show(None)
        self._answer.set_text(str(error))
        self._sizes.set_text("")

    def _show(self, found: OneAsperity) -> None:
        self._picture.show(_section_chart(found, self._explorer.view.dark))
        place = f"in the {found.where}, at x = {found.at[0]:.2f} a, z = {found.at[1]:.2f} a"
        if found.largest >= 1.0:
            text = f"Yielded, first {place}: the largest elastic stress would be {found.largest:.3g} times the yield stress."
        else:
            text = f"Elastic: the largest stress is {found.largest:.3g} times the yield stress, {place}."
        self._answer.set_text(text)
        self._sizes.set_text(self._sizes_of(found))

    def _sizes_of(self, found: OneAsperity) -> str:
        """Return contact radius, load and mean pressure of the asperity as text, with units if the contact has units."""
        subject: Any = self._explorer.answer.case.subject
        pressure = f"mean pressure {found.pressure:.3g} times the hardness of the bodies"
        rough = getattr(subject, "roughness", None)
        if rough is None:
            return f"Load {found.load:.3g} K √R σ√σ, {pressure}; elastic, without adhesion."
        radius = found.radius * math.sqrt(rough.asperity_radius * rough.asperity_height_deviation)
        load = found.load * subject.scales().load
        stress = show(load / (math.pi * radius**2), "nominal_pressure", 3)
        return (f"Contact radius {show(radius, 'mean_separation', 3)}, load {show(load, 'load', 3)}, {pressure}, {stress}; "
                "elastic, without adhesion.")  # fmt: skip


def _section_chart(found: OneAsperity, dark: bool) -> dict[str, Any]:
    """Return a chart with the stress in a cross-section below the asperity in colours, depth downwards and equal scales.

    found: stresses under the asperity. dark: whether the page is dark.
    """
    ends = [float(found.x[0]), float(found.x[-1])]
    series = [line("contact", [-1.0, 1.0], [0.0, 0.0], 1, z=4), mark("largest stress", found.at, "pin", 30, COLOURS[3])]
    if found.thickness <= found.z[-1]:
        series.append(line("lower face of the film", ends, [found.thickness] * 2, 5, z=5))
    x = {"name": "x/a, in the direction of the tangential force", "min": ends[0], "max": ends[1]}
    y = {"name": "depth z/a", "inverse": True, "min": 0.0, "max": float(found.z[-1])}
    options = chart("von Mises stress over yield stress under one asperity", x, y, series, dark)
    options["tooltip"]["trigger"] = "item"
    most = max(float(found.stress.max()), 1e-12)
    add_cells(options, "stress", found.x, found.z, found.stress.T, (most, "stress/yield", ""))
    options["visualMap"]["inRange"] = {"color": SHADES[::-1]}
    return options
