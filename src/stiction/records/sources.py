"""Describe sources of equations and numbers, and read the bibliography of the package."""

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

    key: entry of sources.bib. where: place in the source, such as "eq. (2)", "table 1" or "p. 12"; "" for the whole work.
    note: what was corrected (an erratum) or reconstructed; "" if it is used as printed.
    """

    key: str
    where: str
    note: str = ""

    def __str__(self) -> str:
        place = f"{self.key}, {self.where}" if self.where else self.key
        return f"{place} ({self.note})" if self.note else place


# An entry runs from its "@type{key," at the start of a line to a closing brace alone on a line.
ENTRY = re.compile(r"^@(?P<kind>\w+)\{(?P<key>[^,\s]+),$(?P<fields>.*?)^\}$", re.MULTILINE | re.DOTALL)


@cache
def _entries() -> dict[str, str]:
    text = files("stiction.records").joinpath("sources.bib").read_text(encoding="utf-8")
    return {entry["key"]: entry[0] for entry in ENTRY.finditer(text)}


def bibliography() -> dict[str, str]:
    """Return the BibTeX text of every entry of the bibliography by key, in alphabetical order."""
    return dict(_entries())


def bibtex(keys: Iterable[str], more: Mapping[str, str] = MappingProxyType({})) -> str:
    """Return the BibTeX of these keys as the text of a .bib file; "" for no keys.

    keys: keys of the bibliography; repeated keys are written once. more: further entries, BibTeX by key. Entries are in the
    order of the bibliography, with a blank line between two. Raises InputError for an unknown key.
    """
    wanted = set(keys)
    entries = _entries() | dict(more)
    unknown = sorted(wanted - entries.keys())
    if unknown:
        raise InputError("source", unknown[0], nearest(unknown[0], entries))
    return "".join(f"{text}\n\n" for key, text in entries.items() if key in wanted).removesuffix("\n")
