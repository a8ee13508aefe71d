"""Docstrings of the project as Markdown.

They are paragraphs, in which what is said of an argument begins with its name and a colon. Here each becomes an item of
a list.
"""

import re
from collections.abc import Collection

from links import page_with

# What is said of an argument, or of several: their names at the beginning of a sentence, and a colon.
_SAYS = re.compile(r"(?:^|(?<=[.;)]) )(\*{0,2}[a-z_]\w*(?:, [a-z_]\w*)*): ", re.IGNORECASE)
_NUMBERS = "Numbers, each with its SI unit:"
_BLOCK = re.compile(r"^(?: {4}|[-|>]|\d+\. |```)")
# A section of the numpydoc standard, up to the next one.
_SECTION = re.compile(r"^([A-Z][A-Za-z ]+)\n-{3,}\n(.*?)(?=\n+[A-Z][A-Za-z ]+\n-{3,}\n|\Z)", re.MULTILINE | re.DOTALL)
_PAGE = re.compile(r"(?<![\w/])(?<!\]\()docs/(?:[\w-]+/)?([\w-]+)\.md")


def as_markdown(text: str, names: Collection[str] = (), root: str = "") -> str:
    """The docstring as Markdown. names: what is said of these becomes items of a list; root: the way to the pages of docs/."""
    said = "\n\n".join(_paragraph(one, names) for one in re.split(r"\n\s*\n", _flat(text)))
    if not root:
        return said
    return _PAGE.sub(lambda found: f"[{found[1]}]({root}{page_with(found[1]).relative_to('docs')})", said)


def _flat(text: str) -> str:
    """Write numpydoc sections as paragraphs: "name: meaning (type)", and examples as blocks of code."""
    return _SECTION.sub(lambda section: _as_paragraphs(section[1], section[2]), text.strip())


def _as_paragraphs(title: str, body: str) -> str:
    if title == "Notes":
        return body
    if title == "Examples":
        code, _, rest = body.partition("\n\n")
        return f"```python\n{code}\n```\n\n{rest}".strip()
    paragraphs = []
    for entry in re.split(r"\n(?=\S)", body):
        head, *lines = entry.strip().split("\n")
        name, _, kind = head.partition(" : ")
        meaning = " ".join(line.strip() for line in lines).rstrip(".")
        is_argument = title in ("Parameters", "Attributes")
        paragraphs.append(f"{name}: {meaning} ({kind})." if is_argument and kind else f"{title} `{head}`: {meaning}.")
    return "\n\n".join(paragraphs)


def _paragraph(text: str, names: Collection[str]) -> str:
    lines = text.split("\n")
    if _BLOCK.match(text):
        return text
    if lines[0] == _NUMBERS:
        return "\n".join(
            [_NUMBERS, "", *(f"- `{name}`: {rest}" for name, _, rest in (one.partition(": ") for one in lines[1:]))]
        )
    whole = " ".join(lines)
    before, said = _parted(whole, names)
    items = [f"- {_code(each)}: {words.rstrip(';')}" for each, words in said]
    return "\n".join([before, "", *items] if before else items) if items else text


def _parted(whole: str, names: Collection[str]) -> tuple[str, list[tuple[str, str]]]:
    """What stands before a paragraph's first argument; and of each, or of several, their names and what is said of them."""
    found = [one for one in _SAYS.finditer(whole) if all(name.lstrip("*") in names for name in one[1].split(", "))]
    ends = [*(one.start() for one in found[1:]), len(whole)][: len(found)]
    said = [(one[1], whole[one.end() : end].strip()) for one, end in zip(found, ends, strict=True)]
    return whole[: found[0].start()].strip() if found else whole, said


def said_of(text: str, name: str, names: Collection[str]) -> str:
    """What a docstring says of one of its arguments, `names` being all; nothing, if it is silent."""
    for one in re.split(r"\n\s*\n", _flat(text)):
        for each, words in _parted(" ".join(one.split("\n")), names)[1]:
            if name in each.split(", "):
                return words.rstrip(";.")
    return ""


def _code(names: str) -> str:
    return ", ".join(f"`{name}`" for name in names.split(", "))


def summary(text: str) -> str:
    """The first sentence, or line."""
    first = re.split(r"\n\s*\n", text.strip())[0].replace("\n", " ")
    return re.split(r"(?<=[a-z)\]`])\. ", first)[0]


def cell(text: str) -> str:
    """A text in a cell of a table."""
    return " ".join(text.split()).replace("|", "\\|")
