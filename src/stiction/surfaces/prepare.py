"""Prepare a measured surface for analysis: mask spikes, remove form, fill, and filter to a band of wavelengths.

Each step takes a HeightMap and returns a new one, with the step added to its history. Missing points stay missing unless
filled. Fits use only the points that have heights.
"""

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial.legendre import legvander

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.filters import filter_band, filter_period
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.held import as_height_map
from stiction.surfaces.spikes import mask_spikes

if TYPE_CHECKING:
    from stiction.quantities.arguments import QuantityLike

_APART = 5.0  # least ratio of height steps across the edges to those between neighbours for which a map is not one period


def prepared(
    surface: HeightMap,
    form: int = 1,
    spikes: float | None = None,
    fill: str | None = None,
    shortest: "QuantityLike | None" = None,
    longest: "QuantityLike | None" = None,
    period: bool = False,
) -> HeightMap:
    """Prepare a scan for analysis: remove its form, and filter it to a band of wavelengths.

    Parameters
    ----------
    surface : HeightMap
        Heights (rows, columns) [m], as `read_scan` returns them.
    form : int, optional
        Order of the polynomial to remove: 1 (default) for the mean plane, 0 for none, at most 4.
    spikes : float, optional
        Mask points whose distance from the median height is more than this number of robust standard deviations (1.4826 times
        the median distance). The map is levelled first; the form is removed afterwards. By default no point is masked.
    fill : {"harmonic", "nearest"}, optional
        How missing points are filled, see `fill_missing`; by default they stay missing.
    shortest, longest : float [m] or str with a unit, optional
        Ends of the band of wavelengths that is kept; by default open.
    period : bool, optional
        Whether the map is one period of an infinite surface, by default not. Its mean height is then subtracted in place of a
        form, the filters continue over its edges, and a map with missing points is not filtered.

    Returns
    -------
    HeightMap
        Heights of the same shape [m], with every step in `history`. Unless the map is a period, they are not periodic if form,
        spikes or wavelengths are removed.

    Raises
    ------
    InputError
        An option is out of its bounds, fewer points have heights than the form has coefficients, or only round-off remains
        after spikes and form are removed.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
    >>> print(st.prepared(surface, shortest="500 nm").history[-1].split(":")[0])
    filtered to wavelengths 500 nm to all
    """
    surface = raw = as_height_map(surface)
    if spikes is not None:
        surface = mask_spikes(surface if period else level(surface), spikes)
    if isinstance(form, bool) or form not in (0, 1, 2, 3, 4):
        raise InputError("form", form, "0, 1, 2, 3 or 4: the order of the polynomial that is removed; 0 for none")
    if not period:
        if form:
            surface = level(surface) if form == 1 else remove_form(surface, form)
        _check_left(raw, surface)
    if fill is not None:
        surface = fill_missing(surface, fill)
    band = shortest is not None or longest is not None
    if not period:
        return filter_band(surface, shortest, longest) if band else surface
    if band and surface.complete:
        surface = filter_period(surface, shortest, longest)
    return surface.with_heights(surface.heights - np.nanmean(surface.heights), f"mean removed{_seam(surface)}")


def _seam(surface: HeightMap) -> str:
    """Return a warning for the history if opposite edges of one period do not match; "" if they match.

    They do not match if the rms height step across the edges is at least 5 times the rms step between neighbouring points.
    """
    heights = surface.heights
    far = 0.0
    for axis in (axis for axis in (0, 1) if heights.shape[axis] > 1):
        within = float(np.nanmean(np.square(np.diff(heights, axis=axis))))
        across = np.square(np.take(heights, 0, axis=axis) - np.take(heights, -1, axis=axis))
        if np.isfinite(across).any() and within > 0.0:
            far = max(far, math.sqrt(float(np.nanmean(across)) / within))
    if far < _APART:
        return ""
    return (
        " of one period, whose opposite edges do not match: "
        f"height steps across them are {far:.0f} times those between neighbouring points"
    )


