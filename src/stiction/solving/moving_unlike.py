"""Tangentially displace a map of two bodies with unlike elastic constants, which couple pressure and shear.

A window that is not periodic is completed to one period by its mirror images, because the coupled tractions are not symmetric
about its sides.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from stiction.laws.rough_surface.boundary_elements import bodies_of, shear_compliance_of
from stiction.solving.moving_map import MovingMap, operator_of
from stiction.solving.on_map import MapProblem

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.solvers.shear.coupled import CoupledState, Coupling, Pressing
    from stiction.solvers.shear.path import SlidingPath, Weakening
    from stiction.surfaces.heightmap import HeightMap

__all__ = ["UnlikeBodies", "are_unlike", "effect_of_coupling"]

_LEAST_BETA = 1e-3  # Dundurs' parameter beta from which coupling is computed; below, it changes forces by less than 1e-4


def are_unlike(problem: MapProblem) -> bool:
    """Return whether the elastic constants of the two bodies differ so much that pressure and shear must be coupled."""
    return _coupling_of(problem, problem.surface()).beta > _LEAST_BETA


@dataclass(frozen=True)
class UnlikeBodies(MovingMap):
    """Represent a map of two bodies with unlike elastic constants, which couple pressure and shear.

    Contacts are stored for one period of the map; for a window this includes its mirror images.
    """

    farther: ClassVar[float] = 1.5

    @classmethod
    def of(cls, problem: MapProblem, contacts: "tuple[MapContact, ...]") -> "UnlikeBodies":
        if not problem.surface().periodic:
            contacts = tuple(_contact_of_period(one) for one in contacts)
        strengths = tuple(problem.strengths(one) for one in contacts)
        return cls(problem, contacts, strengths, operator_of(problem, _period(problem.surface())))

    @cached_property
    def surface(self) -> "HeightMap":
        """Return one period of the surface: the periodic map itself, or a window completed by its mirror images."""
        return _period(self.problem.surface())

    @cached_property
    def coupling(self) -> "Coupling":
        """Return the operator that couples pressure and shear on one period of the map."""
        return _coupling_of(self.problem, self.surface)

    def path(self, index: int, shifts: np.ndarray, weakening: "Weakening | None") -> "SlidingPath":
        from stiction.solvers.shear.coupled import slide_coupled

        pressing = self.pressing(index)
        path = slide_coupled(
            self.operator, self.coupling, pressing, lambda pressure: self.strength_at(index, pressure), shifts.tolist(),
            pixel=self.pixel(index), weakening=weakening,
        )  # fmt: skip
        return path if pressing.converged else replace(path, states=tuple(replace(s, converged=False) for s in path.states))

    def pressing(self, index: int) -> "Pressing":
        """Return the solver for the pressure under shear at the load with this index; it starts from the unsheared contact."""
        from stiction.solvers.boundary_elements.compliance import Compliance
        from stiction.solvers.boundary_elements.measures import rms_step
        from stiction.solvers.boundary_elements.minimise import Problem
        from stiction.solvers.boundary_elements.operators import PeriodicBoundary
        from stiction.solvers.shear.coupled import Pressing

        surface, bodies, one = self.surface, bodies_of(self.problem.contact), self.contacts[index]
        assert one.pressure is not None
        compliance = Compliance(bodies.modulus, bodies.film, bodies.counter_film)
        displacement = PeriodicBoundary(compliance, surface.heights.shape, surface.size)
        mean = float(one.pressure.mean())
        problem = Problem(displacement, surface.heights, mean, self._hardness, rms_step(surface.heights))
        return Pressing(problem, one.pressure)

    @property
    def _hardness(self) -> float:
        """Return the largest pressure that the bodies can carry [Pa]; infinite if they do not yield."""
        hardness = bodies_of(self.problem.contact).hardness
        return math.inf if hardness is None or self.problem.options["yielding"] == "none" else float(hardness)

    def strength_at(self, index: int, pressure: np.ndarray) -> np.ndarray:
        """Return the shear strength of every point [Pa] from its pressure [Pa], both (rows, columns).

        index: index of the load.
        """
        return self.problem.strengths(self._with_pressure(index, pressure))

    def _with_pressure(self, index: int, pressure: np.ndarray) -> "MapContact":
        from stiction.solvers.boundary_elements.measures import corrected_area

        plastic = np.count_nonzero(pressure >= self._hardness)
        points, pixel = np.count_nonzero(pressure), self.pixel(index)
        return replace(
            self.contacts[index], pressure=pressure, points=int(points), area_pixels=points * pixel,
            area=corrected_area(pressure, pixel, True, self._hardness), plastic_area=plastic * pixel,
        )  # fmt: skip

    def results(self, paths: "list[SlidingPath]") -> dict[str, np.ndarray]:
        return {"coupling_residual": np.array([max(max(s.change, s.misfit) for s in _states(path)) for path in paths])}

    def remark_on(self, paths: "list[SlidingPath]") -> str:
        error = float(self.results(paths)["coupling_residual"].max())
        return f"pressure and shear of these unlike bodies are coupled, with an error of at most {100.0 * error:.2g} %"

    def curves(self, paths: "list[SlidingPath]") -> dict[str, np.ndarray]:
        areas = [[self._with_pressure(at, state.pressure).area for state in _states(path)] for at, path in enumerate(paths)]
        return {"sheared_contact_area": np.array(areas)}


def effect_of_coupling(problem: MapProblem, contacts: "tuple[MapContact, ...]") -> float:
    """Return the largest relative change of friction due to the coupling of pressure and shear, among all loads.

    contacts: solved without shear, one for each load. Friction is computed with all points sliding, each with the strength
    for its pressure. The pull of menisci is included in the load.
    """
    from stiction.solvers.shear.coupled import force_when_all_slide

    moving = UnlikeBodies.of(problem, contacts)

    def effect(index: int) -> float:
        def strength(pressure: np.ndarray) -> np.ndarray:
            return moving.strength_at(index, pressure)

        pressing = moving.pressing(index)
        alone = pressing(np.zeros(moving.coupling.shape))
        coupled, _ = force_when_all_slide(moving.coupling, pressing, strength, alone)
        return abs(coupled / float(strength(alone).sum()) - 1.0)

    return max(effect(index) for index in range(len(contacts)))


def _states(path: "SlidingPath") -> "tuple[CoupledState, ...]":
    return path.states  # type: ignore[return-value]  # `slide_coupled` makes no others


def _coupling_of(problem: MapProblem, surface: "HeightMap") -> "Coupling":
    from stiction.solvers.shear.coupled import Coupling

    return Coupling(shear_compliance_of(problem.contact), surface.heights.shape, surface.size, periodic=True)


def _period(surface: "HeightMap") -> "HeightMap":
    """Return a periodic map unchanged, and a window together with its mirror images as one period."""
    if surface.periodic:
        return surface
    rows, columns = surface.size
    return replace(surface, heights=_mirrored(surface.heights), size=(2.0 * rows, 2.0 * columns), periodic=True)


def _contact_of_period(one: "MapContact") -> "MapContact":
    """Extend the contact of a window to a whole period, the window with its mirror images.

    Only the attributes that `slide` needs are changed.
    """
    assert one.pressure is not None
    areas = {name: 4.0 * getattr(one, name) for name in ("nominal_area", "area", "area_pixels", "plastic_area")}
    return replace(one, load=4.0 * one.load, points=4 * one.points, pressure=_mirrored(one.pressure), **areas)


def _mirrored(window: np.ndarray) -> np.ndarray:
    rows = np.concatenate([window, window[::-1]])
    return np.concatenate([rows, rows[:, ::-1]], axis=1)
