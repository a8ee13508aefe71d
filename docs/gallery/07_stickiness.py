"""When does a rough surface stick?

Rough contacts with different elastic moduli and different roughness. The colours show the pull-off force divided by the
pull-off force of the same asperities at equal heights (fuller_tabor_1975; all contacts are solved as one array). The red line
is the limit of stickiness after Pastewka and Robbins.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st
from stiction.contact.indices import Groups
from stiction.laws.criterion.pastewka_robbins_2014 import stickiness

sigma, modulus = np.geomspace(1e-9, 1e-6, 40), np.geomspace(1e5, 1e11, 40)  # m, Pa
radius, energy = 10e-6, 0.05  # m, J/m^2
deviation = st.axis("asperity_height_deviation", sigma)
density = (0.05 / (radius * deviation)).assign_attrs(units="1/m^2")  # as of a random surface: rougher is coarser
stiff = st.Material(youngs_modulus="300 GPa", poissons_ratio=0.25, hardness="15 GPa")
contacts = st.Contact(
    first=st.Material(youngs_modulus=st.axis("youngs_modulus", modulus), poissons_ratio=0.45, hardness="1 GPa"),
    second=stiff,
    roughness=st.Roughness(
        asperity_height_deviation=deviation,
        asperity_radius=radius,
        asperity_density=density,
    ),
    work_of_adhesion=energy,
    nominal_area="1 mm^2",
)
solved = st.solve(contacts, separation=[0.0], model="fuller_tabor_1975")
smooth = contacts.roughness.asperity_density * 1e-6 * 1.5 * np.pi * energy * radius  # N: all asperities at once (JKR)
left_over = (solved["pull_off_force"] / smooth).transpose("youngs_modulus", "asperity_height_deviation")
groups, sizes = Groups.of(contacts.indices())
border = stickiness(groups).reshape(tuple(sizes.values()))
border = border if tuple(sizes) == ("youngs_modulus", "asperity_height_deviation") else border.T

figure, axes = plt.subplots(figsize=(6.5, 4.5), layout="constrained")
levels = np.geomspace(1e-6, 1.0, 13)
shown = axes.contourf(sigma * 1e9, modulus, np.maximum(left_over, 1e-6), levels=levels, norm="log", cmap="viridis")
axes.contour(sigma * 1e9, modulus, border, levels=[1.0], colors="red", linewidths=2.5)
axes.set(
    xscale="log", yscale="log", xlabel="sigma of the asperity heights [nm]", ylabel="Young's modulus of the softer body [Pa]"
)
axes.set_title("Pull-off force over that of asperities of equal height; red: Pastewka & Robbins", fontsize="medium")
figure.colorbar(shown, label="pull-off force, relative")
figure.savefig("stickiness.png", dpi=120)
