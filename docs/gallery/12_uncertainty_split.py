"""What the answer is uncertain by: inputs, or models?

Two bearing steels with three numbers that are known within factors. Above, the band of the inputs by one model; below, what
is left by the inputs, and by the choice of the model, each as if the other were known; and which of the inputs to measure
better.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

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
data = st.uncertainty(CASE, load="1 N")
shares = st.sensitivity(CASE, load="1 N", models=[]).squeeze()

figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11, 3.6), layout="constrained")
left.plot(data["load"], data["friction_coefficient"], label="as given")
quantiles = data["friction_coefficient_quantile"]
for low, high, alpha in ((0, -1, 0.2), (1, -2, 0.3)):
    left.fill_between(data["load"], quantiles.isel(quantile=low), quantiles.isel(quantile=high), alpha=alpha, color="C0")
left.set(
    xscale="log", xlabel="load [N]", ylabel="static friction coefficient", title="Half, and 90 %, of the draws", ylim=(0, None)
)
spreads = data.dropna("spread", subset=["spread_factor"]) if "methods" in data["spread"].values else data
for at, name in enumerate(spreads["spread"].values):
    one = spreads.sel(spread=name)
    middle.plot([one["spread_low"], one["spread_high"]], [at, at], linewidth=14, solid_capstyle="butt")
middle.set_yticks(np.arange(spreads.sizes["spread"]), spreads["spread"].values)
middle.set(xlabel="static friction coefficient", title="At 1 N, each by itself", ylim=(-0.6, spreads.sizes["spread"] - 0.4))
total = shares["friction_coefficient_total_order"]
right.barh(shares["input"].values, total)
right.set(xlabel="share of the variance of ln mu", title="Which input", xlim=(0.0, 1.0))
right.tick_params(axis="y", labelsize="small")
figure.savefig("uncertainty_split.png", dpi=120)
