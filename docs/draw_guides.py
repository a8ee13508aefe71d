"""Draw the pictures of the landing page and of the one-page guides into docs/pictures/.

python docs/draw_guides.py
"""

import tomllib
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from measured_tables import measured_series

import stiction as st
from stiction.case.read import case_of
from stiction.report.prediction_pictures import prediction_figure, validation_panel
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.operators import FreeShear
from stiction.solvers.shear.path import Weakening, full_shift, slide_map
from stiction.studies.prediction.around import predict_with_curve

HERE = Path(__file__).parent
BLUE, RED, GREY = "#0072B2", "#D55E00", "0.45"


def answer() -> Figure:
    """Return friction against load of the contact that the README and the landing page predict."""
    case = (HERE.parent / "README.md").read_text(encoding="utf-8").split("```toml\n")[1].partition("```")[0]
    data, curve = predict_with_curve(case_of(tomllib.loads(case)))
    figure = prediction_figure(data, "Copper on copper, oxidised, ground", curve)
    figure.axes[0].lines[0].set_linewidth(4)
    return figure


def interfaces() -> Figure:
    """Return the 90 % range of the shear strength of every state, where the softer body has H = 1 GPa and G = 40 GPa."""
    scale = {"interfacial_shear_strength": 1.0, "shear_strength": 1e9, "strength_over_shear_modulus": 40e9}
    rows = []
    for row in st.interfaces():
        strength = row["strength"]
        values = (strength["value"], *strength["range"])
        rows.append((row["name"], *(value * scale[strength["quantity"]] / 1e6 for value in values)))
    rows.sort(key=lambda row: row[1])
    figure, axes = plt.subplots(figsize=(7.2, 4.6), layout="constrained")
    for at, (_, median, low, high) in enumerate(rows):
        axes.plot([low, high], [at, at], color=BLUE, linewidth=7, alpha=0.35, solid_capstyle="butt")
        axes.plot(median, at, "o", color=BLUE)
        axes.text(high * 1.15, at, f"{median:.3g} MPa", va="center", fontsize=9, color=GREY)
    axes.set_yticks(range(len(rows)), [row[0] for row in rows])
    axes.set(xscale="log", xlim=(0.1, 2000), xlabel="shear strength [MPa] and 90 % range (softer body: H = 1 GPa)")
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def roughness() -> Figure:
    """Return a profile with its asperities, and what sigma, R and N are on it."""
    rng = np.random.default_rng(8)
    x = np.linspace(0.0, 40.0, 1600)
    waves = np.arange(3, 15)
    z = sum(rng.normal() * np.cos(2 * np.pi * q * x / 40 + rng.uniform(0, 7)) / q**1.2 for q in waves)
    z *= 48.0 / z.std()
    tops = np.flatnonzero((z[1:-1] > z[:-2]) & (z[1:-1] > z[2:])) + 1
    tops = tops[(x[tops] > 1) & (x[tops] < 39)]
    figure, axes = plt.subplots(figsize=(7.2, 3.4), layout="constrained")
    axes.fill_between(x, z, -190, color="0.85")
    axes.plot(x, z, color="black", linewidth=1.5)
    axes.plot(x[tops], z[tops], "o", color=RED, markersize=5)
    mean, deviation = z[tops].mean(), z[tops].std()
    axes.axhspan(mean - deviation, mean + deviation, color=BLUE, alpha=0.15)
    axes.axhline(mean, color=BLUE, linewidth=1)
    axes.text(40.4, mean, "mean of the\nasperity heights\n± σ", color=BLUE, va="center", fontsize=10)
    top = tops[np.argmax(z[tops])]
    bend = -np.gradient(np.gradient(z, x), x)[top]
    near = np.abs(x - x[top]) < 1.3
    axes.plot(x[near], z[top] - bend * (x[near] - x[top]) ** 2 / 2, color=RED, linewidth=3)
    axes.annotate("R: radius of the tops", (x[top], z[top]), (x[top] + 2.2, z[top] + 45), color=RED, fontsize=10,
                  arrowprops={"arrowstyle": "-", "color": RED})  # fmt: skip
    axes.text(0.3, -182, f"N: asperities per area (red dots: {tops.size} along this line)", fontsize=10)
    axes.set(xlim=(0, 40), ylim=(-190, z.max() + 75), xlabel="position [µm]", ylabel="height [nm]")
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def models() -> Figure:
    """Return the decision which model to ask, as a chart."""
    figure, axes = plt.subplots(figsize=(7.2, 4.4), layout="constrained")
    axes.set(xlim=(0, 10), ylim=(0, 6.2))
    axes.axis("off")
    rows = [
        ("You want mu and how sure it is", "name no model:\nthe prediction"),
        ("You have a scan, and time", "boundary_elements:\nthe map point by point"),
        ("You compare with a published paper", "the key of that paper,\nas kogut_etsion_2004"),
        ("You have a million contacts", "stiction sweep, or st.evaluate"),
        ("You want to see every model", "stiction compare --all"),
    ]
    for at, (question, reply) in enumerate(rows):
        y = 5.6 - 1.2 * at
        first = at == 0
        box = {
            "boxstyle": "round,pad=0.45",
            "facecolor": "#e3f0f8" if first else "white",
            "edgecolor": BLUE if first else "0.6",
        }
        axes.text(
            2.35, y, question, ha="center", va="center", fontsize=10.5, bbox={**box, "facecolor": "0.95", "edgecolor": "0.8"}
        )
        axes.annotate("", (5.5, y), (4.75, y), arrowprops={"arrowstyle": "->", "color": GREY})
        axes.text(7.6, y, reply, ha="center", va="center", fontsize=10.5, bbox=box, weight="bold" if first else "normal")
    return figure


