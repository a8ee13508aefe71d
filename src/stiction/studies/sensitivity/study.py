"""Rank the inputs by their effect on friction, to see which should be measured better.

For a prediction, the output has the fraction of the variance of ln mu that each source of uncertainty causes. For a single
model, it has Sobol indices with 95 % intervals, and Morris effects. These rank inputs, methods of finding asperities, and
models by their effect on friction, contact area, load and pull-off force. Both outputs have logarithmic sensitivities, d ln
mu/d ln x, for every number of the contact. --out writes sensitivity.csv, log_sensitivities.csv, sensitivity.nc (netCDF4) and
sensitivity.png. A number of the case is uncertain if stated as "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or {samples}.
With --ranges, numbers of material presets also vary within their ranges.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study


def _plan(
    case: Path,
    load: Annotated[str | None, Option(help='Use only this load, e.g. "1 N"; default: at most nine loads of the case.')] = None,
    models: Annotated[
        str | None,
        Option(
            help="Models to sample, separated by commas; none: only the model of the case. Default: the model of the case, "
            "or the prediction if the case names no model.",
            metavar="NAMES",
        ),
    ] = None,
    ranges: bool | None = None,
) -> dict[str, Any]:
    from stiction.case.read import read_case

    names = None if models is None else [] if models.strip() == "none" else [name.strip() for name in models.split(",")]
    return {"case": read_case(case, ranges=ranges), "load": load, "models": names}


def _run(plan: dict[str, Any], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.sensitivity.run import sensitivity

    return sensitivity(**plan, progress=progress), plan["case"].subject.groups()


STUDY = Study("sensitivity", __doc__, "Case file in which numbers of the contact are uncertain.", _plan, _run)
