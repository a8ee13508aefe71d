"""Read case files: TOML files that describe a contact and the loads or separations to solve."""

import tomllib
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import prod
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.case.addresses import roughness_in, with_numbers
from stiction.case.case_tables import case_tables
from stiction.case.distribution import Distribution, is_scipy_law
from stiction.case.own_materials import naming_materials_file, with_materials_of_file, with_own_materials
from stiction.case.study_tables import study_tables
from stiction.case.swept import Address, SweptNumber, points_of, swept_numbers
from stiction.case.uncertain import (
    SAMPLE,
    Uncertain,
    Uncertainty,
    at_bodies,
    named,
    uncertain_numbers,
    with_ranges,
)
from stiction.contact.contact import Contact
from stiction.contact.subject import Subject
from stiction.laws.proportion import input_warnings
from stiction.quantities.dimensions import dimensions, variable
from stiction.quantities.errors import InputError, InputWarning, field_below
from stiction.quantities.inputs import require_names
from stiction.quantities.paths import read_text
from stiction.quantities.table import QUANTITIES
from stiction.solving.choice import LAWS, Choice
from stiction.surfaces.finished import is_finished
from stiction.surfaces.measured import Measured, roughness_of

if TYPE_CHECKING:
    import xarray

    from stiction.quantities.arguments import FilePath

_CASE_FILE = "a TOML case file"
_LARGEST_FILE = 10**7  # bytes; no case file is larger, so a larger file was named by mistake


@dataclass(frozen=True)
class Case:
    """Store a case as read from a case file: a contact, the points to solve, the model and the uncertain inputs.

    title: text, "" if not specified. subject: a Contact, or dimensionless Indices. Its swept numbers are arrays with named
    dimensions, its uncertain numbers have their nominal values. separation, load: the points to solve, one of them an array
    (n,) and the other None. For a Contact the units are m and N. For Indices, separations are h = d/sigma and loads are per
    asperity, divided by K R^(1/2) sigma^(3/2). If sigma is swept, separations specified as multiples of sigma are an array with
    named dimensions. choice: the model with its laws and options. uncertain: uncertain numbers with their distributions.
    uncertainty: how they are sampled. swept: arrays of the swept numbers by address (tuple of keys). points: separations as
    written in the file; None without separations.
    """

    title: str
    subject: Subject
    separation: "np.ndarray | xarray.DataArray | None"
    load: np.ndarray | None
    choice: Choice
    uncertain: tuple[Uncertain, ...] = ()
    uncertainty: Uncertainty = field(default_factory=lambda: Uncertainty(**{}))
    swept: Mapping[Address, Any] = field(default_factory=dict, repr=False)
    points: Any = field(default=None, repr=False)

    @property
    def tables(self) -> dict[str, Subject]:
        """Return the subject under the name of its table, "contact" or "indices"; addresses begin with this name."""
        return {"contact" if isinstance(self.subject, Contact) else "indices": self.subject}

    def at(self, numbers: Mapping[Address, Any]) -> "Case":
        """Return a copy of the case with the entries at some addresses replaced.

        numbers: new entries by address (tuple of keys): SI numbers, arrays with named dimensions, or names such as "gold".
        Raises InputError for an entry that is not allowed.
        """
        (subject,) = with_numbers(self.tables, numbers).values()
        points = None if self.separation is None else self.points
        return replace(self, subject=subject, separation=_separations(points, subject))

    @property
    def requested_points(self) -> dict[str, Any]:
        """Return the loads of the case, or its mean separations if it has no loads, as a keyword argument of `solve`."""
        return {"separation": self.separation} if self.load is None else {"load": self.load}

    @property
    def unknowns(self) -> dict[str, list[Uncertain]]:
        """Return lists of uncertain numbers by sample dimension; numbers of one dimension are sampled at the same quantiles."""
        by_dimension: dict[str, list[Uncertain]] = {}
        for number in self.uncertain:
            by_dimension.setdefault(number.dimension, []).append(number)
        return by_dimension

    def numbers_at(self, levels: np.ndarray) -> dict[Address, Any]:
        """Return all swept numbers, and the uncertain numbers at given quantile levels, as arrays by address (tuple of keys).

        levels: quantile levels (n, k), one column for each of the k dimensions in `unknowns`. The values of uncertain numbers
        are arrays along the dimension `sample` of length n, in SI units, without coordinates, which would only take time.
        """
        columns = dict(zip(self.unknowns, levels.T, strict=True))
        samples = {number.path: variable([SAMPLE], number.at(columns[number.dimension])) for number in self.uncertain}
        return {**self.swept, **samples}

    @property
    def measured(self) -> Measured | None:
        """Return the roughness measured from scans; None if the case names no scans."""
        return self.subject.measured

    @property
    def is_swept(self) -> bool:
        """Return whether any number of the contact is swept (an array instead of a single number)."""
        return any(True for _ in self.subject.arrays())

    @property
    def size(self) -> int:
        """Return the number of points to solve: loads or separations, summed over all contacts of a parameter sweep."""
        (points,) = self.requested_points.values()
        contacts = prod(dimensions([*(array for _, array in self.subject.arrays()), points]).values())
        return contacts if hasattr(points, "dims") else contacts * np.size(points)

    @property
    def by_method(self) -> dict[str, Contact]:
        """Return the contact with the roughness that each asperity method finds in its scans, by method; {} without scans."""
        if self.measured is None or not isinstance(self.subject, Contact):
            return {}
        return self.measured.contacts(self.subject)

    def at_load(self, load: Any) -> "Case":
        """Return a copy of the case with one load as its only point; the case itself if `load` is None.

        load: in N, text with a unit, or dimensionless for Indices. Raises InputError, with the field --load, for a wrong load.
        """
        if load is None:
            return self
        try:
            value = float(self.subject.read(load, "load"))
        except InputError as error:
            raise InputError("--load", error.value, error.allowed) from None
        except (TypeError, ValueError):
            raise InputError("--load", load, "a single load") from None
        return replace(self, separation=None, load=np.array([value]))

    def with_surface_moments(self, model: str) -> "Case":
        """Return the case with the roughness parameters that the model with the key `model` needs.

        For a measured surface, models of the whole surface use its spectral moments instead of the roughness that an asperity
        method finds.
        """
        from stiction.solving.problem import with_surface_moments

        return replace(self, subject=with_surface_moments(self.subject, model))


