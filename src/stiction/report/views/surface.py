"""A measured surface as it is shown."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.report.files import as_json, write_csv, write_netcdf, write_rows
from stiction.report.surface_tables import (
    asperity_table,
    contact_notes,
    contact_table,
    surface_in_short,
    surface_notes,
    surface_summary,
    use_this,
)
from stiction.report.view import Picture, View, picture
from stiction.studies.scans.analysis import spectrum_rows, summary
from stiction.studies.scans.map_contact import summary_of_contact

if TYPE_CHECKING:
    import xarray

    from stiction.studies.scans.analysis import Analysis
    from stiction.studies.scans.map_contact import ContactOfMap


def surface_view(
    analysis: "Analysis",
    case_table: Mapping[str, Any],
    solved: "ContactOfMap | None" = None,
    resolution: "xarray.Dataset | None" = None,
    details: bool = False,
) -> View:
    """Return what a measured surface shows.

    case_table: the roughness of a case file that reads the scan again. solved: its contact; resolution: the resolution study,
    for files. details: whether to print all that was found.
    """

    def parts() -> Iterator[Any]:
        if details:
            yield from (surface_summary(analysis), "", asperity_table(analysis), "", *surface_notes(analysis), "")
        yield surface_in_short(analysis)
        yield from use_this(analysis, case_table)
        if not details:
            yield "Details: --details   pictures: --out DIR"
        if solved is not None:
            yield from ("", contact_table(solved), "", *contact_notes(solved))

    def record() -> dict[str, Any]:
        return summary(analysis) | ({} if solved is None else {"contact": summary_of_contact(solved)})

    files: dict[str, Any] = {
        "spectrum.csv": lambda path: write_rows(path, *spectrum_rows(analysis.spectrum)),
        "surface.json": lambda path: path.write_text(as_json(summary(analysis)) + "\n", encoding="utf-8"),
    }
    if resolution is not None:
        files["fan.csv"] = lambda path: write_csv(resolution, path)
        files["fan.nc"] = lambda path: write_netcdf(resolution, path)
    if solved is not None:
        rows = list(zip(*(values.tolist() for values in solved.columns.values()), strict=True))
        files["contact.csv"] = lambda path: write_rows(path, list(solved.columns), rows)
        files["pressure.npy"] = lambda path: _write_pressure(path, solved)
    return View("surface", None, parts, record, files, _pictures(analysis, resolution))


def _pictures(analysis: "Analysis", resolution: "xarray.Dataset | None") -> dict[str, Picture]:
    surface, asperities = analysis.surface, list(analysis.asperities.values())
    pictures = {
        "map.png": picture("heights", "surface_pictures.map_figure", surface),
        "spectrum.png": picture("power spectrum", "surface_pictures.spectrum_figure", analysis.spectrum),
        "asperities.png": picture(
            "asperities by every way of finding them", "surface_pictures.asperity_figure", asperities, surface
        ),
    }
    if resolution is not None:
        pictures["fan.png"] = picture("what the resolution decides", "method_pictures.resolution_figure", resolution)
    return pictures


def _write_pressure(path: Path, solved: "ContactOfMap") -> None:
    """Pressure maps over E* h', one for each nominal pressure that was solved."""
    import numpy as np

    maps = [one.pressure / solved.gradient for one in solved.curve.contacts if one is not None and one.pressure is not None]
    np.save(path, np.array(maps))
