"""Friction against load for silver films of several thicknesses on steel by the model of 2015: one dataset, one picture.

    python examples/film_thickness.py

One model has no interval, and where it leaves its range it says so. The answer for one thickness is that of
`stiction run examples/soft_film.toml`.
"""

from matplotlib.figure import Figure

import stiction as st

contact = st.Contact(
    first="hardened_steel_52100",
    second="hardened_steel_52100",
    coating=st.Coating(
        material=st.material("silver", hardness="0.4 GPa"),
        thickness=st.axis("thickness", ["25 nm", "50 nm", "75 nm", "100 nm", "200 nm"]),
        bodies="first",
    ),
    roughness=st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2"),
    work_of_adhesion="1 J/m^2",
    nominal_area="1 mm^2",
)
loads = [10 ** (exponent / 10) for exponent in range(-30, 16)]  # N, from 1 mN to 30 N
result = st.solve(contact, load=loads, model="soft_coating_2015")

figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.subplots()
for thickness in result["thickness"].values:
    curve = result["friction_coefficient"].sel(thickness=thickness)
    axes.semilogx(result["load"], curve, label=f"{thickness * 1e9:.0f} nm")
axes.set_xlabel("load [N]")
axes.set_ylabel("static friction coefficient")
axes.set_title("Silver film on hardened steel, soft_coating_2015")
axes.legend(title="film thickness")
axes.set_ylim(bottom=0)
axes.grid(alpha=0.3)
figure.savefig("film_thickness.png", dpi=150)

at_1_N = result["friction_coefficient"].sel(load=1.0)
for thickness, mu in zip(at_1_N["thickness"].values, at_1_N.values, strict=True):
    print(f"{thickness * 1e9:4.0f} nm   mu = {mu:.4f} at 1 N")
print("Outside its validity:", result.attrs["outside_validity"])
