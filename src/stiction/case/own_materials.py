"""Read materials defined by the user: tables [materials.NAME] in a case file, or in a file that the case names."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from stiction.case.addresses import BODIES, entry_at, with_numbers
from stiction.case.swept import Address
from stiction.contact.materials import Material, as_material, material_names, preset_name
from stiction.quantities.errors import InputError, field_as, field_below

_FORM = 'tables [materials.NAME], or the path of a file with such tables, e.g. materials = "my_materials.toml"'


def with_materials_of_file(content: Mapping, folder: Path, read: Callable[[Path], Mapping]) -> Mapping:
    """Return the tables of a case with the path of a materials file replaced by the tables of that file.

    folder: folder of the case file. read: function that returns the tables of a TOML file and checks their units. A case
    without such a path is returned unchanged. Raises InputError, whose field names the materials file.
    """
    materials = content.get("materials")
    if not isinstance(materials, str):
        return content
    name = Path(materials).name
    try:
        tables = read(folder / materials)
        for key in tables.keys() - {"materials"}:
            raise InputError(key, tables[key], "only tables [materials.NAME] in a materials file")
        if not isinstance(tables.get("materials"), Mapping):
            raise InputError("materials", tables.get("materials"), _FORM)
    except InputError as error:
        where = name if error.field == "case file" else f"{name}: {error.field}"
        raise InputError(f"materials: {where}", error.value, error.allowed.replace("case file", "file of materials")) from None
    return {**content, "materials": tables["materials"]}


def naming_materials_file(content: Mapping) -> AbstractContextManager[None]:
    """Return a context manager that adds the name of the materials file to the field of InputErrors about materials.

    Errors stay unchanged if the case names no materials file.
    """
    materials = content.get("materials")
    before = f"materials: {Path(materials).name}: " if isinstance(materials, str) else ""
    return field_as(lambda field: before * field.startswith("materials.") + field)


def with_own_materials(content: Mapping) -> Mapping:
    """Return the tables of a case with every name of a user-defined material replaced by that material.

    The tables must contain the tables [materials.NAME] themselves, not the path of a materials file. Raises InputError for an
    invalid material or an unknown name.
    """
    tables = content.get("materials")
    if tables is None:
        return content
    own = _materials(tables)
    named: dict[Address, Any] = {path: body for path in BODIES if (body := entry_at(content, path)) is not None}
    materials = {path: _with_own_material(body, own, ".".join(path)) for path, body in named.items()}
    return with_numbers(content, {**materials, ("materials",): own})


def _materials(tables: Any) -> dict[str, Material]:
    """Return the materials that tables [materials.NAME] define, by name.

    A material may start from a preset, but must not have the name of a preset. Raises InputError for an invalid material.
    """
    if not isinstance(tables, Mapping):
        raise InputError("materials", tables, _FORM)
    return {name: _material(name, numbers) for name, numbers in tables.items()}


def _material(name: str, numbers: Any) -> Material:
    where = f"materials.{name}"
    if name in material_names():
        raise InputError(where, name, "a name that no preset has; choose another name")
    if not isinstance(numbers, Mapping):
        raise InputError(where, numbers, f"a table [{where}] of material properties")
    with field_below(where):
        material = as_material({"name": name, **numbers})
        return material if isinstance(material, Material) else Material(**material)


def _with_own_material(body: Any, own: Mapping[str, Material], where: str) -> Any:
    """Return a body as a material if it names a user-defined material, with the numbers that the body changes.

    A body that names a preset, or has no name, is returned unchanged. body: name, table or Material. own: user-defined
    materials by name. where: address of the body in error messages. Raises InputError if neither a preset nor a user-defined
    material has the name.
    """
    name = body.get("preset") if isinstance(body, Mapping) else body
    if not isinstance(name, str):
        return body
    if name in own:
        changes = {key: entry for key, entry in body.items() if key != "preset"} if isinstance(body, Mapping) else {}
        with field_below(where):
            return own[name].replace(**changes)
    preset_name(name, where, list(own))
    return body
