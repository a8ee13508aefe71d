"""Find stated inputs that predictions cannot use: inputs that would decide friction are refused, others are listed."""

from collections.abc import Iterator

import numpy as np

from stiction.case.read import Case
from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError, InWords
from stiction.studies.prediction.sampled_case import SampledCase
from stiction.studies.prediction.strength import Strength

# Inputs that decide friction but that only single models use: dotted name -> options of the command that select such a model.
_DECIDE = {
    "coating.friction_constant": "--model greenwood_williamson_1966 --film ravindran_ramasamy_laddha_1980",
    "burgers_vector": "--model greenwood_williamson_1966 --tangential hurtado_kim_1999",
    "peeling": "--model soft_coating_2015",
}


def refusal_of(case: Case) -> InputError | None:
    """Return the error for a stated input that would decide friction but that predictions cannot use; None if there is none."""
    contact = case.subject
    if not isinstance(contact, Contact):
        return None
    stated = dict(contact.inputs())
    for name, model in _DECIDE.items():
        if name in stated and (name != "peeling" or contact.adheres):
            return InputError(name, InWords(stated[name]), "no value in a prediction, which cannot use it", f"use {model}")
    return None


def not_used(sampled: SampledCase, strength: Strength, touching: np.ndarray) -> list[str]:
    """Return the stated inputs that have no effect on a prediction, each with the reason in brackets.

    touching: number of asperities in contact at each load (m,), infinite if unknown, which leaves `strength_variation` unused.
    """
    every = (*_of_bodies(sampled, strength), *_of_surface(sampled, touching), *_of_choice(sampled.case))
    return [f"{name} ({why})" for name, why in every]


def _of_bodies(sampled: SampledCase, strength: Strength) -> Iterator[tuple[str, str]]:
    contact = sampled.contact
    bodies = {"first": contact.first, "second": contact.second}
    bodies |= {} if contact.coating is None else {"coating.material": contact.coating.material}
    softest = min(float(np.mean(touching.hardness)) for touching in contact.touching)
    why = _why_no_yield(sampled, strength)
    for place, body in bodies.items():
        softer = any(touching == body for touching in contact.touching) and float(np.mean(body.hardness)) <= softest
        reasons = {
            "yield_stress": "hardness_to_yield is stated" if contact.hardness_to_yield is not None
            else why if softer else "another body yields first",
            "tangent_modulus": "no area model includes hardening",
            "surface_energy": f"the work of adhesion is {'stated' if contact.adheres else 'not stated'}",
        }  # fmt: skip
        yield from ((f"{place}.{name}", reason) for name, reason in reasons.items() if reason and body.is_own(name))
    if contact.hardness_to_yield is not None and why:
        yield "hardness_to_yield", why
    if contact.peeling is not None:  # a contact with adhesion and this input was refused before
        yield "peeling", "the contact has no adhesion"


def _why_no_yield(sampled: SampledCase, strength: Strength) -> str:
    """Return the reason why the yield stress has no effect; "" if it has an effect.

    The yield stress limits tau_0, and it controls the growth of metal junctions.
    """
    stated = strength.stated
    if sampled.metallic.any() or stated is None or np.any(stated * strength.aged > sampled.bodies.shear_strength):
        return ""
    return "the interface is weaker than the bodies"


def _of_surface(sampled: SampledCase, touching: np.ndarray) -> Iterator[tuple[str, str]]:
    contact = sampled.contact
    if contact.measured is not None and sampled.on_map:
        yield from ((f"roughness.{name}", "the prediction uses the map itself") for name in contact.measured.stated)
    elif (found := contact.measured) is not None and "heights" in found.stated and not found.counts[found.method]:
        yield "roughness.heights", f"the asperity method {found.method} assumes Gaussian heights"
    if contact.strength_variation is not None and not np.isfinite(touching).all():
        yield "strength_variation", "the number of contact spots is unknown"
    if contact.residual_strength is not None and contact.weakening_slip is None:
        yield "residual_strength", "weakening_slip is not stated"


def _of_choice(case: Case) -> Iterator[tuple[str, str]]:
    for name, value in case.choice.arguments().items():
        if value is not None and (name, value) != ("model", "recommended"):
            yield f"solve.{name} = {value}", "the prediction combines all models"
