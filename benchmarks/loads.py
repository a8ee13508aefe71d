"""Speed of finding separations under given loads, each beside scipy's quad and brentq in the same run.

`load_rows` is taken up by run.py; `python benchmarks/loads.py` prints it alone. Processor time of one core.
"""

import math
import os
import time

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402
import xarray  # noqa: E402
from scipy.integrate import quad  # noqa: E402
from scipy.optimize import brentq  # noqa: E402

import stiction as st  # noqa: E402
from stiction.records.registry import RoughSurface, find, of_kind  # noqa: E402
from stiction.solving.choice import Choice  # noqa: E402
from stiction.solving.inversion import separations_at  # noqa: E402
from stiction.solving.problem import make_problem  # noqa: E402


def best(action, repeats: int = 5) -> float:
    """Least seconds of processor time of this thread, over some repeats after a first that is not counted."""
    action()
    times = []
    for _ in range(repeats):
        start = time.thread_time()
        action()
        times.append(time.thread_time() - start)
    return min(times)


# Repeats after which loops over a hundred loads are compiled: Python runs them at first.
_UNTIL_COMPILED = 20


def designs(count: int, model: str = "soft_coating_2015", **film) -> st.Indices:
    """Random contacts over the range of the paper's interest; with all groups that some theory of the surface needs."""
    rng = np.random.default_rng(1)
    surface = {} if model == "soft_coating_2015" else {"roughness_parameter": rng.uniform(0.04, 0.06, count)}
    drawn = {"theta": 10 ** rng.uniform(0, 3, count), "lam": 10 ** rng.uniform(-2, 3, count)} | surface
    others = {"sharpness": 0.03, "nominal_width": 100.0, "tabor_parameter": 1.0} if surface else {}
    return st.Indices(**{name: xarray.DataArray(value, dims="contact") for name, value in drawn.items()}, **others, **film)


def speed_of_brentq(count: int = 12) -> float:
    """Contacts per second: one load each, by brentq on quad of the load alone, bare corrected."""
    rng = np.random.default_rng(1)
    laws = list(zip(10 ** rng.uniform(0, 3, count), 10 ** rng.uniform(-2, 3, count), strict=True))

    def load(h, theta, lam):
        S = math.sqrt(6.0 * math.pi / theta)
        eta = math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / math.sqrt(theta)
        first = (2.0 / 3.0 * S) ** (1.0 / 3.0)
        last = brentq(lambda u: u**3 - eta * u - S, first, 2.0 + 2.0 * S ** (1.0 / 3.0) + 2.0 * math.sqrt(eta))
        reach = math.sqrt(max(h, 0.0) ** 2 + 72.0) - h

        def dense(w):
            return math.exp(-((h + w) ** 2) / 2.0) / math.sqrt(2.0 * math.pi)

        def elastic(u):
            return (u**6 - S * u**3) * (4.0 * u**3 - 2.0 / 3.0 * S) * dense(u**4 - 2.0 / 3.0 * S * u)

        def plastic(w):
            return (2.0 * eta * w - 2.0 * math.pi / theta) * dense(w)

        onset = last**4 - 2.0 / 3.0 * S * last
        total = quad(elastic, first, min(last, (reach + 1.0) ** 0.25 + S), epsabs=0.0, epsrel=1e-10, limit=200)[0]
        return total + (quad(plastic, onset, reach, epsabs=0.0, epsrel=1e-10, limit=200)[0] if onset < reach else 0.0)

    start = time.thread_time()
    for theta, lam in laws:
        grid = np.linspace(6.0, -6.0, 13)  # the bracket: the first that carries more, inwards of the lowest
        loads = [load(h, theta, lam) for h in grid]
        lowest = int(np.argmin(loads))
        at = next(k for k in range(lowest, len(grid)) if loads[k] >= 0.01)
        brentq(lambda h, theta=theta, lam=lam: load(h, theta, lam) - 0.01, grid[at], grid[at - 1], xtol=1e-12)
    return count / (time.thread_time() - start)