def enlarged(length: float) -> st.Contact:
    """Return one period of a rough surface of this length [m], with slopes that do not depend on it."""
    waves = st.SelfAffine(0.8, length / 4, length / 16, 2e-3 * length)
    return st.Contact(
        first="hardened_steel_52100", second="silicon_nitride", nominal_area=length**2, interfacial_shear_strength="300 MPa",
        roughness=st.gaussian_surface((128, 128), (length, length), waves, seed=1),
    )  # fmt: skip


def onset() -> Figure:
    """Return force against displacement at three loads, and friction against the size of the surface, on maps."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained")
    loss = {"model": "boundary_elements", "residual_strength": 0.3, "weakening_slip": "3 nm"}
    for milli, color in ((1, BLUE), (10, RED), (40, GREY)):
        moved = st.slide(enlarged(10e-6), load=f"{milli} mN", **loss)
        share = moved["tangential_force"] / moved["friction_force"]
        left.plot(moved["displacement"] * 1e9, share, color=color, label=f"{milli} mN")
    left.set(xlabel="displacement (nm)", ylabel="force over sum of strengths", ylim=(0.0, 1.05))
    left.legend(title="load", frameon=False)
    lengths = np.geomspace(1e-6, 30e-6, 8)
    for residual, color in ((0.3, RED), (0.7, BLUE)):
        found = [st.slide(enlarged(one), load=1e8 * one**2, **loss | {"residual_strength": residual}) for one in lengths]
        mu = [float(one["largest_friction_coefficient"]) for one in found]
        right.semilogx(lengths * 1e6, mu, "o-", color=color, label=f"residual strength {residual:.0%}")
    right.axhline(float(found[0]["friction_coefficient"]), color=GREY, linestyle="--", label="sum of strengths")
    right.set(xlabel="length of the surface (µm)", ylabel="static friction coefficient", ylim=(0.0, 0.09))
    right.legend(frameon=False)
    return figure


def scales() -> Figure:
    """Return friction against the size of a contact, as predicted, and against the load on a rough sphere, as solved."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained")
    lengths = np.geomspace(1e-6, 1e-2, 13)
    rough = {"asperity_height_deviation": "20 nm", "asperity_radius": "2 um", "asperity_density": "1e12 1/m^2"}
    pair = {"first": "hardened_steel_52100", "second": "silicon_nitride", "interfacial_shear_strength": "300 MPa"}
    for slip, color in (("1 nm", RED), ("10 nm", BLUE), ("100 nm", GREY)):
        contacts = [
            st.Contact(roughness=rough, nominal_area=one**2, weakening_slip=slip, residual_strength=0.5, **pair)
            for one in lengths
        ]
        found = [st.predict(one, load=1e8 * one.nominal_area) for one in contacts]
        left.semilogx(lengths * 1e3, [float(one.friction_efficiency) for one in found], "o-", color=color, label=slip)
    left.set(xlabel="side of the contact (mm)", ylabel="friction over sum of strengths", ylim=(0.0, 1.05))
    left.legend(title="weakening slip", frameon=False)
    loads = np.geomspace(1e-3, 1.0, 7)
    for slip, color in ((20e-9, RED), (60e-9, BLUE)):
        drop = [share / 0.5 for share in sphere_shares(loads, slip, residual=0.5)]
        right.semilogx(loads, drop, "o-", color=color, label=f"{slip * 1e9:.0f} nm")
    right.set(xlabel="load on a rough sphere (N)", ylabel="static over sliding friction", ylim=(0.9, 2.05))
    right.legend(title="weakening slip", frameon=False)
    return figure


def sphere_shares(loads: np.ndarray, slip: float, residual: float) -> list[float]:
    """Return friction over the sum of strengths of a rough silicon sphere of 0.25 mm on silicon, at loads [N].

    slip [m]: over which the strength of 1 GPa falls to its residual part.
    """
    count, side, body = 160, 40e-6, HalfSpace(160e9, 0.22)
    x = ((np.arange(count) + 0.5) / count - 0.5) * side
    waves = st.SelfAffine(0.8, side / 10, side / 32, 20e-9)
    heights = st.gaussian_surface((count, count), (side, side), waves, seed=1).heights
    heights = heights - (x[None, :] ** 2 + x[:, None] ** 2) / (2.0 * 0.25e-3)
    modulus = body.modulus / (2.0 * (1.0 - body.poisson**2))
    solved = solve_map(heights, (side, side), modulus=modulus, loads=loads, periodic=False, free=True, stiffness=False)
    operator = FreeShear(ShearCompliance((body, body)), heights.shape, (side, side))
    shares = []
    for one in solved:
        strength = 1e9 * (one.pressure > 0.0)
        shifts = np.linspace(0.0, full_shift(operator, strength), 31)[1:]
        path = slide_map(operator, strength, shifts, pixel=(side / count) ** 2, weakening=Weakening(slip, residual))
        shares.append(path.efficiency)
    return shares


def measured() -> Figure:
    """Return the prediction beside every measured series of validation/."""
    series = measured_series()
    figure, panels = plt.subplots(1, len(series), figsize=(4.8 * len(series), 4.2), layout="constrained")
    for axes, data in zip(panels, series, strict=True):
        validation_panel(axes, data)
    return figure


if __name__ == "__main__":
    matplotlib.rcParams["svg.hashsalt"] = "stiction"  # the same picture, the same file
    for draw in (answer, interfaces, roughness, models, measured, onset, scales):
        draw().savefig(HERE / "pictures" / f"{draw.__name__}.svg", metadata={"Date": None})
