"""Compute the real contact area of a map against load, by solving the map or by a formula.

The area fraction A/A0 is solved at each requested mean pressure separately. If more than twelve are requested, it is solved at
four pressures per decade, and ln A is interpolated by a monotone cubic of ln p (p: mean pressure). To save time, points are
skipped if this leaves at least four points in the shortest wave (eight on a map with a lay) and 3000 points in contact. The map
is solved only between a lightest pressure, at which about 120 points touch, and a heaviest pressure. Beyond these two pressures
the area follows a formula (`area_estimates`), scaled to the solution at the nearer one. Neither depends on the requested
pressures. For maps that are too large to solve, the formula gives all areas. Solutions are cached as long as the program runs.
"""

import hashlib
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import PchipInterpolator

from stiction.solvers.boundary_elements.area_estimates import MapSlopes, by_ranks, by_top_slopes, map_slopes
from stiction.solvers.boundary_elements.compliance import Compliance
from stiction.solvers.boundary_elements.limits import LEAST_IN_WAVE, LEAST_WAVES
from stiction.solvers.boundary_elements.measures import Waves, waves
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.asperity_set import skewness
from stiction.surfaces.heightmap import HeightMap, every_point
from stiction.surfaces.theory.widened_area import with_hardness

MOST_POINTS = 2**19  # largest number of points that are solved
# Least number of points in contact, if the map has so many. With 1000 points, areas were up to 4.6 % too large on maps with a
# strong or weak lay.
LEAST_CONTACT = 3000
FEWEST_CONTACT = 60  # with fewer points in contact the formula replaces the solution
AT_LEAST = 2.0 * FEWEST_CONTACT  # estimated number of touching points at the lightest solved pressure
FEWEST_IN_WAVE = 2.5  # least number of points in the shortest wave on large maps, which need more skipping
# Contact patches are narrower across a lay. With 4 points in the shortest wave, areas are therefore 3 % too large at a lay
# ratio of 3:1, and 9 % at 6:1.
_LAID, _LEAST_ACROSS_LAY = 1.7, 8.0
_STEPS, _FEW = 4, 12  # solved pressures per decade, if more than twelve pressures are requested
# This factor was measured on windows of generated maps (grade C). In 24 windows of elastic maps, the error of ln A was up to 5
# times the error estimated from quadrants if the window was as wide as 1 of the longest waves, and equal to the estimate for 4
# waves or more. It was tested on 104 windows of 21 plastic maps (H/(E* h') .25 to 1.2, 1.4 to 6 waves, seven kinds of surface).
# There, 90 % intervals contain the area in 91 % of cases, and in 83 % for surfaces with a lay, the worst kind.
_OF_WAVES = 0.8
_HEAVIEST = 1.2  # largest pressure that is solved, divided by E* h'
_MOST_OF_HARDNESS = 0.97
# Limits of maps that are Gaussian and isotropic enough for the formula by top slopes.
_MOST_SKEWNESS, _MOST_LAY, _TOP, _TOP_RANGE = 0.5, 1.3, 0.05, (0.75, 1.3)


