"""Measure how much a contact differs from each surface of the benchmark set, and describe the nearest surface.

The distance is the square root of the sum of squared differences in features such as Nayak's alpha. Each difference is divided
by a scale, for example 0.5 for ln(alpha). The scales are listed below.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.indices import Groups
from stiction.solving.accuracy.benchmark_set import OF_KIND, BenchmarkSet, benchmark_set
from stiction.solving.problem_base import Problem
from stiction.surfaces.theory.moments import bandwidth, reduced_pressure, slope_over_sharpness

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

# Of skewness the difference itself is compared, of the other features the difference of the logarithms.
_SCALES = {"alpha": 0.5, "skewness": 0.6, "lay": 0.35, "top": 0.25}  # differences that count as 1
_LEAST_TOP = 0.03
# Differences that count as 1 if numbers are stated in place of a map: of skewness, ln(kurtosis) and ln(Str). Smaller scales
# narrow the interval. In a test that omitted each design of the set in turn, such narrower intervals contained too few of the
# areas of surfaces with a lay.
_STATED = {"skewness": 0.35, "kurtosis": 0.3, "texture_aspect_ratio": 0.25}
_ALIKE, _FEWEST = 2.0, 8  # a map has a kind if it is closer than 2 to a benchmark surface and has 8 points or more on a side
_PRESSURE = 1.4  # difference of ln(pressure) that counts as 1, at pressures above the solved pressures
# The first number replaces _PRESSURE where the ratio of area to load hardly changes: below the lightest solved pressure
# (truth/light.csv), and where hardness/(E* h') is below the second number, so that all points flow plastically.
_LIGHTER, _FLOWING = 7.0, 0.1
FILM_SCALES = (0.7, 0.8)  # differences that count as 1, of ln(film modulus ratio) and ln(thickness over sqrt(m2/m4))
_SAID = 0.25  # smallest fraction of the squared distance for which a difference is reported
_NAMES = {
    "alpha": "Nayak's alpha",
    "skewness": "skewness",
    "lay": "lay (ratio of rms slopes)",
    "top": "rms slope of the highest 5 % over that of the map",
    "kurtosis": "kurtosis",
    "texture_aspect_ratio": "Str",
}
_OVER_STIFFNESS, _OVER_HARDNESS = "nominal pressure over E* times rms slope", "nominal pressure over hardness"


@dataclass(frozen=True)
class ContactFeatures:
    """Store the features that are compared with benchmark surfaces, at k points (a point is one contact at one load).

    pressure, hardness (k,): divided by E* h', with the contact modulus E* and the rms slope h'. alpha (k,): Nayak's parameter.
    shape: skewness, lay (ratio of largest to smallest rms slope) and relative slope of the highest parts of the map; None
    without a map. modulus (k,): film modulus divided by substrate modulus. thickness (k,): film thickness divided by
    sqrt(m2/m4), with the spectral moments m2 and m4. Both are None without a film. kind: the specified kind of surface, for a
    contact without a map. stated: specified statistics of the surface, by their names in surfaces.roughness.SHAPE, for a
    contact without a map.
    """

    pressure: np.ndarray
    hardness: np.ndarray
    alpha: np.ndarray
    shape: tuple[float, float, float] | None
    modulus: np.ndarray | None = None
    thickness: np.ndarray | None = None
    kind: str | None = None
    stated: Mapping[str, float] = field(default_factory=dict)

    @property
    def kind_known(self) -> bool:
        """Return whether anything is known about the shape of the surface: its map, its kind, or a statistic."""
        return self.shape is not None or self.kind is not None or bool(self.stated)

    def some(self, rows: slice) -> "ContactFeatures":
        """Return the features at the points in the slice `rows`."""
        modulus, thickness = (None if table is None else table[rows] for table in (self.modulus, self.thickness))
        pressure, hardness, alpha = self.pressure[rows], self.hardness[rows], self.alpha[rows]
        return replace(self, pressure=pressure, hardness=hardness, alpha=alpha, modulus=modulus, thickness=thickness)

    @classmethod
    def of(cls, problem: Problem, load: np.ndarray, surface: "HeightMap | None" = None) -> "ContactFeatures":
        """Compute the features of n contacts at normalised loads (n, m), as k = n m points.

        surface: the height map of the contact. If it is None, the contact's own map is used, or its roughness numbers if it has
        no map.
        """
        groups, points = problem.groups, load.shape[1]
        density = groups.roughness_parameter[:, None]
        pressure = reduced_pressure(load, density)
        hardness = groups.eta[:, None] * (4.0 / 3.0) / math.pi / slope_over_sharpness(density)
        alpha, shape = np.broadcast_to(bandwidth(density), load.shape).ravel(), None
        if surface is None and problem.subject is not None:
            surface = problem.subject.with_surface_moments().map
        if surface is not None:
            pressure, hardness, alpha, shape = _of_map(surface, problem, load)
        modulus, thickness = _film_of(groups, points) if groups.has_film else (None, None)
        kind = problem.subject.surface_kind if shape is None and problem.subject is not None else None
        stated = problem.subject.surface_shape if shape is None and problem.subject is not None else {}
        hardness = np.broadcast_to(hardness, load.shape).ravel()
        return cls(pressure.ravel(), hardness, alpha, shape, modulus, thickness, kind, stated)


def _of_map(surface: "HeightMap", problem: Problem, load: np.ndarray):
    """Return pressure/(E* h'), hardness/(E* h'), Nayak's alpha and the shape of a contact with a known map.

    E* is the contact modulus and h' the rms gradient. load: normalised loads. The shape has three numbers: the skewness of the
    heights, the lay (ratio of largest to smallest rms slope), and the rms gradient of the highest 5 % of all points, divided by
    h'.
    """
    from stiction.solvers.boundary_elements.map_area import map_area  # only contacts with a map need this
    from stiction.surfaces.asperity_set import skewness

    area, whole = map_area(surface), problem.subject.with_surface_moments()
    h = area.slopes.gradient
    factors = problem.subject.scales().factors()
    # The unit of load is proportional to the contact modulus, so this ratio is the same for all contacts of a sweep.
    of_unit_load = np.ravel(factors["N"] / whole.nominal_area / (whole.contact_modulus * h))
    pressure = load * float(of_unit_load[0])
    groups = problem.groups
    of_load = groups.eta[:, None] * (4.0 / 3.0) / math.pi * groups.sharpness[:, None] / h
    shape = skewness(surface.heights), area.slopes.lay, area.slopes.top(0.05)
    return pressure, of_load, np.full(load.size, area.slopes.alpha), shape


def _film_of(groups: Groups, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Return two ratios (k,) for k = n m points: film to substrate modulus, and film thickness to sqrt(m2/m4).

    groups: dimensionless groups of n contacts. points: number m of loads of each contact. The spectral moments follow from
    the asperity density N: sqrt(m2/m4) = 1/sqrt(6 pi sqrt(3) N) (Nayak 1971). The group film_aspect is t/sqrt(R sigma),
    with film thickness t.
    """
    thickness = groups.film_aspect * np.sqrt(6.0 * math.pi * math.sqrt(3.0) * groups.roughness_parameter)
    return np.repeat(groups.film_modulus, points), np.repeat(thickness, points)


