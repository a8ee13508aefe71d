"""Write the texts of an answer: the contact regime, warnings, and the input to measure next."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.interfaces import interface
from stiction.contact.materials import class_of
from stiction.quantities.errors import InputError
from stiction.quantities.shown import show
from stiction.solvers.boundary_elements.limits import LEAST_WAVES
from stiction.solving.choice import Choice
from stiction.solving.state import of_the_map
from stiction.studies.prediction.beside import unlike_handbooks
from stiction.studies.prediction.levels import Levels
from stiction.studies.prediction.mixture import Mixture, Samples
from stiction.studies.prediction.sampled_case import SampledCase
from stiction.studies.prediction.uncertainty_sources import part_name
from stiction.studies.uncertainty.drawing import Variant, draw

_STICKS = 2.0  # factor of the area by adhesion or menisci above which they, and not the load, determine the area
_FLAT = 0.95  # real over nominal area from which a contact counts as pressed flat
_PLASTIC = 0.9  # mean pressure over hardness from which spots count as plastic
_AT_HARDNESS = 0.05  # largest relative difference of pressure and hardness for which they count as equal
_SOME = 0.1  # fraction of elastic samples above which the text mentions them
_GROWN = 1.1  # factor of junction growth, and of the area by adhesion, from which it is mentioned
_BY_STRENGTH = 0.2  # fraction of friction that tau_0 causes, below which another area hardly changes mu
_FEW = 10.0  # number of touching asperities below which mu varies from place to place
# State that can weaken an interface, the easiest to make first -> an example that follows its name.
_WEAK = {"boundary lubricant": "", "monolayer": "", "layered solid": " such as MoS2", "DLC dry": ""}
_MUCH_WEAKER = 0.8  # ratio of shear strengths below which a state is named as weaker
_STEEP = 0.93  # ratio c of interface to body strength above which mu is steep: d ln mu/d ln c = 1/(1 - c^2), 15 % for 2 %
_SAME = 0.015  # relative difference of two strengths that counts as none
_DECIDES = 0.05  # fraction of the variance above which a part is worth a warning
_ATOM = 1e-19  # m^2, some 0.3 nm squared
_MANY = 0.05  # fraction of impossible samples above which a warning is issued


def regime_of(mixture: Mixture, samples: Samples, index: int) -> tuple[str, str]:
    """Return one to three sentences on the contact regime, and a phrase on what would lower mu.

    The sentences state, for example, that all contact spots are plastic. samples: results of the prediction. index: position of
    the load among the loads of the prediction.
    """
    area, pull, pressure = (_median(table, samples, index) for table in (samples.area, samples.pull, samples.pressure))
    sentences, added = [], " plus the pressure coefficient" if mixture.strength.has_coefficient else ""
    times = _times(mixture, samples, index)
    by_area = _by_strength(samples, index) > _BY_STRENGTH  # otherwise friction is nearly alpha W, for any area
    weaker = _weaker(mixture, samples, index, by_area)
    if area > _FLAT * float(np.median(mixture.sampled.drawn.nominal_area)):
        levers = ["more load", "a smaller nominal area", weaker] if by_area else [weaker]
        flat = "pulled" if pull > _STICKS else "pressed"
        sentences.append(f"The surfaces are {flat} flat: the real area is the nominal area, and mu = tau_0·A_n/P{added}.")
    elif pressure > _PLASTIC:
        levers = [weaker]
        if by_area and not mixture.strength.is_relative_to("shear_strength"):
            levers.append(f"a higher hardness of the {_softer(mixture)}")
        elastic = np.nanmean(samples.pressure[:, index] < _PLASTIC) if samples.pressure.ndim == 2 else 0.0
        at_hardness = abs(pressure - 1.0) < _AT_HARDNESS
        formula = f"mu = tau_0/{'H' if at_hardness else f'({pressure:.2g} H)'}{times}{added}"
        if elastic > _SOME:
            sentences.append(f"The contacts are probably plastic: then {formula}. If they are elastic, mu is larger.")
        else:
            sentences.append(f"All contacts are plastic: {formula}{', for any roughness' if at_hardness else ''}.")
    else:
        sentence, other = _of_pressure(mixture, pressure, index, times, added)
        sentences.append(sentence)
        levers = [weaker, other] if by_area else [weaker]
    if pull > _STICKS:
        contact, load = mixture.sampled.contact, float(mixture.loads[index])
        levers = [f"less {'adhesion' if contact.adheres else 'liquid'}", weaker]
        if contact.adheres and (force := _pull_off_force(mixture.sampled)) > load:
            shown = show(force, "pull_off_force", 2)
            sentences.insert(0, f"The pull-off force, {shown}, exceeds the load: use the friction force, not mu.")
    return " ".join(sentences), _alternatives(levers)


def _alternatives(levers: Sequence[str]) -> str:
    """Return the changes that would lower mu as one text; "" among them stands for a weaker interface, if none is known.

    >>> _alternatives(["more load", "a smaller nominal area", "a lower strength tau_0"])
    'more load, a smaller nominal area or a lower strength tau_0'
    >>> _alternatives(["", "rougher surfaces"])
    'rougher surfaces; no weaker interface is known'
    """
    *before, last = [*filter(None, levers)] or [""]
    text = f"{', '.join(before)} or {last}" if before else last
    return text if all(levers) else f"{text}; no weaker interface is known".removeprefix("; ")


def _weaker(mixture: Mixture, samples: Samples, index: int, by_area: bool) -> str:
    """Return what would weaken the interface, with the name of a weaker state; "" if there is none for these bodies.

    index: position of the load among the loads of the prediction. by_area: whether the shear strength causes a notable part of
    friction; otherwise the pressure coefficient does.
    """
    contact = mixture.sampled.contact
    if contact.interfacial_shear_strength is not None:
        return "a lower strength tau_0" if by_area else "a lower pressure coefficient alpha"
    pressure = _median(samples.pressure, samples, index) * float(np.median(mixture.sampled.bodies.hardness))
    present = _median(samples.strength + samples.coefficient * pressure, samples, index)
    for name, example in _WEAK.items():
        state = interface(name)
        tau, alpha = state.at(0.5, *contact.touching)
        holds = state.pressure_limit is None or pressure < state.pressure_limit
        suits = holds and state.allows(*contact.touching, coated=contact.has_film)
        if suits and tau + alpha * pressure < _MUCH_WEAKER * present:
            return f"a weaker interface ({name}{example})"
    return ""


def _median(table: np.ndarray, samples: Samples, index: int) -> float:
    """Return the median of a result over the samples, at the load with this index. table: one of the arrays of `samples`."""
    return float(np.nanmedian(np.broadcast_to(table, samples.area.shape)[:, index]))


_JUNCTIONS = "the growth of junctions under shear"


def enlarged_by(mixture: Mixture, samples: Samples, index: int) -> dict[str, float]:
    """Return the median factors, by cause, with which junction growth, and adhesion and menisci, enlarge the contact area.

    A factor of at most 1.1 is left out, except that of menisci, with or without adhesion. index: position of the load among the
    loads of the prediction.
    """
    contact = mixture.sampled.contact
    growth, pull = (_median(table, samples, index) for table in (samples.growth, samples.pull))
    pulls = [name for name, value in (("adhesion", contact.adheres), ("menisci", contact.liquid is not None)) if value]
    factors = {_JUNCTIONS: growth} if growth > _GROWN else {}
    return factors | ({" and ".join(pulls): pull} if pulls and (pull > _GROWN or contact.liquid is not None) else {})


def _times(mixture: Mixture, samples: Samples, index: int) -> str:
    """Return a text on the factors of `enlarged_by` that continues the formula mu = tau_0/pressure; "" without any factor."""
    factors = enlarged_by(mixture, samples, index).items()
    texts = [cause if cause == _JUNCTIONS else f"{factor:.3g} for {cause}" for cause, factor in factors]
    return f", times {' and '.join(texts)}" if texts else ""


def _pull_off_force(sampled: SampledCase) -> float:
    """Return the pull-off force [N] of the nominal contact by the model soft_coating_2015, or 0 if the model refuses it.

    Asperities of that model do not interact, so that the force is a lower bound where adhesion makes contact spots merge.
    """
    nominal = replace(sampled.case, uncertain=(), load=sampled.loads[:1], separation=None)
    variant = Variant(Choice("soft_coating_2015", tangential="none"))
    try:
        drawn = draw(nominal, np.zeros((1, 0)), [variant], names=("pull_off_force",))
    except (InputError, ArithmeticError):
        return 0.0
    return float(np.nan_to_num(drawn.tables["pull_off_force"]).max())


def _by_strength(samples: Samples, index: int) -> float:
    """Return the median fraction of friction that tau_0 causes; the pressure coefficient causes the remaining friction.

    index: position of the load among the loads of the prediction.
    """
    strength = np.broadcast_to(samples.strength, samples.area.shape)[:, index]
    force = samples.force[:, index] / samples.efficiency[:, index]
    return float(np.nanmedian(strength * samples.area[:, index] / force))


def _of_pressure(mixture: Mixture, pressure: float, index: int, times: str, added: str) -> tuple[str, str]:
    """Return two texts: a sentence on the pressure of contact spots that are not plastic, and a change that lowers mu.

    The second text is e.g. "rougher surfaces"; the caller adds a weaker interface. On a film, the sentence may say that the
    body below yields. pressure: mean pressure over the hardness of the softer surface. index: position of the load among the
    loads of the prediction. times, added: factors and added term with which the formula "mu = tau_0/p" continues, or "".
    """
    contact, hardness = mixture.sampled.contact, float(np.median(mixture.sampled.bodies.hardness))
    carried = min(float(np.median(law.yields_at[:, index])) for law in mixture.laws)
    if contact.coating is None or not carried < hardness or pressure * hardness < _PLASTIC * carried:
        softer = _softer(mixture)
        before = " before shear" if "shear" in times else ""
        sentence = (
            f"mu = tau_0/p{times}{added}: p, the pressure in contact spots{before}, is {100.0 * pressure:.2g}% of the "
            f"hardness of the {softer}."
        )
        stiffer = "" if mixture.strength.is_relative_to("strength_over_shear_modulus") else "stiffer or "
        return sentence, f"{stiffer}rougher surfaces"
    coated = [getattr(contact, name) for name in ("first", "second") if contact.coating.bodies in (name, "both")]
    below = min(coated, key=lambda body: float(np.mean(body.hardness)))
    sentence = (
        f"The body below the film yields{'' if below.name == 'unnamed' else f', {below.name}'}: the pressure "
        f"in contact spots is {pressure * hardness / float(np.mean(below.hardness)):.2g} times its hardness, {pressure:.0%} of "
        f"the hardness of the {_softer(mixture)}. mu is tau_0 over this pressure{times}{added}."
    )
    return sentence, "a harder body below the film"


def _softer(mixture: Mixture) -> str:
    """Return a name for the surface that determines the hardness of the contact: "softer body", "film" or "counterbody"."""
    contact = mixture.sampled.contact
    if contact.coating is None:
        return "softer body"
    return "film" if contact.softer_counterbody is None else "counterbody"


def warnings_of(
    mixture: Mixture, samples: Samples, index: int, shares: Mapping[str, float], by_state: Sequence[str] = ()
) -> list[str]:
    """Return the warnings about a prediction as sentences, the most serious first.

    index: position of the load among the loads of the prediction. shares: fraction of the variance of ln mu by part, empty if
    unknown. by_state: texts on mu for each possible state of the interface, from `mu_by_state`.
    """
    impossible = float(np.mean(~np.isfinite(samples.force[:, index])))
    contact = mixture.sampled.contact
    warnings = contact.roughness.unusual_heights()
    if impossible > _MANY:
        warnings.append(f"{impossible:.0%} of the samples are physically impossible and are excluded.")
    if len(mixture.strength.states) > 1:
        warnings.append(
            f"The interface is not stated: mu is {', '.join(by_state)}." if by_state else "The interface is not stated."
        )
    if (times := mixture.strength.over_body) > 1.0:
        warnings.append(f"The stated interface is {_as_strong(times)} the weaker body, which limits mu.")
    elif times > _STEEP and mixture.sampled.metallic:
        warnings.append(
            f"The stated interface is {_as_strong(times)} the weaker body, and junctions grow: if its "
            "strength changes by 2 %, mu changes by 15 % or more."
        )
    area, pressure = (_median(table, samples, index) for table in (samples.area, samples.pressure))
    warnings += _beyond_limit(contact, pressure * float(np.median(mixture.sampled.bodies.hardness)))
    is_flat = area >= _FLAT * float(np.median(mixture.sampled.drawn.nominal_area))
    soft = any(class_of(body) == "elastomer" for body in contact.touching)
    if contact.work_of_adhesion is None and soft and not is_flat:  # adhesion cannot enlarge a full contact
        warnings.append("work_of_adhesion is not stated: if the bodies stick after unloading, mu is several times higher.")
    warnings += [*_of_few_asperities(float(mixture.touching[index])), *_of_small_menisci(contact), *_of_few_waves(mixture)]
    warnings += [] if contact.measured is None else list(contact.measured.validity_warnings)
    is_open = not is_flat and pressure < _PLASTIC
    decides = not shares or shares.get("area model", 0.0) > _DECIDES
    if decides and (is_open or contact.has_film) and _kind_is_missing(mixture):
        text = "The kind of surface is not stated: with the same numbers, the contact area can differ severalfold."
        first = shares.get("area model", 0.0) > shares.get("interface", 0.0)
        warnings.insert(0 if first else len(warnings), text)
    if decides and is_open and max(float(law.far[index] * law.weight[index]) * law.far_error for law in mixture.laws) > 0.2:
        warnings.append("No benchmark surface is similar to this contact: its real area is uncertain by a factor of 2.")
    if not is_flat and _median(samples.pull, samples, index) < _STICKS:
        warnings[:0] = unlike_handbooks(mixture, _median(samples.force, samples, index) / float(mixture.loads[index]))
    if area < _ATOM:
        warnings.insert(0, "The contact area is smaller than an atom: models of solids do not hold at this load.")
    return warnings


def _as_strong(times: float) -> str:
    """Return a phrase such as "1.03 times as strong as", or "as strong as" if the ratio is 1 within 1.5 %."""
    return "as strong as" if abs(times - 1.0) < _SAME else f"{times:.3g} times as strong as"


def mu_by_state(mixture: Mixture, levels: Levels, index: int, level: float) -> list[str]:
    """Return one text for each possible state of an interface that is not stated, with the interval of mu, lowest first.

    An example is "0.1 to 0.2 with boundary lubricant". The list is empty if the state or tau_0 is stated, or if only one state
    is possible. Each state is applied to all samples; a state without a possible sample is left out. index: position of the
    load among the loads of the prediction. level: coverage probability of the intervals.
    """
    states = mixture.strength.states
    if len(states) < 2:
        return []
    weights, rows = np.array([weight for _, weight in states]), np.tile(np.arange(len(levels)), len(states))
    places = (np.cumsum(weights) - 0.5 * weights) / weights.sum()  # the middle of each state's range of levels
    others = {name: column[rows] for name, column in levels.others.items()} | {"state": np.repeat(places, len(levels))}
    force, intervals = mixture.at_load(index).samples(Levels(levels.inputs[rows], others), rows).force, []
    for (state, _), mu in zip(states, np.split(force[:, 0] / mixture.loads[index], len(states)), strict=True):
        if np.isfinite(mu).any():
            intervals.append((*np.nanquantile(mu, [0.5 - 0.5 * level, 0.5 + 0.5 * level]), state.name))
    return [f"{low:.2g} to {high:.2g} with {name}" for low, high, name in sorted(intervals)]


def _kind_is_missing(mixture: Mixture) -> bool:
    """Return whether the kind of surface is unknown: no height map, kind, shape or non-Gaussian heights are specified."""
    contact = mixture.sampled.contact
    stated = mixture.sampled.on_map or contact.surface_kind is not None or bool(contact.surface_shape)
    return not stated and contact.heights[0] == "gaussian"


def _beyond_limit(contact: Contact, pressure: float) -> list[str]:
    """Return a list with a warning if the pressure of contact spots exceeds the limit of the stated interface; otherwise [].

    pressure: mean pressure of the contact spots [Pa].
    """
    limit = None if contact.interface is None else contact.interface.pressure_limit
    if limit is None or pressure <= float(np.min(np.asarray(limit))):
        return []
    bears, most = (show(value, "hardness", 2) for value in (pressure, float(np.min(np.asarray(limit)))))
    return [f"Contact pressure {bears} exceeds {most}: the interface fails, mu rises."]


def _of_few_asperities(touching: float) -> list[str]:
    """Return a list with a warning if fewer than ten asperities touch; otherwise []. touching: their number."""
    count = round(max(touching, 1.0))
    touch = "asperity touches" if count == 1 else "asperities touch"
    return [f"About {count} {touch}: mu varies from one place to the next."] if touching < _FEW else []


def _of_small_menisci(contact: Contact) -> list[str]:
    """Return a list with a warning if menisci are smaller than any for which Kelvin's equation was tested; otherwise []."""
    liquid = contact.liquid
    if liquid is None or float(np.min(np.asarray(liquid.kelvin_radius_over_confirmed))) >= 1.0:
        return []
    radius = 1e9 * float(np.min(np.asarray(liquid.kelvin_radius)))
    return [f"The menisci, {radius:.2g} nm, are smaller than any tested: mu is uncertain."]


