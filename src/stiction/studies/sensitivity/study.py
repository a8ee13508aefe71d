"""Which of the inputs should be measured better: of friction, area, load and pull-off.

Sobol indices with 95 % intervals and Morris effects over what is uncertain, the ways of finding asperities and the models;
logarithmic sensitivities d ln mu/d ln x for every number of the contact. With --out: sensitivity.csv, log_sensitivities.csv,
sensitivity.nc (netCDF4) and sensitivity.png. Numbers are uncertain as "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or
{samples} in the case, or with --ranges, within the ranges of their materials.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study


def _plan(
    case: Path,
    load: Annotated[str | None, Option(help='Only at this load, e.g. "1 N"; default: nine of the case at most.')] = None,
    models: Annotated[
        str | None,
        Option(
            help="Models to draw from, separated by commas, or: none, for the model of the case alone. Default: the model "
            "of the case, or the prediction where it names none.",
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
