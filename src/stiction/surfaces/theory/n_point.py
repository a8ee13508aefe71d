"""Compute the statistics of n-point asperities of a Gaussian profile with exponential autocorrelation.

Hariri, Zu & Ben Mrad (2006) define an asperity as n neighbouring sampled points whose n - 2 middle ones are above a level. The
closer the surfaces are, the more points an asperity has. Their abstract states that height and curvature of such an asperity
are defined and that their distributions are derived, with the exponential autocorrelation as an example. It states no formula.
This module is a reconstruction:

    asperity   a longest row of m = n - 2 neighbouring points above the level, and the points below the level beside it
    height t   the highest of the m points, above the level
    radius R   of the parabola of this height over the chord L = (m + 1) spacing between the two neighbours, L^2 / (8 t)

A Gaussian profile with exponential autocorrelation is a Markov chain, so no simulation is needed. Levels D and heights z are
divided by the standard deviation of the profile, rho is the correlation of two neighbouring heights, phi is the standard
Gaussian density, and rates are per sampled point.

- A row begins wherever the profile rises through the level. The rate of rows is a bivariate Gaussian integral, P(y0 < D <
  y1) = 2 T(D, sqrt((1 - rho)/(1 + rho))), with Owen's function T.
- A point at z is the highest of its row if the profile, on either side, falls below the level before it exceeds z. Both
  sides have the same statistics and, given z, are independent. Let q(z) be the probability for one side. The sum of the
  heights of all rows is then Int_D^inf (z - D) phi(z) q(z)^2 dz per point.
- q solves a linear integral equation on (D, z) with the kernel of the chain. Gauss-Legendre panels turn it into linear
  equations. Panels end at the requested z, so that one Cholesky factor serves all of them: its leading blocks belong to the
  shorter intervals.
"""

import math
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np
from numpy.polynomial.chebyshev import chebval2d, chebvander
from numpy.polynomial.legendre import leggauss
from scipy.linalg import cholesky, solve_triangular
from scipy.special import ndtr, owens_t

from stiction.quantities.errors import InputError, InWords

_gauss = cache(leggauss)


# ---- on a measured profile


@dataclass(frozen=True)
class NPointAsperities:
    """Store the n-point asperities of a profile at one level, from left to right, as arrays (k,).

    - points: number n of points, including the two neighbours below the level
    - height: height of the highest point above the level
    - radius: radius of the parabola with this height over the chord between the two neighbours
    - middle: index of the point in the middle of the asperity

    height and radius have the unit of the profile.
    """

    points: np.ndarray
    height: np.ndarray
    radius: np.ndarray
    middle: np.ndarray