def _of_few_waves(mixture: Mixture) -> list[str]:
    """Return a list with a warning if a height map contains only a few of its longest waves along a side; otherwise []."""
    waves = of_the_map(mixture.sampled.contact).get("longest_waves_on_a_side", math.inf)
    few = f"The scan has {waves:.2g} long waves, but needs {LEAST_WAVES:g}: scan more area."
    return [few] if waves < LEAST_WAVES else []


_MUCH = 0.2  # fraction of the variance above which stating the kind of surface is advised
_STEPS = {
    "interface": "measure mu once: stiction fit CASE.toml --data FILE",
    "area model": "measure the surface and give a scan (stiction surface FILE)",
    "adhesion": "measure the pull-off force, which gives the work of adhesion",
    "junctions": "measure mu once at this load: stiction fit CASE.toml --data FILE",
    "squeezed film": "measure mu once at this load: stiction fit CASE.toml --data FILE",
    "chance": "measure at several places, or use a larger load",
}


def next_step(shares: Mapping[str, float], mixture: Mixture) -> str:
    """Return a text on what to measure or state next to narrow the interval of mu.

    shares: fraction of the variance of ln mu by part. The text names an interface or a kind of surface that is not stated,
    otherwise a measurement for the part with the largest fraction. It is "" if the interface is stated and no fractions are
    known.
    """
    largest = max(shares, key=lambda name: shares[name], default="")
    if len(mixture.strength.states) > 1:
        if largest == "area model" and _kind_is_missing(mixture):
            return f"{_state_kind(mixture)}, and the interface (stiction interfaces)"
        return "state the interface (stiction interfaces), or measure mu once: stiction fit CASE.toml --data FILE"
    if not shares:
        return ""
    if _kind_is_missing(mixture) and shares.get("area model", 0.0) > _MUCH:
        kind = _state_kind(mixture)
        return f"{kind}, or give a scan" if largest == "area model" else f"{kind}; then {_step(largest)}"
    return _step(largest)


def _state_kind(mixture: Mixture) -> str:
    of_each = " of each body" if mixture.sampled.contact.roughness.part("second") is not None else ""
    return f'state the kind of surface{of_each}, e.g. kind = "ground"'


def _step(part: str) -> str:
    return _STEPS.get(part, f"measure {part_name(part)}")


def without_commands(step: str, fit: str = " and fit the case to it", scan: str = "") -> str:
    """Return the text of `next_step` reworded for readers without a terminal or a case file.

    step: the text. fit, scan: texts that replace the commands `stiction fit` and `stiction surface`.

    >>> without_commands("state the interface (stiction interfaces), or measure mu once: stiction fit CASE.toml --data FILE")
    'state the interface, or measure mu once and fit the case to it'
    """
    words = {": stiction fit CASE.toml --data FILE": fit, " (stiction surface FILE)": scan, " (stiction interfaces)": ""}
    for command, text in {**words, ', e.g. kind = "ground"': ", e.g. ground"}.items():
        step = step.replace(command, text)
    return step
