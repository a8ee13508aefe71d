"""`stiction film`: the stresses in a film, in the body below and at their interface."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import (
    AllRows,
    Asperity,
    Details,
    Json,
    Load,
    Out,
    TakesOptionsOfRecords,
    Tangential,
    app,
    busy,
    keys_of,
    options_of_records,
    present,
    solving,
)


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
    details: Details = False,
    json: Json = False,
) -> None:
    """Stresses in a film: where film, interface or body yields first, and what peels the film off.

    Of the mean touching asperity, pressed and dragged, by the stresses of an elastic sphere on a film: the film law is layered,
    whatever the case names. Tension and shear at the interface are over the yield stress, and the shear yield stress, of the
    weaker of film and body. With --out: film.csv, film.nc (netCDF4), and of the middle one of the points that press, or --load,
    section.nc and film.png, the section under the asperity. The options of a model or a law may be given too.
    """
    with busy("Reading the case"):
        from stiction.case.read import read_case

        chosen = read_case(case)
        chosen = chosen if load is None else chosen.at_load(load)
    laws = {"model": model, "asperity": asperity, "tangential": tangential, "film": "layered"}
    with solving():
        from stiction.studies.case_results import film_of_case

        data = film_of_case(chosen, chosen.choice.with_changes(laws, options_of_records(context)))
    from stiction.report.views.film import film_view

    present(film_view(chosen, data, all_rows, out is not None), out, json, details)
