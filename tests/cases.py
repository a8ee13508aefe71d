"""Cases that several tests run."""

import tomllib
from pathlib import Path

import stiction as st

__all__ = ["BARE", "SILICON_CASE", "SILICON_ON_SILICON", "STEEL_ON_STEEL", "of_one_model"]

# Without a title and what to solve.
STEEL_ON_STEEL = """
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "0.1 J/m^2"
nominal_area = "1 mm^2"
interfacial_shear_strength = "200 MPa"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
"""
# The table [contact] of silver on steel, without a film.
BARE = {
    "first": "silver",
    "second": {"preset": "hardened_steel_52100"},
    "work_of_adhesion": "0.5 J/m^2",
    "nominal_area": "1 mm^2",
    "roughness": {
        "asperity_height_deviation": "50 nm",
        "asperity_radius": "50 um",
        "asperity_density": "1.6e10 1/m^2",
    },
}

# Smooth silicon of micromachines, dry, whose interface states its strength.
SILICON_ON_SILICON = st.Contact(
    first="silicon",
    second="silicon",
    roughness=st.Roughness(asperity_height_deviation="10 nm", asperity_radius="1 um", asperity_density="1e13 1/m^2"),
    nominal_area="0.01 mm^2",
    interfacial_shear_strength="100 MPa",
)

# The same as text of a case file, to which more numbers of the contact may be added.
SILICON_CASE = """
[contact.roughness]
asperity_height_deviation = "10 nm"
asperity_radius = "1 um"
asperity_density = "1e13 1/m^2"
[contact]
first = "silicon"
second = "silicon"
nominal_area = "0.01 mm^2"
interfacial_shear_strength = "100 MPa"
"""


def of_one_model():
    """Return the tables of the example of a silver film, answered by the model of the 2015 paper."""
    tables = tomllib.loads((Path(__file__).parents[1] / "examples" / "silver_on_steel.toml").read_text(encoding="utf-8"))
    return {**tables, "solve": {**tables["solve"], "model": "soft_coating_2015"}}
