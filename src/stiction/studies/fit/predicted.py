"""Fit a case that names no model: weight samples of its free parameters by their agreement with measured values.

A free parameter is a number of the case with a low and a high end in [fit.free].
"""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction import __version__
from stiction.case.addresses import as_numbers, with_numbers
from stiction.case.read import Case, case_in, read_content, tables_of, with_files_read, without_studies
from stiction.case.text import case_text, show_exactly
from stiction.quantities.errors import InputError, InWords
from stiction.studies.fit.plan import WANTED, free_numbers, read_fit
from stiction.studies.prediction.predict import is_predicted, predict

if TYPE_CHECKING:
    import xarray


def fit_prediction(
    given: Any, data: Any, folder: Path | None = None, load: str | None = None
) -> "tuple[Case, xarray.Dataset] | None":
    """Return a case and its prediction updated by measured values; None for a fit of a named model.

    Each free parameter of [fit.free] becomes uncertain, with a uniform distribution between its ends (of its logarithm for
    logarithmic spacing). given: path of a case file, or its tables. data: path of the CSV file of measured values. folder:
    folder to which paths in the tables are relative; None for the folder of the case file. load: replaces the loads of the
    case. Raises InputError, also if a case that names a model has no [fit] or is given a load.
    """
    content, own_folder = tables_of(given)
    folder = folder or own_folder
    plain: Mapping[str, Any] = without_studies(content)
    if not is_predicted(case_in(plain, folder)):
        if "fit" not in content:
            raise InputError("fit", None, WANTED, "where a model is named")
        if load is not None:
            raise InputError("--load", load, "no value if the case names a model; state the loads in [solve]")
        return None
    if "fit" in content:
        plain = with_numbers(plain, _ends(content, as_numbers(with_files_read(plain, folder)[0])))
    case = case_in(plain, folder).at_load(load)
    return case, predict(case, measured=data)


def _ends(content: Mapping[str, Any], plain: Mapping) -> dict[tuple[str, ...], Any]:
    """Return each free parameter as an uncertain number of a case file, {low, high, spacing}, by address (tuple of keys).

    content: tables of the case with [fit]. plain: tables after reading all files, which give the addresses. Raises InputError
    for keys of [fit] that predictions do not support.
    """
    fit = read_fit(content)
    free = free_numbers(fit, plain)
    asked = [name for name in ("models", "predict", "specific_contact_resistance") if getattr(fit, name)]
    asked += [f"free.{one.name}.each_sample" for one in free if one.each_sample]
    if asked:
        raise InputError(f"fit.{asked[0]}", InWords("given"), "not supported by predictions", "name a model as solve.model")
    return {one.path: _between(one.path, one.low, one.high, "log" if one.log else "linear") for one in free}


def _between(path: tuple[str, ...], low: float, high: float, spacing: str) -> dict[str, Any]:
    return {"low": show_exactly(low, path[-1]), "high": show_exactly(high, path[-1]), "spacing": spacing}


def fitted_case(given: Any, case: Case, found: "xarray.Dataset", out: Path) -> str:
    """Return the text of a case file in which the uncertain numbers have their fitted intervals.

    given: path of the original case file. case, found: the case and the prediction that `fit_prediction` returned. out: folder
    of the new case file, to which the file paths in the text are relative. Nothing is written. An interval has logarithmic
    spacing if its lower end is above 0, otherwise linear spacing.
    """
    numbers = {}
    for one in case.uncertain:
        here = found.sel(parameter=".".join(one.path[1:]))
        low, high = float(here["low"]), float(here["high"])
        numbers[one.path] = _between(one.path, low, high, "log" if low > 0.0 else "linear")
    comments = [
        f"Fitted by stiction {__version__} to {found.attrs['measured']} measured values: {found.level:.0%} intervals.",
        "They lack the correlations of strength, hardness and area: the interval of mu is wider than in the fit.",
        f"For other loads with these correlations: stiction fit {Path(given).name} --data FILE --load LOAD",
    ]
    return case_text(with_numbers(without_studies(read_content(given)), numbers), comments, Path(given).parent, out)
