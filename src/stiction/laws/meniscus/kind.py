"""Define meniscus laws: capillary forces that are added to a model."""

from collections.abc import Callable
from dataclasses import dataclass

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.records.registry import Addition, FilmLaw, RoughSurface, TangentialLaw


@dataclass(frozen=True, kw_only=True)
class Meniscus(Addition):
    """Describe a law of the capillary force of a liquid around an asperity.

    pull(groups) returns a list of `Regime` objects with negative loads, without contact area or tangential resistance. It
    does not depend on the asperity law, but `required_traits` may exclude asperity laws. A negative displacement is a gap
    that the meniscus bridges.
    """

    kind = keyword = "meniscus"
    order = 2
    default = "equilibrium_meniscus"  # can be combined with every asperity law
    pull: Callable[[Groups], list[Regime]]

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        return "" if model.asperity else f"none: {model.key} has no single asperities"

    @classmethod
    def is_stated(cls, groups: Groups) -> bool:
        return groups.meniscus_index is not None

    def regimes(self, groups: Groups) -> list[Regime]:
        return self.pull(groups)


KIND = Meniscus
