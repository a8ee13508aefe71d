"""Define presliding laws: tangential stiffness of a contact before it slides, added to a model."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from stiction.records.registry import Addition, FilmLaw, RoughSurface, TangentialLaw


@dataclass(frozen=True, kw_only=True)
class Presliding(Addition, TangentialLaw):
    """Describe a law of the elastic tangential displacement of a contact before it slides.

    It is stored as a tangential law whose `resistance` is the tangential stiffness of one asperity at zero force, times sigma,
    in the unit of the load.
    """

    kind = keyword = "presliding"
    order = 1

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        if not model.asperity:
            return f"not supported: {model.key} has no single asperities"
        return "not supported with a film" if film is not None else ""

    def results(
        self, results: Mapping[str, np.ndarray], summed: Callable[[TangentialLaw], np.ndarray], asperities: np.ndarray | None
    ) -> dict[str, np.ndarray]:
        return {"tangential_stiffness": summed(self)}


KIND = Presliding
