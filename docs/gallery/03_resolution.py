"""Friction against the resolution of the scan.

A scan with a finer resolution contains more and sharper asperities. In this example the short waves of one generated surface
are removed step by step. Each line is one asperity method. If a line is not horizontal, the result depends on the resolution.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st
from stiction.solving.choice import Choice

steel = "hardened_steel_52100"
spectrum = st.SelfAffine(hurst=0.8, rolloff=10e-6, shortest=0.7e-6, deviation=8e-9)
surface = st.gaussian_surface((192, 192), ("40 um", "40 um"), spectrum, seed=1)
contact = st.Contact(
    first=steel, second="silicon_nitride", roughness=surface, interfacial_shear_strength="300 MPa", nominal_area="1 mm^2"
)
study = st.resolution_study(
    surface,
    np.geomspace(0.8e-6, 8e-6, 6),
    contact=contact,
    load="1 N",
    choice=Choice("greenwood_williamson_1966", tangential="bowden_tabor_1943"),
)

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained", sharex=True)
for method in study["asperity_method"].values:
    one = study.sel(asperity_method=method)
    left.plot(one["cutoff"] * 1e6, one["mu"], "o-", label=method)
    right.loglog(one["cutoff"] * 1e6, one["R"] * 1e6, "o-", label=method)
left.set(xscale="log", xlabel="shortest wavelength [µm]", ylabel="static friction coefficient at 1 N", ylim=(0.0, None))
right.set(xlabel="shortest wavelength [µm]", ylabel="asperity radius [µm]")
for axes in (left, right):
    axes.grid(alpha=0.3)
    axes.set_xticks([1, 2, 5], ["1", "2", "5"])
    axes.set_xticks([], minor=True)
left.legend(fontsize="small")
figure.savefig("resolution.png", dpi=120)
