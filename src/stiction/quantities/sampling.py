"""Compute quasi-random points that fill the unit cube evenly, and row numbers evenly spaced within a table.

The points are computed by scipy.stats, which takes half a second to import. They are cached on disk, so that only the first
study with a given number of points and dimensions needs this import.
"""

import zipfile

import numpy as np

from stiction.quantities.cache import cache_folder, keep_file

_MOST = 20_000_000  # largest size of all stored points, in bytes


def spread_rows(count: int, most: int) -> np.ndarray:
    """Return at most `most` row numbers (k,) in ascending order, evenly spaced from the first to the last of `count` rows."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def sobol_points(columns: int, count: int, seed: int | np.random.SeedSequence) -> np.ndarray:
    """Return points of a scrambled Sobol sequence in the unit cube.

    Parameters
    ----------
    columns : int
        Number of dimensions.
    count : int
        Number of points; a power of two keeps the points balanced.
    seed : int or numpy.random.SeedSequence
        Seed of the scrambling: the same seed gives the same points.

    Returns
    -------
    numpy.ndarray, shape (count, columns)
        Coordinates of the points, 0 to 1.

    Notes
    -----
    The scrambling follows Owen (1998), J. Complexity 14, 466.
    """
    key = f"{seed.entropy}_{'_'.join(map(str, seed.spawn_key))}" if isinstance(seed, np.random.SeedSequence) else seed
    path = cache_folder("points") / f"sobol-{columns}-{count}-{key}.npz"
    try:
        with np.load(path, allow_pickle=False) as file:  # the archive has a checksum, so that damage is noticed
            points = file["points"]
        if points.shape == (count, columns):
            return points
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        pass  # not stored yet, or damaged
    from scipy.stats import qmc  # slow to import

    points = qmc.Sobol(columns, rng=np.random.default_rng(seed)).random(count)
    keep_file(path, lambda file: np.savez(file, points=points), _MOST)
    return points
