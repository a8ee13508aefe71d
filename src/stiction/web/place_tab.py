"""Build the tab Regime: the contact in the plane of the adhesion indices, with claims and figures of the 2015 paper.

The paper introduced the model of soft films that stiction calls soft_coating_2015. The adhesion indices are theta (elastic) and
lambda (plastic).
"""

from functools import cache
from typing import Any

import numpy as np
from nicegui import ui

from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.report.html_words import letters
from stiction.report.paper_pictures import panel_figure
from stiction.studies.paper.claims import CLAIMS, LAM, THETA, VARIANTS, claim_map
from stiction.studies.paper.figures import PANELS, panel_curves
from stiction.studies.paper.place import ADHESION_MATTERS, PLASTICITY, Place, place_of, plasticity_line
from stiction.web.background import run
from stiction.web.charts import COLOURS, add_cells, chart, line, mark
from stiction.web.elements import Picture, Rows
from stiction.web.explorer import Explorer
from stiction.web.pictures import drawing_of, show_drawing
from stiction.web.study_button import Study

_NO_CLAIM = "none"
_NO_ADHESION = "Without a work of adhesion both indices are infinite: enter one to place the contact."
_INDICES = {
    "theta": 40.0,
    "lam": 10.0,
}  # indices of the figures: the paper does not print them, and its claims hold at these values
_claims: list[Any] = []  # the map of the claims, computed once for all visitors


@cache
def _panel(at: int, variant: str, narrow: bool) -> tuple[str, str]:
    """Return caption and HTML drawing of one figure of the 2015 paper.

    at: index of the figure. variant: variant of the paper's model. narrow: whether the page is narrow.
    """
    curves = panel_curves(PANELS[at], _INDICES["theta"], _INDICES["lam"], variant)
    return curves.caption, drawing_of(panel_figure(curves), curves.caption, narrow)


class PlaceTab:
    """Draw the plane of the adhesion indices after each result, and a figure of the 2015 paper when the user selects it."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._text = ui.label().props('role="status" aria-live="polite"')
        with ui.row().classes("items-center gap-3"):
            claims = {_NO_CLAIM: "no claim"} | {claim.key: f"({claim.key}) {claim.says}" for claim in CLAIMS}
            self._claim = ui.select(claims, value=_NO_CLAIM, label="claim of the 2015 paper", on_change=self._claimed)
            self._claim.classes("w-80").props("dense outlined")
            self._variant = ui.toggle(list(VARIANTS), value=VARIANTS[0], on_change=self.opened).props("dense no-caps")
        self._study = Study(None, "Test the claims on the map", self._judge, lambda _: self.show())
        self._plane = Picture("map of the adhesion indices", "460px", 620)
        ui.label("Figures of the 2015 paper").classes("text-lg")
        with ui.row().classes("items-center gap-3"):
            self._figure = ui.select({at: panel.figure for at, panel in enumerate(PANELS)}, value=0, on_change=self.opened)
            self._figure.props('dense outlined aria-label="figure"')
            ui.button("Use as the case", on_click=self._open).props("no-caps outline")
        self._curves = Rows(ui.column().classes("w-full"), show_drawing)
        self._caption = ui.label().classes("text-sm")
        explorer.listen(self.show)

    async def opened(self) -> None:
        """Show the plane of the adhesion indices, and the selected figure of the paper."""
        self.show()
        caption, drawing = await run(_panel, self._figure.value, self._variant.value, self._explorer.view.narrow)
        self._caption.set_text(letters(caption.replace("\n", ", ")))
        self._curves.show([drawing])

    async def _claimed(self) -> None:
        if self._claim.value != _NO_CLAIM and not _claims:
            await self._study.start()
        self.show()

    def _judge(self, progress: Any) -> None:
        if not _claims:
            _claims.append(claim_map(progress=progress("Testing the claims")))

    def show(self) -> None:
        """Draw the present contact in the plane of the adhesion indices, and the region in which the selected claim holds."""
        place = None
        try:
            place = place_of(self._explorer.answer.case.subject)
            text = _in_words(place)
        except InputError as error:
            text = _NO_ADHESION if error.field == "work_of_adhesion" else str(error)
        self._text.set_text(text)
        options = _plane_chart(place, self._explorer.view.dark)
        chosen = next((at for at, claim in enumerate(CLAIMS) if claim.key == self._claim.value), None)
        if chosen is not None and _claims:
            share = _claims[0].share[chosen, VARIANTS.index(self._variant.value)]
            add_cells(options, CLAIMS[chosen].says, THETA, LAM, share, (1.0, "holds", "fails"))
        self._plane.show(options)

    async def _open(self) -> None:
        panel = PANELS[self._figure.value]
        indices = {**_INDICES, **panel.fixed, panel.along: list(panel.values)}
        solve = {"separation": {"start": 4, "stop": -4, "count": 81}, "variant": self._variant.value}
        await self._explorer.open({"title": f"{panel.figure} of the 2015 paper", "indices": indices, "solve": solve})


def _in_words(place: Place) -> str:
    theta, lam = place.bodies
    adheres = theta < ADHESION_MATTERS["theta"] or lam < ADHESION_MATTERS["lam"]
    low, high = PLASTICITY
    psi = place.plasticity_index
    yields = "elastic at any load" if psi < low else "plastic at any load" if psi > high else "in between"
    film = "" if place.film is None else f" The film by itself: θ = {place.film[0]:.3g}, λ = {place.film[1]:.3g}."
    return (f"The bodies: θ = {theta:.3g}, λ = {lam:.3g}: adhesion {'matters' if adheres else 'does not matter'}; "
            f"plasticity index {psi:.3g}: {yields}.{film}")  # fmt: skip


def _plane_chart(place: Place | None, dark: bool) -> dict[str, Any]:
    points = [] if place is None else [place.bodies, *([place.film] if place.film else [])]
    shown = [np.log10([*values[[0, -1]], *(point[at] for point in points)]) for at, values in enumerate((THETA, LAM))]
    theta, lam = ((10.0 ** np.floor(ends.min()), 10.0 ** np.ceil(ends.max())) for ends in shown)
    along = np.geomspace(*theta, 60)
    series = [
        line("below this θ adhesion matters", [ADHESION_MATTERS["theta"]] * 2, lam, 0),
        line("below this λ adhesion matters", theta, [ADHESION_MATTERS["lam"]] * 2, 1),
        *(line(f"plasticity index {psi:g}", along, plasticity_line(along, psi), at) for at, psi in enumerate(PLASTICITY, 2)),
    ]
    for limit in series:
        limit["showSymbol"] = False
    looks = ("the bodies", "diamond", COLOURS[3]), ("the film by itself", "triangle", COLOURS[5])
    series += [mark(name, point, symbol, 20, colour) for (name, symbol, colour), point in zip(looks, points, strict=False)]
    x, y = (
        {"type": "log", "name": f"{meaning} adhesion index {letters(QUANTITIES[name].symbol)}", "min": low, "max": high}
        for meaning, name, (low, high) in (("elastic", "theta", theta), ("plastic", "lam", lam))
    )
    options = chart("map of the adhesion indices", x, y, series, dark)
    options["tooltip"]["trigger"] = "item"
    return options
