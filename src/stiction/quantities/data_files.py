"""Read the data files of the package: TOML files with tables [KIND.NAME] and shared default entries at the top."""

import tomllib
from importlib import resources
from typing import Any

# Grade -> reliability of a number in a data file.
GRADES = {
    "A": "measured on such an interface or surface; the printed number was read",
    "B": "derived from printed numbers that were read; the spread is a judgement",
    "C": "from memory, not checked against a page",
}


def read_tables(subpackage: str, folder: str, kind: str) -> dict[str, dict[str, Any]]:
    """Return the TOML tables [kind.NAME] of all files in a data folder, as a dict NAME -> table.

    - subpackage: name of the subpackage of stiction that contains the folder, such as "contact"
    - folder: name of the folder, such as "material_data"
    - kind: first part of the table names, such as "materials"

    Entries at the top of a file are defaults for all tables in that file. A default that is itself a table is merged with the
    table's own entry field by field. Raises ValueError if a NAME occurs in two files.
    """
    tables: dict[str, dict[str, Any]] = {}
    for file in sorted(resources.files(f"stiction.{subpackage}").joinpath(folder).iterdir(), key=lambda file: file.name):
        if not file.name.endswith(".toml"):
            continue
        content = tomllib.loads(file.read_text(encoding="utf-8"))
        for name, table in content.pop(kind).items():
            if name in tables:
                raise ValueError(f"{kind}: {name} occurs in two files")
            shared = {key: value | table.get(key, {}) for key, value in content.items() if isinstance(value, dict)}
            tables[name] = content | table | shared
    return tables
