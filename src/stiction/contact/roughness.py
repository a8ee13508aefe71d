"""A rough surface by its asperities: given, or found in scans."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field, PrivateAttr, model_validator

from stiction.contact import measuring
from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input, Number

__all__ = ["Rough", "Roughness"]


def _parameter(value):
    numbers = np.asarray(value)
    if numbers.dtype.kind not in "iuf" or not np.isfinite(numbers).all():
        raise InputError("", value, "a finite number or a list of them")
    return numbers.astype(float).tolist()


_Parameter = Annotated[Any, BeforeValidator(_parameter, json_schema_input_type=float | list[float])]


class Roughness(Input):
    """The equivalent rough surface: asperities of one radius, with distributed heights (GW 1966).

    height_distribution: name of a height distribution; height_parameters: its parameters, e.g. {"shape":
    3.4}. surface: asperities with the spectral moments of the surface (McCool 1986), with Gaussian heights, which theories of
    the whole surface take in place of these; left out, they take these. Raises InputError.
    """

    asperity_height_deviation: Number
    asperity_radius: Number
    asperity_density: Number
    height_distribution: str = "gaussian"
    height_parameters: dict[str, _Parameter] = Field(default_factory=dict)
    surface: "Roughness | None" = Field(default=None, description="a table with sigma, R and N of a Gaussian surface")
    _measured: Any = PrivateAttr(None)
    _map: Any = PrivateAttr(None)

    @property
    def measured(self) -> Any:
        """What scans say by all ways of finding asperities (studies.measured.Measured), where these numbers are from scans."""
        return self._measured

    def as_measured(self, measured: Any) -> "Roughness":
        """The same numbers, found in scans that say this."""
        found = self.model_copy()
        found._measured = measured
        return found

    def as_numbers(self) -> "Roughness":
        """The same without the memory of scans and their map."""
        return self.replace() if self.surface is None else self.replace(surface=self.surface.as_numbers())

    @property
    def map(self) -> Any:
        """The map (a HeightMap) that stands for both faces, where these numbers are from scans that make one; else None."""
        return self._map

    def with_map(self, surface: Any) -> "Roughness":
        """The same numbers, of a surface whose map this is."""
        found = self.model_copy()
        found._map = surface
        return found

    @model_validator(mode="after")
    def _surface_is_gaussian(self):
        if self.surface is not None and self.surface.height_distribution != "gaussian":
            raise InputError("surface.height_distribution", self.surface.height_distribution, "gaussian")
        if self.surface is not None and self.surface.surface is not None:
            raise InputError("surface.surface", "a table", "nothing: this is the surface already")
        return self


def _rough(value):
    """Numbers as they are, scans as the roughness that is found in them."""
    if isinstance(value, Roughness | str | int | float | None) or (
        isinstance(value, Mapping) and not value.keys() & {"first", "second"}
    ):
        return value
    return measuring.measure(value)


Rough = Annotated[Roughness, BeforeValidator(_rough, json_schema_input_type=Roughness)]
