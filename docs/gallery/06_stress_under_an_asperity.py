"""Stress under an asperity with normal and tangential load.

Von Mises stress divided by the local yield stress in a cross-section, for bare steel, steel with a softer film, and steel with
a harder film. On the line the ratio is 1. The dot marks the largest ratio. The stresses are from the elastic solution for a
sphere on a layered solid.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st
from stiction.studies.stresses.one_asperity import one_asperity

steel = "hardened_steel_52100"
FILMS = {
    "no film": None,
    "200 nm of MoS2": st.Coating(material="molybdenum_disulfide", thickness="200 nm", bodies="first"),
    "200 nm of hard carbon": st.Coating(material="diamond_like_carbon", thickness="200 nm", bodies="first"),
}
figure, panels = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained", sharey=True)
for (name, film), axes in zip(FILMS.items(), panels, strict=True):
    contact = st.Contact(
        first=steel,
        second=steel,
        coating=film,
        roughness=st.Roughness(asperity_height_deviation="48 nm", asperity_radius="2 um", asperity_density="2e11 1/m^2"),
        work_of_adhesion="50 mJ/m^2",
        nominal_area="1 mm^2",
    )
    found = one_asperity(contact, radius=0.4, traction=0.2)
    shown = axes.contourf(found.x, found.z, found.stress, levels=np.linspace(0.0, 1.6, 17), extend="max", cmap="viridis")
    axes.contour(found.x, found.z, found.stress, levels=[1.0], colors="white")
    axes.plot(*found.at, "o", color="red")
    if np.isfinite(found.thickness):
        axes.axhline(found.thickness, color="white", linestyle="--")
    axes.set(title=f"{name}:\n{found.largest:.2f} in the {found.where}", xlabel="x over the contact radius", ylim=(1.8, 0.0))
panels[0].set_ylabel("depth over the contact radius")
figure.colorbar(shown, ax=panels, label="von Mises stress over yield stress")
figure.savefig("stress_under_an_asperity.png", dpi=120)
