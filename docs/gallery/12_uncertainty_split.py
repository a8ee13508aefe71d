"""What makes the answer uncertain?

Two bearing steels with four uncertain numbers. Left: the interval that these numbers cause with a single model. Middle: the
contributions to the variance of the prediction. Right: the contributions of the inputs with a single model, which show what to
measure better.
"""

import matplotlib.pyplot as plt

import stiction as st
from stiction.case.read import parse_case

CASE = {
    "contact": {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "work_of_adhesion": {"median": "20 mJ/m^2", "factor": 2},
        "interfacial_shear_strength": "200 +/- 40 MPa",
        "nominal_area": "1 mm^2",
        "roughness": {
            "asperity_height_deviation": "48 +/- 5 nm",
            "asperity_radius": {"low": "35 um", "high": "65 um"},
            "asperity_density": "1.7e10 1/m^2",
        },
    },
    "solve": {"load": ["0.1 N", "0.3 N", "1 N", "3 N", "10 N"], "model": "greenwood_williamson_1966"},
    "uncertainty": {"count": 256},
}
data = st.solve_case(parse_case(CASE))
shares = st.sensitivity(CASE, load="1 N", models=[]).squeeze()

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
left.plot(data["load"], data["friction_coefficient"], label="nominal inputs")
quantiles = data["friction_coefficient_quantile"]
for low, high, alpha in ((0, -1, 0.2), (1, -2, 0.3)):
    left.fill_between(data["load"], quantiles.isel(quantile=low), quantiles.isel(quantile=high), alpha=alpha, color="C0")
left.set(xscale="log", xlabel="load [N]", ylabel="static friction coefficient", title="50 % and 90 % intervals", ylim=(0, None))
parts = st.predict({**CASE, "solve": {"load": "1 N"}}).attrs["shares"]
middle.barh([name.replace("_", " ") for name in parts], list(parts.values()))
middle.set(xlabel="fraction of the variance of ln mu", title="Contributions to the prediction, 1 N", xlim=(0.0, 1.0))
total = shares["friction_coefficient_total_order"]
right.barh([name.replace("_", " ") for name in shares["input"].values], total)
right.set(xlabel="fraction of the variance of ln mu", title="Inputs, one model, 1 N", xlim=(0.0, 1.0))
right.tick_params(axis="y", labelsize="small")
figure.savefig("uncertainty_split.png", dpi=120)
