"""Draw the pictures of docs/explanation/which-film-law.md: film laws on a sphere on a film, beside the exact solution.

python truth/draw_film_laws.py
"""

import math
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from film_laws import LAWS, NU, asperity
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.sphere import respond

DOCS = Path(__file__).parents[1] / "docs" / "explanation"
MODULI, RATIO = (0.1, 2.0, 10.0), 1e-3  # thickness over radius
WIDTHS = np.geomspace(0.05, 20.0, 60)
LOOKS = {
    ("sequential", ""): {"color": "C0"},
    ("graded", ""): {"color": "C1"},
    ("halling_1979", "modulus perriot_barthel_2004"): {"color": "C2"},
    ("halling_1979", "modulus bec_2006"): {"color": "C4"},
    ("ogilvy_1993", ""): {"color": "C5"},
    ("finkin_1969", "bound compressible"): {"color": "C6", "linestyle": ":"},
    ("layered", ""): {"color": "C3", "linewidth": 2.2},
}


def label(law: tuple[str, str]) -> str:
    return " ".join([law[0], *law[1].split(" ")[1:]])


def curves(n_E: float) -> dict[tuple[str, str], tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Law -> its own modulus 3PR/(4a^3) over that of the body, and area and load over the exact ones, at WIDTHS."""
    aspect, exact = math.sqrt(RATIO), [respond((Layer.of(1.0, n_E, NU, NU),), width) for width in WIDTHS]
    x = (WIDTHS * aspect) ** 2
    pressed = n_E * np.array([one.load for one in exact]) * x**1.5
    approach = np.array([one.approach for one in exact]) * x
    w = np.geomspace(1e-6, 1e5, 6000) * RATIO
    found = {("exact", ""): (pressed / x**1.5, np.ones_like(x), np.ones_like(x))}
    for law in LOOKS:
        load, area = asperity(LAWS[law], n_E, aspect, 1.0, w)
        grows = np.maximum.accumulate(np.maximum(load, 1e-300))
        there = np.exp(np.interp(np.log(pressed), np.log(grows), np.log(np.maximum(area, 1e-300))))
        of_width = np.exp(np.interp(np.log(x), np.log(np.maximum(np.maximum.accumulate(area), 1e-300)), np.log(grows)))
        found[law] = (of_width / x**1.5, there / x, np.interp(approach, w, load) / pressed)
    return found


def draw(axes: Axes, found: dict, quantity: int) -> None:
    for law, look in LOOKS.items():
        axes.plot(WIDTHS, found[law][quantity], label=label(law), **look)
    if quantity == 0:
        axes.plot(WIDTHS[::4], found["exact", ""][0][::4], "ko", markersize=4, label="exact sphere")
    axes.set(xscale="log", yscale="log", ylim=(None if quantity == 0 else 0.08, None if quantity == 0 else 12.0))
    axes.grid(visible=True, linewidth=0.3)


def main() -> None:
    matplotlib.rcParams.update({"svg.hashsalt": "films", "svg.fonttype": "none", "path.simplify_threshold": 0.5})
    every = {n_E: curves(n_E) for n_E in MODULI}
    moduli = Figure(figsize=(12, 4.4), layout="constrained")
    for axes, n_E in zip(moduli.subplots(1, len(MODULI)), MODULI, strict=True):
        draw(axes, every[n_E], 0)
        ends = 0.5 * min(n_E, 1.0), 2.0 * max(n_E, 1.0)
        axes.set(title=f"E_f/E_s = {n_E:g}", xlabel="contact radius a over thickness t", ylim=ends)
        if n_E == MODULI[0]:
            axes.set_ylabel("modulus 3PR/(4a^3) over the body's")
            axes.legend(fontsize=7)
    errors = Figure(figsize=(12, 7.2), layout="constrained")
    grid = errors.subplots(2, len(MODULI), sharex=True, sharey=True)
    for column, n_E in enumerate(MODULI):
        for row, name in enumerate(("area at given load", "load at given approach")):
            draw(grid[row, column], every[n_E], row + 1)
            if not column:
                grid[row, 0].set_ylabel(f"{name}, over the exact one")
        grid[0, column].set_title(f"E_f/E_s = {n_E:g}")
        grid[1, column].set_xlabel("contact radius a over thickness t")
    grid[0, 0].legend(fontsize=7)
    for name, figure in (("film_moduli", moduli), ("film_errors", errors)):
        figure.savefig(DOCS / f"{name}.svg", metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main()
