"""From rest to sliding: tangential force against displacement.

Each asperity first sticks, then slips from the edge of its contact inwards, and finally slides. Different asperities slide at
different displacements. The total force therefore rises smoothly, although every asperity obeys Coulomb's law. If a sliding
asperity retains only a fraction of its strength, the largest total force is less than the sum of all strengths.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

steel = "hardened_steel_52100"
contact = st.Contact(
    first=steel,
    second=steel,
    roughness=st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2"),
    interfacial_shear_strength="200 MPa",
    nominal_area="1 mm^2",
)
laws = {"model": "greenwood_williamson_1966", "tangential": "bowden_tabor_1943"}
displacement = np.linspace(0.0, 30e-9, 121)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
for load in (0.3, 1.0, 3.0):
    data = st.slide(contact, load=load, displacement=displacement, **laws)
    left.plot(displacement * 1e9, data["tangential_force"].squeeze(), label=f"{load:g} N")
left.set(xlabel="tangential displacement [nm]", ylabel="tangential force [N]")
left.legend(title="load")
for residual in (1.0, 0.7, 0.4):
    data = st.slide(contact, load=1.0, displacement=displacement, residual_strength=residual, **laws)
    right.plot(displacement * 1e9, data["tangential_force"].squeeze() / 1.0, label=f"{residual:g}")
right.set(xlabel="tangential displacement [nm]", ylabel="tangential force over load")
right.legend(title="residual strength")
for axes in (left, right):
    axes.grid(alpha=0.3)
    axes.set_ylim(bottom=0.0)
figure.savefig("sliding.png", dpi=120)
