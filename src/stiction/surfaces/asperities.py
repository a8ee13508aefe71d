"""Asperities of a measured surface by five methods: sigma, R and N differ with the method as much as with the resolution.

A new method is one function of a HeightMap, in a file of its own, and a line in METHODS.
"""

from collections.abc import Callable

import numpy as np

from stiction.quantities.errors import InputError
from stiction.surfaces.areal_asperities import eight_neighbour, persistence
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.gaussian_asperities import combine, mccool
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.profile_asperities import n_point, three_point

__all__ = ["AREAL", "METHODS", "Asperities", "asperities", "combine", "methods_for"]

METHODS: dict[str, Callable[..., Asperities]] = {
    "three_point": three_point,
    "eight_neighbour": eight_neighbour,
    "persistence": persistence,
    "n_point": n_point,
    "mccool": mccool,
}
# Those that need a map, not a profile.
AREAL = ("eight_neighbour", "persistence")


def asperities(surface: HeightMap, method: str = "mccool", **options) -> Asperities:
    """The asperities of a surface by one method.

    method: a key of METHODS. options: those of its function. The map is to be levelled and filtered before: heights are counted
    from their mean. Raises InputError for a method, option or map that will not do, or if nothing is found.
    """
    if method not in METHODS:
        raise InputError("method", method, ", ".join(METHODS))
    if not np.isfinite(surface.heights).any():
        raise InputError("heights", "all points missing", "a map with heights")
    function = METHODS[method]
    known = function.__code__.co_varnames[1 : function.__code__.co_argcount]
    for option in options:
        if option not in known:
            raise InputError(option, options[option], f"of method {method}: {', '.join(known) or 'no option'}")
    return function(surface, **options)


def methods_for(surface: HeightMap) -> tuple[str, ...]:
    """The methods that a map, or a profile, can be given to."""
    return tuple(key for key in METHODS if not (surface.is_profile and key in AREAL))
