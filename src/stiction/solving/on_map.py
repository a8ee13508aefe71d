"""Solve the contact of a height map, measured or generated, point by point, without asperities or statistics."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.laws.joining import resistances
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import select_options
from stiction.solving.point_shear import POINT_SHEARS, points_of
from stiction.solving.problem_base import Problem, with_coefficient

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.curve import MapCurve
    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.surfaces.heightmap import HeightMap
    from stiction.surfaces.measured import Measured

# Results that every contact has: name in the table of quantities -> name of the attribute of MapContact.
_PLAIN = {
    "load_share_plastic": "plastic_share",
    "points_in_contact": "points",
    "solution_residual": "residual",
    "solution_error": "pressure_error",
    "area_solution_error": "area_error",
    "load_error": "load_error",
}
_SOLVED = ("solution_residual", "solution_error", "area_solution_error", "load_error")  # only solutions without adhesion
# Loads of a quick curve: their number; the nominal pressure of the heaviest, divided by modulus times gradient, and divided by
# the hardness; the ratio of the lightest to the heaviest.
_FEW, _HEAVY, _OF_HARDNESS, _LIGHT = 5, 0.2, 0.3, 0.02
_MOST_POINTS = 1_100_000


@dataclass(frozen=True)
class MapProblem(Problem):
    """Represent a contact whose roughness is a height map, which is solved point by point.

    Results are normalised, as for all problems.
    """

    @property
    def needs_load(self) -> bool:
        return True

    @property
    def adheres(self) -> bool:
        return self.options.get("adhesion", "left_out") != "left_out"

    @property
    def menisci(self) -> bool:
        """Return whether the model solves menisci between the surfaces; False without liquid, and if adhesion is solved.

        The result is also False if the user chose meniscus = "none".
        """
        liquid = self.groups.meniscus_index is not None
        return liquid and not self.chosen.dry and not self.adheres

    @property
    def heights_taken(self) -> str:
        return "measured"

    @cached_property
    def contact(self) -> Contact:
        """Return the contact with its map, and without its liquid if the model does not solve menisci.

        Raises InputError if the contact has no map, or if one of its numbers is an array.
        """
        if not isinstance(self.subject, Contact) or self.subject.measured is None:
            raise InputError(
                "height map", None, f"roughness = a HeightMap, or a scan in a case file; {self.record.key} solves a map"
            )
        self.subject.require_single(f"one number, where {self.record.key} solves a map")
        return self.subject if self.menisci else self.subject.replace(liquid=None)

    @cached_property
    def factors(self) -> dict[str, Any]:
        """Return, for each unit ("N", "m^2" ...), the number by which normalised results are multiplied."""
        return self.contact.scales().factors()

    @property
    def _measured(self) -> "Measured":
        measured = self.contact.measured
        assert measured is not None  # `contact` raises an error otherwise
        return measured

    def without_attraction(self) -> "MapProblem":
        """Return the problem of the dry contact without adhesion."""
        assert isinstance(self.subject, Contact)
        chosen = self.chosen.with_option("adhesion", "left_out").with_option("mode_mixity", "none")
        return replace(self, subject=self.subject.replace(liquid=None), chosen=chosen)

    def surface(self) -> "HeightMap":
        """Return the height map that is solved; raise InputError if it cannot be solved."""
        return self._measured.solvable.one()

    def curve(self, load: np.ndarray) -> "MapCurve":
        """Solve the map at normalised loads (m,), and return the solutions.

        Raises InputError for a load that is not positive, unless the option `adhesion` includes adhesion.
        """
        contact, surface = self.contact, self.surface()
        unit = self.factors["N"]
        if not self.adheres and not (load > 0.0).all():
            allowed = f"above 0, because {self.record.key} neglects adhesion unless the option adhesion adds it"
            raise InputError("load", contact.show(float(load.min() * unit), "load"), allowed)
        assert self.record.of_map is not None
        options = select_options(self.record, self.options)
        return self.record.of_map(surface, contact, load * unit / contact.nominal_area, **options)

    def at_load(self, load: np.ndarray) -> dict[str, np.ndarray]:
        load = np.asarray(load, dtype=float)
        curve = self.curve(load.reshape(-1))
        factors = self.factors
        whole = self.contact.nominal_area / curve.array("nominal_area")  # area of the contact over area of the map
        planes = curve.array("separation")
        results = {
            "load": load.reshape(-1),
            "contact_area": curve.array("area") * whole / factors["m^2"],
            "contact_area_pixels": curve.array("area_pixels") * whole / factors["m^2"],
            "mean_separation": (planes - self._mean_height()) / factors["m"],
            "plane_separation": planes / factors["m"],
            "contact_stiffness": curve.array("stiffness") * whole / factors["N/m"],
            **{name: curve.array(column) for name, column in _PLAIN.items()},
            **{
                name: np.full(load.size, value) / factors.get(QUANTITIES[name].scale, 1.0)
                for name, value in curve.of_map.items()
            },
            **curve.more,
        }
        if self.menisci:
            results["load_meniscus"] = -curve.array("pull") * whole / factors["N"]
        if self.adheres:
            results = {name: table for name, table in results.items() if name not in ("contact_stiffness", *_SOLVED)}
        if self.friction:
            force = np.array([np.nan if state is None else self._friction(state) for state in curve.contacts])
            results |= with_coefficient(results["load"], force)
        return {name: table.reshape(load.shape) for name, table in results.items()}

    def few_of(self, load: np.ndarray) -> np.ndarray:
        """Return five normalised loads (1, 5), from light contact up to contact on at most about a third of the nominal area.

        At the highest load the nominal pressure is the smaller of two values: 0.2 times modulus times rms gradient, at which
        about a third of the nominal area touches, and 0.3 times the smallest hardness. The modulus is the contact modulus or,
        if this is smaller, Young's modulus of the film. `load` is not used: a map is slow to solve, so these few loads replace
        it. Raises InputError for a map with too many points.
        """
        from stiction.solvers.boundary_elements.measures import waves
        from stiction.solvers.boundary_elements.sampled import fewest_points

        contact, surface = self.contact, self.surface()
        points = fewest_points(surface.heights, surface.size, surface.periodic)
        if points > _MOST_POINTS:
            allowed = f"at most {_MOST_POINTS} in a comparison; stiction run --model {self.record.key} solves any number"
            raise InputError("points", points, allowed)
        steep = waves(surface.heights, surface.size, surface.periodic).gradient
        stiff, strong = contact.contact_modulus, min(contact.first.hardness, contact.second.hardness)
        if contact.coating is not None:
            film = contact.coating.material
            stiff, strong = min(stiff, film.youngs_modulus), min(strong, film.hardness)
        most = min(_HEAVY * stiff * steep, _OF_HARDNESS * strong)
        return np.geomspace(_LIGHT * most, most, _FEW)[None] * contact.nominal_area / self.factors["N"]

    def _mean_height(self) -> float:
        """Return the mean height of the asperities above the mean plane of the map [m], from which separations are measured."""
        return float(self._measured.mean_heights[self._measured.method])

    def _friction(self, map_contact: "MapContact") -> float:
        """Return the normalised tangential force of the whole contact with all points at full strength.

        map_contact: solved map; its force is scaled to the nominal area of the contact. Raises InputError for adhesive
        contact if the option `shear` needs the pressure of each point.
        """
        assert self.chosen.tangential is not None
        whole = self.contact.nominal_area / map_contact.nominal_area
        of_points = POINT_SHEARS.get(self.options.get("shear", ""))
        if of_points is not None and map_contact.pressure is None:
            raise InputError(
                "shear",
                self.options["shear"],
                "law, because other values need the pressure of each point, which is known only without adhesion",
            )
        if of_points is not None:
            force = sum(float(each.sum()) for _, each in of_points(self.contact, self.chosen.tangential.key, map_contact))
            return force * whole / self.factors["N"]
        force, extent = whole / self.factors["N"], whole / self.factors["m^2"]
        if map_contact.pressure is None:  # without point pressures the law gets the total load and area
            return float(self._sheared(np.array([map_contact.load * force]), map_contact.area * extent, "elastic"))
        of_states = (self._sheared(p * pixel * force, area * extent, state) for state, p, pixel, area in points_of(map_contact))
        return float(sum(of_states))

    def map_friction(self, map_contact: "MapContact") -> float:
        """Return the tangential force [N] of a solved map with all its points at full strength."""
        return self._friction(map_contact) * self.factors["N"] * map_contact.nominal_area / self.contact.nominal_area

    def strengths(self, map_contact: "MapContact") -> np.ndarray:
        """Return the shear strength of every point of a solved map [Pa] (rows, columns), 0 outside of contact.

        Raises InputError without a tangential law, and for adhesive contact, where pressures and strengths of points are
        unknown.
        """
        if self.chosen.tangential is None:
            raise InputError("tangential", "none", "a tangential law, which gives the shear strength of each point")
        if map_contact.pressure is None:
            raise InputError(
                "adhesion", self.options["adhesion"], "left_out, because slip needs contact pressures without adhesion"
            )
        strength = np.zeros_like(map_contact.pressure)
        hardness = float(map_contact.pressure.max()) if map_contact.plastic_area > 0.0 else np.inf
        masks = {
            "elastic": (map_contact.pressure > 0.0) & (map_contact.pressure < hardness),
            "plastic": map_contact.pressure >= hardness,
        }
        pixel = map_contact.nominal_area / strength.size
        for state, force in self._forces(map_contact):
            strength[masks[state]] = force / pixel
        return strength

    def _forces(self, map_contact: "MapContact") -> Iterator[tuple[str, np.ndarray]]:
        """Yield each state of points in contact, "elastic" or "plastic", with the tangential force [N] of its points."""
        assert self.chosen.tangential is not None
        of_points = POINT_SHEARS.get(self.options.get("shear", ""))
        if of_points is not None:
            yield from of_points(self.contact, self.chosen.tangential.key, map_contact)
            return
        whole, unit = self.contact.nominal_area / map_contact.nominal_area, self.factors
        for state, p, pixel, area in points_of(map_contact):
            each = self._each_sheared(p * pixel * whole / unit["N"], area * whole / unit["m^2"], state)
            yield state, each * unit["N"] / whole

    def _sheared(self, loads: np.ndarray, area: float, state: str) -> float:
        """Return the total normalised tangential force of points of the map according to the tangential law.

        loads: normalised load (n,) of each point. area: normalised contact area of each point. state: "elastic" or "plastic".
        """
        return self._each_sheared(loads, area, state).sum()

    def _each_sheared(self, loads: np.ndarray, area: float, state: str) -> np.ndarray:
        """Return the normalised tangential force (n,) of each point of the map according to the tangential law.

        loads: normalised load (n,) of each point. area: normalised contact area of each point. state: "elastic" or "plastic".
        """
        assert self.chosen.tangential is not None
        return resistances(self.chosen.tangential, self.groups, loads[None], np.full((1, loads.size), area), state)[0]