@dataclass(frozen=True, eq=False)
class MapArea:
    """Compute the real contact area of one map at any mean pressure and hardness.

    heights: (rows, columns) [m], without missing points. size: (y, x) [m]. periodic: whether the map is one period of an
    endless surface; if not, it is a window of a larger surface.
    """

    heights: np.ndarray
    size: tuple[float, float]
    periodic: bool
    _curves: dict[float, "_Curve"] = field(default_factory=dict, repr=False)

    @cached_property
    def slopes(self) -> MapSlopes:
        """Return the rms gradient, Nayak parameter and lay of the map, and its gradients by height rank."""
        return map_slopes(self.heights, self.size, self.periodic)

    @cached_property
    def waves(self) -> Waves:
        """Return the shortest and longest wavelength of the map, its rms gradient, point spacing and shorter side."""
        return waves(self.heights, self.size, self.periodic)

    @cached_property
    def _quadrants(self) -> "list[MapArea]":
        halves = [(slice(None, count // 2), slice(count - count // 2, None)) for count in self.heights.shape]
        parts = [self.heights[rows, columns] for rows in halves[0] for columns in halves[1]]
        high, wide = (length * (count // 2) / count for length, count in zip(self.size, self.heights.shape, strict=True))
        return [MapArea(np.ascontiguousarray(part), (high, wide), periodic=False) for part in parts]

    def sample_error(self, pressure: np.ndarray, hardness: float) -> np.ndarray:
        """Return the standard error of ln A that arises because the map is only a window of a larger surface.

        A: contact area. pressure (any shape), hardness: mean pressures and hardness, divided by E*. The error, of the shape of
        the pressures, is estimated from the scatter between the four quadrants of the map. It is 0 for a periodic map. If the
        window holds few of the longest waves, its quadrants resemble each other and the error is increased (_OF_WAVES). The
        result is NaN if a quadrant is flat or the pressure is 0.
        """
        if self.periodic:
            return np.zeros(np.shape(pressure))
        if any(np.ptp(quadrant.heights) == 0.0 for quadrant in self._quadrants):
            return np.full(np.shape(pressure), np.nan)
        with np.errstate(divide="ignore", invalid="ignore"):
            logarithms = np.log([quadrant.share(pressure, hardness) for quadrant in self._quadrants])
            scatter = np.std(logarithms, axis=0, ddof=1) / math.sqrt(len(logarithms))
        return scatter * (1.0 + _OF_WAVES * max(LEAST_WAVES / self.waves.longest_waves_on_a_side - 1.0, 0.0))

    @cached_property
    def solvable(self) -> list[int]:
        """Return the sampling steps with which the map can be solved, coarsest first; empty if there are none.

        A step of r uses every r-th point of each row and column, few enough to solve. On a periodic map r divides the numbers
        of rows and columns. Steps above 1 also leave enough points in the shortest wave. If no step satisfies these conditions,
        the list contains only the smallest step that leaves at least FEWEST_IN_WAVE points in this wave, if there is one.
        """
        in_wave = self.waves.points_in_shortest_wave
        all_of_them = range(1, min(self.heights.shape) // 16 + 1)
        least = LEAST_IN_WAVE if self.slopes.lay < _LAID else _LEAST_ACROSS_LAY
        steps = [every for every in all_of_them if self._may(every, in_wave, least)]
        return steps[::-1] or [every for every in all_of_them if self._may(every, in_wave, FEWEST_IN_WAVE)][:1]

    @property
    def finest_points(self) -> float:
        """Return the number of points of the map at the finest sampling step in `solvable`, which must not be empty."""
        return self.heights.size / self.solvable[-1] ** 2

    def _may(self, every: int, in_wave: float, least: float) -> bool:
        divides = not self.periodic or not any(count % every for count in self.heights.shape)
        few_enough = self.heights.size / every**2 <= MOST_POINTS
        return divides and few_enough and (every == 1 or in_wave / every >= least)

    @property
    def gaussian(self) -> bool:
        """Return whether the map is Gaussian and isotropic enough for the area formula that uses its highest points only."""
        low, high = _TOP_RANGE
        return (
            abs(skewness(self.heights)) < _MOST_SKEWNESS and self.slopes.lay < _MOST_LAY and low < self.slopes.top(_TOP) < high
        )

    @property
    def way(self) -> str:
        """Return the method that computes the area: "solution", "top slopes" or "ranks"."""
        if self.solvable:
            return "solution"
        return "top slopes" if self.gaussian else "ranks"

    @property
    def formula(self) -> Callable[[float, MapSlopes], float]:
        """Return the function that estimates the area fraction A/A0 at pressures that are not solved.

        Its arguments are the mean pressure divided by E* h', where h' is the rms gradient, and the `MapSlopes` of the map.
        """
        return by_top_slopes if self.gaussian else by_ranks

    def share(self, pressure: np.ndarray, hardness: float) -> np.ndarray:
        """Return the area fraction A/A0 at mean pressures divided by E* (any shape, >= 0).

        hardness: divided by E*; infinite for elastic bodies. The map is solved at pressures where this is possible; a formula
        is used at all others.
        """
        h = self.slopes.gradient
        if hardness not in self._curves:
            self._curves[hardness] = _Curve(self, hardness / h)
        flat = np.ravel(np.asarray(pressure, dtype=float)) / h
        return self._curves[hardness](flat).reshape(np.shape(pressure))

    def solved_with(self, compliance: Compliance, pressure: np.ndarray, expected: np.ndarray) -> np.ndarray:
        """Return the area fraction A/A0 (n,) of elastic bodies with films, by solving the map.

        compliance: elastic constants of bodies and films. pressure: mean pressures (n,), ascending [Pa]. expected: approximate
        A/A0 (n,), from which the number of points to solve follows. The result is NaN where too few points touch or the map is
        too large.
        """
        areas = np.full(len(pressure), np.nan)
        if not self.solvable:
            return areas
        films = {"film": compliance.film, "counter_film": compliance.counter_film}
        steps = np.array([self.every(area) for area in expected.tolist()])
        for step in np.unique(steps).tolist():
            mine = steps == step
            areas[mine] = self.solve(pressure[mine], step, modulus=compliance.modulus, **films)
        return areas

    def every(self, area: float) -> int:
        """Return the coarsest sampling step that leaves at least 3000 points in contact, or the smallest step if none does.

        A step of r uses every r-th point of each row and column. area: expected area fraction A/A0.
        """
        expected = area * self.heights.size
        return next((step for step in self.solvable if expected / step**2 >= LEAST_CONTACT), self.solvable[-1])

    def solve(self, pressure: np.ndarray, every: int, **how) -> np.ndarray:
        """Return the area fraction A/A0 (n,) at mean pressures (n,), solved at every r-th point of each row and column.

        pressure: in the unit of the modulus in `how`. every: r. how: further keywords of `solve_map`, such as modulus and
        films. The result is NaN where too few points touch.
        """
        heights, (high, wide) = every_point(self.heights, self.size, every)
        loads = (pressure * high * wide).tolist()
        contacts = solve_map(
            heights, (high, wide), loads=loads, periodic=self.periodic, keep_maps=False, stiffness=False, **how
        )
        touching = contacts.array("area_pixels") / (high * wide) * heights.size >= FEWEST_CONTACT
        return np.where(touching, np.minimum(contacts.array("area") / (high * wide), 1.0), np.nan)

    def by_formula(self, pressure: float, hardness: float) -> float:
        """Return the area fraction A/A0 of the map by a formula, without solving it.

        pressure, hardness: divided by E* h', with the contact modulus E* and the rms gradient h' of the map.
        """
        return float(with_hardness(self.formula(pressure, self.slopes), pressure, hardness))


class _Curve:
    """Compute the area fraction A/A0 of a map against mean pressure at one hardness.

    Pressure and hardness are divided by E* h', with h' the rms gradient. Solutions are stored as ln(A/A0) at each pressure. For
    many pressures the map is solved only at 10^(k/4), with integers k, and ln(A/A0) is interpolated.
    """

    def __init__(self, area: MapArea, hardness: float):
        self._area, self._hardness = area, hardness
        self._heaviest = min(_HEAVIEST, _MOST_OF_HARDNESS * hardness)
        self._nodes: dict[float, float] = {}
        self._lightest = 0.0  # the lightest solved pressure, or the heaviest pressure at which too few points touch
        self._has_lightest = False  # whether the lightest pressure has been determined

    def __call__(self, pressure: np.ndarray) -> np.ndarray:
        areas = np.zeros(pressure.shape)
        some = pressure > 0.0
        if not some.any():
            return areas
        if not self._area.solvable:
            areas[some] = [self._area.by_formula(ratio, self._hardness) for ratio in pressure[some].tolist()]
            return areas
        self._solve(np.unique(pressure[some]))
        areas[some] = self._read(pressure[some])
        return areas

    def _solve(self, pressure: np.ndarray) -> None:
        """Solve the map at the pressures (n,) or, if there are more than twelve, at the powers 10^(k/4) around them.

        Pressures are divided by E* h'. The results are stored; pressures solved before are skipped.
        """
        inside = np.minimum(pressure, self._heaviest)
        if len(pressure) > _FEW:
            steps = np.floor(_STEPS * np.log10(inside)).astype(int)
            grid = {int(k) + shift for k in steps for shift in (-1, 0, 1, 2)}
            inside = np.array([min(10.0 ** (k / _STEPS), self._heaviest) for k in grid])
        if not self._has_lightest and self._touching(float(inside.min())) < 2.0 * AT_LEAST:
            self._find_lightest()
        missing = sorted({float(f"{ratio:.12g}") for ratio in inside.tolist()} - self._nodes.keys())
        missing = [ratio for ratio in missing if ratio > self._lightest]
        before = self._lightest
        while missing:  # heaviest first, because no lighter pressure need be tried once too few points touch
            every = self._every(missing[-1])
            together = [ratio for ratio in missing if self._every(ratio) == every]
            self._solve_nodes(together, every)
            missing = [ratio for ratio in missing if ratio not in together and ratio > self._lightest]
        if self._lightest > before and not self._has_lightest:
            self._find_lightest()

    def _touching(self, pressure: float) -> float:
        """Estimate from the area formula how many points touch at a pressure (divided by E* h') at the finest sampling step."""
        return self._area.by_formula(pressure, self._hardness) * self._area.finest_points

    def _find_lightest(self) -> None:
        """Solve the map at the lowest pressure 10^(k/4) E* h', with integer k, at which enough points touch.

        Areas at lower pressures are scaled from this solution.
        """
        self._has_lightest = True
        k = math.ceil(_STEPS * math.log10(self._heaviest))
        while self._touching(10.0 ** ((k - 1) / _STEPS)) >= AT_LEAST:
            k -= 1
        for power in itertools.count(k):
            ratio = float(f"{min(10.0 ** (power / _STEPS), self._heaviest):.12g}")
            if ratio not in self._nodes:
                self._solve_nodes([ratio], self._every(ratio))
            if ratio in self._nodes or ratio >= self._heaviest:
                break
        self._lightest = ratio

    def _every(self, pressure: float) -> int:
        return self._area.every(self._area.by_formula(pressure, self._hardness))

    def _solve_nodes(self, pressures: list[float], every: int) -> None:
        h = self._area.slopes.gradient
        hardness = None if math.isinf(self._hardness) else self._hardness * h
        areas = self._area.solve(np.array(pressures) * h, every, modulus=1.0, hardness=hardness)
        for pressure, area in zip(pressures, areas.tolist(), strict=True):
            if math.isnan(area):
                self._lightest = max(self._lightest, pressure)
            else:
                self._nodes[pressure] = math.log(area)

    def _read(self, pressure: np.ndarray) -> np.ndarray:
        if not self._nodes:
            return np.array([self._formula(ratio) for ratio in pressure.tolist()])
        nodes = sorted(self._nodes)
        x, y = np.log(nodes), np.array([self._nodes[node] for node in nodes])
        if self._hardness < _HEAVIEST:  # all points are in contact when the pressure is the hardness
            x, y = np.append(x, math.log(self._hardness)), np.append(y, 0.0)
        low, high = math.exp(x[0]), math.exp(x[-1])
        inside = np.log(np.clip(pressure, low, high))
        areas = np.exp(PchipInterpolator(x, y)(inside) if len(x) > 1 else np.full(inside.shape, y[0]))
        for row in np.flatnonzero(pressure < low):
            areas[row] *= self._formula(pressure[row]) / self._formula(low)
        for row in np.flatnonzero(pressure > high):
            left = max(1.0 - self._formula(high), 1e-12)
            areas[row] = 1.0 - (1.0 - areas[row]) * min((1.0 - self._formula(pressure[row])) / left, 1.0)
        return np.minimum(areas, 1.0)

    def _formula(self, pressure: float) -> float:
        return self._area.by_formula(float(pressure), self._hardness)


def map_area(surface: HeightMap) -> MapArea:
    """Return the MapArea of a map without missing points.

    The objects of the last eight maps are kept in memory, so that an equal map gets the same object with its stored solutions.
    """
    digest = hashlib.blake2b(np.ascontiguousarray(surface.heights).tobytes(), digest_size=20)
    digest.update(repr((surface.heights.shape, surface.size, surface.periodic)).encode())
    return _kept(digest.hexdigest(), _Held(surface))


class _Held:
    """Wrap a map so that all wrapped maps compare equal: the cache then distinguishes maps by their digest alone."""

    def __init__(self, surface: HeightMap):
        self.surface = surface

    def __hash__(self) -> int:
        return 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Held)


@lru_cache(maxsize=8)
def _kept(digest: str, held: _Held) -> MapArea:
    return MapArea(held.surface.heights, held.surface.size, held.surface.periodic)
