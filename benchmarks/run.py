"""Benchmarks: `make bench`. Peers run in the same process and minute, so ratios hold where absolute figures move.

Writes benchmarks/results.md and benchmarks/results.json, with machine and versions, appends a record to
benchmarks/history.jsonl (history.py), and says what got slower. Nothing here is a test.
"""

import json
import os
import platform
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

# One processor for everything that is called "per core".
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[name] = "1"

import history  # noqa: E402
import numpy as np  # noqa: E402
from loads import load_rows  # noqa: E402
from maps import map_rows  # noqa: E402
from peers import nodes_a_point, quad_loop, seconds_of_exponential  # noqa: E402
from processes import command_rows, peak_memory, start_rows  # noqa: E402
from rich.console import Console  # noqa: E402
from rich.progress import track  # noqa: E402
from scans import scan_rows  # noqa: E402
from sliding import held_rows, slide_rows  # noqa: E402

import stiction as st  # noqa: E402
from stiction.contact.indices import Groups, stiffness_group  # noqa: E402
from stiction.engine.heights import gaussian  # noqa: E402
from stiction.engine.summation import totals_on_grid  # noqa: E402
from stiction.records.registry import (  # noqa: E402
    JUNCTIONS,
    AsperityLaw,
    FilmLaw,
    RoughSurface,
    TangentialLaw,
    find,
    incompatibility,
    kinds_of_additions,
    of_kind,
)
from stiction.solving.choice import Choice  # noqa: E402
from stiction.solving.problem import problem_of  # noqa: E402

HERE = Path(__file__).parent
SEPARATIONS = np.linspace(-4.0, 4.0, 100)


def best(action: Callable, repeats: int = 5, clock: Callable[[], float] = time.thread_time) -> float:
    """Least seconds, of processor time of this thread, over some repeats after a first that is not counted."""
    action()
    times = []
    for _ in range(repeats):
        start = clock()
        action()
        times.append(clock() - start)
    return min(times)


def draw(count: int, seed: int = 1) -> dict[str, np.ndarray]:
    """Random laws over the range of the paper's interest."""
    rng = np.random.default_rng(seed)
    return {"theta": 10 ** rng.uniform(0, 3, count), "lam": 10 ** rng.uniform(-2, 3, count)}


def speed_of_quad() -> tuple[float, float]:
    """Evaluations per second of the loop above, and the largest difference from `evaluate` (area and friction)."""
    laws, count = draw(400), 400
    h = np.random.default_rng(2).uniform(-4, 4, count)
    values = np.array([quad_loop(*row) for row in zip(h, laws["theta"], laws["lam"], strict=False)])
    rate = count / best(lambda: [quad_loop(*row) for row in zip(h, laws["theta"], laws["lam"], strict=False)])
    ours = np.array(st.evaluate(h, **laws)).T
    return rate, float(np.max(np.abs(values[:, 1:] - ours[:, 1:]) / np.maximum(ours[:, 1:], 1e-12)))


def speed_scattered(**extra) -> float:
    count = 200_000
    laws, h = draw(count), np.random.default_rng(3).uniform(-6, 8, count)
    return count / best(lambda: st.evaluate(h, **laws, **extra))


def speed_on_grid(**extra) -> float:
    count = 10_000
    laws = {name: values[:, None] for name, values in draw(count).items()}
    return count * SEPARATIONS.size / best(lambda: st.evaluate(SEPARATIONS, **laws, **extra))


def exponentials_alone() -> dict[str, float]:
    """Evaluations per second if all that had to be done were the exponentials of a direct sum, by NumPy."""
    rng, each = np.random.default_rng(3), seconds_of_exponential()
    laws, nu = draw(20_000), np.full(20_000, 0.3)
    groups = Groups(**laws, nu=nu, hardness_to_yield=np.full(nu.size, 2.8), K_beta=stiffness_group(nu))
    regimes = problem_of(groups, Choice()).regimes
    ranges = {"scattered": (-6.0, 8.0), "grid": (SEPARATIONS[0], SEPARATIONS[-1])}
    return {name: 1.0 / float(each * nodes_a_point(regimes, rng.uniform(*ends, nu.size))) for name, ends in ranges.items()}


