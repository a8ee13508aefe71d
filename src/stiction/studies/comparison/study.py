"""Compare all models that apply to one contact; the prediction is shown first.

Models that agree share a row. "Area error" is the mean error of the model's area on benchmark surfaces near this contact. The
last column states whether the contact is in the range that the authors claim, or which quantities are outside. The notes
"without the interface" and "without alpha" mean that the model ignores this input. The note "load without friction" states the
fraction of the load on asperities for which the model predicts no friction. If an interfacial_shear_strength is specified,
models of contact area give friction too. --out writes compare.csv (the curves), compare_at_load.csv, compare.nc (netCDF4) and
compare.png. Models are compared at the middle load of the case, or at the nearest load above 0 N; without any such load only
the curves are written.
"""

from pathlib import Path
from typing import Annotated, Any

from typer import Option

from stiction.studies.study import Study


def _plan(
    case: Path,
    load: Annotated[str | None, Option(help='Working load, e.g. "1 N"; default: the middle load of the case.')] = None,
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
