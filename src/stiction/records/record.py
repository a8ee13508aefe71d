"""Define the record that describes a model or law, and find records by kind and key.

A record is found in the file named after its key in the folder of its kind, or through an entry point of another package.
"""

import importlib
import importlib.util
import inspect
import pkgutil
import threading
import traceback
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
    """Describe one model or law. Each kind of record adds its formulas.

    - kind: name of the kind and of its folder; room: package with that folder
    - keyword: argument of `solve` that selects a record of this kind, "" if none does
    - key: author_year, or a name
    - grade: a key of GRADES
    - verified: what the numbers were checked against
    - needs, takes: dimensionless groups that the model requires, and those that it uses if they are given
    - validity, limits: ranges in which it is claimed, and limiting cases
    - own_options: allowed values of each option, the default first
    - load_falls: whether, in the source, a compressive load always decreases with growing separation
    - accuracy: relative accuracy of sums over asperities; coarser if kinks of the law are located numerically
    - notes: remarks for users
    - entries: BibTeX by key, for sources outside the package's bibliography
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
        """Return the allowed values of every option, the default first."""
        return self.own_options

    def parts(self, options: Mapping[str, str]) -> list["Record"]:
        """Return the records of the sub-models that these options select; a result must cite them too."""
        return []


_R = TypeVar("_R", bound="Record")


def _package(kind: type[Record]) -> str:
    """Return the name of the package that contains the records of a kind."""
    return f"stiction.{kind.room}.{kind.kind.replace(' ', '_')}"


_LONG = 10.0  # seconds that a plug-in may take to be imported before a notice names it


@cache
def _outside() -> tuple[tuple[Record, str], ...]:
    """Return all records of installed plug-in packages, each with the name of its module.

    A plug-in that cannot be used gives a notice, and so does one whose import takes long.
    """
    loaded: list[tuple[Record, str]] = []
    for entry in entry_points(group="stiction"):
        name = f"the plug-in {entry.name} ({entry.value})"
        slow = threading.Timer(
            _LONG, notice, [f"{name} is still being imported: interrupt and uninstall it if that does not end"]
        )
        slow.daemon = True
        slow.start()
        try:
            record = entry.load()
            problem = _problem(record, [other for other, _ in loaded])
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # somebody else's code may raise anything
            problem = " ".join(f"{type(error).__name__}: {error}".split())
        finally:
            slow.cancel()
        if problem:
            notice(f"{name} is ignored: {problem}")
        else:
            loaded.append((record, entry.module))
    return tuple(loaded)


def _problem(record: object, others: list[Record]) -> str:
    """Return why an object from a plug-in cannot be used as a record; "" if it can. others: records of earlier plug-ins."""
    if not isinstance(record, Record) or not hasattr(record, "kind"):
        return f"it is a {type(record).__name__}, not a record of a law"
    if not isinstance(record.key, str) or not record.key.isidentifier():
        return f"key = {record.key!r}; allowed: letters, digits and underscores"
    ours = importlib.util.find_spec(f"{_package(type(record))}.{record.key}") is not None
    if ours or any(other.kind == record.kind and other.key == record.key for other in others):
        return f"key = {record.key!r}; allowed: a key that no other law or method of this kind ({record.kind}) has"
    return ""


def plug_in_error(error: BaseException) -> InputError | None:
    """Return an error in one line that names the plug-in whose code raised an exception; None if no plug-in did."""
    modules = {str(frame.f_globals.get("__name__")) for frame, _ in traceback.walk_tb(error.__traceback__)}
    packages = {module.partition(".")[0] for module in modules}
    for record, module in _outside():
        if module.partition(".")[0] in packages:
            said = f"{type(error).__name__}: {error}"
            return InputError(record.keyword or record.kind, record.key, f"a law that works; its plug-in raised {said}")
    return None


@cache
def _inside(folder: str) -> tuple[Record, ...]:
    """Return the records of all modules in one package."""
    package = importlib.import_module(folder)
    names = [info.name for info in pkgutil.iter_modules(package.__path__, f"{folder}.")]
    modules = [importlib.import_module(name) for name in names]
    return tuple(module.RECORD for module in modules if hasattr(module, "RECORD"))


def of_kind(kind: type[_R]) -> dict[str, _R]:
    """Return all records of one kind by key, in alphabetical order."""
    everybody = (*(record for record, _ in _outside()), *_inside(_package(kind)))
    matches = [record for record in everybody if isinstance(record, kind) and record.kind == kind.kind]
    return {record.key: record for record in sorted(matches, key=lambda record: record.key)}


def find(key: str, kind: type[_R]) -> _R:
    """Return the record with this key and kind; raise InputError if there is none.

    Only the module of the record is imported, if it belongs to this package.
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
    """Return the documentation of a record as Markdown: equations with sources, assumptions, reconstructions.

    It is the docstring of the module that defines the record, in this package or in a plug-in; "" if there is none.
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
