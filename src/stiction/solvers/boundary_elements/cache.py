"""Store solutions of map contacts in a cache on disk, and read them again.

There is one file for each load. Its name is a hash of the inputs and of the solver's code, so an interrupted series of loads
continues where it stopped. When the cache is full, the least recently used files are deleted.
"""

import ast
import hashlib
import json
import os
from collections.abc import Sequence
from dataclasses import fields
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from stiction.quantities.cache import cache_folder, keep_file
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.map_warnings import warnings_of_map
from stiction.solvers.boundary_elements.solve import MapContact, MapContacts, checked, solve_map

_MOST = 1_000_000_000  # bytes of all files
_TOO_LARGE = 200_000_000  # bytes; a contact with a larger pressure map is not stored
_OF_FILE = ("pressure", "validity_warnings")  # fields of a contact that are not numbers


def solve_cached(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, loads: Sequence[float], periodic: bool, **how
) -> MapContacts:
    """Solve a map like `solve_map`, but read the contacts at loads solved before from the cache on disk.

    heights: (rows, columns) [m]. size: (y, x) [m]. modulus [Pa], loads [N], periodic, how: as in `solve_map`, with the same
    results and errors. A cached solution may have been started from another pressure; it agrees within the tolerance.
    """
    loads = [float(load) for load in np.atleast_1d(np.asarray(loads, dtype=float))]
    checked(heights, size, loads, periodic, how)  # bad arguments must raise even if all loads are in the cache
    inputs = {name: value for name, value in how.items() if name not in ("progress", "done")}
    name = _name(heights, size, modulus=modulus, periodic=periodic, **inputs)
    solved_before: dict[float, MapContact] = {}
    for load in loads:
        if load not in solved_before and (contact := _read(_file(name, load), np.shape(heights))) is not None:
            solved_before[load] = contact
    missing = [load for load in dict.fromkeys(loads) if load not in solved_before]
    if not missing:
        of_map = warnings_of_map(np.asarray(heights, dtype=float), size, how.get("film") or how.get("counter_film"), periodic)
        return MapContacts(tuple(solved_before[load] for load in loads), of_map)
    report = how.pop("done", None)

    def requested_load(contact: MapContact) -> float:
        """Return the requested load that belongs to a contact; the attribute `load` may differ from it by rounding."""
        return min(missing, key=lambda load: abs(load - contact.load))

    def done(contact: MapContact) -> None:
        _keep(_file(name, requested_load(contact)), contact)
        if report is not None:
            report(contact)

    solved = solve_map(heights, size, modulus=modulus, loads=missing, periodic=periodic, done=done, **how)
    solved_before |= {requested_load(contact): contact for contact in solved}
    there = tuple(solved_before[load] for load in loads if load in solved_before)
    return MapContacts(there, solved.validity_warnings, len(there) == len(loads))


def _name(heights: np.ndarray, size: tuple[float, float], **inputs: Any) -> str:
    """Return the cache key of a map: a hash of its heights, its size, the solver's code and all inputs except the load."""
    digest = hashlib.sha256(_solver())
    digest.update(np.ascontiguousarray(heights, dtype=np.float64).tobytes())
    digest.update(repr((np.shape(heights), tuple(map(float, size)), sorted(inputs.items(), key=lambda item: item[0]))).encode())
    return digest.hexdigest()[:40]


@cache
def _solver() -> bytes:
    """Return the code of all modules of the solver, without comments and docstrings, as bytes.

    It is part of the cache key, because a changed solver may give other solutions.
    """
    folder = files("stiction.solvers.boundary_elements")
    sources = sorted((file for file in folder.iterdir() if file.name.endswith(".py")), key=lambda file: file.name)
    return "".join(code_alone(file.read_text("utf-8")) for file in sources).encode()


def code_alone(source: str) -> str:
    """Return the syntax tree of a module as text, without comments and docstrings, which change no solution.

    source: text of the module.
    """
    tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(node, clean=False):
            node.body = node.body[1:]
    return ast.dump(tree)


def _file(name: str, load: float) -> Path:
    """Return the path of the cache file of one load [N]; name: cache key of the map."""
    return cache_folder("contacts") / f"{name}-{load.hex()}.npz"


def _read(path: Path, shape: tuple[int, ...]) -> MapContact | None:
    """Return the contact stored in a cache file, or None if the file is missing, damaged, or was written under another name.

    shape: (rows, columns) of the map.
    """
    try:
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            if file["name"].item() != path.name:
                return None
            numbers = json.loads(file["numbers"].item())
            validity_warnings = tuple(ValidityWarning.from_data(row) for row in json.loads(file["validity_warnings"].item()))
            pressure = np.zeros(shape)
            pressure[np.unpackbits(file["where"], count=pressure.size).reshape(shape).astype(bool)] = file["pressure"]
        os.utime(path)
        return MapContact(**numbers, validity_warnings=validity_warnings, pressure=pressure)
    except Exception:  # numpy and zipfile raise many kinds of errors for damaged files
        return None


def _keep(path: Path, contact: MapContact) -> None:
    """Write a contact to a cache file atomically.

    Contacts that did not converge, have no pressure map, or are too large are not written.
    """
    pressure = contact.pressure
    if (
        pressure is None
        or pressure.nbytes > _TOO_LARGE
        or any(one.quantity == "not_converged" for one in contact.validity_warnings)
    ):
        return
    touched = pressure > 0.0
    numbers = {field.name: getattr(contact, field.name) for field in fields(contact) if field.name not in _OF_FILE}
    validity_warnings, where = json.dumps([warning.as_data() for warning in contact.validity_warnings]), np.packbits(touched)

    def write(file: BinaryIO) -> None:
        np.savez(
            file,
            name=path.name,
            numbers=json.dumps(numbers),
            validity_warnings=validity_warnings,
            where=where,
            pressure=pressure[touched],
        )

    keep_file(path, write, _MOST)