def read_case(path: "FilePath", *, ranges: bool | None = None) -> Case:
    r"""Read a case file.

    Parameters
    ----------
    path : path
        TOML file. Paths of scans and of materials files are relative to its folder.
    ranges : bool, optional
        Whether material presets vary within their stated ranges. None uses the setting in the file.

    Returns
    -------
    Case
        Contact, points, model and uncertain numbers, for `solve_case`, `compare_case`, `slide_case` and `predict`.

    Raises
    ------
    InputError
        The file cannot be read or is not TOML, a key is unknown, or a number is missing, without unit or out of bounds.

    Notes
    -----
    An InputWarning names inputs that are unlikely for a rough surface, e.g. a roughness of one metre.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "case.toml"
    >>> _ = path.write_text("indices = { theta = 40, lam = 10 }\nsolve = { load = [1.0, 2.0] }")
    >>> st.read_case(path).load
    array([1., 2.])
    """
    return parse_case(_with(read_content(path), ranges), Path(path).parent)


def as_case(given: Any, ranges: bool | None = None) -> Case:
    """Return a Case from a Case, the path of a case file, or a dict of its tables.

    ranges: whether material presets vary within their stated ranges; None uses the setting in the case. The argument is ignored
    for a Case. Relative paths in a dict start at the current folder. Raises the InputErrors of `read_case`.
    """
    if isinstance(given, Case):
        return given
    return parse_case(_with(given, ranges)) if isinstance(given, Mapping) else read_case(given, ranges=ranges)


def _with(content: Mapping, ranges: bool | None) -> Mapping:
    if ranges is None or not isinstance(content.get("uncertainty", {}), Mapping):
        return content
    return {**content, "uncertainty": {**content.get("uncertainty", {}), "ranges": ranges}}


