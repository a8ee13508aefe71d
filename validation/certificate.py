"""Compare the certificate of solved maps with their true errors, on 200 maps whose answers are known by other means.

    python validation/certificate.py     # a line for each kind of map and residual; half a minute on one core

Displacements are sums over cosines or Love's formula, with the compliance of a film by maps/maps.py: no transform and no
solver is shared with the package. Maps are of five kinds:

    hertz        ellipsoids on a map that ends: Hertz' pressure at the points; Johnson 1985, Contact Mechanics, eqs. 3.23, 4.24
    westergaard  a wave along one direction, partly in contact: Johnson, eq. 13.7
    full         several waves and egg boxes in full contact, each wave with its own pressure: Johnson, eq. 13.6
    flowing      pressures between none and the hardness, drawn; the heights follow from them
    dense        drawn heights of few points, solved by active sets with dense matrices until all conditions hold to 1e-12

For the first four the pressure p* of the answer is given, and the heights are h = C p* - g*, where the gap g* has the sign that
the conditions of contact demand. The answer of that map is then p*, exactly: the problem is convex. For Hertz and Westergaard
g* is zero in contact, and outside it is that of the paraboloid or wave, so that only the width of points distinguishes the map
from these.
"""

import itertools
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from stiction.solvers.boundary_elements.certificate import Certificate, certify
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.limits import TOLERANCE
from stiction.solvers.boundary_elements.measures import rms_step
from stiction.solvers.boundary_elements.minimise import Found, Problem, minimise
from stiction.solvers.boundary_elements.operators import FreeBoundary, MirroredBoundary, PeriodicBoundary

sys.path.insert(0, str(Path(__file__).parent / "maps"))
import maps

UNIT = (1.0, 1.0)
COUNTS = {"hertz": 30, "westergaard": 30, "full": 30, "flowing": 40, "dense": 70}
TOLERANCES = (1e-1, 1e-3, TOLERANCE)  # of the residual; the last is that of every solution
_BOUNDARIES = {"periodic": PeriodicBoundary, "mirrored": MirroredBoundary, "free": FreeBoundary}
_EXACT = 1e-12  # of the pressures and gaps of a dense answer, relative


class Known(NamedTuple):
    """A map with its answer. pressure: p* (rows, columns), in units of E*, as in the problem; matrix: C (points, points)."""

    problem: Problem
    pressure: np.ndarray
    matrix: np.ndarray


class Compared(NamedTuple):
    """The certificate of a solution and its true errors.

    pressure: |p - p*| over |p| as energy norms. points: points that are wrongly in or out of contact, over those in contact.
    """

    said: Certificate
    pressure: float
    points: float

    @property
    def ratio(self) -> float:
        """The bound of the pressure over its true error."""
        return self.said.pressure_error / self.pressure if self.pressure else math.inf


def answers(kinds=tuple(COUNTS)) -> Iterator[tuple[str, Known]]:
    """Yield the maps of these kinds with their answers."""
    for kind in kinds:
        for number in range(COUNTS[kind]):
            yield kind, _MAKERS[kind](np.random.default_rng([number, len(kind)]))


def compared(known: Known, tolerance: float) -> Compared:
    """Return the certificate of a map solved to a residual, beside its errors."""
    found = minimise(known.problem, np.full_like(known.pressure, known.problem.mean), tolerance=tolerance, most=2000)
    assert found.converged
    return Compared(certify(known.problem, found), *_errors(known, found))


def _errors(known: Known, found: Found) -> tuple[float, float]:
    wrong, all_of_it = (found.pressure - known.pressure).ravel(), found.pressure.ravel()
    energies = [max(float(p @ known.matrix @ p), 0.0) for p in (wrong, all_of_it)]
    touch = found.pressure > 0.0
    return math.sqrt(energies[0] / energies[1]), np.count_nonzero(touch != (known.pressure > 0.0)) / np.count_nonzero(touch)


