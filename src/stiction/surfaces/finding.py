"""Find the asperities of a measured surface by a selected method, and compute sigma, R and N from them.

sigma is the standard deviation of the asperity heights, R the tip radius and N the number per area. They depend strongly on
the method and on the point spacing of the map. Each method is a record of the class AsperityMethod, in a file of
`asperity_method` or in another package, which registers it through an entry point.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError, InWords
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import AsperityMethod, Parameter, find, of_kind
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.heightmap import HeightMap, in_metres
from stiction.surfaces.held import as_height_map

if TYPE_CHECKING:
    from stiction.quantities.arguments import QuantityLike


def methods() -> dict[str, AsperityMethod]:
    """Return the record of every method that finds asperities, by key, in display order."""
    known = of_kind(AsperityMethod)
    return dict(sorted(known.items(), key=lambda one: (one[1].order, one[0])))


def methods_for(surface: HeightMap) -> tuple[str, ...]:
    """Return the keys of the asperity methods that accept this surface, a map or a profile."""
    return tuple(key for key, one in methods().items() if one.of_profiles or not surface.is_profile)


def method_of_moments() -> str:
    """Return the key of the asperity method that computes spectral moments instead of searching for single summits.

    Theories that describe the surface by its spectral moments use this method.
    """
    return next(key for key, one in methods().items() if one.of_moments)


def length_unit(surface: HeightMap, roughness_parameter: Any) -> Any:
    """Return sqrt(R sigma) [m], the unit of length along the surface, for contacts with this map.

    roughness_parameter: the dimensionless N R sigma of the contact, a number or an array. It is divided by the asperity density
    N from the spectral moments of the map, which gives R sigma.
    """
    return np.sqrt(roughness_parameter / asperities(surface, method_of_moments()).density)


def asperities(surface: HeightMap, method: str = "mccool", **options: "QuantityLike | None") -> Asperities:
    """Find the asperities of a surface by one method.

    Parameters
    ----------
    surface : HeightMap
        Heights (rows, columns) [m]. Level and filter the map first. Heights are measured from their mean.
    method : str
        Key of a method that finds asperities, as `st.models()` lists them.
    **options : float, int, str or None
        Options of that method. None selects the default. Lengths are in metres, or text with a unit.

    Returns
    -------
    Asperities
        Standard deviation sigma of the heights [m], radius R [m] and density N [1/m^2]. Heights and radii (n,) [m] of
        the single asperities are included if the method finds them.

    Raises
    ------
    InputError
        The method is unknown, an option or the map does not suit the method, or fewer than two asperities are found.

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="400 nm", deviation="10 nm")
    >>> surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
    >>> print(f"{st.asperities(surface).radius:.1e} m")
    3.1e-06 m
    """
    surface, record = as_height_map(surface), find(str(method), AsperityMethod)
    if not np.isfinite(surface.heights).any():
        raise InputError("heights", InWords("all points missing"), "a map with heights")
    if surface.is_profile and not record.of_profiles:
        shape = InWords(f"shape {surface.heights.shape}")
        raise InputError("heights", shape, "a map of 3 or more rows and columns: a profile has no summits")
    found = record.find(surface, **_settled(record, options))
    return replace(found, note="; ".join([found.note, *_outside(record, found)]))


# Quantities of the asperities found for which a method may claim a validity range: name -> function that returns the value.
CHECKED_QUANTITIES: dict[str, Callable[[Asperities], float]] = {
    "asperity_height_deviation": lambda found: found.deviation,
    "asperity_radius": lambda found: found.radius,
    "asperity_density": lambda found: found.density,
    "roughness_parameter": lambda found: found.density * found.radius * found.deviation,
}


def _outside(record: AsperityMethod, found: Asperities) -> list[str]:
    """Return one warning sentence for each validity range of an asperity method that is violated.

    record: the method. found: the asperities that it found, whose properties are checked.
    """
    values = {rule: CHECKED_QUANTITIES[rule.quantity](found) for rule in record.validity}
    return [
        f"{QUANTITIES[rule.quantity].meaning} is {value:.3g}, valid range {rule.range}: {rule.why}"
        for rule, value in values.items()
        if not rule.low <= value <= rule.high
    ]


def _settled(record: AsperityMethod, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the value of every option of an asperity method, by name.

    given: values specified by the user. An option that is absent or None gets its default. Raises InputError for an unknown
    option or a value that is not allowed.
    """
    for name in given:
        if name not in record.parameters:
            known = f"its options: {', '.join(record.parameters)}" if record.parameters else "it has no options"
            raise InputError(name, given[name], f"not supported by method {record.key}; {known}")
    return {
        name: option.default if given.get(name) is None else _checked(name, option, given[name])
        for name, option in record.parameters.items()
    }


def _checked(name: str, option: Parameter, value: Any) -> Any:
    """Return the value of an option of an asperity method; raise InputError if it is not allowed.

    name: name of the option, for the error. value: as specified by the user; a length is converted to metres.
    """
    if option.unit and not option.values and not isinstance(value, bool):
        value = in_metres(value, name)
    if isinstance(value, bool) or not option.allows(value):
        raise InputError(name, value, option.allowed)
    return value
