"""Laws that a contact may have besides those of its model, by keyword: a row each."""

from collections.abc import Callable
from dataclasses import dataclass

from stiction.contact.indices import Groups
from stiction.quantities.errors import InputError
from stiction.records.registry import (
    Ageing,
    Contamination,
    FilmLaw,
    Meniscus,
    Presliding,
    Record,
    RoughSurface,
    TangentialLaw,
    find,
)

_OF_AREA = "none, or a tangential law whose force is a strength of the interface on the area"


@dataclass(frozen=True)
class Addition:
    """One kind of law. allowed(model, tangential, film) -> what is allowed instead where no law of this kind suits them, ""
    where one does. default: key of the law that is taken where the contact states what it is about, `stated`; "" for none."""

    kind: type[Record]
    allowed: Callable[[RoughSurface, TangentialLaw | None, FilmLaw | None], str]
    default: str = ""
    stated: Callable[[Groups], bool] = lambda groups: False


def _presliding(model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
    if not model.asperity:
        return f"nothing: {model.key} knows no single asperities"
    return "nothing: how film and substrate share it is not known" if film is not None else ""


def _meniscus(model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
    return "" if model.asperity else f"none: {model.key} knows no single asperities for a liquid to bridge"


def _ageing(model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
    if model.of_map is not None:
        return f"none: {model.key} limits the shear of points, which do not wait"
    if tangential is None:
        return f"{_OF_AREA}: there is no tangential law"
    return "" if tangential.of_area else f"{_OF_AREA}: {tangential.key} is none that goes with the area"


def _contamination(model: RoughSurface, tangential: TangentialLaw | None, film: FilmLaw | None) -> str:
    if not model.asperity:
        return f"none: {model.key} knows no single junctions"
    if film is not None:
        return f"none: how a junction is shared by film and substrate ({film.key}) is not known"
    return "" if tangential is not None and tangential.of_area else _OF_AREA


_JUNCTIONS = "independent_junctions"
ADDITIONS = {
    "presliding": Addition(Presliding, _presliding),
    "meniscus": Addition(  # this law of menisci goes with every asperity law
        Meniscus, _meniscus, "equilibrium_meniscus", lambda groups: groups.meniscus_index is not None
    ),
    "ageing": Addition(Ageing, _ageing, "berthoud_1999", lambda groups: groups.waiting is not None),
    "contamination": Addition(
        Contamination, _contamination, _JUNCTIONS, lambda groups: all(map(groups.knows, find(_JUNCTIONS, Contamination).needs))
    ),
}


def added(
    keyword: str,
    key: str | None,
    groups: Groups | None,
    model: RoughSurface,
    tangential: TangentialLaw | None,
    film: FilmLaw | None,
) -> Record | None:
    """Return the law of this kind that answers, None for none; key: as it was chosen, None where the contact decides.

    Raises InputError for a key that is not known, and for a law that does not suit the others.
    """
    row = ADDITIONS[keyword]
    if (key is None and (groups is None or not row.stated(groups))) or (key == "none" and row.default):
        return None
    allowed = row.allowed(model, tangential, film)
    if key is None:
        return None if allowed else find(row.default, row.kind)
    law = find(key, row.kind)
    if allowed:
        raise InputError(keyword, law.key, allowed)
    return law
