"""The pages of the public names: every name of `stiction`, from its docstring."""

import inspect
import re
from collections.abc import Iterator
from enum import Enum
from pathlib import Path, PurePosixPath
from typing import Any

from docstrings import as_markdown, summary
from pydantic import BaseModel

import stiction as st

# What the public names are for; every name stands in exactly one group (held by a test).
GROUPS = {
    "A contact": ("Contact", "Roughness", "Coating", "Material", "Liquid", "material", "work_of_adhesion", "Indices", "axis",
                  "height_distribution"),
    "Friction": ("predict", "predict_value", "export", "solve", "unload", "slide", "evaluate", "Evaluation", "summary"),
    "Case files": ("read_case", "solve_case", "compare_case", "slide_case", "write_report"),
    "Studies": ("compare", "sensitivity", "sweep", "fit", "design", "validate", "film_stresses"),
    "Measured surfaces": ("read_scan", "HeightMap", "prepared", "analyse", "asperities", "resolution_study",
                          "combined_spectrum", "gaussian_surface", "non_gaussian_surface", "SelfAffine"),
    "Models, interfaces and sources": ("models", "interfaces", "cite", "show_config"),
    "Errors and warnings": ("InputError", "InputWarning"),
}  # fmt: skip
_EMPTY = inspect.Parameter.empty


def write(out: Path) -> list[PurePosixPath]:
    """A page for each name, and their list."""
    folder = out / "reference" / "names"
    folder.mkdir(parents=True)
    lines = ["# Public names", "", "This page lists all names that are available after `import stiction as st`.", ""]
    for title, names in GROUPS.items():
        lines += [f"## {title}", "", "| name | meaning |", "|---|---|"]
        for name in names:
            thing = getattr(st, name)
            lines.append(f"| [`{name}`]({page_name(name)}) | {summary(inspect.getdoc(thing) or '')} |".replace("`|`", "`\\|`"))
            (folder / page_name(name)).write_text("\n".join(page(name, thing)) + "\n", encoding="utf-8")
        lines += ["", ":::{toctree}", ":hidden:", "", *map(page_name, names), ":::", ""]
    (folder / "index.md").write_text("\n".join(lines), encoding="utf-8")
    return []


def page_name(name: str) -> str:
    """The file of a name's page: some differ from another by a capital letter only, which some disks do not tell apart."""
    return f"{name}{'-class' * name[0].isupper()}.md"


def page(name: str, thing: Any) -> Iterator[str]:
    """The page of one public name."""
    yield from (f"# `{name}`", "")
    kind = "exception" if _is(thing, Exception) else "class" if inspect.isclass(thing) else "function"
    yield f"::::::{{py:{kind}}} stiction.{name}{_signature(thing)}"
    yield ":single-line-parameter-list:" if kind == "function" and len(_parameters(thing)) < 4 else ""
    yield from ("", as_markdown(inspect.getdoc(thing) or "", _names(thing), "../../"), "")
    if inspect.isclass(thing):
        for member, value in _members(thing):
            yield from _member(member, value)
    yield "::::::"


def _is(thing: Any, kind: type) -> bool:
    return inspect.isclass(thing) and issubclass(thing, kind)


def _parameters(thing: Any) -> list[inspect.Parameter]:
    """The parameters that a user may give."""
    if _is(thing, Exception) or _is(thing, Enum):
        return []
    found = [one for one in inspect.signature(thing).parameters.values() if not one.name.startswith("unnamed")]
    return [one for one in found if one.name != "self"]


def _names(thing: Any) -> set[str]:
    return {one.name for one in _parameters(thing)}


def _signature(thing: Any) -> str:
    """Names and defaults; what each may be the text says."""
    if _is(thing, Exception):
        return ""
    shown, last = [], None
    for one in _parameters(thing):
        if one.kind is one.KEYWORD_ONLY and last not in (one.KEYWORD_ONLY, one.VAR_POSITIONAL):
            shown.append("*")
        stars = {one.VAR_POSITIONAL: "*", one.VAR_KEYWORD: "**"}.get(one.kind, "")
        shown.append(f"{stars}{one.name}" + ("" if one.default is _EMPTY else f"={_default(one.default)}"))
        last = one.kind
    return f"({', '.join(shown)})"


def _default(value: Any) -> str:
    plain = value is None or isinstance(value, (str, int, float, bool, tuple, list))
    return repr(value) if plain else "..."


def _members(thing: type) -> Iterator[tuple[str, Any]]:
    """What a class adds to what it is made of, if it is public and says what it is."""
    for name, value in vars(thing).items():
        skipped = name.startswith("_") or name in vars(BaseModel) or name in getattr(thing, "model_fields", ())
        if not skipped and _told(value) and (callable(value) or isinstance(value, (property, classmethod, staticmethod))):
            yield name, value


def _told(value: Any) -> str:
    inner = getattr(value, "__func__", value)
    return getattr(inner, "__doc__", None) or ""


def _member(name: str, value: Any) -> Iterator[str]:
    if isinstance(value, property):
        yield from (f":::::{{py:property}} {name}", "", as_markdown(inspect.getdoc(value) or "", (), "../../"), "", ":::::", "")
        return
    inner = getattr(value, "__func__", value)
    signature = re.sub(r"^\((?:self|cls)(?:, )?", "(", _signature(inner))
    yield from (
        f":::::{{py:method}} {name}{signature}",
        "",
        as_markdown(inspect.getdoc(inner) or "", _names(inner), "../../"),
        "",
    )
    yield from (":::::", "")
