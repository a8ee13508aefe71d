"""How much of a friction coefficient is the reading of the surface: one scan, five ways to find asperities, eight resolutions.

    python examples/from_a_scan.py

A made surface stands for the scan; with one of your own, give its name to st.read_scan. The picture is the resolution study:
sigma, R, N and mu by the model of 2015 against the shortest wavelength that is left in the scan, a line for each method. The
answer with its interval is that of st.predict, last, which takes the map itself.
"""

import numpy as np

import stiction as st
from stiction.report.method_pictures import resolution_figure

spectrum = st.SelfAffine(hurst=0.8, rolloff=5e-6, shortest=0.2e-6, deviation=10e-9)
made = st.gaussian_surface((512, 512), (30e-6, 30e-6), spectrum, seed=7)
np.save("scan.npy", made.heights)

scan = st.prepared(st.read_scan("scan.npy", size="30 um", unit="m"), form=1)
print(*scan.history, sep="\n")
contact = st.Contact(
    first="hardened_steel_52100",
    second="hardened_steel_52100",
    work_of_adhesion="0.1 J/m^2",
    nominal_area="1 mm^2",
    roughness=st.Roughness(asperity_height_deviation="10 nm", asperity_radius="1 um", asperity_density="1e12 1/m^2"),
)  # its roughness is replaced by what is found
resolution_study = st.resolution_study(scan, contact=contact, load="100 mN")
lowest, highest = float(resolution_study["mu"].min()), float(resolution_study["mu"].max())
print(f"static friction coefficient from {lowest:.3f} to {highest:.3f}, by method and resolution alone")
answer = st.predict(contact.replace(roughness=scan), load="100 mN")
low, mu, high = (answer[f"friction_coefficient{end}"].item() for end in ("_low", "", "_high"))
print(f"prediction: mu = {mu:.2g}, {answer.level:.0%} interval {low:.2g} to {high:.2g}")
print("warning:", *answer.warnings)
resolution_figure(resolution_study).savefig("fan.png", dpi=150)
