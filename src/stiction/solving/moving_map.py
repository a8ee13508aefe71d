"""Represent a solved map that is displaced tangentially: its contacts, strengths and shear solver."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from stiction.laws.rough_surface.boundary_elements import shear_compliance_of
from stiction.solving.on_map import MapProblem

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.solvers.shear.operators import ShearOperator
    from stiction.solvers.shear.path import SlidingPath, Weakening
    from stiction.surfaces.heightmap import HeightMap

__all__ = ["MovingMap"]


@dataclass(frozen=True)
class MovingMap:
    """Represent a solved map that is displaced tangentially at one or more loads.

    Shear does not change its pressure, except in the subclass UnlikeBodies. problem: contact and laws. contacts: solution
    without shear at each load. strengths: shear strength [Pa] of the points (rows, columns) at each load. operator: computes
    shear displacements. remark: text for the user on what the solution neglects, or "". farther: end of the default
    displacements at constant strength, divided by the displacement at which every point of the uncoupled map slips.
    """

    farther: ClassVar[float] = 1.0

    problem: MapProblem
    contacts: "tuple[MapContact, ...]"
    strengths: tuple[np.ndarray, ...]
    operator: "ShearOperator"
    remark: str = ""

    @classmethod
    def of(cls, problem: MapProblem, contacts: "tuple[MapContact, ...]") -> "MovingMap":
        """Build the moving map from contacts solved without shear, one for each load.

        Raises InputError if the shear strength of the points is unknown.
        """
        strengths = tuple(problem.strengths(one) for one in contacts)
        return cls(problem, contacts, strengths, operator_of(problem, problem.surface()))

    @property
    def nominal_area(self) -> float:
        """Return the nominal area of the solved map [m2]."""
        return self.contacts[0].nominal_area

    def pixel(self, index: int) -> float:
        """Return the area [m2] of a map point at the load with this index."""
        return self.nominal_area / self.strengths[index].size

    def path(self, index: int, shifts: np.ndarray, weakening: "Weakening | None") -> "SlidingPath":
        """Return the solutions of the map under load number `index` at the rigid tangential displacements `shifts` [m].

        The displacements are solved in the given order. weakening: how strength falls with slip; None for constant strength.
        """
        from stiction.solvers.shear.path import slide_map

        strength, pixel = self.strengths[index], self.pixel(index)
        return slide_map(self.operator, strength, shifts.tolist(), pixel=pixel, weakening=weakening, keep_maps=False)

    def remark_on(self, paths: "list[SlidingPath]") -> str:
        """Return a remark for the user on what the solution neglects, or on its coupling error; "" if there is none."""
        return self.remark

    def results(self, paths: "list[SlidingPath]") -> "dict[str, np.ndarray]":
        """Return additional results at each load, as arrays (m,) by name; this class has none."""
        return {}

    def curves(self, paths: "list[SlidingPath]") -> "dict[str, np.ndarray]":
        """Return additional results at each load and displacement, as arrays (m, k) by name; this class has none.

        Areas [m2] are those of the solved map.
        """
        return {}


def operator_of(problem: MapProblem, surface: "HeightMap") -> "ShearOperator":
    """Return the operator that computes shear displacements of a map with the bodies of this problem.

    surface: the map, either one period of an endless surface, or a window that is continued by its mirror images.
    """
    from stiction.solvers.shear.operators import MirroredShear, PeriodicShear

    boundary = PeriodicShear if surface.periodic else MirroredShear
    return boundary(shear_compliance_of(problem.contact), surface.heights.shape, surface.size)