def _pair(rng: np.random.Generator, filmed: float = 0.0) -> tuple[Compliance, maps.Film | None]:
    """Return the compliance of a pair with E* = 1, or of a film on a body of E* = 1, and the film."""
    if rng.random() >= filmed:
        return Compliance(1.0), None
    film = maps.Film(10.0 ** rng.uniform(-1.0, 1.0), rng.uniform(0.01, 0.2), rng.uniform(0.1, 0.45))
    own = Film(film.thickness, film.modulus * (1.0 - film.poisson**2), film.poisson, 1.0 - maps.POISSON**2, maps.POISSON)
    return Compliance(math.inf, own), film


def matrix_of(boundary: str, count: int, film: maps.Film | None = None) -> np.ndarray:
    """Return the displacement of every point by the pressure on every other, of a square map of side 1."""
    if boundary == "mirrored":  # cosines of half periods along a side
        waves = np.cos(math.pi * np.outer(np.arange(count), np.arange(count) + 0.5) / count)
        waves *= np.sqrt(np.where(np.arange(count) == 0, 1.0, 2.0) / count)[:, None]
        both = np.kron(waves, waves)
        k = math.pi * np.hypot(np.arange(count)[:, None], np.arange(count)).ravel()
        return both.T @ (_compliance(k, film)[:, None] * both)
    apart = np.arange(1 - count, count)
    if boundary == "periodic":
        m = np.fft.fftfreq(count, 1.0 / count)
        of_waves = _compliance(2.0 * math.pi * np.hypot(m[:, None], m).ravel(), film).reshape(count, count)
        turns = np.exp(2j * math.pi * np.outer(apart, m) / count)
        response = (turns @ of_waves @ turns.T).real / count**2
    else:
        response = np.array([[_love(dx / count, dy / count, 0.5 / count) for dx in apart] for dy in apart])
    row, column = np.divmod(np.arange(count**2), count)
    return response[row[:, None] - row + count - 1, column[:, None] - column + count - 1]


def _compliance(k: np.ndarray, film: maps.Film | None) -> np.ndarray:
    """Return the compliance of waves, 0 for the mean."""
    found = np.zeros_like(k)
    found[k > 0.0] = maps.compliance(k[k > 0.0], film)
    return found


def _love(x: float, y: float, a: float) -> float:
    """Return the displacement over the pressure of a square of side 2a; Johnson, eq. 3.25."""

    def term(u, v, w):
        return u * math.log((v + math.hypot(v, u)) / (w + math.hypot(w, u)))

    return (
        term(x + a, y + a, y - a) + term(y + a, x + a, x - a) + term(x - a, y - a, y + a) + term(y - a, x - a, x + a)
    ) / math.pi


def _known(boundary: str, pair: Compliance, pressure, heights, matrix, hardness: float = math.inf) -> Known:
    displacement = _BOUNDARIES[boundary](pair, heights.shape, UNIT)
    return Known(Problem(displacement, heights, float(pressure.mean()), hardness, rms_step(heights)), pressure, matrix)


def _places(count: int) -> np.ndarray:
    return (np.arange(count) + 0.5) / count - 0.5


def _lifted(matrix: np.ndarray, pressure: np.ndarray, surface: np.ndarray) -> np.ndarray:
    """Return heights that carry this pressure exactly: those of a surface outside of contact, where it does not overlap.

    The level of the surface is the mean one of the displaced points in contact.
    """
    moved = (matrix @ pressure.ravel()).reshape(pressure.shape)
    touch = pressure > 0.0
    surface = surface + float(np.mean((moved - surface)[touch]))
    return np.where(touch, moved, np.minimum(surface, moved - 1e-9 * np.ptp(moved)))


def _hertz(rng: np.random.Generator) -> Known:
    count, a = 24, rng.uniform(0.12, 0.35)
    b, turned = a * rng.uniform(0.5, 1.0), rng.uniform(0.0, math.pi)
    y, x = _places(count)[:, None] + rng.uniform(-0.02, 0.02), _places(count) + rng.uniform(-0.02, 0.02)
    along, across = x * math.cos(turned) + y * math.sin(turned), y * math.cos(turned) - x * math.sin(turned)
    pressure = 0.1 * np.sqrt(np.maximum(1.0 - (along / a) ** 2 - (across / b) ** 2, 0.0))
    matrix = _MATRICES("free", count)
    moved = (matrix @ pressure.ravel()).reshape(pressure.shape)
    touch = pressure > 0.0
    terms = np.stack([np.ones_like(moved), along**2, across**2])  # Hertz: in contact the displacement is a paraboloid
    fit = np.linalg.lstsq(terms[:, touch].T, moved[touch], rcond=None)[0]
    return _known("free", Compliance(1.0), pressure, _lifted(matrix, pressure, np.tensordot(fit, terms, 1)), matrix)


