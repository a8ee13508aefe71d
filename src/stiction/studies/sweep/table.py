"""Define the table [sweep] of a case file: its keys and their checks."""

from typing import Any, Literal, get_args

from pydantic import Field, model_validator

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input, Seed
from stiction.studies.sweep.quantile_counts import PERCENTILES

Method = Literal["grid", "list", "sobol", "latin_hypercube"]
_MOST_SOBOL, _MOST_HYPERCUBE = 2**32, 2**22  # every worker samples the whole Latin hypercube
LARGEST_BLOCK = 2**24
MOMENTS = ("count", "mean", "standard_deviation", "least", "most")
STATISTICS = (*MOMENTS, *PERCENTILES)


class Sample(Input):
    """Define how the contacts of a sweep are selected from the values of its array parameters.

    method: "grid" takes every combination; "list" the first values of all parameters together, then the second, and so on;
    "sobol" and "latin_hypercube" take `count` points between start and stop of each range, uniform in the value or in its
    logarithm.
    """

    method: Method = Field("grid", description=", ".join(get_args(Method)))
    count: int | None = Field(None, ge=1, le=_MOST_SOBOL, strict=True, description="a whole number, 1 or more")
    seed: Seed = 0

    @property
    def is_drawn(self) -> bool:
        """Return whether the method samples points between the ends of ranges, as sobol and latin_hypercube do."""
        return self.method in ("sobol", "latin_hypercube")

    @model_validator(mode="after")
    def _count_is_needed(self):
        if self.is_drawn and self.count is None:
            raise InputError("count", None, "a whole number, 1 or more: the number of sampled points")
        if not self.is_drawn and self.count is not None:
            raise InputError("count", self.count, "no value: count is for sobol and latin_hypercube")
        if self.method == "latin_hypercube" and (self.count or 0) > _MOST_HYPERCUBE:
            raise InputError("count", self.count, f"{_MOST_HYPERCUBE} at most, or sobol, which may have more")
        return self


class Sweep(Input):
    """Define the table [sweep] of a case file: which contacts are computed and which results are stored.

    roughness: height maps, each the roughness of one contact (see `maps`). sample: how contacts are selected. keep: names of
    the results to store, all by default. statistics: names of statistics over all contacts at each load or separation, stored
    instead of single results. precision: number type of stored results. block: number of points (contacts at a load or
    separation) that are stored at once. By default it is the number of points that are solved at once, or up to 8 times this
    number for statistics.
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


TABLE = (Sweep, "contacts and results of `stiction sweep`")
