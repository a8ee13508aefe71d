"""Define the class Coating, a film on one body of a contact or on both."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field

from stiction.contact.materials import Material, as_material
from stiction.quantities.inputs import Input, Number, OptionalNumber, by_default

if TYPE_CHECKING:
    from stiction.quantities.keywords import Converted

    Body = Converted[Material, Material | str | Mapping[str, object]]
else:
    Body = Annotated[Material, BeforeValidator(as_material, json_schema_input_type=str | Material)]


class Coating(Input):
    """Describe a film on one body of a contact, or a film on each of the two bodies.

    Parameters
    ----------
    material : Material, str or dict
        Material, name of a preset, or a dict with the fields of a Material.
    thickness : float [m], str with a unit, or array
        Film thickness; with two films, the sum of both thicknesses.
    bodies : {"both", "first", "second"}
        Coated body; with "both" (default, as in the 2015 paper) each body has a film, and film meets film.
    work_of_adhesion : float [J/m^2], str with a unit, or array, optional
        Work of adhesion of the surfaces that meet; by default the value of the contact.
    friction_constant : float [N/m], str with a unit, or array, optional
        Constant C of the friction mu = (C t/W)^(1/3) of an asperity with load W on a film of thickness t. Only the film law of
        Ravindran et al. (1980) uses it; by default it follows from strength and hardness.

    Raises
    ------
    InputError
        A number is out of its bounds, or a name is unknown.

    Notes
    -----
    The film laws use the ratios H/Y and E_t/E (tangent modulus over Young's modulus) of the bodies for the film too. A
    yield_stress or tangent_modulus of the film only decides whether the film or an equally hard body yields first.

    Examples
    --------
    >>> import stiction as st
    >>> st.Coating(material="silver", thickness="200 nm").thickness
    2e-07
    """

    material: Body = Field(description="a material: the name of a preset, or its numbers")
    thickness: Number
    bodies: Literal["both", "first", "second"] = "both"
    work_of_adhesion: OptionalNumber = by_default(None)
    friction_constant: OptionalNumber = by_default(None)


def softer_in_words(film: Material, counterbody: Material, bare: Any) -> str:
    """Return a remark that the body opposite the film is softer than the film, and therefore yields first.

    film, counterbody: materials of the film and of the body opposite. bare: hardness of the contact without the film [Pa].
    The hardness ratio n_H is given as a number unless it is an array.
    """
    ratio = counterbody.hardness / bare
    n_H = f"n_H = {float(ratio):.4g}" if np.ndim(ratio) == 0 else "n_H"
    return (
        f"the counterbody {counterbody.name} is softer than the film {film.name} and yields first: its hardness is "
        f"used ({n_H}), and the hardness of the film changes nothing"
    )
