"""Extend sums at a few separations to many separations, by a matrix that depends only on the heights and the separations.

For a law that is a single spike at the displacement w, the sum at the separation h is the height density at h + w. These
functions of h are so similar that their values at a few separations (the skeleton) determine all others. The matrix is fitted
by least squares to spikes at 300 displacements, and therefore serves every law. Sums that may have lost digits in the product
are marked, and are then computed directly.
"""

import math
from functools import cache, lru_cache
from typing import Any

import numpy as np

from stiction.engine.compiled import kernel, loop
from stiction.engine.heights import Heights

# Numbers of separations in a skeleton; multiples of four, because the product adds four terms at a time.
_SKELETONS = (16, 20, 24, 28, 32, 40, 48, 64)
# Separations over a wider range, in units of sigma, would need more than 64 in the skeleton, and are divided into groups.
_SPAN = 14.0
# Largest error of the matrix. It grows with h^2, because the exponent h^2/2 of the density itself is rounded.
_RESIDUAL, _ROUNDING = 5e-15, 2.3e-16
# A sum whose relative error may exceed this (see `carry_over`) is marked.
_LOST = 8e-11


def near_each_other(h: np.ndarray) -> list[np.ndarray]:
    """Divide the separations h (H,) into groups; return the indices of each group.

    h is in units of sigma, the standard deviation of the heights. Each group spans at most 14 sigma.
    """
    if not h.size or np.ptp(h) <= _SPAN:
        return [np.arange(h.size)]
    order = np.argsort(h, kind="stable")
    span = np.ptp(h) / np.ceil(np.ptp(h) / _SPAN)
    parts = np.ceil((h[order] - h[order[0]]) / span)
    return np.split(order, np.flatnonzero(np.diff(np.maximum(parts, 1.0))) + 1)


