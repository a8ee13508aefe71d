"""Read the data files of the package: TOML files with tables [KIND.NAME] and defaults for them at the top."""

import tomllib
from importlib import resources
from typing import Any

# Meaning of the grades of numbers.
GRADES = {
    "A": "measured on such an interface or surface; the printed number was read",
    "B": "derived from printed numbers that were read; the spread is a judgement",
    "C": "from memory, not checked against a page",
}


def read_tables(room: str, folder: str, kind: str) -> dict[str, dict[str, Any]]:
    """Return the TOML tables [kind.NAME] of all files in a data folder, as a dict by NAME.

    room: package that holds the folder, such as "contact". Entries at the top of a file are defaults for all tables in that
    file; nested tables are merged field by field. Raises ValueError if a NAME occurs in two files.
    """
    tables: dict[str, dict[str, Any]] = {}
    for file in sorted(resources.files(f"stiction.{room}").joinpath(folder).iterdir(), key=lambda file: file.name):
        if not file.name.endswith(".toml"):
            continue
        content = tomllib.loads(file.read_text(encoding="utf-8"))
        for name, table in content.pop(kind).items():
            if name in tables:
                raise ValueError(f"{kind}: {name} stands in two files")
            shared = {key: value | table.get(key, {}) for key, value in content.items() if isinstance(value, dict)}
            tables[name] = content | table | shared
    return tables
