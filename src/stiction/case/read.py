"""Case files: one TOML file that says what is in contact and what is to be solved."""

import tomllib
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field, create_model, model_validator

from stiction.case.bare_numbers import refuse_bare_numbers
from stiction.case.own_materials import telling_the_file, with_materials_of_file, with_own_materials
from stiction.case.places import roughness_in, with_numbers, with_roughness
from stiction.case.several import Address, Points, Several, numbers_schema, points_of, several_numbers
from stiction.case.study_tables import study_tables
from stiction.case.uncertain import (
    FORMS,
    SAMPLE,
    Uncertain,
    Uncertainty,
    named,
    placed,
    uncertain_numbers,
    with_ranges,
)
from stiction.contact.contact import Body, Contact, Indices
from stiction.contact.subject import Subject
from stiction.laws.proportion import input_warnings
from stiction.quantities.errors import InputError, InputWarning, field_as
from stiction.quantities.inputs import Input, require_names
from stiction.quantities.paths import read_text
from stiction.records.additions import names_of_additions
from stiction.records.registry import all_options
from stiction.solving.choice import DEFAULT_MODEL, LAWS, Choice
from stiction.surfaces.finished import Finished, FinishedBodies, is_finished
from stiction.surfaces.measured import Measured, MeasuredRoughness, measure

if TYPE_CHECKING:
    from stiction.quantities.arguments import FilePath

_CASE_FILE = "a TOML case file"
_SOLVE = "a table with separation or load"
_LARGEST_FILE = 10**7  # bytes; no case is that long, and a file that is was not meant


@dataclass(frozen=True)
class Case:
    """Hold the contents of a case file.

    subject: the Contact or the Indices; swept numbers are arrays with named dimensions. separation, load: points, one is an
    array (n,) and the other None; metres and newtons for a Contact, h = d/sigma and load per K R^(1/2) sigma^(3/2) and
    asperity for Indices. If sigma is swept and separations are over it, they are a labelled array. choice: the model, other
    laws and options, as in the registry. uncertain: uncertain numbers, whose nominal values are in the subject; uncertainty:
    how they are sampled. several: address -> array of the swept numbers. points: separations as written, which may be over
    sigma.
    """

    title: str
    subject: Subject
    separation: Any
    load: np.ndarray | None
    choice: Choice
    uncertain: tuple[Uncertain, ...] = ()
    uncertainty: Uncertainty = field(default_factory=lambda: Uncertainty(**{}))
    several: Mapping[Address, Any] = field(default_factory=dict, repr=False)
    points: Any = field(default=None, repr=False)

    @property
    def tables(self) -> dict[str, Subject]:
        """Return the subject under the key of its table: addresses of numbers begin with it."""
        return {"contact" if isinstance(self.subject, Contact) else "indices": self.subject}

    def at(self, numbers: Mapping[Address, Any]) -> "Case":
        """Return the case with these entries at their addresses: SI floats, labelled arrays, names. Raises InputError."""
        (subject,) = with_numbers(self.tables, numbers).values()
        points = None if self.separation is None else self.points
        return replace(self, subject=subject, separation=_separations(points, subject))

    @property
    def unknowns(self) -> dict[str, list[Uncertain]]:
        """Return the names of the uncertain numbers; numbers that are sampled together count as one."""
        found: dict[str, list[Uncertain]] = {}
        for one in self.uncertain:
            found.setdefault(one.dimension, []).append(one)
        return found

    def numbers_at(self, shares: np.ndarray) -> dict[Address, Any]:
        """Return the entries of swept and uncertain numbers, address -> entry.

        shares: (n, k), quantile levels of the k `unknowns`, in their order; their values are arrays along `sample`.
        """
        columns = list(self.unknowns)
        at = {one.path: one.array(one.at(shares[:, columns.index(one.dimension)]), SAMPLE) for one in self.uncertain}
        return {**self.several, **at}

    @property
    def measured(self) -> Measured | None:
        """Return the measured roughness if the case names scans, else None."""
        return self.subject.measured

    @property
    def is_several(self) -> bool:
        """Whether numbers of the contact are several."""
        return any(True for _ in self.subject.arrays())

    @property
    def by_method(self) -> dict[str, Contact]:
        """The contact with the roughness that each way of finding asperities gives, if it is measured; else nothing."""
        if self.measured is None or not isinstance(self.subject, Contact):
            return {}
        return self.measured.contacts(self.subject)

    def at_load(self, load: Any) -> "Case":
        """Return the case at this load only. Raises InputError."""
        try:
            value = float(self.subject.read(load, "load"))
        except InputError as error:
            raise InputError("--load", error.value, error.allowed) from None
        except (TypeError, ValueError):
            raise InputError("--load", load, "one load") from None
        return replace(self, separation=None, load=np.array([value]))

    def with_surface_moments(self, model: str) -> "Case":
        """Return the case for the model of this key: theories of the whole surface use no asperity methods."""
        from stiction.solving.problem import with_surface_moments

        return replace(self, subject=with_surface_moments(self.subject, model))


