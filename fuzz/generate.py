"""Case files for a seed: an example case, changed at random as its JSON schema allows, and sometimes as it does not."""

import copy
import random
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from stiction.case.case_tables import json_schema
from stiction.case.read import case_in
from stiction.contact.interfaces import interface_names
from stiction.contact.materials import material_names
from stiction.quantities.errors import InputError
from stiction.web.fields import example_cases

SECTIONS = ("uncertainty", "sweep", "design", "fit")
WRONG: tuple[Any, ...] = (
    "",
    "nan",
    "1e400 m",
    "-1 nm",
    "5 parsnip",
    [],
    {},
    True,
    -1,
    0,
    1e300,
    float("nan"),
    "no such thing",
    [1, "2 nm"],
)
_QUANTITY = re.compile(r"^([-+]?[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?)\s*(.*)$")
_MOST_POINTS = 40  # more are only more work
_MOST_DEPTH = 6  # of tables in tables that are made


def case_of(seed: int) -> dict[str, Any]:
    """Return the tables of the case of a seed; the same seed gives the same case."""
    chance = random.Random(seed)
    tables = copy.deepcopy(chance.choice(list(example_cases().values())))
    if chance.random() < 0.15:
        tables = {"title": "groups", "indices": _indices(chance), "solve": {"load": [1e-3, 1e-2]}}
    careful = chance.random() < 0.75  # most changes would be refused, and a refused case tests only the reader
    for _ in range(chance.randint(1, 6)):
        changed = copy.deepcopy(tables)
        _change(chance, changed)
        if not careful or _is_read(changed):
            tables = changed
    if chance.random() < 0.3:
        name = chance.choice(SECTIONS)
        tables[name] = value_of(chance, schema_of(name), name)
    if not careful and chance.random() < 0.5:
        place = chance.choice(list(_leaves(tables)))
        put(tables, place, copy.deepcopy(chance.choice(WRONG)))
    return tables


