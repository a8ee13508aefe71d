"""Find the tables that studies read from a case file."""

import importlib
import importlib.util
import pkgutil
from collections.abc import Mapping
from functools import cache
from typing import Any

from stiction.quantities.errors import InputError, field_below
from stiction.quantities.inputs import Input


@cache
def study_tables() -> dict[str, tuple[type[Input], str]]:
    """Return the form and the description of every study's table by its key.

    A study that reads a table has a file `table.py` with `TABLE = (form, description)`; the name of its folder is the key.
    They are found by their place, as laws are, so that this room imports no study.
    """
    studies = importlib.import_module("stiction.studies")
    modules = {one.name: f"{studies.__name__}.{one.name}.table" for one in pkgutil.iter_modules(studies.__path__) if one.ispkg}
    return {name: importlib.import_module(path).TABLE for name, path in modules.items() if importlib.util.find_spec(path)}


def study_table(content: Mapping[str, Any], name: str, wanted: str) -> Any:
    """Return the table of a study in a case, checked; wanted: what such a table has. Raises InputError."""
    table = content.get(name)
    if not isinstance(table, Mapping):
        raise InputError(name, table, wanted)
    with field_below(name):
        return study_tables()[name][0](**table)
