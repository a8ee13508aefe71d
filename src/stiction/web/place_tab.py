"""The tab Where am I: the plane of the adhesion indices with the contact in it; claims and figures of the 2015 paper."""

from functools import cache
from typing import Any

import numpy as np
from nicegui import ui

from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.studies.paper.claims import CLAIMS, LAM, READINGS, THETA, ClaimMap, claim_map
from stiction.studies.paper.figures import PANELS, PanelCurves, panel_curves
from stiction.studies.paper.place import ADHESION_MATTERS, PLASTICITY, Place, place_of, plasticity_line
from stiction.web.charts import COLOURS, axis_name, cells, chart, line
from stiction.web.drawn import Picture
from stiction.web.explorer import Explorer
from stiction.web.studying import Study
from stiction.web.working import run

__all__ = ["PlaceTab"]

_NO_CLAIM = "none"
_INDICES = (40.0, 10.0)  # of the figures, which the paper does not print; those at which its claims show
_SHADES = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"]  # viridis, dark to light for everybody
_kept: dict[str, ClaimMap] = {}  # the same for everybody: it depends on nothing that a visitor says


@cache
def _panel(at: int, reading: str) -> PanelCurves:
    return panel_curves(PANELS[at], *_INDICES, reading)


class PlaceTab:
    """The plane, drawn anew with every answer; the figures, as they are chosen."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._said = ui.label().props('role="status" aria-live="polite"')
        with ui.row().classes("items-center gap-3"):
            claims = {_NO_CLAIM: "no claim"} | {one.key: f"({one.key}) {one.says}" for one in CLAIMS}
            self._claim = ui.select(claims, value=_NO_CLAIM, label="claim of the 2015 paper", on_change=self._claimed)
            self._claim.classes("w-80").props("dense outlined")
            self._reading = ui.toggle(list(READINGS), value=READINGS[0], on_change=self._again).props("dense no-caps")
        self._study = Study(None, "Judge the claims in the plane", self._judged, lambda _: self.show())
        self._plane = Picture("plane of the adhesion indices", "460px", 620)
        ui.label("Figures of the 2015 paper").classes("text-lg")
        with ui.row().classes("items-center gap-3"):
            self._figure = ui.select({at: one.figure for at, one in enumerate(PANELS)}, value=0, on_change=self._again)
            self._figure.props('dense outlined aria-label="figure"')
            ui.button("Open as the case", on_click=self._open).props("no-caps outline")
        self._curves = Picture("figure of the paper", "360px", 620)
        self._caption = ui.label().classes("text-sm")
        explorer.listen(self.show)

    async def opened(self) -> None:
        self.show()
        await self._again()

    async def _again(self) -> None:
        self.show()
        curves = await run(_panel, self._figure.value, self._reading.value)
        self._caption.set_text(curves.caption)
        self._curves.show(_panel_chart(curves, self._explorer.view.dark))

    async def _claimed(self) -> None:
        if self._claim.value != _NO_CLAIM and "map" not in _kept:
            await self._study.start()
        self.show()

    def _judged(self, progress: Any) -> None:
        if "map" not in _kept:
            _kept["map"] = claim_map(progress=progress("Judging the claims"))

    def show(self) -> None:
        """The plane with the newest contact."""
        case = self._explorer.good.case
        assert case is not None
        try:
            place = place_of(case.subject)
        except InputError as error:
            place = None
            self._said.set_text(str(error))
        if place is not None:
            self._said.set_text(_in_words(place))
        self._plane.show(_plane_chart(place, self._share(), self._explorer.view.dark))

    def _share(self) -> tuple[str, np.ndarray] | None:
        """The claim that is shown, and the share (theta, lambda) of its cases for which it holds."""
        found = next((at for at, one in enumerate(CLAIMS) if one.key == self._claim.value), None)
        if found is None or "map" not in _kept:
            return None
        return CLAIMS[found].says, _kept["map"].share[found, READINGS.index(self._reading.value)]

    async def _open(self) -> None:
        panel = PANELS[self._figure.value]
        theta, lam = _INDICES
        indices = {"theta": theta, "lam": lam, **panel.fixed, panel.along: list(panel.values)}
        solve = {"separation": {"start": 4, "stop": -4, "count": 81}, "reading": self._reading.value}
        await self._explorer.ask({"title": f"{panel.figure} of the 2015 paper", "indices": indices, "solve": solve})
        self._explorer.rebuild()


def _in_words(place: Place) -> str:
    theta, lam = place.bodies
    adheres = theta < ADHESION_MATTERS["theta"] or lam < ADHESION_MATTERS["lam"]
    low, high = PLASTICITY
    psi = place.plasticity_index
    yields = "elastic, whatever the load" if psi < low else "plastic, whatever the load" if psi > high else "in between"
    film = "" if place.film is None else f" The film by itself: theta = {place.film[0]:.3g}, lambda = {place.film[1]:.3g}."
    return (f"The bodies: theta = {theta:.3g}, lambda = {lam:.3g}: adhesion {'matters' if adheres else 'does not matter'}; "
            f"plasticity index {psi:.3g}: {yields}.{film}")  # fmt: skip


def _plane_chart(place: Place | None, share: tuple[str, np.ndarray] | None, dark: bool) -> dict[str, Any]:
    points = [] if place is None else [place.bodies, *([place.film] if place.film else [])]
    ends = [(min([low, *(p[at] for p in points)]), max([high, *(p[at] for p in points)]))
            for at, (low, high) in enumerate(((THETA[0], THETA[-1]), (LAM[0], LAM[-1])))]  # fmt: skip
    ends = [(10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high))) for low, high in ends]
    theta = np.geomspace(*ends[0], 60)
    series = [
        line("below this theta adhesion matters", [ADHESION_MATTERS["theta"]] * 2, ends[1], 0),
        line("below this lambda adhesion matters", ends[0], [ADHESION_MATTERS["lam"]] * 2, 1),
        *(line(f"plasticity index {psi:g}", theta, plasticity_line(theta, psi), at) for at, psi in enumerate(PLASTICITY, 2)),
        *({"name": name, "type": "scatter", "symbol": symbol, "symbolSize": 20, "data": [list(point)], "z": 5,
           "itemStyle": {"color": colour, "borderColor": "white", "borderWidth": 1.5}}
          for name, symbol, colour, point in zip(("the bodies", "the film by itself"), ("diamond", "triangle"),
                                                 (COLOURS[3], COLOURS[5]), points, strict=False)),
    ]  # fmt: skip
    for one in series:
        one["showSymbol"] = False
    meanings = {"theta": "elastic adhesion index", "lam": "plastic adhesion index"}
    axes = [{"type": "log", "name": f"{meanings[name]} {QUANTITIES[name].symbol}",
"min": low, "max": high}
            for name, (low, high) in zip(("theta", "lam"), ends, strict=True)]  # fmt: skip
    options = chart("plane of the adhesion indices", axes[0], axes[1], series, dark)
    options["tooltip"]["trigger"] = "item"
    if share is not None:
        _add_share(options, *share)
    return options


def _add_share(options: dict[str, Any], says: str, share: np.ndarray) -> None:
    """Squares for the share of the cases of a claim for which it holds."""
    points = [[float(THETA[i]), float(LAM[j]), float(share[i, j])]
              for i in range(len(THETA)) for j in range(len(LAM)) if np.isfinite(share[i, j])]  # fmt: skip
    half = [float((values[1] / values[0]) ** 0.5) for values in (THETA, LAM)]
    squares = cells(says, points, *((f"it / {one!r}", f"it * {one!r}") for one in half))  # type: ignore[arg-type]  # two of them
    options["series"] = [squares, *options["series"]]
    options["legend"]["data"] = [one["name"] for one in options["series"][1:]]
    options["visualMap"] = {"min": 0, "max": 1, "dimension": 2, "seriesIndex": 0, "right": 0, "top": "middle",
                            "calculable": True, "inRange": {"color": _SHADES}, "text": ["holds", "fails"],
                            "textStyle": options["textStyle"]}  # fmt: skip
    options["grid"]["right"] = 86


def _panel_chart(curves: PanelCurves, dark: bool) -> dict[str, Any]:
    """Friction against load for the films of a panel, beside the uncoated surface."""
    along = curves.panel.along
    each = [("uncoated", curves.bare)]
    each += [(f"{QUANTITIES[along].symbol} = {value:g}", curves.coated.sel({along: value})) for value in curves.panel.values]
    series = []
    for at, (name, data) in enumerate(each):
        load, mu = (np.where(data[key].values > 0.0, data[key].values, np.nan) for key in ("load", "friction_coefficient"))
        series.append(line(name, load, mu, at))
    x, y = (axis_name(curves.bare[key]) for key in ("load", "friction_coefficient"))
    return chart(curves.caption, {"type": "log", "name": x}, {"type": "log", "name": y}, series, dark)
