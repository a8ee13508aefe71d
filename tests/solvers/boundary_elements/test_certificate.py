"""The certificate of a solution is never below its true error, on maps whose answer is known."""

import importlib.util
import math
from pathlib import Path

import numpy as np
import pytest

from stiction.solvers.boundary_elements.certificate import certify
from stiction.solvers.boundary_elements.compliance import Compliance, Film
from stiction.solvers.boundary_elements.measures import rms_step
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import FreeBoundary, MirroredBoundary, PeriodicBoundary
from stiction.solvers.boundary_elements.solve import solve_map

UNIT = (1.0, 1.0)


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


def script():
    path = Path(__file__).parents[3] / "validation" / "certificate.py"
    spec = importlib.util.spec_from_file_location("validation_certificate", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("kind", ("hertz", "westergaard", "full", "flowing", "dense"))
def test_the_certificate_is_never_below_the_true_error(kind):
    """200 maps in all, at three residuals, with answers that share neither transform nor solver with the package."""
    made, rows = script(), []
    for _, known in made.answers((kind,)):
        problem, pressure = known.problem, known.pressure
        gap = (known.matrix @ pressure.ravel()).reshape(pressure.shape) - problem.heights
        free = (pressure > 0.0) & (pressure < problem.hardness)
        gap -= gap[free].mean()
        rounding = 1e-10 * np.abs(problem.heights).max()
        assert np.abs(gap[free]).max() < rounding  # what is called an answer is one
        assert (
            gap[pressure <= 0.0].min(initial=0.0) > -rounding and gap[pressure >= problem.hardness].max(initial=0.0) < rounding
        )
        rows += [made.compared(known, tolerance) for tolerance in made.TOLERANCES]
    for row in rows:
        assert row.pressure <= row.said.pressure_error
        assert row.points <= row.said.area_error
    if kind != "hertz":  # maps that end have a loose bound
        assert np.median([row.ratio for row in rows]) < 1.3


def test_a_map_with_the_pressure_of_hertz_is_an_ellipsoid():
    made = script()
    (_, known) = next(made.answers(("hertz",)))
    y, x = np.meshgrid(*2 * [made._places(24)], indexing="ij")
    touch = known.pressure > 0.0
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y])
    fit = np.linalg.lstsq(terms[:, touch].T, known.problem.heights[touch], rcond=None)[0]
    rest = known.problem.heights - np.tensordot(fit, terms, 1)
    assert np.abs(rest).max() < 0.02 * np.ptp(known.problem.heights)  # what the width of points leaves


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
