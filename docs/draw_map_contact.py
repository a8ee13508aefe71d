"""Draws friction of one map against load, solved point by point and by the models.

    python docs/draw_map_contact.py                                     # a made map: docs/explanation/boundary-elements.png
    python docs/draw_map_contact.py SCAN --size "20 um" --out mu.png    # any scan that stiction reads, by every model

Of the made map also against the cutoff. The bodies are steel on silicon nitride with an interface of 300 MPa; a scan is
levelled, its missing points are filled, and shorter waves than `--shortest` are taken out.
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import stiction as st
from stiction.solving.choice import Choice
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import prepared
from stiction.surfaces.statistics import statistics

SOLVED = "boundary_elements"
MODELS = ("greenwood_williamson_1966", "zhao_maietta_chang_2000", "jackson_green_2005", "persson_2001_elastoplastic")
LENGTH = 20e-6


def made() -> HeightMap:
    """A Gaussian map, 8 points in its shortest waves and 8 of its longest on a side."""
    return st.gaussian_surface((256, 256), (LENGTH, LENGTH), st.SelfAffine(0.8, LENGTH / 8, LENGTH / 32, 30e-9), seed=1)


def contact_of(surface: HeightMap) -> st.Contact:
    """Steel on silicon nitride."""
    return st.Contact(
        first="hardened_steel_52100", second="silicon_nitride", roughness=surface,
        interfacial_shear_strength="300 MPa", nominal_area="1 mm^2",
    )  # fmt: skip


def loads_of(contact: st.Contact) -> np.ndarray:
    """Eight, up to a tenth of the hardness on the nominal area."""
    most = 0.1 * min(contact.first.hardness, contact.second.hardness) * contact.nominal_area
    return np.geomspace(0.01, 1.0, 8) * most


def draw(surface: HeightMap, out: Path) -> None:
    """Both panels, as a picture."""
    contact = contact_of(surface)
    loads = loads_of(contact)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 4.2), layout="constrained")
    for model in MODELS:
        data = st.solve(contact, load=loads, model=model)
        (line,) = left.plot(loads, data["friction_coefficient"], label=model)
        low, high = (data.get(f"friction_coefficient_{end}") for end in ("low", "high"))
        if low is not None:
            left.fill_between(loads, low, high, color=line.get_color(), alpha=0.15, linewidth=0.0)
    left.plot(loads, st.solve(contact, load=loads, model=SOLVED)["friction_coefficient"], "ko-", label=SOLVED)
    left.set(xscale="log", xlabel="net normal load [N]", ylabel="friction coefficient", ylim=(0.0, None))
    left.legend(fontsize="small")
    for model, look in ((SOLVED, "ko-"), ("persson_2001_elastoplastic", "s--")):
        choice = Choice(model, tangential="bowden_tabor_1943")
        study = st.resolution_study(surface, methods=["mccool"], contact=contact, load=float(loads[4]), choice=choice)
        there = study["cutoff"].values > 0.0
        right.plot(study["cutoff"].values[there] * 1e6, study["mu"].values[0][there], look, label=model)
    right.set(xscale="log", xlabel="shortest wavelength left [µm]", ylabel=f"friction coefficient at {loads[4]:.3g} N")
    right.legend(fontsize="small")
    figure.savefig(out, dpi=110)


def draw_all(surface: HeightMap, words: str, out: Path) -> None:
    """Every model on a scan, in one panel; what is drawn and found stands above and below it."""
    contact = contact_of(surface)
    load = float(loads_of(contact)[4])
    data = st.compare(contact, load=load)
    recommended = "boundary_elements"
    figure, axes = plt.subplots(figsize=(10.0, 6.0), layout="constrained")
    falling = np.argsort(-np.nan_to_num(data["friction_coefficient_at_load"].values))
    for at, name in enumerate(data["model"].values[falling]):
        one = data.sel(model=name)
        look = {"color": f"C{at % 10}", "linestyle": ("-", "--", ":")[at // 10], "linewidth": 1.0, "zorder": 2}
        if name == recommended:
            look.update(color="tab:orange", linestyle="-", linewidth=7.0, alpha=0.5, zorder=1)
        if name == SOLVED:
            look.update(color="black", linestyle="-", marker="o", zorder=3)
        mu = float(one["friction_coefficient_at_load"])
        there = (one["load"] > 0.0) & (one["friction_coefficient"] > 0.0)
        kind = " (the map itself)" * (name == SOLVED)
        outside = " *" if str(one["outside_validity"].values) else ""
        axes.plot(
            one["load"].where(there), one["friction_coefficient"].where(there), label=f"{mu:.3g}  {name}{kind}{outside}", **look
        )
    axes.axvline(load, color="grey", linewidth=0.8, linestyle="--")
    solved = data.sel(model=SOLVED)["load"]
    axes.set(xscale="log", yscale="log", xlabel="net normal load [N]", ylabel="static friction coefficient")
    axes.set_xlim(float(solved.min()) / 1.5, float(solved.max()) * 1.5)
    axes.set_title(f"{words}\nsteel on silicon nitride, 1 mm$^2$, interface of 300 MPa", fontsize="medium")
    mu = data["friction_coefficient_at_load"]
    low, high = float(mu.where(mu > 0.0).min()), float(mu.max())
    axes.set_ylim(0.5 * low, 3.0 * high)
    figure.legend(
        loc="outside right upper",
        fontsize="small",
        title=f"mu at {load:.3g} N: {low:.3g} to {high:.3g}\n* outside its validity there",
    )
    validity_warnings = str(data.sel(model=SOLVED)["outside_validity"].values)
    if validity_warnings:
        figure.supxlabel("* the map itself: " + validity_warnings.replace("; ", "\n"), fontsize="small", x=0.01, ha="left")
    figure.savefig(out, dpi=110)


def described(surface: HeightMap, shortest: str | None) -> str:
    """A scan in a line: its name, and what was left of it."""
    found = statistics(surface)
    rows, columns = surface.heights.shape
    size = " x ".join(f"{side * 1e6:.3g} µm" for side in surface.size)
    kept = f", waves from {shortest}" if shortest else ""
    heights = f"Sq {found.Sq * 1e9:.3g} nm, slope {found.slope:.3g}"
    return f"{Path(surface.name).name}: {rows} x {columns} points, {size}{kept}; {heights}"


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("scan", nargs="?", help="a scan; left out, a map is made")
    words.add_argument("--size", help='along x, e.g. "20 um", in place of what the file says')
    words.add_argument("--unit", help="of the numbers in the file")
    words.add_argument("--shortest", help='waves that are kept of a scan, from here, e.g. "400 nm"')
    words.add_argument("--form", type=int, default=1, help="order of the polynomial taken off a scan, 1")
    words.add_argument("--out", type=Path, default=Path(__file__).parent / "explanation" / "boundary-elements.png")
    given = words.parse_args()
    if not given.scan:
        draw(made(), given.out)
        return
    scan = st.read_scan(given.scan, size=given.size, unit=given.unit)
    surface = prepared(scan, form=given.form, fill="harmonic", shortest=given.shortest)
    draw_all(surface, described(surface, given.shortest), given.out)


if __name__ == "__main__":
    main()
