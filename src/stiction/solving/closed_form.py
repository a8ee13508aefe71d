"""Solve closed-form contact theories, which do not sum over asperities."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.joining import resistances
from stiction.quantities.errors import InputError
from stiction.records.registry import select_options
from stiction.solving.problem_base import Problem, with_coefficient


@dataclass(frozen=True)
class ClosedFormProblem(Problem):
    """Represent contacts that are solved by a closed-form theory, without a sum over asperities.

    Friction, if any, is computed by a law of the interface from load and contact area.
    """

    @property
    def needs_load(self) -> bool:
        return self.record.curve is None

    @property
    def adheres(self) -> bool:
        return self.record.adheres

    def near(self, load: np.ndarray) -> np.ndarray:
        """Estimate the separations (n, m), in units of sigma, at which n contacts carry the normalised loads (n, m)."""
        assert self.record.separation_near is not None
        return self.record.separation_near(load, self.groups, **select_options(self.record, self.options))

    def loads(self, h: np.ndarray, law: np.ndarray) -> np.ndarray:
        if self.record.separation_near is not None:
            return self._curve(h[:, None], self.groups[law])[0][:, 0]
        result = np.empty(h.size)
        for index in np.unique(law):
            chosen = law == index
            result[chosen] = self._curve(h[chosen], self.groups[index : index + 1])[0][0]
        return result

    def loads_on_grid(self, h: np.ndarray) -> np.ndarray:
        return self._curve(h, self.groups)[0]

    def on_grid(self, h: np.ndarray) -> dict[str, np.ndarray]:
        return self._results(*self._curve(h, self.groups))

    def at(self, h: np.ndarray) -> dict[str, np.ndarray]:
        if self.record.separation_near is not None:
            return self._results(*self._curve(h, self.groups))
        rows = [self._curve(separations, self.groups[i : i + 1]) for i, separations in enumerate(h)]
        return self._results(*(np.concatenate(parts) for parts in zip(*rows, strict=True)))

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        if not (load >= 0.0).all():
            unknown = "has no results under tension" if self.adheres else "neglects adhesion"
            raise InputError("load", float(load.min()), f"0 or more, because {self.record.key} {unknown}")
        return self._results(load, self._area(load))

    @property
    def map(self) -> Any:
        """Return the height map of the contact if the theory uses it, else None."""
        return None if self.record.area_on_map is None or self.subject is None else self.subject.map

    @property
    def way(self) -> str:
        """Return the name of the method that computes the area, or "" for a theory with only one method."""
        return "" if self.record.way is None else self.record.way(self.map)

    def _area(self, load: np.ndarray) -> np.ndarray:
        assert self.record.area_at_load is not None
        if self.map is not None and self.record.area_on_map is not None:
            return self.record.area_on_map(load, self.groups, self.map)
        return self.record.area_at_load(load, self.groups, **select_options(self.record, self.options))

    def _curve(self, h, groups: Groups) -> tuple[np.ndarray, np.ndarray]:
        if self.record.curve is None:
            self.refuse_separation()
        return self.record.curve(h, groups, **select_options(self.record, self.options))

    def _results(self, load: np.ndarray, area: np.ndarray) -> dict[str, np.ndarray]:
        results = {"load": load, "contact_area": area}
        if self.chosen.tangential is None:
            return results
        return results | with_coefficient(load, resistances(self.chosen.tangential, self.groups, load, area))