@dataclass(frozen=True)
class Difference:
    """Store how k points of a contact differ from s benchmark surfaces in one feature.

    Arrays have length 1 instead of k if they are the same for all points. names (k,): name of the feature. ours (k,): value at
    each point. theirs (k, s): value of each surface. squared (k, s): contribution to the squared distances. For films, `theirs`
    and `squared` have a third dimension, the films. Dimensions along which values are equal may have length 1.
    """

    names: np.ndarray
    ours: np.ndarray
    theirs: np.ndarray
    squared: np.ndarray


def _difference(name: str, ours: float | np.ndarray, theirs: np.ndarray, squared: np.ndarray) -> Difference:
    """Build the `Difference` between k points of a contact and s benchmark surfaces in the feature `name`.

    ours: value at the points. theirs: values of the surfaces. squared: contributions of this feature to the squared
    distances. Both (k, s), or (s,) if they are the same for all points.
    """
    return Difference(np.array([name]), np.atleast_1d(ours), np.atleast_2d(theirs), np.atleast_2d(squared))


def differences(known: BenchmarkSet, features: ContactFeatures) -> list[Difference]:
    """Return the differences between k points of a contact and every benchmark surface, one for each feature.

    For a contact with a map the features are Nayak's alpha, skewness, lay and slope of the highest parts, otherwise alpha and
    the specified statistics.
    """
    theirs = known.feature("alpha")
    apart = ((np.log(theirs) - np.log(features.alpha)[:, None]) / _SCALES["alpha"]) ** 2
    alpha = _difference(_NAMES["alpha"], features.alpha, theirs, apart)
    if features.shape is None:
        return [alpha, *(_of_stated(known, name, value) for name, value in features.stated.items())]
    return [alpha, *_of_shape(known, features.shape)]


