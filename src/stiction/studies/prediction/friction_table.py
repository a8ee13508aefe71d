"""Tabulate predicted friction and tangential stiffness against nominal pressure, for simulation programs."""

from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.read import Case
from stiction.quantities.errors import InputError, InWords
from stiction.solving.sliding import YIELDING_SPOTS, slide
from stiction.studies.prediction.predict import case_given, predict
from stiction.studies.pressing_loads import pressing_loads

if TYPE_CHECKING:
    import xarray

_PER_DECADE, _DECADES = 40, 2  # loads per decade; decades below and above a single load
# Largest relative error of linear interpolation between rows: of mu, and of separation and stiffness, which are less accurate.
_OF_MU, _OF_STIFFNESS = 4e-4, 1e-2


def friction_table(contact: Any, *, load: Any = None, level: float = 0.5) -> "xarray.Dataset":
    """Return a table of mu against nominal pressure; linear interpolation of mu between its rows is accurate to 0.3 %.

    Parameters
    ----------
    contact : Contact, Case, dict or path
        One contact, as for `predict`.
    load : number, text or sequence, optional
        Normal load [N]; by default the loads of the case. The table covers the range of two or more loads. For a single load
        it covers two decades below and up to two decades above it; fewer above if hardness times nominal area is smaller.
    level : float
        Quantile of mu, between 0 and 1: 0.5 for the median, 0.05 for a lower bound.

    Returns
    -------
    xarray.Dataset
        Over `row`: load [N], nominal_pressure [Pa] and friction_coefficient. For bare bodies also tangential_stiffness [N/m^3]
        (initial slope of shear stress against displacement), elastic_slip [m] (shear stress at sliding over that slope) and
        mean_separation [m]. Attributes: working_row (index of the row at the working load), level, comments (a list of lines),
        and case, the title of the case if it has one. Loads without a finite mu have no row.

    Raises
    ------
    InputError
        The level is not between 0 and 1, the contact has arrays, no load is above 0, or mu cannot be predicted.

    Notes
    -----
    Stiffness and separation are computed for the nominal contact under the load alone, by the asperity law of Zhao, Maietta and
    Chang (2000). Each contact spot has Mindlin's stiffness 8 G* a.
    """
    if not 0.0 < level < 1.0:
        raise InputError("level", level, "a quantile above 0 and below 1, e.g. 0.05")
    case = case_given(contact, load)
    if case.is_swept:
        raise InputError("contact", InWords("array parameters"), "a single contact for each table")
    stated, working_index = pressing_loads(case)
    if not stated.size:
        raise InputError("load", None, "> 0 N; the case has no compressive load")
    loads, mu = _predicted(case, np.unique(stated), level)
    numbers: Any = case.subject.as_numbers()
    area = float(np.squeeze(numbers.nominal_area))
    columns = {"load": loads, "nominal_pressure": loads / area, "friction_coefficient": mu}
    comments = [f"stiction: mu, {'median' if level == 0.5 else f'quantile {level:g}'} of the prediction"]
    comments += [f"contact: {case.title}"] if case.title else []
    try:
        elastic = slide(numbers, load=loads, displacement=[0.0], **YIELDING_SPOTS)
    except InputError as error:
        reason = "they are computed from bare asperities, and this contact has a film" if case.subject.has_film else error
        comments.append(f"no stiffness before sliding and no separation: {reason}")
    else:
        stiffness = elastic["tangential_stiffness"].values / area
        columns |= {
            "tangential_stiffness": stiffness,
            "elastic_slip": mu * columns["nominal_pressure"] / stiffness,
            "mean_separation": elastic["mean_separation"].values,
        }
    working = int(np.argmin(np.abs(np.log(loads / stated[working_index]))))
    bounds = {"friction_coefficient": _OF_MU, "mean_separation": _OF_STIFFNESS, "tangential_stiffness": _OF_STIFFNESS}
    smooth = [(columns[name], bound) for name, bound in bounds.items() if name in columns]
    rows = _needed(columns["nominal_pressure"], smooth, working)
    working = int(np.flatnonzero(rows == working)[0])
    return _dataset({name: values[rows] for name, values in columns.items()}).assign_attrs(
        working_row=working, level=level, comments=comments, **({"case": case.title} if case.title else {})
    )


def _predicted(case: Case, stated: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return loads [N] (n,) and the quantile `level` of mu (n,) at these loads.

    stated: sorted loads [N] that the table must contain. Several loads: the table covers their range. A single load: the table
    covers two decades below it and two above it, or one or none above it if hardness times nominal area is smaller. Loads
    without a finite mu are omitted. Raises InputError.
    """
    end = "" if level == 0.5 else "_low" if level < 0.5 else "_high"
    interval = abs(1.0 - 2.0 * level) or None
    decades = [0.0] if stated.size > 1 else [_DECADES, _DECADES - 1, 0.0]
    for above in decades:
        low, high = (stated[0], stated[-1]) if stated.size > 1 else (stated[0] / 10.0**_DECADES, stated[0] * 10.0**above)
        count = 1 + int(np.ceil(_PER_DECADE * np.log10(high / low)))
        loads = np.unique(np.concatenate([np.geomspace(low, high, count), stated]))
        try:
            mu = predict(case, load=loads, level=interval)[f"friction_coefficient{end}"].values
        except InputError as error:
            if error.field != "load" or above == decades[-1]:
                raise
        else:
            known = np.isfinite(mu)
            return loads[known], mu[known]
    raise AssertionError("the last range returns or raises")


def _needed(pressure: np.ndarray, columns: list[tuple[np.ndarray, float]], working_index: int) -> np.ndarray:
    """Return the indices of the rows that a table needs for accurate linear interpolation in pressure.

    pressure: nominal pressures [Pa], ascending. columns: (values, largest relative error) of each column. working_index: index
    of a row that is always included, like the first and the last row.
    """
    rows, last = [0], len(pressure) - 1
    while rows[-1] < last:
        start, end = rows[-1], rows[-1] + 1
        while end not in (working_index, last) and all(_is_straight(pressure, *column, start, end + 1) for column in columns):
            end += 1
        rows.append(end)
    return np.array(rows)


def _is_straight(pressure: np.ndarray, values: np.ndarray, bound: float, start: int, end: int) -> bool:
    between = slice(start, end + 1)
    line = np.interp(pressure[between], pressure[[start, end]], values[[start, end]])
    scale = values[between] if values.min() > 0.0 else np.abs(values).max()
    return bool(np.all(np.abs(line - values[between]) <= bound * scale))


_MEANING = {
    "load": ("N", "normal load"),
    "nominal_pressure": ("Pa", "load over nominal area"),
    "friction_coefficient": ("1", "friction force over load, at the onset of sliding"),
    "tangential_stiffness": ("N/m^3", "shear stress over displacement at rest"),
    "elastic_slip": ("m", "shear stress at sliding over tangential stiffness"),
    "mean_separation": ("m", "distance between the mean planes of the surfaces"),
}


def _dataset(columns: dict[str, np.ndarray]) -> "xarray.Dataset":
    import xarray

    return xarray.Dataset(
        {
            name: ("row", values, dict(zip(("units", "long_name"), _MEANING[name], strict=True)))
            for name, values in columns.items()
        }
    )
