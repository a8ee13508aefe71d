"""`stiction models`: every model and law, and all of one."""

from typing import Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, app, console, every_key


@app.command()
def models(
    keys: Annotated[
        list[str] | None,
        typer.Argument(metavar="[KEY]...", help="Say all of these; else a line of each.", autocompletion=every_key),
    ] = None,
    json: Json = False,
) -> None:
    """Every model and law: key, kind, provenance grade, source, range of validity; what is missing where there is none.
    With KEY also its assumptions, equations and check numbers."""
    from stiction.solving.overview import models as all_models

    rows = all_models(keys or None)
    if json:
        print_json(rows)
        return
    from stiction.report.tables import grades, model_in_full, models_tables

    terminal = console()
    for row in rows if keys else ():
        terminal.print(model_in_full(row), "")
    if not keys:
        terminal.print(models_tables(rows), grades())
