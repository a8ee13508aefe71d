"""`stiction materials`: the presets of materials, with ranges and sources."""

from typing import Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, app, console


def _every_preset(incomplete: str) -> list[str]:
    """What completes a word to the name of any preset."""
    from stiction.contact.materials import material_names

    return [name for name in material_names() if name.startswith(incomplete)]


@app.command()
def materials(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME]...",
            help="Also the source of every number of these; else a line of each.",
            autocompletion=_every_preset,
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Presets of materials: modulus, Poisson's ratio, hardness, surface energy, each with its range. With NAME also where each
    number comes from; stiction cite KEY prints what stands in brackets."""
    from stiction.report.lists import material_in_full, material_rows, materials_table

    rows = material_rows(names or None)
    if json:
        print_json(rows)
        return
    terminal = console()
    for name in names or ():
        terminal.print(material_in_full(name), "")
    if not names:
        terminal.print(materials_table([row["name"] for row in rows]))
