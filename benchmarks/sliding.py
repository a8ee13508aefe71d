"""A map moved aside until it slides, with strength that falls with slip: a fresh process, both processors, peak memory.

Also a map under half its friction force, as Tamaas solves it too where it is (see `maps`). Tamaas has the associated law, in
which slip opens the gap, so that only times are compared.
"""

import os
import subprocess
import sys
import tempfile

from maps import MAKE, TIMED, run_process

POINTS = 512
_CODE = """
import resource, time
import numpy as np
import stiction as st
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.operators import PeriodicShear
from stiction.solvers.shear.path import Weakening, full_shift, slide_map, weakening_length

waves = st.SelfAffine(hurst=0.8, rolloff=1 / 8, shortest=32 / {points}, deviation=1e-3)
surface = st.gaussian_surface(({points}, {points}), (1.0, 1.0), waves, seed=1)
(one,) = solve_map(surface.heights, surface.size, modulus=1.0, loads=[0.002], periodic=True, stiffness=False)
strength, body = (one.pressure > 0.0).astype(float), HalfSpace(2.6, 0.3)
operator = PeriodicShear(ShearCompliance((body, body)), strength.shape, surface.size)
weakening = Weakening(6 / {points} / weakening_length(operator, 1.0, Weakening(1.0)))
shifts = np.linspace(0.0, full_shift(operator, strength), 31)[1:]
before = time.perf_counter(), time.process_time()
path = slide_map(operator, strength, shifts, pixel=1.0, weakening=weakening)
assert all(state.converged for state in path.states)
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
print(time.perf_counter() - before[0], time.process_time() - before[1], memory)
"""


def slide_rows(points: int = POINTS) -> list[tuple[str, float]]:
    """Rows of the table of results: 30 displacements to sliding, strength lost over six points."""
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    command = [sys.executable, "-c", _CODE.format(points=points)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
    elapsed, processor, memory = map(float, done.stdout.split())
    name = f"map of {points} x {points} moved aside until it slides, 30 displacements"
    return [(f"{name}, elapsed s", elapsed), (f"{name}, processor s", processor), (f"{name}, peak memory, GB", memory)]


_HELD = {
    "here": TIMED.replace(
        "{imports}",
        "from stiction.solvers.boundary_elements.solve import solve_map\n"
        "from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance\n"
        "from stiction.solvers.shear.operators import PeriodicShear\n"
        "from stiction.solvers.shear.path import at_force",
    ).replace(
        "{work}",
        "(one,) = solve_map(heights, (1.0, 1.0), modulus=1.0, loads=loads, periodic=True, stiffness=False)\n"
        "bodies = HalfSpace(0.5, 0.0), HalfSpace(1e9, 0.0)\n"
        "operator = PeriodicShear(ShearCompliance(bodies), heights.shape, (1.0, 1.0))\n"
        "at_force(operator, 0.3 * one.pressure, 0.15 * loads[0], pixel=1.0 / count**2)",
    ),
    "Tamaas (associated law, Condat)": TIMED.replace(
        "{imports}", "import tamaas as tm\ntm.set_log_level(tm.LogLevel.error)"
    ).replace(
        "{work}",
        "model = tm.Model(tm.model_type.surface_2d, [1.0, 1.0], [count, count])\n"
        "model.E, model.nu = 1.0, 0.0\n"
        "solver = tm.Condat(model, heights, 1e-6, 0.3)\n"
        "solver.max_iter = 3000\n"
        "solver.solve([0.15 * loads[0], 0.0, loads[0]])",
    ),
}


def held_rows(points: int = 128) -> list[tuple[str, float]]:
    """Rows of the table of results: a map held by half of its friction force, mu = 0.3."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        run_process(folder, sys.executable, MAKE + "print(0, 0, 0)", str(points))
        for name, code in _HELD.items():
            python = sys.executable if name == "here" else os.environ.get("STICTION_PEERS", sys.executable)
            measured = run_process(folder, python, code, str(points), "0.005")
            if measured is not None:
                rows.append((f"map of {points} x {points} held by half of its friction, {name}, processor s", measured[1]))
    return rows


if __name__ == "__main__":
    for row in [*held_rows(), *slide_rows(int(sys.argv[1]) if sys.argv[1:] else POINTS)]:
        print(*row)
