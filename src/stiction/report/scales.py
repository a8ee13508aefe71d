"""Decide which axes are logarithmic, on the page and in pictures, and where their ticks are."""

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOG = " (log)"  # ends the label of a logarithmic axis of friction
_WIDE = 5.0  # ratio of the largest to the smallest value, above which an axis is logarithmic
FEW_DECADES = 200.0  # ratio of the ends of a logarithmic axis, below which 2 and 5 times the powers of ten have ticks too


def log_ticks(low: float, high: float) -> list[float]:
    """Return round numbers for the ticks of a logarithmic axis; the first and the last enclose the range `low` to `high`.

    They are 1, 2 and 5 times powers of ten, or powers of ten alone on an axis of many decades.

    >>> log_ticks(0.04, 0.3)
    [0.02, 0.05, 0.1, 0.2, 0.5]
    """
    steps = (1, 2, 5) if high < FEW_DECADES * low else (1,)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [float(f"{step}e{power}") for power in powers for step in steps]
    first = max((tick for tick in ticks if tick <= low), default=ticks[0])
    last = min((tick for tick in ticks if tick >= high), default=ticks[-1])
    return [tick for tick in ticks if first <= tick <= last]


def is_log(values: np.ndarray) -> bool:
    """Return whether an axis that shows these values is logarithmic: all are positive, and they differ more than 5-fold."""
    known = np.asarray(values, dtype=float)
    known = known[np.isfinite(known)]
    return bool(known.size and known.min() > 0.0 and known.max() > _WIDE * known.min())


def scale_friction(axes: "Axes", values: np.ndarray, which: str = "y") -> None:
    """Make a friction axis logarithmic if `is_log` holds for the values, and append "(log)" to its label; else start it at 0.

    values: friction coefficients that the axis shows. which: "x" or "y". An axis that is already logarithmic is left unchanged.
    """
    text = getattr(axes, f"get_{which}label")().removesuffix(LOG)
    if getattr(axes, f"get_{which}scale")() == "log" or is_log(values):
        getattr(axes, f"set_{which}scale")("log")
        text += LOG
    else:
        getattr(axes, f"set_{which}lim")(0.0, 1.08 * values.max())  # some room above a constant friction
    getattr(axes, f"set_{which}label")(text)
