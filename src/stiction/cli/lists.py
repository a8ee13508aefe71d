"""`stiction models`, `cite` and `schema`: what there is."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Json, app, console
from stiction.quantities.errors import InputError


@app.command()
def models(
    keys: Annotated[list[str] | None, typer.Argument(metavar="[KEY]...", help="Say all of these; else a line of each.")] = None,
    json: Json = False,
) -> None:
    """Every model and law: key, kind, provenance grade, source, range of validity; what is missing where there is none.
    With KEY also its assumptions, equations and check numbers."""
    from stiction.laws.overview import models as all_models

    rows = all_models(keys or None)
    if json:
        from stiction.report.files import as_json

        print(as_json(rows))
        return
    from stiction.report.tables import grades, model_in_full, models_tables

    terminal = console()
    for row in rows if keys else ():
        terminal.print(model_in_full(row), "")
    if not keys:
        terminal.print(models_tables(rows), grades())


@app.command()
def cite(
    keys: Annotated[list[str] | None, typer.Argument(metavar="[KEY]...", help="Models or entries; all if none.")] = None,
) -> None:
    """BibTeX of models, film laws and entries of the bibliography."""
    from stiction.laws.overview import cite as bibtex_of

    print(bibtex_of(keys or None), end="")


@app.command()
def schema(out: Annotated[Path | None, typer.Option(help="File to write to; else it is printed.")] = None) -> None:
    """JSON schema of a case file, for editors that complete and check TOML."""
    from stiction.report.files import as_json
    from stiction.studies.case import json_schema

    text = as_json(json_schema())
    if out is None:
        print(text)
        return
    try:
        out.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError("--out", str(out), f"a file that can be written ({error.strerror})") from None
