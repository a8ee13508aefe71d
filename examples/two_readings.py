"""The 2015 model as printed and as corrected, with and without films: friction against load.

    python examples/two_readings.py

theta and lambda of the paper's figures are not printed; 40 and 10 show its claims.
"""

import numpy as np
from matplotlib.figure import Figure

import stiction as st

SURFACES = {
    "no film": {},
    "stiff film, n_E = 1.5, n_H = 0.5": {"n_E": 1.5, "n_H": 0.5, "tau": 2.0},
    "soft film, n_E = 0.5, n_H = 0.8": {"n_E": 0.5, "n_H": 0.8, "tau": 2.0},
}
h = np.linspace(3, -4, 71)

figure = Figure(figsize=(9, 4.5), layout="constrained")
for axes, variant in zip(figure.subplots(1, 2, sharey=True), ("published", "corrected"), strict=True):
    for name, film in SURFACES.items():
        result = st.solve(st.Indices(theta=40, lam=10, **film), separation=h, variant=variant)
        pressed = result["load"] > 1e-4
        axes.loglog(result["load"].where(pressed), result["friction_coefficient"].where(pressed), label=name)
        mu = float(result["friction_coefficient"].sel(mean_separation=1.0))
        print(f"{variant:9}  {name:33} mu = {mu:.4f} at h = 1")
    axes.set_title(f"{variant} variant")
    axes.set_xlabel(r"load / ($N A_\mathrm{n} K R^{1/2} \sigma^{3/2}$)")
    axes.grid(alpha=0.3)
figure.axes[0].set_ylabel("static friction coefficient")
figure.axes[0].legend()
figure.savefig("two_readings.png", dpi=150)
