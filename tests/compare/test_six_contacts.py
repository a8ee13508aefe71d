"""Six contacts and what an expert would say of each: the judgement that the prediction is held to.

The verdicts rest on what is known without any of the models: a metal pressed plastically under a stated interface strength has
mu = tau_0/H where its contacts are fully plastic, and a little more where they are not, as long as tau_0 is well below the
shear strength of the bulk, H/(2.8 sqrt(3)); from there on it is clean metal, which seizes: mu > 1; a soft film that
yields has tau_0/H_f; clean metals without a stated strength cannot have a mu of a hundredth while their asperities flow; a
soft polymer sticks.
"""

import pytest

import stiction as st


def body(modulus, hardness, nu):
    return {"youngs_modulus": modulus, "hardness": hardness, "poissons_ratio": nu}


def rough(sigma, radius, density):
    return st.Roughness(asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density)


COPPER, STEEL, SILICON = body("120 GPa", "1 GPa", 0.34), body("210 GPa", "7 GPa", 0.3), body("160 GPa", "12 GPa", 0.22)
ON_STEEL = {
    "first": STEEL, "second": STEEL, "roughness": rough("50 nm", "20 um", "1e10 1/m^2"), "nominal_area": "1 mm^2",
    "work_of_adhesion": "50 mJ/m^2",
}  # fmt: skip


def copper(gamma="0.88 J/m^2", **more):
    roughness = rough("150 nm", "20 um", "1.2e10 1/m^2")
    return st.Contact(first=COPPER, second=COPPER, roughness=roughness, work_of_adhesion=gamma, nominal_area="1 mm^2", **more)


def pdms(**more):
    given = {"roughness": rough("0.2 um", "20 um", "2e9 1/m^2"), "nominal_area": "1 mm^2", "work_of_adhesion": "50 mJ/m^2"}
    return st.Contact(first=body("2 MPa", "1 MPa", 0.49), second=body("70 GPa", "6 GPa", 0.2), **given | more)


def polysilicon():
    roughness = rough("5 nm", "0.5 um", "1e13 1/m^2")
    return st.Contact(first=SILICON, second=SILICON, roughness=roughness, work_of_adhesion="20 mJ/m^2", nominal_area="400 um^2")


def coated(material, thickness, strength):
    coating = st.Coating(material=material, thickness=thickness, bodies="first")
    return st.Contact(**ON_STEEL, coating=coating, interfacial_shear_strength=strength)


DLC, SILVER = body("150 GPa", "15 GPa", 0.2), body("83 GPa", "0.5 GPa", 0.37)
# Contact -> (it, load, lowest and highest mu that the expert grants).
VERDICTS = {
    "clean copper": (copper(), "1 N", 0.2, 2.0),
    "oxidised copper": (copper(interfacial_shear_strength="100 MPa"), "1 N", 0.1, 0.14),
    "copper stronger at the interface than in bulk": (
        copper(interfacial_shear_strength="300 MPa"),
        "1 N",
        1.0,
        16.0,
    ),
    "PDMS on glass": (pdms(), "10 mN", 0.5, 20.0),
    "polysilicon": (polysilicon(), "100 uN", 0.1, 1.5),
    "2 um of DLC": (coated(DLC, "2 um", "500 MPa"), "1 N", 0.25, 0.4),
    "200 nm of silver": (coated(SILVER, "200 nm", "35 MPa"), "1 N", 0.06, 0.08),
}


@pytest.mark.parametrize("which", VERDICTS)
def test_the_verdict(which):
    """The interval of the prediction and what an expert grants have values in common."""
    contact, load, low, high = VERDICTS[which]
    found = st.predict(contact, load=load)
    assert float(found["friction_coefficient_low"]) <= high and low <= float(found["friction_coefficient_high"])
