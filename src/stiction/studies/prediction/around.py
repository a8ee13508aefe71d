"""Predict a case with a curve over load, also where the case has a single load."""

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


def predict_with_curve(case: Case) -> "tuple[xarray.Dataset, xarray.Dataset]":
    """Return the prediction of a case, and its curve over load.

    The curve is the prediction itself, unless the case has a single load. Around a single load, the curve covers loads down
    to a tenth and up to ten times. Raises InputError.
    """
    if case.is_swept or case.load is None or case.load.size != 1 or not case.load[0] > 0.0:
        data = predict(case)
        return data, data
    loads = case.load[0] * AROUND
    loads[_MIDDLE] = case.load[0]
    try:
        curve = predict(replace(case, load=loads))
    except InputError:  # of this load too, or of a larger one only
        data = predict(case)
        return data, data
    data = curve.isel(load=[_MIDDLE])
    return data.assign_attrs(excluded=float(np.mean(~np.isfinite(data["friction_coefficient_samples"].values)))), curve
