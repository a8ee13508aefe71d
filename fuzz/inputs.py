"""Try inputs that are no case files: states of the page, measured tables, scans, arguments, and solutions solved again.

Each function takes a source of chance and a folder, and yields what fails: an error that is no InputError of one line, or a
wrong number.
"""

import inspect
import io
import math
import multiprocessing
import os
import random
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache
from multiprocessing.connection import Connection
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from generate import case_of

import stiction as st
from stiction.case.measurements import read_measurements
from stiction.engine.tiers import VARIABLE, tier
from stiction.quantities.errors import InputError
from stiction.solving.candidates import candidates
from stiction.web.address import decoded, encoded
from stiction.web.fields import example_cases, first_case
from stiction.web.query import Query, read_query

_CELLS = ("", "nan", "-1", "0", "1e400", "x", '"', "1,5", "1 N", "\x00", "9" * 400, "=1+1", "<script>")
_ARGUMENTS: tuple[Any, ...] = (
    None, True, -1, 0, 1.5, math.nan, math.inf, 10**400, "", "x", "1 nm", b"x", [], {}, (), [1, "2"], {1: 2}, object(), len,
    np.zeros((0,)), np.zeros((2, 0, 3)), np.array([1.0, math.nan]), np.array("x"), np.ones((2, 3, 4)), 1j, {"load": {"a": []}},
)  # fmt: skip
_CALLS_APART = ("sweep", "fit", "cite", "export", "write_report", "axis")  # write files, or take what has no bad value
_CLOSES, _AGREES = 1e-10, 1e-12
_ROUNDED = 1e-14  # of a sum, for each sigma of the separation: coordinates of nodes that deep are rounded (numerics.md)
_SPECIALISED = 0.2  # of the contacts: such loops take a second to compile for each law


