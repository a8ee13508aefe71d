"""Score predictions of the contact area, with tau_0 known, on a set of maps of maps.py.

    python validation/maps/score.py fifth     # writes scored-fifth.csv, and prints what docs/calibration.md has as tables

Each state of each map is predicted six times: with the map; by sigma, R and N alone; by them with the kind of surface, with
Ssk, Sku and Str of the map, and with both; by Sq and the finish, the map stretched to a slope and height drawn from what that
finish leaves open. A row is kept for each: the solved area, the level of the predictive distribution there, and its quantiles.
"""

import csv
import json
import sys
import zlib
from pathlib import Path

import numpy as np
from maps import POISSON, SIDE, SLOPE, Map, maps, solved_file

import stiction as st
from stiction.surfaces.areal_parameters import areal_parameters
from stiction.surfaces.finishes import finish
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.measured import MeasuredRoughness, measure
from stiction.surfaces.statistics import statistics

HERE = Path(__file__).parent
QUANTILES = ("q5", "q25", "q50", "q75", "q95")
ROUNDING = 0.001  # of a solved area, relative
CERTAIN = 0.02  # width of a 90 % interval that is no wider than what solved areas are known to
KNOWN = ("map", "kind and shape", "shape", "kind", "numbers", "finish")
FINISHES = {
    "gaussian": ("polished", "lapped", "blasted", "wafer"), "skewed": ("as deposited",), "worn": ("worn",),
    "lay": ("ground", "turned", "milled"),
}  # fmt: skip
_MODULUS, _TAU = 1e10, 1e3  # E* of the rough body; tau_0, far below any strength of a body
_ELASTIC, _RIGID = 1e6, 1e30


def contact_of(roughness, hardness, film, stretch: tuple[float, float]) -> st.Contact:
    """Return the contact of a rigid flat face and a body of this roughness, with the hardness and the film of a state.

    stretch: factors of lengths along and across the plane by which the solved map is stretched.
    """
    slope, strain = SLOPE * stretch[1] / stretch[0], 1.0 - POISSON**2
    soft = {
        "youngs_modulus": _MODULUS * strain, "poissons_ratio": POISSON, "hardness": (hardness or _ELASTIC) * _MODULUS * slope,
        "material_class": "polymer",
    }  # fmt: skip
    coating = None
    if film is not None:
        of_film = {"youngs_modulus": film.modulus * _MODULUS * (1.0 - film.poisson**2), "poissons_ratio": film.poisson}
        coating = st.Coating(material=st.Material(**(soft | of_film)), thickness=film.thickness * stretch[0], bodies="first")
    rigid = {"youngs_modulus": _RIGID, "poissons_ratio": POISSON, "hardness": _RIGID, "material_class": "ceramic"}
    return st.Contact(
        first=soft, second=rigid, roughness=roughness, nominal_area=(SIDE * stretch[0]) ** 2, coating=coating,
        interfacial_shear_strength=_TAU,
    )  # fmt: skip


def surface_of(one: Map) -> HeightMap:
    """Return the map that a prediction is given."""
    return HeightMap(one.given, (SIDE, SIDE), periodic=True)


def roughness_of(name: str, one: Map, known: str):
    """Return the roughness of a map as it is known, and how the map is stretched; None where it has no finish."""
    surface = surface_of(one)
    found = measure(MeasuredRoughness(first=surface))
    if known == "map":
        return found.roughness(), (1.0, 1.0)
    if known == "finish":
        return _finished(name, one, surface)
    numbers = found.by_method["mccool"]
    stated = {"kind": one.kind} if known.startswith("kind") else {}
    stated |= _shape_of(surface) if known.endswith("shape") else {}
    return st.Roughness(
        asperity_height_deviation=numbers.asperity_height_deviation, asperity_radius=numbers.asperity_radius,
        asperity_density=numbers.asperity_density, **stated,
    ), (1.0, 1.0)  # fmt: skip


def _shape_of(surface: HeightMap) -> dict[str, float]:
    """Return the statistics that a user would state, those that the map determines."""
    of_heights = statistics(surface)
    found = {"skewness": of_heights.Ssk, "kurtosis": of_heights.Sku, "texture_aspect_ratio": areal_parameters(surface).Str}
    return {key: value for key, value in found.items() if value is not None}


