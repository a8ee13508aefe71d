"""Where a small change of the load changes the recommended model, and friction with it."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

__all__ = ["leap_near"]

_MU = "friction_coefficient_at_load"
# Factors of the load at which the recommendation is asked again, and by how much friction may differ between two models there.
_NEAR, _SAME = (0.5, 2.0), 1.2


def leap_near(data: "xarray.Dataset", ask: Callable[[float], "xarray.Dataset"], show: Callable[[float], str]) -> str:
    """Say between which values mu leaps where another model is recommended near the working load; "" where it does not.

    data: a comparison at a working load. ask: the same comparison at another load. show: a load in words. A leap is told from a
    slope: it is what the two models say at the other load.
    """
    here = data.attrs.get("recommended", "none")
    if here == "none" or bool(data["solved"].sel(model=here)):
        return ""
    leaps = []
    for factor in _NEAR:
        load = factor * float(data.attrs["working_load"])
        other = ask(load)
        there = other.attrs["recommended"]
        if there in ("none", here) or here not in other["model"]:
            continue
        ends = [float(other[_MU].sel(model=name)) for name in (here, there)]
        size = abs(np.log(ends[1] / ends[0]))
        if size > np.log(_SAME):
            leaps.append((size, *ends, show(load), there))
    if not leaps:
        return ""
    _, mu, to, at, there = max(leaps)
    return f"the recommended model changes near this load: mu leaps from {mu:.3g} to {to:.3g} at {at} ({there})"
