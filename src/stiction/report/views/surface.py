"""Build the view of a measured surface: tables, sentences, files and pictures."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.case.text import inline
from stiction.quantities.shown import show
from stiction.report.files import as_json, write_csv, write_netcdf, write_rows
from stiction.report.table import Column, Table, facts, notes, numbers, short, shown
from stiction.report.view import Picture, View, picture
from stiction.studies.scans.analysis import Analysis, spectrum_rows, summary
from stiction.studies.scans.map_contact import summary_of_contact
from stiction.surfaces.areal_parameters import areal_parameters, profile_parameters
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.spikes import SUSPICIOUS
from stiction.surfaces.statistics import ProfileMoments, Statistics

if TYPE_CHECKING:
    import xarray

    from stiction.studies.scans.analysis import Analysis
    from stiction.studies.scans.map_contact import ContactOfMap
    from stiction.surfaces.measured import Measured


def surface_summary(analysis: Analysis) -> Table:
    """Return a table of a scan: size, heights, roughness parameters, slopes, curvatures and spectral moments."""
    surface, measured, spectrum = analysis.surface, analysis.statistics, analysis.spectrum
    rows, columns = surface.heights.shape
    y, x = (shown(length, "scan_size") for length in surface.size)
    dy, dx = (shown(length, "scan_size") for length in surface.pitch)
    along = surface.is_profile
    lengths = {name: shown(getattr(measured, name), "scan_size") for name in ("Sq", "Sa", "Sz")}
    slopes = [f"{measured.slope_x:.4g} along x"]
    curvatures = [f"{measured.curvature_x:.4g} 1/m along x"]
    if not along:
        slopes += [f"{measured.slope_y:.4g} along y", f"{measured.slope:.4g} of the gradient (Sdq)"]
        curvatures += [f"{measured.curvature_y:.4g} 1/m along y", f"{measured.curvature:.4g} 1/m of half the Laplacian"]
    ends = [shown(length, "scan_size") for length in (spectrum.shortest, spectrum.longest)]
    there = spectrum.shortest < spectrum.longest
    reliable = f"wavelengths {ends[0]} to {ends[1]}" if there else "no wavelength: too few points"
    return facts(
        [
            ("scan", surface.name),
            ("size", f"{x}, pitch {dx}" if along else f"{x} x {y} (x, y), pitch {dx} x {dy}"),
            ("points", f"{columns} of a profile" if along else f"{columns} x {rows}"),
            ("missing", _missing(surface)),
            ("done", "\n".join(surface.history)),
            ("heights", ", ".join(f"{name} = {length}" for name, length in lengths.items())),
            ("", f"skewness Ssk = {round(measured.Ssk, 4) + 0.0:g}, kurtosis Sku = {measured.Sku:.4g} (3 of a Gaussian)"),
            *([_profile_row(surface, measured)] if along else _areal_rows(surface)),
            ("rms slope", ", ".join(slopes)),
            ("rms curvature", ", ".join(curvatures)),
            ("reliable", reliable),
            ("moments", _moments(analysis.by_differences)),
            ("", _moments(analysis.by_spectrum)),
        ]
    )  # fmt: skip


def _profile_row(surface: HeightMap, measured: Statistics) -> tuple[str, str]:
    """Return (heading, text) with the parameters of a profile under their names in ISO 21920-2."""
    values = profile_parameters(surface, measured).items()
    texts = {name: shown(value, "scan_size") if name[1:] in ("a", "q", "t") else short(value) for name, value in values}
    return "ISO 21920-2", ", ".join(f"{name} = {text}" for name, text in texts.items())


def _areal_rows(surface: HeightMap) -> list[tuple[str, str]]:
    """Return pairs (heading, text) with Sp, Sv, Sdr, Sal, Str, Sk, Spk, Svk, Smr1 and Smr2 of ISO 25178-2."""
    parameters = asdict(areal_parameters(surface))
    ratios = {"Sdr", "Str", "Smr1", "Smr2"}
    texts = {
        name: "not within the map" if value is None else short(value) if name in ratios else shown(value, "scan_size")
        for name, value in parameters.items()
    }
    rows = [("ISO 25178-2", ("Sp", "Sv", "Sdr")), ("", ("Sal", "Str")), ("", ("Sk", "Spk", "Svk", "Smr1", "Smr2"))]
    return [(head, ", ".join(f"{name} = {texts[name]}" for name in names)) for head, names in rows]


def surface_in_short(analysis: Analysis) -> Table:
    """Return a short table of a scan: size, heights, kind of surface, spikes and asperities."""
    surface, of_heights = analysis.surface, analysis.statistics
    rows, columns = surface.heights.shape
    y, x = (shown(length, "scan_size", 3) for length in surface.size)
    size = f"{x}, {columns} points" if surface.is_profile else f"{x} x {y}, {columns} x {rows} points"
    slope = of_heights.slope_x if surface.is_profile else of_heights.slope
    missing = f", {_missing(surface)} missing" if surface.missing else ""
    spikes = f"{analysis.spikes} points stand out: mask them with --spikes {SUSPICIOUS:g}" if analysis.spikes else ""
    kind = analysis.kind or 'not found; if known, add e.g. kind = "ground" to the asperities below'
    heights = f"Sq {shown(of_heights.Sq, 'scan_size', 3)}, skewness {round(of_heights.Ssk, 2) + 0.0:g}, rms slope {slope:.2g}"
    return facts(
        [
            ("Scan", f"{size}{missing}"),
            ("Heights", f"{heights}; kind: {kind}"),
            ("Spikes", spikes),
            ("Asperities", _in_short(analysis)),
        ]
    )  # fmt: skip


def _in_short(analysis: Analysis) -> str:
    each = analysis.asperities
    if not each:
        return "none found: see --details"
    radii = [found_asperities.radius for found_asperities in each.values()]
    ends = [shown(end, "asperity_radius", 2) for end in (min(radii), max(radii))]
    return f"by {analysis.standing}; R = {ends[0]} to {ends[1]} over {len(each)} methods"


def use_this(analysis: Analysis, case_table: Mapping[str, Any]) -> list[Text]:
    """Return the lines of a case file that use this surface, once by the scan and once by the numbers of its asperities.

    case_table: roughness table of a case that reads the scan again.
    """
    numbers = asperity_numbers(analysis)
    lines = ["Use this in a case:", *_lines(case_table, "the scan itself")]
    lines += _lines(numbers, "or its asperities") if numbers else []
    return [Text(line, no_wrap=True) for line in lines]


def asperity_numbers(analysis: Analysis) -> dict[str, Any]:
    """Return the roughness table of a case with sigma, R and N of this surface; {} if no asperities were found.

    The heights are stated as Weibull only if a Weibull distribution was fitted and the kind of surface is unknown. Otherwise no
    distribution is stated, which means Gaussian heights: for these the errors of the models are known.
    """
    if not analysis.standing:
        return {}
    chosen, heights = analysis.asperities[analysis.standing], analysis.heights[analysis.standing]
    parameters = {name: float(f"{value:.3g}") for name, value in heights.parameters.items() if heights.name == "weibull"}
    return {
        "asperity_height_deviation": show(chosen.deviation, "asperity_height_deviation", 3).replace("µ", "u"),
        "asperity_radius": show(chosen.radius, "asperity_radius", 3).replace("µ", "u"),
        "asperity_density": f"{chosen.density:.3g} 1/m^2",
        **({"kind": analysis.kind} if analysis.kind else {}),
        **({"height_distribution": "weibull", "height_parameters": parameters} if parameters and not analysis.kind else {}),
    }


def _lines(table: Mapping[str, Any], comment: str) -> list[str]:
    return [f"[contact.roughness]  # {comment}", *(f"{key} = {inline(value)}" for key, value in table.items())]


def _missing(surface: HeightMap) -> str:
    return f"{surface.missing} points ({surface.missing / surface.heights.size:.2%})" if surface.missing else "none"


def _moments(profile: ProfileMoments) -> str:
    moments = profile.equivalent or profile.isotropic
    return (
        f"m0 = {moments.m0:.4g} m², m2 = {moments.m2:.4g}, m4 = {moments.m4:.4g} 1/m², Nayak's alpha = {moments.alpha:.4g} by "
        f"{profile.method}, cutoff {shown(profile.cutoff, 'scan_size')}"
    )


def asperity_table(analysis: Analysis) -> Table:
    """Return a table of the asperities of one scan by each method: sigma, R, N, number, height distribution, skewness."""
    rows = []
    for method, result in analysis.asperities.items():
        cells = _cells(result.deviation, result.radius, result.density)
        count = str(result.count) if result.count else "-"
        rows.append([method, *cells, count, analysis.heights[method].name, short(result.skewness, 3)])
    return _table(rows, "found", "heights", "skewness")


def surface_notes(analysis: Analysis) -> list[Table]:
    """Return notes on spikes, on the spectrum, on each asperity method, and on why a method found no asperities."""
    lines = []
    if analysis.spikes:
        lines.append(
            f"input warning: {analysis.spikes} points are more than {SUSPICIOUS:g} robust deviations from the median: spikes? "
            f"They set Sq, Sz and the threshold of persistent summits; --spikes {SUSPICIOUS:g} masks them"
        )
    lines += [f"spectrum and its moments: {analysis.of_spectrum}"] if analysis.of_spectrum else []
    lines += [f"{method}: {result.note}; {analysis.heights[method].reason}" for method, result in analysis.asperities.items()]
    lines += [f"{method} found no asperities: {why}" for method, why in analysis.failures.items()]
    return notes(lines)


def roughness_table(measured: "Measured", data: "xarray.Dataset | None" = None) -> Table:
    """Return a table of the combined sigma, R and N of both bodies by each asperity method; the method used is bold.

    data: result of the case, which adds mu at the smallest and at the largest compressive load; None for no mu.
    """
    friction = None if data is None else data.get("friction_coefficient_by_method")
    loads = _ends(data) if friction is not None and data is not None else []
    rows = []
    for method, item in measured.by_method.items():
        numbers = item.asperity_height_deviation, item.asperity_radius, item.asperity_density
        cells = _cells(*map(float, numbers))
        mu: Any = [] if friction is None else friction.sel(asperity_method=method).values.ravel()[[index for index, _ in loads]]
        rows.append([method, *cells, item.height_distribution, *(short(value, 3) for value in mu)])
    table = _table(rows, "heights", *(f"mu at\n{shown(load, 'load', 3)}" for _, load in loads))
    return replace(table, looks=["bold" if method == measured.method else "" for method in measured.by_method])


def roughness_notes(measured: "Measured") -> list[Table]:
    """Return notes on the asperity method used, on methods that found nothing, and on how the scans were processed."""
    count = measured.counts[measured.method]
    counted = f" ({count} asperities)" if count else ""
    band = "; a band of mu is the range over all methods" if len(measured.by_method) > 1 else ""
    lines = [f"method: {measured.method}{counted}{band}"]
    lines += [f"{name} found no asperities: {why}" for name, why in measured.failures.items()]
    lines += [f"{body} body: {step}" for body, steps in measured.history.items() for step in steps]
    return notes(lines)


def map_notes(data: "xarray.Dataset") -> list[Table]:
    """Return notes on the contact of a height map: preparation, resolution, and area and plastic fraction at the last load."""
    last = data.isel({name: -1 for name in data["load"].dims})
    every = int(last["point_spacing"])
    lines = [
        *data.attrs["scans"].splitlines(),
        f"solved: {'every point' if every == 1 else f'every {every}th point along rows and columns'}, "
        f"{float(last['points_in_shortest_wave']):.3g} points of the map per shortest wavelength, "
        f"{float(last['longest_waves_on_a_side']):.3g} longest wavelengths on a side, "
        f"gradient {float(last['map_gradient']):.3g}",
        f"at {shown(float(last['load']), 'load', 3)}: area {shown(float(last['contact_area']), 'contact_area', 3)}, "
        f"{shown(float(last['contact_area_pixels']), 'contact_area', 3)} counted in points; "
        f"{float(last['load_share_plastic']):.1%} of the load on points at the hardness",
    ]
    return notes(lines)


def contact_table(contact: "ContactOfMap") -> Table:
    """Return a table of the contact of a height map, one row for each nominal pressure."""
    heads = (re.sub(r" (?=in |load)|(?=/\(|/Sq)", "\n", head) for head in contact.columns)
    rows = [[short(value, 3) for value in row] for row in zip(*contact.columns.values(), strict=True)]
    return Table(numbers(*heads, wrap=True), rows)


def contact_notes(contact: "ContactOfMap") -> list[Text]:
    """Return notes on how the contact of a height map was solved, with its validity warnings."""
    yields = "elastic" if contact.hardness is None else f"no pressure above {contact.hardness:g} E* h'"
    of_map = contact.curve.of_map
    solved = (
        f"contact: {yields}, h' = {contact.gradient:.3g}, "
        f"{of_map['points_in_shortest_wave']:.3g} points per shortest wavelength, "
        f"{of_map['longest_waves_on_a_side']:.3g} longest wavelengths on a side"
    )
    lines = [
        Text(solved, style="dim"),
        *(Text(f"validity warning: {warning}", style="bold yellow") for warning in contact.all_warnings()),
    ]
    return lines


def _table(rows: list[list[str]], *more: str) -> Table:
    return Table([Column("method"), *numbers("sigma", "R", "N\n1/m²", "N R\nsigma", *more)], rows, gap=1)


def _cells(deviation: float, radius: float, density: float) -> list[str]:
    lengths = shown(deviation, "asperity_height_deviation", 3), shown(radius, "asperity_radius", 3)
    return [*lengths, f"{density:.2e}", short(deviation * radius * density, 3)]


def _ends(data: "xarray.Dataset") -> list[tuple[int, float]]:
    """Return (index, load [N]) of the smallest and of the largest compressive load; [] if there is none."""
    loads = np.atleast_1d(data["load"].values).ravel()
    pressed = np.flatnonzero(loads > 0.0)
    if not pressed.size:
        return []
    order = pressed[np.argsort(loads[pressed])]
    return [(int(index), float(loads[index])) for index in dict.fromkeys((order[0], order[-1]))]


def surface_view(
    analysis: "Analysis",
    case_table: Mapping[str, Any],
    solved: "ContactOfMap | None" = None,
    resolution: "xarray.Dataset | None" = None,
    details: bool = False,
) -> View:
    """Return the view (texts, tables, files and pictures) of a measured surface.

    case_table: roughness table of a case that reads the scan again. solved: contact of the height map, or None. resolution:
    resolution study to be written to files, or None. details: whether to print all results.
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
        if resolution is not None and "mu" in resolution and not resolution["mu"].notnull().any():
            why = resolution["failure"].values.flat[0]
            yield Text(f"warning: no cutoff and method gives mu: {why}", style="bold yellow")

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
        "asperities.png": picture("asperities by every method", "surface_pictures.asperity_figure", asperities, surface),
    }
    if resolution is not None:
        pictures["fan.png"] = picture("effect of the resolution", "method_pictures.resolution_figure", resolution)
    return pictures


def _write_pressure(path: Path, solved: "ContactOfMap") -> None:
    """Write the pressure maps, divided by E* h', to a .npy file: one map for each nominal pressure that was solved."""
    import numpy as np

    maps = [
        solution.pressure / solved.gradient
        for solution in solved.curve.contacts
        if solution is not None and solution.pressure is not None
    ]
    np.save(path, np.array(maps))
