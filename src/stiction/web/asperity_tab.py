"""The tab One asperity: the stresses under it in section, where it yields first, film and body to scale."""

import math
from typing import Any

from nicegui import ui

from stiction.quantities.errors import InputError
from stiction.quantities.units import show
from stiction.studies.stresses.one_asperity import OneAsperity, one_asperity
from stiction.web.charts import COLOURS, cells, chart, line
from stiction.web.drawn import Picture
from stiction.web.explorer import Explorer
from stiction.web.working import Latest

__all__ = ["AsperityTab"]

_SHADES = ["#fde725", "#5ec962", "#21918c", "#3b528b", "#440154"]


class AsperityTab:
    """Drawn anew with every answer and every move of its two sliders."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._latest = Latest(self._work, self._show)
        self._said = ui.label().classes("text-lg").props('role="status" aria-live="polite"')
        self._more = ui.label().classes("text-sm")
        ui.label("contact radius over (R sigma)^(1/2), logarithmic").classes("text-sm")
        self._radius = ui.slider(min=-2.0, max=0.5, step=0.01, value=-0.5)
        self._radius.props('aria-label="contact radius over the root of R sigma, its logarithm"')
        ui.label("tangential force over normal force").classes("text-sm")
        self._traction = ui.slider(min=0.0, max=1.0, step=0.01, value=0.2).props('aria-label="tangential over normal force"')
        for slider in (self._radius, self._traction):
            slider.on("update:model-value", self._ask, throttle=0.05)
        self._picture = Picture("von Mises stress in section", "", 620)
        self._picture.element.classes("section")  # as high as its axes are to scale
        explorer.listen(self._again)

    async def opened(self) -> None:
        await self._ask()

    async def _ask(self) -> None:
        case = self._explorer.good.case
        await self._latest.ask(case, 10.0 ** float(self._radius.value), float(self._traction.value))

    def _again(self) -> None:
        ui.timer(0.0, self._ask, once=True)

    @staticmethod
    def _work(case: Any, radius: float, traction: float) -> OneAsperity | InputError:
        try:
            return one_asperity(case.subject, radius, traction)
        except InputError as error:
            return error

    def _show(self, found: OneAsperity | InputError) -> None:
        self._picture.show(None if isinstance(found, InputError) else _section_chart(found, self._explorer.view.dark))
        if isinstance(found, InputError):
            self._said.set_text(str(found))
            self._more.set_text("")
            return
        self._said.set_text(_in_words(found))
        self._more.set_text(self._sizes(found))

    def _sizes(self, found: OneAsperity) -> str:
        """Sizes in units, where the contact has them."""
        case = self._explorer.good.case
        assert case is not None
        pressure = f"mean pressure {found.pressure:.3g} of the hardness of the bodies"
        rough = getattr(case.subject, "roughness", None)
        if rough is None:
            return f"Load {found.load:.3g} K R^(1/2) sigma^(3/2), {pressure}; elastic, without adhesion."
        root = math.sqrt(rough.asperity_radius * rough.asperity_height_deviation)
        load = found.load * case.subject.scales().load
        radius = found.radius * root
        stress = show(load / (math.pi * radius**2), "nominal_pressure", 3)
        return (f"Contact radius {show(radius, 'mean_separation', 3)}, load {show(load, 'load', 3)}, {pressure}, {stress}; "
                "elastic, without adhesion.")  # fmt: skip


def _in_words(found: OneAsperity) -> str:
    place = f"first in the {found.where}, at x = {found.at[0]:.2f} a, z = {found.at[1]:.2f} a"
    if found.largest >= 1.0:
        return f"It has yielded, {place}: an elastic stress would be {found.largest:.3g} times the yield stress."
    return f"Elastic: the largest stress is {found.largest:.3g} of the yield stress, {place}."


def _section_chart(found: OneAsperity, dark: bool) -> dict[str, Any]:
    """The stress in colours over the section, depth downwards, lengths over the contact radius on both axes alike."""
    points = [[float(x), float(z), float(value)] for z, row in zip(found.z, found.stress, strict=True)
              for x, value in zip(found.x, row, strict=True)]  # fmt: skip
    half = [float(values[1] - values[0]) / 2.0 for values in (found.x, found.z)]
    series: list[dict[str, Any]] = [
        cells("stress", points, *((f"it - {one!r}", f"it + {one!r}") for one in half)),  # type: ignore[arg-type]  # two of them
        line("contact", [-1.0, 1.0], [0.0, 0.0], 1, z=4),
        {"name": "largest stress", "type": "scatter", "symbol": "pin", "symbolSize": 30, "data": [list(found.at)], "z": 6,
         "itemStyle": {"color": COLOURS[3]}},
    ]  # fmt: skip
    if found.thickness <= found.z[-1]:
        ends = [float(found.x[0]), float(found.x[-1])]
        series.append(line("lower face of the film", ends, [found.thickness] * 2, 5, z=5))
    x = {"name": "x/a, in the direction of the tangential force", "min": float(found.x[0]), "max": float(found.x[-1])}
    y = {"name": "depth z/a", "inverse": True, "min": 0.0, "max": float(found.z[-1])}
    options = chart("von Mises stress over yield stress under one asperity", x, y, series, dark)
    options["legend"]["data"] = [one["name"] for one in series[1:]]
    options["tooltip"]["trigger"] = "item"
    options["grid"]["right"] = 96
    most = max(float(found.stress.max()), 1e-12)
    options["visualMap"] = {"min": 0.0, "max": most, "dimension": 2, "seriesIndex": 0, "right": 0, "top": "middle",
                            "calculable": True, "align": "left", "precision": 3, "inRange": {"color": _SHADES},
                            "text": ["stress/yield", ""], "textStyle": options["textStyle"]}  # fmt: skip
    return options
