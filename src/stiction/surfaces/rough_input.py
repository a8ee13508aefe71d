"""Define the type of the field `roughness` of a contact, and convert what users may specify there.

Users may specify numbers, a scan, a finish, or a table of scans.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator

from stiction.quantities.keywords import Converted
from stiction.surfaces.finished import is_finished, roughness_of_finish
from stiction.surfaces.measured import roughness_of
from stiction.surfaces.roughness import Roughness

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap


def _rough(value):
    """Convert the input for the roughness of a contact to a Roughness if it describes scans or a finish; else return it."""
    if isinstance(value, Roughness | str | int | float | None):
        return value
    if is_finished(value):
        return roughness_of_finish(value)
    if isinstance(value, Mapping) and not value.keys() & {"first", "second"}:
        return value
    if not isinstance(value, Mapping):
        from stiction.surfaces.held import as_height_map

        value = {"first": as_height_map(value, "")}
    return roughness_of(value)


if TYPE_CHECKING:
    Rough = Converted[Roughness, Roughness | HeightMap | Mapping[str, object] | tuple[object, object]]
else:
    Rough = Annotated[Roughness, BeforeValidator(_rough, json_schema_input_type=Roughness)]
