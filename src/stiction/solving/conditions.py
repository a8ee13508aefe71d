"""Check validity conditions for the results of every model, in addition to the ranges that the authors of the laws state.

A rule limits one quantity: a number from `solving.state`, a result, or a property of the contact. Each rule has a function
that returns whether the rule applies to a problem. Bounds are round numbers. The text of each rule states which assumption
fails beyond its bounds. A model with an "impossible" result is never recommended.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from math import inf
from typing import Any

import numpy as np

from stiction.laws.meniscus.equilibrium_meniscus import KELVIN
from stiction.laws.proportion import OUT_OF_PROPORTION
from stiction.laws.validity import violated_ranges, warnings_about
from stiction.quantities.dimensions import aligned
from stiction.records.claims import Validity
from stiction.records.registry import JUNCTIONS, NO_JUNCTIONS
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.limits import LEAST_WAVES
from stiction.solving.on_map import MapProblem
from stiction.solving.problem import Problem, lost_in_rounding
from stiction.solving.state import state_of

# Theories that end at full contact may exceed an area fraction of 1 by round-off.
_ROUNDING = 1e-9


def _any(problem: Problem) -> bool:
    return True


def _by_numbers(problem: Problem) -> bool:
    """Return whether the model uses roughness numbers; False for a model that solves a height map."""
    return problem.record.of_map is None


def _at_random(problem: Problem) -> bool:
    """Return whether the model uses roughness numbers that are statistics of random heights.

    The result is False for a model that solves a height map, and for asperities whose heights are listed one by one.
    """
    return _by_numbers(problem) and not problem.heights.listed.size


def _of_asperities(problem: Problem) -> bool:
    """Return whether the theory is limited to small contact areas because it neglects the interaction of contact spots."""
    return not problem.record.up_to_full_contact


def _does_not_adhere(problem: Problem) -> bool:
    return not problem.adheres


def leaves_out_liquid(problem: Problem) -> bool:
    """Return whether the contact has a liquid that its model neglects."""
    return (
        problem.groups.meniscus_index is not None
        and "meniscus" not in problem.chosen.additions
        and not _solves_menisci(problem)
    )


def _solves_menisci(problem: Problem) -> bool:
    return isinstance(problem, MapProblem) and problem.menisci


def _shears_the_interface(problem: Problem) -> bool:
    return any("shear_strength" in record.needs for record in problem.records())


def _does_not_grow(problem: Problem) -> bool:
    """Return whether friction is computed on a bare contact without junction growth.

    The result is False for contacts with a film, because no law covers junction growth on films.
    """
    grows = problem.chosen.yielded != "interface" or problem.options.get("shear") == "junction_growth"
    return not grows and not problem.groups.has_film


def _elastic_on_a_film(problem: Problem) -> bool:
    """Return whether elastic results of a coated contact must be checked with the plasticity index of the film.

    This is the case if film and body are solved as one elastic solid and the validity of the asperity law is limited by the
    plasticity index, because that index is computed without the film.
    """
    film, asperity = problem.chosen.film, problem.chosen.asperity
    if film is None or asperity is None or not film.solved_as_one:
        return False
    return any(rule.quantity == "plasticity_index" for rule in asperity.validity)


_FEW = "too few contacts for an average: their number n scatters by 1/sqrt(n)"

RULES: tuple[tuple[Validity, Callable[[Problem], bool]], ...] = (
    *((rule, _by_numbers) for rule in OUT_OF_PROPORTION),
    (Validity("area_fraction", 0.0, 1.0 + _ROUNDING, "the real contact area exceeds the nominal area", "impossible"), _any),
    (Validity("nominal_pressure_over_hardness", -inf, 1.0, "the surfaces are pressed flat", "impossible"), _any),
    (Validity("mean_pressure_over_hardness", -inf, 1.05, "the mean contact pressure exceeds the hardness", "effect"), _any),
    (Validity("strength_over_bodies", 0.0, 1.0 + _ROUNDING,
              "the interface is stronger than the bodies: the weaker body limits mu"), _shears_the_interface),
    (Validity("grown_area_ratio", 1.0, 2.0, "junction growth under shear is left out, so mu is too low", "effect"),
     _does_not_grow),
    (Validity("pressure_over_body_below", 0.0, 1.05, "the body below a hard film yields, so mu is too low", "effect"), _any),
    (Validity("pressure_over_body_below", 0.0, 0.8, "the body below yields: the film may crack, and mu then rises"), _any),
    (Validity("pressure_over_punching", 0.0, 1.1, "the film would be punched through, so mu is too low", "impossible"), _any),
    (Validity("film_plasticity_index", 0.0, 0.6, "asperities are modelled as elastic, but film or counterbody yields",
              "effect"), _elastic_on_a_film),
    (Validity("load_share_without_friction", 0.0, 0.5, "most of the load is on asperities without friction", "effect"), _any),
    (Validity("adhesion_share", 0.0, 0.1, "adhesion is left out, but is a large share of the load", "effect"),
     _does_not_adhere),
    (Validity("meniscus_share", 0.0, 0.1, "the liquid is left out, but its pull is a large share of the load", "effect"),
     leaves_out_liquid),
    (KELVIN, _solves_menisci),
    (Validity("area_fraction", 0.0, 0.1, "theories of single asperities hold for small contact areas only"), _of_asperities),
    (Validity("touching_share", 0.0, 0.5, "most asperities touch: the flat is below their mean height"), _at_random),
    (Validity("sharpness", 0.0, 0.3, "asperities are too sharp for the theory of small contacts"), _by_numbers),
    (Validity("rms_slope", 0.0, 0.3, "slopes are too steep for half-spaces"), _at_random),
    (Validity("roughness_parameter", 1e-3, 1.0, "asperities are unlike those of a random surface"), _at_random),
    (Validity("thickness_over_radius", 0.0, 1.0, "the film is so thick that it rounds off the asperities"), _by_numbers),
    (Validity("size_effect", 0.0, 10.0, "no measured metal is that much harder under small asperities"), _any),
    (Validity("longest_waves_on_a_side", LEAST_WAVES, inf, "the map is too small a sample of its surface", "statistics"), _any),
    (Validity("touching_asperities", 10.0, inf, _FEW, "statistics"), _at_random),
)  # fmt: skip


def warnings_of_results(problem: Problem, results: Mapping[str, np.ndarray]) -> list[ValidityWarning]:
    """Return all validity warnings about normalised results, based on the ranges of the laws in use and on RULES.

    results: arrays by name.
    """
    return without_repeats(warnings_about(problem.subject, rules_of(problem), _known(problem, results)))


def warnings_of_rounding(carried: np.ndarray, asked: np.ndarray) -> list[ValidityWarning]:
    """Return one validity warning, in a list, if requested loads were lost in round-off; otherwise an empty list.

    carried, asked: computed and requested normalised loads, arrays of the same shape.
    """
    lost = lost_in_rounding(carried, asked)
    if not lost.any():
        return []
    where = f"in {lost.sum()} of {lost.size} points" if lost.size > 1 else "here"
    off = np.abs(carried[lost] / asked[lost] - 1.0).max()
    off_by = f"the computed load differs by up to {off:.2g} times the requested load"
    why = f"the requested load is below round-off {where}, or the load jumps over it: {off_by}"
    return [ValidityWarning(why, kind="impossible")]  # because there is no result at the requested load


# State of a point of a curve: inside all validity ranges, outside of one, or physically impossible.
WITHIN, OUTSIDE, IMPOSSIBLE = range(3)


def points_outside(problem: Problem, curve: Mapping[str, np.ndarray]) -> np.ndarray:
    """Classify each point (m,) of a curve as WITHIN all validity ranges, OUTSIDE at least one, or physically IMPOSSIBLE.

    curve: normalised results (1, m) of a single contact, by name.
    """
    status = np.full(curve["load"].shape, WITHIN)
    for rule, _, outside in violated_ranges(problem.subject, rules_of(problem), _known(problem, curve)):
        status = np.maximum(status, np.where(outside, IMPOSSIBLE if rule.kind == "impossible" else OUTSIDE, WITHIN))
    return status[0]


def rules_of(problem: Problem) -> list[Validity]:
    """Return every validity range that results of this problem can violate, without duplicates.

    The list depends on the laws and the problem, not on the values of its results.
    """
    if "rules" not in problem.shared:
        problem.shared["rules"] = list(dict.fromkeys(_rules_for(problem)))
    return problem.shared["rules"]


def excludes(rule: Validity) -> bool:
    """Return whether a sample of uncertain inputs is excluded if its results violate this range.

    The result is True for ranges beyond which results are impossible, and for the range that limits the mean contact
    pressure to the hardness.
    """
    return rule.kind == "impossible" or rule.quantity == "mean_pressure_over_hardness"


def rules_violated(problem: Problem, results: Mapping[str, np.ndarray]) -> list[np.ndarray]:
    """Return one mask for each range of `rules_of`, True where results lie outside the range.

    Masks are (n, m) for n contacts and m points, or (n, 1) for ranges that do not depend on points; False where the value is
    unknown. results: normalised arrays by name, with the dimensions of the contacts first.
    """
    known, contacts = _known(problem, results), len(problem.groups)
    found = []
    for rule in rules_of(problem):
        value = known[rule.quantity]
        if value is None:
            found.append(np.zeros((contacts, 1), dtype=bool))
            continue
        if hasattr(value, "dims"):
            value = np.broadcast_to(aligned(value, problem.dims), problem.shape)
        values = np.asarray(value, dtype=float)
        values = values.reshape(contacts, -1) if values.size > 1 else np.full((contacts, 1), values.item())
        found.append((values < rule.low) | (values > rule.high))
    return found


def _known(problem: Problem, results: Mapping[str, np.ndarray]) -> dict[str, Any]:
    """Return the values of all quantities that the rules limit, by name; None if unknown."""
    if "groups" not in problem.shared:
        problem.shared["groups"], problem.shared["of_contact"] = _of_groups(problem), {}
    # The result touching_asperities is a fraction; the rule needs a number, which state_of gives if it is known.
    known = problem.shared["groups"] | dict(results) | {"touching_asperities": None} | state_of(problem, results)
    of_contact = problem.shared["of_contact"]
    for name in {rule.quantity for rule in rules_of(problem)} - known.keys():
        if name not in of_contact:
            of_contact[name] = problem.subject.known(name)
        known[name] = of_contact[name]
    return known


def _of_groups(problem: Problem) -> dict[str, Any]:
    """Return dimensionless groups of n contacts, and quantities derived from them, by name: each (n, 1), None if unknown.

    The values are read from the groups of the problem, because the contact would recompute all groups at each access.
    """
    groups = problem.groups
    names = [
        *type(groups).model_fields,
        "film_plasticity_index",
        "yield_strain",
        "film_stiffness",
        "meniscus_tabor_parameter",
        "meniscus_over_radius",
    ]
    return {name: None if (value := getattr(groups, name)) is None else np.reshape(value, (-1, 1)) for name in names}


def _rules_for(problem: Problem) -> list[Validity]:
    """Return the rules of RULES that apply to a problem, and the ranges that the laws in use claim."""
    rules = [rule for rule, applies in RULES if applies(problem)]
    if _hardens(problem):  # a hardening metal may bear more than its hardness, so exceeding it is not impossible
        hardness = "nominal_pressure_over_hardness"
        rules = [replace(rule, kind="assumption") if rule.quantity == hardness else rule for rule in rules]
    as_published = problem.options.get(JUNCTIONS, NO_JUNCTIONS) == NO_JUNCTIONS
    claimed = (rule for record in problem.records() for rule in record.validity)
    return [*rules, *(rule for rule in claimed if as_published or not rule.as_published)]


def _hardens(problem: Problem) -> bool:
    """Return whether every contact has a work-hardening metal and a law in use includes hardening.

    Under a law without hardening no contact spot bears more than the hardness.
    """
    hardening = problem.groups.hardening
    known = any("hardening" in (*record.needs, *record.takes) for record in problem.records())
    return known and hardening is not None and bool(np.all(np.asarray(hardening) > 0.0))


def without_repeats(warnings: Iterable[ValidityWarning]) -> list[ValidityWarning]:
    """Drop validity warnings whose quantity also has a warning of kind "impossible", and return all others.

    For example, a value above 1, which is impossible, is also above 0.1. Warnings of kind "impossible" stay.
    """
    warnings = list(warnings)
    worst = {warning.quantity for warning in warnings if warning.kind == "impossible"}
    return [warning for warning in warnings if warning.kind == "impossible" or warning.quantity not in worst]