def suited_to(command: str, tables: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    """Return a case with what a command needs, as far as the case itself allows it: a random case is refused almost always."""
    tables = {name: part for name, part in copy.deepcopy(tables).items() if name not in SECTIONS}
    contact, solve = tables.get("contact"), tables.get("solve")
    if not isinstance(contact, dict) or not isinstance(solve, dict):
        return tables
    if command == "validate":  # loads are those of the measured table
        del tables["solve"]
    elif contact.pop("interface", None) is not None and command not in ("film", "slide"):
        contact["interfacial_shear_strength"] = f"{10 ** chance.uniform(6, 9):.3g} Pa"
    if command in _SECTION_OF and solve.pop("separation", None) is not None:
        solve["load"] = [f"{10 ** chance.uniform(-6, 2):.3g} N" for _ in range(chance.randint(1, 3))]
    if command in ("film", "slide"):
        contact.setdefault("work_of_adhesion", f"{10 ** chance.uniform(-3, 0.3):.3g} J/m^2")
    if command == "slide":
        contact.pop("coating", None)
    if command == "film":
        contact.setdefault("coating", {"material": "silver", "thickness": f"{10 ** chance.uniform(0, 4):.3g} nm"})
    if command in _SECTION_OF:
        tables[command] = _SECTION_OF[command](contact, chance)
    return tables


def _sweep(contact: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    contact["interfacial_shear_strength"] = [f"{10 ** chance.uniform(5, 9):.3g} Pa" for _ in range(chance.randint(2, 4))]
    kept: tuple[dict[str, Any], ...] = ({}, {"statistics": ["mean", "median"]}, {"precision": "float32"}, {"block": 2})
    return dict(chance.choice(kept))


def _fit(contact: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    contact["interfacial_shear_strength"] = "50 MPa"
    return {"free": {"interfacial_shear_strength": {"low": "1 MPa", "high": "1 GPa"}}}


def _design(contact: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    choose: dict[str, Any] = {"interfacial_shear_strength": {"low": "1 MPa", "high": "1 GPa"}}
    rough = contact.get("roughness")
    if isinstance(rough, dict) and "asperity_height_deviation" in rough:
        choose["roughness"] = {"asperity_height_deviation": {"low": "20 nm", "high": "80 nm"}}
    return {"objective": {"minimise": "friction_coefficient"}, "choose": choose}


_SECTION_OF = {"sweep": _sweep, "fit": _fit, "design": _design}


def measured_text(chance: random.Random) -> str:
    """Return a table of friction measured at some loads, with errors of about a tenth."""
    rows = [(10 ** chance.uniform(-4, 1), 10 ** chance.uniform(-2, 0.3)) for _ in range(chance.randint(1, 6))]
    lines = [f"{load:.3g},{mu:.3g},{mu * chance.uniform(0.01, 0.2):.2g}" for load, mu in sorted(rows)]
    return "\n".join(["load [N],friction_coefficient,friction_coefficient_error", *lines, ""])


def _is_read(tables: dict[str, Any]) -> bool:
    try:
        case_in(tables, Path())
    except InputError:
        return False
    return True


def value_of(chance: random.Random, schema: dict[str, Any], name: str, depth: int = 0) -> Any:
    """Return a value that a part of the schema allows, as far as a schema can say it; name: of its key."""
    schema = _resolved(schema)
    if depth > _MOST_DEPTH:
        return _number(chance)
    if "enum" in schema:
        return chance.choice(schema["enum"])
    if "const" in schema:
        return schema["const"]
    if "anyOf" in schema:
        return value_of(chance, chance.choice(schema["anyOf"]), name, depth + 1)
    kind = schema.get("type")
    if kind == "object" or "properties" in schema:
        return _table(chance, schema, depth)
    if kind == "array":
        count = chance.choice((1, 2, 3))
        return [value_of(chance, schema.get("items", {}), name, depth + 1) for _ in range(count)]
    if kind == "boolean":
        return chance.random() < 0.5
    if kind in ("number", "integer"):
        number = _within(chance, schema)
        return min(int(number), _MOST_POINTS) if kind == "integer" else number
    return _text(chance, schema, name)


def _table(chance: random.Random, schema: dict[str, Any], depth: int) -> dict[str, Any]:
    parts = schema.get("properties", {})
    needed = set(schema.get("required", ()))
    if "oneOf" in schema:
        needed |= set(chance.choice(schema["oneOf"]).get("required", ()))
    share = chance.choice((0.05, 0.2, 0.5))
    taken = [name for name in parts if name in needed or chance.random() < share]
    table = {name: value_of(chance, parts[name], name, depth + 1) for name in taken}
    if not parts and isinstance(schema.get("additionalProperties"), dict):
        table["load"] = value_of(chance, schema["additionalProperties"], "load", depth + 1)
    return table


def _indices(chance: random.Random) -> dict[str, float]:
    groups = {"theta": 10 ** chance.uniform(-1, 4), "lam": 10 ** chance.uniform(-2, 4)}
    more = {"n_E": 10 ** chance.uniform(-2, 1), "n_H": 10 ** chance.uniform(-2, 1), "tau": 10 ** chance.uniform(-2, 2)}
    return groups | (more if chance.random() < 0.5 else {})


def _change(chance: random.Random, tables: dict[str, Any]) -> None:
    """Scale a number, make it several or uncertain, remove a key or add one that the schema has."""
    place = chance.choice(list(_leaves(tables)))
    value = _got(tables, place)
    kind = chance.random()
    if kind < 0.5:
        put(tables, place, scaled(chance, value))
    elif kind < 0.65:
        several = (
            {"start": value, "stop": scaled(chance, value), "count": chance.randint(1, 4)},
            {"median": value, "factor": 10 ** chance.uniform(0, 1.5)},
            {"mean": value, "deviation": scaled(chance, value)},
            {"low": value, "high": scaled(chance, value)},
            [value, scaled(chance, value)],
        )
        put(tables, place, chance.choice(several))
    elif kind < 0.75 and len(place) > 1:
        _got(tables, place[:-1]).pop(place[-1], None)
    else:
        section = chance.choice([name for name in ("contact", "indices", "solve") if name in tables] or ["contact"])
        parts = schema_of(section).get("properties", {})
        name = chance.choice(list(parts))
        tables.setdefault(section, {})[name] = value_of(chance, parts[name], name)


def scaled(chance: random.Random, value: Any) -> Any:
    """Return a number, or text with a unit, times a random factor; other text is exchanged."""
    factor = 10 ** chance.gauss(0.0, chance.choice((0.1, 1.0, 4.0)))
    if isinstance(value, bool) or value is None:
        return value
    if isinstance(value, int | float):
        return min(int(value * factor) + 1, _MOST_POINTS) if isinstance(value, int) else value * factor
    if isinstance(value, str) and (found := _QUANTITY.match(value)):
        return f"{float(found[1]) * factor:.4g} {found[2]}".strip()
    return chance.choice([*material_names(), *interface_names(), "first", "second", "both", "log", "linear"])


def _text(chance: random.Random, schema: dict[str, Any], name: str) -> str:
    examples = schema.get("examples")
    if examples:
        return str(scaled(chance, chance.choice(examples)))
    if name in ("first", "second", "material", "preset"):
        return chance.choice(material_names())
    if name == "interface":
        return chance.choice(interface_names())
    return chance.choice(
        ("load", "sample", "contact.roughness.asperity_radius", "contact.interfacial_shear_strength", "2 N", "x")
    )


def _within(chance: random.Random, schema: dict[str, Any]) -> float:
    low = schema.get("minimum", schema.get("exclusiveMinimum"))
    high = schema.get("maximum", schema.get("exclusiveMaximum"))
    if low is not None and high is not None:
        return chance.uniform(low, high)
    number = _number(chance)
    return number if low is None else low + abs(number)


def _number(chance: random.Random) -> float:
    return chance.choice((1.0, -1.0, 1.0, 1.0)) * float(f"{10 ** chance.gauss(0, 2):.3g}")


def _leaves(table: dict[str, Any], place: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the places of all values that are no tables, or of an empty case its title."""
    for name, value in table.items():
        if isinstance(value, dict) and value:
            yield from _leaves(value, (*place, name))
        else:
            yield (*place, name)
    if not table and not place:
        yield ("title",)


def _got(table: dict[str, Any], place: tuple[str, ...]) -> Any:
    for name in place:
        table = table.get(name, "")  # type: ignore[assignment]
    return table


def put(table: dict[str, Any], place: tuple[str, ...], value: Any) -> None:
    """Put a value at a place; tables that are not there are made."""
    for name in place[:-1]:
        table = table.setdefault(name, {})
    table[place[-1]] = value


def _schema() -> dict[str, Any]:
    if not _made:
        _made.update(json_schema())
    return _made


_made: dict[str, Any] = {}


def schema_of(section: str) -> dict[str, Any]:
    """Return the schema of a section of a case file."""
    return _resolved(_schema()["properties"][section])


def _resolved(schema: dict[str, Any]) -> dict[str, Any]:
    while "$ref" in schema:
        schema = _schema()["$defs"][schema["$ref"].rpartition("/")[2]]
    return schema
