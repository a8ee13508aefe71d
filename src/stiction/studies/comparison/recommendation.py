"""Which of the models that were asked to trust, and why.

Every model gets a cost: how far it leaves a range, in doublings, times what it means to leave it, and something for how well
its numbers are founded. A model of cost c weighs exp(-c/COST_UNIT); the one recommended is the weighted median by friction
among those of one family, so that one outlier does not win, and nothing hangs on a bound that is just crossed: cost is
continuous there. What cannot be so has no weight at all. The numbers below are this project's judgement, held by the
contacts of tests/compare/test_six_contacts.py.
"""

import math
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from stiction.laws.validity import Doubt
from stiction.records.registry import GRADES
from stiction.solving.accuracy.measured_error import MeasuredErrors
from stiction.solving.candidates import Candidate

# The cost of leaving a range by a factor of two: an effect that is left out weighs more than an assumption strained.
COST_OF_A_DOUBLING = {"effect": 3.0, "assumption": 1.0, "fit": 0.5, "statistics": 0.0}
COST_OF_GRADE = {"A": 0.0, "B": 0.1, "C": 0.5}
# Of a film law off by a factor of two in area on a sphere near this contact, where no surfaces were solved near it.
COST_OF_FILM = 0.5
COST_UNIT = 0.5
# The cost of a measured error of the contact area by a factor of e; where others were measured near this contact and a model
# was not, it is taken for this wrong.
COST_OF_ERROR, NOT_MEASURED = 10.0, 0.3
_COSTS = COST_OF_A_DOUBLING | {"impossible": math.inf}
# A model that weighs less than this beside the best founded one is set aside; with less of the whole weight it is
# not listed, and not recommended unless all have less.
_LITTLE = 0.05
_MOST_DOUBLINGS = 10.0
# Of models that differ by less than this from the weighted median the best founded one stands for it.
_AS_GOOD_AS = 0.02
# Neighbours by friction that differ by this factor are two opinions; less than this is no friction.
_A_GAP, _NO_FRICTION = 2.0, 1e-300
# Where adhesion pulls with less than this share of the load, how exactly it acts does not matter.
_ADHESION_MATTERS = 0.1


# What a model does with the liquid of a contact.
LIQUID = {True: "left out", False: "taken"}


@dataclass
class Answer:
    """What one candidate says, in the units of the contact.

    curve: results (points,); doubtful: of each point whether it is. at_load: results at the working load, None if it cannot
    carry that. outside: ranges of validity that are left at the working load, or anywhere if there is none. effects: what it
    takes account of; of_interface: its friction is the shear strength that the contact states; yielded: what its plastic
    junctions resist, of registry.YIELDED, "" for contact only. adhesion: its pull-off forces over the load. measured: its
    error on solved surfaces near this contact and load; beside_measured: how near the error of any model is known, 0 to 1.
    film_off: by how many factors of two its film law was found off on a sphere near this contact; film_errors: what was
    measured of it, as JSON. liquid: of LIQUID, "" of a dry contact; pull_left_out: of menisci that it leaves out, over the
    load, infinite where that is not known. why_not: why it says nothing, or nothing of friction. of_map: it solves the
    contact's map.
    """

    candidate: Candidate
    grade: str = ""
    title: str = ""
    curve: dict[str, np.ndarray] = field(default_factory=dict)
    doubtful: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    at_load: dict[str, float] | None = None
    outside: list[Doubt] = field(default_factory=list)
    effects: list[str] = field(default_factory=list)
    of_interface: bool = False
    yielded: str = ""
    adhesion: float = math.inf
    measured: MeasuredErrors | None = None
    beside_measured: float = 0.0
    film_off: float = 0.0
    film_errors: str = "[]"
    liquid: str = ""
    pull_left_out: float = math.nan
    sources: list[str] = field(default_factory=list)
    why_not: str = ""
    of_map: bool = False

    @property
    def mu(self) -> float:
        """The friction coefficient at the working load, not a number where there is none."""
        return self.at_load.get("friction_coefficient", np.nan) if self.at_load else np.nan

    @property
    def solved(self) -> bool:
        """Whether it is the solution of the contact's own map at the working load, converged."""
        return (
            self.of_map and self.at_load is not None and not any(one.kind in ("impossible", "effect") for one in self.outside)
        )

    @property
    def trust(self) -> float:
        """How near its measured error is known, 0 to 1."""
        return 0.0 if self.measured is None or not self.measured.known else float(np.min(self.measured.trust))

    @property
    def impossible(self) -> list[Doubt]:
        """Doubts that this can be so at all."""
        return [one for one in self.outside if one.kind == "impossible"]

    @property
    def cost(self) -> float:
        """How ill founded it is, 0 at the best, infinite where it cannot be so."""
        return math.inf if self.impossible else self.cost_if_possible

    @property
    def cost_if_possible(self) -> float:
        """The same of what its authors claim, whether or not the result can be so. The same limit said twice counts once."""
        worst: dict[str, float] = {}
        for doubt in self.outside:
            if doubt.kind != "impossible":
                worst[doubt.quantity] = max(worst.get(doubt.quantity, 0.0), self.cost_of(doubt))
        return COST_OF_GRADE[self.grade] + sum(worst.values()) + self.cost_of_error

    @property
    def cost_of_error(self) -> float:
        """What its measured error costs; where there is none near, that of its film law; between by how near it is."""
        without = COST_OF_FILM * min(self.film_off, _MOST_DOUBLINGS) + COST_OF_ERROR * NOT_MEASURED * self.beside_measured
        if self.trust == 0.0 or self.measured is None:
            return without
        return self.trust * COST_OF_ERROR * float(np.nanmax(self.measured.expected)) + (1.0 - self.trust) * without

    def cost_of(self, doubt: Doubt) -> float:
        """What one doubt costs."""
        cost = _COSTS[doubt.kind] * min(_doublings(doubt), _MOST_DOUBLINGS)
        return cost * min(1.0, self.adhesion / _ADHESION_MATTERS) if doubt.quantity == "tabor_parameter" else cost