def _check_left(raw: HeightMap, surface: HeightMap) -> None:
    """Raise InputError if only round-off remains after spikes and form are removed.

    raw, surface: the map before and after the removal.
    """
    if surface is raw or not np.isfinite(surface.heights).any():
        return
    before, after = (float(np.nanmax(one.heights) - np.nanmin(one.heights)) for one in (raw, surface))
    offset = max(abs(float(np.nanmax(raw.heights))), abs(float(np.nanmin(raw.heights))))
    if after <= 1e-12 * before + 8.0 * np.finfo(float).eps * offset:
        raise InputError(
            "scan", InWords(f"{surface.name} is flat once its form is removed"), "a scan that is rough after form removal"
        )


def level(surface: HeightMap) -> HeightMap:
    """Return the map minus its least-squares mean plane, or a profile minus its mean line.

    The result is not periodic. Raises InputError if fewer points have heights than the plane or line has coefficients.
    """
    fitted = "line" if surface.is_profile else "plane"
    return surface.with_heights(_without_polynomial(surface, 1), f"levelled: least-squares {fitted} removed").alone()


def remove_form(surface: HeightMap, order: int) -> HeightMap:
    """Return the map minus its least-squares polynomial in x and y.

    order: total order of the polynomial, 1 to 4. It is fitted to the points with heights. The result is not periodic.
    Raises InputError for another order, or if fewer points have heights than the polynomial has coefficients.
    """
    if isinstance(order, bool) or order not in (1, 2, 3, 4):
        raise InputError("order", order, "1, 2, 3 or 4, the order of the polynomial to remove")
    left = _without_polynomial(surface, order)
    return surface.with_heights(left, f"form removed: least-squares polynomial of order {order}").alone()


def _without_polynomial(surface: HeightMap, order: int) -> np.ndarray:
    """Return the heights (rows, columns) [m] of a map minus their least-squares polynomial of total order `order` in x and y.

    Legendre polynomials over -1..1 keep the normal equations well conditioned; they are summed row by row, so that the matrix
    of all points and terms never exists. A second fit to the residual removes the round-off of the first. Raises InputError if
    there are fewer points than coefficients.
    """
    heights = surface.heights
    rows, columns = heights.shape
    there = None if surface.complete else ~np.isnan(heights)
    along_x, along_y = legvander(_unit(columns), order), legvander(_unit(rows), order)
    terms = [(i, j) for i in range(order + 1) for j in range(order + 1 - i) if rows > 1 or j == 0]
    if heights.size - surface.missing < len(terms):
        raise InputError(
            "scan",
            InWords(f"{heights.size - surface.missing} points with heights"),
            f"at least {len(terms)} points with heights for this fit",
        )
    left = heights - np.nanmean(heights)
    gram = _gram(there, along_x, along_y, terms)
    for _ in range(2):
        known = left if there is None else np.where(there, left, 0.0)
        moments = along_y.T @ (known @ along_x)
        solved = np.linalg.lstsq(gram, np.array([moments[j, i] for i, j in terms]), rcond=1e-13)[0]
        coefficients = np.zeros((order + 1, order + 1))  # by order in y and order in x
        coefficients[[j for _, j in terms], [i for i, _ in terms]] = solved
        left -= along_y @ coefficients @ along_x.T
    return left


def _unit(count: int) -> np.ndarray:
    return np.linspace(-1.0, 1.0, count) if count > 1 else np.zeros(1)


def _gram(there: np.ndarray | None, along_x: np.ndarray, along_y: np.ndarray, terms) -> np.ndarray:
    """Return the matrix (terms, terms) of the sums over points of the products of two terms P_i(x) P_j(y).

    - there: mask of the points with heights (rows, columns); None for all
    - along_x, along_y: Legendre polynomials P at all columns (columns, order + 1) and rows (rows, order + 1)
    - terms: list of (i, j)
    """
    n = along_x.shape[1]
    pairs_x = (along_x[:, :, None] * along_x[:, None, :]).reshape(-1, n * n)
    pairs_y = (along_y[:, :, None] * along_y[:, None, :]).reshape(-1, n * n)
    if there is None:
        sums = np.outer(pairs_y.sum(axis=0), pairs_x.sum(axis=0))
    else:
        sums = pairs_y.T @ np.stack([row @ pairs_x for row in there])
    sums = sums.reshape(n, n, n, n)
    return np.array([[sums[j, q, i, p] for p, q in terms] for i, j in terms])
