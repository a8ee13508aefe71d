"""Choose a distribution for the heights of asperities: Gaussian, Weibull or empirical."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.asperity_set import FEW, Asperities
from stiction.surfaces.roughness import Roughness

MODELS = ("gaussian", "weibull", "empirical")

# A distribution fits if its Kolmogorov-Smirnov distance is below a limit that 1 in 20 samples drawn from the distribution
# itself exceed. With the mean and deviation of the sample the limit is 0.886 / sqrt(n) for a Gaussian (Lilliefors 1967); it is
# used for Weibull's distribution too. The long waves of a surface correlate the heights of its asperities, so n is at most
# _INDEPENDENT. A stricter test would choose the empirical distribution too often, which ends at the highest asperity of the
# scan, although a larger contact has higher asperities.
_ONE_IN_TWENTY = 0.886
_INDEPENDENT = 100
_QUANTILES = 2000  # number of quantiles that replace the samples if there are more samples
_LEAST_EXPONENT, _LARGEST_EXPONENT = 1.0, 100.0  # bounds of stiction.engine.heights.weibull


@dataclass(frozen=True)
class HeightModel:
    """Store the distribution chosen for the heights of asperities, and how well each candidate fits the heights.

    - name, parameters: name and parameters of the chosen distribution, as in `Roughness`
    - reason: why this distribution was chosen, in words
    - skewness: skewness of the heights
    - allowed: largest acceptable Kolmogorov-Smirnov distance between a distribution and the heights
    - distances: Kolmogorov-Smirnov distance of each candidate, by name: "gaussian", "weibull"
    - likelihoods: mean log-likelihood of the standardised heights for each candidate, by name; -inf if it excludes a height

    If no candidate was fitted, allowed is NaN, and distances and likelihoods are empty.
    """

    name: str
    parameters: dict[str, Any]
    reason: str
    skewness: float
    allowed: float = math.nan
    distances: dict[str, float] = field(default_factory=dict)
    likelihoods: dict[str, float] = field(default_factory=dict)


def height_model(found: Asperities, wanted: str | None = None) -> HeightModel:
    """Choose the simplest distribution that fits the heights of asperities: Gaussian, else Weibull, else empirical.

    A distribution fits if its Kolmogorov-Smirnov distance from the heights is at most a limit. One in 20 samples drawn from
    the distribution itself exceeds this limit. Every distribution has the mean and standard deviation of the heights; the
    Weibull exponent also reproduces their skewness.

    - found: the asperities
    - wanted: name of a distribution to use instead, whether it fits or not

    The result is Gaussian, regardless of `wanted`, if only averages of the heights are known, if there are fewer than FEW
    heights, or if all heights are equal. Raises InputError if `wanted` is not gaussian, weibull or empirical.
    """
    if wanted is not None and wanted not in MODELS:
        raise InputError("heights", wanted, ", ".join(MODELS))
    if found.count < FEW or not found.deviation > 0.0:
        why = f"only {found.count} heights" if 0 < found.count < FEW else "averages only"
        why = why if found.deviation > 0.0 else "all heights equal"
        return HeightModel("gaussian", {}, f"Gaussian assumed: {why}", found.skewness)
    from scipy import stats  # slow to import

    z = np.sort((found.heights - found.mean_height) / found.deviation)
    exponent = exponent_of_skewness(found.skewness)
    form = stats.weibull_min(exponent)
    mean, deviation = form.mean(), form.std()
    fits = {"gaussian": stats.norm, "weibull": stats.weibull_min(exponent, loc=-mean / deviation, scale=1.0 / deviation)}
    distances = {name: float(stats.ks_1samp(z, fit.cdf, method="asymp").statistic) for name, fit in fits.items()}
    likelihoods = {name: float(np.mean(fit.logpdf(z))) for name, fit in fits.items()}
    allowed = _ONE_IN_TWENTY / math.sqrt(min(found.count, _INDEPENDENT))
    name = wanted or next((one for one in fits if distances[one] <= allowed), "empirical")
    parameters: dict[str, dict[str, Any]] = {
        "gaussian": {}, "weibull": {"exponent": exponent}, "empirical": {"samples": _representatives(z)},
    }  # fmt: skip
    bounds = (_LEAST_EXPONENT, _LARGEST_EXPONENT)
    clipped = "; Weibull's exponent at its bound: no such skewness" if exponent in bounds else ""
    shown = ", ".join(f"{one} {distance:.3g}" for one, distance in distances.items())
    reason = f"distances {shown}; allowed {allowed:.3g}; skewness {found.skewness:.3g}{clipped}"
    reason = f"as wanted; {reason}" if wanted else reason
    return HeightModel(name, parameters[name], reason, found.skewness, allowed, distances, likelihoods)


def roughness(found: Asperities, model: HeightModel | None = None) -> Roughness:
    """Return the roughness of a contact that has these asperities.

    found: the asperities, from which sigma, R and N are taken. model: distribution of their heights, by default
    `height_model(found)`. Raises InputError if sigma is 0.
    """
    model = height_model(found) if model is None else model
    return Roughness(
        asperity_height_deviation=found.deviation,
        asperity_radius=found.radius,
        asperity_density=found.density,
        height_distribution=model.name,
        height_parameters=model.parameters,
    )


def exponent_of_skewness(skewness: float) -> float:
    """Return the exponent of the Weibull distribution with this skewness, clipped to the range 1 to 100.

    The exponent is 1 for skewness 2 and 3.60 for skewness 0.
    """
    from scipy.optimize import brentq
    from scipy.special import gamma

    def excess(exponent: float) -> float:
        first, second, third = (gamma(1.0 + k / exponent) for k in (1, 2, 3))
        variance = second - first * first
        return float((third - 3.0 * first * variance - first**3) / variance**1.5 - skewness)

    if excess(_LEAST_EXPONENT) <= 0.0:
        return _LEAST_EXPONENT
    if excess(_LARGEST_EXPONENT) >= 0.0:
        return _LARGEST_EXPONENT
    return float(brentq(excess, _LEAST_EXPONENT, _LARGEST_EXPONENT, xtol=1e-10))


def _representatives(ascending: np.ndarray) -> list[float]:
    """Return sorted samples unchanged; represent more than _QUANTILES samples by this number of quantiles.

    ascending: the samples (n,). The lowest and the highest sample are always included, because the highest asperities touch
    first.
    """
    if len(ascending) <= _QUANTILES:
        return ascending.tolist()
    return np.quantile(ascending, np.arange(_QUANTILES) / (_QUANTILES - 1)).tolist()
