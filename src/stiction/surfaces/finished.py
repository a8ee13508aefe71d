"""Compute sigma, R and N of a rough surface from its rms height Sq and its finish (how it was made, such as "ground").

The rms height Sq, the rms slope h' and the product N R sigma determine the spectral moments of a Gaussian surface: m0 = Sq^2,
m2 = h'^2/2, m4 = alpha m2^2/m0. The bandwidth parameter alpha (Nayak) follows from N R sigma
(stiction.surfaces.theory.moments). The summits of the surface are its asperities (McCool 1986). Hence

    R = (3/4) (pi/alpha)^(1/2) Sq/h'^2,

which is 0.54 Sq/h'^2 at alpha = 6. The moments of two independent surfaces add.
"""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from stiction.quantities.errors import InputError, InWords, field_named
from stiction.quantities.inputs import Input, OptionalNumber, as_text, by_default
from stiction.quantities.ranges import range_in_words
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.surfaces.finishes import Finish, finish, mixture_of_kinds, surface_kind_of
from stiction.surfaces.roughness import SHAPE, Roughness, ShapeNumber, refuse_impossible_kurtosis
from stiction.surfaces.theory.moments import Moments, bandwidth, combine

SQ_OVER_RA = 1.25  # sqrt(pi/2) of Gaussian heights, rounded as is usual
_ASPERITIES = ("asperity_height_deviation", "asperity_radius", "asperity_density")
HEIGHTS = ("rms_height", "mean_height")
_SYMBOLS = ("Sq", "Rq", "Ra", "Sa")  # not valid keys, but the error of Finished then names the valid key
_UNUSUAL = 1.5  # factor outside the 90 % range of a finish from which a height gives a warning (judgement)
_RULES = 0.8  # least fraction of the mean square slope with which one of two bodies alone decides the kind of surface


def _finish(value):
    with field_named(""):
        return finish(value).name


