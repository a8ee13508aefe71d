"""Menisci: a kind of law that is added to a model."""

from collections.abc import Callable
from dataclasses import dataclass

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.records.registry import Addition, FilmLaw, RoughSurface, TangentialLaw


@dataclass(frozen=True, kw_only=True)
class Meniscus(Addition):
    """Capillary force of a liquid around an asperity, independent of the contact law.

    pull(groups, **own options) -> list of Regime, by displacement, which may begin below zero, where the liquid bridges a gap:
    no area, no resistance, and loads below zero.
    """

    kind = keyword = "meniscus"
    order = 2
    default = "equilibrium_meniscus"  # which goes with every asperity law
    pull: Callable[[Groups], list[Regime]]

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        return "" if model.asperity else f"none: {model.key} knows no single asperities for a liquid to bridge"

    @classmethod
    def is_stated(cls, groups: Groups) -> bool:
        return groups.meniscus_index is not None

    def regimes(self, groups: Groups) -> list[Regime]:
        return self.pull(groups)


KIND = Meniscus
