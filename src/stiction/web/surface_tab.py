"""The tab Surface: a scan, its spectrum with the cutoffs, its asperities by each method, and what all that does to friction."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from nicegui import ui

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError
from stiction.quantities.units import show
from stiction.studies.resolution import resolution_study
from stiction.studies.surface_analysis import Analysis, analyse, prepared
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.read import read_scan
from stiction.surfaces.targets import SelfAffine
from stiction.web.charts import chart, line
from stiction.web.drawn import Picture, attributes
from stiction.web.explorer import Explorer
from stiction.web.pictures import image_of, show_image
from stiction.web.studying import Study
from stiction.web.working import Latest, Progress, run

__all__ = ["Band", "SurfaceTab", "analysed", "example_scan", "fan_picture", "read_bounded"]

_MOST_POINTS = 1_500_000  # of a scan on the page
_SHOWN = 96  # points along a side of the map in three dimensions
_MOST_UPLOAD = 64 * 2**20


@dataclass(frozen=True)
class Band:
    """Order of the form that is taken off, and wavelengths [m] between which heights are kept, None for no end."""

    form: int = 1
    shortest: float | None = None
    longest: float | None = None

    def tables(self) -> dict[str, Any]:
        """The same as a case has it."""
        ends = {"shortest": self.shortest, "longest": self.longest}
        return {"form": self.form} | {name: f"{value:.10g} m" for name, value in ends.items() if value is not None}


def read_bounded(path: Path, told: dict[str, str]) -> HeightMap:
    """A scan of a size for a page. Raises InputError."""
    surface = read_scan(path, **told)  # type: ignore[arg-type]  # texts
    if surface.heights.size > _MOST_POINTS:
        raise InputError(
            "scan", f"{surface.heights.size} points", f"{_MOST_POINTS} at most on a page; `stiction surface` takes more"
        )
    return surface


def analysed(surface: HeightMap, band: Band) -> tuple[Analysis, str, str] | InputError:
    """What is said of a scan in a band, its map and its asperities as pictures; or why nothing is."""
    from stiction.report.surface_pictures import asperity_figure, map_figure

    try:
        found = analyse(prepared(surface, band.form, None, None, band.shortest, band.longest))
        return found, image_of(map_figure(found.surface)), image_of(asperity_figure(found.asperities.values(), found.surface))
    except InputError as error:
        return error


def example_scan(path: Path) -> dict[str, str]:
    """Write a surface that was made, not measured, and say how it is read: self-affine, 256 points over 40 um."""
    made = gaussian_surface((256, 256), (40e-6, 40e-6), SelfAffine(0.8, 10e-6, 0.8e-6, 50e-9), 1)
    np.save(path, made.heights * 1e9)
    return {"size": "40 um", "unit": "nm"}


def fan_picture(surface: HeightMap, contact: Contact | None, load: float | None, progress: Progress) -> str:
    """Numbers of the asperities, and friction, against the shortest wave that is left: a picture. Raises InputError."""
    from stiction.report.method_pictures import resolution_figure

    asked: dict[str, Any] = {} if contact is None else {"contact": contact, "load": load}
    return image_of(resolution_figure(resolution_study(surface, progress=progress("Filtering"), **asked)))


class SurfaceTab:
    """One scan of one visitor."""

    def __init__(self, explorer: Explorer):
        self._explorer = explorer
        self._scan: HeightMap | None = None
        self._file = ""
        self._told: dict[str, str] = {}
        self._latest = Latest(analysed, self._show)
        self._source()
        self._said = ui.label().props('role="status" aria-live="polite"')
        self._body = ui.column().classes("w-full gap-2")
        with self._body:
            self._band()
            self._mu = ui.label().classes("text-xl font-bold").props('role="status" aria-live="polite"')
            self._spectrum = Picture("power spectrum")
            self._pictures = ui.column().classes("w-full")
            self._solid = ui.echart({}, enable_3d=True).classes("w-full").style("height: 380px")
            self._solid.props('role="img" aria-label="map of the heights in three dimensions"')
            Study("Resolution: how asperities and mu hang on the shortest wave", self._fan, self._show_fan)
            self._below = ui.column().classes("w-full")
        self._body.set_visibility(False)
        explorer.listen(self._friction)

    def _source(self) -> None:
        with ui.row().classes("items-end gap-2"):
            fields = {"size": "size along x, e.g. 40 um", "unit": "unit of the numbers", "height_unit": "unit of the heights"}
            self._given = {name: ui.input(label).props("dense outlined").classes("w-48") for name, label in fields.items()}
        with ui.row().classes("items-center gap-2"):
            ui.upload(label="scan", auto_upload=True, max_files=1, max_file_size=_MOST_UPLOAD, on_upload=self._uploaded).props(
                'flat bordered aria-label="upload a scan"'
            )
            ui.button("Make an example", on_click=self._example).props("no-caps outline")

    def _band(self) -> None:
        with ui.row().classes("items-center gap-3"):
            self._form = ui.select(
                {0: "no form", 1: "plane", 2: "curved", 3: "order 3", 4: "order 4"}, value=1, label="form taken off"
            )
            self._form.on_value_change(self._ask).classes("w-32").props("dense outlined")
            use = "use it in the case, as the first body"
            self._used = attributes(ui.switch(use, on_change=self._ask), aria_label=use)
        self._ends: dict[str, Any] = {}
        for name in ("shortest", "longest"):
            with ui.row().classes("items-center w-full no-wrap gap-3"):
                label = ui.label(f"{name} wave").classes("w-56")
                slider = ui.slider(min=-9.0, max=-3.0, step=0.01, value=-9.0).classes("grow")
                attributes(slider, aria_label=f"{name} wave that is kept, logarithm of metres")
                slider.on("update:model-value", self._ask, throttle=0.2)
                self._ends[name] = slider, label

    async def _uploaded(self, event: Any) -> None:
        told = {name: str(one.value).strip() for name, one in self._given.items() if str(one.value or "").strip()}
        await self._read(self._explorer.upload(event.file.name, await event.file.read()), told)

    async def _example(self) -> None:
        path = self._explorer.upload("example.npy", b"")
        await self._read(path, example_scan(Path(path)))

    async def _read(self, path: str, told: dict[str, str]) -> None:
        try:
            self._scan = await run(read_bounded, Path(path), told)
        except InputError as error:
            self._said.set_text(str(error).replace(path, Path(path).name))
            return
        self._file, self._told = path, told
        low, high = (float(np.log10(one)) for one in (2.0 * self._scan.coarsest_pitch, max(self._scan.size)))
        for name, place in (("shortest", low), ("longest", high)):
            attributes(self._ends[name][0], min=low, max=high)
            self._ends[name][0].set_value(place)
        self._body.set_visibility(True)
        self._said.set_text("; ".join(self._scan.history))
        await self._ask()

    def _wanted(self) -> Band:
        """The band of the sliders; at the end of a slider there is no cutoff."""
        assert self._scan is not None
        places = {name: float(slider.value) for name, (slider, _) in self._ends.items()}
        ends = {"shortest": 2.0 * self._scan.coarsest_pitch, "longest": max(self._scan.size)}
        found = {name: None if abs(place - np.log10(ends[name])) < 0.011 else 10.0**place for name, place in places.items()}
        for name, (_, label) in self._ends.items():
            value = found[name]
            label.set_text(f"{name} wave: " + ("as it is" if value is None else show(value, "scan_size", 3)))
        return Band(int(self._form.value), found["shortest"], found["longest"])

    async def _ask(self) -> None:
        if self._scan is None:
            return
        band = self._wanted()
        await self._latest.ask(self._scan, band)
        if self._used.value and "contact" in self._explorer.question.tables:
            rough = {"first": {"file": self._file, **self._told}, **band.tables()}
            await self._explorer.put(("contact", "roughness"), rough)
            self._explorer.rebuild()

    def _show(self, found: tuple[Analysis, str, str] | InputError) -> None:
        if isinstance(found, InputError):
            self._said.set_text(str(found))
            return
        analysis, picture, asperities = found
        self._spectrum.show(self._spectrum_chart(analysis))
        self._pictures.clear()
        with self._pictures:
            show_image(picture, "the heights in colours, and their histogram")
            show_image(asperities, "heights of the asperities by each method")
            for method, why in analysis.failures.items():
                ui.label(f"{method}: {why}").classes("text-sm")
        self._solid.set_visibility(not analysis.surface.is_profile)
        if not analysis.surface.is_profile:
            self._solid.options.clear()
            self._solid.options.update(_solid_chart(analysis.surface))
            self._solid.update()

    def _friction(self) -> None:
        from stiction.web.words import headline

        error = self._explorer.answer.error
        said = str(error) if error is not None else ", ".join(headline(self._explorer.good, self._explorer.here))
        self._mu.set_text(said if self._used.value else "")

    def _spectrum_chart(self, found: Analysis) -> dict[str, Any]:
        spectrum, dark = found.spectrum, self._explorer.view.dark
        ends = [one for one in (self._wanted().shortest, self._wanted().longest) if one is not None]
        limits = [float(np.min(spectrum.density[spectrum.density > 0.0])), float(np.max(spectrum.density))]
        series = [line("power spectral density", spectrum.wavevector, spectrum.density, 0)]
        series += [
            line(f"cutoff {show(one, 'scan_size', 3)}", [2.0 * np.pi / one] * 2, limits, 3, showSymbol=False) for one in ends
        ]
        unit = "m^3" if spectrum.is_profile else "m^4"
        x, y = {"type": "log", "name": "wavevector q [rad/m]"}, {"type": "log", "name": f"C [{unit}]"}
        return chart("radially averaged power spectrum", x, y, series, dark)

    def _fan(self, progress: Progress) -> str:
        case = self._explorer.good.case
        subject = case.subject if case is not None and isinstance(case.subject, Contact) and not case.is_several else None
        load = float(self._explorer.good.curve["load"].values.reshape(-1)[self._explorer.here])
        pressed = subject if load > 0.0 else None
        assert self._scan is not None
        return fan_picture(
            prepared(self._scan, int(self._form.value)), pressed, load if pressed is not None else None, progress
        )

    def _show_fan(self, source: str) -> None:
        self._below.clear()
        with self._below:
            show_image(source, "sigma, R, N and mu against the shortest wave that is left, by each method")


def _solid_chart(surface: HeightMap) -> dict[str, Any]:
    """The heights in three dimensions, of some of the points; the vertical is stretched."""
    rows, columns = (max(count // _SHOWN, 1) for count in surface.heights.shape)
    heights = surface.heights[::rows, ::columns] * 1e9
    y, x = (np.arange(count) * step * pitch * 1e6 for count, step, pitch in
            zip(heights.shape, (rows, columns), surface.pitch, strict=True))  # fmt: skip
    points = [[float(a), float(b), None if np.isnan(z) else float(z)] for b, row in zip(y, heights, strict=True)
              for a, z in zip(x, row, strict=True)]  # fmt: skip
    seen = [float(np.nanmin(heights)), float(np.nanmax(heights))]
    axes = {
        f"{name}Axis3D": {"type": "value", "name": said} for name, said in (("x", "x [um]"), ("y", "y [um]"), ("z", "z [nm]"))
    }
    colours = {"color": ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"]}
    return axes | {
        "grid3D": {"boxHeight": 30},
        "visualMap": {"min": seen[0], "max": seen[1], "dimension": 2, "inRange": colours, "show": False},
        "series": [{"type": "surface", "wireframe": {"show": False}, "data": points, "dataShape": list(heights.shape)}],
    }
