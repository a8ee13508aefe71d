"""Tables of approximate separations, from which the search at a load starts.

Lone spheres under a Gaussian of heights carry F_3/2(x) at the separation x (Greenwood & Williamson 1966). By how much another
theory's separation at the same load is larger varies slowly, with x and with the one group that the theory depends on: a
bicubic spline through a few thousand values has it to 1e-4 or better, which is enough for a start.
"""

from collections.abc import Callable
from functools import cache

import numpy as np

from stiction.surfaces.theory.moments import LEAST_DENSITY, require_gaussian
from stiction.surfaces.theory.summits import Shapes, curve, truncated_mean

_SEPARATIONS = np.linspace(-12.0, 20.0, 257)
_LONE = np.linspace(-12.0, 20.0, 257)


@cache
def _inverse():
    """Return separations of lone spheres against the logarithm of their load, as a spline."""
    from scipy.interpolate import CubicSpline

    x = np.linspace(-40.0, 36.0, 2001)
    return CubicSpline(np.log(truncated_mean(1.5, x[::-1])), x[::-1], extrapolate=False)


def lone_separation(load: np.ndarray) -> np.ndarray:
    """Return separations x with F_3/2(x) = load, to 1e-6 or so.

    NaN beyond -40 and 36, and for loads of 0 or less.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        return _inverse()(np.log(load))


def tabulated(loads: Callable, groups: np.ndarray, along: np.ndarray) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Return near(load (n, m), along (n,)) -> separations (n, m), from a table made once.

    The separations are approximate. loads(h, group) -> loads (k, H) at the separations h (H,), for the groups (k,); along: (k,)
    ascending, the function of the groups in which the table is even. If several separations have one load, the largest is
    taken.
    """
    from scipy.interpolate import PchipInterpolator, RectBivariateSpline

    table = np.empty((along.size, _LONE.size))
    for row, load in zip(table, loads(_SEPARATIONS, groups), strict=True):
        part = slice(int(np.argmax(load)), int(np.searchsorted(-load, 0.0)))  # it falls, to where nothing touches
        x = lone_separation(load[part])
        row[:] = PchipInterpolator(x, _SEPARATIONS[part] - x)(np.clip(_LONE, x[0], x[-1]))
    shift = RectBivariateSpline(along, _LONE, table)

    def near(load: np.ndarray, at: np.ndarray) -> np.ndarray:
        x = lone_separation(load)
        return x + shift.ev(np.broadcast_to(at[:, None], x.shape), np.nan_to_num(x))

    return near


def separation_of_summits(load: np.ndarray, density: np.ndarray, shapes: Callable[[], Shapes]) -> np.ndarray:
    """Return approximate separations (n, m) at which summits carry loads (n, m).

    The surfaces have the roughness parameters (n,); shapes: as in `summits.curve`.
    """
    require_gaussian(density)
    return _of_shapes(shapes)(load, np.arcsin(np.minimum(LEAST_DENSITY / density, 1.0)))


@cache
def _of_shapes(shapes: Callable[[], Shapes]) -> Callable:
    along = np.linspace(1e-3, 0.5 * np.pi, 33)
    return tabulated(lambda h, density: curve(h, density, shapes)[0], LEAST_DENSITY / np.sin(along), along)
