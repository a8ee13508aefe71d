"""Define the class Study, and list all studies of one case.

A study is a folder next to this file with a module `study.py` that defines STUDY.
"""

import importlib
import importlib.util
import pkgutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Study:
    """Describe a study of one case, which becomes the command `stiction NAME CASE.toml`.

    - name: name of the command
    - help: help text of the command
    - case: what the case file must contain, for the help
    - plan(case, **options): reads and checks the case file at the path `case`, and returns a plan without long computations.
      Its parameters are the options of the command. Shared options need no description: load, ranges, model, ..., `out` (folder
      for results, or None) and `options` (options of models and laws).
    - run(plan, progress): computes the results and returns the arguments of the view, the function FOLDER_view in
      report/views/FOLDER.py, where FOLDER is the name of the study's folder. Without this file, run returns a tuple with one
      dataset, which is shown as tables. A run with a parameter `callback` instead of `progress` receives a function that shows
      a text as progress.
    """

    name: str
    help: str
    case: str
    plan: Callable[..., Any]
    run: Callable[..., tuple[Any, ...]]


def studies() -> Iterator[tuple[str, Study]]:
    """Yield the folder name and the Study of every study."""
    folder = importlib.import_module(__package__)
    for module in pkgutil.iter_modules(folder.__path__, f"{folder.__name__}."):
        if module.ispkg and importlib.util.find_spec(f"{module.name}.study"):
            yield module.name.rpartition(".")[2], importlib.import_module(f"{module.name}.study").STUDY
