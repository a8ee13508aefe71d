"""Materials of a case's own: tables [materials.NAME] in the case, or in a file beside it that the case names."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from stiction.contact.materials import Material, as_material, material_names
from stiction.quantities.errors import InputError
from stiction.quantities.inputs import nearest

__all__ = ["with_own_materials"]

_FORM = 'tables [materials.NAME], or the name of a file that has them, e.g. materials = "my_materials.toml"'
_BODIES = ("first", "second")


def with_own_materials(content: Mapping, folder: Path, read: Callable[[Path], Mapping]) -> Mapping:
    """The tables of a case with every name of its own materials replaced by the material.

    content: the tables of the case file; folder: from which a file of materials is named; read: the tables of a TOML file, its
    numbers with their units. Raises InputError, for what stands in a file with the name of the file before the field.
    """
    given = content.get("materials")
    if given is None:
        return content
    own = _of_file(folder / given, read) if isinstance(given, str) else _materials(given)
    contact = content.get("contact")
    if not isinstance(contact, Mapping):
        return {**content, "materials": own}
    bodies = {name: _found(contact[name], own, f"contact.{name}") for name in _BODIES if name in contact}
    coating = contact.get("coating")
    if isinstance(coating, Mapping) and "material" in coating:
        found = _found(coating["material"], own, "contact.coating.material")
        bodies["coating"] = {**coating, "material": found}
    return {**content, "materials": own, "contact": {**contact, **bodies}}


def _of_file(path: Path, read: Callable[[Path], Mapping]) -> dict[str, Material]:
    try:
        tables = read(path)
        for key in tables.keys() - {"materials"}:
            raise InputError(key, tables[key], "materials: a file of materials has tables [materials.NAME] and nothing else")
        return _materials(tables.get("materials"))
    except InputError as error:
        where = path.name if error.field == "case file" else f"{path.name}: {error.field}"
        raise InputError(f"materials: {where}", error.value, error.allowed.replace("case file", "file of materials")) from None


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
    try:
        found = as_material({"name": name, **numbers})
        return found if isinstance(found, Material) else Material(**found)
    except InputError as error:
        raise InputError(f"{where}.{error.field}" if error.field else where, error.value, error.allowed) from None


def _found(body: Any, own: Mapping[str, Material], where: str) -> Any:
    """The material of a body that names one of the case's own, changed where it says so; the body as it is if it names none."""
    name = body.get("preset") if isinstance(body, Mapping) else body
    if not isinstance(name, str):
        return body
    if name in own:
        changes = {key: entry for key, entry in body.items() if key != "preset"} if isinstance(body, Mapping) else {}
        try:
            return own[name].replace(**changes)
        except InputError as error:
            raise InputError(f"{where}.{error.field}", error.value, error.allowed) from None
    if name not in material_names():
        raise InputError(where, name, "a material of the case, or a preset: " + nearest(name, [*own, *material_names()]))
    return body
