"""Where the numbers of a contact stand in a case, and what may stand there in place of one."""

from collections.abc import Iterator, Mapping
from typing import Any

from stiction.case.several import Address
from stiction.contact.contact import Coating, Contact, Indices, Liquid
from stiction.contact.materials import Material
from stiction.quantities.errors import InputError, field_below, nearest
from stiction.quantities.inputs import Input
from stiction.quantities.table import QUANTITIES
from stiction.surfaces.roughness import Roughness

_PARTS: dict[str, type[Input]] = {
    "": Contact,
    "first": Material,
    "second": Material,
    "roughness": Roughness,
    "coating": Coating,
    "coating.material": Material,
    "liquid": Liquid,
}


# Where the materials of a contact stand.
BODIES = (("contact", "first"), ("contact", "second"), ("contact", "coating", "material"))


def entry_at(content: Any, path: Address) -> Any:
    """Return what stands at a path of tables and records; None if nothing does."""
    for key in path:
        content = content.get(key) if isinstance(content, Mapping) else getattr(content, "part", lambda _: None)(key)
    return content


def subject_table(content: Mapping) -> str:
    """Return the table of the subject: "contact" or "indices"."""
    return "indices" if "indices" in content else "contact"


def _numbers_of(record: type[Input]) -> list[str]:
    return [name for name in record.model_fields if name in QUANTITIES]


def _known(content: Mapping) -> list[str]:
    """Dotted names of all numbers that this case may have."""
    if subject_table(content) == "indices":
        return _numbers_of(Indices)
    absent = [part for part in ("coating", "liquid") if entry_at(content, ("contact", part)) is None]
    parts = [part for part in _PARTS if part.partition(".")[0] not in absent]
    return [f"{part}.{name}".removeprefix(".") for part in parts for name in _numbers_of(_PARTS[part])]


def placed(name: str, content: Mapping, where: str) -> Address:
    """Return the address of the number of this name.

    ("contact", "coating", "thickness") for "coating.thickness", or for "thickness" if there is only one. Raises InputError,
    naming `where`, for a name that is no number of the case.
    """
    known = _known(content)
    found = [name] if name in known else [one for one in known if one.rpartition(".")[2] == name]
    if len(found) != 1:
        allowed = ", ".join(found) if found else nearest(name, known)
        raise InputError(where, name, f"a number of the case: {allowed}")
    return subject_table(content), *found[0].split(".")


def flat(table: Any, where: str, is_leaf) -> Iterator[tuple[str, Any]]:
    """Dotted name and entry of everything in a table of tables, down to what is a leaf."""
    if not isinstance(table, Mapping):
        raise InputError(where, table, "a table of numbers of the case, by their names")
    for key, value in table.items():
        if isinstance(value, Mapping) and not is_leaf(value):
            for name, leaf in flat(value, f"{where}.{key}", is_leaf):
                yield f"{key}.{name}", leaf
        else:
            yield str(key), value


def with_numbers(content: Any, numbers: Mapping[Address, Any]) -> Any:
    """Return tables or a record with these entries at their addresses.

    A body that is named by its preset keeps its other numbers. Records are checked. Raises InputError.
    """
    changes: dict[str, Any] = {}
    for key in dict.fromkeys(path[0] for path in numbers):
        inner = {path[1:]: entry for path, entry in numbers.items() if path[0] == key}
        part = inner.pop((), entry_at(content, (key,)))
        with field_below(key):
            changes[key] = with_numbers(_as_table(part), inner) if inner else part
    if not isinstance(content, Input):
        return {**content, **changes}
    return content.replace(**changes)


def _as_table(entry: Any) -> Any:
    """Return a preset by its name as a table that starts from it, and nothing as an empty table."""
    return {"preset": entry} if isinstance(entry, str) else {} if entry is None else entry


def roughness_in(content: Mapping) -> Any:
    """Return what the tables of a case have as the roughness of the contact; None where they have nothing."""
    return entry_at(content, ("contact", "roughness"))


def with_roughness(content: Mapping, roughness: Any) -> Any:
    """Return the tables of a case with another roughness of the contact."""
    return with_numbers(content, {("contact", "roughness"): roughness})


def as_numbers(content: Mapping) -> Mapping:
    """Replace scans by the roughness numbers of the method that represents them, so that studies can vary these."""
    rough = roughness_in(content)
    return content if getattr(rough, "measured", None) is None else with_roughness(content, rough.replace())
