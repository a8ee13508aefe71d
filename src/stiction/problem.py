"""A model, its contacts and its heights, ready to be summed: what every way of solving starts from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from .contact import Contact, Indices
from .errors import InputError
from .groups import Groups
from .heights import Heights, gaussian, height_distribution
from .registry import Record, find, settle
from .summation import on_grid, scattered, totals_on_grid

_AT_ONCE = 500_000  # pairs of a law and a separation; bounds the memory of the sums by regime


@dataclass(frozen=True)
class Problem:
    """n contacts under one model.

    groups: their dimensionless groups, flat. dims: named dimensions of the contacts, name -> size; n is the product.
    coords: what the dimensions' points are called.
    """

    record: Record
    options: Mapping[str, str]
    groups: Groups
    heights: Heights
    dims: dict[str, int]
    coords: dict[str, Any]

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(self.dims.values())

    @cached_property
    def regimes(self) -> list:
        return self.record.regimes(self.groups, **self.options)

    def records(self) -> list[Record]:
        """The records of all that answers: the model, and the film law if there is a film."""
        if not (self.groups.coated and self.record.coating):
            return [self.record]
        printed = self.options.get("reading") == "published"
        return [self.record, find("printed" if printed else self.options["coating_law"], "film")]

    def on_branch(self, branch: str) -> "Problem":
        """The same problem on another branch, if the model has it for this contact; otherwise itself."""
        try:
            other = replace(self, options=settle(self.record, {**self.options, "branch": branch}))
            return other if other.regimes else self
        except InputError:
            return self

    def by_regime(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Sums (regimes, m, 5) at pairs of separation and law."""
        return scattered(self.regimes, h, self.heights, law)

    def by_regime_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Sums (regimes, n, H, 5) at separations that all laws share."""
        return np.moveaxis(on_grid(self.regimes, h, self.heights), 2, -1)

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Net load per asperity at pairs of separation and law."""
        pieces = range(0, h.size, _AT_ONCE)
        parts = [self.by_regime(h[at : at + _AT_ONCE], law[at : at + _AT_ONCE])[..., 1].sum(axis=0) for at in pieces]
        return np.concatenate(parts) if parts else np.empty(0)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Net load per asperity (n, H) at separations that all laws share."""
        return totals_on_grid(self.regimes, h, self.heights)[:, 0]


def make_problem(
    subject: Contact | Indices, model: str, options: Mapping[str, str | None], heights: Heights | str | None = None
) -> Problem:
    """The problem of this contact under this model. Raises InputError for what the model does not know or refuses."""
    record = find(model, "rough surface")
    settled = settle(record, options)
    if isinstance(subject, Contact):
        indices = subject.indices()
        roughness = subject.roughness
        given = height_distribution(roughness.height_distribution, **roughness.height_parameters)
    elif isinstance(subject, Indices):
        indices, given = subject, gaussian()
    else:
        raise InputError("contact", type(subject).__name__, "a stiction.Contact or stiction.Indices")
    if heights is not None:
        given = height_distribution(heights) if isinstance(heights, str) else heights
    if indices.has_film and not record.coating:
        raise InputError("model", record.key, "a model that knows coatings; this contact has one")
    groups, dims, coords = _flatten(indices.resolved())
    return Problem(record, settled, groups, given, dims, coords)


def _flatten(indices: Indices) -> tuple[Groups, dict[str, int], dict[str, Any]]:
    """Flat groups of all combinations of the named dimensions, and those dimensions."""
    values = {name: getattr(indices, name) for name in (field.name for field in fields(Groups))}
    if not indices.has_film:
        values |= {"n_g": None, "film_aspect": None}
    elif indices.film_aspect is None:
        values["film_aspect"] = math.inf
    labelled = {name: value for name, value in values.items() if hasattr(value, "dims")}
    dims: dict[str, int] = {}
    coords: dict[str, Any] = {}
    for value in labelled.values():
        dims |= {str(dim): size for dim, size in value.sizes.items()}
        coords |= {str(name): coordinate.variable for name, coordinate in value.coords.items()}
    shape = tuple(dims.values())
    flat: dict[str, np.ndarray | None] = {}
    for name, value in values.items():
        flat[name] = None if value is None else np.broadcast_to(spread(value, dims), shape).reshape(-1).astype(float)
    return Groups(**flat), dims, coords  # type: ignore[arg-type]


def spread(value: Any, dims: Mapping[str, int]) -> np.ndarray:
    """The value with its named dimensions in the order of `dims`, ready to broadcast; the missing ones have length 1."""
    if not hasattr(value, "dims"):
        return np.asarray(value, dtype=float)
    ordered = value.transpose(*(dim for dim in dims if dim in value.dims))
    return ordered.values.reshape([value.sizes.get(dim, 1) for dim in dims])
