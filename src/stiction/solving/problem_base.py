"""The base of every problem: a sum over asperities, a theory in closed form, the contact of a map."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NoReturn

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.heights import Heights
from stiction.quantities.errors import InputError
from stiction.quantities.quotient import quotient
from stiction.records.registry import Record, RoughSurface
from stiction.solving.chosen import Chosen


@dataclass(frozen=True)
class Problem(ABC):
    """Hold n contacts under one model.

    groups: their dimensionless groups, flat. dims: named dimensions of the contacts, name -> size; n is the product. coords:
    coordinates of the dimensions. subject: the Contact or Indices, as the model takes it; None where only groups were given.
    Results are normalised, by name; theories without separations have only `at_load`. threads: number of threads of the sums;
    it changes no digit.
    """

    chosen: Chosen
    groups: Groups
    heights: Heights
    dims: dict[str, int]
    coords: dict[str, Any]
    subject: Any = None
    threads: int = 1

    @property
    def record(self) -> RoughSurface:
        return self.chosen.model

    @property
    def options(self) -> Mapping[str, str]:
        return self.chosen.options

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(self.dims.values())

    @property
    def friction(self) -> bool:
        """Whether there is a tangential law."""
        return self.chosen.tangential is not None

    @property
    def heights_taken(self) -> str:
        """Which heights count, in a word: the name of a distribution."""
        return self.heights.key

    @property
    def way(self) -> str:
        """How the contact area is found, in words, where the model has more than one way; else ""."""
        return ""

    def records(self) -> list[Record]:
        """Return the records of all laws in use."""
        return self.chosen.records()

    def with_groups(self, rows: slice | np.ndarray) -> "Problem":
        """Return the problem of some of the contacts; itself for all of them."""
        groups = self.groups[rows]
        return self if isinstance(rows, slice) and len(groups) == len(self.groups) else replace(self, groups=groups)

    @property
    @abstractmethod
    def needs_load(self) -> bool:
        """Return whether the model takes loads only, and has no separation."""

    @property
    @abstractmethod
    def adheres(self) -> bool:
        """Whether asperities attract."""

    def few_of(self, load: np.ndarray) -> np.ndarray:
        """Of normalised loads (n, m) of a curve those that can be afforded: all, unless every one takes its time."""
        return load

    def on_branch(self, branch: str) -> "Problem":
        """Return the problem on another branch; itself where there is none."""
        return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Net load per asperity at pairs of separation and law."""
        self.refuse_separation()

    def load_at(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Net load per asperity at any separations, of the laws of these numbers, which broadcast to them."""
        return self.loads(h.ravel(), np.broadcast_to(law.astype(int), h.shape).ravel()).reshape(h.shape)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Net load per asperity (n, H) at separations that all laws share."""
        self.refuse_separation()

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, H) at separations that all laws share."""
        self.refuse_separation()

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, m) at the separations h (n, m)."""
        self.refuse_separation()

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        """Results (n, m) at normalised loads (n, m), where the model `needs_load`."""
        raise AssertionError(f"{self.record.key} is solved at separations")

    def refuse_separation(self) -> NoReturn:
        """Raise the InputError of a model without separations."""
        raise InputError("separation", None, f"a load: {self.record.key} has no separation")


def with_coefficient(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """Return the friction force and its ratio to the load, NaN where the load does not press."""
    return {"friction_force": friction, "friction_coefficient": quotient(friction, load)}
