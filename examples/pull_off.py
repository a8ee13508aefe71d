"""How roughness destroys adhesion: pull-off force against theta for several distributions of the asperity heights.

    python examples/pull_off.py

For Gaussian heights it is the curve of Fuller & Tabor 1975. theta = K sigma^(3/2) / (gamma R^(1/2)) grows with roughness and
stiffness. The force is over that of as many free asperities, N A_n (3/2) pi gamma R, or 3 pi / (2 theta) per asperity.
"""

import math

import numpy as np
from matplotlib.figure import Figure

import stiction as st

theta = st.axis("theta", np.geomspace(0.1, 100, 61))
figure = Figure(figsize=(6, 4), layout="constrained")
axes = figure.subplots()
for name, parameters in (("gaussian", {}), ("exponential", {}), ("weibull", {"exponent": 2.0})):
    heights = st.height_distribution(name, **parameters)
    result = st.solve(st.Indices(theta=theta, lam=1.0), separation=0.0, model="fuller_tabor_1975", heights=heights)
    share = result["pull_off_force"] * 2 * theta / (3 * math.pi)
    axes.semilogx(theta, share, label=" ".join([name, *(f"({value:g})" for value in parameters.values())]))
    at_10 = float(share.sel(theta=10.0, method="nearest"))
    print(f"{name:12} {at_10:.1%} of the ideal pull-off force is left at theta = 10")
axes.set_xlabel(r"elastic adhesion index $\theta$")
axes.set_ylabel(r"pull-off force / ($N A_\mathrm{n}\,\frac{3}{2}\pi\gamma R$)")
axes.set_ylim(bottom=0)
axes.legend(title="heights")
axes.grid(alpha=0.3)
figure.savefig("pull_off.png", dpi=150)
