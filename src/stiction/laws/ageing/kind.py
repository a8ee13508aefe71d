"""Ageing: a kind of law that is added to a model."""

from collections.abc import Callable
from dataclasses import dataclass

from stiction.contact.indices import Groups
from stiction.records.registry import OF_AREA, Addition, FilmLaw, RoughSurface, TangentialLaw


@dataclass(frozen=True, kw_only=True)
class Ageing(Addition):
    """Ageing law: the strength of an interface grows with its time at rest.

    aged(groups) -> the groups as tangential laws take them then: with the strength of the interface that a contact has by now,
    over the area that it had at first.
    """

    kind = keyword = "ageing"
    order = 3
    default = "berthoud_1999"
    aged: Callable[[Groups], Groups]

    @classmethod
    def allowed(cls, model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
        if model.of_map is not None:
            return f"none: {model.key} limits the shear of points, which do not wait"
        if tangential is None:
            return f"{OF_AREA}: there is no tangential law"
        return "" if tangential.of_area else f"{OF_AREA}: {tangential.key} is none that goes with the area"

    @classmethod
    def is_stated(cls, groups: Groups) -> bool:
        return groups.waiting is not None

    def changed(self, groups: Groups) -> Groups:
        return self.aged(groups)


KIND = Ageing
