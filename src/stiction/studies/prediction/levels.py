"""Draw the quantile levels of all random inputs of a prediction.

The random inputs form parts (interface, area model, chance, ...), which are sampled together. To find the variance due to one
part, only the levels of this part are exchanged between samples.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from stiction.quantities.sampling import sobol_points

# Columns of levels of each part of the random inputs. The part "inputs" has the columns of the uncertain numbers of the case.
COLUMNS: Mapping[str, tuple[str, ...]] = {
    "inputs": (),
    "interface": ("state", "strength", "coefficient"),
    "area model": ("area_model", "area_error"),
    "adhesion": ("pull_model", "pull_error"),
    "junctions": ("growth",),
    "squeezed film": ("confinement",),
    "chance": ("chance",),
    "sliding": ("spots",),
}
PARTS = tuple(COLUMNS)
_APART = "spots"  # not part of the Sobol sequence: few contacts need this column, and a further column would change all others


@dataclass(frozen=True)
class Levels:
    """Store quantile levels, 0 to 1, of n samples.

    inputs: (n, k), one column for each of the k sample dimensions of the case. others: one column (n,) for each further random
    number, by the column names listed in COLUMNS.
    """

    inputs: np.ndarray
    others: Mapping[str, np.ndarray]

    def __len__(self) -> int:
        return len(self.inputs)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.others[name]

    def exchanged(self, parts: Sequence[str], rows: np.ndarray, moved: np.ndarray) -> "tuple[Levels, np.ndarray]":
        """Return levels in which one part after the other comes from other samples, and the rows of the inputs of each sample.

        parts: keys of COLUMNS, one for each block of samples in the result. rows: indices of the samples from which a block
        takes all other columns. moved: indices of the samples from which it takes the columns of its part. The part "inputs"
        has no such columns: for it, the returned rows are `moved`.
        """
        others = {
            name: np.concatenate([column[moved if name in COLUMNS[part] else rows] for part in parts])
            for name, column in self.others.items()
        }
        inputs = np.concatenate([moved if part == "inputs" else rows for part in parts])
        return Levels(self.inputs[inputs], others), inputs


def draw_levels(inputs: int, count: int, seed: int) -> Levels:
    """Return the quantile levels of `count` samples, from one scrambled Sobol sequence.

    Parameters
    ----------
    inputs : int
        Number of sample dimensions of the case: its uncertain numbers, but numbers that are sampled together count once.
    count : int
        Number of samples, a power of two.
    seed : int
        Seed of the scrambling.

    Notes
    -----
    Owen scrambling (Owen 1997) makes the points uniform. The same seed gives the same samples. The column "spots" of COLUMNS is
    not part of the sequence: its levels are evenly spaced, in random order.
    """
    names = [name for columns in COLUMNS.values() for name in columns if name != _APART]
    points = sobol_points(inputs + len(names), count, seed)
    points = np.clip(points, 1e-9, 1.0 - 1e-9)  # quantiles at 0 and 1 are infinite
    # Inputs come last, so that the levels of all other parts do not change with the number of uncertain inputs.
    others = dict(zip(names, points[:, : len(names)].T, strict=True))
    others[_APART] = (np.random.default_rng(seed).permutation(count) + 0.5) / count
    return Levels(points[:, len(names) :], others)
