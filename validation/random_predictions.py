"""Predict random contacts over the ranges of all inputs, and count what cannot be.

python validation/random_predictions.py [COUNT]     # 10000 contacts; a line for each fault, the reasons of refusals by number

A contact is refused with an InputError of one line, or its prediction has no fault: see `faults`.
"""

import sys
import warnings
from collections import Counter

import numpy as np

import stiction as st
from stiction.contact.interfaces import allowed_interfaces, interface
from stiction.contact.materials import material_names
from stiction.quantities.errors import InputError
from stiction.surfaces.finishes import finish_names

COUNT, SEED = 10_000, 1
KINDS = (None, "gaussian", "worn", "skewed", "lay")


def contact_of(rng: np.random.Generator) -> tuple[dict, float]:
    """Return the fields of a random contact, and a load [N]."""

    def between(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    def body():
        if rng.random() < 0.5:
            return str(rng.choice(material_names()))
        modulus = between(1e5, 1e12)
        hardness = min(between(1e-3, 1.0), 0.3) * modulus
        return {"youngs_modulus": modulus, "poissons_ratio": rng.uniform(0.0, 0.499), "hardness": hardness}

    fields = {"first": body(), "second": body(), "nominal_area": between(1e-14, 1e-1)}
    if rng.random() < 0.4:
        fields["roughness"] = {name: {"finish": str(rng.choice(finish_names()))} for name in ("first", "second")}
    else:
        radius = between(1e-8, 1e-2)
        sigma = between(1e-5, 1.0) * radius
        rough = {"asperity_radius": radius, "asperity_height_deviation": sigma}
        fields["roughness"] = rough | {"asperity_density": between(0.01, 0.2) / (radius * sigma)}
        kind = KINDS[rng.integers(len(KINDS))]
        fields["roughness"] |= {"kind": kind} if kind else {}
    if rng.random() < 0.25:
        thickness = between(1e-9, 1e-4)
        fields["coating"] = {"material": body(), "bodies": "first", "thickness": thickness}
    if rng.random() < 0.3:
        fields["work_of_adhesion"] = between(1e-6, 3.0)
    if (chosen := rng.random()) < 0.4:
        fields["interfacial_shear_strength"] = between(1e3, 1e10)
        if rng.random() < 0.5:
            fields["pressure_coefficient"] = rng.uniform(0.0, 0.9)
    elif chosen < 0.8:
        fields["interface"] = rng.random()
    return fields, between(1e-9, 1e5)


def predicted(rng: np.random.Generator):
    """Return the contact and its prediction. Raises InputError where the contact is refused."""
    fields, load = contact_of(rng)
    if isinstance(fields.get("interface"), float):
        share = fields.pop("interface")
        bare = st.Contact(**fields)
        names = allowed_interfaces(*bare.touching, coated=bare.has_film)
        fields["interface"] = names[int(share * len(names))] if names else None
    contact = st.Contact(**fields)
    return contact, st.predict(contact, load=load)


def faults(contact: st.Contact, found) -> list[str]:
    """Return what cannot be: medians within intervals above 0, area and strength within what the bodies allow."""
    said = []
    for name in ("friction_coefficient", "friction_force", "contact_area"):
        low, middle, high = (found[name + end].item() for end in ("_low", "", "_high"))
        if not (0.0 < low <= middle <= high < np.inf):
            said.append(f"{name}: {low:.3g}, {middle:.3g}, {high:.3g}")
        elif low == high and name == "friction_coefficient" and _is_uncertain(contact):
            said.append(f"{name}: no width")
    said = said or _beyond_the_bodies(contact, found)
    shares = found.attrs["shares"]
    if shares and not 0.9 < sum(shares.values()) < 1.0 + 1e-9:
        said.append(f"shares add up to {sum(shares.values()):.3g}")
    if any("\n" in text or "nan" in text for text in (found.attrs["regime"], *found.attrs["warnings"])):
        said.append("a text with nan or a line break")
    return said


def _beyond_the_bodies(contact: st.Contact, found) -> list[str]:
    """Return which bounds of the bodies the upper ends of the intervals pass."""
    said = []
    area, mu, load = (found[name].item() for name in ("contact_area_high", "friction_coefficient_high", "load"))
    if area > contact.nominal_area * (1.0 + 1e-9):
        said.append("area above the nominal one")
    hardest = 1.5 * max(
        float(body.hardness) for body in (*contact.touching, contact.first, contact.second)
    )  # presets have ranges
    if load > hardest * area:
        said.append("pressure above the hardness")
    coefficient = contact.pressure_coefficient or 0.0
    if contact.interface is not None and contact.interface.pressure_coefficient is not None:
        coefficient = 2.0 * contact.interface.range["pressure_coefficient"][1]
    if not contact.adheres and mu * load > hardest * area + coefficient * load:
        said.append("friction above what the bodies bear")
    return said


def _is_uncertain(contact: st.Contact) -> bool:
    """Return whether anything of a contact is drawn that mu depends on: a state, or none."""
    return contact.interfacial_shear_strength is None and (
        contact.interface is None or bool(interface(contact.interface.name).range)
    )


def run(count: int, seed: int = SEED) -> tuple[list[str], Counter]:
    """Return a line for each fault, and how many contacts were refused for which input; "" of those that were predicted."""
    found, refused = [], Counter()
    for at in range(count):
        rng = np.random.default_rng([seed, at])
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                contact, answer = predicted(rng)
        except InputError as error:
            refused[error.field] += 1
            found += [f"{at}: an error of several lines: {error}"] if "\n" in str(error) else []
            continue
        except Exception as error:  # a traceback for users
            found.append(f"{at}: {type(error).__name__}: {error}")
            continue
        refused[""] += 1
        found += [f"{at}: {text}" for text in faults(contact, answer)]
    return found, refused


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    found, refused = run(count)
    print("\n".join(found))
    print(
        f"{len(found)} faults in {count} contacts; {refused.pop('', 0)} predicted, refused for: {dict(refused.most_common())}"
    )


if __name__ == "__main__":
    main()