def read_content(path) -> dict[str, Any]:
    """Return the tables of a TOML file without checking their contents.

    path: path of the file. Raises InputError if it cannot be read or is not TOML.
    """
    if not isinstance(path, str | PathLike):
        raise InputError("case", path, "the path of a case file; most functions also accept its tables as a dict")
    text = read_text(Path(path), "case file", _CASE_FILE, _LARGEST_FILE)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _not_a_case(path, f"this is not TOML: {error}") from None
    except (ValueError, RecursionError):  # tomllib raises these for numbers of thousands of digits and for very deep lists
        raise _not_a_case(path, "this file has a number too long to read, or nests too deeply") from None


def tables_of(given: Any) -> tuple[Mapping[str, Any], Path]:
    """Return the unchecked tables of a case, and the folder at which the relative paths in them start.

    given: path of a case file, or a dict of its tables, whose paths start at the current folder. Raises InputError if the file
    cannot be read or is not TOML.
    """
    return (given, Path()) if isinstance(given, Mapping) else (read_content(given), Path(given).parent)


def _tables(path) -> Mapping:
    """Return the tables of the TOML file at this path; raise InputError if it is unreadable or a number lacks its unit."""
    content = read_content(path)
    refuse_bare_numbers(content, "")
    return content


def refuse_bare_numbers(table: Mapping, path: str) -> None:
    """Raise InputError if a number in a table, or in a nested table, needs a unit and has none.

    path: dotted name of the table, e.g. "contact.coating"; "" for all tables of a case. `solve.load`, and lists outside tables
    named `range`, are checked later, when they are read.
    """
    for key, value in table.items():
        where = f"{path}.{key}" if path else key
        if isinstance(value, Mapping):
            refuse_bare_numbers(value, where)
        elif where != "solve.load" and not _is_exempt(value, path) and key in QUANTITIES and QUANTITIES[key].unit:
            raise InputError(where, value, QUANTITIES[key].as_text)


def _is_exempt(value: Any, path: str) -> bool:
    """Return whether an entry of a case file needs no check for a missing unit: it is text, a list or a distribution.

    Lists are checked later, when they are read; in a table `range`, only a list of texts needs no check. Distributions made in
    Python are in SI units. path: dotted name of the table with the entry.
    """
    if isinstance(value, list):
        return path.rpartition(".")[2] != "range" or all(isinstance(end, str) for end in value)
    return isinstance(value, str | Distribution) or is_scipy_law(value)


def parse_case(content: Mapping, folder: Path = Path()) -> Case:
    """Return the Case that these tables describe, and warn of unlikely inputs.

    content: tables of a case file. folder: folder at which relative paths of scans and of materials files start. Raises the
    InputErrors of `read_case`. An InputWarning names unlikely inputs.
    """
    case = case_in(content, folder)
    for warning in input_warnings(case.subject):
        warnings.warn(warning, InputWarning, stacklevel=2)
    return case


def case_in(content: Mapping, folder: Path = Path()) -> Case:
    """Return the Case that these tables describe, without warnings of unlikely inputs.

    content: tables of a case file. folder: folder at which relative paths of scans and of materials files start. For the
    warnings, call `input_warnings(case.subject)`. Raises the InputErrors of `read_case`.
    """
    require_names(content)
    content, swept = with_files_read(content, folder)
    uncertain = named([number for number in swept.values() if isinstance(number, Uncertain)])
    arrays = {path: number.array(number.numbers()) for path, number in swept.items() if not isinstance(number, Uncertain)}
    return replace(case_of(content, arrays), uncertain=tuple(uncertain), swept=arrays)