def _westergaard(rng: np.random.Generator) -> Known:
    count, height, share = 24, 0.02, rng.uniform(0.05, 0.95)
    x = _places(count) + rng.uniform(-0.02, 0.02)
    root = np.sqrt(np.maximum(share - np.sin(math.pi * x) ** 2, 0.0))
    pressure = np.tile(2.0 * math.pi * height * np.cos(math.pi * x) * root, (count, 1))
    pressure = pressure.T.copy() if rng.random() < 0.5 else pressure
    wave = height * np.cos(2.0 * math.pi * x) + np.zeros((count, 1))
    wave = wave.T.copy() if pressure[0, 0] != pressure[1, 0] or pressure[0].std() == 0.0 else wave
    matrix = _MATRICES("periodic", count)
    return _known("periodic", Compliance(1.0), pressure, _lifted(matrix, pressure, wave), matrix)


def _full(rng: np.random.Generator) -> Known:
    count = 24
    pair, film = _pair(rng, filmed=0.5)
    y, x = _places(count)[:, None], _places(count)
    heights, pressure = np.zeros((count, count)), np.zeros((count, count))
    for _ in range(int(rng.integers(1, 5))):
        m, n = (int(rng.integers(1, 8)) for _ in range(2))
        wave = 0.01 * rng.normal() * np.cos(2.0 * math.pi * m * x + rng.uniform(0.0, 7.0))
        wave = wave * np.cos(2.0 * math.pi * n * y + rng.uniform(0.0, 7.0))
        heights += wave
        pressure += wave / float(maps.compliance(2.0 * math.pi * np.array([math.hypot(m, n)]), film)[0])
    pressure += rng.uniform(1.01, 2.0) * abs(float(pressure.min()))
    return _known(
        "periodic", pair, pressure, heights, matrix_of("periodic", count, film) if film else _MATRICES("periodic", count)
    )


def _flowing(rng: np.random.Generator) -> Known:
    count, boundary = 20, str(rng.choice(["periodic", "mirrored", "free"]))
    pair, film = _pair(rng, filmed=0.0 if boundary == "free" else 0.4)
    matrix = matrix_of(boundary, count, film) if film else _MATRICES(boundary, count)
    field = _drawn(rng, count, 4)
    low, high = np.quantile(field, [rng.uniform(0.05, 0.95), 1.0 - rng.uniform(0.02, 0.05)])
    hardness = 0.1 if high > low else math.inf
    pressure = 0.1 * np.clip((field - low) / (abs(high - low) or 1.0), 0.0, 1.0 if math.isfinite(hardness) else math.inf)
    moved = (matrix @ pressure.ravel()).reshape(pressure.shape)
    gap = float(moved.std()) * np.where(pressure <= 0.0, rng.exponential(size=field.shape), 0.0)
    gap -= float(moved.std()) * np.where(pressure >= hardness, rng.exponential(size=field.shape), 0.0)
    return _known(boundary, pair, pressure, moved - gap, matrix, hardness)


def _drawn(rng: np.random.Generator, count: int, waves: int) -> np.ndarray:
    """Return a random map with waves up to so many periods, of standard deviation 1."""
    y, x = np.arange(count)[:, None] / count, np.arange(count) / count
    heights, hurst = np.zeros((count, count)), rng.uniform(0.3, 1.0)
    for m, n in itertools.product(range(-waves, waves + 1), range(waves + 1)):
        if 0 < m * m + n * n <= waves**2:
            phase = 2.0 * math.pi * (m * y + n * x) + rng.uniform(0.0, 7.0)
            heights += rng.normal() * math.hypot(m, n) ** -(1.0 + hurst) * np.cos(phase)
    return (heights - heights.mean()) / heights.std()


