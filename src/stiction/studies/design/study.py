"""Find materials, film thickness, roughness or load that best meet an objective within constraints.

The case states the objective in [design], the choices in [design.choose] and the constraints in [design.limits]. With two
objectives, the output includes the Pareto front: designs that no other design improves in one objective without being worse in
the other. --out writes designed.toml (a case file for `stiction run`), design.csv, pareto.csv, design.png and design.nc. If
interrupted, the command keeps the best design so far.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from stiction.studies.study import Study


def _plan(case: Path, out: Path | None = None) -> tuple[Any, ...]:
    from stiction.studies.design.run import plan_of_design

    return plan_of_design(case), out


def _run(plan: tuple[Any, ...], callback: Callable[[str], None]) -> tuple[Any, ...]:
    from stiction.studies.design.run import run_design

    callback("Designing")
    return run_design(plan[0], lambda count, text: callback(f"Designing: {count} designs {text}")), plan[1]


STUDY = Study("design", __doc__, "Case file with a table [design]: choices, objectives, constraints.", _plan, _run)
