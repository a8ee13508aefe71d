"""Whether the 95 % intervals of `stiction fit` hold the truth as often as they say.

    python benchmarks/fit_coverage.py [--sets 400] [--seed 1] [--unknown]

Synthetic series: friction of a rough, adhesive contact (Fuller & Tabor's surface with a sheared interface) at 20 loads, with
Gaussian noise of 3 % of each value, of which the errors are stated, or with --unknown a noise of one size that is not stated.
The strength of the interface is well determined, the work of adhesion badly: within a factor of ten or so. Every series is
fitted, and how often the interval holds the value that made it is counted.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

from stiction.studies.fit.answer import fitted
from stiction.studies.fit.model import forward_model
from stiction.studies.fit.plan import make_fit_plan

CASE = {
    "contact": {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "work_of_adhesion": "50 mJ/m^2",
        "interfacial_shear_strength": "200 MPa",
        "nominal_area": "1 mm^2",
        "roughness": {"asperity_height_deviation": "20 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
    },
    "solve": {"load": "1 N", "model": "fuller_tabor_1975"},
    "fit": {
        "free": {
            "interfacial_shear_strength": {"low": "10 MPa", "high": "2 GPa"},
            "work_of_adhesion": {"low": "0.1 mJ/m^2", "high": "1 J/m^2"},
        }
    },
}
TRUTH = {"interfacial_shear_strength": 200e6, "work_of_adhesion": 50e-3}
LOADS = np.geomspace(1e-3, 1.0, 20)
NOISE = 0.03


def coverage(sets: int, seed: int, unknown: bool = False, say=lambda done, held: None) -> dict[str, np.ndarray]:
    """Of each free number whether the interval of each series holds the truth (sets,), and the intervals (sets, 2)."""
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        exact = _exact(Path(folder))
        held: dict[str, list] = {name: [] for name in TRUTH}
        ends: dict[str, list] = {name: [] for name in TRUTH}
        for at in range(sets):
            noise = NOISE * (np.full(len(exact), exact.mean()) if unknown else exact)
            values = exact + noise * rng.standard_normal(len(exact))
            one = fitted("", forward_model(_plan(Path(folder), values, None if unknown else noise)))
            for parameter, profile in zip(one.parameters, one.profiles, strict=True):
                low, high = (float(parameter.at(end)) for end in (profile.low, profile.high))
                ends[parameter.name].append((low, high))
                held[parameter.name].append(low <= TRUTH[parameter.name] <= high)
            say(at + 1, held)
    return {name: np.array(held[name]) for name in TRUTH} | {f"{name} ends": np.array(ends[name]) for name in TRUTH}


def _exact(folder: Path) -> np.ndarray:
    forward = forward_model(_plan(folder, np.full(len(LOADS), 0.3), np.full(len(LOADS), 0.01)))
    positions = [float(one.share(TRUTH[one.name])) for one in forward.parameters]
    return forward.values(np.array(positions))[0]


def _plan(folder: Path, values: np.ndarray, errors: np.ndarray | None):
    rows = [[f"{load:.17g}", f"{value:.17g}"] for load, value in zip(LOADS, values, strict=True)]
    heads = ["load [N]", "friction_coefficient"]
    if errors is not None:
        heads.append("friction_coefficient_error")
        rows = [[*row, f"{error:.17g}"] for row, error in zip(rows, errors, strict=True)]
    path = folder / "measured.csv"
    path.write_text("\n".join(map(",".join, [heads, *rows])) + "\n", encoding="utf-8")
    return make_fit_plan(CASE, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=400)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--unknown", action="store_true")
    given = parser.parse_args()

    def say(done: int, held: dict) -> None:
        if done % 20 == 0:
            shares = ", ".join(f"{name} {np.mean(hits):.3f}" for name, hits in held.items())
            print(f"{done} of {given.sets}: {shares}", file=sys.stderr, flush=True)

    found = coverage(given.sets, given.seed, given.unknown, say)
    for name in TRUTH:
        ratio = found[f"{name} ends"][:, 1] / found[f"{name} ends"][:, 0]
        held = f"{found[name].mean():.2%} of {given.sets} intervals hold the truth"
        print(f"{name}: {held}; high over low {np.median(ratio):.3g} (median)")


if __name__ == "__main__":
    main()
