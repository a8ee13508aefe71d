"""Compute the stresses in a film: where film, interface or body yields first, and the stresses that peel the film off.

The stresses are those of an elastic sphere on a film, pressed and dragged, with the size and load of the mean touching
asperity. The film law is always `layered`. Tension and shear at the interface are divided by the yield stress and the shear
yield stress of the weaker of film and body. --out writes film.csv and film.nc (netCDF4) and, for the middle compressive point
or for --load, a section under the asperity: section.nc and film.png. The options of a model or a law are allowed too.
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
    from stiction.studies.prediction.predict import is_predicted

    read = read_case(case)
    if model is None and is_predicted(read):  # a prediction has no single asperity
        model = "greenwood_williamson_1966"
    laws = {"model": model, "asperity": asperity, "tangential": tangential, "film": "layered"}
    return read.at_load(load), read.choice.with_changes(laws, options), all_rows, out is not None


def _run(plan: tuple[Any, ...], progress: Any) -> tuple[Any, ...]:
    from stiction.studies.case_results import film_of_case

    case, choice, all_rows, with_section = plan
    for _ in progress("Solving")([case]):
        data = film_of_case(case, choice)
    return case, data, all_rows, with_section


STUDY = Study("film", __doc__, "Case file of a contact with a film.", _plan, _run)
