"""Convert BibTeX entries to printed references: authors, title, journal, year and link."""

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

from stiction.records.sources import ENTRY
from stiction.solving.overview import entries

_FIELD = re.compile(r"^\s*(\w+)\s*=\s*\{(.*)\},?$", re.MULTILINE)
_ACCENTS = {'"': "\u0308", "'": "\u0301", "`": "\u0300", "^": "\u0302", "~": "\u0303", "v": "\u030c", "c": "\u0327"}
_ACCENT = re.compile(r"""\\(["'`^~]|[vc]\s)\s*\{?\\?([A-Za-z])\}?""")
_LETTERS = {r"\kappa": "κ", r"\ss": "ß", r"\o": "ø", r"\&": "&", "---": " – ", "``": "“", "''": "”", "--": "–", "~": " "}
_LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


@dataclass(frozen=True)
class Printed:
    """Store one printed reference: bibliography key, text, and DOI ("" if no DOI was verified)."""

    key: str
    text: str
    doi: str


def printed(keys: Iterable[str]) -> list[Printed]:
    """Return the printed references of bibliography keys, in the order of the bibliography.

    Raises InputError for an unknown key.
    """
    return [_printed(entry["key"], entry["fields"]) for entry in ENTRY.finditer(entries(keys))]


def _printed(key: str, body: str) -> Printed:
    fields = {name: tex_to_text(text) for name, text in _FIELD.findall(body)}
    where = fields.get("journal") or fields.get("booktitle") or fields.get("publisher", "")
    volume = fields.get("volume", "") + (f" ({fields['number']})" if "number" in fields else "")
    place = ", ".join(filter(None, [f"{where} {volume}".strip(), fields.get("pages")]))
    authors = fields.get("author", "").replace(" and others", " et al.").replace(" and ", "; ")
    title, year = fields.get("title", ""), fields.get("year", "no year")
    who = [f"{authors} ({year})", title] if authors else [f"{title} ({year})"]
    parts = [*who, place, fields.get("note", "")]
    return Printed(key, ". ".join(part.rstrip(".") for part in parts if part) + ".", fields.get("doi", ""))


def tex_to_text(text: str) -> str:
    """Convert TeX to plain text: accented letters, no braces."""
    text = _ACCENT.sub(lambda match: unicodedata.normalize("NFC", match[2] + _ACCENTS[match[1].strip()]), text)
    text = re.sub(r"\$_(\d)\$", lambda match: match[1].translate(_LOW), text)
    for tex, letter in _LETTERS.items():
        text = text.replace(tex, letter)
    return re.sub(r"[{}$]", "", text)
