"""The tab Surface: a scan, its spectrum with the cutoffs, its asperities by each method, and what all that does to friction."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

from nicegui import ui

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError
from stiction.quantities.units import show
from stiction.surfaces.finding import methods
from stiction.surfaces.prepare import prepared
from stiction.surfaces.spectrum import BinnedSpectrum
from stiction.web.drawn import Picture, attributes
from stiction.web.explorer import Explorer
from stiction.web.guard import LARGEST_UPLOAD
from stiction.web.pictures import show_image
from stiction.web.studying import Study
from stiction.web.surface_charts import solid_chart, spectrum_chart, wavevectors
from stiction.web.surface_work import (
    Band,
    Pictures,
    Scan,
    example_scan,
    fan_picture,
    map_picture,
    pictures_of,
    read_bounded,
    said_of_friction,
    spectrum_of,
)
from stiction.web.uploading import upload_button
from stiction.web.working import Latest, Progress, run

__all__ = ["SurfaceTab"]

_FORMS = {0: "no form", 1: "plane", 2: "curved", 3: "order 3", 4: "order 4"}
_NO_METHOD = ""
_STEP = 0.005  # of the decimal logarithm of a wavevector


class SurfaceTab:
    """One scan of one visitor. While a cutoff is moved spectrum and friction follow; pictures when it is let go."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._scan: Scan | None = None
        self._drawn: Pictures | None = None
        self._whole: BinnedSpectrum | None = None
        self._spectra = Latest(spectrum_of, self._show_spectrum)
        self._friction = Latest(said_of_friction, lambda said: self._mu.set_text(said))
        self._pictures = Latest(pictures_of, self._show_pictures)
        self._source()
        self._said = ui.label().props('role="status" aria-live="polite"')
        self._body = ui.column().classes("w-full gap-2")
        with self._body:
            self._mu = ui.label().classes("text-xl font-bold").props('role="status" aria-live="polite"')
            self._options()
            self._spectrum = Picture("power spectrum")
            self._handles()
            self._map = ui.column().classes("w-full")
            with ui.element("div").classes("w-full") as self._above:
                self._solid = ui.echart({}, enable_3d=True).classes("w-full").style("height: 380px")
            self._solid.props('role="img" aria-label="map of the heights in three dimensions"')
            Study(explorer, "Resolution: how asperities and mu hang on the shortest wave", self._fan, self._show_fan)
            self._below = ui.column().classes("w-full")
        self._body.set_visibility(False)
        explorer.listen(self._again)

    def _source(self) -> None:
        with ui.row().classes("items-end gap-2"):
            fields = {"size": "size along x, e.g. 40 um", "unit": "unit of the numbers", "height_unit": "unit of the heights"}
            self._given = {name: ui.input(label).props("dense outlined").classes("w-48") for name, label in fields.items()}
        ui.label("Only for files that do not say it themselves, such as numbers in rows.").classes("text-sm")
        with ui.row().classes("items-center gap-2"):
            upload_button(self._explorer, "Upload a scan", self._uploaded, self._refused, LARGEST_UPLOAD)
            ui.button("Make an example", on_click=self._example).props("no-caps outline")

    def _options(self) -> None:
        with ui.row().classes("items-center gap-3"):
            self._form = ui.select(_FORMS, value=1, label="form taken off", on_change=self._let_go)
            self._form.classes("w-32").props("dense outlined")
            labels = {_NO_METHOD: "none"} | {key: one.label for key, one in methods().items()}
            self._method = ui.select(labels, value="eight_neighbour", label="asperities on the map", on_change=self._marked)
            self._method.classes("w-56").props("dense outlined")
            use = "use it in the case, as the first body"
            self._used = attributes(ui.switch(use, on_change=self._let_go), aria_label=use)

    def _handles(self) -> None:
        """Two handles under the spectrum, each at its wavevector, so that the picture is their scale."""
        self._ends: dict[str, Any] = {}
        for name in ("longest", "shortest"):
            label = ui.label().classes("text-sm")
            slider = ui.slider(min=0.0, max=1.0, step=_STEP, value=0.0).classes("under-chart")
            attributes(slider, aria_label=f"{name} wave that is kept, by the logarithm of its wavevector")
            slider.on("update:model-value", self._ask, throttle=0.1)
            slider.on("change", self._let_go)
            self._ends[name] = slider, label

    async def _uploaded(self, path: str, name: str) -> None:
        told = {name: str(one.value).strip() for name, one in self._given.items() if str(one.value or "").strip()}
        await self._read(path, told, name)

    def _refused(self, why: str) -> None:
        self._said.set_text(why)

    async def _example(self) -> None:
        path = self._explorer.upload("example.npy", b"")
        await self._read(path, example_scan(Path(path)), "the example")

    async def _read(self, path: str, told: dict[str, str], name: str) -> None:
        try:
            surface = replace(await run(read_bounded, Path(path), told), name=name)
        except InputError as error:
            # Before the line is made, which shortens long paths. An archive is named without its folder.
            value, allowed = (
                one and str(one).replace(path, name).replace(Path(path).name, name) for one in (error.value, error.allowed)
            )
            self._said.set_text(str(InputError(error.field, value, allowed)))
            return
        whole = await run(spectrum_of, surface, Band(int(self._form.value)))
        if isinstance(whole, InputError):
            self._said.set_text(str(whole))
            return
        self._scan, self._whole = Scan(surface, path, told), whole
        low, high = map(math.log10, wavevectors(surface))
        for end, place in (("longest", low), ("shortest", high)):
            attributes(self._ends[end][0], min=low, max=high)
            self._ends[end][0].set_value(place)
        self._body.set_visibility(True)
        self._said.set_text("; ".join(surface.history))
        await self._let_go()

    def _wanted(self) -> Band:
        """The band of the handles; at the end of the spectrum there is no cutoff."""
        assert self._scan is not None
        ends = dict(zip(("longest", "shortest"), map(math.log10, wavevectors(self._scan.surface)), strict=True))
        found: dict[str, float | None] = {}
        for name, (slider, label) in self._ends.items():
            place = float(slider.value)
            found[name] = None if abs(place - ends[name]) < 1.1 * _STEP else 2.0 * math.pi / 10.0**place
            said = "as it is" if found[name] is None else show(found[name], "scan_size", 3)
            label.set_text(f"{name} wave that is kept: {said}")
            attributes(slider, aria_valuetext=said)
        return Band(int(self._form.value), found["shortest"], found["longest"])

    async def _ask(self) -> None:
        """Spectrum and friction of the band: each of the newest, as the handles may have moved while the other was asked."""
        if self._scan is None:
            return
        explorer = self._explorer
        await self._spectra.ask(self._scan.surface, self._wanted())
        load = float(explorer.good.curve["load"].values.reshape(-1)[explorer.here])
        if load > 0.0:
            question = explorer.question.with_tables(explorer.good.question.tables)
            await self._friction.ask(question, self._scan, self._wanted(), load)
        else:
            self._mu.set_text("Friction with this surface: at a load above 0; choose a point of the tab Contact that presses.")

    async def _let_go(self) -> None:
        """Everything of the band; and the case, where the scan is in it."""
        if self._scan is None:
            return
        await self._ask()
        if self._used.value and "contact" in self._explorer.question.tables:
            await self._explorer.put(("contact", "roughness"), self._scan.roughness(self._wanted()))
            self._explorer.rebuild()
        await self._pictures.ask(self._scan.surface, self._wanted(), self._method.value, self._explorer.view.narrow)

    def _show_spectrum(self, found: BinnedSpectrum | InputError) -> None:
        if isinstance(found, InputError):
            self._said.set_text(str(found))
            return
        assert self._scan is not None and self._whole is not None
        self._said.set_text("; ".join(self._scan.surface.history))
        dark = self._explorer.view.dark
        self._spectrum.show(spectrum_chart(self._whole, found, self._wanted(), wavevectors(self._scan.surface), dark))

    def _show_pictures(self, found: Pictures | InputError) -> None:
        if isinstance(found, InputError):
            self._said.set_text(str(found))
            return
        self._drawn = found
        self._show_map(found.map)
        surface = found.analysis.surface
        self._above.set_visibility(not surface.is_profile)
        if not surface.is_profile:
            self._solid.options.clear()
            self._solid.options.update(solid_chart(surface, self._explorer.view.dark))
            self._solid.update()

    def _show_map(self, source: str) -> None:
        assert self._drawn is not None
        named = methods().get(self._method.value)
        self._map.clear()
        with self._map:
            marked = "" if named is None else f"; marked: {named.label}"
            show_image(source, f"the heights in colours, and their histogram{marked}")
            show_image(self._drawn.heights, "heights of the asperities by each method")
            for method, why in self._drawn.analysis.failures.items():
                ui.label(f"{methods()[method].label}: {why}").classes("text-sm")

    async def _marked(self) -> None:
        """The same map with the asperities of another method."""
        if self._drawn is not None:
            self._show_map(await run(map_picture, self._drawn.analysis, self._method.value, self._explorer.view.narrow))

    def _again(self) -> None:
        """The case has changed: so has friction with this surface."""
        if self._scan is not None:
            ui.timer(0.0, self._ask, once=True)

    def _fan(self, progress: Progress) -> str:
        case = self._explorer.good.case
        subject = case.subject if case is not None and isinstance(case.subject, Contact) and not case.is_several else None
        load = float(self._explorer.good.curve["load"].values.reshape(-1)[self._explorer.here])
        pressed = subject if load > 0.0 else None
        assert self._scan is not None
        surface = prepared(self._scan.surface, int(self._form.value))
        return fan_picture(surface, pressed, load if pressed is not None else None, progress, self._explorer.view.narrow)

    def _show_fan(self, source: str) -> None:
        self._below.clear()
        with self._below:
            show_image(source, "sigma, R, N and mu against the shortest wave that is left, by each method")
