"""Distributions of asperity heights, all standardised: mean 0 and standard deviation 1, in units of sigma.

A new distribution is one density, one window and one constructor below, and a line in DISTRIBUTIONS.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import TYPE_CHECKING, TypedDict, Unpack

import numpy as np

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.quantities.errors import InputError
from stiction.quantities.keywords import with_keywords

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

# Where the density has fallen by exp(-NEGLIGIBLE) below its largest value on a piece, the rest of the piece is left out.
NEGLIGIBLE = 36.0

_INV_SQRT_2PI = 0.3989422804014327
_NO_DENSITY = 745.0  # exp of less than minus this is 0


@dataclass(frozen=True, eq=False)
class Heights:
    """A standardised height distribution.

    density(z, shape): probability density at the height z over sigma. window(z_left, z_right, shape) -> (low, high): the
    part of that interval outside which the density is negligible. shape: the parameters of both. knots: heights at which
    the density is not smooth; the engine splits there. tops: the highest height, and all others with a gap above them, where
    asperities begin to touch anew; none of a density that fades out. entire: the density has no singularity at all, so that
    sums over many separations may use its Chebyshev expansion.
    """

    key: str
    density: Callable
    window: Callable
    shape: np.ndarray = field(default_factory=lambda: np.zeros(1))
    knots: np.ndarray = field(default_factory=lambda: np.zeros(0))
    tops: np.ndarray = field(default_factory=lambda: np.zeros(0))
    entire: bool = False


@formula
def gaussian_density(z, shape):
    """phi(z) = exp(-z^2/2) / sqrt(2 pi)."""
    return _INV_SQRT_2PI * exponential(-0.5 * z * z)


@formula
def gaussian_window(z_left, z_right, shape):
    nearest = max(z_left, 0.0) + min(z_right, 0.0)  # the height on the piece that is nearest to the mean
    reach = math.sqrt(nearest * nearest + 2.0 * NEGLIGIBLE)
    return max(z_left, -reach), min(z_right, reach)


@cache
def gaussian() -> Heights:
    """Gaussian heights, the default of the field (Greenwood & Williamson 1966)."""
    return Heights("gaussian", gaussian_density, gaussian_window, entire=True)


@formula
def exponential_density(z, shape):
    """exp(-(z + 1)) for z >= -1."""
    return exponential(-(z + 1.0)) if z >= -1.0 else 0.0


@formula
def exponential_window(z_left, z_right, shape):
    low = max(z_left, -1.0)
    return low, min(z_right, low + NEGLIGIBLE)


@cache
def exponential_heights() -> Heights:
    """Exponential heights: every sum has a closed form (Greenwood & Williamson 1966, section 3)."""
    return Heights("exponential", exponential_density, exponential_window, knots=np.array([-1.0]))


@formula
def weibull_density(z, shape):
    """Weibull density of y = mean + deviation z, times the deviation; shape = (exponent, mean, deviation), scale 1."""
    exponent, mean, deviation = shape[0], shape[1], shape[2]
    y = mean + deviation * z
    if y <= 0.0:
        return 0.0
    power = y ** (exponent - 1.0)
    return deviation * exponent * power * math.exp(-power * y) if power * y < _NO_DENSITY else 0.0


@formula
def weibull_window(z_left, z_right, shape):
    exponent, mean, deviation = shape[0], shape[1], shape[2]
    low = max(z_left, -mean / deviation)
    nearest = max(mean + deviation * low, 0.0) ** exponent
    if nearest > _NO_DENSITY:
        return low, low
    # 5 more than NEGLIGIBLE makes up for the factor y^(exponent-1), left out here.
    high = (nearest + NEGLIGIBLE + 5.0) ** (1.0 / exponent)
    return low, min(z_right, (high - mean) / deviation)


@cache
def weibull(exponent: float) -> Heights:
    """Return Weibull heights of the given shape parameter (1 is exponential, 3.6 nearly Gaussian).

    A parameter below 1 is refused, because the density has a pole.
    """
    if not 1.0 <= exponent <= 100.0:
        raise InputError("height_distribution.exponent", exponent, "1 to 100")
    mean = math.gamma(1.0 + 1.0 / exponent)
    deviation = math.sqrt(math.gamma(1.0 + 2.0 / exponent) - mean * mean)
    shape = np.array([exponent, mean, deviation])
    return Heights("weibull", weibull_density, weibull_window, shape, knots=np.array([-mean / deviation]))


@formula
def empirical_density(z, shape):
    """Piecewise linear density; shape = (first knot, spacing, density at each knot ...)."""
    position = (z - shape[0]) / shape[1]
    last = shape.size - 3
    if position < 0.0 or position > last:
        return 0.0
    cell = min(int(position), last - 1)
    part = position - cell
    return (1.0 - part) * shape[2 + cell] + part * shape[3 + cell]


@formula
def empirical_window(z_left, z_right, shape):
    return max(z_left, shape[0]), min(z_right, shape[0] + shape[1] * (shape.size - 3))


def empirical(samples: np.ndarray, cells: int | None = None) -> Heights:
    """Heights as measured: the frequency polygon of `samples` (any unit), scaled to mean 0 and standard deviation 1.

    cells: number of histogram cells; by default the rule of Freedman & Diaconis (1981).
    """
    samples = np.asarray(samples, dtype=float).ravel()
    if samples.size < 10 or not np.all(np.isfinite(samples)) or np.ptp(samples) == 0.0:
        raise InputError("height_distribution.samples", f"{samples.size} samples", "10 or more finite, not all equal")
    bins = cells or min(max(len(np.histogram_bin_edges(samples, "fd")) - 1, 10), 400)
    counts, edges = np.histogram(samples, bins)
    step = edges[1] - edges[0]
    knots = np.concatenate([[edges[0] - step / 2], (edges[:-1] + edges[1:]) / 2, [edges[-1] + step / 2]])
    density = np.concatenate([[0.0], counts / (samples.size * step), [0.0]])
    # Moments of the polygon itself: each knot carries a triangle of half-width `step`, of variance step^2/6.
    mass = density * step
    mean = np.sum(mass * knots)
    deviation = math.sqrt(np.sum(mass * (knots - mean) ** 2) + step**2 / 6.0)
    knots = (knots - mean) / deviation
    shape = np.concatenate([[knots[0], step / deviation], density * deviation])
    tops = knots[1:][(density[1:] == 0.0) & (density[:-1] > 0.0)]
    return Heights("empirical", empirical_density, empirical_window, shape, knots, tops)


DISTRIBUTIONS: dict[str, Callable[..., Heights]] = {
    "gaussian": gaussian,
    "exponential": exponential_heights,
    "weibull": weibull,
    "empirical": empirical,
}


class HeightParameters(TypedDict, total=False):
    """Parameters of height distributions."""

    exponent: float
    samples: "ArrayLike"
    cells: int | None


@with_keywords(HeightParameters)
def height_distribution(key: str, **parameters: Unpack[HeightParameters]) -> Heights:
    """Return a height distribution by its name.

    Parameters
    ----------
    key : str
        "gaussian", "exponential", "weibull" or "empirical".
    exponent : float, optional
        Shape parameter of "weibull".
    samples : array_like (n,), optional
        Measured heights of "empirical", in any unit.
    cells : int, optional
        Number of cells of the density of "empirical"; by default by the number of samples.

    Returns
    -------
    Heights
        Distribution with mean 0 and standard deviation 1, for `heights` of `solve`.

    Raises
    ------
    InputError
        The name is not known, or a parameter is missing or out of bounds.

    Examples
    --------
    >>> import stiction as st
    >>> weibull = st.height_distribution("weibull", exponent=2.0)
    >>> result = st.solve(st.Indices(theta=40, lam=10), load=1.0, heights=weibull)
    >>> result.attrs["heights"]
    'weibull'
    """
    if key not in DISTRIBUTIONS:
        raise InputError("height_distribution", key, ", ".join(DISTRIBUTIONS))
    try:
        return DISTRIBUTIONS[key](**parameters)
    except TypeError:
        needs = {"weibull": "exponent", "empirical": "samples"}.get(key, "no parameter")
        raise InputError("height_distribution", f"{key} with {sorted(parameters) or 'no parameter'}", needs) from None
