"""Figure 2: how far models are from solved contacts, by mean pressure, on Gaussian isotropic surfaces. Writes errors.png."""

import matplotlib.pyplot as plt
import numpy as np

from stiction.solving.accuracy.benchmark_set import benchmark_set

MODELS = {
    "greenwood_williamson_1966|mccool": "Greenwood & Williamson, asperities by McCool",
    "bush_gibson_thomas_1975|moments": "Bush, Gibson & Thomas",
    "persson_2001|moments": "Persson",
    "yang_persson_2008|moments": "Yang & Persson",
    "persson_widened|moments": "this project's formula",
}

known = benchmark_set()
figure, axes = plt.subplots(figsize=(6.0, 4.0), layout="constrained")
for at, (column, name) in enumerate(MODELS.items()):
    error = 100.0 * np.expm1(known.errors(column)[known.gaussian, 0])
    axes.fill_between(known["loads"], *np.nanpercentile(error, [10.0, 90.0], axis=0), color=f"C{at}", alpha=0.15, linewidth=0)
    axes.semilogx(known["loads"], np.nanmean(error, axis=0), "o-", markersize=3, color=f"C{at}", label=name)
axes.axhline(0.0, color="black", linewidth=0.8)
axes.set(xlabel="mean pressure over $E^*h'$", ylabel="error of the contact area [%]", ylim=(-80.0, 20.0))
axes.grid(alpha=0.3)
axes.legend(fontsize="x-small")
figure.savefig("errors.png", dpi=150)
