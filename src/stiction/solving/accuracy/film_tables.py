"""How far film laws were found from the truth, elastic: near a modulus and a thickness, as data.

Two tables, made by `python truth/film_laws.py`: each law on one sphere against the exact solution of a sphere on a film; and
sums over asperities of rough surfaces (and the area law of a surface on a film) against these surfaces solved by layered
boundary elements. Ratios, interpolated as their logarithms over logarithms. Laws of films that flow are not in them: what
squeezes a film out is solved nowhere here.
"""

import csv
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

ON_A_SPHERE, ON_MAPS = (Path(__file__).with_name(f"measured_on_{name}.csv") for name in ("a_sphere", "maps"))
SPHERE_COLUMNS = ("law", "options", "thickness_over_radius", "n_E", "a_over_t", "area", "load")
MAP_COLUMNS = ("law", "options", "n_E", "n_E_to", "thickness", "thickness_to", "mean", "rms", "count")
# In the summary of a law: moduli and widths, and the thickness over the radius where that counts.
_SHOWN = (0.1, 0.5, 2.0, 10.0), (0.1, 0.5, 1.0, 2.0, 5.0, 20.0)
_SHOWN_RADIUS = 1e-3
# Ends of what was measured, on a sphere and on maps.
MEASURED = {"n_E": (0.005, 100.0), "a_over_t": (0.05, 20.0)}
MEASURED_ON_MAPS = {"n_E": (0.1, 10.0), "thickness_over_shortest_wave": (0.15, 5.0)}
_MARGIN = 1.001  # of a table's ends, for rounding


class OnSphere(NamedTuple):
    """Arrays alike: area over the exact one at the exact load, load over the exact one at the exact approach; not a number
    outside of what was measured."""

    area: np.ndarray
    load: np.ndarray


class OnMaps(NamedTuple):
    """Area over that of solved maps at the same load: geometric mean, and root mean square of its logarithm; arrays alike, not
    a number outside of what was measured."""

    mean: np.ndarray
    rms: np.ndarray


def on_a_sphere(
    law: str, options: Mapping[str, str], n_E: np.ndarray, a_over_t: np.ndarray, thickness_over_radius: np.ndarray
) -> OnSphere | None:
    """Of a film law with its options, at arrays alike; None where it was not measured at all."""
    found = _of(_sphere(), law, options)
    if found is None:
        return None
    radii, places, table = found
    with np.errstate(divide="ignore"):  # of no contact
        given = [np.log(np.asarray(one, dtype=float)) for one in (n_E, a_over_t, thickness_over_radius)]
    values = [_between(table[..., column], [*places, radii], given) for column in range(2)]
    return OnSphere(*(np.exp(one) for one in values))


def on_maps(law: str, options: Mapping[str, str], n_E: np.ndarray, thickness: np.ndarray) -> OnMaps | None:
    """Of rough surfaces under a film of these thicknesses over the shortest wave, at arrays alike; None where not measured."""
    rows = _of(_maps(), law, options)
    if rows is None:
        return None
    out = np.full((2, *np.shape(n_E)), np.nan)
    for low, high, thin, thick, mean, rms, _ in rows:
        here = (n_E >= low / _MARGIN) & (n_E <= high * _MARGIN) & (thickness >= thin / _MARGIN) & (thickness <= thick * _MARGIN)
        out[:, here] = [[mean], [rms]]
    return OnMaps(*out)


def summary(law: str) -> list[dict[str, Any]]:
    """A law's errors on a sphere for tables: for each of its options, at every n_E and a/t that is shown, the relative errors
    of the area at given load and of the load at given approach. Nothing where it was not measured."""
    found = []
    for key, options in _sphere():
        if key == law:
            chosen = dict([options.split(" ", 1)]) if options else {}
            n_E, width = np.meshgrid(*map(np.array, _SHOWN), indexing="ij")
            sphere = on_a_sphere(law, chosen, n_E, width, np.full(n_E.shape, _SHOWN_RADIUS))
            assert sphere is not None
            off = {"area": sphere.area - 1.0, "load": sphere.load - 1.0}
            found.append({"options": options, "n_E": _SHOWN[0], "a_over_t": _SHOWN[1]} | off)
    return found


def _of(table: Mapping, law: str, options: Mapping[str, str]):
    """What the table has of a law with these options; None if nothing."""
    for (key, chosen), rows in table.items():
        name, _, value = chosen.partition(" ")
        if key == law and (not name or options.get(name) == value):
            return rows
    return None


def _between(table: np.ndarray, places: list[np.ndarray], given: list[np.ndarray]) -> np.ndarray:
    """Linear between the places along each axis; held beyond the ends of the last one, not a number beyond those of others."""
    shape = np.broadcast_shapes(*(np.shape(one) for one in given))
    left, share, inside = [], [], np.ones(shape, dtype=bool)
    for number, (axis, one) in enumerate(zip(places, given, strict=True)):
        one = np.broadcast_to(one, shape)
        if number < len(places) - 1:
            inside &= (one >= axis[0] - math.log(_MARGIN)) & (one <= axis[-1] + math.log(_MARGIN))
        at = np.clip(np.searchsorted(axis, one) - 1, 0, max(len(axis) - 2, 0))
        left.append(at)
        width = axis[np.minimum(at + 1, len(axis) - 1)] - axis[at]
        share.append(np.clip(np.divide(one - axis[at], width, out=np.zeros(shape), where=width > 0.0), 0.0, 1.0))
    total = np.zeros(shape)
    for corner in np.ndindex(*(2,) * len(places)):
        place = tuple(np.minimum(one + step, len(p) - 1) for one, step, p in zip(left, corner, places, strict=True))
        weight = np.prod([s if step else 1.0 - s for s, step in zip(share, corner, strict=True)], axis=0)
        total += np.where(weight > 0.0, weight * table[place], 0.0)
    return np.where(inside, total, np.nan)


@cache
def _sphere() -> dict[tuple[str, str], tuple[np.ndarray, list[np.ndarray], np.ndarray]]:
    """Law and options -> logarithms of thicknesses over radius, of n_E and of a/t, and of the ratios over them."""
    found: dict[tuple[str, str], list[list[float]]] = {}
    for row in _rows(ON_A_SPHERE):
        numbers = [float(row[name] or 1.0) for name in SPHERE_COLUMNS[2:]]
        found.setdefault((row["law"], row["options"]), []).append(numbers)
    tables = {}
    for key, rows in found.items():
        radius, n_E, width, *_ = np.log(np.array(rows)).T
        axes = [np.unique(one) for one in (n_E, width, radius)]
        table = np.full((*(len(axis) for axis in axes), 2), np.nan)
        at = tuple(np.searchsorted(axis, one) for axis, one in zip(axes, (n_E, width, radius), strict=True))
        table[at] = np.log(np.array(rows)[:, 3:])
        tables[key] = (axes[2], axes[:2], table)
    return tables


@cache
def _maps() -> dict[tuple[str, str], list[list[float]]]:
    found: dict[tuple[str, str], list[list[float]]] = {}
    for row in _rows(ON_MAPS):
        found.setdefault((row["law"], row["options"]), []).append([float(row[name]) for name in MAP_COLUMNS[2:]])
    return found


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))
