"""What the tab Surface asks: a scan in a band of waves, its pictures, and friction with it in the case. No browser."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError
from stiction.report.method_pictures import resolution_figure
from stiction.report.surface_pictures import asperity_figure, map_figure
from stiction.studies.scans.analysis import Analysis, analyse
from stiction.studies.scans.resolution import resolution_study
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import prepared
from stiction.surfaces.read import read_scan
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.targets import SelfAffine
from stiction.web.asked import Question, solved
from stiction.web.fields import placed
from stiction.web.pictures import image_of
from stiction.web.words import headline
from stiction.web.working import Progress

_MOST_POINTS = 1_500_000  # of a scan on the page


@dataclass(frozen=True)
class Band:
    """Order of the form that is taken off, and wavelengths [m] between which heights are kept, None for no end."""

    form: int = 1
    shortest: float | None = None
    longest: float | None = None

    def of(self, surface: HeightMap) -> HeightMap:
        """Return a surface in this band."""
        return prepared(surface, self.form, None, None, self.shortest, self.longest)


@dataclass(frozen=True)
class Scan:
    """A scan of a visitor: its heights, the file in which they are, and what else was told of it."""

    surface: HeightMap
    file: str
    told: Mapping[str, str]

    def roughness(self, band: Band) -> dict[str, Any]:
        """The table of a case that has it as the first body."""
        ends = {name: f"{value:.10g} m" for name, value in (("shortest", band.shortest), ("longest", band.longest)) if value}
        return {"first": {"file": self.file, **self.told}, "form": band.form, **ends}


def read_bounded(path: Path, told: Mapping[str, str]) -> HeightMap:
    """A scan of a size for a page. Raises InputError."""
    surface = read_scan(path, **told)  # type: ignore[arg-type]  # texts
    if surface.heights.size > _MOST_POINTS:
        raise InputError(
            "scan", f"{surface.heights.size} points", f"{_MOST_POINTS} at most on a page; `stiction surface` takes more"
        )
    return surface


def spectrum_of(surface: HeightMap, band: Band) -> BinnedSpectrum:
    """The averaged spectrum of a scan in a band, its gaps filled. Raises InputError."""
    inside = band.of(surface)
    return radial_average(power_spectrum(inside if inside.complete else fill_missing(inside)))


def said_of_friction(question: Question, scan: Scan, band: Band, load: float) -> str:
    """Friction at a load, SI, with the scan in a band as the first body of the case: a sentence."""
    if "contact" not in question.tables:
        return "Friction with this surface: of dimensionless groups there is none; begin with a case in units."
    tables = placed(question.tables, ("contact", "roughness"), scan.roughness(band))
    answer = solved(question.with_tables(tables).at_load(f"{load!r} N"))
    if answer.error is not None:
        return str(answer.error).replace(scan.file, Path(scan.file).name)
    said, where = headline(answer, 0)
    return f"{said} with this surface as the first body, {where}"


def pictures_of(surface: HeightMap, band: Band, method: str, narrow: bool) -> tuple[Analysis, str, str]:
    """What is found in a scan in a band, the heights of its asperities, and its map with those of a method. Raises InputError.
    narrow: for a narrow page."""
    found = analyse(band.of(surface))
    heights = image_of(asperity_figure(found.asperities.values(), found.surface), narrow)
    return found, heights, map_picture(found, method, narrow)


def map_picture(found: Analysis, method: str, narrow: bool) -> str:
    """The map, with the asperities of a method, "" for none."""
    return image_of(map_figure(found.surface, found=found.asperities.get(method)), narrow)


def example_scan(path: Path) -> dict[str, str]:
    """Write a surface that was made, not measured, and say how it is read: self-affine, 256 points over 40 um."""
    made = gaussian_surface((256, 256), (40e-6, 40e-6), SelfAffine(0.8, 10e-6, 0.8e-6, 50e-9), 1)
    np.save(path, made.heights * 1e9)
    return {"size": "40 um", "unit": "nm"}


def resolution_picture(surface: HeightMap, contact: Contact | None, load: float, progress: Progress, narrow: bool) -> str:
    """Numbers of the asperities, and friction, against the shortest wave that is left: a picture. Raises InputError."""
    asked: dict[str, Any] = {} if contact is None else {"contact": contact, "load": load}
    return image_of(resolution_figure(resolution_study(surface, progress=progress("Filtering"), **asked)), narrow)