@lru_cache(maxsize=64)
def skeleton(h_bytes: bytes, w_low: float, w_high: float, heights: Heights) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a few separations, the matrix that extends sums at these to the separations h, and a threshold of its accuracy.

    h_bytes: bytes of the array h (H,), separations in units of sigma. w_low, w_high: range of the displacements in units of
    sigma. heights: distribution of the heights.

    Returns the few separations (L,), the matrix (L, H) cut into tiles, and a threshold (H,). A positive sum may have lost
    digits if it is below threshold times size, where size is the same sum with the height density left out. The first two
    arrays are empty if no matrix is accurate enough.
    """
    h = np.frombuffer(h_bytes)
    spikes = w_low + (w_high - w_low) * (1.0 - np.cos(np.linspace(0.0, math.pi, 300))) / 2.0
    wanted, largest = _spike_sums(h, spikes, heights)
    middle, half = (h.max() + h.min()) / 2.0, np.ptp(h) / 2.0
    good = max(_RESIDUAL, _ROUNDING * max(h.max() + w_low, 0.0) ** 2)
    for count in _SKELETONS:
        angle = (np.arange(count) + 0.5) * math.pi / count
        few = middle + half * np.cos(angle) / np.cos(angle[0])  # Chebyshev's points, stretched to both ends
        known, scale = _spike_sums(few, spikes, heights)
        left, values, right = np.linalg.svd(known, full_matrices=False)
        significant = values > 1e-15 * values[0]
        carry = (wanted @ right[significant].T / values[significant]) @ left[:, significant].T
        if np.abs(carry @ known - wanted).max() <= good:
            return few, _tiled((carry / scale).T * largest), good / _LOST * largest
    return np.empty(0), np.empty((0, 0, 0)), largest


def _spike_sums(h: np.ndarray, spikes: np.ndarray, heights: Heights) -> tuple[np.ndarray, np.ndarray]:
    """Return the height density at h + w for each spike w, divided by its maximum at each h, and this maximum.

    h (H,), spikes: separations and displacements in units of sigma. The returned shapes are (H, spikes) and (H,). A spike is a
    law whose value is concentrated at a single displacement.
    """
    z = np.add.outer(h, spikes)
    density = np.empty(z.size)
    _densities(heights.density)(z.ravel(), heights.shape, density)
    table = density.reshape(z.shape)
    largest = np.maximum(table.max(axis=1), 1e-300)  # the density may be 0 at all spikes
    return table / largest[:, None], largest


@cache
def _densities(density: Any) -> Any:
    @kernel
    def fill_density(z, shape, out):
        for i in range(z.size):
            out[i] = density(z[i], shape)

    return fill_density


# The matrix is cut into tiles of columns, none wider than this.
_TILE = 128


def _tiled(carry: np.ndarray) -> np.ndarray:
    """Return a matrix (L, H) cut into tiles of columns, as an array (tiles, L, width).

    width is at most 128 and a multiple of eight; the last tile is padded with zeros.
    """
    tiles = -(-carry.shape[1] // _TILE)
    width = 8 * -(-carry.shape[1] // (8 * tiles))
    padded = np.zeros((len(carry), tiles * width))
    padded[:, : carry.shape[1]] = carry
    return np.ascontiguousarray(padded.reshape(len(carry), tiles, width).transpose(1, 0, 2))


@loop
def _add_four(few, row, column, tile, product):
    """Add four terms of the matrix product of four rows of `few` and one tile to `product`.

    few: (rows, L), left factor. row: index of the first of the four rows. column: index of the first of the four terms. tile
    (L, width): columns of the right factor. In `product`, rows begin 128 elements apart. With this fixed distance the compiler
    can prove that the rows do not overlap, and vectorises the loop. Each value of the tile is loaded once for the four rows.
    """
    a0, a1, a2, a3 = few[row, column], few[row, column + 1], few[row, column + 2], few[row, column + 3]
    b0, b1, b2, b3 = few[row + 1, column], few[row + 1, column + 1], few[row + 1, column + 2], few[row + 1, column + 3]
    c0, c1, c2, c3 = few[row + 2, column], few[row + 2, column + 1], few[row + 2, column + 2], few[row + 2, column + 3]
    d0, d1, d2, d3 = few[row + 3, column], few[row + 3, column + 1], few[row + 3, column + 2], few[row + 3, column + 3]
    for to in range(8 * (tile.shape[1] // 8)):
        p, q, r, s = tile[column, to], tile[column + 1, to], tile[column + 2, to], tile[column + 3, to]
        product[to] += a0 * p + a1 * q + a2 * r + a3 * s
        product[_TILE + to] += b0 * p + b1 * q + b2 * r + b3 * s
        product[2 * _TILE + to] += c0 * p + c1 * q + c2 * r + c3 * s
        product[3 * _TILE + to] += d0 * p + d1 * q + d2 * r + d3 * s


@loop
def _store(product, sums, size, threshold, inaccurate):
    """Copy one row of the matrix product to `sums`, and mark inaccurate sums as True in `inaccurate`.

    A sum is marked if it is below threshold times size (the same sum without the height density), because cancellation may
    then have cost digits of the product.
    """
    for to in range(sums.size):
        sums[to] = product[to]
        inaccurate[to] = inaccurate[to] | (product[to] < size * threshold[to])


@kernel
def carry_over(few, tiles, threshold, nodes, signed, sums, inaccurate):
    """Extend sums at a few separations to many by a matrix, mark inaccurate sums, and return whether any is inaccurate.

    few (rows of all laws, rounded up to a multiple of four, L): sums at the L separations of the skeleton. tiles: the matrix
    (L, H), cut into tiles by `skeleton`. sums (n, rows, H): filled with the product. inaccurate (n, H): set to True where
    cancellation may have cost digits: a sum of positive terms is below threshold (H,) times its size, the same sum without
    the height density. nodes: (displacements, weights times values, numbers of nodes) from which `few` was summed. signed:
    index of the row that holds the load; it changes sign and is not checked, because it is as accurate as the area. The product
    is written as a loop here, because a threaded library would compete with the threads of the caller.
    """
    _, values, used = nodes
    laws, rows, separations = sums.shape
    product, width = np.empty(4 * _TILE), tiles.shape[2]
    inaccurate[:laws] = False
    for first in range(0, laws * rows, 4):
        for number in range(len(tiles)):
            product[:] = 0.0
            for column in range(0, few.shape[1], 4):
                _add_four(few, first, column, tiles[number], product)
            start, stop = number * width, min((number + 1) * width, separations)
            for beside in range(min(4, laws * rows - first)):
                i, row = (first + beside) // rows, (first + beside) % rows
                size = -np.inf if row == signed else np.sum(values[i, row, : used[i]])
                part = inaccurate[i, start:stop]
                _store(product[beside * _TILE :], sums[i, row, start:stop], size, threshold[start:stop], part)
    return inaccurate[:laws].any()
