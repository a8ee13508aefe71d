"""The answer for one contact, and what every applicable model says of it, a row for those that agree.

A model fits, or does not and why. The area is off by its mean error on solved surfaces near this contact. A contact that
states an interfacial_shear_strength gets a friction coefficient from models of contact only, too. With --out: compare.csv
(the curves), compare_at_load.csv, compare.nc (netCDF4) and compare.png. A working load presses: it is above 0 N; where the
middle one of the case is not, the nearest that is stands in, and without any there are only curves.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study


def _plan(
    case: Path,
    load: Annotated[str | None, Option(help='Working load, e.g. "1 N"; default: the middle one of the case.')] = None,
    details: Annotated[bool, Option("--all", help="Show every model in its own row, with its notes.")] = False,
    ranges: bool | None = None,
) -> tuple[Any, ...]:
    from stiction.case.read import read_case
    from stiction.studies.comparison.compare import working_load

    read = read_case(case, ranges=ranges)
    return str(case), read, working_load(read, load), details


def _run(plan: tuple[Any, ...], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.case_results import compare_case
    from stiction.studies.prediction.predict import prediction_of

    path, case, load, every = plan
    data = compare_case(case, load, progress).assign_attrs(case_file=path)
    return case, data, prediction_of(case, load), every


STUDY = Study("compare", __doc__, "Case file: what is in contact.", _plan, _run)
