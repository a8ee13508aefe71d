"""`stiction validate`: every model against measured series."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Out, app, bar, busy, console, writing, written

if TYPE_CHECKING:
    import xarray


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
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the measured series"):
        from stiction.studies.comparison.validation import entries_in, read_entry
        from stiction.studies.comparison.validation import validate as validated

        paths = entries_in(entry) if entry.is_dir() else [entry]
        entries = [read_entry(path) for path in paths]
    found = [validated(one, progress=bar(path.stem)) for one, path in zip(entries, paths, strict=True)]
    names = _write(out, {path.stem: data for path, data in zip(paths, found, strict=True)}) if out is not None else []
    if json:
        from stiction.report.validation_tables import validation_record

        print_json({path.stem: validation_record(data) for path, data in zip(paths, found, strict=True)})
        return
    for data in found:
        _print(data)
    if out is not None:
        written(out, names)


def _print(data: "xarray.Dataset") -> None:
    from stiction.report.validation_tables import origin_lines, validation_table
    from stiction.report.whole_keys import WholeKeys

    terminal = console()
    for line in origin_lines(data):
        terminal.print(line)
    terminal.print(WholeKeys(validation_table(data)))
    for line in data.attrs["left_out"].splitlines():
        terminal.print(f"left out: {line}", style="dim", highlight=False, markup=False)


def _write(out: Path, found: "dict[str, xarray.Dataset]") -> list[str]:
    """Write a table for each entry; returns their names."""
    with writing():
        from stiction.report.files import write_folder, write_rows
        from stiction.report.validation_tables import row_rows

        files = {f"{name}.csv": lambda path, data=data: write_rows(path, *row_rows(data)) for name, data in found.items()}
        write_folder(out, files)
    return list(files)
