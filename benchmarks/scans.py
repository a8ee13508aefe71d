"""A map of 4096 x 4096 heights through all that is said of it, and a peer through the part that it has: fresh processes, their
elapsed time with all processors of the machine, and their peak memory."""

import os
import subprocess
import sys

POINTS, SIZE = 4096, 100e-6
_ENDING = """
import resource, time
before = time.perf_counter()
{work}
print(time.perf_counter() - before, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6)
"""
_MAKE = f"""
target = st.SelfAffine(hurst=0.8, rolloff={SIZE / 5.0}, shortest={4.0 * SIZE / POINTS}, deviation=50e-9)
np.save("map.npy", st.gaussian_surface(({POINTS}, {POINTS}), ({SIZE}, {SIZE}), target, seed=1).heights)
"""
_OURS = """
from stiction.surfaces.spectrum import power_spectrum, radial_average
from stiction.surfaces.statistics import statistics
surface = st.prepared(st.read_scan("map.npy", size="100 um", unit="m"))
said, spectrum = statistics(surface), radial_average(power_spectrum(surface))
"""
_LIBRARY = """
surface = Topography(np.load("map.npy").T, (100e-6, 100e-6), unit="m").detrend("height")
surface.Sq(), surface.rms_gradient(), surface.rms_laplacian()
surface.power_spectrum_from_area(window="hann")
"""


def _measured(folder: str, imports: str, work: str) -> tuple[float, float]:
    """Seconds and peak GB of a fresh process."""
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    code = imports + _ENDING.format(work=work)
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code], check=True, capture_output=True, text=True, cwd=folder, env=environment
    )
    seconds, memory = map(float, done.stdout.split())
    return seconds, memory


def scan_rows(folder: str) -> list[tuple[str, float]]:
    """Rows of the table of results."""
    # Made in a process of its own: a child's peak memory counts from that of its parent.
    _measured(folder, "import numpy as np\nimport stiction as st\n", _MAKE)
    whole = 'st.analyse(st.prepared(st.read_scan("map.npy", size="100 um", unit="m")))'
    imports = "import stiction as st\n"
    _measured(folder, imports, whole)  # kernels are compiled here, once per installation
    seconds, memory = _measured(folder, imports, whole)
    ours, _ = _measured(folder, imports, _OURS)
    library, library_memory = _measured(folder, "import numpy as np\nfrom SurfaceTopography import Topography\n", _LIBRARY)
    name = f"map of {POINTS} x {POINTS}"
    return [
        (f"{name}: read, level, statistics, spectrum, moments, five methods, elapsed s", seconds),
        (f"{name}: the same, peak memory, GB", memory),
        (f"{name}: read, level, statistics, spectrum, elapsed s", ours),
        (f"{name}: SurfaceTopography for level, Sq, slope, Laplacian, spectrum, elapsed s", library),
        (f"{name}: that, peak memory, GB", library_memory),
        (f"{name}: ratio of SurfaceTopography's time to ours", library / ours),
    ]
