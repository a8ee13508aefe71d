"""Write the tables of a case as TOML text that `stiction run` can read."""

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from stiction.case.addresses import roughness_in, with_numbers, with_roughness
from stiction.case.distribution import Distribution, is_scipy_law
from stiction.case.swept import Address
from stiction.case.uncertain import read_distribution
from stiction.quantities.quantity import in_degrees
from stiction.quantities.table import QUANTITIES

_TABLES = ("contact", "indices", "materials")  # tables whose numbers may be samples in a file


def with_written(content: Mapping, numbers: Mapping[Address, float]) -> dict[str, Any]:
    """Return the tables of a case with some numbers replaced by text with units.

    numbers: new numbers in SI units by address, e.g. {("contact", "first", "hardness"): 1e9}.
    """
    return dict(with_numbers(content, {path: show_exactly(value, path[-1]) for path, value in numbers.items()}))


def show_exactly(value: float, name: str) -> Any:
    """Return an SI number as a case file writes it: text with a unit, or a plain number if dimensionless.

    Numbers are rounded to ten significant digits. name: name of the quantity. Angles are converted from radians to degrees.
    """
    value, unit = in_degrees(value, QUANTITIES[name].unit)
    return f"{value:.10g} {unit}" if unit else float(f"{value:.10g}")


def case_text(content: Mapping, comments: list[str], folder: Path, out: Path) -> str:
    """Return the tables of a case as TOML text, after the given comment lines.

    Relative paths of scans, sample files and the materials file start at `folder` in the tables. In the text they start at
    `out`, the folder to which the text will be written.
    """
    return "".join(f"# {line}\n" for line in comments) + as_toml(_moved(content, folder, out))


def as_toml(content: Mapping) -> str:
    """Return tables as TOML text, without keys whose value is None."""
    return tomli_w.dumps(_plain(content, ""))


def inline(value: Any) -> str:
    """Return a table, list, text, number or boolean as TOML text on one line."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {inline(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(inline, value)) + "]"
    return json.dumps(value, ensure_ascii=False, default=str)  # a date is no number, but can be typed


def _moved(content: Mapping, folder: Path, out: Path) -> dict[str, Any]:
    def moved(name: str) -> str:
        return Path(os.path.relpath((folder / name).resolve(), out.resolve())).as_posix()

    def placed(entry: Any, keys: tuple[str, ...]) -> Any:
        if not isinstance(entry, Mapping):
            return entry
        return {
            key: moved(value) if key in keys and isinstance(value, str) else placed(value, keys) for key, value in entry.items()
        }

    changed = {key: placed(value, ("samples", "file")) if key in _TABLES else value for key, value in content.items()}
    if isinstance(changed.get("materials"), str):
        changed["materials"] = moved(changed["materials"])
    rough = roughness_in(changed)
    return with_roughness(changed, placed(rough, ("first", "second"))) if isinstance(rough, Mapping) else changed


def _plain(value: Any, name: str) -> Any:
    """Return a copy of a value with types that TOML can store.

    Keys with the value None are left out, and NumPy arrays become lists. A distribution made in Python, which TOML cannot
    store, becomes its nominal value. name: quantity of the value.
    """
    if isinstance(value, Distribution) or is_scipy_law(value):
        return show_exactly(read_distribution(value, name, name).nominal, name)
    if isinstance(value, Mapping):
        return {str(key): _plain(entry, str(key)) for key, entry in value.items() if entry is not None}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(entry, name) for entry in value]
    return value.item() if isinstance(value, np.generic) else value
