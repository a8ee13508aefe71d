"""Define the table [design] of a case file: its keys and their checks."""

from typing import Any, Literal

from pydantic import Field, model_validator

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input, Seed


class Objective(Input):
    """Define an objective of a design: minimise a result, maximise it, or bring it close to a target value."""

    minimise: str | None = Field(None, description="the name of a result")
    maximise: str | None = Field(None, description="the name of a result")
    target: str | None = Field(None, description="the name of a result")
    value: str | float | None = Field(None, description="with target: the value, with its unit")

    @model_validator(mode="after")
    def _one_of_them(self):
        given = [name for name in ("minimise", "maximise", "target") if getattr(self, name) is not None]
        if len(given) != 1:
            raise InputError("", given or None, 'one of minimise, maximise, target, e.g. { minimise = "friction_coefficient" }')
        if (self.target is None) != (self.value is None):
            raise InputError("value", self.value, "a value with target; no value with minimise or maximise")
        return self

    @property
    def quantity(self) -> str:
        return str(self.minimise or self.maximise or self.target)

    @property
    def words(self) -> str:
        return (
            f"{self.quantity} next to {self.value}"
            if self.target
            else f"{'least' if self.minimise else 'most'} {self.quantity}"
        )


class Design(Input):
    """Define the table [design] of a case file: choices, objectives and constraints of a design search.

    objective: one objective, or a list of two. choose: by name, numbers of the contact or the load with their low and high
    ends, or lists from which one entry is chosen. limits: by name, results with their low or high ends. validity: "claimed"
    allows validity warnings about statistics only, "possible" all except those that make a result impossible, "any" allows all.
    effort: largest number of generations of the search.
    """

    objective: Any = Field(description='an objective, { minimise = "friction_coefficient" }, or a list of two')
    choose: dict[str, Any] = Field(description="a table of numbers of the contact with their ends, or lists")
    limits: dict[str, Any] = Field(default_factory=dict, description="a table of results, each with its low or high end")
    validity: Literal["claimed", "possible", "any"] = Field("claimed", description="claimed, possible, any")
    effort: int = Field(60, ge=1, le=10_000, strict=True, description="generations of the search, 1 to 10000")
    seed: Seed = 0


TABLE = (Design, "choices and objectives of `stiction design`")
