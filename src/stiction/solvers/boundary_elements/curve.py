"""Solve the contacts of one map at many nominal pressures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.cache import solve_cached
from stiction.solvers.boundary_elements.listeners import notify_listeners
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.sampled import solve_sampled
from stiction.solvers.boundary_elements.solve import MapContact, MapContacts
from stiction.surfaces.heightmap import HeightMap


@dataclass(frozen=True)
class MapCurve:
    """Store the contacts of one map at a list of nominal pressures.

    contacts: in the order of the pressures; None for a load not solved because of an interruption. every: sampling step; 2
    means that every second point of each row and column was solved. of_map: quantities of the map that do not depend on load,
    by name. more: arrays (contacts,) of further quantities, by name.
    """

    contacts: tuple[MapContact | None, ...]
    every: int
    of_map: Mapping[str, float]
    more: Mapping[str, np.ndarray] = field(default_factory=dict)

    def array(self, name: str) -> np.ndarray:
        """Return one attribute of all contacts as an array (contacts,); NaN if it is None or the load is not solved.

        name: name of the attribute.
        """
        return np.array([np.nan if contact is None else getattr(contact, name) for contact in self.contacts], dtype=float)

    @cached_property
    def fraction(self) -> np.ndarray:
        """Return the ratio of real to nominal contact area (contacts,); NaN for a load not solved."""
        return self.array("area") / self.array("nominal_area")


def curve_of_map(surface: HeightMap, bodies: Bodies, pressures: Sequence[float], *, sampled: bool = False) -> MapCurve:
    """Solve the contact of a map at nominal pressures [Pa], or read it from the cache on disk.

    bodies: elastic constants, hardness and liquid. sampled: whether to skip points of the map that are not needed for the
    accuracy. Raises InputError as `solve_map` does.
    """
    nominal = surface.size[0] * surface.size[1]

    def at_pressures(heights, size, *, loads, **how) -> MapContacts:
        """Solve a map or the points sampled from it at loads [N] that are given for the whole map.

        The sampled points may cover less area; the loads are multiplied by the ratio of the areas.
        """
        covered = size[0] * size[1] / nominal
        return solve_cached(heights, size, loads=[load * covered for load in loads], **how)

    loads = [float(pressure) * nominal for pressure in pressures]
    how = {name: getattr(bodies, name) for name in ("film", "counter_film", "hardness", "menisci")} | {
        "progress": notify_listeners
    }
    arguments: dict[str, Any] = {"modulus": bodies.modulus, "loads": loads, "periodic": surface.periodic, **how}
    if sampled:
        sampled_contacts = solve_sampled(surface.heights, surface.size, solve=at_pressures, **arguments)
        contacts, every = sampled_contacts.contacts, sampled_contacts.every
    else:
        contacts, every = at_pressures(surface.heights, surface.size, **arguments), 1
    return MapCurve(_in_order(contacts, pressures), every, of_map(surface, bodies, every))


def _in_order(contacts: MapContacts, pressures: Sequence[float]) -> tuple[MapContact | None, ...]:
    """Return one contact for each nominal pressure [Pa], in their order; None where the contact was not solved."""
    if contacts.complete:
        return tuple(contacts)
    by_pressure = {contact.mean_pressure: contact for contact in contacts}
    nearest = [min(by_pressure, key=lambda mean: abs(mean - wanted), default=np.nan) for wanted in pressures]
    return tuple(
        by_pressure[mean] if abs(mean - wanted) <= 1e-9 * wanted else None
        for mean, wanted in zip(nearest, pressures, strict=True)
    )


def of_map(surface: HeightMap, bodies: Bodies, every: int) -> dict[str, float]:
    """Return the quantities of a map that do not depend on load, by name.

    They are points in the shortest wave, longest waves on a side, rms gradient, sampling step and, if one of the bodies has a
    film, the number of points in its thickness; if both have films, the number for the first film. every: sampling step.
    """
    seen = waves(surface.heights, surface.size, surface.periodic)
    numbers = {
        "points_in_shortest_wave": seen.points_in_shortest_wave,
        "longest_waves_on_a_side": seen.longest_waves_on_a_side,
        "map_gradient": seen.gradient,
        "point_spacing": float(every),
    }
    film = bodies.film or bodies.counter_film
    if film is not None:
        numbers["points_in_film"] = film.thickness / (seen.pitch * every)
    return numbers
