"""`stiction fit`: numbers of a case, from measured series."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Out, app, bar, busy, console, writing, written

if TYPE_CHECKING:
    import xarray

    from stiction.studies.fit.run import Fitting


@app.command()
def fit(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file with a table [fit]: what is free.")],
    data: Annotated[Path, typer.Option("--data", metavar="MEASURED.csv", help="Measured series, units in the heads.")],
    out: Out = None,
    json: Json = False,
) -> None:
    """Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

    The case says in [fit.free] which numbers are free, between which ends. Intervals are of 95 %, by the profile of the
    likelihood; what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, fit.png,
    profiles.png, parameters.csv, residuals.csv, predictions.csv, fit.nc. Interrupted once the case's model is fitted, it keeps
    that.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.studies.fit.run import plan_of_fit, run_fit

        plan = plan_of_fit(case, data)
    found = run_fit(plan, bar)
    result = found.data()
    names = _write(out, found, result) if out is not None else []
    if json:
        from stiction.report.files import record

        print_json(record(result, {}))
    else:
        _print(result, plan.title)
        if out is not None:
            written(out, names)
    if found.stopped:
        raise KeyboardInterrupt


def _print(data: "xarray.Dataset", title: str) -> None:
    from stiction.report.fit_tables import evidence_table, fit_notes, parameter_table
    from stiction.report.whole_keys import WholeKeys

    terminal = console()
    if title:
        terminal.print(title, style="bold", highlight=False, markup=False)
    terminal.print(f"model {data.attrs['model']}", "", sep="\n", highlight=False)
    terminal.print(parameter_table(data), "")
    for note in fit_notes(data):
        terminal.print(note)
    if "model" in data.dims:
        terminal.print("", WholeKeys(evidence_table(data)))


def _figure(found: "Fitting", data: "xarray.Dataset"):
    from stiction.report.fit_pictures import fit_figure

    return fit_figure(data, found.plan.title)


def _profiles(data: "xarray.Dataset"):
    from stiction.report.fit_pictures import profile_figure

    return profile_figure(data)


def _write(out: Path, found: "Fitting", data: "xarray.Dataset") -> list[str]:
    """Write the fitted case, tables and pictures; returns their names."""
    with writing():
        from stiction.report.files import write_csv, write_folder, write_netcdf, write_picture, write_rows
        from stiction.report.fit_tables import parameter_rows, prediction_names, row_rows

        files = {
            "fitted.toml": lambda path: path.write_text(found.case_text(out), encoding="utf-8"),
            "fit.png": lambda path: write_picture(_figure(found, data), path),
            "profiles.png": lambda path: write_picture(_profiles(data), path),
            "parameters.csv": lambda path: write_rows(path, *parameter_rows(data)),
            "residuals.csv": lambda path: write_rows(path, *row_rows(data)),
            "fit.nc": lambda path: write_netcdf(data, path),
        }
        names = prediction_names(data)
        if names:
            files["predictions.csv"] = lambda path: write_csv(data[names].drop_vars(_OTHERS, errors="ignore"), path)
        write_folder(out, files)
    return list(files)


_OTHERS = ("parameter", "other_parameter", "row", "model")
