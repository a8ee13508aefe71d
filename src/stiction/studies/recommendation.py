"""Which of the models that were asked to trust, and why."""

from dataclasses import dataclass, field

import numpy as np

from stiction.laws.registry import GRADES
from stiction.laws.validity import Doubt
from stiction.solving.choice import Choice


@dataclass(frozen=True)
class Candidate:
    """A model as it may be applied to a contact: its name in the comparison, and what is chosen."""

    name: str
    choice: Choice


@dataclass
class Answer:
    """What one candidate says, in the units of the contact. curve: results (points,); at_load: results at the working load,
    None if it cannot carry that. outside: ranges of validity that are left at the working load, or anywhere if there is none.
    effects: what it takes account of; of_interface: its friction is the shear strength that the contact states. why_not: why
    it says nothing, or nothing of friction."""

    candidate: Candidate
    grade: str = ""
    title: str = ""
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    at_load: dict[str, float] | None = None
    outside: list[Doubt] = field(default_factory=list)
    effects: list[str] = field(default_factory=list)
    of_interface: bool = False
    sources: list[str] = field(default_factory=list)
    why_not: str = ""

    @property
    def mu(self) -> float:
        """The friction coefficient at the working load, not a number where there is none."""
        return self.at_load.get("friction_coefficient", np.nan) if self.at_load else np.nan


def recommend(answers: list[Answer]) -> tuple[Answer | None, str]:
    """The answer to trust, and why: of those that say something of friction, the least outside their validity; then those
    that use the shear strength of the interface, if it is stated; then the best grade; then what takes account of most; and of
    all that are left the middle one."""
    able = [one for one in answers if np.isfinite(one.mu)]
    if not able:
        return None, "no model says anything of friction at this load"
    stated = any(one.of_interface for one in able)

    def rank(one: Answer) -> tuple[int, bool, str, int]:
        return len(one.outside), stated and not one.of_interface, one.grade, -len(one.effects)

    alike = sorted((one for one in able if rank(one) == min(map(rank, able))), key=lambda one: one.mu)
    best = alike[(len(alike) - 1) // 2]
    within = sum(not one.outside for one in able)
    reasons = [
        f"no model is within its validity here, and this leaves the fewest ranges ({len(best.outside)})"
        if best.outside
        else f"within its validity here, as {within} of the {len(able)} models that predict friction are",
        "uses the stated shear strength of the interface" if best.of_interface else "",
        f"grade {best.grade} ({GRADES[best.grade]})",
        f"takes account of {' and '.join(best.effects)}" if best.effects else "",
        f"the middle one of {len(alike)} alike" if len(alike) > 1 else "",
    ]
    return best, "; ".join(filter(None, reasons))