def refused_or_fine(where: str, work: Callable[[], object]) -> Iterator[str]:
    """Run something; yield its error unless that is an InputError of one line."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            work()
    except InputError as error:
        if len(str(error).splitlines()) != 1:
            yield f"{where}: not one line of error: {str(error)[:300]!r}"
    except Exception as error:
        frame = inspect.trace()[-1]
        yield f"{where}: {type(error).__name__}: {error} ({frame.filename}, line {frame.lineno})"[:500]


def page_states(chance: random.Random, folder: Path) -> Iterator[str]:
    """Read a state of the page, as it was encoded or damaged."""
    tables = case_of(chance.randrange(2**31))
    try:
        state = encoded(tables)
    except Exception:  # what TOML cannot say
        return
    for text in (state, _damaged(chance, state.encode()).decode("latin-1")):
        yield from refused_or_fine(f"state {text[:60]}", lambda text=text: read_query(Query(decoded(text))))


def measured_tables(chance: random.Random, folder: Path) -> Iterator[str]:
    """Read a table of measurements with other column names, cells and bytes."""
    names = ["load [mN]", "friction_coefficient", "friction_coefficient_error", "sample", "coating.thickness [nm]", "note"]
    names = chance.sample([*names, "contact_area [mm^2]", "load", "x [parsnip]", ""], chance.randint(1, 6))
    rows = [[chance.choice((*_CELLS, "1", "2", "3")) if chance.random() < 0.3 else "0.5" for _ in names] for _ in range(4)]
    between = chance.choice(",;\t")
    text = "\n".join(between.join(row) for row in [names, *rows]).encode()
    path = folder / "measured.csv"
    path.write_bytes(_damaged(chance, text) if chance.random() < 0.5 else text)
    tables = chance.choice(list(example_cases().values()))
    yield from refused_or_fine(f"measured {text[:200]!r}", lambda: read_measurements(path, tables))


def scans(chance: random.Random, folder: Path) -> Iterator[str]:
    """Read and analyse a scan that is cut short or changed, by its right name or another."""
    ending, content = chance.choice(_scans(chance))
    changed = _damaged(chance, content) if chance.random() < 0.8 else content
    path = folder / f"scan{ending if chance.random() < 0.9 else chance.choice(('.npy', '.csv', '.sur', '.xyz', '.opd', ''))}"
    path.write_bytes(changed)
    stated = chance.choice(({}, {"size": "10 um", "unit": "um"}, {"size": "10 um", "height_unit": "nm"}, {"size": "-1 um"}))

    def work() -> None:
        surface = st.read_scan(path, **stated)
        st.asperities(st.prepared(surface, form=chance.choice((0, 1, 2))))

    yield from refused_or_fine(f"scan {path.name} {changed[:80]!r}", work)


def _scans(chance: random.Random) -> list[tuple[str, bytes]]:
    """Return small scans as the ending of a file name and its content."""
    heights = np.random.default_rng(chance.randrange(2**31)).normal(0.0, 1e-8, (chance.randint(2, 24), chance.randint(2, 24)))
    array, archive, table = io.BytesIO(), io.BytesIO(), io.StringIO()
    np.save(array, heights)
    np.savez(archive, heights=heights, size=np.array([1e-5, 1e-5]))
    np.savetxt(table, heights * 1e9, delimiter=",", fmt="%.4g")
    points = "\n".join(f"{x} {y} {height:.4g}" for (y, x), height in np.ndenumerate(heights * 1e6))
    text = table.getvalue()
    return [
        (".npy", array.getvalue()), (".npz", archive.getvalue()), (".csv", text.encode()), (".xyz", points.encode()),
        (".txt", f"# Width: 10 um\n# Height: 10 um\n# Value units: nm\n{text.replace(',', ' ')}".encode()),
    ]  # fmt: skip


def calls(chance: random.Random, folder: Path) -> Iterator[str]:
    """Call a public function with arguments of wrong types, values and shapes."""
    name = chance.choice([name for name in st.__all__ if callable(getattr(st, name)) and name not in _CALLS_APART])
    function = getattr(st, name)
    if inspect.isclass(function) and issubclass(function, Exception):
        return
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return
    right = {"case": first_case(), "contact": _indices(chance), "indices": _indices(chance), "load": 1e-3, "h": 1.0}
    right |= {
        "theta": 10.0,
        "lam": 5.0,
        "surface": st.HeightMap(np.random.default_rng(1).normal(0, 1e-8, (8, 8)), (1e-5, 1e-5)),
    }
    given = {}
    for parameter in parameters:
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD) or parameter.name in ("threads", "progress"):
            continue
        if parameter.name in right and chance.random() < 0.7:
            given[parameter.name] = right[parameter.name]
        elif parameter.default is parameter.empty or chance.random() < 0.2:
            given[parameter.name] = chance.choice(_ARGUMENTS)
    positional = [p.name for p in parameters if p.kind == p.POSITIONAL_ONLY and p.name in given]
    yield from refused_or_fine(
        f"st.{name}({', '.join(f'{key}={value!r}'[:60] for key, value in given.items())})",
        lambda: function(*[given.pop(key) for key in positional], **given),
    )


def solved_again(chance: random.Random, folder: Path) -> Iterator[str]:
    """Solve at loads, and at the separations that were found: both must agree, and area must rise with load."""
    solvable = _solvable(chance)
    if solvable is None:
        return
    subject, model, loads, found = solvable
    where = f"{model} at {loads}"
    yield from _faults(found, where)
    if "mean_separation" not in found or found["mean_separation"].dims != ("load",):
        return
    if not np.isfinite(found["mean_separation"]).all():
        return
    again: list[Any] = []
    yield from refused_or_fine(
        where, lambda: again.append(st.solve(subject, separation=found["mean_separation"].values, model=model))
    )
    for other in again:
        yield from (
            f"{where}: {fault} at the separations that were found" for fault in _differences(subject, found, other, _CLOSES)
        )


def other_means(chance: random.Random, folder: Path) -> Iterator[str]:
    """Solve in plain Python, in compiled loops, with eight threads and in another process: all must agree."""
    solvable = _solvable(chance)
    if solvable is None:
        return
    subject, model, loads, _ = solvable
    means = {"compiled": ("shared", 1), "with eight threads": ("shared", 8)}
    if chance.random() < _SPECIALISED:
        means["in specialised loops"] = ("specialised", 1)
    found: list[Any] = []
    try:
        for loops, threads in (("interpreted", 1), *means.values()):
            with _loops(loops):
                found.append(_solved_quietly(subject, model, loads, threads))
        _other_process().send((subject, model, loads))
        found.append(_other_process().recv())
    except Exception as error:
        yield f"{model} at {loads}: {type(error).__name__} by one means only: {error}"
        return
    rounding = _rounding(subject, model, found[0])
    for words, other in zip([*means, "in another process"], found[1:], strict=True):
        yield from (
            f"{model} at {loads}: {fault} {words}" for fault in _differences(subject, found[0], other, _AGREES, rounding)
        )


def _rounding(subject: Any, model: str, found: Any) -> dict[str, np.ndarray]:
    """Return by how much results change with the last digits of the separation: a load cannot be met more closely."""
    if "mean_separation" not in found or found["mean_separation"].dims != ("load",):
        return {}
    separation = found["mean_separation"].values
    with suppress(InputError, ArithmeticError), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        near = st.solve(subject, separation=separation + 1e-14 * np.abs(separation).max(), model=model)
        return {
            name: np.abs(near[name].values - found[name].values) for name in ("contact_area", "friction_force") if name in near
        }
    return {}


@contextmanager
def _loops(wanted: str) -> Iterator[None]:
    """Within the context, sum by these loops."""
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = wanted
    tier.cache_clear()
    try:
        yield
    finally:
        os.environ.pop(VARIABLE) if before is None else os.environ.update({VARIABLE: before})
        tier.cache_clear()


@cache
def _other_process() -> Connection:
    """Return the connection to a process that solves what it is sent, and ends with this one."""
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    context.Process(target=_solve_what_is_sent, args=(there,), daemon=True).start()
    there.close()
    return here


def _solve_what_is_sent(requests: Connection) -> None:
    with suppress(EOFError):
        while True:
            requests.send(_solved_quietly(*requests.recv()))


def _solved_quietly(subject: Any, model: str, loads: np.ndarray, threads: int = 1) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return st.solve(subject, load=loads, model=model, threads=threads)


def _solvable(chance: random.Random) -> tuple[Any, str, np.ndarray, Any] | None:
    """Return a random contact, a model, loads of 1 pN to 1 GN and their solution; None where 20 draws were all refused."""
    for _ in range(20):
        subject = _contact(chance) if chance.random() < 0.6 else _indices(chance)
        model = chance.choice([one.name for one in candidates(subject)])
        unit = 1.0 if isinstance(subject, st.Contact) else 1e-6
        middle = chance.uniform(-11.0, 8.0)
        loads = unit * 10.0 ** np.sort(np.array([middle + chance.uniform(-1.0, 1.0) for _ in range(4)]))
        with suppress(InputError, ArithmeticError), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return subject, model, loads, st.solve(subject, load=loads, model=model)
    return None


def _differences(
    subject: Any, found: Any, other: Any, tolerance: float, rounding: Mapping[str, np.ndarray] = MappingProxyType({})
) -> Iterator[str]:
    """Yield the results of two solutions that differ by more than a tolerance, as a fraction, and what rounding does."""
    pull_off = float(found.get("pull_off_force", 0.0))  # loads far below it are a difference of large numbers
    if "mean_separation" in found:
        tolerance += _ROUNDED * float(np.abs(found["mean_separation"]).max() / subject.scales().separation)
    for name, least in (("load", pull_off), ("contact_area", 0.0), ("friction_force", 0.0)):
        if name in found and name in other:
            before, after = found[name].values, other[name].values
            over = np.maximum(np.abs(before), max(least, 1e-300))
            allowed = tolerance + rounding.get(name, 0.0) / over
            if not np.isclose(before / over, after / over, rtol=0.0, atol=allowed, equal_nan=True).all():
                yield f"{name} {before} differs by {np.nanmax(np.abs(after - before) / over):.1e} of it"


def _faults(found: Any, where: str) -> Iterator[str]:
    """Yield areas that are negative or fall with load, and coefficients of friction that are negative."""
    area = found["contact_area"].values
    if (area < 0.0).any() or (np.diff(area) < -1e-9 * area[1:]).any():
        yield f"{where}: contact area {area} is negative or falls"
    if "friction_coefficient" in found and (found["friction_coefficient"].values < 0.0).any():
        yield f"{where}: a negative coefficient of friction"


def _indices(chance: random.Random) -> st.Indices:
    return st.Indices(theta=10 ** chance.uniform(-1, 6), lam=10 ** chance.uniform(-2, 6))


def _contact(chance: random.Random) -> Any:
    """Return a contact of gels of 1 kPa to diamond, half of them with a film of 0.3 nm to 1 mm."""

    def body(least: float) -> dict[str, float]:
        modulus = 10.0 ** chance.uniform(least, 12.0)
        return {
            "youngs_modulus": modulus,
            "poissons_ratio": chance.uniform(0.0, 0.49),
            "hardness": modulus * 10 ** chance.uniform(-3, -1),
        }

    sigma = 10.0 ** chance.uniform(-10, -5)
    given: dict[str, Any] = {"first": body(3.0), "second": body(3.0), "nominal_area": 10.0 ** chance.uniform(-12, -2)}
    radius = sigma * 10.0 ** chance.uniform(1, 5)
    rough = {
        "asperity_height_deviation": sigma,
        "asperity_radius": radius,
        "asperity_density": 10.0 ** chance.uniform(-2, -0.5) / (sigma * radius),
    }
    given |= {"roughness": rough, "interfacial_shear_strength": 10.0 ** chance.uniform(2, 9)}
    if chance.random() < 0.5:
        given["work_of_adhesion"] = 10.0 ** chance.uniform(-4, 0.5)
    if chance.random() < 0.5:
        given["coating"] = {"material": body(3.0), "thickness": 10.0 ** chance.uniform(-9.5, -3)}
    try:
        return st.Contact(**given)
    except InputError:
        return _indices(chance)


def _damaged(chance: random.Random, content: bytes) -> bytes:
    """Return content that is cut short, or has other bytes, bytes more or bytes less."""
    changed = bytearray(content)
    for _ in range(chance.randint(1, 4)):
        place = chance.randrange(len(changed) + 1)
        kind = chance.random()
        if kind < 0.3:
            del changed[place:]
        elif kind < 0.6 and place < len(changed):
            changed[place] = chance.randrange(256)
        elif kind < 0.8:
            changed[place:place] = bytes(chance.randrange(256) for _ in range(chance.randint(1, 8)))
        else:
            del changed[place : place + chance.randint(1, 8)]
    return bytes(changed)


TARGETS = (page_states, measured_tables, scans, calls, solved_again, other_means)