def elapsed_rates(points: int, *inputs, **laws) -> tuple[float, float]:
    """Evaluations per elapsed second with one thread and with two."""

    def rate(threads: int) -> float:
        return points / best(lambda: st.evaluate(*inputs, **laws, threads=threads), clock=time.perf_counter)

    return rate(1), rate(2)


def thread_rows() -> list[tuple[str, float]]:
    """One thread and two; only an otherwise idle machine shows what there is to gain."""
    count, rows = 40_000, []
    laws, h = draw(10 * count), np.random.default_rng(3).uniform(-6, 8, 10 * count)
    of_grid = {name: values[:count, None] for name, values in laws.items()}
    rates = {
        "scattered": elapsed_rates(h.size, h, **laws),
        "grid": elapsed_rates(count * SEPARATIONS.size, SEPARATIONS, **of_grid),
    }
    for name, (one, two) in rates.items():
        rows += [(f"{name}, 1 thread, evaluations per elapsed s", one), (f"{name}, 2 threads, the same", two)]
        rows += [(f"{name}, ratio of 2 threads to 1", two / one)]
    return rows


def groups_of_models(count: int, film: bool, choice: Choice) -> Groups:
    """Random contacts with every group that some model needs, and those that only laws which are chosen may be given."""
    rng, ones = np.random.default_rng(4), np.ones(count)
    nu, k = 0.3 * ones, 2.8 * ones
    coating = {}
    if film:
        coating = {
            "n_E": 10 ** rng.uniform(-1, 1, count),
            "n_H": 10 ** rng.uniform(-1, 0, count),
            "tau": rng.uniform(0, 8, count),
            "n_g": ones,
            "film_aspect": 0.5 * ones,
            "film_nu": nu,
            "film_K_beta": 6.4762 * ones,
        }
    others = {"tabor_parameter": 10 ** rng.uniform(-1, 1, count), "sharpness": 0.03 * ones, "roughness_parameter": 0.05 * ones}
    others |= {"nominal_width": 2e4 * ones, "shear_strength": 0.1 * ones, "pressure_coefficient": 0.05 * ones}
    others |= {"hardening": 0.01 * ones, "peeling": 0.3 * ones, "size_over_burgers": 1e3 * ones}
    if choice.beside.get("meniscus"):
        others |= {"meniscus_index": 10 ** rng.uniform(-2, 0, count), "meniscus_height": 10 ** rng.uniform(-2, 0, count)}
    if choice.beside.get("ageing"):
        others |= {"waiting": 1e3 * ones, "ageing_rate": 0.02 * ones}
    if choice.beside.get("contamination"):
        others |= {"strength_variation": 0.5 * ones}
    return Groups(**draw(count), nu=nu, hardness_to_yield=k, K_beta=6.4762 * ones, **coating, **others)


def speed_of_model(choice: Choice, film: bool) -> float:
    """Evaluations per second of any choice of laws on the grid, from its groups to load, area and resistance."""
    model = find(choice.model_key, RoughSurface)
    count = 4_000 if model.asperity else 40  # theories that are no sum take each law by itself
    groups = groups_of_models(count, film, choice)
    if model.asperity and not choice.beside.get("contamination"):  # whose variance is a sum of its own
        seconds = best(lambda: totals_on_grid(problem_of(groups, choice).regimes, SEPARATIONS, gaussian()), repeats=3)
    elif model.asperity or model.curve is not None:
        seconds = best(lambda: problem_of(groups, choice).on_grid(SEPARATIONS), repeats=3)
    else:
        load = np.tile(10 ** np.linspace(-6.0, 0.0, SEPARATIONS.size), (count, 1))
        seconds = best(lambda: problem_of(groups, choice).at_load(load), repeats=3)
    return count * SEPARATIONS.size / seconds


def designs_at_a_load(**film) -> float:
    """Contacts per second, each solved at one load, with its pull-off force."""
    count = 20_000
    contacts = st.Indices(theta=st.axis("theta", np.geomspace(1.0, 1e3, count)), lam=20.0, **film)
    return count / best(lambda: st.solve(contacts, load=0.01), repeats=3)


