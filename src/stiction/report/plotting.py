"""Draw any result with `result.stiction.plot()`; drawing modules are imported only when it is called."""

from importlib import import_module
from typing import TYPE_CHECKING

import xarray

from stiction.quantities.errors import InputError
from stiction.quantities.extras import require

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Variable or attribute of a result -> function that draws the result; the first match counts.
_DRAWN = {
    "objectives": "design_pictures.design_figure",
    "profile_value": "fit_pictures.fit_figure",
    "displacement": "sliding_pictures.sliding_figure",
    "status": "model_pictures.models_figure",
    "measured_low": "prediction_pictures.validation_figure",
    "cutoff": "method_pictures.resolution_figure",
    "friction_coefficient_log_sensitivity": "sensitivity_pictures.sensitivity_figure",
}


@xarray.register_dataset_accessor("stiction")
class Plotting:
    """Add the method `result.stiction.plot()` to xarray datasets."""

    def __init__(self, data: xarray.Dataset):
        self._data = data

    def plot(self) -> "Figure":
        """Draw this result as a matplotlib Figure.

        The dataset must be a result of solve, predict, compare, slide, unload, design, fit, sensitivity, film_stresses,
        validate or resolution_study. Any other dataset raises InputError.
        """
        require("plot", "matplotlib")
        data = self._data
        place = next((place for name, place in _DRAWN.items() if name in data.variables or name in data.attrs), "")
        if not place:
            place = _of_solved(data)
        module, _, name = place.partition(".")
        figure: Figure = getattr(import_module(f"stiction.report.{module}"), name)(data)
        return figure


def _of_solved(data: xarray.Dataset) -> str:
    from stiction.report.swept_tables import varied

    if "load" not in data.variables or ("model" not in data.attrs and "shares" not in data.attrs):
        raise InputError("result", list(data.variables), "a dataset that a function of stiction returned, e.g. st.predict")
    if varied(data):
        return "swept_pictures.swept_figure"
    return "prediction_pictures.prediction_figure" if "level" in data.attrs else "pictures.curve_figure"
