"""Find and check the tables that studies add to a case file, e.g. [fit] and [design]."""

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
    """Return every table that a study adds to a case file, by name: the class that checks it and its description.

    A study that reads a table has a module `table.py` with `TABLE = (class, description)`. The folder of the study names the
    table. Modules are found by their path, because `case` must not import `studies`.
    """
    studies = importlib.import_module("stiction.studies")
    modules = {
        module.name: f"{studies.__name__}.{module.name}.table"
        for module in pkgutil.iter_modules(studies.__path__)
        if module.ispkg
    }
    return {name: importlib.import_module(path).TABLE for name, path in modules.items() if importlib.util.find_spec(path)}


def study_table(content: Mapping[str, Any], name: str, wanted: str) -> Any:
    """Return the table `name` of a case, e.g. "fit", after checking it.

    content: tables of the case. wanted: what the table must contain, for the InputError if the table is missing.
    """
    table = content.get(name)
    if not isinstance(table, Mapping):
        raise InputError(name, table, wanted)
    with field_below(name):
        return study_tables()[name][0](**table)
