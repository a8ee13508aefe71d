"""Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

The case says in [fit.free] which numbers are free, between which ends. Where it names no model, it is predicted with what
was measured: draws count by how well they meet the values. With a model, intervals are of 95 %, by the profile of the
likelihood, and what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, and pictures
and tables. Interrupted once the case's model is fitted, it keeps that.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study


def _plan(
    case: Path,
    data: Annotated[Path, Option(help="CSV file of a measured series, units in the column names.", metavar="MEASURED.csv")],
    out: Path | None = None,
    details: bool = False,
) -> tuple[Any, ...]:
    from stiction.studies.fit.run import plan_of_fit  # noqa: F401  # slow to import, which is part of reading

    return case, data, out, details


def _run(plan: tuple[Any, ...], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.fit.predicted import fit_prediction
    from stiction.studies.fit.run import plan_of_fit, run_fit

    case, data, out, details = plan
    for _ in progress("Solving")([case]):
        predicted = fit_prediction(case, data)
    if predicted is not None:
        return (case, *predicted, details), out
    return run_fit(plan_of_fit(case, data), progress), out


STUDY = Study("fit", __doc__, "Case file; a table [fit] says what is free.", _plan, _run)
