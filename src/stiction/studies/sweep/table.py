"""The table [sweep] of a case file."""

from typing import Any, Literal, get_args

from pydantic import Field, model_validator

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input
from stiction.studies.sweep.quantile_counts import PERCENTILES

Method = Literal["grid", "list", "sobol", "latin_hypercube"]
_MOST_SOBOL, _MOST_HYPERCUBE = 2**32, 2**22  # a Latin hypercube is drawn whole, by every worker
LARGEST_BLOCK = 2**24
MOMENTS = ("count", "mean", "standard_deviation", "least", "most")
STATISTICS = (*MOMENTS, *PERCENTILES)


class Sample(Input):
    """Selection of contacts. grid: every combination; list: the values point by point.

    sobol, latin_hypercube: `count` points between start and stop of each range, evenly in it or in its logarithm.
    """

    method: Method = Field("grid", description=", ".join(get_args(Method)))
    count: int | None = Field(None, ge=1, le=_MOST_SOBOL, strict=True, description="a whole number, 1 or more")
    seed: int = Field(0, ge=0, le=2**63 - 1, strict=True, description="a whole number, 0 or more")

    @property
    def is_drawn(self) -> bool:
        """Whether points are drawn between the ends."""
        return self.method in ("sobol", "latin_hypercube")

    @model_validator(mode="after")
    def _count_is_needed(self):
        if self.is_drawn and self.count is None:
            raise InputError("count", None, "a whole number, 1 or more: how many points are drawn")
        if not self.is_drawn and self.count is not None:
            raise InputError("count", self.count, "no value: count is for sobol and latin_hypercube")
        if self.method == "latin_hypercube" and (self.count or 0) > _MOST_HYPERCUBE:
            raise InputError("count", self.count, f"{_MOST_HYPERCUBE} at most, or sobol, which may have more")
        return self


class Sweep(Input):
    """Contacts that are computed and results that are stored.

    roughness: maps, each the roughness of one contact (see `maps`). sample: which contacts. keep: names of results, all by
    default. statistics: of these results over all contacts at each load, stored in place of the points. precision: of what is
    stored. block: points that are stored at once; by default as many as are solved at once, or up to 8 times that for
    statistics, whose blocks need no more room when they are larger.
    """

    roughness: list[str | dict[str, Any]] = Field(
        default_factory=list,
        description="maps, each of one contact: files, tables with file and patches, or tables with hurst and realisations",
    )
    sample: Sample = Field(default=Sample(method="grid", count=None, seed=0), description="a table with method, count and seed")
    keep: list[str] = Field(default_factory=list, description="a list of names of results")
    statistics: list[Literal[STATISTICS]] = Field(  # type: ignore[valid-type]  # one list of them, for all
        default_factory=list, description=", ".join(STATISTICS)
    )
    precision: Literal["float64", "float32"] = Field("float64", description="float64, float32")
    block: int | None = Field(None, ge=1, le=LARGEST_BLOCK, strict=True, description=f"a whole number, 1 to {LARGEST_BLOCK}")


TABLE = (Sweep, "what `stiction sweep` computes and keeps")