def model_choices() -> list[tuple[str, Choice, bool]]:
    """Every model by itself, on each branch; with films; and every other law in the place of a plain model's: name, choice and
    whether there is a film."""
    plain, taken, rows = "greenwood_williamson_1966", set(), []
    laws, shears, models = of_kind(AsperityLaw), of_kind(TangentialLaw), of_kind(RoughSurface)
    for record in models.values():
        if record.of_map is not None:  # solves the contact of a map: nothing to evaluate on a grid of separations
            continue
        taken |= {record.asperity, record.tangential}
        branches = laws[record.asperity].own_options.get("branch", ("",)) if record.asperity else ("",)
        choices = [Choice(record.key, options={"branch": one or None}) for one in branches]
        rows += [(f"{record.key} {one}".strip(), choice, record.on_film) for one, choice in zip(branches, choices, strict=True)]
        for value, film in record.film_by_option.items():
            name = next(name for name, values in record.own_options.items() if value in values)
            rows.append((f"{record.key}, {value}, {film} film", Choice(record.key, options={name: value}), True))
    rows += [(f"asperity law {key}", Choice(plain, asperity=key), False) for key in laws if key not in taken]
    for key, shear in shears.items():
        if key not in taken:
            suited = next(law.key for law in laws.values() if not incompatibility(shear, law))
            rows.append((f"tangential law {key} on {suited}", Choice(plain, suited, key), False))
    usual = models["soft_coating_2015"]
    interface = next(key for key, shear in shears.items() if shear.interfacial)
    for key, film in of_kind(FilmLaw).items():
        if not film.interchangeable:
            continue
        if key == usual.default_film or "2015" in film.required_traits:
            rows.append((f"{usual.key}, {key} film", Choice(usual.key, film=key), True))
        else:
            suited = next(law.key for law in laws.values() if not incompatibility(film, law))
            rows.append((f"{key} film, asperity law {suited}, {interface}", Choice(plain, suited, interface, key), True))
    return rows + added_choices(plain, interface)


def added_choices(plain: str, interface: str) -> list[tuple[str, Choice, bool]]:
    """What is added to a model: other laws for its plastic junctions, and menisci, time at rest and contamination to a plain
    one that shears its interface."""
    rows = [
        (f"{key}, plastic_junctions {junctions}", Choice(key, options={JUNCTIONS: junctions}), False)
        for key, model in of_kind(RoughSurface).items()
        if model.tangential != "none"
        for junctions in find(model.tangential, TangentialLaw).junctions
    ]
    rows += [
        (f"{name} {key}", Choice(plain, tangential=interface, beside={name: key}), False)
        for name, kind in kinds_of_additions().items()
        if name != "presliding"  # of the path to sliding, not of its end
        for key in of_kind(kind)
    ]
    return rows


def model_rows() -> list[tuple[str, float]]:
    rows = track(model_choices(), "models", console=Console(stderr=True))
    return [(name, speed_of_model(choice, film)) for name, choice, film in rows]


def comparison_rows() -> list[tuple[str, float]]:
    """Seconds of a full comparison, working load included, on a bare and on a coated contact, once kernels are loaded."""
    rows = []
    surface = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    steel = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2"}
    sheared = {"work_of_adhesion": "0.1 J/m^2", "interfacial_shear_strength": "200 MPa"}
    film = st.Coating(material="silver", thickness="200 nm", bodies="first")
    for name, coating in (("bare", None), ("coated", film)):
        contact = st.Contact(roughness=surface, coating=coating, **steel, **sheared)
        count = st.compare(contact, load="1 N").sizes["model"]
        seconds = best(lambda contact=contact: st.compare(contact, load="1 N"))
        rows.append((f"compare, {name}: {count} models, 80 separations and the working load, processor s", seconds))
    return rows


def prediction_rows() -> list[tuple[str, float]]:
    """Seconds of a prediction of 512 draws, which a move of a slider of the page takes, once kernels are loaded."""
    examples = {"the demo": "soft_film", "with adhesion": "silver_on_steel"}
    paths = {name: str(HERE.parent / "examples" / f"{stem}.toml") for name, stem in examples.items()}
    return [
        (f"prediction, {name}, processor s", best(lambda path=path: st.predict(path), repeats=3))
        for name, path in paths.items()
    ]


