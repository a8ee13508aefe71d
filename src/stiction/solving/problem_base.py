"""Define the base class of all problems: sums over asperities, closed-form theories, and contacts of a map."""

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
    """Represent n contacts with one model, and solve them.

    chosen: model and laws. groups: dimensionless groups of the contacts, in one dimension. heights: distribution of the
    asperity heights. dims: named dimensions of the contacts with their sizes; n is the product. coords: coordinates of the
    dimensions. subject: the Contact or Indices in the form that the model uses; None if only groups are known. threads:
    number of threads of the sums, which does not change results. Results are normalised, in a dictionary by name;
    separations are in units of sigma. Models without separations implement only `at_load`.
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
        """Return a dictionary for data that all results of the problem share; used by `results` and `conditions`."""
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
        """Return whether the problem has a tangential law, so that friction is computed."""
        return self.chosen.tangential is not None

    @property
    def heights_taken(self) -> str:
        """Return the name of the height distribution that the model uses."""
        return self.heights.key

    @property
    def way(self) -> str:
        """Return the name of the method that computes the contact area, or "" for a model with only one method."""
        return ""

    def records(self) -> list[Record]:
        """Return the records of the model and of all laws in use."""
        return self.chosen.records()

    def with_groups(self, rows: slice | np.ndarray) -> "Problem":
        """Return the problem restricted to some of its contacts, or the same object if a slice selects all of them.

        rows: indices of the contacts, or a slice.
        """
        count = len(self.groups)
        if isinstance(rows, slice) and len(range(*rows.indices(count))) == count:
            return self
        return replace(self, groups=self.groups[rows])

    @property
    @abstractmethod
    def needs_load(self) -> bool:
        """Return whether the model can be solved only at loads, because it computes no separation."""

    @property
    @abstractmethod
    def adheres(self) -> bool:
        """Return whether the model includes adhesion between the two surfaces."""

    def few_of(self, load: np.ndarray) -> np.ndarray:
        """Return the normalised loads (n, m) at which a curve is solved: `load`, or a few others if solving is slow."""
        return load

    def on_branch(self, branch: str) -> "Problem":
        """Return the problem on a branch, "loading" or "unloading", or the problem itself if its law has no branches."""
        return self

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity (k,), normalised, at the separations h (k,), in units of sigma.

        law (k,): index of the contact of each separation.
        """
        self.refuse_separation()

    def load_at(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        """Return the net load per asperity, normalised, at the separations h of any shape.

        law: indices of the contacts, which broadcast to the shape of h.
        """
        return self.loads(h.ravel(), np.broadcast_to(law.astype(int), h.shape).ravel()).reshape(h.shape)

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        """Return the normalised net load per asperity (n, H), all at the same separations h (H,), in units of sigma."""
        self.refuse_separation()

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results of all contacts at the same separations h (H,), in units of sigma, as arrays (n, H) by name."""
        self.refuse_separation()

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results at the separations h (n, m), in units of sigma, as arrays (n, m) by name."""
        self.refuse_separation()

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        """Return the results at normalised loads (n, m), as arrays (n, m) by name; for models that compute no separations."""
        raise AssertionError(f"{self.record.key} is solved at separations")

    def refuse_separation(self) -> NoReturn:
        """Raise InputError, because the model computes no separations."""
        raise InputError(
            "separation", InWords("given"), f"a load instead, because {self.record.key} does not compute a separation"
        )


def with_coefficient(load: np.ndarray, friction: np.ndarray) -> dict[str, np.ndarray]:
    """Return the friction force and its ratio to the load as results by name.

    The ratio is NaN where the load is not compressive.
    """
    return {"friction_force": friction, "friction_coefficient": quotient(friction, load)}
