"""`stiction interfaces`: the states of an interface, with strength, range, source and grade."""

from typing import Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, app, console


def _every_state(incomplete: str) -> list[str]:
    """Complete a word to the name of any state."""
    from stiction.contact.interfaces import interface_names

    return [name for name in interface_names() if name.startswith(incomplete)]


@app.command()
def interfaces(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME]...",
            help='Also sources, and where each must not be used, of these: "oxidised metal".',
            autocompletion=_every_state,
        ),
    ] = None,
    json: Json = False,
) -> None:
    """States of an interface: shear strength and how it grows with pressure, each with range and grade. With NAME also where
    the numbers come from and where the state must not be used; stiction cite KEY prints what stands in brackets."""
    from stiction.contact.interfaces import interfaces as rows_of
    from stiction.report.lists import interface_in_full, interfaces_table

    rows = rows_of(names or None)
    if json:
        print_json(rows)
        return
    terminal = console()
    for name in names or ():
        terminal.print(interface_in_full(name), "")
    if not names:
        terminal.print(interfaces_table())
