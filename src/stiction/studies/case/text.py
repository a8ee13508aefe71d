"""A case as text: a TOML file that `stiction run` reads."""

import json
import math
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from stiction.quantities.table import QUANTITIES
from stiction.studies.case.distribution import Distribution, is_law
from stiction.studies.case.places import with_numbers
from stiction.studies.case.uncertain import read_distribution

__all__ = ["as_toml", "case_text", "show_exactly", "with_written"]

_TABLES = ("contact", "indices", "materials")  # in which numbers may be values from a file
_PLAIN_KEY = re.compile(r"[A-Za-z0-9_-]+")


def with_written(content: Mapping, numbers: Mapping[tuple[str, ...], float]) -> dict[str, Any]:
    """The tables of a case as they were written, with these numbers, SI, as text with their units."""
    return dict(with_numbers(content, {path: show_exactly(value, path[-1]) for path, value in numbers.items()}))


def show_exactly(value: float, name: str) -> Any:
    """A number of the named quantity as a case file has it, to ten digits."""
    unit = QUANTITIES[name].unit
    return f"{value:.10g} {unit}" if unit else float(f"{value:.10g}")


def case_text(content: Mapping, comments: list[str], folder: Path, out: Path) -> str:
    """The tables as TOML, after comments. What is named from a folder (scans, files of values, of materials) is named from
    where the text goes."""
    return "".join(f"# {line}\n" for line in comments) + as_toml(_moved(content, folder, out))


def as_toml(content: Mapping) -> str:
    """The tables as TOML; what they name keeps its name."""
    lines: list[str] = []
    _write(content, (), lines)
    return "\n".join(lines) + "\n"


def _moved(content: Mapping, folder: Path, out: Path) -> dict[str, Any]:
    def moved(name: str) -> str:
        return Path(os.path.relpath((folder / name).resolve(), out.resolve())).as_posix()

    changed = {key: _samples_moved(one, moved) if key in _TABLES else one for key, one in content.items()}
    if isinstance(changed.get("materials"), str):
        changed["materials"] = moved(changed["materials"])
    contact = changed.get("contact")
    rough = contact.get("roughness") if isinstance(contact, Mapping) else None
    if isinstance(rough, Mapping):
        assert isinstance(contact, Mapping)
        surfaces = {key: _scan_moved(one, moved) if key in ("first", "second") else one for key, one in rough.items()}
        changed["contact"] = {**contact, "roughness": surfaces}
    return changed


def _samples_moved(table: Any, moved) -> Any:
    """With every file of values named from its new place."""
    if not isinstance(table, Mapping):
        return table
    return {
        key: moved(one) if key == "samples" and isinstance(one, str) else _samples_moved(one, moved)
        for key, one in table.items()
    }


def _scan_moved(surface: Any, moved) -> Any:
    if isinstance(surface, str):
        return moved(surface)
    if isinstance(surface, Mapping) and isinstance(surface.get("file"), str):
        return {**surface, "file": moved(surface["file"])}
    return surface


def _write(table: Mapping, path: tuple[str, ...], lines: list[str]) -> None:
    """First what is no table, then the tables in it, each under its name."""
    inner = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    plain = {key: value for key, value in table.items() if key not in inner and value is not None}
    if path and (plain or not inner):
        lines += ["", f"[{'.'.join(map(_key, path))}]"]
    lines += [f"{_key(key)} = {_value(_written(key, value))}" for key, value in plain.items()]
    for key, value in inner.items():
        _write(value, (*path, str(key)), lines)


def _written(key: str, value: Any) -> Any:
    """A distribution that a file cannot say as the number that stands for it."""
    if isinstance(value, Distribution) or is_law(value):
        return show_exactly(read_distribution(value, key, key).nominal, key)
    return value


def _key(key: Any) -> str:
    return str(key) if _PLAIN_KEY.fullmatch(str(key)) else json.dumps(str(key))


def _value(value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)  # the escapes of JSON are escapes of TOML
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list | tuple | np.ndarray):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, float | np.floating):
        return repr(float(value)) if math.isfinite(value) else ("inf" if value > 0 else "-inf" if value < 0 else "nan")
    return str(value)