def _doublings(doubt: Doubt) -> float:
    """How far a range is left. Of the load without friction by what is left of the rest: friction is wrong by that factor, and
    the share itself never doubles again."""
    if doubt.quantity != "load_share_without_friction":
        return doubt.doublings
    return math.log2((1.0 - doubt.high) / (1.0 - doubt.most)) if doubt.most < 1.0 else math.inf


@dataclass(frozen=True)
class Recommendation:
    """best: the answer to trust, None if there is none; reason: why, in words; low, high: where the middle two thirds of the
    weight of its family are. family: what its friction rests on, in words. advice: what would have to change where there is
    none. set_aside: which models of the family count for next to nothing, and what weighs on them most, a line for each
    reason."""

    best: Answer | None
    reason: str
    low: float = math.nan
    high: float = math.nan
    family: str = ""
    advice: str = ""
    set_aside: str = ""


FAMILIES = {
    True: "interface strength as stated by the contact",
    False: "strength derived from the yield or the adhesion of the bodies",
}


def recommend(answers: list[Answer]) -> Recommendation:
    """The answer to trust, and why."""
    able = [one for one in answers if np.isfinite(one.mu)]
    if not able:
        return Recommendation(None, "no model says anything of friction at this load", advice=_advice(answers))
    possible = [one for one in able if not one.impossible]
    if not possible:
        return Recommendation(None, f"no model holds: {_why_none(able)}", advice=_advice(able))
    if all(map(_knows_nothing_of_the_pull, possible)):
        return Recommendation(None, f"no model holds: {_PULLED}; of the others {_why_none(able)}", advice=_MORE_THAN_THE_PULL)
    if _share_of(possible, able) < _LITTLE:
        return Recommendation(None, f"no model holds: {_BETTER_FOUNDED} {_why_none(able)}", advice=_advice(able))
    stated = any(one.of_interface for one in possible)
    family = sorted((one for one in possible if one.of_interface == stated), key=lambda one: (one.mu, one.candidate.name))
    weights = _weights(family)
    below = np.cumsum(weights)
    middle = family[int(np.searchsorted(below, 0.5 - 1e-12))].mu
    little = weights < _LITTLE * weights.max()  # not of the sum: of many that are equally well founded each has a small share
    best = _nearest([one for one, weight in zip(family, weights, strict=True) if weight > _LITTLE] or family, middle)
    low, high = (family[int(np.searchsorted(below, share - 1e-12))].mu for share in (1.0 / 6.0, 5.0 / 6.0))
    others = [one for one in possible if one.of_interface != stated]
    aside = _set_aside([one for one, aside in zip(family, little, strict=True) if aside], able)
    return Recommendation(best, _reason(best, family, weights, others), low, high, FAMILIES[stated], set_aside=aside)


