"""Contact of maps solved point by point, and by Tamaas and ContactMechanics where they are: fresh processes, elapsed and
processor seconds, peak memory.

All stop at pressures that are known to about 2e-6 (the certificate's bound, of a map of 512 x 512 points): residual 1e-5 here,
Tamaas' error 1e-5, ContactMechanics' pentol 1e-8. STICTION_PEERS names the Python of an environment that has both; without it
that of this environment is taken, and rows of what it lacks are left out.
"""

import math
import os
import subprocess
import sys

PRESSURE = 0.05  # over modulus times rms gradient: a tenth of the map touches
SLOPE = 0.1
MAKE = f"""
import sys, numpy as np
import stiction as st
from stiction.surfaces.generate import with_slope
count = int(sys.argv[1])
target = st.SelfAffine(hurst=0.8, rolloff=1 / 8, shortest=8 / count, deviation=0.01)
surface = st.gaussian_surface((count, count), (1.0, 1.0), target, seed=1)
np.save(f"map{{count}}.npy", with_slope(surface, {SLOPE}).heights)
"""
TIMED = """
import math, resource, sys, time, numpy as np
heights, loads = np.load(f"map{sys.argv[1]}.npy"), [float(load) for load in sys.argv[2].split(",")]
count = len(heights)
{imports}
before, worked = time.perf_counter(), time.process_time()
{work}
print(time.perf_counter() - before, time.process_time() - worked, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6)
"""
_SOLVED_HERE = TIMED.replace(
    "{imports}",
    "from stiction.solvers.boundary_elements.compliance import Film\n"
    "from stiction.solvers.boundary_elements.solve import solve_map",
).replace("{work}", "solve_map(heights, (1.0, 1.0), loads=loads, periodic=True, keep_maps=False, {how})")
_PEERS = {
    "tamaas": TIMED.replace("{imports}", "import tamaas as tm\ntm.set_log_level(tm.LogLevel.error)").replace(
        "{work}",
        "model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [count, count])\n"
        "model.E, model.nu = 1.0, 0.0\n"
        "solver = tm.PolonskyKeerRey(model, heights, 1e-5)\n"
        "solver.max_iter = 3000\n"
        "[solver.solve(load) for load in loads]",
    ),
    "ContactMechanics": TIMED.replace(
        "{imports}",
        "from ContactMechanics import PeriodicFFTElasticHalfSpace\nfrom ContactMechanics.Factory import make_system\n"
        "from SurfaceTopography import Topography",
    ).replace(
        "{work}",
        "half_space = PeriodicFFTElasticHalfSpace((count, count), 1.0, physical_sizes=(1.0, 1.0))\n"
        "surface = Topography(heights, physical_sizes=(1.0, 1.0), periodic=True)\n"
        "system = make_system(substrate=half_space, surface=surface)\n"
        "[system.minimize_proxy(external_force=load, pentol=1e-8, maxiter=3000) for load in loads]",
    ),
}
_BODIES = {
    "elastic": "modulus=1.0",
    "with hardness": "modulus=1.0, hardness=0.05",
    "with a film": "modulus=math.inf, film=Film(0.02, 0.3, 0.4, 1.0, 0.3)",
}
_TEN = [SLOPE * 0.003 * 100.0 ** (step / 9.0) for step in range(10)]


def run_process(folder: str, python: str, code: str, *words: str) -> list[float] | None:
    """Return what a fresh process prints; None where it lacks a package."""
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    done = subprocess.run(
        [python, "-W", "ignore", "-c", code, *words], capture_output=True, text=True, cwd=folder, env=environment
    )
    if done.returncode and "ModuleNotFoundError" in done.stderr:
        return None
    done.check_returncode()
    return [float(word) for word in done.stdout.split()[-3:]]


def _timed(folder: str, name: str, python: str, code: str, count: int, loads: list[float]) -> list[tuple[str, float]]:
    measured = run_process(folder, python, code, str(count), ",".join(map(str, loads)))
    what = f"contact of {count} x {count} points, {len(loads)} load{'s' if len(loads) > 1 else ''}, {name}"
    units = ("elapsed s", "processor s", "peak memory, GB")
    return [] if measured is None else [(f"{what}, {unit}", value) for unit, value in zip(units, measured, strict=True)]


def map_rows(folder: str, sizes: tuple[int, ...] = (512, 1024, 2048, 4096)) -> list[tuple[str, float]]:
    """Rows of the table of results."""
    for count in sizes:
        run_process(folder, sys.executable, MAKE + "print(0, 0, 0)", str(count))
    one = [SLOPE * PRESSURE]
    elastic = {count: _timed(folder, "elastic", sys.executable, _ours("elastic"), count, one) for count in sizes[1:]}
    rows = [row for part in elastic.values() for row in part]
    for name in ("with hardness", "with a film"):
        rows += _timed(folder, name, sys.executable, _ours(name), sizes[-2], one)
    rows += _timed(folder, "elastic", sys.executable, _ours("elastic"), sizes[0], _TEN)
    rows += _peer_rows(folder, sizes[1], one, elastic[sizes[1]][1][1])
    first, last = (elastic[count][1][1] for count in (sizes[1], sizes[-1]))
    growth = math.log(last / first) / math.log((sizes[-1] / sizes[1]) ** 2)
    return [
        *rows,
        (f"contact of maps: power of the points with which processor s grow, {sizes[1]} to {sizes[-1]} a side", growth),
    ]


def _peer_rows(folder: str, count: int, loads: list[float], ours: float) -> list[tuple[str, float]]:
    """Rows of the peers that are there; ours: processor seconds of the same contact here.

    Not of larger maps: at 2048 points a side the peers need many minutes.
    """
    rows = []
    for name, code in _PEERS.items():
        measured = _timed(folder, name, os.environ.get("STICTION_PEERS", sys.executable), code, count, loads)
        rows += measured
        if measured:
            rows += [(f"contact of {count} x {count} points, ratio of {name}'s processor time to ours", measured[1][1] / ours)]
    return rows


def _ours(bodies: str) -> str:
    return _SOLVED_HERE.replace("{how}", _BODIES[bodies])


if __name__ == "__main__":
    import tempfile

    with tempfile.TemporaryDirectory() as own:
        for label, value in map_rows(own):
            print(f"{label}: {value:.3g}")
