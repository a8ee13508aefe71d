"""Interpolate the response curves of a film on one body from a table that is valid for all materials.

The table makes sweeps over thousands of material pairs fast. Running `python -m stiction.solvers.layered.table` (two minutes)
computes it from exact solutions and writes `curves.npz`. It has three coordinates: ln r / ln 200, where r is the ratio of
moduli; the excess of `compliance.Layer`; and v = sqrt(r) W/(1 - W + sqrt(r) W), where W is the film's share of the compliance.
v is 0 if the film has no effect and 1 for a rigid counterbody. The curves (see `curves`) are Chebyshev series in these
coordinates. E_P, D and E_S are within 0.4 % of exact solutions, and B within 0.8 %. Pairs with a ratio r outside 1/200 to 200
are solved one by one.
"""

from functools import cache
from importlib import resources

import numpy as np
from numpy.polynomial import chebyshev

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.compliance import Layer, Pair
from stiction.solvers.layered.curves import CURVES, POWERS, TERMS, curves, curves_of_pairs

_RANGE = float(np.log(200.0))
_SIZES = 13, 13, 9
# Number of independent curves whose sums give all others to 2e-4.
_MODES = 24
_FILE = "curves.npz"


@on_one_thread
def curves_of_films(share: np.ndarray, ratio: np.ndarray, excess: np.ndarray) -> np.ndarray:
    """Return the response curves of n films, each on one body, as coefficients (n, CURVES, TERMS) of `curves`.

    share, ratio, excess (n,): compliance of the film material divided by the sum of the compliances of both surface materials,
    ratio of the moduli of film and body below, and 4 beta - alpha with Dundurs' parameters, as in `compliance.Layer`.
    """
    places = np.stack([np.log(ratio) / _RANGE, excess, 2.0 * _together(share, ratio) - 1.0], axis=1)
    tabled = np.abs(places[:, 0]) <= 1.0
    out = np.empty((len(places), CURVES, TERMS))
    if tabled.any():
        out[tabled] = _interpolated(places[tabled])
    out[~tabled] = curves_of_pairs([(Layer(*film),) for film in np.stack([share, ratio, excess], axis=1)[~tabled].tolist()])
    return out


def _together(share, ratio):
    """Return the table coordinate v = sqrt(r) W/(1 - W + sqrt(r) W), for arrays or numbers.

    share: the film's fraction W of the compliance. ratio: ratio r of the moduli of film and body below.
    """
    root = np.sqrt(ratio)
    return root * share / (1.0 - share + root * share)


def _interpolated(places: np.ndarray) -> np.ndarray:
    """Interpolate the coefficients (n, CURVES, TERMS) of the response curves at table coordinates (n, 3), -1 to 1."""
    table, modes = _table()
    first, second, third = (chebyshev.chebvander(column, size - 1) for column, size in zip(places.T, _SIZES, strict=True))
    product = (first[:, :, None] * second[:, None, :]).reshape(len(places), -1)
    if len(places) > 1 and np.ptp(places[:, 2]) == 0.0:  # typical of sweeps against a rigid counterbody; this saves time
        weights = product @ np.tensordot(third[0], table, axes=(0, 2)).reshape(-1, _MODES)
    else:
        weights = np.einsum("nk,nkm->nm", third, (product @ table.reshape(product.shape[1], -1)).reshape(-1, _SIZES[2], _MODES))
    return (weights @ modes).reshape(-1, CURVES, TERMS)


@cache
def _table() -> tuple[np.ndarray, np.ndarray]:
    """Return (weights, modes): a weighted sum of the modes gives the response curves of any film.

    weights (*_SIZES, _MODES): weight of each mode, as a Chebyshev series in the three table coordinates. modes (_MODES, CURVES
    * TERMS): curves as coefficients of powers of their variable z. The file `_FILE` stores modes as Chebyshev coefficients in
    z.
    """
    with resources.files("stiction.solvers.layered").joinpath(_FILE).open("rb") as file:
        data = np.load(file)
        table, modes = data["table"].astype(float), data["modes"].astype(float)
    return table, (modes.reshape(-1, CURVES, TERMS) @ POWERS).reshape(-1, CURVES * TERMS)


def _pair(place: tuple[float, float, float]) -> Pair:
    """Return the pair of bodies at a point of the table, given by its three coordinates, each -1 to 1."""
    ratio, v = float(np.exp(place[0] * _RANGE)), (place[2] + 1.0) / 2.0
    share = v / (v + np.sqrt(ratio) * (1.0 - v))
    return (Layer(float(share), ratio, float(place[1])),)


def make() -> tuple[np.ndarray, np.ndarray]:
    """Compute the table and its modes from exact solutions; return both.

    The modes (_MODES, CURVES * TERMS) are the principal sets of curves, from a singular value decomposition. The table
    (*_SIZES, _MODES) holds the weight of each mode, as a Chebyshev series in the three coordinates. The solutions are at the
    Chebyshev extreme points of the three coordinates.
    """
    points = [-np.cos(np.pi * np.arange(size) / (size - 1)) for size in _SIZES]
    solved = np.zeros((*_SIZES, CURVES * TERMS))
    to_chebyshev = np.linalg.inv(POWERS)
    for at in np.ndindex(*_SIZES):
        if at[2]:  # at the first value of v the film has no effect and all coefficients are 0
            place = tuple(column[i] for column, i in zip(points, at, strict=True))
            solved[at] = (curves(_pair(place)) @ to_chebyshev).ravel()
    for axis, column in enumerate(points):
        series = np.linalg.inv(chebyshev.chebvander(column, len(column) - 1))
        solved = np.moveaxis(np.tensordot(series, solved, axes=(1, axis)), 0, axis)
    left, size, modes = np.linalg.svd(solved.reshape(-1, CURVES * TERMS), full_matrices=False)
    return (left * size)[:, :_MODES].reshape(*_SIZES, _MODES), modes[:_MODES]


if __name__ == "__main__":
    with resources.as_file(resources.files("stiction.solvers.layered")) as folder:
        table, modes = make()
        np.savez_compressed(folder / _FILE, table=table.astype(np.float32), modes=modes.astype(np.float32))
