"""Analyse and draw a scan for the tab Surface: a band of its wavelengths, its spectrum, and its friction."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.shown import show
from stiction.report.method_pictures import resolution_figure
from stiction.report.surface_pictures import asperity_figure, map_figure
from stiction.studies.scans.analysis import Analysis, analyse
from stiction.studies.scans.resolution import resolution_study
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.finding import methods
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import prepared
from stiction.surfaces.read import read_scan
from stiction.surfaces.spectrum import BinnedSpectrum, power_spectrum, radial_average
from stiction.surfaces.targets import SelfAffine
from stiction.web.answer_card import card_on_page
from stiction.web.background import Progress
from stiction.web.charts import INK, SHADES, chart, line
from stiction.web.fields import with_value_at
from stiction.web.pictures import drawing_of
from stiction.web.query import Query, headline, solved

_HEIGHTS = "heights of the asperities by each method"
_MOST_POINTS = 1_500_000  # largest number of points of a scan on the page


@dataclass(frozen=True)
class Band:
    """Hold the preparation of a scan: order of the polynomial form to remove, and the band of wavelengths [m] to retain.

    shortest, longest: None for no cutoff.
    """

    form: int = 1
    shortest: float | None = None
    longest: float | None = None

    def of(self, surface: HeightMap) -> HeightMap:
        """Return a surface without its form, filtered to this band of wavelengths.

        Raises InputError if the form or the band does not suit the surface.
        """
        return prepared(surface, self.form, None, None, self.shortest, self.longest)


@dataclass(frozen=True)
class Scan:
    """Hold a scan of a visitor.

    surface: its heights. file: path of the uploaded file. stated: what the visitor stated about the file, such as its size.
    """

    surface: HeightMap
    file: str
    stated: Mapping[str, str]

    def roughness(self, band: Band) -> dict[str, Any]:
        """Return the table [contact.roughness] of a case in which the scan is the first body, prepared as `band` states."""
        ends = {name: f"{value:.10g} m" for name, value in (("shortest", band.shortest), ("longest", band.longest)) if value}
        return {"first": {"file": self.file, **self.stated}, "form": band.form, **ends}


def read_bounded(path: Path, stated: Mapping[str, str]) -> HeightMap:
    """Return the heights of a scan file.

    stated: arguments of `read_scan`, such as the size. Raises InputError for an invalid file or one that is too large for the
    page.
    """
    surface = read_scan(path, **stated)  # type: ignore[arg-type]  # texts
    if surface.heights.size > _MOST_POINTS:
        raise InputError(
            "scan",
            InWords(f"{surface.heights.size} points"),
            f"at most {_MOST_POINTS} points on this page; the command `stiction surface` accepts more",
        )
    return surface


def spectrum_of(surface: HeightMap, band: Band) -> BinnedSpectrum:
    """Return the radially averaged power spectrum of a scan, prepared as `band` states, with gaps filled.

    Raises InputError as `Band.of` does.
    """
    inside = band.of(surface)
    return radial_average(power_spectrum(inside if inside.complete else fill_missing(inside)))


def friction_with(query: Query, scan: Scan, band: Band, load: float) -> str:
    """Return HTML with the friction of a case at a load [N], if the prepared scan is the roughness of the first body.

    An error is returned as text. If the case states dimensionless groups, a hint is returned.
    """
    if "contact" not in query.tables:
        return "Friction with this surface needs a case in units: choose an example."
    tables = with_value_at(query.tables, ("contact", "roughness"), scan.roughness(band))
    try:
        answer = solved(query.with_tables(tables).at_load(f"{load!r} N"))
    except InputError as error:
        return escape(str(error).replace(scan.file, Path(scan.file).name))
    return card_on_page(answer.data).html(why=False) if answer.is_prediction else escape(", ".join(headline(answer, 0)))


def pictures_of(surface: HeightMap, band: Band, method: str, narrow: bool) -> tuple[Analysis, str, str]:
    """Prepare a scan; return (analysis, drawing of the asperity heights, drawing of the map with asperities).

    band: how the scan is prepared. method: asperity method whose asperities are marked on the map. narrow: whether the page is
    narrow. Raises InputError as `Band.of` does.
    """
    found = analyse(band.of(surface))
    heights = drawing_of(asperity_figure(found.asperities.values(), found.surface), _HEIGHTS, narrow)
    return found, heights, map_picture(found, method, narrow)


def map_picture(found: Analysis, method: str, narrow: bool) -> str:
    """Return a drawing of the height map with the asperities of a method; method "" marks none.

    found: analysis of the scan. narrow: whether the page is narrow.
    """
    named = methods().get(method)
    description = "the heights in colours, and their histogram" + (f"; marked: {named.label}" if named else "")
    return drawing_of(map_figure(found.surface, asperities=found.asperities.get(method)), description, narrow)


def example_scan(path: Path) -> dict[str, str]:
    """Write a generated self-affine surface to a file, and return the properties that are needed to read the file.

    The surface has 256 x 256 points over 40 um.
    """
    made = gaussian_surface((256, 256), (40e-6, 40e-6), SelfAffine(0.8, 10e-6, 0.8e-6, 50e-9), 1)
    np.save(path, made.heights * 1e9)
    return {"size": "40 um", "unit": "nm"}


def resolution_picture(surface: HeightMap, contact: Contact | None, load: float, progress: Progress, narrow: bool) -> str:
    """Return a drawing of sigma, R, N and, if a contact is given, mu against the shortest wavelength that is kept.

    load: [N], for mu. narrow: whether the page is narrow. Raises InputError if the scan cannot be filtered.
    """
    asked: dict[str, Any] = {} if contact is None else {"contact": contact, "load": load}
    study = resolution_study(surface, progress=progress("Filtering"), **asked)
    return drawing_of(resolution_figure(study), "σ, R, N and μ against the shortest wave, by each method", narrow)


_SHOWN = 96  # points along a side of the three-dimensional map of a large scan; fewer than twice as many are drawn

_DECADES = 10  # decades of the spectrum that are shown; below them a filter leaves round-off


def wavevectors(surface: HeightMap) -> tuple[float, float]:
    """Return the wavevectors [rad/m] of the longest and the shortest wave that a scan can contain."""
    return 2.0 * math.pi / max(surface.size), math.pi / surface.coarsest_pitch


def spectrum_chart(
    whole: BinnedSpectrum, kept: BinnedSpectrum, band: Band, ends: tuple[float, float], dark: bool
) -> dict[str, Any]:
    """Return the chart of the spectra before and after the filter, in which removed wavelengths are shaded.

    whole: before the filter. kept: after it. ends: wavevectors [rad/m] at both ends of the axis. dark: whether the page is
    dark.
    """
    top = math.ceil(math.log10(whole.density.max()))
    limits = [10.0 ** (top - _DECADES), 10.0**top]
    left_out = []
    for length, end, which in ((band.longest, ends[0], "longer"), (band.shortest, ends[1], "shorter")):
        if length is not None:
            low, high = sorted((end, 2.0 * math.pi / length))
            left_out.append([{"xAxis": low, "name": f"{which} than {show(length, 'scan_size', 3)}"}, {"xAxis": high}])
    area = {
        "silent": True,
        "itemStyle": {"color": "rgba(128, 128, 128, 0.25)"},
        "label": {"color": INK[dark], "position": "insideTop"},
        "data": left_out,
    }
    series = []
    for name, one, at in (("as measured", whole, 1), ("within the cutoffs", kept, 0)):
        seen = np.where(one.density > limits[0], one.density, np.nan)
        series.append(line(name, one.wavevector, seen, at, showSymbol=False, clip=True))
    series[1]["markArea"] = area
    unit = "m³" if whole.is_profile else "m⁴"
    x = {"type": "log", "name": "wavevector q [rad/m]", "min": ends[0], "max": ends[1]}
    y = {"type": "log", "name": f"C [{unit}]", "min": limits[0], "max": limits[1]}
    return chart("radially averaged power spectrum against the wavevector", x, y, series, dark)


def solid_chart(surface: HeightMap, dark: bool) -> dict[str, Any]:
    """Return a three-dimensional chart of a surface, with a stretched vertical axis and at most 191 points a side."""
    rows, columns = (max(count // _SHOWN, 1) for count in surface.heights.shape)
    heights = surface.heights[::rows, ::columns] * 1e9
    along_y, along_x = surface.pitch[0] * rows * 1e6, surface.pitch[1] * columns * 1e6
    points = [[j * along_x, i * along_y, None if np.isnan(z) else float(z)] for (i, j), z in np.ndenumerate(heights)]
    seen = [float(np.nanmin(heights)), float(np.nanmax(heights))]
    ink = INK[dark]
    look = {"axisLine": {"lineStyle": {"color": ink}}, "axisLabel": {"color": ink}, "nameTextStyle": {"color": ink}}
    axes = {
        f"{name}Axis3D": {"type": "value", "name": label, "nameGap": 30, "splitNumber": 3, **look}
        for name, label in zip("xyz", ("x [µm]", "y [µm]", "z [nm]"), strict=True)
    }
    return axes | {
        "grid3D": {"boxHeight": 30, "viewControl": {"distance": 230}},
        "visualMap": {"min": seen[0], "max": seen[1], "dimension": 2, "inRange": {"color": SHADES}, "show": False},
        "series": [{"type": "surface", "wireframe": {"show": False}, "data": points, "dataShape": list(heights.shape)}],
    }
