"""The certificate of a solution is never below its true error, on maps whose answer is known."""

import math

import numpy as np
import pytest

from stiction.solvers.boundary_elements.certificate import certify
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.measures import rms_step
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import FreeBoundary, MirroredBoundary, PeriodicBoundary
from stiction.solvers.boundary_elements.solve import solve_map

UNIT = (1.0, 1.0)
ROUGH, NEARLY = 1e-1, 1e-3  # tolerances of the solutions that are certified


def drawn_problem(seed):
    """A map of any kind, boundary, film, hardness and pressure, from light contact to far beyond full contact."""
    rng = np.random.default_rng(seed)
    count = int(rng.choice([24, 32, 45]))
    y, x = np.arange(count)[:, None] / count, np.arange(count) / count
    heights, hurst = np.zeros((count, count)), rng.uniform(0.3, 1.0)
    for m, n in ((m, n) for m in range(-5, 6) for n in range(6) if 1 < m * m + n * n <= 25):
        phase = 2.0 * math.pi * (m * y + n * x) + rng.uniform(0.0, 7.0)
        heights += rng.normal() * math.hypot(m, n) ** -(1.0 + hurst) * np.cos(phase)
    heights /= heights.std()
    skewed = (heights, np.exp(0.7 * heights), -np.exp(0.7 * heights), np.minimum(heights, 0.3) + 0.02 * heights)
    heights = 0.01 * skewed[seed % 4]
    film = Film(rng.uniform(0.005, 0.1), 10.0 ** rng.uniform(-1.0, 1.0), 0.4, rng.choice([1.0, math.inf]), 0.3)
    compliance = Compliance(1.0, film if rng.random() < 0.3 else None)
    boundary = (PeriodicBoundary, MirroredBoundary, FreeBoundary)[rng.integers(3)]
    mean = rms_step(heights) * count * 10.0 ** rng.uniform(-3.0, 0.7) / compliance.near
    hardness = mean * 10.0 ** rng.uniform(0.1, 1.5) if rng.random() < 0.4 else math.inf
    return Problem(boundary(compliance, heights.shape, UNIT), heights, mean, hardness, rms_step(heights))


def size(problem, pressure):
    return math.sqrt(float((pressure * problem.displacement(pressure)).sum()))


@pytest.mark.parametrize("first", range(0, 200, 20))
def test_the_certificate_is_never_below_the_true_error(first):
    """The true answer by a residual of 1e-10, from another start; without it the two would share their way."""
    ratios = []
    for seed in range(first, first + 20):
        problem = drawn_problem(seed)
        ramp = problem.mean * (0.5 + np.arange(problem.heights.size) / problem.heights.size).reshape(problem.heights.shape)
        exact = minimise(problem, ramp, tolerance=1e-10, most=2000)
        assert exact.converged
        touches = exact.pressure > 0.0
        for tolerance in (ROUGH, NEARLY):
            found = minimise(problem, np.full(problem.heights.shape, problem.mean), tolerance=tolerance, most=200)
            said = certify(problem, found)
            assert found.converged
            error = size(problem, found.pressure - exact.pressure) / size(problem, found.pressure)
            assert error <= said.pressure_error + 1e-9
            points = np.count_nonzero(found.pressure)
            assert abs(points - np.count_nonzero(touches)) <= said.area_error * points
            if problem.displacement.inverts and error > 1e-9:
                ratios.append(said.pressure_error / error)
    assert np.median(ratios) < 2.0


def test_the_certificate_of_closed_forms():
    """Full contact: p = P + C^-1 h. A start that touches everywhere, evenly: its error is that of leaving the waves out."""
    count = 32
    wave = np.cos(2.0 * math.pi * np.arange(count) / count) * np.ones((count, 1))
    problem = Problem(PeriodicBoundary(Compliance(2.0), wave.shape, UNIT), 1e-3 * wave, 1.0, math.inf, rms_step(1e-3 * wave))
    exact = 1.0 + 1e-3 * 2.0 * math.pi * wave  # Johnson 1985, eq. 13.6: p* = pi E* Delta/lambda, here of height Delta
    found = minimise(problem, np.full(wave.shape, 1.0), tolerance=1e-6, most=50)
    assert found.pressure == pytest.approx(exact, abs=2e-8)
    assert certify(problem, found).pressure_error < 1e-6
    off = minimise(problem, exact + 1e-3 * wave, tolerance=1e-6, most=0)
    error = 1e-3 / (2e-3 * math.pi + 1e-3)  # over that of its own pressure
    said = certify(problem, off)
    assert said.pressure_error == pytest.approx(error, rel=1e-5) and said.overlap == 0.0
    assert said.opening == pytest.approx(1e-3 / (2.0 * math.pi), rel=1e-6)


def test_what_did_not_converge_says_so_with_its_error():
    problem = drawn_problem(1)
    loads = [problem.mean]
    (rough,) = solve_map(problem.heights, UNIT, modulus=1.0, loads=loads, periodic=True, most_steps=1)
    (fine,) = solve_map(problem.heights, UNIT, modulus=1.0, loads=loads, periodic=True)
    assert "not_converged" in {warning.quantity for warning in rough.validity_warnings}
    assert rough.pressure_error > 1e-2 > 1e-4 > fine.pressure_error
    assert abs(rough.points - fine.points) <= rough.area_error * rough.points
    assert rough.overlap > fine.overlap >= 0.0