def _of_stated(known: BenchmarkSet, name: str, ours: float) -> Difference:
    """Return the difference between a specified statistic and the same statistic of every benchmark surface (s,).

    name: name of the statistic. ours: its specified value. The texture aspect ratio (Str) of a stretched isotropic surface is
    the reciprocal of its lay.
    """
    theirs = 1.0 / known.feature("lay") if name == "texture_aspect_ratio" else known.feature(name)
    apart = theirs - ours if name == "skewness" else np.log(theirs / ours)
    return _difference(_NAMES[name], ours, theirs, (apart / _STATED[name]) ** 2)


def _of_shape(known: BenchmarkSet, shape: tuple[float, float, float]) -> list[Difference]:
    """Return the differences between a map and every benchmark surface in skewness, lay, and slope of the highest parts.

    shape: these three numbers of the map.
    """
    skewness, lay, top = shape
    tops = np.maximum(known.feature("top"), _LEAST_TOP)
    each = {
        "skewness": (skewness, ((known.feature("skewness") - skewness) / _SCALES["skewness"]) ** 2),
        "lay": (lay, (np.log(known.feature("lay") / lay) / _SCALES["lay"]) ** 2),
        "top": (top, (np.log(tops / max(top, _LEAST_TOP)) / _SCALES["top"]) ** 2),
    }
    return [_difference(_NAMES[name], ours, known.feature(name), square) for name, (ours, square) in each.items()]


def kind_of_map(surface: "HeightMap") -> str | None:
    """Return the kind of surface (a key of OF_KIND) that is most frequent among similar benchmark surfaces.

    Similar surfaces have about the same skewness, lay and slope of the highest parts; each is weighted by its similarity. The
    result is None for a profile, for a map with missing points or fewer than 8 points along a side, and if no benchmark surface
    is similar.
    """
    from stiction.solvers.boundary_elements.area_estimates import map_slopes  # only contacts with a map need this
    from stiction.surfaces.asperity_set import skewness

    if surface.is_profile or not surface.complete or min(surface.heights.shape) < _FEWEST:
        return None
    slopes, known = map_slopes(surface.heights, surface.size, surface.periodic), benchmark_set()
    squared = squared_distance(_of_shape(known, (skewness(surface.heights), slopes.lay, slopes.top(0.05))))[0]
    if not squared.min() < _ALIKE**2:
        return None
    weights = np.exp(-0.5 * squared)
    return max(OF_KIND, key=lambda kind: float(weights[known.of_kind(kind)].sum()))


