"""Find, read and replace numbers in the nested tables of a case by their address.

An address is the tuple of keys that leads to a number, e.g. ("contact", "first", "hardness").
"""

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


# Addresses of the materials of a contact: the two bodies and the film.
BODIES = (("contact", "first"), ("contact", "second"), ("contact", "coating", "material"))


def entry_at(content: Any, path: Address) -> Any:
    """Return the entry at an address in nested tables or records; None if there is none.

    path: keys from the outermost table inwards, e.g. ("contact", "first", "hardness").
    """
    for key in path:
        content = content.get(key) if isinstance(content, Mapping) else getattr(content, "part", lambda _: None)(key)
    return content


def subject_table(content: Mapping) -> str:
    """Return the name of the table in a case that describes the contact: "contact" or "indices"."""
    return "indices" if "indices" in content else "contact"


def _numbers_of(record: type[Input]) -> list[str]:
    return [name for name in record.model_fields if name in QUANTITIES]


def _known(content: Mapping) -> list[str]:
    """Return the dotted names of all numbers that the contact of a case can have, e.g. "first.hardness".

    content: tables of the case. Numbers of a film or a liquid are included only if the case has one.
    """
    if subject_table(content) == "indices":
        return _numbers_of(Indices)
    absent = [part for part in ("coating", "liquid") if entry_at(content, ("contact", part)) is None]
    parts = [part for part in _PARTS if part.partition(".")[0] not in absent]
    return [f"{part}.{name}".removeprefix(".") for part in parts for name in _numbers_of(_PARTS[part])]


def _heights(content: Mapping) -> list[str]:
    """Return the dotted names of the heights (Sq or Ra) that a case specifies with a finish, e.g. "roughness.rms_height"."""
    paths = [(*body, height) for body in ((), ("first",), ("second",)) for height in ("rms_height", "mean_height")]
    return [".".join(("roughness", *path)) for path in paths if entry_at(roughness_in(content), path) is not None]


def address_of(name: str, content: Mapping, where: str, of_finish: bool = False) -> Address:
    """Return the address of a number in a case from its dotted or short name.

    name: "coating.thickness", or "thickness" if only one number has this short name; both give ("contact", "coating",
    "thickness"). content: tables of the case. where: name of the field in the InputError that an unknown or ambiguous name
    raises. of_finish: whether `name` may also be Sq or Ra of a surface with a finish (roughness.rms_height,
    roughness.mean_height).
    """
    heights = _heights(content)
    known = [*_known(content), *heights]
    matches = [name] if name in known else [known_name for known_name in known if known_name.rpartition(".")[2] == name]
    if not of_finish and set(matches) & set(heights):
        raise InputError(where, name, "no height of a finish; state sigma, R and N instead, and name one of them")
    if len(matches) != 1:
        allowed = ", ".join(matches) if matches else nearest(name, known)
        raise InputError(where, name, f"a number of the case: {allowed}")
    return subject_table(content), *matches[0].split(".")


def leaves_of(table: Any, where: str, is_leaf) -> Iterator[tuple[str, Any]]:
    """Yield the dotted name and the entry of every leaf in nested tables, e.g. ("first.hardness", "1 GPa").

    is_leaf: function that takes a table and returns whether the table is one entry, so that its own keys are not visited.
    where: name of the outermost table in error messages. Raises InputError if `table` is not a table.
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
    """Return a copy of nested tables, or of a record, with the entries at some addresses replaced.

    numbers: new entries by address, e.g. {("contact", "first", "hardness"): 1e9}. To change a number of a material preset, the
    name of the preset is first replaced by the table {"preset": name}. Records are checked again. Raises InputError for an
    entry that is not allowed.
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
    """Return None as an empty table, and a preset name, or another entry that is not a table, as {"preset": entry}."""
    return entry if isinstance(entry, Mapping | Input) else {} if entry is None else {"preset": entry}


def roughness_in(content: Mapping) -> Any:
    """Return the entry contact.roughness from the tables of a case; None if there is none."""
    return entry_at(content, ("contact", "roughness"))


def with_roughness(content: Mapping, roughness: Any) -> Any:
    """Return a copy of the tables of a case with `roughness` as the entry contact.roughness."""
    return with_numbers(content, {("contact", "roughness"): roughness})


def as_numbers(content: Mapping) -> Mapping:
    """Return the tables of a case with roughness measured from scans replaced by its roughness parameters.

    A study can vary these parameters: height deviation, radius and density of asperities, which the asperity method of the case
    finds. Tables without scans are returned unchanged.
    """
    rough = roughness_in(content)
    return content if getattr(rough, "measured", None) is None else with_roughness(content, rough.replace())
