"""Texts of an answer: the contact regime, warnings, and the input to measure next."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from stiction.contact.materials import class_of
from stiction.solvers.boundary_elements.limits import LEAST_WAVES
from stiction.solving.state import of_the_map
from stiction.studies.prediction.levels import Levels
from stiction.studies.prediction.mixture import Mixture, Samples

_STICKS = 2.0  # factor of the area by adhesion above which it, and not the load, makes the contact
_FLAT = 0.95  # of the nominal area
_PLASTIC = 0.9  # mean pressure over hardness
_SOME = 0.1  # share of the draws
_GROWN = 1.5  # area after shear over that before
_FEW = 10.0
_DRY = ("clean metal", "oxidised metal", "ceramic", "dry polymer", "elastomer", "gold contact")  # a lubricant weakens these
_STEEP = 0.93  # strength of the interface over the body's, c: ln mu goes with 1/(1 - c^2) times ln c, 0.15 for 2 % here
_DECIDES = 0.05  # share of the variance from which on a part is worth a warning
_ATOM = 1e-19  # m^2, some 0.3 nm squared
_MANY = 0.05  # fraction of impossible samples above which a warning is issued


def regime_of(mixture: Mixture, samples: Samples, index: int) -> tuple[str, str]:
    """Return one or two sentences on the contact regime, e.g. how plastic the contact spots are, and what lowers mu in it.

    index: position of the load in `loads`.
    """
    area, pull, growth, pressure = (
        float(np.nanmedian(np.broadcast_to(table, samples.area.shape)[:, index]))
        for table in (samples.area, samples.pull, samples.growth, samples.pressure)
    )
    sentences, added = [], " plus the pressure coefficient" if mixture.strength.has_coefficient else ""
    stated = mixture.sampled.contact.interface
    is_dry = stated is not None and stated.name in _DRY
    weaker = "a weaker interface (e.g. lubricated)" if is_dry else "a weaker interface"
    if area > _FLAT * float(np.median(mixture.sampled.drawn.nominal_area)):
        lever = f"more load, a smaller nominal area or {weaker}"
        sentences.append(f"Pressed flat, the real area is the nominal area: mu = tau_0·A_n/P{added}.")
    elif pressure > _PLASTIC:
        lever = weaker
        if not mixture.strength.is_relative_to("shear_strength"):
            lever += f" or a higher hardness of the {_softer(mixture)}"
        grows = (", times the growth of junctions under shear" if growth > _GROWN else "") + added
        elastic = np.nanmean(samples.pressure[:, index] < _PLASTIC) if samples.pressure.ndim == 2 else 0.0
        if elastic > _SOME:
            sentences.append(f"The contacts are probably plastic: then mu = tau_0/H{grows}. If they are elastic, mu is larger.")
        else:
            sentences.append(f"All contacts are plastic: mu = tau_0/H{grows}, whatever the roughness.")
    else:
        sentence, other = _of_pressure(mixture, pressure, index, added)
        sentences.append(sentence)
        lever = f"{weaker} or {other}"
    if pull > _STICKS:
        lever = f"less adhesion or {weaker}"
        sentences.insert(
            0, "Adhesion exceeds the load: the contact sticks even without load, so use the friction force, not mu."
        )
    touching = float(mixture.touching[index])
    if touching < _FEW:
        count = round(max(touching, 1.0))
        sentences.append(
            f"About {count} {'asperity touches' if count == 1 else 'asperities touch'}: mu varies from one place to the next."
        )
    return " ".join(sentences[:2]), lever


def _of_pressure(mixture: Mixture, pressure: float, index: int, added: str) -> tuple[str, str]:
    """Return a sentence on the mean pressure of spots, or on yielding of the body below a film, and what else lowers mu.

    pressure: mean pressure over the hardness of the softer surface. index: position of the load in `loads`. added: words for
    what is added to tau_0 over the pressure.
    """
    contact, hardness = mixture.sampled.contact, float(np.median(mixture.sampled.bodies.hardness))
    carried = min(float(np.median(law.yields_at[:, index])) for law in mixture.laws)
    if contact.coating is None or not carried < hardness or pressure * hardness < _PLASTIC * carried:
        softer = _softer(mixture)
        sentence = f"mu = tau_0/p{added}: the spots bear p, {100.0 * pressure:.2g}% of the {softer}'s hardness."
        stiffer = "" if mixture.strength.is_relative_to("strength_over_shear_modulus") else "stiffer or "
        return sentence, f"{stiffer}rougher surfaces"
    coated = [getattr(contact, name) for name in ("first", "second") if contact.coating.bodies in (name, "both")]
    below = min(coated, key=lambda body: float(np.mean(body.hardness)))
    sentence = (
        f"The body below the film yields{'' if below.name == 'unnamed' else f', {below.name}'}: contacts bear "
        f"{pressure * hardness / float(np.mean(below.hardness)):.2g} times its hardness, {pressure:.0%} of the "
        f"{_softer(mixture)}'s. mu is tau_0 over that pressure{added}."
    )
    return sentence, "a harder body below the film"


def _softer(mixture: Mixture) -> str:
    """Return what the hardness of the contact is that of, in one or two words."""
    contact = mixture.sampled.contact
    if contact.coating is None:
        return "softer body"
    return "film" if contact.softer_counterbody is None else "counterbody"


def warnings_of(
    mixture: Mixture, samples: Samples, index: int, shares: Mapping[str, float], by_state: Sequence[str] = ()
) -> list[str]:
    """Return the warnings about a prediction, the most serious first.

    index: position of the load in `loads`. shares: fraction of the variance by part, empty if unknown. by_state:
    texts of `mu_by_state`.
    """
    impossible = float(np.mean(~np.isfinite(samples.force[:, index])))
    warnings = []
    if impossible > _MANY:
        warnings.append(f"{impossible:.0%} of the draws are physically impossible and are excluded.")
    if len(mixture.strength.states) > 1:
        warnings.append(
            f"The interface is not stated: mu is {', '.join(by_state)}." if by_state else "The interface is not stated."
        )
    if (times := mixture.strength.over_body) > 1.0:
        warnings.append(f"The stated interface is {times:.3g} times as strong as the weaker body, which limits mu.")
    elif times > _STEEP and mixture.sampled.metallic:
        warnings.append(
            f"The stated interface is {times:.3g} times as strong as the weaker body, and junctions grow: if its "
            "strength changes by 2 %, mu changes by 15 % or more."
        )
    contact = mixture.sampled.contact
    area, pressure = (float(np.nanmedian(table[:, index])) for table in (samples.area, samples.pressure))
    is_flat = area >= _FLAT * float(np.median(mixture.sampled.drawn.nominal_area))
    soft = any(class_of(body) == "elastomer" for body in contact.touching)
    if contact.work_of_adhesion is None and soft and not is_flat:  # adhesion cannot enlarge what touches everywhere
        warnings.append("work_of_adhesion is not stated: adhesion of an elastomer can raise mu several times at light loads.")
    warnings += _of_few_waves(mixture)
    warnings += [] if contact.measured is None else list(contact.measured.validity_warnings)
    is_open = not is_flat and pressure < _PLASTIC
    decides = not shares or shares.get("area model", 0.0) > _DECIDES  # parts that hardly count are left out
    if decides and (is_open or contact.has_film) and _kind_is_missing(mixture):
        text = "The kind of surface is not stated: with the same numbers, the contact area can differ several times."
        first = shares.get("area model", 0.0) > shares.get("interface", 0.0)
        warnings.insert(0 if first else len(warnings), text)
    if decides and is_open and max(float(law.far[index] * law.weight[index]) * law.far_error for law in mixture.laws) > 0.2:
        warnings.append("No benchmark surface is near this contact: its real area is uncertain by a factor of 2.")
    if area < _ATOM:
        warnings.insert(0, "The contact area is smaller than an atom: models of solids do not hold at this load.")
    return warnings


def mu_by_state(mixture: Mixture, levels: Levels, index: int, level: float) -> list[str]:
    """Return the interval of mu for each possible state of an interface that is not stated, as texts, the weakest first.

    The list is empty if the state is known. Each state is applied to all samples. index: position of the load in `loads`.
    level: coverage probability of the intervals.
    """
    states = mixture.strength.states
    if len(states) < 2:
        return []
    single, intervals = mixture.at_load(index), []
    weights = np.array([weight for _, weight in states])
    for (state, _), place in zip(states, (np.cumsum(weights) - 0.5 * weights) / weights.sum(), strict=True):
        fixed = Levels(levels.inputs, {**levels.others, "state": np.full(len(levels), place)})
        mu = single.samples(fixed, np.arange(len(levels))).force[:, 0] / single.loads[0]
        if np.isfinite(mu).any():
            intervals.append((*np.nanquantile(mu, [0.5 - 0.5 * level, 0.5 + 0.5 * level]), state.name))
    return [f"{low:.2g} to {high:.2g} with {name}" for low, high, name in sorted(intervals)]


def _kind_is_missing(mixture: Mixture) -> bool:
    """Return whether the kind of surface is unknown: no scan, kind, shape or non-Gaussian heights are stated."""
    contact = mixture.sampled.contact
    stated = mixture.sampled.on_map or contact.surface_kind is not None or bool(contact.surface_shape)
    return not stated and contact.heights[0] == "gaussian"


def _of_few_waves(mixture: Mixture) -> list[str]:
    """Return a list with a warning if a height map contains only a few of its longest wavelengths; otherwise []."""
    waves = of_the_map(mixture.sampled.contact).get("longest_waves_on_a_side", math.inf)
    few = f"The scan holds {waves:.2g} long waves, {LEAST_WAVES:g} wanted: measure a larger area."
    return [few] if waves < LEAST_WAVES else []


_MUCH = 0.2  # share of the variance that is worth a word in the case
_STEPS = {
    "interface": "measure mu once: stiction fit CASE.toml --data FILE",
    "area model": "measure the surface and give a scan (stiction surface FILE)",
    "adhesion": "measure the pull-off force, which gives the work of adhesion",
    "junctions": "measure mu once at this load: stiction fit CASE.toml --data FILE",
    "chance": "measure at several places, or use a larger load",
}


def next_step(shares: Mapping[str, float], mixture: Mixture) -> str:
    """Return what to measure or state next, which follows from the part with the largest share of the variance."""
    largest = max(shares, key=lambda name: shares[name], default="")
    if len(mixture.strength.states) > 1:
        if largest == "area model" and _kind_is_missing(mixture):
            return 'state the kind of surface, e.g. kind = "ground", and the interface (stiction interfaces)'
        return "state the interface (stiction interfaces), or measure mu once: stiction fit CASE.toml --data FILE"
    if not shares:
        return ""
    if _kind_is_missing(mixture) and shares.get("area model", 0.0) > _MUCH:
        kind = 'state the kind of surface, e.g. kind = "ground"'
        return f"{kind}, or give a scan" if largest == "area model" else f"{kind}; then {_step(largest)}"
    return _step(largest)


def _step(part: str) -> str:
    return _STEPS.get(part, f"measure {part.replace('_', ' ')}")
