"""`stiction fit`: numbers of a case, from measured series."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Details, Json, Out, app, bar, busy, present, solving


@app.command()
def fit(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file; a table [fit] says what is free.")],
    data: Annotated[Path, typer.Option("--data", metavar="MEASURED.csv", help="Measured series, units in the heads.")],
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

    The case says in [fit.free] which numbers are free, between which ends. Where it names no model, it is predicted with what
    was measured: draws count by how well they meet the values. With a model, intervals are of 95 %, by the profile of the
    likelihood, and what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, and pictures
    and tables. Interrupted once the case's model is fitted, it keeps that.
    """
    with busy("Reading the case"):
        from stiction.report.views.fit import fit_view, fitted_prediction_view
        from stiction.studies.fit.predicted import fit_prediction
        from stiction.studies.fit.run import plan_of_fit, run_fit

    with solving():
        answer = fit_prediction(case, data)
    if answer is not None:
        present(fitted_prediction_view(case, *answer, details, out), out, json)
        return
    with busy("Reading the case"):
        plan = plan_of_fit(case, data)

    found = run_fit(plan, bar)
    present(fit_view(found, out), out, json, details)
    if found.stopped:
        raise KeyboardInterrupt
