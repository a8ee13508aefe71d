"""Tabulate approximate separations, from which the iteration for the separation at a given load starts.

Independent spheres with Gaussian heights carry the load F_3/2(x) at the separation x (Greenwood & Williamson 1966). At the same
load, the separation by another theory differs from x. The difference varies slowly with x and with the theory's only
dimensionless group. A bicubic spline through two thousand values gives the difference to 5e-4, and usually to 1e-5.
"""

from collections.abc import Callable
from functools import cache

import numpy as np

from stiction.surfaces.theory.moments import LEAST_DENSITY, require_gaussian
from stiction.surfaces.theory.summits import Shapes, curve, truncated_mean

_SEPARATIONS = np.linspace(-12.0, 20.0, 129)


@cache
def _inverse():
    """Return a spline of the separation of independent spheres as a function of the logarithm of their load F_3/2."""
    from scipy.interpolate import CubicSpline

    x = np.linspace(-40.0, 36.0, 2001)
    return CubicSpline(np.log(truncated_mean(1.5, x[::-1])), x[::-1], extrapolate=False)


def lone_separation(load: np.ndarray) -> np.ndarray:
    """Return the separation x, in units of sigma, at which independent spheres with Gaussian heights carry a load.

    The separation x solves F_3/2(x) = load (see `summits.truncated_mean`). load: array, per sphere, divided by K R^(1/2)
    sigma^(3/2). The error is about 1e-6. The result is NaN for loads of 0 or less, and where x is outside -40 to 36.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return _inverse()(np.log(load))


def tabulated(loads: Callable, groups: np.ndarray, along: np.ndarray) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Return a function that interpolates approximate separations of a theory at given loads from a table.

    - loads: function (h (H,), groups (k,)) that returns loads (k, H) of the theory at the separations h
    - groups: (k,) values of the dimensionless group of the theory
    - along: (k,) ascending, the coordinate of each group in the table

    The returned function maps loads (n, m) and coordinates (n,) to separations (n, m). If more than one separation carries a
    load, the largest is used.
    """
    from scipy.interpolate import PchipInterpolator, RectBivariateSpline

    table = np.empty((along.size, _SEPARATIONS.size))
    for row, load in zip(table, loads(_SEPARATIONS, groups), strict=True):
        part = slice(int(np.argmax(load)), int(np.searchsorted(-load, 0.0)))  # where the load falls, down to no contact
        x = lone_separation(load[part])
        row[:] = PchipInterpolator(x, _SEPARATIONS[part] - x)(np.clip(_SEPARATIONS, x[0], x[-1]))
    shift = RectBivariateSpline(along, _SEPARATIONS, table)

    def near(load: np.ndarray, at: np.ndarray) -> np.ndarray:
        x = lone_separation(load)
        return x + shift.ev(np.broadcast_to(at[:, None], x.shape), np.nan_to_num(x))

    return near


def separation_of_summits(load: np.ndarray, density: np.ndarray, shapes: Callable[[], Shapes]) -> np.ndarray:
    """Return approximate separations (n, m), divided by sigma, at which the summits of Gaussian surfaces carry given loads.

    load: (n, m), per asperity, divided by K R^(1/2) sigma^(3/2). density: N R sigma (n,) of the surfaces. shapes: function
    that returns the load and area factors of a summit, as for `summits.curve`. Raises InputError as `require_gaussian` does.
    """
    require_gaussian(density)
    return _of_shapes(shapes)(load, np.arcsin(np.minimum(LEAST_DENSITY / density, 1.0)))


@cache
def _of_shapes(shapes: Callable[[], Shapes]) -> Callable:
    along = np.linspace(1e-3, 0.5 * np.pi, 17)
    return tabulated(lambda h, density: curve(h, density, shapes)[0], LEAST_DENSITY / np.sin(along), along)
