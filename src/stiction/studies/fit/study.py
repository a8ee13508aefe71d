"""Fit numbers of a case to measured friction, pull-off force, contact area or resistance.

A case that names no model needs no change: the samples of its prediction are weighted by their agreement with the measured
values, and --load predicts friction at another load from the same values. The table [fit.free] of a case names free parameters,
each with its low and high end. A case that names a model needs this table. The 95 % intervals of its free parameters follow
from the profile likelihood, and the output states what the data do not determine. --out writes pictures, tables and, with
[fit.free], fitted.toml, a case file for `stiction run`. If interrupted after the model is fitted, the command keeps this fit.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study

_DATA = "CSV file, for example a line 'load [N],friction_coefficient' and a line '10,0.4'."


def _plan(
    case: Path,
    data: Annotated[Path, Option(help=_DATA, metavar="MEASURED.csv")],
    load: str | None = None,
    out: Path | None = None,
    details: bool = False,
) -> tuple[Any, ...]:
    from stiction.studies.fit.run import plan_of_fit  # noqa: F401  # slow to import, which is part of reading

    return case, data, load, out, details


def _run(plan: tuple[Any, ...], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.fit.predicted import fit_prediction
    from stiction.studies.fit.run import plan_of_fit, run_fit

    case, data, load, out, details = plan
    for _ in progress("Solving")([case]):
        predicted = fit_prediction(case, data, load=load)
    if predicted is not None:
        return (case, *predicted, details, data), out
    return run_fit(plan_of_fit(case, data), progress), out


STUDY = Study("fit", __doc__, "Case file; with a table [fit] that names the free parameters if it names a model.", _plan, _run)
