"""`stiction compare`: one case, every model."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Json, Out, Ranges, app, bar, busy, present


@app.command()
def compare(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact.")],
    load: Annotated[str | None, typer.Option(help='Working load, e.g. "1 N"; default: the middle one of the case.')] = None,
    out: Out = None,
    every: Annotated[bool, typer.Option("--all", help="Show every model in its own row, with its notes.")] = False,
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """The answer for one contact, and what every applicable model says of it, those that say the same in one row.

    A model fits, or does not and why. The area is off by its mean error on solved surfaces near this contact. A contact that
    states an interfacial_shear_strength gets a friction coefficient from models of contact only, too. With --out: compare.csv
    (the curves), compare_at_load.csv, compare.nc (netCDF4) and compare.png. A working load presses: it is above 0 N; where the
    middle one of the case is not, the nearest that is stands in, and without any there are only curves.
    """
    with busy("Reading the case"):
        from stiction.case.read import read_case
        from stiction.studies.case_results import compare_case
        from stiction.studies.comparison.compare import working_load
        from stiction.studies.prediction.predict import prediction_of

        chosen = read_case(case, ranges=ranges)
        at = working_load(chosen, load)
    data = compare_case(chosen, at, bar).assign_attrs(case_file=str(case))
    from stiction.report.views.comparison import comparison_view

    present(comparison_view(chosen, data, prediction_of(chosen, at), every), out, json)
