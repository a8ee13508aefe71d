"""`stiction fit`: numbers of a case, from measured series."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Json, Out, app, bar, busy, present


@app.command()
def fit(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file with a table [fit]: what is free.")],
    data: Annotated[Path, typer.Option("--data", metavar="MEASURED.csv", help="Measured series, units in the heads.")],
    out: Out = None,
    json: Json = False,
) -> None:
    """Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

    The case says in [fit.free] which numbers are free, between which ends. Intervals are of 95 %, by the profile of the
    likelihood; what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, fit.png,
    profiles.png, parameters.csv, residuals.csv, predictions.csv, fit.nc. Interrupted once the case's model is fitted, it keeps
    that.
    """
    with busy("Reading the case"):
        from stiction.studies.fit.run import plan_of_fit, run_fit

        plan = plan_of_fit(case, data)
        from stiction.report.views.fit import fit_view

    found = run_fit(plan, bar)
    present(fit_view(found, out), out, json)
    if found.stopped:
        raise KeyboardInterrupt
