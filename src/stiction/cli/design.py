"""`stiction design`: the coating, thickness, roughness and load that come nearest to what is wished."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Details, Json, Out, app, busy, present, telling_how_far


@app.command()
def design(
    case: Annotated[
        Path, typer.Argument(metavar="CASE.toml", help="Case file with a table [design]: choices, wishes, limits.")
    ],
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Choose materials, thickness, roughness or load so that a wish comes true and limits are kept.

    The case says in [design] what is wished, in [design.choose] what may be chosen, in [design.limits] what must hold.
    With two wishes, also the designs of which none is better in both. With --out: designed.toml, a case that `stiction run`
    takes, design.csv, front.csv, design.png, design.nc. Interrupted, it keeps the best so far.
    """
    with busy("Reading the case"):
        from stiction.studies.design.run import plan_of_design, run_design

        plan = plan_of_design(case)
    with telling_how_far("Designing") as tell:
        found = run_design(plan, lambda count, text: tell(f"Designing: {count} designs asked"))
    from stiction.report.views.design import design_view

    present(design_view(found, out), out, json, details)
    if found.stopped:
        raise KeyboardInterrupt