# Said where only models are possible that owe it to what they leave out.
_BETTER_FOUNDED = "the possible models leave out too much to be believed; among the better founded ones"


def _share_of(possible: list[Answer], able: list[Answer]) -> float:
    """The share of the weight that the possible answers would have, were those counted whose result cannot be so."""
    weights = np.exp(-np.array([one.cost_if_possible for one in able]) / COST_UNIT)
    return float(weights[[one in possible for one in able]].sum() / weights.sum())


# Said where a contact sticks and the models that know it say what cannot be.
_PULLED = "adhesion pulls with more than the load, and the models that are possible leave it out"
_MORE_THAN_THE_PULL = "more load, less work of adhesion, or a rougher surface"


def _knows_nothing_of_the_pull(one: Answer) -> bool:
    """Whether it leaves out adhesion that pulls with more than the load."""
    return any(doubt.quantity == "adhesion_share" and doubt.most > 1.0 for doubt in one.outside)


def _nearest(well_founded: list[Answer], middle: float) -> Answer:
    """The best founded of those nearest to the weighted median, which may itself be of a model that counts for nothing."""
    apart = [abs(math.log(max(one.mu, _NO_FRICTION) / max(middle, _NO_FRICTION))) for one in well_founded]
    near = [one for one, by in zip(well_founded, apart, strict=True) if by <= min(apart) + _AS_GOOD_AS]
    return min(near, key=lambda one: one.cost)


def _two_opinions(family: list[Answer], weights: np.ndarray) -> str:
    """Said where those that count fall into two groups with a gap between: then a small change of input may turn the scale."""
    counted = [one for one, weight in zip(family, weights, strict=True) if weight > _LITTLE]
    gaps = [(high.mu / max(low.mu, _NO_FRICTION), low, high) for low, high in pairwise(counted)]
    widest = max(gaps, key=lambda gap: gap[0], default=None)
    if widest is None or widest[0] < _A_GAP:
        return ""
    share = float(sum(weight for one, weight in zip(family, weights, strict=True) if one.mu <= widest[1].mu))
    ends = f"{share:.0%} of the weight is at {widest[1].mu:.3g} or below, the rest from {widest[2].mu:.3g} on"
    return f"the models are of two opinions: {ends}"


def _weights(family: list[Answer]) -> np.ndarray:
    cost = np.array([one.cost for one in family])
    weights = np.exp(-(cost - cost.min()) / COST_UNIT)
    return weights / weights.sum()


def _reason(best: Answer, family: list[Answer], weights: np.ndarray, others: list[Answer]) -> str:
    """Why this one: what it leaves, what it rests on, who is beside it, and what another family says."""
    beside = [(one, weight) for one, weight in zip(family, weights, strict=True) if one is not best and weight > _LITTLE]
    beside.sort(key=lambda pair: -pair[1])
    shares = ", ".join(f"{one.candidate.name} {one.mu:.3g} ({weight:.0%})" for one, weight in beside)
    own = weights[[one is best for one in family]].item()
    within = [one for one in family if not one.outside]
    lines = [
        _standing(len(family), own),
        f"other models with weight: {shares}" if shares else "",
        _two_opinions(family, weights),
        _left(best, within),
        f"measured error: {best.measured.words}" if best.measured is not None and best.measured.known else "",
        FAMILIES[best.of_interface],
        f"grade {best.grade} ({GRADES[best.grade]})",
        f"takes account of {' and '.join(best.effects)}" if best.effects else "",
        _of_liquid(best),
        _other_family(best, others),
    ]
    return "; ".join(filter(None, lines))


def _of_liquid(best: Answer) -> str:
    """Say that the model leaves out the liquid, and how much that pulls."""
    if best.liquid != LIQUID[True]:
        return ""
    pull = f"{best.pull_left_out:.2g} of the load" if math.isfinite(best.pull_left_out) else "an unknown share of the load"
    return f"leaves out the liquid, whose menisci would pull with {pull}: mu is too low by about that share"