def machine() -> dict[str, str]:
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    name = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.processor())
    import numba
    import scipy

    versions = (
        f"Python {platform.python_version()}, numpy {np.__version__}, numba {numba.__version__}, scipy {scipy.__version__}"
    )
    return {
        "processor": name,
        "processors": str(os.cpu_count()),
        "system": platform.system(),
        "versions": versions,
        "stiction": st.__version__,
        "date": time.strftime("%Y-%m-%d"),
    }


FILM = {"n_E": 0.5, "n_H": 0.5, "tau": 3.0}


def peer_rows() -> list[tuple[str, float]]:
    """The bare corrected model scattered and on a grid, beside scipy.quad and NumPy's exponentials."""
    quad_rate, difference = speed_of_quad()
    scattered_rate, grid_rate, alone = speed_scattered(), speed_on_grid(), exponentials_alone()
    return [
        ("scipy.quad, clipped and split, evaluations/s", quad_rate),
        ("largest difference of that loop from evaluate (area, friction), relative", difference),
        ("scattered, bare corrected, evaluations/s", scattered_rate),
        ("scattered, ratio to scipy.quad", scattered_rate / quad_rate),
        ("the exponentials of that alone, by NumPy, evaluations/s", alone["scattered"]),
        ("scattered, ratio to NumPy's exponentials alone", scattered_rate / alone["scattered"]),
        ("grid of 100 separations, bare corrected, evaluations/s", grid_rate),
        ("grid, ratio to scipy.quad", grid_rate / quad_rate),
        ("the exponentials of every pair of that alone, by NumPy, evaluations/s", alone["grid"]),
        ("grid, ratio to NumPy's exponentials alone", grid_rate / alone["grid"]),
    ]


def other_rows() -> list[tuple[str, float]]:
    """Other readings and films, and designs at a load."""
    own_nu = np.random.default_rng(5).uniform(0, 0.499, 200_000)
    return [
        ("scattered, every input its own nu, evaluations/s", speed_scattered(nu=own_nu)),
        ("scattered, published, evaluations/s", speed_scattered(variant="published")),
        ("scattered, sequential film, evaluations/s", speed_scattered(**FILM)),
        ("grid, sequential film, evaluations/s", speed_on_grid(**FILM)),
        ("solved at one load each, bare corrected, contacts/s", designs_at_a_load()),
        ("solved at one load each, sequential film, contacts/s", designs_at_a_load(**FILM)),
    ]


def write(figures: list[tuple[str, float]]) -> None:
    about = machine()
    lines = [
        "# Benchmarks",
        "",
        "Made by `make bench`; processor time of one core, if not said. Absolute figures move with the machine, ratios hold.",
        "",
    ]
    lines += [f"- {name}: {value}" for name, value in about.items()]
    lines += ["", "| what | figure |", "|---|---|", *(f"| {name} | {value:.3g} |" for name, value in figures), ""]
    results, commit = {"machine": about, "figures": dict(figures)}, history.commit_of(HERE.parent)  # before files are written
    (HERE / "results.md").write_text("\n".join(lines))
    (HERE / "results.json").write_text(json.dumps(results, indent=2) + "\n")
    history.append(history.record(results, commit))
    print("\n".join(lines))
    print(history.told(history.read()))


def main() -> None:
    figures = peer_rows() + thread_rows() + other_rows()
    figures += [(f"grid: {name}, evaluations/s", rate) for name, rate in model_rows()]
    with tempfile.TemporaryDirectory() as folder:
        figures += (
            load_rows()
            + comparison_rows()
            + prediction_rows()
            + scan_rows(folder)
            + map_rows(folder)
            + held_rows()
            + slide_rows()
            + start_rows()
        )
        figures += command_rows(folder)
    write([*figures, ("10^7 scattered evaluations, peak memory, GB", peak_memory())])


if __name__ == "__main__":
    main()
