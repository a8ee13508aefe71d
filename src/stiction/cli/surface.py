"""Define the command `stiction surface`, which analyses one scan."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.cli.options import Json, Out, argument, option
from stiction.cli.program import app, bar, busy, console, present, solving
from stiction.quantities.errors import InputError

if TYPE_CHECKING:
    from stiction.case.read import Case


@app.command()
def surface(
    file: Path = argument("FILE", "Scan: an array, a text file with numbers, or an instrument file."),
    size: str | None = option('Size along x, e.g. "10 um"; by default as the file states.'),
    unit: str | None = option("Length unit of the numbers in the file, e.g. nm."),
    height_unit: str | None = option("Length unit of the heights, if it differs."),
    height_scale: float | None = option("Factor by which heights are multiplied, not 0."),
    channel: str | None = option("Name or number of the channel to read."),
    form: int = option("Order of the polynomial to remove: 1 for a plane, 0 for nothing.", 1, min=0, max=4),
    spikes: float | None = option("Mask points further than this many robust deviations from the median, e.g. 10."),
    fill: str | None = option("Fill missing points: harmonic or nearest; by default they stay missing."),
    shortest: str | None = option('Shortest wavelength to keep, e.g. "200 nm".'),
    longest: str | None = option('Longest wavelength to keep, e.g. "5 um".'),
    tip_radius: str | None = option('Radius of the stylus tip, e.g. "2 um"; the tip limits the reliable wavelengths.'),
    case: Path | None = option("Case file; the resolution study then includes its mu with this surface."),
    load: str | None = option('Load of --case, e.g. "1 N"; default: the middle load of the case.'),
    contact: str | None = option(
        "Solve the contact of the scan at these nominal pressures divided by E* h' (h': rms gradient), e.g. \"0.01 0.1\"."
    ),
    hardness: float | None = option("Hardness of --contact, divided by E* h'; by default the contact is elastic."),
    periodic: bool = option("Treat the scan as one period of an infinite surface; no form is removed.", False, "--periodic"),
    save_map: Path | None = option("Write the prepared map to this file: .gwy (Gwyddion), .x3p or .sdf."),
    details: bool = option("Also print spectral moments, and the asperities by every method.", False, "--details"),
    out: Out = None,
    json: Json = False,
) -> None:
    """Analyse a measured surface: heights, kind of surface, asperities, and the lines of a case file that use it.

    --contact also solves the contact of the surface with a flat by boundary elements: real area, separation, stiffness. --out
    writes map.png, spectrum.png, asperities.png, surface.json, spectrum.csv, with --contact also contact.csv and pressure.npy,
    and the resolution study as fan.png, fan.csv and fan.nc: how sigma, R and N (and with --case mu) depend on the asperity
    method and on the shortest wavelength.
    """
    if out is None and (case is not None or load is not None):
        what, value = ("--load", load) if case is None else ("--case", str(case))
        raise InputError(what, value, "only with --out, which writes the resolution study")
    pressures = _pressures(contact, hardness)
    reading: dict[str, Any] = {
        "size": size, "unit": unit, "height_unit": height_unit, "height_scale": height_scale, "channel": channel,
    }  # fmt: skip
    with busy("Reading the scan"):
        from stiction.studies.scans.analysis import analyse
        from stiction.surfaces.prepare import prepared
        from stiction.surfaces.read import read_scan

        chosen, chosen_load = _chosen(case, load)
        scan = read_scan(file, **reading)
        periodic = periodic or scan.periodic
        scan = prepared(replace(scan, periodic=periodic), form, spikes, fill, shortest, longest, periodic)
    if save_map is not None:
        from stiction.surfaces.writing import write_map

        write_map(scan, save_map)
    analysis = analyse(scan, progress=bar("Analysing"), tip_radius=tip_radius)
    solved = resolution = None
    if pressures:
        with solving():
            from stiction.studies.scans.map_contact import contact_of_map

            solved = contact_of_map(scan, pressures, hardness)
    if out is not None:
        from stiction.studies.prediction.predict import is_predicted
        from stiction.studies.scans.resolution import default_cutoffs, resolution_study

        contact_at: dict[str, Any] = {}
        if chosen is not None:
            choice = None if is_predicted(chosen) else chosen.choice
            contact_at = {"contact": chosen.subject, "load": chosen_load, "choice": choice}
        cutoffs = default_cutoffs(analysis.surface, analysis.spectrum.shortest)  # the tip could not follow shorter waves
        resolution = resolution_study(analysis.surface, cutoffs, progress=bar("Studying the resolution"), **contact_at)
    from stiction.report.views.surface import surface_view

    steps = {"form": form, "spikes": spikes, "fill": fill, "shortest": shortest, "longest": longest}
    body = {"file": file.as_posix(), **reading, "periodic": periodic or None}
    table = {name: value for name, value in steps.items() if value is not None and (name, value) != ("form", 1)}
    case_table = {"first": {name: value for name, value in body.items() if value is not None}} | table
    present(surface_view(analysis, case_table, solved, resolution, details), out, json)
    if save_map is not None and not json:
        console().print(f"written to {save_map}", highlight=False, markup=False, soft_wrap=True)


def _pressures(contact: str | None, hardness: float | None) -> list[float]:
    """Return the nominal pressures of --contact, divided by E* h'; [] without --contact.

    Raises InputError for text that is not a list of numbers, and for a hardness without --contact.
    """
    if contact is None:
        if hardness is not None:
            raise InputError("--hardness", hardness, "only with --contact")
        return []
    try:
        return [float(word) for word in contact.replace(",", " ").split()]
    except ValueError:
        raise InputError("--contact", contact, "pressures over E* h', above 0, separated by spaces, e.g. 0.01 0.1") from None


def _chosen(case: Path | None, load: str | None) -> "tuple[Case | None, Any]":
    """Return the case of --case and its working load; (None, None) without --case.

    load: text of --load, or None for the middle load of the case. Raises InputError for a load without a case, for a case of
    indices, and for a case without a compressive load.
    """
    if case is None:
        if load is not None:
            raise InputError("--load", load, "only with --case")
        return None, None
    from stiction.case.read import read_case
    from stiction.contact.contact import Contact
    from stiction.studies.comparison.compare import working_load

    chosen = read_case(case)
    if not isinstance(chosen.subject, Contact):
        raise InputError("--case", str(case), "a case with [contact], because [indices] describe no surface")
    chosen_load = working_load(chosen, load)
    if chosen_load is None:
        raise InputError("--load", None, "a compressive load, because the case has none")
    return chosen, chosen_load
