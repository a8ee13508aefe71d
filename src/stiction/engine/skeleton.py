"""Extend sums at a few separations to many, by a matrix that depends on heights and separations alone.

For a law that is a single spike at the displacement w, the sum at h is the density at h + w. As functions of h these are so
much alike that a few separations, the skeleton, tell all others. The matrix is the one that is best for all spikes (least
squares), and so for every law. What loses digits on the way is marked, to be summed at its own separation after all.
"""

import math
from functools import cache, lru_cache
from typing import Any

import numpy as np

from stiction.engine.compiled import kernel, loop
from stiction.engine.heights import Heights

# Numbers of separations in a skeleton; multiples of four, so many terms of the product are taken at a time.
_SKELETONS = (16, 20, 24, 28, 32, 40, 48, 64)
# Separations farther apart than this, over sigma, have no skeleton of 64, and are taken in parts.
_SPAN = 14.0
# The matrix is good to this; far out the density itself is not, whose exponent h^2/2 is rounded.
_RESIDUAL, _ROUNDING = 5e-15, 2.3e-16
# A sum that may have lost more than this (see `carry_over`) is doubtful.
_LOST = 8e-11


def near_each_other(h: np.ndarray) -> list[np.ndarray]:
    """Return the numbers of the separations h (H,), in parts that each span at most _SPAN."""
    if not h.size or np.ptp(h) <= _SPAN:
        return [np.arange(h.size)]
    order = np.argsort(h, kind="stable")
    span = np.ptp(h) / np.ceil(np.ptp(h) / _SPAN)
    parts = np.ceil((h[order] - h[order[0]]) / span)
    return np.split(order, np.flatnonzero(np.diff(np.maximum(parts, 1.0))) + 1)


@lru_cache(maxsize=64)
def skeleton(h_bytes: bytes, w_low: float, w_high: float, heights: Heights) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return few separations, a matrix and a threshold for sums at all separations of h.

    The separations (L,); the matrix that extends sums at them to h, in tiles; and the share (H,) of the size, the sum without
    the density, below which a positive sum may have lost digits. h_bytes: bytes of the array h (H,). w_low, w_high:
    displacements of all spikes. Empty where no such matrix is accurate.
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
        kept = values > 1e-15 * values[0]
        carry = (wanted @ right[kept].T / values[kept]) @ left[:, kept].T
        if np.abs(carry @ known - wanted).max() <= good:
            return few, _tiled((carry / scale).T * largest), good / _LOST * largest
    return np.empty(0), np.empty((0, 0, 0)), largest


def _spike_sums(h: np.ndarray, spikes: np.ndarray, heights: Heights) -> tuple[np.ndarray, np.ndarray]:
    """Density at h + w (H, spikes) over its largest value at each h, and that value (H,)."""
    z = np.add.outer(h, spikes)
    density = np.empty(z.size)
    _densities(heights.density)(z.ravel(), heights.shape, density)
    table = density.reshape(z.shape)
    largest = np.maximum(table.max(axis=1), 1e-300)  # there may be no height in reach
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
    """Return a matrix (L, H) as tiles (tiles, L, width), width a multiple of eight, the last one padded with zeros."""
    tiles = -(-carry.shape[1] // _TILE)
    width = 8 * -(-carry.shape[1] // (8 * tiles))
    padded = np.zeros((len(carry), tiles * width))
    padded[:, : carry.shape[1]] = carry
    return np.ascontiguousarray(padded.reshape(len(carry), tiles, width).transpose(1, 0, 2))


@loop
def _add_four(few, row, at, tile, product):
    """Add four terms of the product of four rows of `few` and a tile.

    `product` has a row every _TILE, a fixed distance: the compiler then sees that rows do not overlap, and vectorises. A loaded
    value of the tile is used for four rows.
    """
    a0, a1, a2, a3 = few[row, at], few[row, at + 1], few[row, at + 2], few[row, at + 3]
    b0, b1, b2, b3 = few[row + 1, at], few[row + 1, at + 1], few[row + 1, at + 2], few[row + 1, at + 3]
    c0, c1, c2, c3 = few[row + 2, at], few[row + 2, at + 1], few[row + 2, at + 2], few[row + 2, at + 3]
    d0, d1, d2, d3 = few[row + 3, at], few[row + 3, at + 1], few[row + 3, at + 2], few[row + 3, at + 3]
    for to in range(8 * (tile.shape[1] // 8)):
        p, q, r, s = tile[at, to], tile[at + 1, to], tile[at + 2, to], tile[at + 3, to]
        product[to] += a0 * p + a1 * q + a2 * r + a3 * s
        product[_TILE + to] += b0 * p + b1 * q + b2 * r + b3 * s
        product[2 * _TILE + to] += c0 * p + c1 * q + c2 * r + c3 * s
        product[3 * _TILE + to] += d0 * p + d1 * q + d2 * r + d3 * s


@loop
def _store(product, sums, size, doubtful_below, doubtful):
    """One row of a product, and which of it is too small against the size."""
    for to in range(sums.size):
        sums[to] = product[to]
        doubtful[to] = doubtful[to] | (product[to] < size * doubtful_below[to])


@kernel
def carry_over(few, tiles, doubtful_below, nodes, signed, sums, doubtful):
    """Fill sums[i, row] = few[i * rows + row] @ matrix, and mark sums that may have lost digits; return whether any has.

    A positive sum is marked if it is too small against its size, the sum without the density. few: (a multiple of four, L);
    nodes: as in `sum_kernels`. signed: the row of the load, which changes sign; it is as accurate as the area. The product is
    a loop of this package, because a threaded library would compete with the threads of callers.
    """
    _, values, used = nodes
    laws, rows, separations = sums.shape
    product, width = np.empty(4 * _TILE), tiles.shape[2]
    doubtful[:laws] = False
    for first in range(0, laws * rows, 4):
        for number in range(len(tiles)):
            product[:] = 0.0
            for at in range(0, few.shape[1], 4):
                _add_four(few, first, at, tiles[number], product)
            start, stop = number * width, min((number + 1) * width, separations)
            for beside in range(min(4, laws * rows - first)):
                i, row = (first + beside) // rows, (first + beside) % rows
                size = -np.inf if row == signed else np.sum(values[i, row, : used[i]])
                part = doubtful[i, start:stop]
                _store(product[beside * _TILE :], sums[i, row, start:stop], size, doubtful_below[start:stop], part)
    return doubtful[:laws].any()
