"""Contacts of one map at many nominal pressures, with what makes them doubtful as numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.kept import solve_kept
from stiction.solvers.boundary_elements.measures import waves
from stiction.solvers.boundary_elements.sampled import solve_sampled
from stiction.solvers.boundary_elements.solve import MapContact, MapContacts
from stiction.solvers.boundary_elements.telling import tell
from stiction.surfaces.heightmap import HeightMap


@dataclass(frozen=True)
class MapCurve:
    """contacts: at the nominal pressure of each, in the order asked for, fewer where it was interrupted; None for those that
    were not reached. every: only every so many-th point was solved. of_map: numbers of the map that no load changes, by
    their names in the table of quantities; more: others of every contact, by these names."""

    contacts: tuple[MapContact | None, ...]
    every: int
    of_map: Mapping[str, float]
    more: Mapping[str, np.ndarray] = field(default_factory=dict)

    def array(self, name: str) -> np.ndarray:
        """A number of every contact by its name, not a number where it was not reached."""
        return np.array([np.nan if one is None else getattr(one, name) for one in self.contacts], dtype=float)

    @cached_property
    def fraction(self) -> np.ndarray:
        """Real area over the nominal one."""
        return self.array("area") / self.array("nominal_area")


def curve_of_map(surface: HeightMap, bodies: Bodies, pressures: Sequence[float], *, sampled: bool = False) -> MapCurve:
    """Contacts at nominal pressures [Pa]; sampled: of the fewest points that are enough (see `sampled`). Every solution is
    kept for the next time. Raises InputError as `solve_map` does."""
    whole = surface.size[0] * surface.size[1]

    def at_pressures(heights, size, *, loads, **how) -> MapContacts:
        """The loads are of the whole map; points that were sampled may stand for a little more or less."""
        covered = size[0] * size[1] / whole
        return solve_kept(heights, size, loads=[load * covered for load in loads], **how)

    loads = [float(pressure) * whole for pressure in pressures]
    how = {name: getattr(bodies, name) for name in ("film", "counter_film", "hardness", "menisci")} | {"progress": tell}
    given: dict[str, Any] = {"modulus": bodies.modulus, "loads": loads, "periodic": surface.periodic, **how}
    if sampled:
        found = solve_sampled(surface.heights, surface.size, solve=at_pressures, **given)
        contacts, every = found.contacts, found.every
    else:
        contacts, every = at_pressures(surface.heights, surface.size, **given), 1
    return MapCurve(_in_order(contacts, pressures), every, of_map(surface, bodies, every))


def _in_order(contacts: MapContacts, pressures: Sequence[float]) -> tuple[MapContact | None, ...]:
    """By the nominal pressure: where it was interrupted some are missing."""
    if contacts.complete:
        return tuple(contacts)
    by_pressure = {one.mean_pressure: one for one in contacts}
    nearest = [min(by_pressure, key=lambda mean: abs(mean - wanted), default=np.nan) for wanted in pressures]
    return tuple(
        by_pressure[mean] if abs(mean - wanted) <= 1e-9 * wanted else None
        for mean, wanted in zip(nearest, pressures, strict=True)
    )


def of_map(surface: HeightMap, bodies: Bodies, every: int) -> dict[str, float]:
    """What no load changes, of a map of which every so many-th point is solved."""
    seen = waves(surface.heights, surface.size, surface.periodic)
    pitch, side = max(surface.pitch), min(surface.size)
    found = {
        "points_in_shortest_wave": seen.shortest / pitch,
        "longest_waves_on_a_side": side / seen.longest,
        "map_gradient": seen.gradient,
        "point_spacing": float(every),
    }
    film = bodies.film or bodies.counter_film
    if film is not None:
        found["points_in_film"] = film.thickness / (pitch * every)
    return found
