"""A map with its contact spots.

The contact of a generated rough surface, solved point by point at two loads. The contact spots are drawn on the height map.
The solution does not assume asperities. The errors of all models are computed from such solutions (docs/explanation/truth.md).
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st
from stiction.solvers.boundary_elements.solve import solve_map

spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=1.25e-6, deviation=30e-9)
surface = st.gaussian_surface((192, 192), ("30 um", "30 um"), spectrum, seed=2)
steel = st.material("hardened_steel_52100")
modulus = 0.5 * steel.youngs_modulus / (1.0 - steel.poissons_ratio**2)  # E* of two bodies of steel
loads = [0.01, 0.05]  # N
solved = solve_map(
    surface.heights, surface.size, modulus=modulus, loads=loads, periodic=True, hardness=steel.hardness, stiffness=False
)

figure, panels = plt.subplots(1, 2, figsize=(9.5, 4.6), layout="constrained", sharey=True)
side = surface.size[0] * 1e6
for contact, axes in zip(solved, panels, strict=True):
    heights = axes.imshow(surface.heights * 1e9, cmap="Greys_r", extent=(0, side, 0, side), origin="lower")
    spots = np.ma.masked_less_equal(contact.pressure * 1e-9, 0.0)
    pressed = axes.imshow(spots, cmap="plasma", extent=(0, side, 0, side), origin="lower", vmin=0.0, vmax=steel.hardness * 1e-9)
    share = contact.area / contact.nominal_area
    axes.set_title(f"{contact.load * 1e3:.0f} mN: {share:.1%} of the area touches", fontsize="medium")
    axes.set_xlabel("x [µm]")
panels[0].set_ylabel("y [µm]")
figure.colorbar(heights, ax=panels, label="height [nm]", shrink=0.8)
figure.colorbar(pressed, ax=panels, label="pressure in the spots [GPa]", shrink=0.8)
figure.savefig("contact_spots.png", dpi=120)
