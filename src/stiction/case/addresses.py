"""Addresses of the numbers of a contact in the tables of a case: find, read and replace them."""

from collections.abc import Iterator, Mapping
from typing import Any

from stiction.case.swept import Address
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
    """Return the entry at an address in nested tables and records; None if there is none."""
    for key in path:
        content = content.get(key) if isinstance(content, Mapping) else getattr(content, "part", lambda _: None)(key)
    return content


def subject_table(content: Mapping) -> str:
    """Return the table that describes the contact: "contact" or "indices"."""
    return "indices" if "indices" in content else "contact"


def _numbers_of(record: type[Input]) -> list[str]:
    return [name for name in record.model_fields if name in QUANTITIES]


def _known(content: Mapping) -> list[str]:
    """Return the dotted names of all numbers that the contact of a case can have."""
    if subject_table(content) == "indices":
        return _numbers_of(Indices)
    absent = [part for part in ("coating", "liquid") if entry_at(content, ("contact", part)) is None]
    parts = [part for part in _PARTS if part.partition(".")[0] not in absent]
    return [f"{part}.{name}".removeprefix(".") for part in parts for name in _numbers_of(_PARTS[part])]


def address_of(name: str, content: Mapping, where: str) -> Address:
    """Return the address of a number from its dotted or short name.

    "coating.thickness", or "thickness" if no other number has that name, gives ("contact", "coating", "thickness"). where:
    field of the InputError for a name that is unknown or ambiguous.
    """
    known = _known(content)
    matches = [name] if name in known else [known_name for known_name in known if known_name.rpartition(".")[2] == name]
    if len(matches) != 1:
        allowed = ", ".join(matches) if matches else nearest(name, known)
        raise InputError(where, name, f"a number of the case: {allowed}")
    return subject_table(content), *matches[0].split(".")


def leaves_of(table: Any, where: str, is_leaf) -> Iterator[tuple[str, Any]]:
    """Yield every leaf of nested tables: its dotted name and its entry.

    is_leaf: function that returns whether a table counts as one entry. where: name of the table, for errors. Raises InputError
    if `table` is no table.
    """
    if not isinstance(table, Mapping):
        raise InputError(where, table, "a table with names of numbers of the case, e.g. hardness = ...")
    for key, value in table.items():
        if isinstance(value, Mapping) and not is_leaf(value):
            for name, leaf in leaves_of(value, f"{where}.{key}", is_leaf):
                yield f"{key}.{name}", leaf
        else:
            yield str(key), value


def with_numbers(content: Any, numbers: Mapping[Address, Any]) -> Any:
    """Return a copy of tables or of a record, with other entries at some addresses.

    numbers: entry by address. A preset name becomes a table that starts from the preset. Records are validated again. Raises
    InputError.
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
    """Return a preset name as {"preset": name}, None as an empty table, and any other entry unchanged."""
    return {"preset": entry} if isinstance(entry, str) else {} if entry is None else entry


def roughness_in(content: Mapping) -> Any:
    """Return the entry contact.roughness of a case, or None."""
    return entry_at(content, ("contact", "roughness"))


def with_roughness(content: Mapping, roughness: Any) -> Any:
    """Return a copy of the tables of a case with this entry as contact.roughness."""
    return with_numbers(content, {("contact", "roughness"): roughness})


def as_numbers(content: Mapping) -> Mapping:
    """Return the tables of a case with scans replaced by roughness parameters, so that a study can vary these.

    The parameters are those that the chosen asperity method finds in the scans.
    """
    rough = roughness_in(content)
    return content if getattr(rough, "measured", None) is None else with_roughness(content, rough.replace())
