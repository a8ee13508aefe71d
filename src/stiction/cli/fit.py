"""`stiction fit`: numbers of a case, from measured series."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.program import Details, Json, Out, app, bar, busy, present, solving

if TYPE_CHECKING:
    from stiction.report.view import View


@app.command()
def fit(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file; a table [fit] says what is free.")],
    data: Annotated[Path, typer.Option("--data", metavar="MEASURED.csv", help="Measured series, units in the heads.")],
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

    A case without a table [fit] is predicted with what was measured: draws count by how well they meet the values. Else the
    case says in [fit.free] which numbers are free, between which ends. Intervals are of 95 %, by the profile of the
    likelihood; what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, fit.png,
    profiles.png, parameters.csv, residuals.csv, predictions.csv, fit.nc. Interrupted once the case's model is fitted, it keeps
    that.
    """
    with busy("Reading the case"):
        from stiction.case.read import read_content
        from stiction.studies.fit.run import plan_of_fit, run_fit

        if "fit" not in read_content(case):
            present(_predicted(case, data, details), out, json)
            return

        plan = plan_of_fit(case, data)
        from stiction.report.views.fit import fit_view

    found = run_fit(plan, bar)
    present(fit_view(found, out), out, json, details)
    if found.stopped:
        raise KeyboardInterrupt


def _predicted(case: Path, data: Path, details: bool) -> "View":
    from stiction.case.read import read_case
    from stiction.report.views.prediction import prediction_view
    from stiction.studies.prediction.predict import predict

    chosen = read_case(case)
    with solving():
        return prediction_view(chosen, predict(chosen, measured=data), str(case), details)
