"""Choose materials, thickness, roughness or load so that an objective comes true and limits are kept.

The case says in [design] the objective, in [design.choose] what may be chosen, in [design.limits] what must hold.
With two objectives, also the designs of which none is better in both. With --out: designed.toml, a case that `stiction run`
takes, design.csv, pareto.csv, design.png, design.nc. Interrupted, it keeps the best so far.
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

    callback("DesignSearch")
    return run_design(plan[0], lambda count, text: callback(f"Designing: {count} designs {text}")), plan[1]


STUDY = Study("design", __doc__, "Case file with a table [design]: choices, objectives, limits.", _plan, _run)
