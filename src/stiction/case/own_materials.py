"""Materials of a case: tables [materials.NAME] in the case, or in a file that it names."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from stiction.case.places import BODIES, entry_at, with_numbers
from stiction.case.several import Address
from stiction.contact.materials import Material, as_material, material_names, preset_name
from stiction.quantities.errors import InputError, field_as, field_below

_FORM = 'tables [materials.NAME], or the name of a file that has them, e.g. materials = "my_materials.toml"'


def with_materials_of_file(content: Mapping, folder: Path, read: Callable[[Path], Mapping]) -> Mapping:
    """Return the tables of a case with the contents of its file of materials, if it names one.

    folder: of the case; read: returns the tables of a TOML file, with units. Raises InputError, with the name of the file
    before the field.
    """
    given = content.get("materials")
    if not isinstance(given, str):
        return content
    name = Path(given).name
    try:
        tables = read(folder / given)
        for key in tables.keys() - {"materials"}:
            raise InputError(key, tables[key], "materials: a file of materials has tables [materials.NAME] and nothing else")
        if not isinstance(tables.get("materials"), Mapping):
            raise InputError("materials", tables.get("materials"), _FORM)
    except InputError as error:
        where = name if error.field == "case file" else f"{name}: {error.field}"
        raise InputError(f"materials: {where}", error.value, error.allowed.replace("case file", "file of materials")) from None
    return {**content, "materials": tables["materials"]}


def telling_the_file(content: Mapping) -> AbstractContextManager[None]:
    """Put the name of the file that has the materials of a case before the field of an InputError about them."""
    given = content.get("materials")
    before = f"materials: {Path(given).name}: " if isinstance(given, str) else ""
    return field_as(lambda field: before * field.startswith("materials.") + field)


def with_own_materials(content: Mapping) -> Mapping:
    """Replace the names of materials of the case by these materials. Raises InputError."""
    given = content.get("materials")
    if given is None:
        return content
    own = _materials(given)
    named: dict[Address, Any] = {path: body for path in BODIES if (body := entry_at(content, path)) is not None}
    found = {path: _found(body, own, ".".join(path)) for path, body in named.items()}
    return with_numbers(content, {**found, ("materials",): own})


def _materials(tables: Any) -> dict[str, Material]:
    """Name -> material, of the tables of numbers; a material may start from a preset, but not bear its name."""
    if not isinstance(tables, Mapping):
        raise InputError("materials", tables, _FORM)
    return {name: _material(name, numbers) for name, numbers in tables.items()}


def _material(name: str, numbers: Any) -> Material:
    where = f"materials.{name}"
    if name in material_names():
        raise InputError(where, name, "a name that no preset has")
    if not isinstance(numbers, Mapping):
        raise InputError(where, numbers, f"a table [{where}] of its numbers")
    with field_below(where):
        found = as_material({"name": name, **numbers})
        return found if isinstance(found, Material) else Material(**found)


def _found(body: Any, own: Mapping[str, Material], where: str) -> Any:
    """Return the material of a body that names one of the case, with its changes; other bodies are returned unchanged."""
    name = body.get("preset") if isinstance(body, Mapping) else body
    if not isinstance(name, str):
        return body
    if name in own:
        changes = {key: entry for key, entry in body.items() if key != "preset"} if isinstance(body, Mapping) else {}
        with field_below(where):
            return own[name].replace(**changes)
    preset_name(name, where, list(own))
    return body
