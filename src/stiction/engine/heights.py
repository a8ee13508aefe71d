"""Provide distributions of asperity heights, standardised to mean 0 and standard deviation 1.

Heights are in units of sigma, their standard deviation. To add a distribution, write a density, a window and a constructor, and
add it to DISTRIBUTIONS. Heights that are listed one by one have no density: sums over them have as many terms as there are
heights.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from numbers import Real
from typing import TYPE_CHECKING, TypedDict, Unpack

import numpy as np

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.keywords import with_keywords

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

# Integration stops where the density has fallen to exp(-NEGLIGIBLE) of its largest value on a segment.
NEGLIGIBLE = 36.0

_INV_SQRT_2PI = 0.3989422804014327
_NO_DENSITY = 745.0  # exp(-x) is 0 in double precision for larger x
_ALIKE = 1e-12  # listed heights with a smaller ratio of standard deviation to largest height differ by rounding alone


@dataclass(frozen=True, eq=False)
class Heights:
    """Represent a height distribution with mean 0 and standard deviation 1; heights z are in units of sigma.

    key: name of the distribution. density(z, shape): probability density. window(z_left, z_right, shape) -> (low, high): the
    part of the interval in which the density is not negligible. shape: parameters of density and window. knots: heights at
    which the density is not smooth; the integration is split there. tops: upper ends of the ranges in which heights occur,
    where further asperities begin to touch on approach; empty if the density has no upper end. entire: True if the density is
    an entire function (it has no singularity), so that sums over many separations can be interpolated. listed: the heights of
    single asperities, which replace the density; empty for a density.
    """

    key: str
    density: Callable
    window: Callable
    shape: np.ndarray = field(default_factory=lambda: np.zeros(1))
    knots: np.ndarray = field(default_factory=lambda: np.zeros(0))
    tops: np.ndarray = field(default_factory=lambda: np.zeros(0))
    entire: bool = False
    listed: np.ndarray = field(default_factory=lambda: np.zeros(0))


@formula
def gaussian_density(z, shape):
    """Return the standard normal density exp(-z^2/2) / sqrt(2 pi) at the height z; `shape` is not used."""
    return _INV_SQRT_2PI * exponential(-0.5 * z * z)


@formula
def gaussian_window(z_left, z_right, shape):
    nearest = max(z_left, 0.0) + min(z_right, 0.0)  # the height on the segment that is nearest to the mean
    reach = math.sqrt(nearest * nearest + 2.0 * NEGLIGIBLE)
    return max(z_left, -reach), min(z_right, reach)


@cache
def gaussian() -> Heights:
    """Return Gaussian heights, the usual assumption (Greenwood & Williamson 1966)."""
    return Heights("gaussian", gaussian_density, gaussian_window, entire=True)


@formula
def exponential_density(z, shape):
    """Return the exponential density exp(-(z + 1)) at the height z >= -1, else 0; `shape` is not used."""
    return exponential(-(z + 1.0)) if z >= -1.0 else 0.0


@formula
def exponential_window(z_left, z_right, shape):
    low = max(z_left, -1.0)
    return low, min(z_right, low + NEGLIGIBLE)


@cache
def exponential_heights() -> Heights:
    """Return exponential heights, for which sums over touching asperities fall as exp(-h) with the separation h >= -1.

    Greenwood & Williamson 1966, section 3. h: separation from the mean height, in units of sigma. No asperity is lower than -1.
    """
    return Heights("exponential", exponential_density, exponential_window, knots=np.array([-1.0]))


@formula
def weibull_density(z, shape):
    """Return the Weibull density with mean 0 and standard deviation 1 at the height z.

    shape: (exponent, mean, deviation) of the Weibull variable y = mean + deviation z with scale 1.
    """
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
    # The 5 added to NEGLIGIBLE compensates for the omitted factor y^(exponent-1) of the density.
    high = (nearest + NEGLIGIBLE + 5.0) ** (1.0 / exponent)
    return low, min(z_right, (high - mean) / deviation)


@cache
def weibull(exponent: float) -> Heights:
    """Return Weibull heights with the shape parameter `exponent`, 1 (exponential) to 100; 3.6 is nearly Gaussian.

    Values outside this range raise an InputError; below 1 the density would be infinite at its lower end.
    """
    if not isinstance(exponent, Real) or not 1.0 <= exponent <= 100.0:
        raise InputError("height_distribution.exponent", exponent, "1 to 100")
    mean = math.gamma(1.0 + 1.0 / exponent)
    deviation = math.sqrt(math.gamma(1.0 + 2.0 / exponent) - mean * mean)
    shape = np.array([exponent, mean, deviation])
    return Heights("weibull", weibull_density, weibull_window, shape, knots=np.array([-mean / deviation]))


@formula
def empirical_density(z, shape):
    """Return the density at the height z by linear interpolation between equally spaced knots, and 0 outside them.

    shape: first knot, spacing, then the density at each knot.
    """
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
    """Return the distribution of measured heights as a frequency polygon, scaled to mean 0 and standard deviation 1.

    samples: 10 or more heights in any unit. cells: number of histogram cells; by default from the rule of Freedman & Diaconis
    (1981). Raises InputError for fewer heights, and for heights that are not finite or all equal.
    """
    samples = np.asarray(samples, dtype=float).ravel()
    if samples.size < 10 or not np.all(np.isfinite(samples)) or np.ptp(samples) == 0.0:
        raise InputError(
            "height_distribution.samples", InWords(f"{samples.size} samples"), "10 or more finite heights, not all equal"
        )
    bins = cells or min(max(len(np.histogram_bin_edges(samples, "fd")) - 1, 10), 400)
    counts, edges = np.histogram(samples, bins)
    step = edges[1] - edges[0]
    knots = np.concatenate([[edges[0] - step / 2], (edges[:-1] + edges[1:]) / 2, [edges[-1] + step / 2]])
    density = np.concatenate([[0.0], counts / (samples.size * step), [0.0]])
    # Moments of the polygon itself: the sum of one triangle per knot, each of half-width `step` and variance step^2/6.
    mass = density * step
    mean = np.sum(mass * knots)
    deviation = math.sqrt(np.sum(mass * (knots - mean) ** 2) + step**2 / 6.0)
    knots = (knots - mean) / deviation
    shape = np.concatenate([[knots[0], step / deviation], density * deviation])
    tops = knots[1:][(density[1:] == 0.0) & (density[:-1] > 0.0)]
    return Heights("empirical", empirical_density, empirical_window, shape, knots, tops)


def discrete(samples: np.ndarray) -> Heights:
    """Return the heights of single asperities, scaled to mean 0 and standard deviation 1 (divisor n).

    samples: 2 or more heights in any unit. Sums run over these asperities one by one, without a density (Aymard et al. 2024).
    Raises InputError for fewer heights, and for heights that are not finite or equal apart from round-off.
    """
    samples = np.sort(np.asarray(samples, dtype=float).ravel())
    if samples.size < 2 or not np.all(np.isfinite(samples)) or samples[0] == samples[-1]:
        raise InputError(
            "height_distribution.samples", InWords(f"{samples.size} samples"), "2 or more finite heights, not all equal"
        )
    z = (samples - samples.mean()) / samples.std()
    if samples.std() <= _ALIKE * np.abs(samples).max():
        why = InWords(f"{samples.size} heights of {samples.mean():.4g} with the standard deviation {samples.std():.2g}")
        raise InputError("height_distribution.samples", why, "heights that differ by more than rounding")
    shape = np.array([z[0], z[-1] - z[0], 0.0, 0.0])  # a polygon without density between the lowest and the highest
    return Heights("discrete", empirical_density, empirical_window, shape, tops=np.unique(z), listed=z)


DISTRIBUTIONS: dict[str, Callable[..., Heights]] = {
    "gaussian": gaussian,
    "exponential": exponential_heights,
    "weibull": weibull,
    "empirical": empirical,
    "discrete": discrete,
}


class HeightParameters(TypedDict, total=False):
    """Define the parameters of the height distributions and their types.

    exponent: shape parameter of "weibull". samples: heights for "empirical" and "discrete". cells: number of histogram cells of
    "empirical".
    """

    exponent: float
    samples: "ArrayLike"
    cells: int | None


@with_keywords(HeightParameters)
def height_distribution(key: str, **parameters: Unpack[HeightParameters]) -> Heights:
    """Return the height distribution with this name.

    Parameters
    ----------
    key : str
        "gaussian", "exponential", "weibull", "empirical" or "discrete".
    exponent : float, optional
        Shape parameter of "weibull", 1 to 100.
    samples : array_like (n,), optional
        Measured heights for "empirical", 10 or more; or the height of every asperity for "discrete", 2 or more. In any unit.
    cells : int, optional
        Number of histogram cells of "empirical"; chosen from the samples by default.

    Returns
    -------
    Heights
        Distribution with mean 0 and standard deviation 1, for the argument `heights` of `solve`.

    Raises
    ------
    InputError
        The name is unknown, or a parameter is missing or out of bounds.

    Examples
    --------
    >>> import stiction as st
    >>> weibull = st.height_distribution("weibull", exponent=2.0)
    >>> result = st.solve(st.Indices(theta=40, lam=10), load=1.0, heights=weibull)
    >>> result.attrs["heights"]
    'weibull'
    """
    if not isinstance(key, str) or key not in DISTRIBUTIONS:
        raise InputError("height_distribution", key, ", ".join(DISTRIBUTIONS))
    try:
        return DISTRIBUTIONS[key](**parameters)
    except TypeError:
        samples = "the parameter samples"
        needs = {"weibull": "the parameter exponent", "empirical": samples, "discrete": samples}.get(key, "no parameter")
        stated = InWords(f"{key} with {', '.join(sorted(parameters)) or 'no parameter'}")
        raise InputError("height_distribution", stated, needs) from None
