"""The figures of the 2015 paper, as published and corrected.

The coated and the uncoated surface of figures 1(a), 2(a) and 3, computed with the published equations and with the corrected
equations (docs/explanation/theory-limits.md lists the differences). The paper does not print the adhesion indices of its
figures. This picture uses theta = 40 and lambda = 10, for which the claims of the paper are true. `stiction figures` draws all
figures for other indices.
"""

import matplotlib.pyplot as plt
import numpy as np

import stiction as st

FIGURES = {
    "1(a), modulus of the film": ("n_E", (0.5, 1.5, 2.5), {"n_H": 0.5, "tau": 2.0}),
    "2(a), its hardness": ("n_H", (0.2, 0.5, 0.8), {"n_E": 1.5, "tau": 2.0}),
    "3, its thickness": ("tau", (2.0, 4.0, 6.0), {"n_E": 0.5, "n_H": 0.8}),
}
h = np.linspace(3.0, -3.0, 61)  # mean separation over sigma

figure, rows = plt.subplots(2, 3, figsize=(11, 6.5), sharex=True, sharey="row", layout="constrained")
for variant, row in zip(("published", "corrected"), rows, strict=True):
    for (title, (name, values, fixed)), axes in zip(FIGURES.items(), row, strict=True):
        coated = st.Indices(theta=40.0, lam=10.0, **fixed, **{name: st.axis(name, values)})
        for contact, look in ((coated, "-"), (st.Indices(theta=40.0, lam=10.0), "k--")):
            data = st.solve(contact, separation=h, variant=variant).where(lambda one: one["load"] > 1e-4)
            curves = [data.sel({name: value}) for value in values] if name in data.dims else [data]
            for one, value in zip(curves, values, strict=False):
                label = f"{name} = {value:g}" if name in data.dims else "no film"
                axes.loglog(one["load"], one["friction_coefficient"], look, label=label)
        axes.set_title(f"figure {title}\n{variant}", fontsize="medium")
        axes.grid(alpha=0.3)
        axes.legend(fontsize="small")
for axes in rows[1]:
    axes.set_xlabel(r"load over $NA_n\,KR^{1/2}\sigma^{3/2}$")
for axes in rows[:, 0]:
    axes.set_ylabel("static friction coefficient")
figure.savefig("paper_figures.png", dpi=120)
