"""Define the class Roughness, which describes the rough surface of a contact by asperities, specified or found in scans."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Field, PrivateAttr, model_validator

from stiction.quantities.errors import InputError, InWords, field_named
from stiction.quantities.inputs import Input, Number, OptionalNumber, by_default
from stiction.surfaces.finishes import surface_kind_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from stiction.quantities.arguments import QuantityLike
    from stiction.quantities.keywords import Converted
    from stiction.surfaces.heightmap import HeightMap
    from stiction.surfaces.measured import Measured


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


def _single(value: Any) -> float | None:
    if hasattr(value, "dims"):
        raise InputError("", InWords(f"{value.size} values"), "one number, without a range or a list")
    return value


if TYPE_CHECKING:
    _Parameters = Converted[dict[str, float | list[float]], Mapping[str, ArrayLike]]
    ShapeNumber = Converted[float | None, QuantityLike | None]
else:
    _Parameters = dict[str, Annotated[Any, BeforeValidator(_parameter, json_schema_input_type=float | list[float])]]
    ShapeNumber = Annotated[OptionalNumber, AfterValidator(_single)]


StatedKind = Annotated[str | None, BeforeValidator(_kind)]
# Statistics that distinguish a surface from a Gaussian isotropic one, if the user states them.
SHAPE = ("skewness", "kurtosis", "texture_aspect_ratio")


def refuse_impossible_kurtosis(skewness: float | None, kurtosis: float | None) -> None:
    """Raise InputError if no heights can have this kurtosis and skewness: the kurtosis is at least 1 + skewness^2.

    None means an unknown number and is accepted.
    """
    if skewness is not None and kurtosis is not None and kurtosis < 1.0 + skewness**2:
        raise InputError("kurtosis", kurtosis, f"at least {1.0 + skewness**2:.3g}, 1 + skewness^2")


# Units [m] in which heights may be listed, and the relative difference allowed between their deviation and the stated one.
_UNITS, _SAME = np.array([1.0, 1e-3, 1e-6, 1e-9, 1e-10]), 0.01


_NO_PARAMETERS: Any = Field(default_factory=dict)


class Roughness(Input):
    """Describe the roughness of a contact by asperities of one radius with distributed heights.

    If both bodies are rough, the asperities are those of the sum of both surfaces, in contact with a smooth plane.

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
        Parameters of the distribution, e.g. {"exponent": 3.4} for "weibull"; see `stiction.height_distribution`.
    kind : str, optional
        Kind of surface: gaussian, skewed, worn, lay (rougher across than along), two-scale (fine roughness on coarse), or the
        name of a finish ("ground"). It does not change the result of a model; it selects the benchmark surfaces with which the
        result is compared.
    skewness, kurtosis : float, optional
        Ssk and Sku of the surface heights (ISO 25178-2), 0 and 3 for a Gaussian surface. Like `kind`, they select the
        benchmark surfaces with which the result is compared. They thus narrow the interval of a prediction.
    texture_aspect_ratio : float, optional
        Str of the surface (ISO 25178-2), 1 for an isotropic surface and small for a surface with a lay. It is used like the
        skewness.
    surface : Roughness, optional
        Asperities with the spectral moments of the surface and Gaussian heights (McCool 1986), for theories of the whole
        surface; by default these use the numbers above.

    Raises
    ------
    InputError
        A number is out of its bounds, no surface can have the skewness and kurtosis, or a name is unknown.

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

    instead: ClassVar[str] = "; or, in place of the three asperity_* numbers, finish (and rms_height or mean_height if known)"

    asperity_height_deviation: Number
    asperity_radius: Number
    asperity_density: Number
    height_distribution: str = "gaussian"
    height_parameters: _Parameters = _NO_PARAMETERS
    kind: StatedKind = Field(default=None, description="gaussian, skewed, worn, lay, two-scale or a finish")
    skewness: ShapeNumber = by_default(None)
    kurtosis: ShapeNumber = by_default(None)
    texture_aspect_ratio: ShapeNumber = by_default(None)
    surface: "Roughness | None" = Field(default=None, description="a table with sigma, R and N of a Gaussian surface")
    _measured: Any = PrivateAttr(None)
    _map: Any = PrivateAttr(None)
    _finished: Any = PrivateAttr(None)

    def replace(self, **changes: object) -> Self:
        """Return a copy of the roughness with the fields in `changes` replaced.

        A roughness made from a finish (how the surface was made) also accepts finish, rms_height, mean_height, first and
        second. Raises InputError for an unknown field or a value that is not allowed.
        """
        if self._finished is None or not changes.keys() & {"finish", "rms_height", "mean_height", "first", "second"}:
            return super().replace(**changes)
        changed = self._finished.replace if changes.keys() & {"first", "second"} else self._finished.with_first
        return changed(**changes).roughness()

    def part(self, name: str) -> object:
        """Return the value of the field `name`; for "first" or "second", the finish and height specified for that body.

        The result is None if there is no such field, if no finish was specified, or if that body is smooth.
        """
        return getattr(self._finished, name, None) if name in ("first", "second") else super().part(name)

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Return the names of the quantities that a finish determines only as a range, e.g. "first.rms_slope".

        There are none if the user specified sigma, R and N.
        """
        return () if self._finished is None else self._finished.unknowns

    def drawn(self, levels: "ArrayLike") -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return sigma [m], R [m] and N [1/m^2], (n,) each, with the quantities in `unknowns` at given quantile levels.

        Parameters
        ----------
        levels : array_like (k, n)
            One row of quantile levels for each of the k names in `unknowns`, in their order. Levels are above 0 and below 1.

        Raises
        ------
        InputError
            The number of rows is wrong, or a level is not between 0 and 1.
        """
        rows = np.asarray(levels, dtype=float)
        if self._finished is None or rows.ndim == 0 or len(rows) != len(self.unknowns):
            allowed = (
                f"a row for each of {', '.join(self.unknowns)}"
                if self.unknowns
                else "nothing, because sigma, R and N are stated"
            )
            raise InputError("levels", InWords(f"{len(np.atleast_1d(rows))} rows"), allowed)
        return self._finished.asperities(dict(zip(self.unknowns, rows, strict=True)))

    def attached(self, **what: object) -> "Roughness":
        """Return a copy with the same numbers that also stores where they come from.

        Keywords: measured (surfaces.measured.Measured), map (a HeightMap) and finished (surfaces.finished.FinishedBodies).
        """
        found = self.model_copy()
        for name, value in what.items():
            setattr(found, f"_{name}", value)
        return found

    def unusual_heights(self) -> list[str]:
        """Return a warning for each body whose Sq or Ra is far outside the range of its finish."""
        return [] if self._finished is None else self._finished.unusual_heights()

    def notes(self) -> list[str]:
        return [*([] if self._finished is None else self._finished.notes()), *self._scaled_heights()]

    def _scaled_heights(self) -> list[str]:
        """Return a warning, in a list, if the heights of a discrete distribution are scaled; otherwise an empty list.

        The heights may be listed in m, mm, um, nm or Angstrom. If their standard deviation equals the specified value in none
        of these units, they are scaled to this value, and the warning states this.
        """
        samples = self.height_parameters.get("samples") if self.height_distribution == "discrete" else None
        deviation = 0.0 if samples is None else float(np.std(np.asarray(samples, dtype=float)))
        if not deviation > 0.0:
            return []
        scaled = np.ravel(self.asperity_height_deviation)[:, None] / deviation / _UNITS
        if (np.abs(scaled - 1.0) < _SAME).any(axis=1).all():
            return []
        return [f"input warning: listed heights are scaled from a deviation of {deviation:.4g} to asperity_height_deviation"]

    def of_surface(self) -> "Roughness | None":
        """Return the asperities that follow from the spectral moments of the surface; None if the moments are unknown.

        This is the field `surface`. The kind of surface, skewness, kurtosis and texture aspect ratio specified for this
        roughness replace its values.
        """
        if self.surface is None:
            return None
        stated = self.shape | ({} if self.kind is None else {"kind": self.kind})
        more = {name: value for name, value in stated.items() if value != getattr(self.surface, name)}
        return self.surface.replace(**more) if more else self.surface  # a replaced surface loses its map

    @property
    def shape(self) -> dict[str, float]:
        """Return the values of skewness, kurtosis and texture_aspect_ratio that the user specified, by name."""
        return {name: value for name in SHAPE if (value := getattr(self, name)) is not None}

    @property
    def surface_kind(self) -> str | None:
        """Return the kind of surface, one of finishes.SURFACE_KINDS or a text for a mixture of them; None if it is unknown."""
        return None if self.kind is None else surface_kind_of(self.kind)

    @property
    def measured(self) -> "Measured | None":
        """Return the results of all asperity methods for the scans (surfaces.measured.Measured).

        The result is None if the numbers do not come from scans, or belong to one method in `Measured.by_method`.
        """
        return self._measured

    def as_numbers(self) -> "Roughness":
        """Return a copy with the same numbers that stores no scans, map or finish."""
        return self.replace() if self.surface is None else self.replace(surface=self.surface.as_numbers())

    @property
    def map(self) -> "HeightMap | None":
        """Return the single height map that represents the roughness of both bodies.

        Only the asperities with the spectral moments of the scans, the field `surface`, store this map. The result is None for
        every other roughness, and if the scans cannot be combined into one map.
        """
        return self._map

    @model_validator(mode="after")
    def _kurtosis_is_possible(self):
        refuse_impossible_kurtosis(self.skewness, self.kurtosis)
        return self

    @model_validator(mode="after")
    def _surface_is_gaussian(self):
        if self.surface is not None and self.surface.height_distribution != "gaussian":
            raise InputError("surface.height_distribution", self.surface.height_distribution, "gaussian")
        if self.surface is not None and self.surface.surface is not None:
            raise InputError("surface.surface", InWords("a table"), "no `surface` inside the table `surface`")
        return self
