"""Predict a single number from names and values, for spreadsheets and other languages."""

from functools import lru_cache
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stiction.case.addresses import with_numbers
from stiction.case.read import parse_case, read_content
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.table import QUANTITIES
from stiction.studies.prediction.many import PREDICTED
from stiction.studies.prediction.predict import predict

if TYPE_CHECKING:
    import xarray

_MU = "friction_coefficient"


def predict_value(output: str, *pairs: str | float) -> float:
    """Return one predicted number, e.g. for a cell of a spreadsheet.

    Parameters
    ----------
    output : str
        mu, friction_force [N] or contact_area [m^2] for the median; with _low or _high for an end of the interval.
    *pairs : str, number
        Names, each followed by its value. A name is a key of the table [contact] of a case file, with a dot for a table
        inside it ("roughness.rms_height"). Further names are "load", and "case" for a case file whose numbers the other
        pairs replace. Numbers are in SI units; text has a unit ("0.2 um").

    Returns
    -------
    float
        The number in SI units.

    Raises
    ------
    InputError
        A name or the output is unknown, a value is missing or out of bounds, the contact cannot be predicted, or the pairs
        define several contacts or loads.

    Notes
    -----
    Calls with the same pairs share one prediction: three cells with mu, mu_low and mu_high cost as much as one.

    Examples
    --------
    >>> import stiction as st
    >>> pairs = ["first", "copper", "second", "copper", "interface", "oxidised metal", "nominal_area", 1e-4]
    >>> pairs += ["roughness.rms_height", "0.2 um", "roughness.finish", "ground"]
    >>> round(st.predict_value("mu", "load", 10, *pairs), 2)
    0.43
    """
    output = str(output)
    name = _MU + output[2:] if output in ("mu", "mu_low", "mu_high") else output
    if name not in PREDICTED:
        raise InputError("output", output, ", ".join(PREDICTED).replace(_MU, "mu"))
    if len(pairs) % 2:
        raise InputError("pairs", InWords(f"{len(pairs)} words"), "a value after each name")
    named_values = dict(zip(pairs[::2], pairs[1::2], strict=True))
    for key, value in named_values.items():  # an empty cell is None, a range of cells a tuple, a date a datetime
        if not isinstance(value, str | Real) or isinstance(value, bool):
            raise InputError(str(key), value, "one number or text, from a single cell that is not empty")
    file = named_values.get("case")
    changed = Path(str(file)).stat().st_mtime_ns if file is not None and Path(str(file)).is_file() else 0
    values = _predicted(tuple(named_values.items()), changed)[name]
    if values.size != 1:
        raise InputError(
            "pairs",
            InWords(f"{values.size} contacts or loads"),
            'names and values that leave one contact at one load; the two arguments "load", 5 choose it',
        )
    return float(values.squeeze())


@lru_cache(maxsize=1024)
def _predicted(given: tuple[tuple[str, Any], ...], changed: int) -> "xarray.Dataset":
    """Return the prediction for pairs of names and values, as in `predict_value`.

    changed: modification time of the case file [ns]. It is an argument so that a changed file is not answered from the cache.
    """
    pairs = dict(given)
    file = pairs.pop("case", None)
    tables: Any = {} if file is None else read_content(file)
    for name, value in pairs.items():
        path = ("solve", "load") if name == "load" else ("contact", *str(name).split("."))
        tables = with_numbers(tables, {path: _with_unit(path[-1], value)})
    return predict(parse_case(tables, Path() if file is None else Path(file).parent))


def _with_unit(name: str, value: Any) -> Any:
    """Return a number as text with the SI unit of the quantity `name`.

    Text, and a number of an unknown quantity, are returned unchanged.
    """
    if isinstance(value, str) or name not in QUANTITIES:
        return value
    return f"{float(value)!r} {QUANTITIES[name].unit}".rstrip()