def with_files_read(content: Mapping, folder: Path) -> tuple[Mapping, dict[Address, SweptNumber]]:
    """Read all files that a case names; return the tables of the case, and its swept and uncertain numbers by address.

    An address is a tuple of keys. folder: base folder of relative paths. In the tables, names of user-defined materials
    are replaced by the materials, scans by the roughness measured from them, swept numbers by their first value, and uncertain
    numbers by their nominal value. Raises InputError for an invalid entry or file.
    """
    refuse_bare_numbers(content, "")
    numbers: dict[Address, SweptNumber] = dict(swept_numbers(content))
    with naming_materials_file(content):
        file = content.get("materials")
        content = with_materials_of_file(content, folder, _tables)
        uncertain = uncertain_numbers(content, folder, (folder / file).parent if isinstance(file, str) else folder)
        used = {number.path: number for number in at_bodies(uncertain, content)}
        nominal = {path: float(number.values[0]) for path, number in (numbers | uncertain).items()}
        content = with_own_materials(with_numbers(content, nominal))
    content = _measured(content, folder)
    _refuse_beside_scans(content, numbers, used)
    if wants_ranges(content):
        used |= {number.path: number for number in with_ranges(content, [*numbers, *used])}
    return content, numbers | {number.path: number for number in named(list(used.values()))}


def with_single_numbers(content: Mapping[str, Any], folder: Path, allowed: str) -> tuple[Mapping, dict[Address, Uncertain]]:
    """Return the tables of a case without tables of studies, after reading all files, and its uncertain numbers by address.

    An address is a tuple of keys. folder: base folder of relative paths. allowed: text for the error, which states what is
    allowed in place of a list of values. Raises InputError if a number is swept.
    """
    content, numbers = with_files_read(without_studies(content), folder)
    uncertain = {}
    for path, number in numbers.items():
        if not isinstance(number, Uncertain):
            raise InputError(number.where, number.words, f"a single number; {allowed}")
        uncertain[path] = number
    return content, uncertain


def without_studies(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of a case without the tables of studies, such as [design] and [fit]."""
    return {key: value for key, value in content.items() if key not in study_tables()}


def wants_ranges(content: Mapping) -> bool:
    """Return whether the tables of a case set `uncertainty.ranges`, so that presets vary within their stated ranges."""
    table = content.get("uncertainty", {})
    return isinstance(table, Mapping) and table.get("ranges") is True


def _refuse_beside_scans(content: Mapping, swept: Mapping, uncertain: Mapping[Address, Uncertain]) -> None:
    """Raise InputError if scans define the roughness and a roughness parameter is swept or uncertain too.

    content: tables of the case after reading all files. swept, uncertain: swept and uncertain numbers by address (tuple of
    keys).
    """
    if getattr(roughness_in(content), "measured", None) is None:
        return
    for path, number in {**swept, **uncertain}.items():
        if path[:2] == ("contact", "roughness"):
            raise InputError(number.where, number.words, "a single number, because scans define the roughness")


def case_of(content: Mapping, numbers: Mapping[Address, Any] | None = None) -> Case:
    """Return the Case that these tables describe, after replacing the entries at some addresses.

    content: tables of a case, which name no files. numbers: SI numbers or arrays with named dimensions by address (tuple of
    keys). Raises InputError for an entry that is missing or not allowed.
    """
    file = case_tables()(**with_numbers(content, numbers or {}))
    subject = file.contact or file.indices
    assert subject is not None  # validated by case_tables
    solve = file.solve
    return Case(
        title=file.title,
        subject=subject,
        separation=_separations(solve.separation, subject),
        points=solve.separation,
        load=points_of(solve.load, "load", subject, "solve.load"),
        choice=Choice.of(solve.model, solve.options | {name: getattr(solve, name) for name in LAWS if name != "model"}),
        uncertainty=file.uncertainty or Uncertainty(**{}),
    )


def _separations(points: Any, subject: Subject) -> Any:
    return points_of(points, "mean_separation", subject, "solve.separation")


def _measured(content: Mapping, folder: Path) -> Mapping:
    """Return the tables of a case with scans replaced by the roughness measured from them.

    folder: folder at which relative paths of scans start. Tables without scans are returned unchanged.
    """
    surface = roughness_in(content)
    if not (isinstance(surface, Mapping) and surface.keys() & {"first", "second"}) or is_finished(surface):
        return content
    with field_below("contact.roughness"):
        return {**content, "contact": {**content["contact"], "roughness": roughness_of(surface, folder)}}


def _not_a_case(path, why: str) -> InputError:
    return InputError("case file", str(path), f"{_CASE_FILE}; {why}")
