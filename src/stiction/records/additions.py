"""Find the kinds of laws that can be added to a model, such as menisci: every folder of `laws` that has a file kind.py."""

from functools import cache
from importlib import import_module
from pathlib import Path


@cache
def names_of_additions() -> dict[str, str]:
    """Return the description of each kind of law that can be added to a model, by keyword, such as "meniscus".

    The keyword is the name of the folder in `laws`, and the description the docstring of its `__init__.py`. No law is imported.
    """
    folders = sorted(path.parent.name for path in (Path(__file__).parents[1] / "laws").glob("*/kind.py"))
    return {name: import_module(f"stiction.laws.{name}").__doc__ or "" for name in folders}
