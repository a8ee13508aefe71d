"""Friction against film thickness, with error bars.

Silver on bearing steel at 1 N. The strength of the interface, the work of adhesion and the hardness of the film are uncertain,
and each number is stated with its error. The bars are the resulting 90 % intervals of the friction coefficient.
"""

from pathlib import Path

import matplotlib.pyplot as plt

import stiction as st

CASE = """
[materials.film]
preset = "silver"
hardness = "0.4 GPa +/- 20 %"

[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = { median = "50 mJ/m^2", factor = 2 }
interfacial_shear_strength = "25 +/- 5 MPa"
nominal_area = "1 mm^2"

[contact.coating]
material = "film"
thickness = { start = "50 nm", stop = "2 um", count = 9, spacing = "log" }
bodies = "first"

[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"

[solve]
load = ["1 N"]
asperity = "hertz"
tangential = "bowden_tabor_1943"
film = "layered"

[uncertainty]
count = 128
"""

Path("film.toml").write_text(CASE, encoding="utf-8")
data = st.solve_case(st.read_case("film.toml")).squeeze()
mu = data["friction_coefficient"]
thickness = data["thickness"].values * 1e9
low, high = (data["friction_coefficient_quantile"].isel(quantile=end).values for end in (0, -1))

figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
axes.errorbar(thickness, mu, yerr=[mu.values - low, high - mu.values], fmt="o", capsize=4)
axes.set(xscale="log", xlabel="thickness of the silver [nm]", ylabel="static friction coefficient", ylim=(0.0, None))
axes.set_title("Silver on bearing steel, 1 N on 1 mm$^2$; bars hold 90 %", fontsize="medium")
axes.grid(alpha=0.3)
figure.savefig("film_thickness.png", dpi=120)
