"""One model's record, and where records are found: the file of their name in the folder of their kind, and entry points."""

import importlib
import importlib.util
import inspect
import pkgutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import entry_points
from typing import ClassVar, TypeVar

from stiction.quantities.errors import InputError
from stiction.quantities.notices import notice
from stiction.records.claims import Limit, Validity
from stiction.records.sources import Source


@dataclass(frozen=True, kw_only=True)
class Record:
    """Describe one model; each kind adds what it computes.

    kind: what it is, in words; its folder has this name, in this room. keyword: by which a user chooses one, "" if nobody
    does. key: author_year, or a name. grade: see GRADES. verified: what the numbers were checked against. needs: names of the
    groups it depends on; takes: other groups, which count where they are given.
    own_options: option name -> allowed values, the first is the default. load_falls: the source's load falls
    with growing separation wherever it is compressive. accuracy: sums are good to this, relative to each law's own; larger
    where kinks of a law are found by scanning. notes: remarks for the user. entries: bibliography entries that the
    package does not have, key -> BibTeX.
    """

    kind: ClassVar[str]
    room: ClassVar[str] = "laws"
    keyword: ClassVar[str] = ""
    key: str
    title: str
    grade: str
    sources: tuple[Source, ...]
    verified: str
    needs: tuple[str, ...] = ()
    takes: tuple[str, ...] = ()
    validity: tuple[Validity, ...] = ()
    limits: tuple[Limit, ...] = ()
    own_options: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    load_falls: bool = True
    accuracy: float = 1e-10
    notes: str = ""
    entries: Mapping[str, str] = field(default_factory=dict)

    @property
    def options(self) -> Mapping[str, tuple[str, ...]]:
        """Return every option of the record: name -> allowed values, the first is the default."""
        return self.own_options

    def parts(self, options: Mapping[str, str]) -> list["Record"]:
        """Return other records that these options use; they have to be cited, too."""
        return []


_R = TypeVar("_R", bound="Record")


def _package(kind: type[Record]) -> str:
    """Return the folder with the records of a kind."""
    return f"stiction.{kind.room}.{kind.kind.replace(' ', '_')}"


@cache
def _outside() -> tuple[tuple[Record, str], ...]:
    """Return the records of other distributions, each with its module; name those that cannot be loaded."""
    found = []
    for entry in entry_points(group="stiction"):
        try:
            record = entry.load()
            problem = "" if isinstance(record, Record) else f"it is {type(record).__name__}, no record of a law"
        except (Exception, SystemExit) as error:  # somebody else's code may raise anything
            problem = " ".join(f"{type(error).__name__}: {error}".split())
        if problem:
            notice(f"the plug-in {entry.name} ({entry.value}) is left out: {problem}")
        else:
            found.append((record, entry.module))
    return tuple(found)


@cache
def _inside(folder: str) -> tuple[Record, ...]:
    """Return the records of one folder of this package."""
    package = importlib.import_module(folder)
    modules = [importlib.import_module(one.name) for one in pkgutil.iter_modules(package.__path__, f"{folder}.")]
    return tuple(module.RECORD for module in modules if hasattr(module, "RECORD"))


def of_kind(kind: type[_R]) -> dict[str, _R]:
    """Load the records of one kind, in alphabetical order: key -> record."""
    everybody = (*(record for record, _ in _outside()), *_inside(_package(kind)))  # of two with one key ours is the last
    found = [one for one in everybody if isinstance(one, kind) and one.kind == kind.kind]
    return {one.key: one for one in sorted(found, key=lambda one: one.key)}


def find(key: str, kind: type[_R]) -> _R:
    """Return the record of this key and kind, or raise InputError.

    A record of the package is in the file of its name, so that no other has to be loaded.
    """
    module = f"{_package(kind)}.{key}"
    if isinstance(key, str) and key.isidentifier() and importlib.util.find_spec(module) is not None:
        record = getattr(importlib.import_module(module), "RECORD", None)
        if isinstance(record, kind):
            return record
    known = of_kind(kind)
    if not isinstance(key, str) or key not in known:
        raise InputError(kind.keyword or kind.kind, key, ", ".join(known))
    return known[key]


def text_of(record: Record) -> str:
    """Return the documentation of a record: equations with sources, assumptions, reconstructions; Markdown.

    It is the docstring of the module in which the record stands, of this package or of the project that brought it; "" if that
    has none.
    """
    name = f"{_package(type(record))}.{record.key}"
    if record.key.isidentifier() and importlib.util.find_spec(name) is not None:
        module = importlib.import_module(name)
        if getattr(module, "RECORD", None) is record:
            return inspect.getdoc(module) or ""
    for other, where in _outside():
        if other is record:
            return inspect.getdoc(importlib.import_module(where)) or ""
    return ""
