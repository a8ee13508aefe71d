"""The tab Where am I: the plane of the adhesion indices with the contact in it; claims and figures of the 2015 paper."""

from functools import cache
from typing import Any

import numpy as np
from nicegui import ui

from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.report.paper_pictures import panel_figure
from stiction.studies.paper.claims import CLAIMS, LAM, THETA, VARIANTS, ClaimMap, claim_map
from stiction.studies.paper.figures import PANELS, panel_curves
from stiction.studies.paper.place import ADHESION_MATTERS, PLASTICITY, Place, place_of, plasticity_line
from stiction.web.charts import COLOURS, add_cells, chart, line, mark
from stiction.web.drawn import Picture, Rows
from stiction.web.explorer import Explorer
from stiction.web.pictures import drawing_of, show_drawing
from stiction.web.studying import Study
from stiction.web.working import run

_NO_CLAIM = "none"
_NO_ADHESION = "No work of adhesion is stated, so both indices are infinite: state one to place the contact."
_INDICES = (40.0, 10.0)  # of the figures, which the paper does not print; those at which its claims show
_kept: dict[str, ClaimMap] = {}  # the same for everybody: it depends on nothing that a visitor says


@cache
def _panel(at: int, variant: str, narrow: bool) -> tuple[str, str]:
    """The caption of a figure, and the figure."""
    curves = panel_curves(PANELS[at], *_INDICES, variant)
    return curves.caption, drawing_of(panel_figure(curves), curves.caption, narrow)


class PlaceTab:
    """The plane, drawn anew with every answer; the figures, as they are chosen."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._said = ui.label().props('role="status" aria-live="polite"')
        with ui.row().classes("items-center gap-3"):
            claims = {_NO_CLAIM: "no claim"} | {one.key: f"({one.key}) {one.says}" for one in CLAIMS}
            self._claim = ui.select(claims, value=_NO_CLAIM, label="claim of the 2015 paper", on_change=self._claimed)
            self._claim.classes("w-80").props("dense outlined")
            self._reading = ui.toggle(list(VARIANTS), value=VARIANTS[0], on_change=self.opened).props("dense no-caps")
        self._study = Study(None, "Judge the claims in the plane", self._judged, lambda _: self.show())
        self._plane = Picture("plane of the adhesion indices", "460px", 620)
        ui.label("Figures of the 2015 paper").classes("text-lg")
        with ui.row().classes("items-center gap-3"):
            self._figure = ui.select({at: one.figure for at, one in enumerate(PANELS)}, value=0, on_change=self.opened)
            self._figure.props('dense outlined aria-label="figure"')
            ui.button("Open as the case", on_click=self._open).props("no-caps outline")
        self._curves = Rows(ui.column().classes("w-full"), show_drawing)
        self._caption = ui.label().classes("text-sm")
        explorer.listen(self.show)

    async def opened(self) -> None:
        """Show the plane and the figure that is chosen."""
        self.show()
        caption, drawing = await run(_panel, self._figure.value, self._reading.value, self._explorer.view.narrow)
        self._caption.set_text(caption)
        self._curves.show([drawing])

    async def _claimed(self) -> None:
        if self._claim.value != _NO_CLAIM and "map" not in _kept:
            await self._study.start()
        self.show()

    def _judged(self, progress: Any) -> None:
        if "map" not in _kept:
            _kept["map"] = claim_map(progress=progress("Judging the claims"))

    def show(self) -> None:
        """The plane with the newest contact, and the share (theta, lambda) of its cases for which the claim that is shown
        holds."""
        case = self._explorer.good.case
        assert case is not None
        try:
            place = place_of(case.subject)
            self._said.set_text(_in_words(place))
        except InputError as error:
            place = None
            self._said.set_text(_NO_ADHESION if error.field == "work_of_adhesion" else str(error))
        options = _plane_chart(place, self._explorer.view.dark)
        found = next((at for at, one in enumerate(CLAIMS) if one.key == self._claim.value), None)
        if found is not None and "map" in _kept:
            share = _kept["map"].share[found, VARIANTS.index(self._reading.value)]
            add_cells(options, CLAIMS[found].says, THETA, LAM, share, (1.0, "holds", "fails"))
        self._plane.show(options)

    async def _open(self) -> None:
        panel = PANELS[self._figure.value]
        theta, lam = _INDICES
        indices = {"theta": theta, "lam": lam, **panel.fixed, panel.along: list(panel.values)}
        solve = {"separation": {"start": 4, "stop": -4, "count": 81}, "variant": self._reading.value}
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


def _plane_chart(place: Place | None, dark: bool) -> dict[str, Any]:
    points = [] if place is None else [place.bodies, *([place.film] if place.film else [])]
    seen = [np.log10([*values[[0, -1]], *(point[at] for point in points)]) for at, values in enumerate((THETA, LAM))]
    theta, lam = ((10.0 ** np.floor(one.min()), 10.0 ** np.ceil(one.max())) for one in seen)
    along = np.geomspace(*theta, 60)
    series = [
        line("below this theta adhesion matters", [ADHESION_MATTERS["theta"]] * 2, lam, 0),
        line("below this lambda adhesion matters", theta, [ADHESION_MATTERS["lam"]] * 2, 1),
        *(line(f"plasticity index {psi:g}", along, plasticity_line(along, psi), at) for at, psi in enumerate(PLASTICITY, 2)),
    ]
    for one in series:
        one["showSymbol"] = False
    looks = ("the bodies", "diamond", COLOURS[3]), ("the film by itself", "triangle", COLOURS[5])
    series += [mark(name, point, symbol, 20, colour) for (name, symbol, colour), point in zip(looks, points, strict=False)]
    x, y = (
        {"type": "log", "name": f"{meaning} adhesion index {QUANTITIES[name].symbol}", "min": low, "max": high}
        for meaning, name, (low, high) in (("elastic", "theta", theta), ("plastic", "lam", lam))
    )
    options = chart("plane of the adhesion indices", x, y, series, dark)
    options["tooltip"]["trigger"] = "item"
    return options
