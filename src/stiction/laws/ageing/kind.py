"""Define ageing laws: growth of the interface strength with the hold time, added to a model."""

from collections.abc import Callable
from dataclasses import dataclass

from stiction.contact.indices import Groups
from stiction.records.registry import OF_AREA, Addition, FilmLaw, RoughSurface, TangentialLaw


@dataclass(frozen=True, kw_only=True)
class Ageing(Addition):
    """Describe a law of ageing: the shear strength of the interface grows with the hold time, but not the contact area.

    aged(groups) returns the dimensionless groups of the contact with the shear strength after the hold time.
    """

    kind = keyword = "ageing"
    order = 3
    default = "berthoud_1999"
    aged: Callable[[Groups], Groups]

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        if model.of_map is not None:
            return f"none: {model.key} does not support ageing"
        if tangential is None:
            return f"{OF_AREA}: no tangential law is chosen"
        return "" if tangential.of_area else f"{OF_AREA}: the force of {tangential.key} is not"

    @classmethod
    def is_stated(cls, groups: Groups) -> bool:
        return groups.waiting is not None

    def changed(self, groups: Groups) -> Groups:
        return self.aged(groups)


KIND = Ageing