def _dense(rng: np.random.Generator) -> Known:
    count, boundary = int(rng.integers(8, 13)), str(rng.choice(["periodic", "mirrored", "free"]))
    pair, film = _pair(rng, filmed=0.0 if boundary == "free" else 0.4)
    matrix = matrix_of(boundary, count, film)
    z = _drawn(rng, count, 4)
    shapes = (z, np.exp(0.7 * z), -np.exp(0.7 * z), np.minimum(z, 0.3) + 0.02 * z)
    heights = 0.01 * shapes[int(rng.integers(4))]
    stiffness = 1.0 / float(matrix[0, 0] - matrix[0, 1])
    mean = rms_step(heights) * stiffness * 10.0 ** rng.uniform(-2.5, 0.0)
    hardness = mean * 10.0 ** rng.uniform(0.2, 1.5) if rng.random() < 0.4 else math.inf
    pressure = solved(matrix, heights.ravel(), mean, hardness).reshape(heights.shape)
    known = _known(boundary, pair, pressure, heights, matrix, hardness)
    return known._replace(problem=Problem(known.problem.displacement, heights, mean, hardness, rms_step(heights)))


def solved(matrix: np.ndarray, heights: np.ndarray, mean: float, hardness: float) -> np.ndarray:
    """Return the pressure (n,) of this mean, between 0 and the hardness, that meets all conditions of contact.

    Active sets: of the points that neither carry nothing nor flow the equations are solved; a step ends where the first of
    them meets a bound, and the point whose gap is most wrong leaves its bound (Nocedal & Wright 2006, Numerical Optimization,
    algorithm 16.3).
    """
    pressure = np.full(len(heights), mean)
    low, high = np.zeros(len(heights), bool), np.zeros(len(heights), bool)
    while True:
        inside = np.flatnonzero(~low & ~high)
        system = np.ones((len(inside) + 1, len(inside) + 1))
        system[:-1, :-1], system[-1, -1] = matrix[np.ix_(inside, inside)], 0.0
        others = np.where(high, hardness, 0.0) if math.isfinite(hardness) else np.zeros_like(pressure)
        right = np.append((heights - matrix @ others)[inside], mean * len(heights) - others.sum())
        answer = np.linalg.solve(system, right)
        change = answer[:-1] - pressure[inside]
        bound = np.where(change < 0.0, 0.0, hardness)
        with np.errstate(divide="ignore", invalid="ignore"):
            room = np.where(change == 0.0, math.inf, (bound - pressure[inside]) / change)
        first = int(np.argmin(room))
        if room[first] < 1.0:
            pressure[inside] += room[first] * change
            pressure[inside[first]] = bound[first]
            (low if change[first] < 0.0 else high)[inside[first]] = True
            continue
        pressure[inside] = answer[:-1]
        gap = matrix @ pressure - heights + answer[-1]
        wrong = np.where(low, -gap, 0.0) + np.where(high, gap, 0.0)
        worst = int(np.argmax(wrong))
        if wrong[worst] <= _EXACT * np.abs(heights).max():
            return pressure
        low[worst] = high[worst] = False


class _Kept(dict):
    """Keep the matrices of maps without films, which many maps share."""

    def __call__(self, boundary: str, count: int) -> np.ndarray:
        if (boundary, count) not in self:
            self[boundary, count] = matrix_of(boundary, count)
        return self[boundary, count]


_MATRICES = _Kept()
_MAKERS = {"hertz": _hertz, "westergaard": _westergaard, "full": _full, "flowing": _flowing, "dense": _dense}


def main() -> None:
    rows: dict[tuple[str, float], list[Compared]] = {}
    for kind, known in answers():
        for tolerance in TOLERANCES:
            rows.setdefault((kind, tolerance), []).append(compared(known, tolerance))
    print("kind, residual: maps; largest error; bounds below the error; least and median bound over error; points below")
    for (kind, tolerance), some in rows.items():
        below = sum(one.pressure > one.said.pressure_error for one in some)
        points = sum(one.points > one.said.area_error for one in some)
        ratios = [one.ratio for one in some]
        print(f"{kind}, {tolerance:g}: {len(some)}; {max(one.pressure for one in some):.1e}; {below}; "
              f"{min(ratios):.3g}, {np.median(ratios):.3g}; {points}")  # fmt: skip


if __name__ == "__main__":
    main()
