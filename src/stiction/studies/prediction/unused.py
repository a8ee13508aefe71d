"""Stated inputs that a prediction does not use: refused where they would decide friction, else named."""

from collections.abc import Iterator

import numpy as np

from stiction.case.read import Case
from stiction.contact.contact import Contact
from stiction.quantities.errors import InputError, InWords
from stiction.studies.prediction.asked import Asked
from stiction.studies.prediction.strength import Strength

__all__ = ["not_used", "refusal_of"]

# What decides friction and is known to laws alone: dotted name -> a model that uses it, by the options of the command.
_DECIDE = {
    "coating.friction_constant": "--model greenwood_williamson_1966 --film ravindran_ramasamy_laddha_1980",
    "peeling": "--model soft_coating_2015",
}


def refusal_of(case: Case) -> InputError | None:
    """Return the error for a stated input that would decide friction and that no prediction uses; None where there is none."""
    contact = case.subject
    if not isinstance(contact, Contact):
        return None
    given = dict(contact.inputs())
    for name, model in _DECIDE.items():
        if name in given and (name != "peeling" or contact.adheres):
            return InputError(
                name, InWords(given[name]), "no value unless a model is named: predictions do not use it", f"name {model}"
            )
    return None


def not_used(asked: Asked, strength: Strength, touching: np.ndarray) -> list[str]:
    """Return the stated inputs that change nothing, each with its reason; touching: number of asperities at each load (m,)."""
    every = (*_of_bodies(asked, strength), *_of_surface(asked, touching), *_of_choice(asked.case))
    return [f"{name} ({why})" for name, why in every]


def _of_bodies(asked: Asked, strength: Strength) -> Iterator[tuple[str, str]]:
    contact = asked.contact
    bodies = {"first": contact.first, "second": contact.second}
    bodies |= {} if contact.coating is None else {"coating.material": contact.coating.material}
    softest = min(float(np.mean(one.hardness)) for one in contact.touching)
    why = _why_no_yield(asked, strength)
    for place, body in bodies.items():
        softer = any(one == body for one in contact.touching) and float(np.mean(body.hardness)) <= softest
        reasons = {
            "yield_stress": "hardness_to_yield is stated" if contact.hardness_to_yield is not None
            else why if softer else "another body yields first",
            "tangent_modulus": "no law of the area hardens",
            "surface_energy": f"the work of adhesion is {'stated' if contact.adheres else 'not stated'}",
        }  # fmt: skip
        yield from ((f"{place}.{name}", reason) for name, reason in reasons.items() if reason and body.is_own(name))
    if contact.hardness_to_yield is not None and why:
        yield "hardness_to_yield", why
    if contact.peeling is not None:  # of what adheres it is refused
        yield "peeling", "nothing adheres"


def _why_no_yield(asked: Asked, strength: Strength) -> str:
    """Return why the yield stress does not count, "" where it does: it bounds tau_0, and the growth of metal junctions."""
    stated = strength.stated
    if asked.metallic.any() or stated is None or np.any(stated * strength.aged > asked.bodies.shear_strength):
        return ""
    return "the interface is weaker than the bodies"


def _of_surface(asked: Asked, touching: np.ndarray) -> Iterator[tuple[str, str]]:
    contact = asked.contact
    if contact.measured is not None and asked.on_map:
        yield from ((f"roughness.{name}", "the map itself is used") for name in contact.measured.stated)
    if contact.strength_variation is not None and not np.isfinite(touching).all():
        yield "strength_variation", "the number of contacts is not known"
    if contact.residual_strength is not None and contact.weakening_slip is None:
        yield "residual_strength", "weakening_slip is not stated"


def _of_choice(case: Case) -> Iterator[tuple[str, str]]:
    for name, value in case.choice.arguments().items():
        if value is not None and (name, value) != ("model", "recommended"):
            yield f"solve.{name} = {value}", "the prediction draws all laws together"
