"""Find the studies of one case: the folders next to this file with a file `study.py` and its STUDY."""

import importlib
import importlib.util
import pkgutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Study:
    """A study of one case, the command `stiction NAME CASE.toml`.

    help: of the command, paragraphs. case: what the file has to have. plan(case, **options) -> plan, quick: it reads the case,
    given by its path, and its signature has the options of the command; `out`, the folder of the results or None, `options`,
    those of records, and others that commands share (load, ranges, model, ...) need no description. run(plan, progress) ->
    arguments of its view, which is a function FOLDER_view in report/views/FOLDER.py, or one dataset; a parameter `tell` in
    place of `progress` is called with sentences.
    """

    name: str
    help: str
    case: str
    plan: Callable[..., Any]
    run: Callable[..., tuple[Any, ...]]


def studies() -> Iterator[tuple[str, Study]]:
    """Yield the name of its folder and the declaration of every study that is a command."""
    folder = importlib.import_module(__package__)
    for one in pkgutil.iter_modules(folder.__path__, f"{folder.__name__}."):
        if one.ispkg and importlib.util.find_spec(f"{one.name}.study"):
            yield one.name.rpartition(".")[2], importlib.import_module(f"{one.name}.study").STUDY
