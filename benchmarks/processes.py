"""Benchmark rows of fresh processes: processor time until the first answer, and peak memory."""

import os
import resource
import subprocess
import sys
from pathlib import Path

SOLVE = (
    "import stiction as st; "
    "rough = st.Roughness(asperity_height_deviation='48 nm', asperity_radius='50 um', asperity_density='1.7e10 1/m^2'); "
    "steel = st.Contact(first='hardened_steel_52100', second='hardened_steel_52100', roughness=rough, nominal_area='1 mm^2'); "
    "st.solve(steel, load='1 N', model='greenwood_williamson_1966', tangential='none')"
)


def processor_seconds(*command: str, repeats: int = 5, **environment: str) -> float:
    """Least processor time of a fresh process."""
    times = []
    for _ in range(repeats):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        surroundings = {**os.environ, **environment}
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=surroundings)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


def peak_memory() -> float:
    """GB at most in a fresh process that evaluates 10^7 scattered inputs."""
    code = (
        "import numpy as np, resource, stiction as st\n"
        "rng = np.random.default_rng(0); n = 10**7\n"
        "st.evaluate(rng.uniform(-4, 4, n), 10**rng.uniform(0, 3, n), 10**rng.uniform(-2, 3, n))\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return int(done.stdout) / 1e6


def start_rows() -> list[tuple[str, float]]:
    """What a fresh process takes until the first answer, beside what it cannot do without."""
    programs = {
        "interpreter": "pass",
        "import numba": "import numba",
        "import xarray": "import xarray",
        "import stiction": "import stiction",
        "st.solve of one contact, kernels cached": SOLVE,
    }
    return [
        (f"fresh process: {name}, processor s", processor_seconds(sys.executable, "-c", code))
        for name, code in programs.items()
    ]


def command_rows(folder: str) -> list[tuple[str, float]]:
    """The command line in fresh processes."""
    command, examples = str(Path(sys.executable).with_name("stiction")), Path(__file__).parents[1] / "examples"
    case = str(examples / "silver_on_steel.toml")
    run = command, "run", case
    demo = command, "run", str(examples / "soft_film.toml")
    cold = [
        (
            f"stiction {name}, empty cache, processor s",
            processor_seconds(*words, repeats=1, STICTION_CACHE_DIR=f"{folder}/{at}"),
        )
        for at, (name, words) in enumerate({"run of the demo": demo, "run": run}.items())
    ]
    return [
        *cold,
        ("stiction run of the demo, fresh process, kernels cached, processor s", processor_seconds(*demo)),
        ("stiction --help, processor s", processor_seconds(command, "--help")),
        ("stiction run, fresh process, kernels cached, processor s", processor_seconds(*run)),
        ("stiction run --out, fresh process, processor s", processor_seconds(*run, "--out", folder + "/out")),
    ]
