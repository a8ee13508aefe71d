"""Displace an adhesive map tangentially; with a law of mode mixity, shear lowers its adhesion."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.laws.rough_surface.boundary_elements import attraction_of, bodies_of, shear_compliance_of
from stiction.quantities.errors import InputError, InWords
from stiction.solvers.shear.mode_mixity import MODE_MIXITIES
from stiction.solving.moving_map import MovingMap
from stiction.solving.on_map import MapProblem

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.adhesive import AdhesiveState
    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.solvers.shear.path import SlidingPath, Weakening

__all__ = ["AdhesiveMap", "PeelingMap", "without_mode_mixity"]


def without_mode_mixity(problem: MapProblem) -> MapProblem:
    """Return the problem with the option mode_mixity set to "none": shear then does not change the adhesion.

    Raises InputError if a law of mode mixity (how shear lowers adhesion) is selected for a contact without adhesion.
    """
    law = problem.options.get("mode_mixity", "none")
    if law != "none" and not problem.adheres:
        raise InputError("mode_mixity", law, "none, or the option adhesion = shortest_range: without adhesion nothing peels")
    return replace(problem, chosen=problem.chosen.with_option("mode_mixity", "none"))


@dataclass(frozen=True)
class AdhesiveMap(MovingMap):
    """Represent an adhesive map at one load that is displaced tangentially; shear does not change its adhesion.

    All touching points have the same strength.
    """

    @classmethod
    def of(cls, problem: MapProblem, contacts: "tuple[MapContact, ...]") -> "AdhesiveMap":
        from stiction.solvers.shear.operators import PeriodicShear

        if len(contacts) != 1:
            raise InputError("load", InWords(f"{len(contacts)} loads"), "one load at a time with adhesion")
        contact = _adhesive_state(problem, contacts[0])
        operator = PeriodicShear(shear_compliance_of(problem.contact), contact.gap.shape, contact.grid.size)
        return cls(problem, contacts, (_strength(problem, contacts[0], contact),), operator, _remark(problem))


@dataclass(frozen=True)
class PeelingMap(AdhesiveMap):
    """Represent an adhesive map at one load that is displaced tangentially; shear lowers its adhesion by a mode-mixity law."""

    def path(self, index: int, shifts: np.ndarray, weakening: "Weakening | None") -> "SlidingPath":
        from stiction.solvers.shear.peeling import slide_and_peel

        one, peeling = self.contacts[index], self.problem.contact.peeling

        def strength(state: "AdhesiveState") -> np.ndarray:
            return _strength(self.problem, one, state)

        work, _ = _attraction(self.problem)
        return slide_and_peel(
            _adhesive_state(self.problem, one), self.operator, strength, shifts.tolist(), work=work,
            law=MODE_MIXITIES[self.problem.options["mode_mixity"]], zeta=1.0 if peeling is None else float(peeling),
            weakening=weakening,
        )  # fmt: skip

    def curves(self, paths: "list[SlidingPath]") -> dict[str, np.ndarray]:
        return {"sheared_contact_area": np.array([[state.contact.area for state in path.states] for path in paths])}  # type: ignore[attr-defined]


def _remark(problem: MapProblem) -> str:
    """Return a remark for the user on the grade and evidence of the selected law of mode mixity; "" without such a law."""
    name = problem.options["mode_mixity"]
    if name == "none":
        return ""
    law = MODE_MIXITIES[name]
    return f"mode mixity after {law.source} (grade {law.grade}; {law.evidence}): the physics is disputed"


def _attraction(problem: MapProblem) -> tuple[float, float]:
    """Return the work of adhesion [J/m2] and the range of attraction [m] of the contact."""
    return attraction_of(problem.surface(), problem.contact, bodies_of(problem.contact), problem.options["adhesion"])


def _adhesive_state(problem: MapProblem, map_contact: "MapContact") -> "AdhesiveState":
    """Solve the adhesive map again at the load of `map_contact`, and return the state with the gap of every point."""
    from stiction.solvers.boundary_elements.adhesive import adhesive_state

    surface, bodies = problem.surface(), bodies_of(problem.contact)
    work, reach = _attraction(problem)
    return adhesive_state(
        surface.heights, surface.size, modulus=bodies.modulus, load=map_contact.load, work=work, reach=reach, film=bodies.film,
        finer=True,
    )  # fmt: skip


def _strength(problem: MapProblem, map_contact: "MapContact", state: "AdhesiveState") -> np.ndarray:
    """Return the shear strength of every point [Pa] (rows, columns), 0 for points that do not touch.

    It is the friction force of the whole contact, divided equally among the touching points.
    """
    touching = state.touching
    count = int(np.count_nonzero(touching))
    if count == 0:
        return np.zeros(touching.shape)
    return np.where(touching, problem.map_friction(replace(map_contact, area=state.area)) / (count * state.pixel), 0.0)
