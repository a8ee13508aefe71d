"""Replace the missing points of a height map by interpolated heights."""

from collections.abc import Callable

import numpy as np
from scipy import ndimage, sparse
from scipy.sparse.linalg import LinearOperator, cg, splu

from stiction.quantities.errors import InputError, InWords
from stiction.surfaces.heightmap import HeightMap


def fill_missing(surface: HeightMap, way: str = "harmonic") -> HeightMap:
    """Return the map with its missing points replaced by interpolated heights.

    way: "harmonic" makes each missing height the mean of its neighbours, weighted by 1/pitch^2, like a membrane. A
    profile is interpolated linearly. "nearest" copies the height of the nearest known point. Filled regions are smoother than
    the real surface, so slopes and summits are inaccurate if many points are missing. Raises InputError if no height is known,
    `way` is unknown, or the equations of "harmonic" do not converge.
    """
    if not isinstance(way, str) or way not in FILLS:
        raise InputError("fill", way, " or ".join(FILLS))
    missing = np.isnan(surface.heights)
    count = int(np.count_nonzero(missing))
    if count == missing.size:
        raise InputError("scan", InWords(f"all {count} points missing"), "a scan with heights")
    if count == 0:
        return surface.with_heights(surface.heights, "no missing points to fill")
    return surface.with_heights(FILLS[way](surface.heights, missing, surface.pitch), f"{count} missing points filled: {way}")


def _nearest(heights: np.ndarray, missing: np.ndarray, pitch: tuple[float, float]) -> np.ndarray:
    place = ndimage.distance_transform_edt(missing, sampling=pitch, return_distances=False, return_indices=True)
    return heights[tuple(place)]


def _harmonic(heights: np.ndarray, missing: np.ndarray, pitch: tuple[float, float]) -> np.ndarray:
    """Return the heights with the missing ones replaced by the solution of Laplace's equation (conjugate gradients).

    heights: (rows, columns) [m], NaN where missing. missing: mask of the missing points. pitch: (dy, dx) [m]. There is one
    equation per missing point; a point at the edge of the map has fewer neighbours. A profile is interpolated linearly.
    Raises InputError if the conjugate gradients do not converge.
    """
    if heights.shape[0] == 1:
        place = np.arange(heights.shape[1])
        return np.interp(place, place[~missing[0]], heights[~missing])[None, :]
    mean = float(np.nanmean(heights))
    filled = heights - mean
    matrix, known = _laplace(filled, missing, pitch)
    within = _RESIDUAL * float(np.linalg.norm(known))
    solved, left = cg(matrix, known, rtol=0.0, atol=within, M=_multigrid(matrix, *np.nonzero(missing)), maxiter=5000)
    if left:
        raise InputError("scan", InWords(f"{len(known)} points missing"), 'fewer missing points, or fill = "nearest"')
    filled[missing] = solved
    filled += mean
    return filled


_RESIDUAL = 1e-9  # largest residual of the equations, relative to the heights at the rims of the holes
_DAMPED = 0.7  # damping factor of the relaxation on each level
_FEW = 1000  # points for which the equations are solved directly


def _multigrid(matrix: sparse.csr_array, row: np.ndarray, column: np.ndarray) -> LinearOperator:
    """Return an approximate inverse of the matrix of Laplace's equation, computed by one multigrid cycle.

    matrix: equations of the missing points (n, n). row, column (n,): indices of each missing point in the map. The inverse is
    the preconditioner of the conjugate gradients; it keeps the number of iterations small, however wide the holes are. Each
    block of two by two points forms one point of the next coarser grid. Neighbouring blocks are joined by two links, hence the
    factor 0.5 for the coarse matrix.
    """
    levels = []
    size = matrix.shape
    while matrix.shape[0] > _FEW:
        row, column = row // 2, column // 2
        _, first, group = np.unique(row * (column.max() + 1) + column, return_index=True, return_inverse=True)
        each = np.arange(len(group) + 1, dtype=np.int32)
        into = sparse.csr_array((np.ones(len(group)), group.astype(np.int32), each), shape=(len(group), len(first)))
        levels.append((matrix, _DAMPED / matrix.diagonal(), into))
        matrix = 0.5 * (into.T @ matrix @ into)
        row, column = row[first], column[first]
    directly = splu(matrix.tocsc()).solve

    def relaxed(right: np.ndarray, level: int = 0) -> np.ndarray:
        if level == len(levels):
            return directly(right)
        matrix, step, into = levels[level]
        solution = step * right
        solution += into @ relaxed(into.T @ (right - matrix @ solution), level + 1)
        solution += step * (right - matrix @ solution)
        return solution

    return LinearOperator(size, matvec=relaxed, dtype=float)


def _laplace(heights: np.ndarray, missing: np.ndarray, pitch: tuple[float, float]) -> tuple[sparse.csr_array, np.ndarray]:
    """Return the matrix (n, n) and the right side (n,) of the equations for the n missing heights.

    heights: (rows, columns) [m]. missing: mask of the missing points. pitch: (dy, dx) [m]. Each missing height is the mean of
    its neighbours, weighted by 1/pitch^2 along the direction to the neighbour.
    """
    dy, dx = pitch
    number = np.full(missing.shape, -1, dtype=np.int32)
    number[missing] = np.arange(np.count_nonzero(missing), dtype=np.int32)
    total, known = np.zeros(np.count_nonzero(missing)), np.zeros(np.count_nonzero(missing))
    links = []
    for axis, weight in enumerate(((dx / dy), (dy / dx))):
        low, high = _neighbours(axis)
        for here, there in ((low, high), (high, low)):
            at = missing[here]
            own, other = number[here][at], number[there][at]
            total[own] += weight
            known[own[other < 0]] += weight * heights[there][at][other < 0]
            links.append((own[other >= 0], other[other >= 0], np.full(np.count_nonzero(other >= 0), -weight)))
    own, other, value = (np.concatenate(parts) for parts in zip(*links, strict=True))
    del links  # they take as much memory as the matrix
    matrix = sparse.csr_array((value, (own, other)), shape=(len(total), len(total))) + sparse.diags_array(total)
    return matrix.tocsr(), known


def _neighbours(axis: int) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """Return two pairs of slices (rows, columns) of a map: all points but the last, and all but the first, along an axis.

    Points at the same position in both parts of the map are neighbours. axis: 0 along y, 1 along x.
    """
    everything = slice(None)
    low, high = slice(None, -1), slice(1, None)
    return ((low, everything), (high, everything)) if axis == 0 else ((everything, low), (everything, high))


FILLS: dict[str, Callable[[np.ndarray, np.ndarray, tuple[float, float]], np.ndarray]] = {
    "harmonic": _harmonic,
    "nearest": _nearest,
}
