"""A Pareto front: little friction, or much contact area?

An electric contact needs a large contact area, but should slide easily. The search varies the thickness of a silver film and
the roughness of the surface. No design on the line is better than another in both objectives. `stiction design` computes this
Pareto front, also with constraints.
"""

import matplotlib.pyplot as plt

import stiction as st

CASE = {
    "contact": {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "work_of_adhesion": "0.3 J/m^2",
        "nominal_area": "1 mm^2",
        "roughness": {
            "asperity_height_deviation": "48 nm",
            "asperity_radius": "50 um",
            "asperity_density": "1.7e10 1/m^2",
        },
        "coating": {"material": "silver", "bodies": "first", "thickness": "200 nm"},
    },
    "solve": {"load": "1 N"},
    "design": {
        "objective": [{"minimise": "friction_coefficient"}, {"maximise": "contact_area"}],
        "validity": "possible",
        "effort": 6,
        "choose": {
            "coating": {"thickness": {"low": "20 nm", "high": "500 nm"}},
            "roughness": {"asperity_height_deviation": {"low": "20 nm", "high": "80 nm"}},
        },
    },
}
data = st.design(CASE)

figure, axes = plt.subplots(figsize=(6.5, 4), layout="constrained")
points = axes.scatter(
    data["pareto_contact_area"] * 1e12,
    data["pareto_friction_coefficient"],
    c=data["pareto_coating.thickness"] * 1e9,
    norm="log",
)
figure.colorbar(points, label="thickness of the silver [nm]")
axes.set(xlabel="real contact area [µm²]", ylabel="static friction coefficient")
axes.set_title("Silver on bearing steel at 1 N: the front of two objectives", fontsize="medium")
axes.grid(alpha=0.3)
figure.savefig("design_front.png", dpi=120)
