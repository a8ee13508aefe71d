"""`stiction compare`: one case, every model."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Out, Ranges, app, bar, busy, console, writing, written

if TYPE_CHECKING:
    import xarray


@app.command()
def compare(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact.")],
    load: Annotated[str | None, typer.Option(help='Working load, e.g. "1 N"; default: the middle one of the case.')] = None,
    out: Out = None,
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """Every applicable model on one contact: friction of each, their spread at the working load, and which to trust.

    A contact that states an interfacial_shear_strength gets a friction coefficient from models of contact only, too.
    With --out: compare.csv (the curves), compare_at_load.csv, compare.nc (netCDF4), compare.png and spread.png: what is due to
    the inputs, to the methods and to the models, each apart. Where the case names scans, also the spread of each model over the
    methods of finding asperities; where numbers are uncertain, the band of each. A working load presses: it is above 0 N; where
    the middle one of the case is not, the nearest that is stands in, and without any there are only curves.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.report.comparison_rows import comparison
        from stiction.studies.case.read import read_case
        from stiction.studies.case.results import compare_case
        from stiction.studies.comparison.compare import working_load

        chosen = read_case(case, ranges=ranges)
        at = working_load(chosen, load)
    data = compare_case(chosen, at, bar).assign_attrs(case_file=str(case))
    names = _write_comparison(out, data, chosen.title) if out is not None else []
    if json:
        measured = {} if chosen.measured is None else {"measured": chosen.measured.record()}
        print_json(comparison(data) | measured)
        return
    from stiction.report.tables import comparison_summary, comparison_table
    from stiction.report.whole_keys import WholeKeys

    terminal = console()
    terminal.print(WholeKeys(comparison_table(data)))
    for line in comparison_summary(data):
        terminal.print(line, soft_wrap=bool(line.no_wrap))
    if "spread_factor" in data:
        from stiction.report.uncertainty_tables import models_band_table, spread_table, uncertain_notes

        terminal.print(spread_table(data))
        if "uncertain_inputs" in data.attrs:
            terminal.print(WholeKeys(models_band_table(data)), *uncertain_notes(data), sep="\n")
    if chosen.measured is not None:
        from stiction.report.surface_tables import roughness_notes, roughness_table

        terminal.print(roughness_table(chosen.measured), *roughness_notes(chosen.measured), sep="\n")
        for doubt in chosen.measured.doubts:
            terminal.print(f"doubtful: {doubt}", style="bold yellow", highlight=False, markup=False)
    if out is not None:
        written(out, names)


def _figure(data: "xarray.Dataset", title: str):
    from stiction.report.comparison_pictures import comparison_figure

    return comparison_figure(data, title)


def _spread(data: "xarray.Dataset", title: str):
    from stiction.report.uncertainty_pictures import spread_figure

    return spread_figure(data, title)


def _write_comparison(out: Path, data: "xarray.Dataset", title: str) -> list[str]:
    """Write tables and the picture; returns their names."""
    with writing("Drawing"):
        from stiction.report.comparison_rows import at_load_rows, comparison_rows
        from stiction.report.files import write_folder, write_netcdf, write_picture, write_rows

        files = {
            "compare.csv": lambda path: write_rows(path, *comparison_rows(data)),
            "compare_at_load.csv": lambda path: write_rows(path, *at_load_rows(data)),
            "compare.nc": lambda path: write_netcdf(data, path),
            "compare.png": lambda path: write_picture(_figure(data, title), path),
        }
        if "working_load" not in data.attrs:
            del files["compare_at_load.csv"]
        if "spread_factor" in data:
            files["spread.png"] = lambda path: write_picture(_spread(data, title), path)
        write_folder(out, files)
    return list(files)
