"""Define the table [fit] of a case file."""

from typing import Any

from pydantic import Field

from stiction.quantities.inputs import Input


class Fit(Input):
    """Define the table [fit] of a case file.

    free: numbers of the case that are fitted, by name, each with its low and high end. models: names of alternative models that
    are fitted too. predict: numbers of the contact, single or arrays, for which the fitted model predicts at the loads or
    separations of [solve]. specific_contact_resistance: contact resistance times contact area [ohm m^2], needed if resistance
    was measured and this number is not free.
    """

    free: dict[str, Any] = Field(description="a table of numbers of the case, each with its low and high end")
    models: list[str] = Field(default_factory=list, description="a list of names of models, as `stiction compare` shows them")
    predict: dict[str, Any] = Field(default_factory=dict, description="a table of numbers of the contact, one or several")
    specific_contact_resistance: str | None = Field(None, description='text with a unit, e.g. "1e-12 ohm m^2"')


TABLE = (Fit, "free parameters of `stiction fit`")
