"""A film on one body or on both."""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from stiction.contact.materials import Material, as_material
from stiction.quantities.inputs import Input, Number, OptionalNumber

Body = Annotated[Material, BeforeValidator(as_material, json_schema_input_type=str | Material)]


class Coating(Input):
    """A film on one body or on both.

    material: Material, name of a preset, or dict of its numbers. bodies: which body carries it; with
    "both", the default and the paper's case, film meets film and `thickness` is the sum of the two.
    work_of_adhesion: of the surfaces that meet when there is a film; left out, it is that of the contact. friction_constant: C
    of mu = (C t/W)^(1/3), which one film law takes (Ravindran et al. 1980); left out, it follows from strength and hardness.

    The film models take one H/Y for film and substrate (theory 2), and one E_t/E, that of the bodies: a
    yield_stress or tangent_modulus of the film is not used, but to say whether it or a body as hard yields first. Raises
    InputError.
    """

    material: Body = Field(description="a material: the name of a preset, or its numbers")
    thickness: Number
    bodies: Literal["both", "first", "second"] = "both"
    work_of_adhesion: OptionalNumber = None
    friction_constant: OptionalNumber = None


def softer_in_words(film: Material, counterbody: Material, bare: Any) -> str:
    """Say that the counterbody yields before the film; bare: the hardness of the bodies without their film [Pa]."""
    ratio = counterbody.hardness / bare
    n_H = f"n_H = {float(ratio):.4g}" if np.ndim(ratio) == 0 else "n_H"
    return (
        f"the counterbody {counterbody.name} is softer than the film {film.name} and yields first: where they meet its "
        f"hardness counts ({n_H}), and the hardness of the film changes nothing"
    )