def one_load_each(count: int = 20_000, **film) -> tuple[float, float]:
    """Contacts per second at one load each: by st.solve, pull-off force included, and by its core, separations and sums."""
    contacts = designs(count, **film)
    load = 10 ** np.random.default_rng(2).uniform(-6, -2, count)
    asked = xarray.DataArray(load, dims="contact")

    def core():
        problem = make_problem(contacts, Choice())
        return problem.at(separations_at(problem, load[:, None]).h)

    return count / best(lambda: st.solve(contacts, load=asked), 3), count / best(core, 3)


def many_loads(count: int, contacts: int = 1) -> tuple[float, float]:
    """Points per second with many loads on each contact: by st.solve, and the separations alone."""
    some, loads = designs(contacts), np.geomspace(1e-6, 0.01, count)
    problem, targets = make_problem(some, Choice()), np.tile(loads, (contacts, 1))
    whole = best(lambda: st.solve(some, load=loads), _UNTIL_COMPILED)
    return contacts * count / whole, contacts * count / best(lambda: separations_at(problem, targets))


def many_loads_on_bodies(count: int, kept: bool) -> float:
    """Points per second with many loads on one contact of bodies, by st.solve, with errors near the contact up to 25 loads.

    kept: whether the contact was solved before, so that its problem is prepared.
    """
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    steel = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "interfacial_shear_strength": "200 MPa"}
    contact, loads = st.Contact(roughness=rough, nominal_area="1 mm^2", **steel), np.geomspace(1e-3, 10.0, count)

    def solve():
        return st.solve(contact if kept else contact.replace(), load=loads, model="greenwood_williamson_1966")

    return count / best(solve, _UNTIL_COMPILED)


def theory_at_loads(key: str, count: int = 4_000) -> float:
    """Contacts per second of a theory in closed form, each with its own surface and load."""
    film = {"n_E": 0.5, "n_H": 0.5, "tau": 3.0, "film_aspect": 0.5} if find(key, RoughSurface).on_film else {}
    contacts, rng = designs(count, key, **film), np.random.default_rng(3)
    load = xarray.DataArray(10 ** rng.uniform(-6, -1, count), dims="contact")
    return count / best(lambda: st.solve(contacts, load=load, model=key), 2)


def theories() -> list[str]:
    """Those in closed form: no sum over asperities, and no map that is solved."""
    return [key for key, one in of_kind(RoughSurface).items() if not one.asperity and one.of_map is None]


def load_rows() -> list[tuple[str, float]]:
    peer = speed_of_brentq()
    found = [("one load each by scipy's brentq on quad, the load alone, contacts/s", peer)]
    for name, film in (("bare corrected", {}), ("sequential film", {"n_E": 0.5, "n_H": 0.5, "tau": 3.0})):
        whole, core = one_load_each(**film)
        found += [(f"one load each, {name}, st.solve, contacts/s", whole), (f"one load each, {name}, core, contacts/s", core)]
        if not film:
            found.append(("one load each, bare corrected, core, ratio to scipy's", core / peer))
    for loads, contacts in ((100, 1), (1000, 1), (10_000, 1), (100, 200)):
        whole, alone = many_loads(loads, contacts)
        where = f"{loads} loads on {contacts} contact{'s' if contacts > 1 else ''}"
        found += [(f"{where}, st.solve, points/s", whole), (f"{where}, separations, points/s", alone)]
    for loads in (100, 10_000):
        where = f"{loads} loads on one contact of steel, greenwood_williamson_1966, st.solve"
        found += [(f"{where}, points/s", many_loads_on_bodies(loads, kept=True))]
        found += [(f"{where}, a new contact each time, points/s", many_loads_on_bodies(loads, kept=False))]
    return found + [(f"{key} at one load each, contacts/s", theory_at_loads(key)) for key in theories()]


if __name__ == "__main__":
    for name, figure in load_rows():
        print(f"{figure:10.3g}  {name}", flush=True)
