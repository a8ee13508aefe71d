"""Asperities of a measured surface: sigma, R and N differ with the method of finding them as much as with the resolution.

A method is a file in `asperity_method`, or an entry point of another package, with a record of the kind AsperityMethod.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import AsperityMethod, Parameter, find, of_kind
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.heightmap import HeightMap, in_metres


def methods() -> dict[str, AsperityMethod]:
    """All ways of finding asperities, key -> record, in the order in which they are shown."""
    known = of_kind(AsperityMethod)
    return dict(sorted(known.items(), key=lambda one: (one[1].order, one[0])))


def methods_for(surface: HeightMap) -> tuple[str, ...]:
    """The methods that a map, or a profile, can be given to."""
    return tuple(key for key, one in methods().items() if one.of_profiles or not surface.is_profile)


def method_of_moments() -> str:
    """The method that looks for no asperities and keeps the moments exactly: what theories of the whole surface take."""
    return next(key for key, one in methods().items() if one.of_moments)


def asperities(surface: HeightMap, method: str = "mccool", **options) -> Asperities:
    """The asperities of a surface by one method.

    method: key of a way of finding asperities, as `st.models()` lists them. options: its own, None for the default; lengths in
    metres or as text with a unit. The map is to be levelled and filtered before: heights are counted from their mean. Raises
    InputError for a method, option or map that will not do, or if nothing is found.
    """
    record = find(str(method), AsperityMethod)
    if not np.isfinite(surface.heights).any():
        raise InputError("heights", "all points missing", "a map with heights")
    if surface.is_profile and not record.of_profiles:
        shape = f"shape {surface.heights.shape}"
        raise InputError("heights", shape, "a map of 3 or more rows and columns: a profile has no summits")
    found = record.find(surface, **_settled(record, options))
    return replace(found, note="; ".join([found.note, *_outside(record, found)]))


# What a range of validity of a method may speak of: a quantity of the asperities found.
SPOKEN_OF: dict[str, Callable[[Asperities], float]] = {
    "asperity_height_deviation": lambda found: found.deviation,
    "asperity_radius": lambda found: found.radius,
    "asperity_density": lambda found: found.density,
    "roughness_parameter": lambda found: found.density * found.radius * found.deviation,
}


def _outside(record: AsperityMethod, found: Asperities) -> list[str]:
    """The ranges of validity that what was found leaves, in words."""
    values = {rule: SPOKEN_OF[rule.quantity](found) for rule in record.validity}
    return [
        f"{QUANTITIES[rule.quantity].meaning} is {value:.3g}, claimed is {rule.range}: {rule.why}"
        for rule, value in values.items()
        if not rule.low <= value <= rule.high
    ]


def _settled(record: AsperityMethod, given: Mapping[str, Any]) -> dict[str, Any]:
    """Every option of a method, the default where None or nothing is given; InputError for any other, or a bad value."""
    for name in given:
        if name not in record.parameters:
            known = ", ".join(record.parameters) or "no option"
            raise InputError(name, given[name], f"of method {record.key}: {known}")
    return {
        name: option.default if given.get(name) is None else _checked(name, option, given[name])
        for name, option in record.parameters.items()
    }


def _checked(name: str, option: Parameter, value: Any) -> Any:
    """A value of an option, a length in metres."""
    if option.unit and not option.values and not isinstance(value, bool):
        value = in_metres(value, name)
    if isinstance(value, bool) or not option.allows(value):
        raise InputError(name, value, option.allowed)
    return value
