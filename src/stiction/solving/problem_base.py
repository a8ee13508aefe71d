"""The base class of all problems: sums over asperities, theories in closed form, contacts of maps."""

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
    """Hold n contacts under one model; results are normalised, by name.

    groups: dimensionless groups of the contacts, flat. dims: named dimensions of the contacts, name -> size; n is their
    product. coords: coordinates of the dimensions. subject: the Contact or Indices, as the model takes it; None if only
    groups are given. threads: number of threads of the sums; it changes no digit. Theories without separations have only
    `at_load`.
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
        """Return whether there is a tangential law."""
        return self.chosen.tangential is not None

    @property
    def heights_taken(self) -> str:
        """Return the name of the height distribution, or what stands in its place."""
        return self.heights.key

    @property
    def way(self) -> str:
        """Return in words how the contact area is found, if the model has more than one way; else ""."""
        return ""

    def records(self) -> list[Record]:
        """Return the records of all laws in use."""
        return self.chosen.records()

    def with_groups(self, rows: slice | np.ndarray) -> "Problem":
        """Return the problem of some of the contacts; the same object for all of them."""
        groups = self.groups[rows]
        return self if isinstance(rows, slice) and len(groups) == len(self.groups) else replace(self, groups=groups)

    @property
    @abstractmethod
    def needs_load(self) -> bool:
        """Return whether the model takes loads only, because it has no separation."""

    @property
    @abstractmethod
    def adheres(self) -> bool:
        """Return whether asperities attract."""

    def few_of(self, load: np.ndarray) -> np.ndarray:
        """Return the loads (n, m) of a curve that are quick enough to solve: all, unless each of them takes seconds."""
        return load

    def on_branch(self, branch: str) -> "Problem":
        """Return the problem on another branch; the same object if the model has no branches."""
        return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity at pairs of separation and law."""
        self.refuse_separation()

    def load_at(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity at separations of any shape.

        law: numbers of the laws, which broadcast to that shape.
        """
        return self.loads(h.ravel(), np.broadcast_to(law.astype(int), h.shape).ravel()).reshape(h.shape)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Return the net load per asperity (n, H) at separations that all laws share."""
        self.refuse_separation()

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return results (n, H) at separations that all laws share."""
        self.refuse_separation()

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return results (n, m) at the separations h (n, m)."""
        self.refuse_separation()

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        """Return results (n, m) at normalised loads (n, m), for a model that `needs_load`."""
        raise AssertionError(f"{self.record.key} is solved at separations")

    def refuse_separation(self) -> NoReturn:
        """Raise the InputError of a model that has no separations."""
        raise InputError("separation", None, f"a load: {self.record.key} has no separation")


def with_coefficient(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """Return the friction force and its ratio to the load, NaN where the load does not press."""
    return {"friction_force": friction, "friction_coefficient": quotient(friction, load)}
