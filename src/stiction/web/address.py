"""Pack a case into the address of the page, and read it back.

The tables of a case are nested dicts, as they are read from a case file in TOML.
"""

import base64
import binascii
import tomllib
import zlib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from stiction.case.addresses import roughness_in
from stiction.case.text import as_toml
from stiction.quantities.errors import InputError, InWords

_LONGEST = 20_000  # characters, largest length of an address
_LARGEST = 200_000  # bytes, largest size of the case in an address
_STATE = "a case, as this page writes it into its address"


def encoded(tables: Mapping[str, Any]) -> str:
    """Return the tables of a case as compressed text for the address of the page; "" if it exceeds 20,000 characters."""
    text = base64.urlsafe_b64encode(zlib.compress(as_toml(tables).encode(), 9)).decode().rstrip("=")
    return text if len(text) <= _LONGEST else ""


def decoded(text: str) -> dict[str, Any]:
    """Return the tables of a case from the text of an address, the inverse of `encoded`.

    Raises InputError for damaged text, for more than 20,000 characters, or for a case larger than 200,000 bytes.
    """
    if len(text) > _LONGEST:
        raise InputError("address", InWords(f"{len(text)} characters"), f"at most {_LONGEST} characters")
    try:
        raw = base64.b64decode(text + "=" * (-len(text) % 4), altchars=b"-_", validate=True)
        unzipping = zlib.decompressobj()
        content = unzipping.decompress(raw, _LARGEST)
        if unzipping.unconsumed_tail or not unzipping.eof:
            raise InputError("address", InWords("a case that is cut off or too large"), _STATE)
        return tomllib.loads(content.decode())
    except InputError:
        raise
    except (binascii.Error, zlib.error, ValueError, RecursionError):  # not base64, not zlib, not UTF-8, not TOML
        raise InputError("address", text[:40], _STATE) from None


def files_named(tables: Mapping[str, Any]) -> list[str]:
    """Return the paths of all files that a case names: materials, scans, height maps, samples and measured series.

    tables: nested dicts, as read from a case file.
    """
    found = [tables["materials"]] if isinstance(tables.get("materials"), str) else []
    rough = roughness_in(tables)
    if isinstance(rough, Mapping):
        found += [rough[body] for body in ("first", "second") if isinstance(rough.get(body), str)]
    sweep = tables.get("sweep")
    maps = sweep.get("roughness") if isinstance(sweep, Mapping) else None
    found += [name for name in maps if isinstance(name, str)] if isinstance(maps, list) else []
    return [*found, *_files_in(tables)]


def _files_in(value: Any) -> Iterator[str]:
    """Yield the file paths under the keys "file", "samples" and "data" of nested dicts and lists."""
    if isinstance(value, Mapping):
        yield from (str(value[key]) for key in ("file", "samples", "data") if isinstance(value.get(key), str))
        for one in value.values():
            yield from _files_in(one)
    elif isinstance(value, list):
        for one in value:
            yield from _files_in(one)


def refuse_other_files(tables: Mapping[str, Any], allowed: Iterable[str]) -> None:
    """Raise InputError if a case names a file that is not among the allowed ones.

    Anybody can write an address, so an address must not give access to other files of this machine. tables: nested dicts, as
    read from a case file. allowed: paths of the files of the served case and of uploaded files.
    """
    known = set(allowed)
    for name in files_named(tables):
        if name not in known:
            there = ", ".join(sorted(Path(name).name for name in known)) or "none"  # folders of this machine stay hidden
            raise InputError("file", name, f"a file of the served case, or an uploaded file (now: {there})")
