"""`stiction cite`: BibTeX of what was used."""

from typing import Annotated

import typer

from stiction.cli.program import app, every_key


@app.command()
def cite(
    keys: Annotated[
        list[str] | None, typer.Argument(metavar="[KEY]...", help="Models or entries; all if none.", autocompletion=every_key)
    ] = None,
) -> None:
    """BibTeX of models, film laws and entries of the bibliography."""
    from stiction.solving.overview import cite as bibtex_of

    print(bibtex_of(keys or None), end="")
