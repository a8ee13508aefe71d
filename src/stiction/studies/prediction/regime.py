"""The state of a contact in one sentence, and the input to measure next."""

import math
from collections.abc import Mapping

import numpy as np

from stiction.solvers.boundary_elements.limits import LEAST_WAVES
from stiction.solving.state import of_the_map
from stiction.studies.prediction.mixture import Mixture, Samples

__all__ = ["next_step", "regime_of", "warnings_of"]

_STICKS = 2.0  # factor of the area by adhesion above which it, and not the load, makes the contact
_FLAT = 0.95  # of the nominal area
_PLASTIC = 0.9  # mean pressure over hardness
_GROWN = 1.5  # area after shear over that before
_FEW = 10.0
_STEEP = 0.93  # strength of the interface over the body's, c: ln mu goes with 1/(1 - c^2) times ln c, 0.15 for 2 % here
_DECIDES = 0.05  # share of the variance from which on a part is worth a warning
_MANY = 0.05  # share of draws that cannot be, from which on it is said


def regime_of(mixture: Mixture, samples: Samples, at: int) -> str:
    """Return the state of the contact at the load of this number, in one or two sentences."""
    asked = mixture.asked
    area, pull, growth, pressure = (
        float(np.nanmedian(np.broadcast_to(one, samples.area.shape)[:, at]))
        for one in (samples.area, samples.pull, samples.growth, samples.pressure)
    )
    nominal = float(np.median(asked.drawn.nominal_area))
    touching = float(mixture.touching[at])
    said = []
    if pull > _STICKS:
        said.append("Adhesion carries more than the load: the contact sticks by itself, and the friction force is the answer.")
    if area > _FLAT * nominal:
        said.append("Pressed flat: mu = tau_0 A_n/P.")
    elif pressure > _PLASTIC:
        grows = ", times the growth of junctions under shear" if growth > _GROWN else ""
        said.append(f"All contacts are plastic: mu = tau_0/H{grows}, whatever the roughness.")
    else:
        said.append(_of_pressure(mixture, pressure, at))
    if touching < _FEW:
        count = round(max(touching, 1.0))
        said.append(
            f"About {count} {'asperity touches' if count == 1 else 'asperities touch'}: mu varies from one place to the next."
        )
    return " ".join(said[:2])


def _of_pressure(mixture: Mixture, pressure: float, at: int) -> str:
    """Return what contacts bear whose mean pressure is this over the hardness of the softer of the surfaces that meet."""
    contact, hardness = mixture.asked.contact, float(np.median(mixture.asked.bodies.hardness))
    carried = min(float(np.median(law.yields_at[:, at])) for law in mixture.laws)
    if contact.coating is None or not carried < hardness or pressure * hardness < _PLASTIC * carried:
        return (
            f"The mean pressure of the spots is {100.0 * pressure:.2g}% of the hardness: mu rises with the real contact area."
        )
    coated = [getattr(contact, name) for name in ("first", "second") if contact.coating.bodies in (name, "both")]
    below = min(coated, key=lambda body: float(np.mean(body.hardness)))
    softer = "film" if contact.softer_counterbody is None else "counterbody"
    return (
        f"The body below the film yields{'' if below.name == 'unnamed' else f', {below.name}'}: contacts bear "
        f"{pressure * hardness / float(np.mean(below.hardness)):.2g} times its hardness, {pressure:.0%} of the {softer}'s. "
        "mu is tau_0 over that pressure."
    )


def warnings_of(mixture: Mixture, samples: Samples, at: int, shares: Mapping[str, float]) -> list[str]:
    """Return what limits the prediction, the most serious first; shares: of the variance, by part, empty if unknown."""
    impossible = float(np.mean(~np.isfinite(samples.force[:, at])))
    found = []
    if impossible > _MANY:
        found.append(f"{impossible:.0%} of the draws are physically impossible and are left out.")
    if len(mixture.strength.states) > 1:
        names = ", ".join(one.name for one, _ in mixture.strength.states)
        found.append(f"The interface is not stated: mu is a mixture over {names}.")
    if (times := mixture.strength.over_body) > 1.0:
        found.append(f"The stated interface is {times:.3g} times as strong as the weaker body: mu is that of the body.")
    elif times > _STEEP and mixture.asked.metallic:
        found.append(
            f"The stated interface is {times:.3g} times as strong as the weaker body, and junctions grow: 2 % of its strength "
            "change mu by 15 % and more."
        )
    found += _of_few_waves(mixture)
    found += [] if mixture.asked.contact.measured is None else list(mixture.asked.contact.measured.validity_warnings)
    area, pressure = (float(np.nanmedian(one[:, at])) for one in (samples.area, samples.pressure))
    is_open = area < _FLAT * float(np.median(mixture.asked.drawn.nominal_area)) and pressure < _PLASTIC
    decides = not shares or shares.get("area model", 0.0) > _DECIDES  # parts that hardly count are left out
    if decides and (is_open or mixture.asked.contact.has_film) and _kind_is_missing(mixture):
        found.append("The kind of surface is not stated: surfaces of these numbers differ in area by factors.")
    if decides and is_open and max(float(law.far[at] * law.weight[at]) * law.far_error for law in mixture.laws) > 0.2:
        found.append("No solved surface is near this contact: its area is known within a factor of 2.")
    return found


def _kind_is_missing(mixture: Mixture) -> bool:
    """Return whether the surface is known by numbers that do not tell its kind."""
    asked = mixture.asked
    return not asked.on_map and asked.contact.surface_kind is None and asked.contact.heights[0] == "gaussian"


def _of_few_waves(mixture: Mixture) -> list[str]:
    """Return a warning where the map has few of its longest waves."""
    waves = of_the_map(mixture.asked.contact).get("longest_waves_on_a_side", math.inf)
    few = f"The map holds {waves:.2g} of its longest waves on a side, fewer than {LEAST_WAVES:g}:"
    return [f"{few} it may not stand for the surface."] if waves < LEAST_WAVES else []


_MUCH = 0.2  # share of the variance that is worth a word in the case
_STEPS = {
    "interface": "measure mu once: stiction fit CASE.toml --data FILE",
    "area model": "measure the surface: give a scan in place of numbers",
    "adhesion": "measure the pull-off force, which tells the work of adhesion",
    "junctions": "measure mu once at this load: stiction fit CASE.toml --data FILE",
    "chance": "measure at several places, or press with more load",
}


def next_step(shares: Mapping[str, float], mixture: Mixture) -> str:
    """Return what to measure or state next: what the width comes from most."""
    if len(mixture.strength.states) > 1:
        return "state the interface (stiction interfaces), or measure mu once: stiction fit CASE.toml --data FILE"
    if not shares:
        return ""
    largest = max(shares, key=lambda name: shares[name])
    if _kind_is_missing(mixture) and shares.get("area model", 0.0) > _MUCH:
        kind = 'state the kind of surface, e.g. kind = "ground"'
        return f"{kind}, or give a scan" if largest == "area model" else f"{kind}; then {_step(largest)}"
    return _step(largest)


def _step(part: str) -> str:
    return _STEPS.get(part, f"measure {part.replace('_', ' ')}")