def n_point_asperities(profile, spacing: float, level: float) -> NPointAsperities:
    """Find the n-point asperities of a sampled profile above a level.

    An asperity is an unbroken run of points above the level, together with the neighbour at or below the level on either side.
    Runs cut by an end of the profile are excluded. profile: heights (N,) [m]. spacing: distance between neighbouring points
    [m], > 0. level: [m], measured from the same zero as the heights. Raises InputError unless the profile is one-dimensional
    and finite and the spacing is > 0.
    """
    heights = np.asarray(profile, dtype=float)
    if heights.ndim != 1 or not np.isfinite(heights).all():
        raise InputError("profile", InWords(f"shape {heights.shape}"), "one row of finite heights")
    if not spacing > 0.0:
        raise InputError("spacing", spacing, "> 0")
    above = heights > level
    first = np.flatnonzero(~above[:-1] & above[1:]) + 1
    past = np.flatnonzero(above[:-1] & ~above[1:]) + 1
    if len(past) and (not len(first) or past[0] < first[0]):
        past = past[1:]  # this row began before the profile
    first = first[: len(past)]
    if not len(first):
        return NPointAsperities(np.zeros(0, dtype=int), np.zeros(0), np.zeros(0), np.zeros(0, dtype=int))
    height = np.maximum.reduceat(heights, np.column_stack([first, past]).ravel())[::2] - level
    chord = (past - first + 1) * spacing
    return NPointAsperities(past - first + 2, height, chord * chord / (8.0 * height), (first + past - 1) // 2)


# ---- on a Gaussian profile with exponential autocorrelation


def rate_of_rows(level, correlation):
    """Return the expected number of n-point asperities, of any n, per sampled point of a Gaussian profile.

    It is the probability that a point is below the level and its next neighbour above it. level: level in standard deviations
    of the profile. correlation: correlation of neighbouring heights, 0 or more and below 1. Both may be arrays.
    """
    return 2.0 * owens_t(level, np.sqrt((1.0 - correlation) / (1.0 + correlation)))


def points_above(level):
    """Return the fraction of the points of a Gaussian profile above a level; level: in standard deviations of the profile."""
    return ndtr(-np.asarray(level, dtype=float))


def mean_height(level, correlation):
    """Return the mean height above the level of the n-point asperities of a Gaussian profile, for all n together.

    Heights and levels are divided by the standard deviation of the profile. level and correlation (of neighbouring heights):
    numbers or arrays. A table is interpolated, accurate to 5e-6 for levels D of -3 to 10. Beyond them the leading terms are
    used: the height grows as 2 |D| below and falls as 1/D above. Raises InputError unless 0 <= correlation <=
    LARGEST_CORRELATION.
    """
    level, correlation = np.broadcast_arrays(np.asarray(level, dtype=float), np.asarray(correlation, dtype=float))
    good = (correlation >= 0.0) & (correlation <= LARGEST_CORRELATION)
    if not good.all():
        raise InputError("correlation", float(correlation[~good][0]), f"0 to {LARGEST_CORRELATION:.5g}")
    inside = np.clip(level, _LOWEST, _HIGHEST)
    value = np.exp(chebval2d(_unit_level(inside), _unit_roughness(correlation), _table()))
    return (value + 2.0 * np.maximum(_LOWEST - level, 0.0)) * _HIGHEST / np.maximum(level, _HIGHEST)


# Range of the table of mean heights in the level, and in sqrt(1 - correlation), which is small if neighbours are alike.
_LOWEST, _HIGHEST, _FOLD = -3.0, 10.0, 12.0
_SMALLEST = 0.0275
_DEGREES = 28, 16
_FILE = "n_point_heights.txt"
LARGEST_CORRELATION = 1.0 - _SMALLEST * _SMALLEST


def _unit_level(level):
    """Map the levels of the table of mean heights to -1..1, with a finer scale at low levels."""
    share = (level - _LOWEST) / (level - _LOWEST + _FOLD)
    return 2.0 * share * (_HIGHEST - _LOWEST + _FOLD) / (_HIGHEST - _LOWEST) - 1.0


def _unit_roughness(correlation):
    """Map the correlations of the table of mean heights to 1..-1, linearly in (1 - correlation)^(1/4)."""
    least = math.sqrt(_SMALLEST)
    return 2.0 * ((1.0 - correlation) ** 0.25 - least) / (1.0 - least) - 1.0


@cache
def _table() -> np.ndarray:
    """Return the table that `make` computes, from the file `_FILE`."""
    with resources.files("stiction.surfaces.theory").joinpath(_FILE).open() as file:
        return np.loadtxt(file)


def make() -> np.ndarray:
    """Compute Chebyshev coefficients of the logarithm of the mean height of n-point asperities above a level.

    The result has the shape `_DEGREES`. The two variables of the series are the level and the correlation of neighbouring
    heights, both mapped to -1 to 1. The command `python -m stiction.surfaces.theory.n_point` (takes about a second) writes the
    coefficients to the file `_FILE`.
    """
    x, y = (np.cos(math.pi * (np.arange(n) + 0.5) / n) for n in _DEGREES)
    share = (x + 1.0) / 2.0 * (_HIGHEST - _LOWEST) / (_HIGHEST - _LOWEST + _FOLD)
    levels = _LOWEST + _FOLD * share / (1.0 - share)
    least = math.sqrt(_SMALLEST)
    correlations = 1.0 - (least + (1.0 - least) * (1.0 + y) / 2.0) ** 4
    values = np.array([[math.log(solved_mean_height(D, rho)) for rho in correlations] for D in levels])
    along_levels = np.linalg.solve(chebvander(x, len(x) - 1), values)
    return np.linalg.solve(chebvander(y, len(y) - 1), along_levels.T).T


def solved_mean_height(level: float, correlation: float, heights: int = 48, fineness: float = 1.7, least: int = 2) -> float:
    """Return the mean height of n-point asperities above one level >= -3, from the integral equation of the module docstring.

    - level: height of the level, in standard deviations of the profile, like the result; correlation: of neighbouring heights
    - heights: number of heights z in the quadrature
    - fineness, least: a panel between two heights z has `least` Gauss points, plus `fineness` for every width of the kernel

    The result is accurate to 3e-6.
    """
    width = math.sqrt(1.0 - correlation * correlation)
    reach = math.sqrt((level * level if level > 0.0 or level < -1.0 else 0.0) + 40.0) - level
    node, weight = _gauss(heights)
    share = (1.0 + node) / 2.0
    z = level + reach * share * (1.0 + share) / 2.0  # twice as dense near the level
    dz = reach * (1.0 + 2.0 * share) / 2.0 * weight / 2.0
    start = np.concatenate([[level], z[:-1]])
    span = z - start
    counts = least + np.ceil(fineness * span / width).astype(int)
    panels = [(a, b, *_gauss(n)) for a, b, n in zip(start, span, counts.tolist(), strict=True)]
    x = np.concatenate([a + b * (1.0 + node) / 2.0 for a, b, node, _ in panels])
    root = np.sqrt(np.concatenate([b / 2.0 * weight for _, b, _, weight in panels]))

    matrix = -(root[:, None] * root) * _kernel(x[:, None], x, correlation)
    matrix[np.diag_indices(len(x))] += 1.0
    factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
    right = np.column_stack([root * _falls(x, level, correlation), root[:, None] * _kernel(x[:, None], z, correlation)])
    solved = solve_triangular(factor, right, lower=True, check_finite=False)
    # q(z) sqrt(phi): the profile falls below the level at once, or continues to lower points and falls from there.
    later = np.cumsum(solved[:, :1] * solved[:, 1:], axis=0)[np.cumsum(counts) - 1, np.arange(heights)]
    q = _falls(z, level, correlation) + later
    return float(np.sum(dz * (z - level) * q * q) / rate_of_rows(level, correlation))


def _kernel(x, y, correlation):
    """Return the joint Gaussian density of two neighbouring heights x and y divided by sqrt(phi(x) phi(y)).

    Heights are in standard deviations of the profile. correlation: correlation of the two heights. phi is the standard Gaussian
    density. The division makes the kernel of the Markov chain symmetric.
    """
    variance = 1.0 - correlation * correlation
    spread = correlation / (2.0 * variance) * (x - y) ** 2
    fall = (1.0 - correlation) / (4.0 * (1.0 + correlation)) * (x * x + y * y)
    return np.exp(-spread - fall) / math.sqrt(2.0 * math.pi * variance)


def _falls(x, level, correlation):
    """Return sqrt(phi(x)) times the probability that, after a point at the height x, the next point is below the level.

    x and level are in standard deviations of the profile. correlation: correlation of neighbouring heights. phi is the standard
    Gaussian density.
    """
    root = np.exp(-0.25 * x * x) / (2.0 * math.pi) ** 0.25
    return ndtr((level - correlation * x) / math.sqrt(1.0 - correlation * correlation)) * root


# ---- peaks of three points, and the sampled profile of a given surface


def peaks_per_point(correlation):
    """Return the fraction of the points of a Gaussian profile that are higher than both neighbours.

    correlation: correlation rho of neighbouring heights; the autocorrelation is exponential. The differences to the two
    neighbours are Gaussian, with correlation (1 - rho)/2. Source: Whitehouse & Archard 1970.
    """
    return 0.25 + np.arcsin((1.0 - correlation) / 2.0) / (2.0 * math.pi)


def peak_curvature(correlation):
    """Return the mean of 2 y0 - y-1 - y1 over the three-point peaks of a Gaussian profile, a dimensionless curvature.

    y0 is the height of the peak, y-1 and y1 the heights of its neighbours, all in standard deviations of the profile.
    correlation: correlation of neighbouring heights; the autocorrelation is exponential. Source: Whitehouse & Archard 1970.
    """
    return (3.0 - correlation) * np.sqrt(1.0 - correlation) / (2.0 * math.sqrt(math.pi) * peaks_per_point(correlation))


# On a profile of an isotropic Gaussian surface there are (1/2 pi) sqrt(m4/m2) peaks per length, of mean curvature
# sqrt(pi m4/2) (Nayak 1971). A sampled profile of the same variance has as many peaks of the same curvature if
# peak_curvature / peaks_per_point^2 equals this number over sqrt(alpha).
_MATCH = 4.0 * math.pi**2 * math.sqrt(math.pi / 2.0)


def _match(correlation):
    return peak_curvature(correlation) / peaks_per_point(correlation) ** 2


# The smallest Nayak's alpha that such a profile can represent, with uncorrelated neighbours: (8 pi^3)^2 / (2 81^2) = 4.689.
LEAST_BANDWIDTH = (_MATCH / float(_match(0.0))) ** 2
# The largest Nayak's alpha for which the mean height is tabulated.
LARGEST_BANDWIDTH = (_MATCH / float(_match(LARGEST_CORRELATION))) ** 2


def correlation_of_bandwidth(alpha: np.ndarray) -> np.ndarray:
    """Return the correlation (n,) of neighbouring points of a profile that represents a surface with Nayak's alpha (n,).

    alpha: bandwidth parameter m0 m4/m2^2. The profile has an exponential autocorrelation. With this correlation, its
    three-point peaks have the same number and curvature as the peaks of a profile on a Gaussian surface with alpha. The
    equation is solved by bisection. Raises InputError unless alpha is LEAST_BANDWIDTH to LARGEST_BANDWIDTH.
    """
    alpha = np.asarray(alpha, dtype=float)
    bad = ~((alpha >= LEAST_BANDWIDTH) & (alpha <= LARGEST_BANDWIDTH))
    if bad.any():
        raise InputError(
            "bandwidth",
            float(alpha[bad][0]),
            f"{LEAST_BANDWIDTH:.4g} to {LARGEST_BANDWIDTH:.4g}: the range of the tabulated profiles with exponential "
            "autocorrelation",
        )
    low, high = np.full(alpha.shape, _SMALLEST), np.ones(alpha.shape)  # bounds of sqrt(1 - correlation)
    for _ in range(52):
        middle = (low + high) / 2.0
        less = _match(1.0 - middle * middle) * np.sqrt(alpha) < _MATCH
        low, high = np.where(less, middle, low), np.where(less, high, middle)
    return 1.0 - ((low + high) / 2.0) ** 2


if __name__ == "__main__":
    with resources.as_file(resources.files("stiction.surfaces.theory")) as folder:
        np.savetxt(folder / _FILE, make(), fmt="%.17g")
