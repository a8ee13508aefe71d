"""Read tables of the measured errors of elastic film laws, by film modulus and film thickness.

`python truth/film_laws.py` makes two tables. The first compares each law on a sphere with the exact solution of a sphere on a
film. The second compares sums over asperities, and the area law of a film, with layered boundary elements on rough surfaces.
The first table holds ratios of a result to the reference, and is interpolated on double-logarithmic scales. The second holds
the geometric mean of such ratios and the rms of their logarithm, for ranges of the parameters. Films that flow plastically are
not included.
"""

import csv
import math
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

ON_A_SPHERE, ON_MAPS = (Path(__file__).with_name(f"film_errors_on_{name}.csv") for name in ("a_sphere", "maps"))
SPHERE_COLUMNS = ("law", "options", "thickness_over_radius", "n_E", "a_over_t", "area", "load")
MAP_COLUMNS = ("law", "options", "n_E", "n_E_to", "thickness", "thickness_to", "mean", "rms", "count")
# Modulus ratios and contact radii over thickness in the summary of a law, and film thickness over sphere radius.
_SHOWN = (0.1, 0.5, 2.0, 10.0), (0.1, 0.5, 1.0, 2.0, 5.0, 20.0)
_SHOWN_RADIUS = 1e-3
# Measured range of each parameter, on a sphere and on maps.
MEASURED = {"n_E": (0.005, 100.0), "a_over_t": (0.05, 20.0)}
MEASURED_ON_MAPS = {"n_E": (0.1, 10.0), "thickness_over_shortest_wave": (0.15, 5.0)}
_MARGIN = 1.001  # factor by which parameters may exceed the range of the table, because of round-off


class SphereFilmErrors(NamedTuple):
    """Store the errors of a film law on a sphere, as arrays of the same shape.

    area: contact area divided by the exact area at the same load. load: load divided by the exact load at the same approach.
    Both are NaN where the modulus ratio or the contact radius divided by film thickness is outside the measured range.
    """

    area: np.ndarray
    load: np.ndarray


class MapFilmErrors(NamedTuple):
    """Store the errors of a film law on rough surfaces, as arrays of the same shape.

    The error is the ratio of the contact area to the reference area at the same load. mean: geometric mean of this ratio over
    the surfaces. rms: root mean square of its logarithm. Both are NaN where modulus ratio or film thickness is outside the
    measured range.
    """

    mean: np.ndarray
    rms: np.ndarray


def on_a_sphere(
    law: str, options: Mapping[str, str], n_E: np.ndarray, a_over_t: np.ndarray, thickness_over_radius: np.ndarray
) -> SphereFilmErrors | None:
    """Return the ratios of area and load by a film law to the exact values on a sphere; None if the law was not measured.

    law: key of the film law. n_E, a_over_t, thickness_over_radius: film modulus divided by substrate modulus, contact radius
    divided by film thickness, and film thickness divided by sphere radius, as arrays of the same shape. A film thickness
    outside the measured range is replaced by the end of the range. The ratios are NaN where n_E or a_over_t is outside it.
    """
    table = _of(_sphere(), law, options)
    if table is None:
        return None
    with np.errstate(divide="ignore"):  # the contact radius may be 0
        given = np.log(np.stack(np.broadcast_arrays(n_E, a_over_t, thickness_over_radius), axis=-1))
    inside = np.clip(given, *np.transpose([(axis[0], axis[-1]) for axis in table.grid]))
    near = np.abs(given - inside)[..., :2] <= math.log(_MARGIN)  # the thickness may be out of range
    ratios = np.exp(table(inside)).reshape(*near.shape[:-1], 2)  # restores the shape of scalar arguments too
    return SphereFilmErrors(*np.moveaxis(np.where(near.all(axis=-1)[..., None], ratios, np.nan), -1, 0))


def on_maps(law: str, options: Mapping[str, str], n_E: np.ndarray, thickness: np.ndarray) -> MapFilmErrors | None:
    """Return mean and rms of the area errors of a film law on rough surfaces; None if the law was not measured.

    law: key of the film law. n_E, thickness: film modulus divided by substrate modulus, and film thickness divided by the
    shortest wavelength, as arrays of the same shape.
    """
    rows = _of(_maps(), law, options)
    if rows is None:
        return None
    out = np.full((2, *np.shape(n_E)), np.nan)
    for low, high, thin, thick, mean, rms, _ in rows:
        here = (n_E >= low / _MARGIN) & (n_E <= high * _MARGIN) & (thickness >= thin / _MARGIN) & (thickness <= thick * _MARGIN)
        out[:, here] = [[mean], [rms]]
    return MapFilmErrors(*out)


def summary(law: str) -> list[dict[str, Any]]:
    """Return the errors of a film law on a sphere, as one dictionary for each set of options.

    A dictionary holds the options, a few values of n_E and a_over_t (film modulus ratio, contact radius divided by thickness),
    and two tables (n_E, a_over_t): relative error of the area at a given load, and of the load at a given approach. The film
    thickness is 0.001 sphere radii. The list is empty if the law was not measured.
    """
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
    """Return the table entry of a film law with these options; None if there is none.

    table: entries by (key of the law, text "option value", or "" for any options).
    """
    for (key, chosen), rows in table.items():
        name, _, value = chosen.partition(" ")
        if key == law and (not name or options.get(name) == value):
            return rows
    return None


@cache
def _sphere() -> dict[tuple[str, str], Any]:
    """Return an interpolator of the errors on a sphere for each (law, options).

    It takes ln of n_E, a/t and t/R, and returns ln of the ratios to the exact area and load. n_E: film modulus divided by
    substrate modulus. a: contact radius, t: film thickness, R: sphere radius.
    """
    from scipy.interpolate import RegularGridInterpolator

    tables = {}
    for key, rows in _numbers(ON_A_SPHERE, SPHERE_COLUMNS).items():
        radius, n_E, width, *ratios = np.log(rows).T
        axes = [np.unique(one) for one in (n_E, width, radius)]
        table = np.full((*map(len, axes), len(ratios)), np.nan)
        table[tuple(map(np.searchsorted, axes, (n_E, width, radius)))] = np.transpose(ratios)
        tables[key] = RegularGridInterpolator(axes, table, bounds_error=False)
    return tables


@cache
def _maps() -> dict[tuple[str, str], list[list[float]]]:
    return _numbers(ON_MAPS, MAP_COLUMNS)


def _numbers(path: Path, columns: Sequence[str]) -> dict[tuple[str, str], list[list[float]]]:
    """Read a CSV file of errors; return the numbers of its rows for each (law, options).

    columns: names of all columns. Those after the first two are numbers; an empty field counts as 1.
    """
    found: dict[tuple[str, str], list[list[float]]] = {}
    with path.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found.setdefault((row["law"], row["options"]), []).append([float(row[name] or 1.0) for name in columns[2:]])
    return found
