"""Define the class Record, which describes a model or law, and find records by kind and key.

A record is the constant RECORD of a module. The module is named after the key of the record and lies in the folder of its kind.
Other packages can provide records through entry points.
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
    """Describe one model or law: its sources, its claims and its inputs. A subclass for each kind of law adds the formulas.

    - kind: name of the kind, such as "film", and of the folder with its records; room: subpackage that contains this folder
    - keyword: argument of `st.solve` that selects a record of this kind, "" if none does
    - key: name of the record, such as "greenwood_williamson_1966"; title: a phrase that describes it
    - grade: a key of GRADES; sources: origin of each equation; verified: what its numbers were checked against
    - needs, takes: dimensionless groups that the model requires, and those that it uses if they are known
    - validity, limits: ranges in which it is valid, and cases in which it agrees with another model
    - own_options: allowed values of each option, by name, the default first
    - load_is_monotonic: whether, in the source, a compressive load always decreases with growing separation
    - accuracy: relative accuracy of sums over asperities; coarser if kinks of the law are located numerically
    - notes: remarks for users
    - entries: BibTeX by key, for sources that are not in the package's bibliography
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
    load_is_monotonic: bool = True
    accuracy: float = 1e-10
    notes: str = ""
    entries: Mapping[str, str] = field(default_factory=dict)

    @property
    def options(self) -> Mapping[str, tuple[str, ...]]:
        """Return the allowed values of every option of the model or law, by name, the default first."""
        return self.own_options

    def parts(self, options: Mapping[str, str]) -> list["Record"]:
        """Return the records of the laws that these options add to this one; a result must cite them too.

        options: chosen values by option name. The base class returns no record.
        """
        return []


_R = TypeVar("_R", bound="Record")


def _package(kind: type[Record]) -> str:
    """Return the name of the Python package that contains the records of a kind, such as "stiction.laws.film" for FilmLaw."""
    return f"stiction.{kind.room}.{kind.kind.replace(' ', '_')}"


_LONG = 10.0  # seconds that a plug-in may take to be imported before a notice names it


@cache
def _from_plug_ins() -> tuple[tuple[Record, str], ...]:
    """Return every usable record in the installed plug-in packages, each with the name of its module.

    The user gets a notice for each plug-in that cannot be used, and for each whose import takes longer than 10 seconds.
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
            problem = _why_unusable(record, [other for other, _ in loaded])
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # the code of a plug-in may raise anything
            problem = " ".join(f"{type(error).__name__}: {error}".split())
        finally:
            slow.cancel()
        if problem:
            notice(f"{name} is ignored: {problem}")
        else:
            loaded.append((record, entry.module))
    return tuple(loaded)


def _why_unusable(record: object, others: list[Record]) -> str:
    """Return the reason, as text, why an object from a plug-in cannot be used as a record; "" if it can.

    others: records of the plug-ins loaded before it. Within one kind, neither their keys nor the keys of this package may be
    repeated.
    """
    if not isinstance(record, Record) or not hasattr(record, "kind"):
        return f"it is a {type(record).__name__}, not a record of a law"
    if not isinstance(record.key, str) or not record.key.isidentifier():
        return f"key = {record.key!r}; allowed: letters, digits and underscores"
    ours = importlib.util.find_spec(f"{_package(type(record))}.{record.key}") is not None
    if ours or any(other.kind == record.kind and other.key == record.key for other in others):
        return f"key = {record.key!r}; allowed: a key that no other law or method of this kind ({record.kind}) has"
    return ""


def plug_in_error(error: BaseException) -> InputError | None:
    """Return an InputError that names the plug-in whose code raised an exception; None if no code of a plug-in was running."""
    modules = {str(frame.f_globals.get("__name__")) for frame, _ in traceback.walk_tb(error.__traceback__)}
    packages = {module.partition(".")[0] for module in modules}
    for record, module in _from_plug_ins():
        if module.partition(".")[0] in packages:
            cause = f"{type(error).__name__}: {error}"
            return InputError(record.keyword or record.kind, record.key, f"a law that works; its plug-in raised {cause}")
    return None


@cache
def _from_package(folder: str) -> tuple[Record, ...]:
    """Return the records in all modules of a Python package; folder: name of the package, such as "stiction.laws.film"."""
    package = importlib.import_module(folder)
    names = [info.name for info in pkgutil.iter_modules(package.__path__, f"{folder}.")]
    modules = [importlib.import_module(name) for name in names]
    return tuple(module.RECORD for module in modules if hasattr(module, "RECORD"))


def of_kind(kind: type[_R]) -> dict[str, _R]:
    """Return all records of one kind by key, in alphabetical order, including records of plug-ins; kind: a class."""
    everybody = (*(record for record, _ in _from_plug_ins()), *_from_package(_package(kind)))
    matches = [record for record in everybody if isinstance(record, kind) and record.kind == kind.kind]
    return {record.key: record for record in sorted(matches, key=lambda record: record.key)}


def find(key: str, kind: type[_R]) -> _R:
    """Return the record with this key and kind; raise InputError, with the known keys, if there is none.

    kind: a class, such as FilmLaw. Only the module of the record is imported, unless the record is in a plug-in.
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
    """Return the documentation of a record as Markdown: equations, sources, assumptions and reconstructions.

    It is the docstring of the module that defines the record, in this package or in a plug-in; "" if there is none.
    """
    name = f"{_package(type(record))}.{record.key}"
    if record.key.isidentifier() and importlib.util.find_spec(name) is not None:
        module = importlib.import_module(name)
        if getattr(module, "RECORD", None) is record:
            return inspect.getdoc(module) or ""
    for other, where in _from_plug_ins():
        if other is record:
            return inspect.getdoc(importlib.import_module(where)) or ""
    return ""
