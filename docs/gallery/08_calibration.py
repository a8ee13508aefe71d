"""Fit: the strength of an interface from measured friction.

The data are synthetic: a strength of 150 MPa, a pressure coefficient of 0.05, and noise of 3 %. The fit estimates both numbers
with intervals. The band is the predicted friction at other loads.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

MEASURED = """load [mN],friction_coefficient,friction_coefficient_error
20,0.1645,0.0051
38.6,0.1675,0.0050
74.6,0.1546,0.0049
144,0.1682,0.0048
278,0.1619,0.0048
537,0.1547,0.0047
1040,0.1517,0.0046
2000,0.1513,0.0045
"""
CASE = {
    "contact": {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "interfacial_shear_strength": "100 MPa",
        "pressure_coefficient": 0.1,
        "nominal_area": "1 mm^2",
        "roughness": {
            "asperity_height_deviation": "60 nm",
            "asperity_radius": "40 um",
            "asperity_density": "1.7e10 1/m^2",
        },
    },
    "solve": {
        "load": {"start": "10 mN", "stop": "20 N", "count": 12, "spacing": "log"},
        "model": "greenwood_williamson_1966",
    },
    "fit": {
        "free": {
            "interfacial_shear_strength": {"low": "1 MPa", "high": "1 GPa"},
            "pressure_coefficient": {"low": 0, "high": 0.3},
        }
    },
}

Path("measured.csv").write_text(MEASURED, encoding="utf-8")
data = st.fit(CASE, "measured.csv")
load, mu, error = np.loadtxt("measured.csv", delimiter=",", skiprows=1, unpack=True)

figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
axes.errorbar(load * 1e-3, mu, yerr=error, fmt="o", capsize=4, label="measured (synthetic)")
predicted = data["predicted_friction_coefficient"].squeeze()
low, high = (data[f"predicted_friction_coefficient_{end}"].squeeze() for end in ("low", "high"))
axes.plot(predicted["load"], predicted, label="fitted")
axes.fill_between(predicted["load"], low, high, alpha=0.2, label="band of the fit")
strength, coefficient = zip(*(data[key].values for key in ("value", "low", "high")), strict=True)
axes.set(xscale="log", xlabel="load [N]", ylabel="static friction coefficient", ylim=(0.0, None))
axes.set_title(
    "interface strength {:.0f} MPa ({:.0f} to {:.0f} MPa)\n".format(*(value / 1e6 for value in strength))
    + "pressure coefficient {:.2f} ({:.2f} to {:.2f})".format(*coefficient),
    fontsize="small",
)
axes.legend()
axes.grid(alpha=0.3)
figure.savefig("calibration.png", dpi=120)
