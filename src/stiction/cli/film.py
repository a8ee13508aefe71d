"""`stiction film`: the stresses in a film, in the body below and at their interface."""

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

if TYPE_CHECKING:
    import xarray

    from stiction.studies.case.read import Case


@app.command(cls=TakesOptionsOfRecords)
def film(
    context: typer.Context,
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file of a contact with a film.")],
    load: Load = None,
    model: Annotated[
        str | None, typer.Option(help="Model in place of the case's, a sum over asperities.", autocompletion=keys_of("model"))
    ] = None,
    asperity: Asperity = None,
    tangential: Tangential = None,
    all_rows: AllRows = False,
    out: Out = None,
    json: Json = False,
) -> None:
    """Stresses in a film: where film, interface or body yields first, and what peels the film off.

    Of the mean touching asperity, pressed and dragged, by the stresses of an elastic sphere on a film: the film law is layered,
    whatever the case names. Tension and shear at the interface are over the yield stress, and the shear yield stress, of the
    weaker of film and body. With --out: film.csv, film.nc (netCDF4), and of the middle one of the points that press, or --load,
    section.nc and film.png, the section under the asperity. The options of a model or a law may be given too.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.studies.case.read import read_case

        chosen = read_case(case)
        chosen = chosen if load is None else chosen.at_load(load)
    laws = {"model": model, "asperity": asperity, "tangential": tangential, "film": "layered"}
    with solving():
        from stiction.studies.case.results import film_of_case

        data = film_of_case(chosen, chosen.choice.with_changes(laws, options_of_records(context)))
    files = _write(out, chosen, data) if out is not None else []
    if json:
        from stiction.report.files import record

        print_json(record(data, chosen.subject.groups()))
        return
    _print(chosen, data, all_rows)
    if out is not None:
        written(out, files)


def _print(case: "Case", data: "xarray.Dataset", all_rows: bool) -> None:
    from rich.text import Text

    from stiction.report.film_tables import MEANINGS, film_table
    from stiction.report.tables import outside_validity, run_summary

    terminal = console()
    terminal.print(run_summary(case, data), "", film_table(data, all_rows), "")
    terminal.print(*(Text(one, style="dim") for one in MEANINGS), sep="\n")
    if data.attrs.get("remarks"):
        terminal.print(Text(data.attrs["remarks"], style="yellow"))
    beyond = outside_validity(data)
    if beyond is not None:
        terminal.print(beyond)


def _figure(case: "Case", point: "xarray.Dataset", section: "xarray.Dataset"):
    from stiction.report.film_pictures import film_figure

    return film_figure(point, section, case.title)


def _write(out: Path, case: "Case", data: "xarray.Dataset") -> list[str]:
    """Write tables and the picture; returns their names."""
    with writing():
        from stiction.report.files import comments_of, write_csv, write_folder, write_netcdf, write_picture
        from stiction.studies.stresses.film_section import film_section
        from stiction.studies.stresses.film_stress import middle_point

        point = middle_point(data)
        section = film_section(case.subject, point)
        files = {
            "film.csv": lambda path: write_csv(data, path, comments_of(data)),
            "film.nc": lambda path: write_netcdf(data, path),
            "section.nc": lambda path: write_netcdf(section, path),
            "film.png": lambda path: write_picture(_figure(case, point, section), path),
        }
        write_folder(out, files)
    return list(files)
