"""Predict a case together with a curve over load, also if the case has a single load."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.case.read import Case
from stiction.quantities.errors import InputError
from stiction.studies.prediction.predict import predict

if TYPE_CHECKING:
    import xarray

AROUND = np.geomspace(0.1, 10.0, 21)  # loads of a curve over its working load
_MIDDLE = len(AROUND) // 2


def curve_of(case: Case, data: "xarray.Dataset") -> "xarray.Dataset":
    """Return a prediction at 21 loads, from a tenth to ten times the single load of a prediction.

    case: the case of the prediction `data`. A prediction at several loads, or updated by measured friction, is returned
    unchanged. For a case with array parameters, and if a load of the range cannot be predicted, the result has the single load.
    """
    if data["load"].size != 1 or "measured" in data.attrs:
        return data
    return predict_with_curve(replace(case, separation=None, load=np.atleast_1d(data["load"].values)))[1]


def predict_with_curve(case: Case) -> "tuple[xarray.Dataset, xarray.Dataset]":
    """Return the prediction of a case at its loads, and a prediction over a range of loads.

    If the case has a single load above 0 N and no array parameters, the range has 21 loads from a tenth to ten times this load.
    Otherwise, or if a load of the range cannot be predicted, both datasets are the prediction at the loads of the case. Raises
    InputError if these loads cannot be predicted.
    """
    if case.is_swept or case.load is None or case.load.size != 1 or not case.load[0] > 0.0:
        data = predict(case)
        return data, data
    loads = case.load[0] * AROUND
    loads[_MIDDLE] = case.load[0]
    try:
        curve = predict(replace(case, load=loads))
    except InputError:  # raised again below if the load itself is refused, and not only a larger one
        data = predict(case)
        return data, data
    data = curve.isel(load=[_MIDDLE])
    return data.assign_attrs(excluded=float(np.mean(~np.isfinite(data["friction_coefficient_samples"].values)))), curve
