"""`stiction schema`: the JSON schema of a case file."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import app
from stiction.quantities.errors import InputError


@app.command()
def schema(out: Annotated[Path | None, typer.Option(help="File to write to; else it is printed.")] = None) -> None:
    """JSON schema of a case file, for editors that complete and check TOML."""
    from stiction.case.read import json_schema
    from stiction.report.files import as_json

    if out is None:
        print_json(json_schema())
        return
    try:
        out.write_text(as_json(json_schema()) + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError("--out", str(out), f"a file that can be written ({error.strerror})") from None
