"""An unloading loop.

Adhesive elastic-plastic asperities (Thornton and Ning 1998) are loaded to three different loads and then separated. A higher
load flattens the asperities more. The flattened asperities have more contact area and adhere up to a larger separation, so the
pull-off force grows with the preceding load.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

silver = st.material("silver")
contact = st.Contact(
    first=silver,
    second=silver,
    roughness=st.Roughness(asperity_height_deviation="5 nm", asperity_radius="20 um", asperity_density="5e10 1/m^2"),
    work_of_adhesion="1 J/m^2",
    nominal_area="1 mm^2",
)
laws = {"model": "greenwood_williamson_1966", "asperity": "thornton_ning_1998", "tangential": "none"}

figure, axes = plt.subplots(figsize=(6.5, 4.2), layout="constrained")
down = st.solve(contact, separation=np.linspace(3.5, -6.2, 120) * 5e-9, **laws)
axes.plot(down["mean_separation"] * 1e9, down["load"], color="black", label="pressed")
for load in (0.5, 2.0, 6.0):
    distance = np.linspace(0.0, 40e-9, 200)
    back = st.unload(contact, max_load=load, separation_increase=distance, **laws)
    axes.plot(
        back["mean_separation"] * 1e9,
        back["load"],
        label=f"back from {load:g} N: pull-off {float(back['pull_off_force']):.2g} N",
    )
axes.axhline(0.0, color="grey", linewidth=0.8)
axes.set(xlabel="mean separation [nm]", ylabel="net load [N]", title="Silver on silver, w = 1 J/m$^2$")
axes.legend(fontsize="small")
axes.grid(alpha=0.3)
figure.savefig("unloading.png", dpi=120)
