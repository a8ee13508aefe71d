"""Define contamination laws: scatter of friction due to varying junction strength."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from stiction.contact.indices import Groups
from stiction.quantities.quotient import quotient
from stiction.records.registry import OF_AREA, Addition, FilmLaw, RoughSurface, TangentialLaw, find


@dataclass(frozen=True, kw_only=True)
class Contamination(Addition, TangentialLaw):
    """Describe a law for the scatter of friction caused by the scatter of junction strength.

    It is stored as a tangential law whose `resistance` is the variance of the friction force of one asperity, in the squared
    unit of the load.
    """

    kind = keyword = "contamination"
    order = 4
    default = "independent_junctions"

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        if not model.asperity:
            return f"none: {model.key} has no single junctions"
        if film is not None:
            return f"none: not supported with a film ({film.key})"
        return "" if tangential is not None and tangential.of_area else OF_AREA

    @classmethod
    def is_stated(cls, groups: Groups) -> bool:
        return all(map(groups.has, find(cls.default, cls).needs))

    def results(
        self, results: Mapping[str, np.ndarray], summed: Callable[[TangentialLaw], np.ndarray], asperities: np.ndarray | None
    ) -> dict[str, np.ndarray]:
        """Return {"friction_coefficient_scatter": standard deviation (n, m) of the friction coefficient between contacts}.

        The variances of the friction forces of all asperities add up. results: results of the sum per asperity, with the
        key "load". summed(law): sum of the resistance of `law` over all heights, per asperity. asperities: number of
        asperities (n, 1). The result is NaN where the load is not positive.
        """
        assert asperities is not None  # the law requires groups that determine the number
        return {"friction_coefficient_scatter": quotient(np.sqrt(summed(self) / asperities), results["load"])}


KIND = Contamination