class _Solve(Input):
    """The points of the curve, as mean separations or as loads, and how to compute it."""

    separation: Points = Field(None, description="mean separations: in sigma, or lengths with a unit")
    load: Points = Field(None, description="loads: forces with a unit, or plain numbers for [indices]")
    model: str | None = Field(None, description=f"key of a model, see `stiction models`; by default {DEFAULT_MODEL}")
    asperity: str | None = Field(None, description="key of an asperity law in place of the model's own, see `stiction models`")
    tangential: str | None = Field(None, description="key of a tangential law in place of the model's own, or none")
    film: str | None = Field(None, description="key of a film law, see `stiction models`")
    options: dict[str, str] = Field(
        default_factory=dict, description="options of the model or of a law, which may also stand here"
    )

    @model_validator(mode="before")
    @classmethod
    def _options_by_name(cls, given):
        """Options may stand among the keys of the table, as they are called in the records."""
        if not isinstance(given, Mapping):
            return given
        given = dict(given)
        if not given.keys() - cls.model_fields.keys():
            return given
        known = all_options()
        named = {name: given.pop(name) for name in known if name in given}
        for name, value in named.items():
            if value not in known[name]:
                raise InputError(name, value, ", ".join(known[name]))
        return given | {"options": {**named, **given.get("options", {})}}

    @model_validator(mode="after")
    def _one_kind_of_points(self):
        if (self.separation is None) == (self.load is None):
            both = "both" if self.load is not None else None
            example = "separation = {start = 4, stop = -1, count = 51}"
            raise InputError("separation or load", both, f"one of them, e.g. {example}")
        return self


class _CaseFile(Input):
    """The tables of a case file: [contact] or [indices], [solve], those of studies of it, and materials of its own."""

    title: str = Field("", description="text: what reports and pictures call the case")
    materials: dict[str, Body] | str = Field(
        default_factory=dict, description="tables of numbers by name, or the name of a file beside the case that has them"
    )
    contact: Contact | None = None
    indices: Indices | None = None
    solve: _Solve = Field(description=_SOLVE)
    uncertainty: Uncertainty | None = Field(None, description="a table: how numbers that are uncertain are drawn")

    @model_validator(mode="after")
    def _one_subject(self):
        if (self.contact is None) == (self.indices is None):
            both = "both" if self.contact is not None else None
            raise InputError("contact or indices", both, "one of the tables [contact] and [indices]")
        return self


