"""The page of the case file, from its schema."""

import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

from docstrings import as_markdown, cell, said_of, summary

from stiction.case.case_tables import json_schema
from stiction.case.study_tables import study_tables

# Where a part of the schema stands in a case file, in the order of the page; those without are values (held by a test).
TABLES = {
    "Contact": "[contact]",
    "Roughness": "[contact.roughness]",
    "MeasuredRoughness": "[contact.roughness] with scans",
    "Scan": "a scan",
    "Finished": "[contact.roughness] with a finish",
    "FinishedBodies": "[contact.roughness] with finishes of both",
    "Interface": "[contact.interface]",
    "Coating": "[contact.coating]",
    "Material": "a material",
    "Liquid": "[contact.liquid]",
    "Indices": "[indices]",
    "_Solve": "[solve]",
    "Uncertainty": "[uncertainty]",
    **{table.__name__: f"[{name}]" for name, (table, _) in study_tables().items()},
    "Sample": "sample of [sweep]",
    "Range": "points in a row",
    "RangeOfNumbers": "numbers in a row",
    "ListAlong": "a list along a dimension",
    "Between": "between two ends",
    "WithinFactor": "within a factor",
    "FromSamples": "from samples",
}
_NUMBERS = ("RangeOfNumbers", "ListAlong", "Between", "WithinFactor", "FromSamples")


def write(out: Path) -> list[PurePosixPath]:
    """One page with a section for each table."""
    folder = out / "reference"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "case-file.md").write_text("\n".join(page(json_schema())) + "\n", encoding="utf-8")
    return []


def page(schema: dict[str, Any]) -> Iterator[str]:
    yield from ("# Case file", "")
    yield (
        schema["description"]
        + " A case file is a TOML file. `stiction schema` prints its JSON schema, from which this page is made. With it,"
    )
    yield from ("a text editor completes and checks a case file. Every number with a dimension is text with a unit.", "")
    yield from _table(schema, schema["$defs"])
    for name, title in TABLES.items():
        part = schema["$defs"][name]
        yield from (f"({_anchor(name)})=", f"## {title}", "", as_markdown(_described(part), part.get("properties", ())), "")
        yield from _table(part, schema["$defs"])


def _described(part: dict[str, Any]) -> str:
    """Return the description without its list of numbers, which the table has, and without sections for Python."""
    text = re.split(r"\n\n(?:Numbers, each|(?:Returns|Raises|Notes|Examples)\n---)", part.get("description", ""))[0]
    return re.sub(r"\s*Raises InputError[^.]*\.", "", text).replace("*", "\\*")


def _anchor(name: str) -> str:
    return f"case-{name.strip('_').lower()}"


def _table(part: dict[str, Any], defined: dict[str, Any]) -> Iterator[str]:
    """The rows of a part; defined: all parts by name, of which those that a row leads to say what it is."""
    rows = part.get("properties", {})
    if not rows:
        return
    yield from ("| key | value | default | meaning |", "|---|---|---|---|")
    for name, one in rows.items():
        must = "**required**" if name in part.get("required", ()) else ""
        usual = one.get("default")
        default = must if usual in (None, "") or isinstance(usual, dict) else f"`{_toml(usual)}`"
        said = _meaning(one, defined) or cell(said_of(_described(part), name, rows))
        yield f"| `{name}` | {value_of(one)} | {default} | {said} |"
    yield ""


def _meaning(one: dict[str, Any], defined: dict[str, Any]) -> str:
    parts = [defined[part["$ref"].rpartition("/")[2]] for part in (one, *one.get("anyOf", ())) if "$ref" in part]
    described = one.get("description") or (summary(_described(parts[0])) if parts else "")
    said = cell(described.replace("*", "\\*"))
    examples = ", ".join(f"`{_toml(each)}`" for each in one.get("examples", ()))
    return f"{said}; for example {examples}" if examples else said


def _toml(value: Any) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)


def value_of(one: dict[str, Any]) -> str:
    """What may be written, in words."""
    if "$ref" in one:
        return _link(one["$ref"])
    if "enum" in one:
        return " or ".join(f'`"{value}"`' for value in one["enum"])
    if "anyOf" in one:
        references = [part["$ref"].rpartition("/")[2] for part in one["anyOf"] if "$ref" in part]
        if set(_NUMBERS) <= set(references):
            first = value_of(one["anyOf"][0])
            return f"{first}; one value, a list, or [a range or an uncertain number](#{_anchor('RangeOfNumbers')})"
        return ", or ".join(dict.fromkeys(value_of(part) for part in one["anyOf"]))
    kind = one.get("type", "")
    if kind == "array":
        return f"a list of {value_of(one.get('items', {}))}"
    names = {"string": "text", "number": "number", "integer": "whole number", "boolean": "`true` or `false`", "object": "table"}
    return names.get(kind, "value")


def _link(reference: str) -> str:
    name = reference.rpartition("/")[2]
    return f"[{TABLES[name].replace('[', '').replace(']', '')}](#{_anchor(name)})"
