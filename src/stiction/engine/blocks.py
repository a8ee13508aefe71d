"""Work in blocks, so that memory is bounded whatever the number of contacts and points."""

from collections.abc import Callable, Iterator

import numpy as np

_TOGETHER = 400_000  # pairs of a law and a point that are computed together; half of that is worth compiling loops (tiers)


def blocks(rows: int, points: int = 1) -> Iterator[slice]:
    """Yield slices of rows with so many points each, that together are few enough; one empty slice of no rows."""
    largest = max(1, _TOGETHER // max(points, 1))
    step = -(-rows // max(1, -(-rows // largest)))  # of about one size: the loops that sum a block are chosen by its size
    for start in range(0, max(rows, 1), max(step, 1)):
        yield slice(start, min(start + step, rows))


def in_blocks(compute: Callable[[slice], dict[str, np.ndarray]], rows: int, points: int = 1) -> dict[str, np.ndarray]:
    """Compute tables by name, block by block of their first axis, and join them."""
    parts = [compute(block) for block in blocks(rows, points)]
    return parts[0] if len(parts) == 1 else {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