@cache
def _case_file() -> type[_CaseFile]:
    """Return the form of a case file with the tables of every study."""
    tables: dict[str, Any] = {
        name: (form | None, Field(None, description=f"a table: {description}"))
        for name, (form, description) in study_tables().items()
    }
    described = {name: f"key of a law of {text}" for name, text in names_of_additions().items()}
    beside: dict[str, Any] = {name: (str | None, Field(None, description=text)) for name, text in described.items()}
    tables["solve"] = (create_model("_Solve", __base__=_Solve, __doc__=_Solve.__doc__, **beside), Field(description=_SOLVE))
    return create_model("_CaseFile", __base__=_CaseFile, __doc__=_CaseFile.__doc__, **tables)


def read_case(path: "FilePath", *, ranges: bool | None = None) -> Case:
    """Read a case file.

    Parameters
    ----------
    path : path
        TOML file; scans and files of materials are looked for in its folder.
    ranges : bool, optional
        Whether numbers of material presets vary within their ranges, in place of what the file states.

    Returns
    -------
    Case
        Contact, points, model and uncertain numbers, for `solve_case`, `compare_case`, `slide_case` and `predict`.

    Raises
    ------
    InputError
        The file cannot be read or is no TOML, a key is not known, or a number is missing, without unit or out of bounds.

    Notes
    -----
    It warns (InputWarning) of numbers that are no rough surface, e.g. a roughness of one metre.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import stiction as st
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "case.toml"
    >>> _ = path.write_text("indices = { theta = 40, lam = 10 }\\nsolve = { load = [1.0, 2.0] }")
    >>> st.read_case(path).load
    array([1., 2.])
    """
    return parse_case(_with(read_content(path), ranges), Path(path).parent)


def as_case(given: Any, ranges: bool | None = None) -> Case:
    """Return the case of a path, of tables, or the case itself.

    ranges: as in `read_case`, for paths and tables. Raises InputError.
    """
    if isinstance(given, Case):
        return given
    return parse_case(_with(given, ranges)) if isinstance(given, Mapping) else read_case(given, ranges=ranges)


def _with(content: Mapping, ranges: bool | None) -> Mapping:
    if ranges is None or not isinstance(content.get("uncertainty", {}), Mapping):
        return content
    return {**content, "uncertainty": {**content.get("uncertainty", {}), "ranges": ranges}}


def read_content(path) -> dict[str, Any]:
    """Return the unchecked tables of a TOML file. Raises InputError if it cannot be read or is not TOML."""
    if not isinstance(path, str | PathLike):
        raise InputError("case", path, "the path of a case file, or its tables as a dict")
    text = read_text(Path(path), "case file", _CASE_FILE, _LARGEST_FILE)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _not_a_case(path, f"this is not TOML: {error}") from None
    except (ValueError, RecursionError):  # a number of thousands of digits, lists nested without end
        raise _not_a_case(path, "this one is out of all proportion") from None


def tables_of(given: Any) -> tuple[Mapping[str, Any], Path]:
    """Return the unchecked tables of a case, a path or a dict, and the folder its files are relative to. Raises InputError."""
    return (given, Path()) if isinstance(given, Mapping) else (read_content(given), Path(given).parent)


def _tables(path) -> Mapping:
    """Return the tables of a TOML file, with the unit of every number that needs one."""
    content = read_content(path)
    refuse_bare_numbers(content, "")
    return content


def parse_case(content: Mapping, folder: Path = Path()) -> Case:
    """Return the case of the tables of a TOML file.

    folder: of scans and files of materials. Raises InputError as `read_case` does.
    """
    case = case_in(content, folder)
    for warning in input_warnings(case.subject):
        warnings.warn(warning, InputWarning, stacklevel=2)
    return case


def case_in(content: Mapping, folder: Path = Path()) -> Case:
    """Return the case without warnings; callers pass its subject to `input_warnings`."""
    require_names(content)
    content, several = opened(content, folder)
    uncertain = named([one for one in several.values() if isinstance(one, Uncertain)])
    arrays = {path: one.array(one.numbers()) for path, one in several.items() if not isinstance(one, Uncertain)}
    return replace(case_of(content, arrays), uncertain=tuple(uncertain), several=arrays)


