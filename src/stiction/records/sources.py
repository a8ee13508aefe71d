"""Describe the source of an equation or number, and read the bibliography of the package."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from stiction.quantities.errors import InputError, nearest


@dataclass(frozen=True)
class Source:
    """Describe the source of one equation, number or idea.

    - key: key of the BibTeX entry, in sources.bib or in the field `entries` of a record
    - where: place in the source, such as "eq. (2)", "table 1" or "p. 12"; "" for the whole work
    - note: what was corrected (an erratum) or reconstructed; "" if the source is used as published
    """

    key: str
    where: str
    note: str = ""

    def __str__(self) -> str:
        place = f"{self.key}, {self.where}" if self.where else self.key
        return f"{place} ({self.note})" if self.note else place


# An entry of the bibliography runs from "@type{key," at the start of a line to a closing brace alone on a line.
ENTRY = re.compile(r"^@(?P<kind>\w+)\{(?P<key>[^,\s]+),$(?P<fields>.*?)^\}$", re.MULTILINE | re.DOTALL)

_NAMED = re.compile(r"\[(\w+)\]")


@cache
def _entries() -> dict[str, str]:
    text = files("stiction.records").joinpath("sources.bib").read_text(encoding="utf-8")
    return {entry["key"]: entry[0] for entry in ENTRY.finditer(text)}


def bibliography() -> dict[str, str]:
    """Return the BibTeX text of every entry in the package's bibliography by key, in the order of the file."""
    return dict(_entries())


def keys_in(text: str) -> list[str]:
    """Return the keys of the bibliography that a text names in brackets, such as "[briscoe_evans_1982]".

    Each key is listed once, in the order of the text.
    """
    return [key for key in dict.fromkeys(_NAMED.findall(text)) if key in _entries()]


def bibtex(keys: Iterable[str], more: Mapping[str, str] = MappingProxyType({})) -> str:
    """Return the BibTeX entries of these keys as the text of a .bib file; "" for no keys.

    keys: keys of the bibliography or of `more`, in any order and with repetitions. more: BibTeX text of further entries by key.
    The entries are in the order of the bibliography, then of `more`, separated by blank lines. An entry in `more` replaces an
    entry of the bibliography with the same key. Raises InputError for an unknown key.
    """
    wanted = set(keys)
    entries = _entries() | dict(more)
    unknown = sorted(wanted - entries.keys())
    if unknown:
        raise InputError("source", unknown[0], nearest(unknown[0], entries))
    return "".join(f"{text}\n\n" for key, text in entries.items() if key in wanted).removesuffix("\n")
