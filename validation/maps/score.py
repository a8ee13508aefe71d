"""Score predictions of the contact area, with tau_0 known, on the maps of maps.py.

    python validation/maps/score.py

Each state of each map is predicted three times: with the map; by sigma, R and N with the kind of surface unknown; by them with
the kind stated. A row is kept for each: the solved area, the level of the predictive distribution there, and its quantiles.
"""

import csv
import json
from pathlib import Path

import numpy as np
from maps import FILE, POISSON, given, maps

import stiction as st
from stiction.surfaces.measured import MeasuredRoughness, measure

HERE = Path(__file__).parent
ROWS = HERE / "scored.csv"
QUANTILES = ("q5", "q25", "q50", "q75", "q95")
SOLVED = 0.005  # relative error of a solved area
KNOWN = ("map", "numbers", "kind")
_MODULUS, _TAU = 1e10, 1e3  # E* of the substrate; tau_0, far below any strength of a body
_ELASTIC, _RIGID = 1e6, 1e30


def contact_of(surface, roughness, state: dict, slope: float, shortest: float) -> st.Contact:
    """Return the contact of a rigid flat face and a body of this roughness, with the hardness and the film of a state."""
    strain, film = 1.0 - POISSON**2, state["film"]
    hardness = (state["hardness"] or _ELASTIC) * _MODULUS * slope
    soft = {"youngs_modulus": _MODULUS * strain, "poissons_ratio": POISSON, "hardness": hardness, "material_class": "polymer"}
    coating = None
    if film is not None:
        body = st.Material(**{**soft, "youngs_modulus": film[0] * _MODULUS * strain})
        coating = st.Coating(material=body, thickness=film[1] * shortest, bodies="first")
    rigid = {"youngs_modulus": _RIGID, "poissons_ratio": POISSON, "hardness": _RIGID, "material_class": "ceramic"}
    return st.Contact(
        first=soft, second=rigid, roughness=roughness, nominal_area=surface.size[0] * surface.size[1], coating=coating,
        interfacial_shear_strength=_TAU,
    )  # fmt: skip


def roughness_of(surface, kind: str, known: str):
    """Return the roughness of a map as it is known: the map itself, or numbers, with the kind or without."""
    found = measure(MeasuredRoughness(first=surface))
    if known == "map":
        return found.roughness()
    numbers = found.by_method["mccool"]
    stated = {"kind": kind} if known == "kind" else {}
    return st.Roughness(
        asperity_height_deviation=numbers.asperity_height_deviation, asperity_radius=numbers.asperity_radius,
        asperity_density=numbers.asperity_density, **stated,
    )  # fmt: skip


def scored() -> list[dict]:
    """Return a row for each map, state, load and way of knowing the surface."""
    solved, rows = json.loads(FILE.read_text()), []
    for name, (kind, one) in maps().items():
        surface, slope, shortest = given(one.made()), solved[name]["slope"], solved[name]["shortest"]
        for known in KNOWN:
            roughness = roughness_of(surface, kind, known)
            for state in solved[name]["states"]:
                contact = contact_of(surface, roughness, state, slope, shortest)
                loads = np.array(state["pressure"]) * _MODULUS * slope * contact.nominal_area
                found = st.predict(contact, load=loads)
                areas = found.friction_coefficient_samples.values * loads / _TAU / contact.nominal_area
                for at, area in enumerate(state["area"]):
                    rows.append(_row(name, kind, known, state, state["pressure"][at], area, areas[:, at]))
    return rows


def _row(name, kind, known, state, pressure, area, samples) -> dict:
    samples = samples[np.isfinite(samples)]
    quantiles = dict(zip(QUANTILES, np.quantile(samples, [float(name[1:]) / 100.0 for name in QUANTILES]), strict=True))
    numbers = {"pressure": pressure, "area": area, "level": np.mean(samples < area), **quantiles}
    film = "" if state["film"] is None else f"{state['film'][0]:g}"
    named = {"map": name, "kind": kind, "known": known, "hardness": state["hardness"] or "", "film": film}
    return named | {key: f"{value:.4g}" for key, value in numbers.items()}


def main() -> None:
    rows = scored()
    with ROWS.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for known in KNOWN:
        some = [row for row in rows if row["known"] == known]
        said(known, some)
        for name in sorted({_state(row) for row in some}):
            said(f"  {name}", [row for row in some if _state(row) == name])
        for kind in dict.fromkeys(row["kind"] for row in some):
            said(f"  {kind}", [row for row in some if row["kind"] == kind])


def _state(row: dict) -> str:
    return f"film {row['film']}" if row["film"] else f"hardness {row['hardness']}"


def held(row: dict, low: str, high: str) -> bool:
    """Return whether an interval holds the solved area, which is known within half a percent."""
    area = float(row["area"])
    return float(row[low]) <= area * (1.0 + SOLVED) and area * (1.0 - SOLVED) <= float(row[high])


def said(name: str, rows: list[dict]) -> None:
    """Print how often the intervals of 50 and 90 % hold the truth, and the median width."""
    width = np.array([float(row["q95"]) / float(row["q5"]) for row in rows])
    errors = np.log([float(row["q50"]) / float(row["area"]) for row in rows])
    half, most = (np.mean([held(row, *ends) for row in rows]) for ends in (("q25", "q75"), ("q5", "q95")))
    rms = np.sqrt(np.mean(errors**2))
    print(f"{name:16s} {len(rows):4d}  50 %: {half:.2f}  90 %: {most:.2f}  width {np.median(width):.3g}  rms {rms:.3f}")


if __name__ == "__main__":
    main()
