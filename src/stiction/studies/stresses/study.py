"""Stresses in a film: where film, interface or body yields first, and what peels the film off.

Of the mean touching asperity, pressed and dragged, by the stresses of an elastic sphere on a film: the film law is layered,
whatever the case names. Tension and shear at the interface are over the yield stress, and the shear yield stress, of the
weaker of film and body. With --out: film.csv, film.nc (netCDF4), and of the middle one of the points that press, or --load,
section.nc and film.png, the section under the asperity. The options of a model or a law may be given too.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stiction.studies.study import Study


def _plan(
    case: Path,
    options: Mapping[str, str],
    load: str | None = None,
    model: str | None = None,
    asperity: str | None = None,
    tangential: str | None = None,
    all_rows: bool = False,
    out: Path | None = None,
) -> tuple[Any, ...]:
    from stiction.case.read import read_case

    read = read_case(case)
    laws = {"model": model, "asperity": asperity, "tangential": tangential, "film": "layered"}
    return read if load is None else read.at_load(load), read.choice.with_changes(laws, options), all_rows, out is not None


def _run(plan: tuple[Any, ...], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.case_results import film_of_case

    case, choice, all_rows, with_section = plan
    for _ in progress("Solving")([case]):
        data = film_of_case(case, choice)
    return case, data, all_rows, with_section


STUDY = Study("film", __doc__, "Case file of a contact with a film.", _plan, _run)
