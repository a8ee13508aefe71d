"""Titles that follow the case: a title of the bodies before a change is not that of the bodies after it."""

from collections.abc import Mapping
from typing import Any

from stiction.web.fields import got

_SUBJECTS = ("contact", "indices")


def retitled(tables: Mapping[str, Any], opened: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables with the title of the opened case where bodies and groups are as in it, else one that names them."""
    same = all(tables.get(name) == opened.get(name) for name in _SUBJECTS)
    title = opened.get("title") if same else _described(tables)
    rest = {name: value for name, value in tables.items() if name != "title"}
    return {"title": title, **rest} if title else rest


def _described(tables: Mapping[str, Any]) -> str:
    """Name the bodies, and the film with its thickness, of a contact; or dimensionless groups."""
    if "contact" not in tables:
        return "Dimensionless groups"
    bodies = " on ".join(_material(tables, body) for body in ("first", "second"))
    if not isinstance(got(tables, ("contact", "coating")), Mapping):
        return bodies.capitalize()
    thickness = got(tables, ("contact", "coating", "thickness"))  # a text; a list or a distribution is too long for a title
    film = f"{_material(tables, 'coating', 'material').capitalize()} film"
    return ", ".join([film, *([thickness] if isinstance(thickness, str) else []), bodies])


def _material(tables: Mapping[str, Any], *place: str) -> str:
    name = got(tables, ("contact", *place, "preset")) or "material of its own"
    return str(name).replace("_", " ")
