"""List the optional inputs specified for a contact, with the dimensionless group in which each is used."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from stiction.contact.contact import Contact

_OF_CONTACT = {
    "work_of_adhesion": "adhesion",
    "interfacial_shear_strength": "shear_strength",
    "pressure_coefficient": "pressure_coefficient",
    "peeling": "peeling",
    "hardness_to_yield": "hardness_to_yield",
    "ageing_rate": "ageing_rate",
    "strength_variation": "strength_variation",
    "weakening_slip": "weakening_slip",
    "residual_strength": "residual_strength",
    "burgers_vector": "size_over_burgers",
    "hold_time": "waiting",
    "reference_time": "waiting",
    "liquid": "meniscus_index",
}
_OF_BODY = {"yield_stress": "hardness_to_yield", "tangent_modulus": "hardening", "characteristic_depth": "hardness"}


def optional_inputs(contact: "Contact") -> dict[str, str]:
    """Return the dimensionless group in which each optional input of a contact is used, by name of the input.

    Only inputs specified for the contact are included. The group is "" for an input of the film that no group contains.
    """
    inputs = {name: group for name, group in _OF_CONTACT.items() if getattr(contact, name) is not None}
    for body in ("first", "second"):
        inputs |= {f"{body}.{name}": group for name, group in _OF_BODY.items() if getattr(contact, body).is_own(name)}
    if contact.interface is not None:
        inputs["interface"] = "shear_strength"
        if contact.interface.pressure_coefficient is not None:
            inputs["interface.pressure_coefficient"] = "pressure_coefficient"
    return inputs | _of_film(contact)


def _of_film(contact: "Contact") -> dict[str, str]:
    if contact.coating is None:
        return {}
    film = contact.coating.material
    inputs = {f"coating.material.{name}": "" for name in ("yield_stress", "tangent_modulus") if film.is_own(name)}
    if film.characteristic_depth is not None:
        inputs["coating.material.characteristic_depth"] = "hardness"
    if contact.coating.work_of_adhesion is not None:
        inputs["coating.work_of_adhesion"] = "adhesion of the film"
    return inputs
