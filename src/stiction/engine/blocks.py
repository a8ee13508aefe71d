"""Split large computations into blocks of rows, so that their memory stays bounded."""

from collections.abc import Callable, Iterator

import numpy as np

_TOGETHER = 400_000  # largest number of points in a block; even half of it is enough that loops are compiled (see `tiers`)


def blocks(rows: int, points: int = 1) -> Iterator[slice]:
    """Yield slices of about equal size that together cover all rows of a table.

    points: number of points in each row. A slice holds at most 400,000 points, unless a single row is longer; this row then has
    a slice of its own. With rows = 0 one empty slice is yielded.
    """
    largest = max(1, _TOGETHER // max(points, 1))
    step = -(-rows // max(1, -(-rows // largest)))  # equal blocks, so that all use the same loops, which are chosen by size
    for start in range(0, max(rows, 1), max(step, 1)):
        yield slice(start, min(start + step, rows))


def in_blocks(compute: Callable[[slice], dict[str, np.ndarray]], rows: int, points: int = 1) -> dict[str, np.ndarray]:
    """Call `compute` for each block of rows and join the arrays it returns, name by name, along their first axis.

    compute: takes a slice of the rows and returns a dictionary of arrays. points: number of points in each row, which limits
    the rows of a block as in `blocks`.
    """
    parts = [compute(block) for block in blocks(rows, points)]
    return parts[0] if len(parts) == 1 else {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
