"""A rough surface by its asperities: given, or found in scans."""

from typing import Annotated, Any, Self

import numpy as np
from pydantic import BeforeValidator, Field, PrivateAttr, model_validator

from stiction.quantities.errors import InputError, InWords, field_named
from stiction.quantities.inputs import Input, Number
from stiction.surfaces.finishes import surface_kind_of


def _parameter(value):
    numbers = np.asarray(value)
    if numbers.dtype.kind not in "iuf" or not np.isfinite(numbers).all():
        raise InputError("", value, "a finite number or a list of them")
    return numbers.astype(float).tolist()


def _kind(value):
    if value is not None:
        with field_named(""):
            surface_kind_of(value)
    return value


_Parameter = Annotated[Any, BeforeValidator(_parameter, json_schema_input_type=float | list[float])]


class Roughness(Input):
    """The equivalent rough surface: asperities of one radius, with distributed heights (GW 1966).

    height_distribution: name of a height distribution; height_parameters: its parameters, e.g. {"shape":
    3.4}. surface: asperities with the spectral moments of the surface (McCool 1986), with Gaussian heights, which theories of
    the whole surface take in place of these; left out, they take these. kind: gaussian, skewed, worn, lay (rougher across than
    along), two-scale (fine roughness on coarse) or the name of a finish ("ground"), which stands for one; left out, not
    known. It changes no result of a model, but the solved surfaces that the result is compared to. Raises InputError.
    """

    asperity_height_deviation: Number
    asperity_radius: Number
    asperity_density: Number
    height_distribution: str = "gaussian"
    height_parameters: dict[str, _Parameter] = Field(default_factory=dict)
    kind: Annotated[str | None, BeforeValidator(_kind)] = Field(
        default=None, description="gaussian, skewed, worn, lay, two-scale or a finish"
    )
    surface: "Roughness | None" = Field(default=None, description="a table with sigma, R and N of a Gaussian surface")
    _measured: Any = PrivateAttr(None)
    _map: Any = PrivateAttr(None)
    _finished: Any = PrivateAttr(None)

    def replace(self, **changes: Any) -> Self:
        """Return another roughness, with these fields in place of its own; of a finish also with another height.
        Raises InputError."""
        of_finish = self._finished is not None and changes.keys() & {"finish", "rms_height", "mean_height"}
        return self._finished.with_first(**changes).roughness() if of_finish else super().replace(**changes)

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Names of the numbers that a finish leaves open, "first.rms_slope"; none where sigma, R and N are stated."""
        return () if self._finished is None else self._finished.unknowns

    def drawn(self, levels: Any) -> tuple[Any, Any, Any]:
        """Return sigma [m], R [m] and N [1/m^2] (n,) each, at quantile levels of what a finish leaves open.

        Parameters
        ----------
        levels : array_like (k, n)
            A row for each of the `unknowns`, in their order; each level above 0 and below 1.

        Raises
        ------
        InputError
            There are not as many rows, or a level is not between 0 and 1.
        """
        rows = np.asarray(levels, dtype=float)
        if self._finished is None or rows.ndim == 0 or len(rows) != len(self.unknowns):
            names = ", ".join(self.unknowns) or "nothing: sigma, R and N are stated"
            raise InputError("levels", InWords(f"{len(np.atleast_1d(rows))} rows"), f"a row for each of {names}")
        return self._finished.asperities(dict(zip(self.unknowns, rows, strict=True)))

    def attached(self, **what: Any) -> "Roughness":
        """Return the same numbers with where they come from: measured (surfaces.measured.Measured), map, or the finishes of the
        bodies, finished (surfaces.finished.FinishedBodies)."""
        found = self.model_copy()
        for name, value in what.items():
            setattr(found, f"_{name}", value)
        return found

    def notes(self) -> list[str]:
        return [] if self._finished is None else self._finished.notes()

    def of_surface(self) -> "Roughness | None":
        """Return the asperities with the moments of the surface, of the same kind; None where there are none but these."""
        return self.surface if self.surface is None or self.kind is None else self.surface.replace(kind=self.kind)

    @property
    def surface_kind(self) -> str | None:
        """The kind of surface, one of finishes.SURFACE_KINDS; None where it is not stated."""
        return None if self.kind is None else surface_kind_of(self.kind)

    @property
    def measured(self) -> Any:
        """What scans say by all ways of finding asperities (surfaces.measured.Measured), where these numbers are from scans."""
        return self._measured

    def as_numbers(self) -> "Roughness":
        """The same without the memory of scans and their map."""
        return self.replace() if self.surface is None else self.replace(surface=self.surface.as_numbers())

    @property
    def map(self) -> Any:
        """The map (a HeightMap) that stands for both faces, where these numbers are from scans that make one; else None."""
        return self._map

    @model_validator(mode="after")
    def _surface_is_gaussian(self):
        if self.surface is not None and self.surface.height_distribution != "gaussian":
            raise InputError("surface.height_distribution", self.surface.height_distribution, "gaussian")
        if self.surface is not None and self.surface.surface is not None:
            raise InputError("surface.surface", "a table", "nothing: this is the surface already")
        return self
