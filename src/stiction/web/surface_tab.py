"""Build the tab Surface: a scan, its spectrum with the cutoffs, its asperities by each method, and friction with it."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from nicegui import ui

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.studies.scans.analysis import Analysis
from stiction.surfaces.finding import methods
from stiction.surfaces.spectrum import BinnedSpectrum
from stiction.web.background import Latest, Progress, run
from stiction.web.elements import Picture, Rows, attributes, upload_button
from stiction.web.explorer import Explorer
from stiction.web.guard import LARGEST_UPLOAD
from stiction.web.pictures import show_drawing
from stiction.web.study_button import Study
from stiction.web.surface_work import (
    Band,
    Scan,
    example_scan,
    friction_with,
    map_picture,
    pictures_of,
    read_bounded,
    resolution_picture,
    solid_chart,
    spectrum_chart,
    spectrum_of,
    wavevectors,
)

_FORMS = {0: "no form", 1: "plane", 2: "curved", 3: "order 3", 4: "order 4"}
_STEP = 0.005  # step of the sliders, in the decimal logarithm of the wavevector


class SurfaceTab:
    """Show the scan of a visitor, with its spectrum and asperities, and friction with this surface.

    Spectrum and friction are updated while a cutoff moves, drawings after the slider is released.
    """

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._scan: Scan | None = None
        self._source()
        self._history = ui.label().props('role="status" aria-live="polite"')
        self._spectra = Latest(spectrum_of, self._show_spectrum, self._refuse)
        self._friction = Latest(friction_with, lambda html: self._mu.set_content(html))
        self._pictures = Latest(pictures_of, self._show_pictures, self._refuse)
        self._body = ui.column().classes("w-full gap-2")
        with self._body:
            ui.label("With this surface as the first body").classes("text-lg")
            self._mu = ui.html("", sanitize=False).classes("w-full").props('role="status" aria-live="polite"')
            self._options()
            self._spectrum = Picture("power spectrum")
            self._ends = {name: self._handle(name) for name in ("longest", "shortest")}
            self._images = Rows(ui.column().classes("w-full"), show_drawing)
            self._failures = Rows(ui.column(), lambda why: ui.label(why).classes("text-sm"))
            self._solid = ui.echart({}, enable_3d=True).classes("w-full").style("height: 380px")
            self._solid.props('role="img" aria-label="map of the heights in three dimensions"')
            label = "Resolution: asperities and μ against the shortest wave"
            Study(explorer, label, self._resolution, lambda drawing: self._resolved.show([drawing]))
            self._resolved = Rows(ui.column().classes("w-full"), show_drawing)
        self._body.set_visibility(False)
        explorer.listen(lambda: ui.timer(0.0, self._ask, once=True))  # the friction depends on the case

    def _source(self) -> None:
        with ui.row().classes("items-end gap-2"):
            fields = {"size": "size along x, e.g. 40 µm", "unit": "unit of the numbers", "height_unit": "unit of the heights"}
            inputs = {name: ui.input(label).props("dense outlined").classes("w-48") for name, label in fields.items()}
        ui.label("Needed only for files without size or units, such as tables of numbers.").classes("text-sm")

        async def uploaded(path: str, name: str) -> None:
            texts = {field: str(text.value or "").strip() for field, text in inputs.items()}
            await self._read(path, {field: text for field, text in texts.items() if text}, name)

        async def example() -> None:
            path = self._explorer.upload("example.npy", b"")
            await self._read(path, example_scan(Path(path)), "the example")

        with ui.row().classes("items-center gap-2"):
            upload_button(self._explorer, "Upload a scan", uploaded, lambda why: self._history.set_text(why), LARGEST_UPLOAD)
            ui.button("Generate an example", on_click=example).props("no-caps outline")

    def _refuse(self, error: InputError) -> None:
        self._history.set_text(str(error))

    def _options(self) -> None:
        with ui.row().classes("items-center gap-3"):
            self._form = ui.select(_FORMS, value=1, label="form removed", on_change=self._released)
            self._form.classes("w-32").props("dense outlined")
            labels = {"": "none"} | {key: method.label for key, method in methods().items()}
            self._method = ui.select(labels, value="eight_neighbour", label="asperities on the map", on_change=self._marked)
            self._method.classes("w-56").props("dense outlined")
            use = "use it in the case, as the first body"
            self._used = attributes(ui.switch(use, on_change=self._released), aria_label=use)

    def _handle(self, name: str) -> tuple[Any, Any]:
        """Add, below the chart of the spectrum, a slider for one cutoff; return the slider and its label.

        name: "longest" or "shortest" wavelength. The slider spans the axis of the chart, so that its position is a wavevector.
        """
        label = ui.label().classes("text-sm")
        slider = ui.slider(min=0.0, max=1.0, step=_STEP, value=0.0).classes("under-chart")
        attributes(slider, aria_label=f"{name} wave that is kept, by the logarithm of its wavevector")
        slider.on("update:model-value", self._ask, throttle=0.1)
        slider.on("change", self._released)
        return slider, label

    async def _read(self, path: str, stated: Mapping[str, str], name: str) -> None:
        try:
            surface = replace(await run(read_bounded, Path(path), stated), name=name)
            self._whole = await run(spectrum_of, surface, Band(int(self._form.value)))
        except InputError as error:
            # Paths are replaced before the message is made, because a message shortens long paths.
            value, allowed = (
                str(text or "").replace(path, name).replace(Path(path).name, name) for text in (error.value, error.allowed)
            )
            self._history.set_text(str(InputError(error.field, value or None, allowed)))
            return
        self._scan = Scan(surface, path, stated)
        low, high = self._limits = tuple(map(math.log10, wavevectors(surface)))
        for (slider, _), place in zip(self._ends.values(), self._limits, strict=True):
            attributes(slider, min=low, max=high)
            slider.set_value(place)
        self._body.set_visibility(True)
        await self._released()

    def _band(self) -> Band:
        """Return the chosen order of the form and the chosen wavelengths; show the wavelengths in the labels.

        A slider at its end sets no cutoff.
        """
        lengths: dict[str, float | None] = {}
        for (name, (slider, label)), end in zip(self._ends.items(), self._limits, strict=True):
            place = float(slider.value)
            length = None if abs(place - end) < 1.1 * _STEP else 2.0 * math.pi / 10.0**place
            text = "no cutoff" if length is None else show(length, "scan_size", 3)
            label.set_text(f"{name} wave that is kept: {text}")
            attributes(slider, aria_valuetext=text)
            lengths[name] = length
        return Band(int(self._form.value), **lengths)

    async def _ask(self) -> None:
        """Compute and show the spectrum, then friction, for the band of wavelengths that the sliders set."""
        if self._scan is None:
            return
        explorer = self._explorer
        await self._spectra.ask(self._scan.surface, self._band())
        if explorer.load > 0.0:
            query = explorer.query.with_tables(explorer.answer.query.tables)
            await self._friction.ask(query, self._scan, self._band(), explorer.load)
        else:
            self._mu.set_content("Friction needs a load above 0: choose another point in the tab Contact.")

    async def _released(self) -> None:
        """Update everything that depends on the band, and the case if it uses the scan."""
        if self._scan is None:
            return
        await self._ask()
        if self._used.value and "contact" in self._explorer.query.tables:
            await self._explorer.put(("contact", "roughness"), self._scan.roughness(self._band()))
            self._explorer.rebuild()
        await self._pictures.ask(self._scan.surface, self._band(), self._method.value, self._explorer.view.narrow)

    def _show_spectrum(self, kept: BinnedSpectrum) -> None:
        assert self._scan is not None
        surface = self._scan.surface
        self._history.set_text("; ".join(surface.history))
        self._spectrum.show(spectrum_chart(self._whole, kept, self._band(), wavevectors(surface), self._explorer.view.dark))

    def _show_pictures(self, found: tuple[Analysis, str, str]) -> None:
        self._analysis, self._heights, of_map = found
        self._images.show([of_map, self._heights])
        self._failures.show([f"{methods()[method].label}: {why}" for method, why in self._analysis.failures.items()])
        surface = self._analysis.surface
        self._solid.set_visibility(not surface.is_profile)
        if not surface.is_profile:
            self._solid.options.clear()
            self._solid.options.update(solid_chart(surface, self._explorer.view.dark))
            self._solid.update()

    async def _marked(self) -> None:
        """Draw the same map with the asperities of another method."""
        if self._body.visible:
            of_map = await run(map_picture, self._analysis, self._method.value, self._explorer.view.narrow)
            self._images.show([of_map, self._heights])

    def _resolution(self, progress: Progress) -> str:
        assert self._scan is not None
        case, load = self._explorer.answer.case, self._explorer.load
        surface = Band(int(self._form.value)).of(self._scan.surface)
        pressed = load > 0.0 and isinstance(case.subject, Contact) and not case.is_swept
        subject: Any = case.subject if pressed else None
        return resolution_picture(surface, subject, load, progress, self._explorer.view.narrow)
