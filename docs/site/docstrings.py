"""Docstrings of the project as Markdown.

They are paragraphs, in which what is said of an argument begins a line with its name and a colon. Here each of those becomes an
item of a list.
"""

import re
from collections.abc import Collection, Iterator

_SAYS = re.compile(r"^(\*{0,2}[a-z_]\w*(?:, [a-z_]\w*)*)(?=: )", re.IGNORECASE)
_NUMBERS = "Numbers, each with its SI unit:"
_BLOCK = re.compile(r"^(?: {4}|[-|>]|\d+\. |```)")


def as_markdown(text: str, names: Collection[str] = ()) -> str:
    """The docstring as Markdown. names: those whose lines become items of a list."""
    return "\n\n".join(_paragraph(one, names) for one in re.split(r"\n\s*\n", text.strip()))


def _paragraph(text: str, names: Collection[str]) -> str:
    lines = text.split("\n")
    every = lines[0] == _NUMBERS
    if _BLOCK.match(lines[0]) or not any(_told(line, names, every) for line in lines):
        return text
    return "\n".join(_items(lines, names, every))


def _items(lines: list[str], names: Collection[str], every: bool) -> Iterator[str]:
    inside = False
    for at, line in enumerate(lines):
        found = _told(line, names, every)
        if found:
            if at and not inside:
                yield ""
            inside = True
            told = ", ".join(f"`{name}`" for name in found[1].split(", "))
            yield f"- {told}{line[found.end() :]}"
        else:
            yield f"  {line}" if inside else line


def _told(line: str, names: Collection[str], every: bool) -> re.Match | None:
    """What a line is about, if that is names of arguments (or any name, with `every`)."""
    found = _SAYS.match(line)
    known = found and (every or all(name.lstrip("*") in names for name in found[1].split(", ")))
    return found if known else None


def summary(text: str) -> str:
    """The first sentence, or line."""
    first = re.split(r"\n\s*\n", text.strip())[0].replace("\n", " ")
    return re.split(r"(?<=[a-z)\]`])\. ", first)[0]


def cell(text: str) -> str:
    """A text in a cell of a table."""
    return " ".join(text.split()).replace("|", "\\|")
