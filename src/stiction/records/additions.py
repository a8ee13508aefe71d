"""Find the kinds of laws that go beside a model, without importing one: the folders of `laws` that have a file kind.py."""

from functools import cache
from importlib import import_module
from pathlib import Path


@cache
def names_of_additions() -> dict[str, str]:
    """Return what each kind is, in words, by its keyword, which is the name of its folder."""
    folders = sorted(path.parent.name for path in (Path(__file__).parents[1] / "laws").glob("*/kind.py"))
    return {name: import_module(f"stiction.laws.{name}").__doc__ or "" for name in folders}