def _standing(models: int, own: float) -> str:
    """How the one recommended stands among the models of its family, with its own share of the weight."""
    if models == 1:
        return "the only model that says anything of friction here: one opinion and no range"
    if own > 1.0 - _LITTLE:
        return f"the best founded of {models} models, with nearly all of the weight: one opinion and no range"
    return f"median of {models} models, each weighted by how well it is founded here ({own:.0%} of the weight is its own)"


# By whether the kind of surface is known: without it the scatter is that over Gaussian surfaces alone.
_WRONG = {
    True: "its contact area differs from solved surfaces near this contact by more than these scatter",
    False: "its contact area differs from solved Gaussian surfaces by more than Gaussian surfaces scatter",
}
_NOT_THERE = "it was not measured near this contact, where others were"


def _set_aside(little: list[Answer], able: list[Answer]) -> str:
    """Models that count for little or cannot be so, by the doubt that weighs most on each; not those whose error is within the
    scatter of the solved surfaces."""
    by_reason: dict[str, list[str]] = {}
    for one in [*little, *(one for one in able if one.impossible)]:
        worst = max(one.impossible or one.outside, key=one.cost_of, default=None)
        name = f"{one.candidate.name} {one.mu:.3g}"
        if one.impossible or one.cost_of_error <= max((one.cost_of(doubt) for doubt in one.outside), default=0.0):
            said = worst.rule if worst else f"grade {one.grade}"
        elif one.measured is None or not one.measured.known:
            said = _NOT_THERE
        elif one.measured.is_off:
            said, name = _WRONG[one.measured.kind_known], f"{name} (area {np.expm1(one.measured.area.item()):+.0%})"
        else:
            continue
        by_reason.setdefault(said, []).append(name)
    return "\n".join(f"{said}: {', '.join(names)}" for said, names in by_reason.items())


def _left(best: Answer, within: list[Answer]) -> str:
    if best.outside:
        return f"outside of its validity: {', '.join(dict.fromkeys(one.short for one in best.outside))}"
    if len(within) == 1:
        return "the only one within its validity, which is one opinion and no range"
    return f"within its validity, as {len(within)} of them are"


def _other_family(best: Answer, others: list[Answer]) -> str:
    if not others:
        return ""
    ends = "to".join(
        dict.fromkeys(f" {value:.3g} " for value in (min(one.mu for one in others), max(one.mu for one in others)))
    )
    return f"models of another family ({FAMILIES[not best.of_interface]}) say{ends.rstrip()} and are not compared with it"


def _why_none(answers: list[Answer]) -> str:
    """What cannot be so, each reason once, with how many models it meets."""
    reasons: dict[str, int] = {}
    for doubt in (doubt for one in answers for doubt in one.impossible):
        reasons[doubt.rule] = reasons.get(doubt.rule, 0) + 1
    return "; ".join(f"{rule} ({count} of {len(answers)} models)" for rule, count in reasons.items())


# How the reason begins of a model that does not carry the load.
TOO_MUCH = "carries loads up to"
_ADVICE = {
    "area_fraction": ("less load", "a larger nominal area", "a rougher or harder surface"),
    "nominal_pressure_over_hardness": ("less load", "a larger nominal area"),
    "sharpness": ("asperity_height_deviation and asperity_radius as they are of a rough surface",),
    "roughness_parameter": ("an asperity_density that goes with sigma and R: N R sigma of random surfaces is 0.02 to 0.2",),
    "pressure_over_punching": ("a thicker film", "a harder body below the film"),
    "nominal_width": ("a nominal_area that is wide against the roughness",),
}


def _advice(answers: list[Answer]) -> str:
    """What would have to change for a model to hold."""
    met = dict.fromkeys(doubt.quantity for one in answers for doubt in one.impossible)
    if not met and any(one.why_not.startswith(TOO_MUCH) for one in answers):
        met = {"nominal_pressure_over_hardness": None}
    ways = [way for name in met if name in _ADVICE for way in _ADVICE[name]]
    return "; ".join(dict.fromkeys(ways))
