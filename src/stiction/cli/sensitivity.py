"""`stiction sensitivity`: which input should be measured better."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Out, Ranges, app, bar, busy, console, writing, written

if TYPE_CHECKING:
    import xarray


@app.command()
def sensitivity(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file in which numbers of the contact are uncertain.")],
    load: Annotated[str | None, typer.Option(help='Only at this load, e.g. "1 N"; default: nine of the case at most.')] = None,
    models: Annotated[
        str | None,
        typer.Option(
            metavar="NAMES",
            help="Models among which is drawn, with commas between, or: none, for that of the case alone. Default: those that "
            "compare recommends, by their weights.",
        ),
    ] = None,
    ranges: Ranges = None,
    out: Out = None,
    json: Json = False,
) -> None:
    """Which of the inputs should be measured better: of friction, area, load and pull-off.

    Sobol indices with 95 % intervals and Morris effects over what is uncertain, the ways of finding asperities and the models;
    elasticities d ln mu/d ln x for every number of the contact. With --out: sensitivity.csv, elasticities.csv, sensitivity.nc
    (netCDF4) and sensitivity.png. Numbers are uncertain as "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or {samples} in the
    case, or with --ranges, within the ranges of their materials.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.studies.case.read import read_case
        from stiction.studies.uncertainty.sensitivity import sensitivity as studied

        chosen = read_case(case, ranges=ranges)
    names = None if models is None else [] if models.strip() == "none" else [one.strip() for one in models.split(",")]
    data = studied(chosen, load=load, models=names, progress=bar)
    files = _write(out, data) if out is not None else []
    if json:
        from stiction.report.files import record

        print_json(record(data, chosen.subject.groups()))
        return
    from stiction.report.sensitivity_tables import elasticities_table, indices_table, sensitivity_notes
    from stiction.report.whole_keys import WholeKeys

    terminal = console()
    if "input" in data.dims:
        terminal.print(WholeKeys(indices_table(data)), "", sep="\n")
    terminal.print(elasticities_table(data), "", *sensitivity_notes(data), sep="\n")
    if out is not None:
        written(out, files)


def _figure(data: "xarray.Dataset"):
    from stiction.report.sensitivity_pictures import sensitivity_figure

    return sensitivity_figure(data)


def _write(out: Path, data: "xarray.Dataset") -> list[str]:
    """Write tables and the picture; returns their names."""
    with writing("Drawing"):
        from stiction.report.files import write_csv, write_folder, write_netcdf, write_picture

        files: dict[str, Callable[[Path], None]] = {
            name: partial(write_csv, data[[one for one in data.data_vars if dim in data[one].dims]])
            for name, dim in (("sensitivity.csv", "input"), ("elasticities.csv", "number"))
            if dim in data.dims
        }
        files |= {
            "sensitivity.nc": lambda path: write_netcdf(data, path),
            "sensitivity.png": lambda path: write_picture(_figure(data), path),
        }
        write_folder(out, files)
    return list(files)
