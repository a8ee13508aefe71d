"""Define the data model that checks the tables of a case file, and its JSON schema."""

from collections.abc import Mapping
from functools import cache
from typing import Any

from pydantic import Field, create_model, model_validator

from stiction.case.study_tables import study_tables
from stiction.case.swept import Points, numbers_schema
from stiction.case.uncertain import FORMS, Uncertainty
from stiction.contact.contact import Body, Contact, Indices
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import Input
from stiction.records.additions import names_of_additions
from stiction.records.registry import all_options
from stiction.solving.choice import DEFAULT_MODEL
from stiction.surfaces.finished import Finished, FinishedBodies
from stiction.surfaces.measured import MeasuredRoughness

_SOLVE = "a table with separation or load"


_OF_SOLVE = ("contact", "heights", "threads")  # other keywords of `solve`


class _Solve(Input):
    """Define the table [solve]: mean separations or loads to solve, the model and its options."""

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
    def _options_by_name(cls, table):
        """Move options of models and laws specified directly in [solve] to its table `options`, and return [solve].

        If an option is in both places, the value in `options` is used. Any argument that is not a table is returned unchanged.
        Raises InputError for an option specified directly with a value that it does not allow. It also raises InputError if
        `options` has a key of [solve], or one of the arguments contact, heights and threads of `solve`.
        """
        if not isinstance(table, Mapping):
            return table
        table, own = dict(table), table.get("options", {})
        for name in own if isinstance(own, Mapping) else ():
            if name in cls.model_fields or name in _OF_SOLVE:
                raise InputError(f"options.{name}", own[name], f"an option of a model or law; write {name} in [solve]")
        if not table.keys() - cls.model_fields.keys():
            return table  # without loading all models
        known = all_options()
        named = {name: table.pop(name) for name in known if name in table}
        for name, value in named.items():
            if value not in known[name]:
                raise InputError(name, value, ", ".join(known[name]))
        return table | {"options": {**named, **table.get("options", {})}}

    @model_validator(mode="after")
    def _one_kind_of_points(self):
        if (self.separation is None) == (self.load is None):
            both = InWords("both given") if self.load is not None else None
            example = "separation = {start = 4, stop = -1, count = 51}"
            raise InputError("separation and load", both, f"exactly one of the two, e.g. {example}")
        return self


class _CaseFile(Input):
    """Define the tables of a case file: [contact] or [indices], [solve], [materials.NAME], [uncertainty], tables of studies."""

    title: str = Field("", description="text: what reports and pictures call the case")
    materials: dict[str, Body] | str = Field(
        default_factory=dict, description="tables of material properties by name, or the path of a file with such tables"
    )
    contact: Contact | None = None
    indices: Indices | None = None
    solve: _Solve = Field(description=_SOLVE)
    uncertainty: Uncertainty | None = Field(None, description="a table: how uncertain numbers are sampled")

    @model_validator(mode="after")
    def _one_subject(self):
        if (self.contact is None) == (self.indices is None):
            both = InWords("both given") if self.contact is not None else None
            raise InputError("contact and indices", both, "exactly one of the tables [contact] and [indices]")
        return self


@cache
def case_tables() -> type[_CaseFile]:
    """Return the class that checks the tables of a case file: `_CaseFile` extended by the tables of all studies.

    Its table [solve] also accepts one key for each kind of additional law, such as `meniscus`.
    """
    tables: dict[str, Any] = {
        name: (form | None, Field(None, description=f"a table: {description}"))
        for name, (form, description) in study_tables().items()
    }
    described = {name: f"key of a law of {text}" for name, text in names_of_additions().items()}
    beside: dict[str, Any] = {name: (str | None, Field(None, description=text)) for name, text in described.items()}
    tables["solve"] = (create_model("_Solve", __base__=_Solve, __doc__=_Solve.__doc__, **beside), Field(description=_SOLVE))
    return create_model("_CaseFile", __base__=_CaseFile, __doc__=_CaseFile.__doc__, **tables)


def json_schema() -> dict:
    """Return the JSON schema of a case file, with units and bounds of all numbers.

    Editors use the schema to complete and check case files.
    """
    schema = case_tables().model_json_schema()
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
