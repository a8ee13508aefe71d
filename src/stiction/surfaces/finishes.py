"""Define finish classes, the typical roughness by manufacturing process, and read them from the files in finish_data/."""

import re
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, Literal, get_args

import numpy as np
from pydantic import model_validator

from stiction.quantities.data_files import read_tables
from stiction.quantities.errors import InputError, nearest
from stiction.quantities.inputs import Input
from stiction.quantities.lognormal import lognormal_quantile
from stiction.quantities.ranges import Ranges
from stiction.quantities.table import QUANTITIES

# Kinds of surfaces by their heights. "lay": rougher across than along; "two-scale": fine roughness on coarse.
SurfaceKind = Literal["gaussian", "skewed", "worn", "lay", "two-scale"]
SURFACE_KINDS: tuple[str, ...] = get_args(SurfaceKind)

_SHARE_OF_KIND = re.compile(r"([01]\.\d+) (\S+)")

# Quantities for which a finish states a range: Sq, asperity radius, rms slope and N R sigma.
NUMBERS = ("rms_height", "asperity_radius", "rms_slope", "roughness_parameter")


class Finish(Input):
    """Store a finish class, such as "ground": 5 and 95 % quantiles of the roughness that one process makes.

    - range: 5 and 95 % quantiles of each quantity in NUMBERS, in SI units; the quantity is lognormally distributed, and its
      median is the geometric mean of the two
    - surface_kind: kind of surface, one of SURFACE_KINDS
    - source, grade: origin and quality grade of each range, by name (data_files.GRADES)

    Raises InputError if a range is missing or not above 0.
    """

    name: str = "unnamed"
    surface_kind: SurfaceKind
    range: Ranges
    source: dict[str, str]
    grade: dict[str, Literal["A", "B", "C"]]

    @model_validator(mode="after")
    def _has_its_numbers(self):
        for name in NUMBERS:
            if name not in self.range or self.range[name][0] <= 0.0:
                raise InputError(f"range.{name}", self.range.get(name), "two numbers above 0, the low end and the high end")
        return self

    def quantile(self, name: str, level: Any) -> np.ndarray:
        """Return a roughness quantity of this finish, in SI units, at quantile levels above 0 and below 1.

        name: "rms_height", "asperity_radius", "rms_slope" or "roughness_parameter". Raises InputError for another
        name or level.
        """
        if name not in NUMBERS:
            raise InputError("quantity", name, ", ".join(NUMBERS))
        low, high = self.range[name]
        return lognormal_quantile(level, (low * high) ** 0.5, low, high)


def finish_names() -> list[str]:
    """Return the names of the finish classes, such as "ground", in alphabetical order."""
    return sorted(_finishes())


def finish(name: str, /) -> Finish:
    """Return the finish class with this name, such as "ground".

    Raises InputError for an unknown name, with similar names as suggestions.
    """
    if not isinstance(name, str) or name not in _finishes():
        raise InputError("finish", name, "a finish: " + nearest(name, finish_names()))
    return _finishes()[name]


def surface_kind_of(word: Any) -> str:
    """Return the kind of surface, one of SURFACE_KINDS, from the name of a kind ("worn") or of a finish ("ground").

    A text from `mixture_of_kinds`, which names more than one kind, is returned unchanged. Raises InputError for any other name.
    """
    if isinstance(word, str) and (word in SURFACE_KINDS or shares_of_kinds(word).keys() <= set(SURFACE_KINDS)):
        return word
    if isinstance(word, str) and word in _finishes():
        return _finishes()[word].surface_kind
    known = [*SURFACE_KINDS, *(name for name in finish_names() if name not in SURFACE_KINDS)]
    raise InputError("kind", word, "a kind of surface or a finish, e.g. " + nearest(word, known))


def mixture_of_kinds(shares: Mapping[str, float]) -> str:
    """Return a text that describes a mixture of kinds of surface, e.g. "0.700 lay + 0.300 gaussian".

    shares: fraction of each kind, by the name of the kind or of a finish; the fractions sum to 1. Raises InputError for an
    unknown name.
    """
    return " + ".join(f"{share:.3f} {surface_kind_of(word)}" for word, share in shares.items())


def shares_of_kinds(kind: str) -> dict[str, float]:
    """Return the fraction of each kind of surface in a text from `mixture_of_kinds`; any other text counts as one kind."""
    parts = [_SHARE_OF_KIND.fullmatch(part) for part in kind.split(" + ")]
    return {part[2]: float(part[1]) for part in parts if part} if all(parts) else {kind: 1.0}


def finishes(names: Iterable[str] | None = None) -> list[dict[str, Any]]:
    """Return one dict for each of the named finish classes, or for all classes if `names` is None.

    Each dict has the keys name, surface_kind and numbers. numbers maps each quantity to its unit, its 5 and 95 % quantiles
    (range), its source and its grade. Raises InputError for an unknown name.
    """
    return [_row(finish(name)) for name in (finish_names() if names is None else names)]


def _row(one: Finish) -> dict[str, Any]:
    numbers = {
        name: {
            "unit": QUANTITIES[name].unit or "1",
            "range": list(one.range[name]),
            "source": one.source[name],
            "grade": one.grade[name],
        }
        for name in NUMBERS
    }
    return {"name": one.name, "surface_kind": one.surface_kind, "numbers": numbers}


@cache
def _finishes() -> dict[str, Finish]:
    return {name: Finish(name=name, **table) for name, table in read_tables("surfaces", "finish_data", "finishes").items()}
