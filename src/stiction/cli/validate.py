"""`stiction validate`: every model against measured series."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Json, Out, app, bar, busy, present


@app.command()
def validate(
    entry: Annotated[Path, typer.Argument(metavar="ENTRY.toml", help="Measured series and its contact, or a folder of them.")],
    out: Out = None,
    json: Json = False,
) -> None:
    """Compare every model that applies with measured series: by what factor each is off.

    An entry is a TOML file with the tables [contact] of a case file and [measured], which says who measured what and where
    that is printed, beside a CSV file of the values. Of a folder, every entry in it. With --out: a CSV file for each entry,
    with what each model says of every value. The mean ratio is of predicted over measured.
    """
    with busy("Reading the measured series"):
        from stiction.studies.comparison.validation import entries_in, read_entry
        from stiction.studies.comparison.validation import validate as validated

        paths = entries_in(entry) if entry.is_dir() else [entry]
        entries = [read_entry(path) for path in paths]
    found = [validated(one, progress=bar(path.stem)) for one, path in zip(entries, paths, strict=True)]
    from stiction.report.views.validation import validation_view

    present(validation_view({path.stem: data for path, data in zip(paths, found, strict=True)}), out, json)
