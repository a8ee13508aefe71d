"""`stiction run`: one case, solved."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import (
    AllRows,
    Asperity,
    Json,
    Load,
    Out,
    Ranges,
    TakesOptionsOfRecords,
    Tangential,
    app,
    busy,
    console,
    keys_of,
    options_of_records,
    solving,
    writing,
    written,
)
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES

if TYPE_CHECKING:
    import xarray

    from stiction.studies.case.read import Case

# Inputs of the Python interface that no case file has.
_NOT_IN_CASES = ("interfacial_energy", "equilibrium_distance")


def case_numbers() -> str:
    """Unit and bounds of every number of a case file, a paragraph for each, for --help."""
    rows = [row for row in QUANTITIES.values() if row.example and row.name not in _NOT_IN_CASES]
    lines = [f"{row.name}: {row.meaning}; {row.wanted}" for row in rows]
    return "\n\n".join(["Numbers of a case file, text with its unit where it has one:", *lines])


@app.command(cls=TakesOptionsOfRecords, epilog=case_numbers())
def run(
    context: typer.Context,
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact and what to solve.")],
    out: Out = None,
    model: Annotated[
        str | None,
        typer.Option(help="Any model that stiction compare shows, or: recommended.", autocompletion=keys_of("model")),
    ] = None,
    asperity: Asperity = None,
    tangential: Tangential = None,
    film: Annotated[str | None, typer.Option(help="Film law in place of its own.", autocompletion=keys_of("film"))] = None,
    presliding: Annotated[str | None, typer.Option(help="mindlin_1949: also the tangential stiffness before sliding.")] = None,
    meniscus: Annotated[
        str | None, typer.Option(help="Law of menisci of a liquid; none: without.", autocompletion=keys_of("meniscus"))
    ] = None,
    ageing: Annotated[
        str | None, typer.Option(help="Law of strengthening at rest; none: without.", autocompletion=keys_of("ageing"))
    ] = None,
    contamination: Annotated[
        str | None, typer.Option(help="Law of junctions that differ; none: without.", autocompletion=keys_of("contamination"))
    ] = None,
    sliding: Annotated[
        bool,
        typer.Option("--sliding", help="Tangential force against displacement up to sliding, at five of the points at most."),
    ] = False,
    kept: Annotated[
        float, typer.Option(help="With --sliding: share of its strength that an asperity keeps once it slides, 0 to 1.")
    ] = 1.0,
    load: Load = None,
    all_rows: AllRows = False,
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """Solve a case: friction coefficient, contact area and load along a curve.

    The table shows about twelve of the points, --all-rows every one.
    With --out: curve.csv (with comments after #), curve.nc (netCDF4) and curve.png. What is given here overrides the case file;
    the options of a model or a law may be given too, such as --reading published: stiction models KEY names them.
    Any number of the contact may be several, a list or {start, stop, count, spacing}: then the picture and the table show mu
    against it. Where numbers are uncertain, "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or {samples}, or numbers of
    materials vary within their --ranges, mu has a band, with the error of its sampling, drawn in uncertainty.png. Where the
    case names scans, the spread of mu over the methods of finding asperities is its error band, drawn in band.png.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.studies.case.read import read_case

        chosen = read_case(case, ranges=ranges)
        chosen = chosen if load is None else chosen.at_load(load)
    laws = {
        "model": model,
        "asperity": asperity,
        "tangential": tangential,
        "film": film,
        "presliding": presliding,
        "meniscus": meniscus,
        "ageing": ageing,
        "contamination": contamination,
    }
    if kept != 1.0 and not sliding:
        raise InputError("--kept", kept, "nothing without --sliding")
    if sliding:
        _report_sliding(chosen, _slide(chosen, laws, options_of_records(context), kept), out, json)
        return
    data = _solve(chosen, laws, options_of_records(context))
    chosen = chosen.with_surface_moments(data.attrs["model"])
    names = _write_run(out, chosen, data) if out is not None else []
    if json:
        _print_json(chosen, data)
        return
    _print_run(chosen, data, all_rows)
    if out is not None:
        written(out, names)


def _solve(case: "Case", laws: Mapping[str, str | None], options: Mapping[str, str]) -> "xarray.Dataset":
    with solving():
        from stiction.studies.case.results import solve_case

        return solve_case(case, case.choice.with_changes(laws, options))


def _slide(case: "Case", laws: Mapping[str, str | None], options: Mapping[str, str], kept: float) -> "xarray.Dataset":
    with solving():
        from stiction.studies.case.results import slide_case

        return slide_case(case, case.choice.with_changes(laws, options), kept)


def _report_sliding(case: "Case", data: "xarray.Dataset", out: Path | None, json: bool) -> None:
    """Write and print what --sliding asks for."""
    from stiction.report.files import comments_of, record, write_csv, write_folder, write_netcdf, write_picture
    from stiction.report.sliding import sliding_notes, sliding_table

    names = {
        "sliding.csv": lambda path: write_csv(data, path, comments_of(data)),
        "sliding.nc": lambda path: write_netcdf(data, path),
        "sliding.png": lambda path: write_picture(_sliding(case, data), path),
    }
    if out is not None:
        with writing():
            write_folder(out, names)
    if json:
        print_json(record(data, case.subject.groups()))
        return
    from stiction.report.tables import outside_validity, run_summary

    terminal = console()
    terminal.print(run_summary(case, data), "", sliding_table(data), "")
    for note in sliding_notes(data):
        terminal.print(note, style="dim")
    if (beyond := outside_validity(data)) is not None:
        terminal.print(beyond)
    if out is not None:
        written(out, list(names))


def _write_run(out: Path, case: "Case", data: "xarray.Dataset") -> list[str]:
    """Write tables and pictures; returns their names."""
    with writing():
        from stiction.report.files import comments_of, write_csv, write_folder, write_netcdf, write_picture
        from stiction.solving.method_spread import as_columns
        from stiction.studies.uncertainty.bands import as_columns as with_quantiles

        files = {
            "curve.csv": lambda path: write_csv(with_quantiles(as_columns(data)), path, comments_of(data)),
            "curve.nc": lambda path: write_netcdf(data, path),
            "curve.png": lambda path: write_picture(_figure(case, data), path),
        }
        if "friction_coefficient_by_method" in data and not case.is_several:
            files["band.png"] = lambda path: write_picture(_methods(case, data), path)
        if "friction_coefficient_quantile" in data and not case.is_several:
            files["uncertainty.png"] = lambda path: write_picture(_uncertainty(case, data), path)
        write_folder(out, files)
    return list(files)


def _figure(case: "Case", data: "xarray.Dataset"):
    if case.is_several:
        from stiction.report.several_pictures import several_figure

        return several_figure(data, case.title)
    from stiction.report.pictures import curve_figure

    return curve_figure(data, case.title)


def _methods(case: "Case", data: "xarray.Dataset"):
    from stiction.report.surface_pictures import method_spread_figure

    return method_spread_figure(data, case.title)


def _uncertainty(case: "Case", data: "xarray.Dataset"):
    from stiction.report.uncertainty_pictures import uncertainty_figure

    return uncertainty_figure(data, case.title)


def _sliding(case: "Case", data: "xarray.Dataset"):
    from stiction.report.sliding_pictures import sliding_figure

    return sliding_figure(data, case.title)


def _table(case: "Case", data: "xarray.Dataset", all_rows: bool):
    if case.is_several:
        from stiction.report.several_tables import several_table

        return several_table(data, all_rows)
    from stiction.report.tables import curve_table

    return curve_table(data, all_rows)


def _print_json(case: "Case", data: "xarray.Dataset") -> None:
    from stiction.report.files import record

    measured = {} if case.measured is None else {"measured": case.measured.record()}
    print_json(record(data, case.subject.groups()) | measured)


def _print_run(case: "Case", data: "xarray.Dataset", all_rows: bool) -> None:
    from rich.text import Text

    from stiction.report.tables import outside_validity, rows_shown, run_notes, run_summary

    terminal = console()
    terminal.print(run_summary(case, data), "", _table(case, data, all_rows), "")
    if not all_rows and not case.is_several and (text := rows_shown(data)):
        terminal.print(Text(text, style="dim"), "", sep="\n")
    if "uncertain_inputs" in data.attrs:
        from stiction.report.uncertainty_tables import band_table, uncertain_notes

        terminal.print(band_table(data), *uncertain_notes(data), "", sep="\n")
    if "point_spacing" in data:
        from stiction.report.surface_tables import map_notes

        terminal.print(*map_notes(data), "", sep="\n")
    elif case.measured is not None:
        from stiction.report.surface_tables import roughness_notes, roughness_table

        terminal.print(roughness_table(case.measured, data), *roughness_notes(case.measured), "", sep="\n")
    for note in run_notes(data):
        terminal.print(Text(note, style="dim"))
    beyond = outside_validity(data)
    if beyond is not None:
        terminal.print(beyond)
