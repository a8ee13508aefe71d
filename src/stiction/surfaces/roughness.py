"""A rough surface by its asperities: stated numbers, or found in scans."""

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
    """The equivalent rough surface: asperities of one radius, with distributed heights.

    Parameters
    ----------
    asperity_height_deviation : float [m], str with a unit, or array
        Standard deviation sigma of the asperity heights.
    asperity_radius : float [m], str with a unit, or array
        Radius R of the asperity tips.
    asperity_density : float [1/m^2], str with a unit, or array
        Number N of asperities per nominal area.
    height_distribution : str, optional
        Name of a height distribution, by default "gaussian".
    height_parameters : dict, optional
        Parameters of the distribution, e.g. {"shape": 3.4}.
    kind : str, optional
        Kind of surface: gaussian, skewed, worn, lay (rougher across than along), two-scale (fine roughness on coarse), or the
        name of a finish ("ground"). It changes no result of a model, only the benchmark surfaces that the result is compared
        to.
    surface : Roughness, optional
        Asperities with the spectral moments of the surface and Gaussian heights (McCool 1986), for theories of the whole
        surface; by default these use the numbers above.

    Raises
    ------
    InputError
        A number is out of its bounds, or a name is unknown.

    Notes
    -----
    Model of Greenwood & Williamson (1966).

    Examples
    --------
    >>> import stiction as st
    >>> rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
    >>> print(f"{rough.asperity_density * rough.asperity_radius * rough.asperity_height_deviation:.4f}")
    0.0024
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
        """Return a copy with these fields replaced. Raises InputError.

        The roughness of a finish also accepts another height.
        """
        if self._finished is None or not changes.keys() & {"finish", "rms_height", "mean_height", "first", "second"}:
            return super().replace(**changes)
        changed = self._finished.replace if changes.keys() & {"first", "second"} else self._finished.with_first
        return changed(**changes).roughness()

    def part(self, name: str) -> Any:
        """Return the field of this name, or a body with a finish; None where there is none."""
        return getattr(self._finished, name, None) if name in ("first", "second") else super().part(name)

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Return the names of numbers that a finish leaves open, e.g. "first.rms_slope".

        Empty where sigma, R and N are stated.
        """
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
        """Return the same numbers together with their origin.

        measured: surfaces.measured.Measured; map: a HeightMap; finished: surfaces.finished.FinishedBodies, the finishes of the
        bodies.
        """
        found = self.model_copy()
        for name, value in what.items():
            setattr(found, f"_{name}", value)
        return found

    def notes(self) -> list[str]:
        return [] if self._finished is None else self._finished.notes()

    def of_surface(self) -> "Roughness | None":
        """Return the asperities with the moments of the surface, of the same kind.

        None where no separate ones are stated.
        """
        return self.surface if self.surface is None or self.kind is None else self.surface.replace(kind=self.kind)

    @property
    def surface_kind(self) -> str | None:
        """Return the kind of surface, one of finishes.SURFACE_KINDS; None if not stated."""
        return None if self.kind is None else surface_kind_of(self.kind)

    @property
    def measured(self) -> Any:
        """Return the scan results of all methods (surfaces.measured.Measured).

        None where these numbers are not from scans.
        """
        return self._measured

    def as_numbers(self) -> "Roughness":
        """Return the same numbers without reference to scans and their map."""
        return self.replace() if self.surface is None else self.replace(surface=self.surface.as_numbers())

    @property
    def map(self) -> Any:
        """Return the map (a HeightMap) that stands for both faces.

        None where these numbers are not from scans that make one.
        """
        return self._map

    @model_validator(mode="after")
    def _surface_is_gaussian(self):
        if self.surface is not None and self.surface.height_distribution != "gaussian":
            raise InputError("surface.height_distribution", self.surface.height_distribution, "gaussian")
        if self.surface is not None and self.surface.surface is not None:
            raise InputError("surface.surface", "a table", "nothing: this is the surface already")
        return self
