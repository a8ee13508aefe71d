"""Figure 1: the 2015 model in its two readings, bare, with a stiffer and with a softer film. Writes readings.png."""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

THETA, LAM = 40.0, 10.0
FILMS = {
    "no film": {},
    "stiffer film, $n_E=1.5$, $n_H=0.5$, $t=2\\sigma$": {"n_E": 1.5, "n_H": 0.5, "tau": 2.0},
    "softer film, $n_E=0.5$, $n_H=0.8$, $t=2\\sigma$": {"n_E": 0.5, "n_H": 0.8, "tau": 2.0},
}

h = np.linspace(3.5, -2.0, 120)
figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
for at, (name, film) in enumerate(FILMS.items()):
    for variant, style in (("published", "--"), ("corrected", "-")):
        load, _, friction = st.evaluate(h, THETA, LAM, variant=variant, **film)
        pressed = load > 0.0  # where adhesion alone holds the surfaces there is no coefficient
        mu = friction[pressed] / load[pressed]
        axes.loglog(load[pressed], mu, style, color=f"C{at}", label=f"{name}, {variant}")
axes.set(xlabel="load per asperity over $KR^{1/2}\\sigma^{3/2}$", ylabel="static friction coefficient", ylim=(1e-2, 10.0))
axes.grid(alpha=0.3)
axes.legend(fontsize="x-small")
figure.savefig("readings.png", dpi=150)