def _finished(name: str, one: Map, surface: HeightMap):
    if one.kind not in FINISHES:
        return None
    rng = np.random.default_rng(zlib.crc32(name.encode()))
    made = finish(str(rng.choice(FINISHES[one.kind])))
    height, slope = (float(made.quantile(number, rng.uniform())) for number in ("rms_height", "rms_slope"))
    upwards = height / float(surface.heights.std())
    return {"finish": made.name, "rms_height": height}, (upwards * SLOPE / slope, upwards)


def scored(name: str) -> list[dict]:
    """Return a row for each map, state, load and way of knowing the surface."""
    solved, rows = json.loads(solved_file(name).read_text()), []
    for key, one in maps(name):
        for known in KNOWN:
            given = roughness_of(key, one, known)
            if given is None:
                continue
            for (hardness, film, pressures), areas in zip(one.states, solved[key]["areas"], strict=True):
                contact = contact_of(given[0], hardness, film, given[1])
                slope = SLOPE * given[1][1] / given[1][0]
                loads = np.array(pressures) * _MODULUS * slope * contact.nominal_area
                found = st.predict(contact, load=loads)
                shares = found.friction_coefficient_samples.values * loads / _TAU / contact.nominal_area
                state = {"map": key, "kind": one.kind, "known": known, "state": _state(hardness, film)}
                rows += [_row(state, *each) for each in zip(pressures, areas, shares.T, strict=True)]
    return rows


def _state(hardness, film) -> str:
    if film is not None:
        return "soft film" if film.modulus < 1.0 else "stiff film"
    return "elastic" if hardness is None else "plastic"


def _row(state: dict, pressure: float, area: float, samples: np.ndarray) -> dict:
    samples = samples[np.isfinite(samples)]
    quantiles = dict(zip(QUANTILES, np.quantile(samples, [float(name[1:]) / 100.0 for name in QUANTILES]), strict=True))
    numbers = {"pressure": pressure, "area": area, "level": np.mean(samples < area), **quantiles}
    return state | {key: f"{value:.5g}" for key, value in numbers.items()}


def scored_file(name: str) -> Path:
    """Return the file of the scores of a set."""
    return HERE / f"scored-{name}.csv"


def read_scored(name: str) -> list[dict[str, str]]:
    """Return the rows of a set that was scored."""
    with scored_file(name).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def held(row: dict, low: str, high: str) -> bool:
    """Return whether an interval holds the solved area."""
    area = float(row["area"])
    return float(row[low]) <= area * (1.0 + ROUNDING) and area * (1.0 - ROUNDING) <= float(row[high])


def width(row: dict) -> float:
    """Return the ratio of the ends of the 90 % interval."""
    return float(row["q95"]) / float(row["q5"])


def open_rows(rows: list[dict]) -> list[dict]:
    """Return the rows where something is left to predict: not those where all flows and the area is load over hardness."""
    return [row for row in rows if width(row) > 1.0 + CERTAIN]


def coverage(rows: list[dict]) -> tuple[float, float, float, float]:
    """Return how often the intervals of 50 and 90 % hold the truth, the median width, and the rms error of ln of the area."""
    half, most = (float(np.mean([held(row, *ends) for row in rows])) for ends in (("q25", "q75"), ("q5", "q95")))
    errors = np.log([float(row["q50"]) / float(row["area"]) for row in rows])
    return half, most, float(np.median([width(row) for row in rows])), float(np.sqrt(np.mean(errors**2)))


def main(name: str) -> None:
    rows = scored(name)
    with scored_file(name).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for known in KNOWN:
        some = [row for row in rows if row["known"] == known]
        _said(known, some)
        for column in ("state", "kind"):
            for value in dict.fromkeys(row[column] for row in some):
                _said(f"  {value}", [row for row in some if row[column] == value])


def _said(name: str, rows: list[dict]) -> None:
    for which, some in (("", rows), (" (open)", open_rows(rows))):
        if some:
            half, most, wide, rms = coverage(some)
            print(f"{name + which:22s} {len(some):4d}  50 %: {half:.2f}  90 %: {most:.2f}  width {wide:.3g}  rms {rms:.3f}")


if __name__ == "__main__":
    main(sys.argv[1])
