"""By how much friction differs: over what is uncertain, over ways of finding asperities, over models; each apart."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from stiction.studies.comparison.recommendation import COST_UNIT

if TYPE_CHECKING:
    import xarray

# What a result may differ by.
SPREADS = ("inputs", "methods", "models")
_MU = "friction_coefficient_at_load"


def with_spreads(
    data: "xarray.Dataset", inputs: Sequence[float], methods: Sequence[float], models: Sequence[float], nominal: float
) -> "xarray.Dataset":
    """A result with how far mu at the working load differs by each of SPREADS: spread_low, spread_high and spread_factor, the
    ratio of the two, over `spread`; not a number where that is not known. Each is low and high end, or nothing."""
    ends = np.array([[min(one), max(one)] if len(one) else [np.nan, np.nan] for one in (inputs, methods, models)])
    ratio = np.divide(ends[:, 1], ends[:, 0], where=ends[:, 0] > 0.0, out=np.full(len(ends), np.nan))
    said = {
        "spread_low": (ends[:, 0], "lowest friction at the working load, by what differs"),
        "spread_high": (ends[:, 1], "highest friction at the working load, by what differs"),
        "spread_factor": (ratio, "factor between the two"),
    }
    data = data.assign_coords(spread=("spread", list(SPREADS)))
    data = data.assign({name: ("spread", values, {"units": "1", "long_name": text}) for name, (values, text) in said.items()})
    return data.assign_attrs(spread_around=nominal)


def spreads_of_comparison(data: "xarray.Dataset", coverage: float) -> "xarray.Dataset":
    """A comparison with its spreads: the band of the recommended model over what is uncertain and over methods of finding
    asperities, and between which ends that share of the weight of all models of its family is. As it is where no model is
    recommended."""
    best = data.attrs.get("recommended", "none")
    if best == "none":
        return data
    one = data.sel(model=best)
    inputs = ends_of_band(one[f"{_MU}_quantile"]) if f"{_MU}_quantile" in data else []
    methods = [float(one[f"{_MU}_{end}"]) for end in ("low", "high")] if f"{_MU}_low" in data else []
    return with_spreads(data, inputs, methods, ends_of_models(data, coverage), float(one[_MU]))


def ends_of_band(band: "xarray.DataArray") -> list[float]:
    """The low and the high end of a band (quantile,); nothing where they are not known."""
    ends = [float(band.isel(quantile=at)) for at in (0, -1)]
    return ends if np.isfinite(ends).all() else []


def ends_of_models(data: "xarray.Dataset", coverage: float) -> list[float]:
    """Between which friction coefficients at the working load this share of the weight of the models is, of the family that is
    recommended; nothing where there are not two of them: one opinion is no range."""
    names, weights = weights_of_models(data)
    if len(names) < 2:
        return []
    mu = data[_MU].sel(model=names).values
    order = np.argsort(mu)
    below = np.cumsum(weights[order])
    ends = ((1.0 - coverage) / 2.0, (1.0 + coverage) / 2.0)
    return [float(mu[order][min(int(np.searchsorted(below, share - 1e-12)), mu.size - 1)]) for share in ends]


def weights_of_models(data: "xarray.Dataset", little: float = 0.0) -> tuple[list[str], np.ndarray]:
    """Names and weights (models,), which sum to 1, of the models of the family that a comparison recommends; without those that
    have less of the weight than `little`. None where no model is recommended. The weights are those of the recommendation."""
    if data.attrs.get("recommended", "none") == "none":
        return [], np.empty(0)
    mu, cost = data[_MU].values, data["cost"].values
    counted = np.isfinite(mu) & np.isfinite(cost) & (data["family_of_curve"].values == data.attrs["family"])
    if not counted.any():
        return [], np.empty(0)
    weights = np.exp(-(cost[counted] - cost[counted].min()) / COST_UNIT)
    kept = weights >= little * weights.sum()
    names = data["model"].values[counted][kept].tolist()
    return names, weights[kept] / weights[kept].sum()