def film_differences(known: BenchmarkSet, features: ContactFeatures) -> list[Difference]:
    """Return the differences between k points with a film and every film of every coated benchmark surface, by feature.

    Arrays broadcast to (k, s, f) for s coated surfaces with f films each.
    """
    assert features.modulus is not None and features.thickness is not None
    some = known["film_surfaces"]
    moduli, thicknesses = known["films"].T
    waves = (known["gradient_over_shortest"][some] / known.feature("wave")[some])[:, None]
    modulus, thickness, pressure = (one[:, None, None] for one in (features.modulus, features.thickness, features.pressure))
    by_film = (np.log(moduli / modulus) / FILM_SCALES[0]) ** 2
    by_thickness = (np.log(thicknesses * waves / thickness) / FILM_SCALES[1]) ** 2
    low, high = known["film_loads"][..., 0], known["film_loads"][..., -1]
    beyond = np.maximum(np.maximum(np.log(low / pressure) / _LIGHTER, np.log(pressure / high) / _PRESSURE), 0.0)
    bare = [
        replace(one, theirs=one.theirs[:, some, None], squared=one.squared[:, some, None])
        for one in differences(known, features)
    ]
    return [
        *bare,
        _difference("film modulus over the body's modulus", features.modulus, moduli[None, None, :], by_film),
        _difference("film thickness over sqrt(m2/m4)", features.thickness, (thicknesses * waves)[None], by_thickness),
        _difference(_OVER_STIFFNESS, features.pressure, np.clip(pressure, low, high), beyond**2),
    ]


def pressure_difference(
    known: BenchmarkSet, pressure: np.ndarray, hardness: np.ndarray
) -> tuple[Difference, np.ndarray, np.ndarray]:
    """Compare pressures with the benchmark set; return the difference, and pressures and hardnesses within its range.

    The errors of models are looked up at the returned pressures and hardnesses, (k,) each. pressure, hardness (k,): divided by
    E* h', with the contact modulus E* and the rms slope h'. Below the smallest hardness of the set all points flow plastically,
    so only the ratio of pressure to hardness matters.
    """
    low, high = float(known["loads"][0]), float(known["loads"][-1])
    softest = float(known["hardnesses"][1:].min())
    flows = hardness < softest
    pressure, hardness = np.where(flows, pressure * softest / hardness, pressure), np.maximum(hardness, softest)
    names, unit = np.where(flows, _OVER_HARDNESS, _OVER_STIFFNESS), np.where(flows, softest, 1.0)
    heavier = np.where(hardness <= _FLOWING, _LIGHTER, _PRESSURE)
    beyond = np.maximum(np.maximum(np.log(low / pressure) / _LIGHTER, np.log(pressure / high) / heavier), 0.0)
    inside = np.clip(pressure, low, high)
    theirs, squared = (np.repeat(one[:, None], len(known["surfaces"]), axis=1) for one in (inside / unit, beyond**2))
    return Difference(names, pressure / unit, theirs, squared), inside, hardness


def squared_distance(parts: Iterable[Difference]) -> np.ndarray:
    """Add the squared differences in all features; return the squared distance (k or 1, s) of each point from each surface.

    For films the shape is (k or 1, s, f), with f films per surface.
    """
    return np.asarray(sum(one.squared for one in parts))


def nearest_in_words(parts: Sequence[Difference], point: int, at: int) -> str:
    """Describe the features in which a point differs most from one benchmark surface.

    For example "the nearest has Nayak's alpha 5 instead of 24". The text names the feature with the largest squared difference,
    and every other feature that contributes at least 25 % of the squared distance. parts: differences in all features. point:
    index of the point. at: flat index of the surface.
    """
    shape = np.broadcast_shapes(*(one.squared.shape[1:] for one in parts))

    def of_point(table: np.ndarray) -> np.ndarray:
        return table[point % len(table)]

    squared = [float(np.broadcast_to(of_point(one.squared), shape).flat[at]) for one in parts]
    texts: list[str] = []
    for part, one in sorted(zip(squared, parts, strict=True), key=lambda row: -row[0]):
        if not texts or part >= _SAID * sum(squared):
            their = np.broadcast_to(of_point(one.theirs), shape).flat[at]
            texts.append(f"{of_point(one.names)} {their:.2g} instead of {of_point(one.ours):.2g}")
    return "the nearest has " + " and ".join(texts)
