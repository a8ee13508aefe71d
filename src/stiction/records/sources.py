"""The sources behind every equation, and the bibliography that ships with the package."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from stiction.quantities.errors import InputError


@dataclass(frozen=True)
class Source:
    """Where one equation, number or idea comes from.

    key: entry of sources.bib.
    where: place inside the source, such as "eq. (2)", "table 1" or "p. 12"; "" if it is the work as a whole.
    note: what was corrected (an erratum) or reconstructed, "" if it is used as printed.
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
    """Return all entries of the bibliography: key -> BibTeX text, keys in alphabetical order."""
    return dict(_entries())


def bibtex(keys: Iterable[str], more: Mapping[str, str] = MappingProxyType({})) -> str:
    """Return the BibTeX of the named entries as one text that can be saved as a .bib file.

    keys: keys of the bibliography, in any order; repeated keys are written once. more: further entries, key -> BibTeX.
    Returns the entries in the order of the bibliography, a blank line between two; "" for no keys.
    Raises InputError for a key that is in neither.
    """
    wanted = set(keys)
    entries = _entries() | dict(more)
    unknown = sorted(wanted - entries.keys())
    if unknown:
        raise InputError("source", unknown[0], "one of " + ", ".join(entries))
    return "".join(f"{text}\n\n" for key, text in entries.items() if key in wanted).removesuffix("\n")