class Finished(Input):
    """Describe a rough body by its finish (how it was made) and, optionally, its measured height.

    finish: name of a finish class, such as "ground" (docs/reference/interfaces.md). rms_height: Sq [m]. mean_height: Ra [m],
    converted by Sq = 1.25 Ra; without either height, the finish provides Sq. kind: kind of surface as in `Roughness`; the
    default is the kind of the finish. skewness, kurtosis, texture_aspect_ratio: as in `Roughness`.

    Raises InputError if both heights are specified, if sigma, R or N is specified as well, for an unknown finish or kind, and
    for an impossible pair of skewness and kurtosis.
    """

    finish: Annotated[str, BeforeValidator(_finish)] = Field(description="a finish, e.g. ground, lapped or polished")
    rms_height: OptionalNumber = by_default(None)
    mean_height: OptionalNumber = by_default(None)
    kind: str | None = Field(default=None, description="gaussian, skewed, worn, lay, two-scale or a finish")
    skewness: ShapeNumber = by_default(None)
    kurtosis: ShapeNumber = by_default(None)
    texture_aspect_ratio: ShapeNumber = by_default(None)

    @model_validator(mode="before")
    @classmethod
    def _no_asperities(cls, given):
        for name in _ASPERITIES:
            if isinstance(given, Mapping) and given.get(name) is not None:
                allowed = f"nothing beside {name}: leave out finish to keep sigma, R and N, or these to keep the finish"
                raise InputError("finish", given.get("finish"), allowed)
        return given

    @model_validator(mode="after")
    def _one_height(self):
        if self.rms_height is not None and self.mean_height is not None:
            raise InputError(
                "mean_height",
                InWords(as_text(self.mean_height, "mean_height")),
                "either mean_height or rms_height; leave out one of them",
            )
        if self.kind is not None:
            surface_kind_of(self.kind)
        refuse_impossible_kurtosis(self.skewness, self.kurtosis)
        return self

    @property
    def height(self) -> Any:
        """Return the specified Sq [m], or 1.25 times the specified Ra; None if neither is specified."""
        return self.rms_height if self.mean_height is None else SQ_OVER_RA * self.mean_height

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Return the names of the quantities that only the finish determines, each as a range.

        They are rms_slope, roughness_parameter (N R sigma) and, if no height is specified, rms_height.
        """
        return ("rms_slope", "roughness_parameter", *(["rms_height"] if self.height is None else []))

    def moments(self, levels: Mapping[str, Any]) -> Moments:
        """Return the spectral moments of the surface, with its uncertain quantities at given quantile levels.

        levels: quantile level, above 0 and below 1, by name in `unknowns`. A quantity without a level has its median.
        """
        made = finish(self.finish)
        slope, density, *drawn = (made.quantile(name, levels.get(name, 0.5)) for name in self.unknowns)
        m0, m2 = (drawn[0] if drawn else self.height) ** 2, slope**2 / 2.0
        return Moments(m0, m2, bandwidth(density) * m2**2 / m0)

    def notes(self) -> list[str]:
        """Return one line on the quantities that the finish provides, and one on the conversion of Ra if Ra is specified."""
        made = finish(self.finish)
        words = "; ".join(_median(made, name) for name in self.unknowns)
        of_ra = [] if self.mean_height is None else [f"Sq = {SQ_OVER_RA} Ra, as of Gaussian heights"]
        return [f"as of a {self.finish} surface: {words}", *of_ra]

    def unusual_height(self) -> str:
        """Return a warning if a specified height is far outside the range of the finish, else "". Arrays are not checked."""
        low, high = finish(self.finish).range["rms_height"]
        if self.height is None or np.ndim(self.height) or low / _UNUSUAL <= self.height <= high * _UNUSUAL:
            return ""
        usual = f"{self.finish} surfaces have {range_in_words(low, high, 'rms_height')}"
        return f"Sq = {show(self.height, 'rms_height', 2)} is unusual, {usual}: check unit and finish."


def _median(made: Finish, name: str) -> str:
    ends = range_in_words(*made.range[name], name)
    median = show(float(made.quantile(name, 0.5)), name, 2)
    return f"{QUANTITIES[name].symbol} {median} (90 % within {ends}, grade {made.grade[name]})"


def _body(value):
    """Convert a table that describes a rough body to a Finished or a Roughness; return other values unchanged.

    A table with sigma, R or N and without a finish gives a Roughness, any other table a Finished.
    """
    if not isinstance(value, Mapping):
        return value
    return Roughness(**value) if value.keys() & set(_ASPERITIES) and "finish" not in value else Finished(**value)


_Body = Annotated[Finished | Roughness, BeforeValidator(_body, json_schema_input_type=Finished | Roughness)]


class FinishedBodies(Input):
    """Describe the rough bodies of a contact, at least one of them by a finish (how it was made, such as "ground").

    first, second: the rough bodies, each a Finished or a Roughness; None for a smooth body. Raises InputError if both bodies
    are rough and one of them specifies skewness, kurtosis or texture_aspect_ratio.
    """

    first: _Body | None = Field(default=None, description="a table with the finish, or the numbers, of the first body")
    second: _Body | None = Field(default=None, description="a table with the finish, or the numbers, of the second body")

    @property
    def bodies(self) -> dict[str, Finished | Roughness]:
        """Return the rough bodies of the contact, by "first" and "second"."""
        return {name: body for name in ("first", "second") if (body := getattr(self, name)) is not None}

    @property
    def unknowns(self) -> tuple[str, ...]:
        """Return the names of the quantities that only a finish determines, each as a range, e.g. "first.rms_slope"."""
        finished = {name: body for name, body in self.bodies.items() if isinstance(body, Finished)}
        return tuple(f"{name}.{number}" for name, body in finished.items() for number in body.unknowns)

    @model_validator(mode="after")
    def _shape_is_of_one_body(self):
        for name, body in self.bodies.items() if len(self.bodies) > 1 else ():
            for number in SHAPE:
                if getattr(body, number) is not None:
                    allowed = "no value where both bodies are rough: the combined value is unknown"
                    raise InputError(f"{name}.{number}", getattr(body, number), allowed)
        return self

    def asperities(self, levels: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """Return sigma [m], R [m] and N [1/m^2] of the contact, with its uncertain roughness at given quantile levels.

        levels: quantile levels, above 0 and below 1, numbers or arrays, by name in `unknowns`. A quantity without a level has
        its median.
        """
        each = [_moments(body, name, levels) for name, body in self.bodies.items()]
        both = each[0] if len(each) == 1 else combine(*each)
        return both.asperities()

    def roughness(self) -> Roughness:
        """Return the roughness of the contact, uncertain quantities at their medians; it refers to these bodies."""
        numbers = dict(zip(_ASPERITIES, self.asperities({}), strict=True))
        shape = {} if len(self.bodies) > 1 else {number: getattr(self._only, number) for number in SHAPE}
        return Roughness(**numbers, **shape, kind=self._kind()).attached(finished=self)

    @property
    def _only(self) -> Finished | Roughness:
        return next(iter(self.bodies.values()))

    def with_first(self, **changes: Any) -> "FinishedBodies":
        """Return a copy with changed fields of the only rough body, such as another height or finish.

        Raises InputError if there are two rough bodies, or if the only one is not the first or has no finish.
        """
        if len(self.bodies) > 1 or not isinstance(self.first, Finished):
            raise InputError(
                next(iter(changes)),
                InWords("one number"),
                "the body before the name, first or second, because each has its own number",
            )
        return self.replace(first=self.first.replace(**changes))

    def notes(self) -> list[str]:
        """Return the notes on each body that is described by a finish, preceded by the name of the body."""
        return [
            f"{name} body {line}" for name, body in self.bodies.items() if isinstance(body, Finished) for line in body.notes()
        ]

    def unusual_heights(self) -> list[str]:
        """Return a warning for each body with a height far outside the range of its finish; equal warnings only once."""
        texts = [body.unusual_height() for body in self.bodies.values() if isinstance(body, Finished)]
        return [text for text in dict.fromkeys(texts) if text]

    def _kind(self) -> str | None:
        """Return the name of the kind or finish of the contact ("worn", "ground"), or a mixture of two kinds; None if unknown.

        A body that contributes at least 80 % of the summed mean square slope determines the kind alone. Between 20 and 80 %,
        the kinds of both bodies must be known; the fraction of each in the mixture rises linearly from 0 to 1, so that results
        change continuously.
        """
        kinds: dict[str, Any] = {name: body.kind or getattr(body, "finish", None) for name, body in self.bodies.items()}
        slopes = {name: float(np.mean(_moments(body, name, {}).m2)) for name, body in self.bodies.items()}
        ruling = [kinds[name] for name in slopes if slopes[name] >= _RULES * sum(slopes.values())] or list(kinds.values())
        if None in ruling or len({surface_kind_of(kind) for kind in ruling}) == 1:
            return None if None in ruling else ruling[0]
        share = (slopes["first"] / sum(slopes.values()) + _RULES - 1.0) / (2.0 * _RULES - 1.0)
        return mixture_of_kinds({kinds["first"]: share, kinds["second"]: 1.0 - share})


def _moments(body: Finished | Roughness, name: str, levels: Mapping[str, Any]) -> Moments:
    if isinstance(body, Finished):
        return body.moments({number: levels.get(f"{name}.{number}", 0.5) for number in body.unknowns})
    return Moments.from_asperities(body.asperity_height_deviation, body.asperity_radius, body.asperity_density)


def is_finished(table: Any) -> bool:
    """Return whether a roughness table, or the table of one of its bodies, specifies a finish or a roughness height (Sq, Ra).

    The result is False if `table` is not a mapping, or if one of its bodies is described by a scan file.
    """
    if not isinstance(table, Mapping):
        return False
    if table.keys() & {"finish", *HEIGHTS, *_SYMBOLS}:
        return True
    bodies = [table[name] for name in ("first", "second") if table.get(name) is not None]
    numbers = [isinstance(body, Roughness | Finished) or (isinstance(body, Mapping) and "file" not in body) for body in bodies]
    return all(numbers) and any(isinstance(body, Finished) or is_finished(body) for body in bodies)


def roughness_of_finish(table: Mapping[str, Any]) -> Roughness:
    """Return the roughness of a contact from a table that specifies a finish.

    The table describes the only rough body, or it has the keys "first" and "second" with a table for each body. `is_finished`
    checks whether a table is accepted. Raises InputError for invalid entries.
    """
    return FinishedBodies(**(table if table.keys() & {"first", "second"} else {"first": Finished(**table)})).roughness()
