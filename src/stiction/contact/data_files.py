"""The data files of the package: tables [KIND.NAME] in every file of a folder, with what holds for a whole file above them."""

import tomllib
from importlib import resources
from typing import Any

__all__ = ["read_tables"]


def read_tables(folder: str, kind: str) -> dict[str, dict[str, Any]]:
    """Read all tables [kind.NAME] of the TOML files in a folder of stiction.contact.

    What stands at the top of a file holds for each of its tables that says nothing else, field by field for tables there.
    Raises ValueError for a name that stands in two files.
    """
    tables: dict[str, dict[str, Any]] = {}
    for file in sorted(resources.files("stiction.contact").joinpath(folder).iterdir(), key=lambda file: file.name):
        if not file.name.endswith(".toml"):
            continue
        content = tomllib.loads(file.read_text(encoding="utf-8"))
        for name, table in content.pop(kind).items():
            if name in tables:
                raise ValueError(f"{kind}: {name} stands in two files")
            shared = {key: value | table.get(key, {}) for key, value in content.items() if isinstance(value, dict)}
            tables[name] = content | table | shared
    return tables