def opened(content: Mapping, folder: Path) -> tuple[Mapping, dict[Address, Several]]:
    """Return the tables with own materials and scanned roughness, and the swept numbers.

    A swept number has its first value in the tables. Raises InputError.
    """
    refuse_bare_numbers(content, "")
    numbers: dict[Address, Several] = dict(several_numbers(content))
    with telling_the_file(content):
        file = content.get("materials")
        content = with_materials_of_file(content, folder, _tables)
        found = uncertain_numbers(content, folder, (folder / file).parent if isinstance(file, str) else folder)
        used = {one.path: one for one in placed(found, content)}
        nominal = {path: float(one.values[0]) for path, one in (numbers | found).items()}
        content = with_own_materials(with_numbers(content, nominal))
    content = _measured(content, folder)
    _refuse_beside_scans(content, numbers, used)
    if wants_ranges(content):
        used |= {one.path: one for one in with_ranges(content, [*numbers, *used])}
    return content, numbers | {one.path: one for one in named(list(used.values()))}


def without_studies(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables without those of studies of many contacts."""
    return {key: value for key, value in content.items() if key not in study_tables()}


def wants_ranges(content: Mapping) -> bool:
    """Whether numbers of materials vary within their ranges, as the tables say."""
    table = content.get("uncertainty", {})
    return isinstance(table, Mapping) and table.get("ranges") is True


def _refuse_beside_scans(content: Mapping, several: Mapping, uncertain: Mapping[Address, Uncertain]) -> None:
    """InputError where a number of the roughness is several, or uncertain, that was measured."""
    if getattr(roughness_in(content), "measured", None) is None:
        return
    for path, one in {**several, **uncertain}.items():
        if path[:2] == ("contact", "roughness"):
            raise InputError(one.where, one.words, "one number, where scans say the roughness")


def case_of(content: Mapping, numbers: Mapping[Address, Any] | None = None) -> Case:
    """Return the case of these tables with other numbers, floats or labelled arrays, in their places. Raises InputError."""
    file = _case_file()(**with_numbers(content, numbers or {}))
    subject = file.contact or file.indices
    assert subject is not None  # the validator of _CaseFile has seen to it
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
    """Replace scans in the tables by their roughness; tables without scans are returned unchanged."""
    surface = roughness_in(content)
    if not (isinstance(surface, Mapping) and surface.keys() & {"first", "second"}) or is_finished(surface):
        return content
    with field_as(lambda field: "contact." + (field if field.startswith("roughness") else f"roughness.{field}")):
        return with_roughness(content, measure(MeasuredRoughness(**surface), folder).roughness())


def json_schema() -> dict:
    """Return the JSON schema of a case file, with units and bounds, for editors."""
    schema = _case_file().model_json_schema()
    schema["title"] = "stiction case"
    schema["oneOf"] = [{"required": ["contact"]}, {"required": ["indices"]}]
    forms: tuple[type[Input], ...] = (MeasuredRoughness, Finished, FinishedBodies)
    for form in forms:
        table = form.model_json_schema(ref_template="#/$defs/{model}")
        schema["$defs"] |= table.pop("$defs", {}) | {form.__name__: table}
    roughness = schema["$defs"]["Contact"]["properties"]["roughness"]
    others = ({"$ref": f"#/$defs/{form.__name__}"} for form in forms)
    schema["$defs"]["Contact"]["properties"]["roughness"] = {"anyOf": [roughness, *others]}
    schema["$defs"]["_Solve"]["properties"] |= {
        name: {"description": "option of a model or of a law", "enum": list(values)} for name, values in all_options().items()
    }
    numbers_schema(schema, FORMS)
    schema["$defs"]["_Solve"]["oneOf"] = [{"required": ["separation"]}, {"required": ["load"]}]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def _not_a_case(path, why: str) -> InputError:
    return InputError("case file", str(path), f"{_CASE_FILE}; {why}")
