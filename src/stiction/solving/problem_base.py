"""Base class of all problems: sums over asperities, theories in closed form, and contacts of a map."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NoReturn

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.heights import Heights
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.quotient import quotient
from stiction.records.registry import Record, RoughSurface
from stiction.solving.chosen import ResolvedLaws


@dataclass(frozen=True)
class Problem(ABC):
    """Hold n contacts under one model, and solve them.

    groups: dimensionless groups of the contacts, in one dimension. dims: named dimensions of the contacts with their sizes; n
    is the product. coords: coordinates of the dimensions. subject: the Contact or Indices, as the model takes it; None if only
    groups are known. Results are normalised, by name. Theories without separations implement only `at_load`. threads: number of
    threads of the sums, which does not change results.
    """

    chosen: ResolvedLaws
    groups: Groups
    heights: Heights
    dims: dict[str, int]
    coords: dict[str, Any]
    subject: Any = None
    threads: int = 1

    @cached_property
    def shared(self) -> dict[str, Any]:
        """Return what all results of the problem have in common, by name; `results` and `conditions` fill it in once."""
        return {}

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
        """Return whether the problem has a tangential law."""
        return self.chosen.tangential is not None

    @property
    def heights_taken(self) -> str:
        """Return the name of the height distribution that the model uses."""
        return self.heights.key

    @property
    def way(self) -> str:
        """Describe how the contact area is computed, for models with more than one method; else ""."""
        return ""

    def records(self) -> list[Record]:
        """Return the records of all laws in use."""
        return self.chosen.records()

    def with_groups(self, rows: slice | np.ndarray) -> "Problem":
        """Return the problem of the contacts at these indices; the same object if all are selected."""
        groups = self.groups[rows]
        return self if isinstance(rows, slice) and len(groups) == len(self.groups) else replace(self, groups=groups)

    @property
    @abstractmethod
    def needs_load(self) -> bool:
        """Return whether the model takes loads only, because it has no separation."""

    @property
    @abstractmethod
    def adheres(self) -> bool:
        """Return whether the model includes adhesion between the two surfaces."""

    def few_of(self, load: np.ndarray) -> np.ndarray:
        """Return the normalised loads (n, m) of a curve, or only a few of them if each solution is slow."""
        return load

    def on_branch(self, branch: str) -> "Problem":
        """Return the problem on another branch, "loading" or "unloading"; itself if the law has no branches."""
        return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity at pairs (k,) of separation and contact index."""
        self.refuse_separation()

    def load_at(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity at separations of any shape; law: contact indices that broadcast to it."""
        return self.loads(h.ravel(), np.broadcast_to(law.astype(int), h.shape).ravel()).reshape(h.shape)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Return the net load per asperity (n, H) at separations (H,) common to all contacts."""
        self.refuse_separation()

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, H) at separations (H,) common to all contacts."""
        self.refuse_separation()

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, m) at the separations h (n, m)."""
        self.refuse_separation()

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results (n, m) at normalised loads (n, m), for models with `needs_load`."""
        raise AssertionError(f"{self.record.key} is solved at separations")

    def refuse_separation(self) -> NoReturn:
        """Raise the InputError of a model that has no separations."""
        raise InputError(
            "separation", InWords("given"), f"a load instead, because {self.record.key} does not compute a separation"
        )


def with_coefficient(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """Return the friction force and its ratio to the load, NaN where the load is not compressive."""
    return {"friction_force": friction, "friction_coefficient": quotient(friction, load)}
