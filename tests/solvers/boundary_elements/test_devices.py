"""Maps solved through the array API standard give what NumPy gives, in each library that is installed."""

import math
import sys
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from refusals import refusal
from stiction.solvers.boundary_elements import arrays, operators
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.generate import gaussian_surface, with_slope
from stiction.surfaces.targets import SelfAffine

SIZE = (2.0 / 3.0, 1.0)
LOADS = [1e-3, 3e-3]
TO_TOLERANCE = 1e-11  # of the residual: steps are in single precision, which each library rounds in its own way
BOUNDARIES = {
    "periodic": {"periodic": True},
    "mirrored": {"periodic": False},
    "free": {"periodic": False, "free": True},
}
BODIES = {
    "elastic": {},
    "hard": {"hardness": 0.03},
    "film": {"modulus": math.inf, "film": Film(0.03, 0.3, 0.4, 9.0, 0.3)},
    "menisci": {"menisci": Menisci(0.01, 0.001)},
}
THE_SAME = ("area", "area_pixels", "separation", "mean_gap", "plastic_area", "pull", "overlap", "points", "perimeter")


@cache
def rough(rows, columns):
    target = SelfAffine(hurst=0.8, rolloff=0.16, shortest=8.0 / columns, deviation=0.01)
    return with_slope(gaussian_surface((rows, columns), SIZE, target, seed=1), 0.1).heights


def solved(heights, boundary, bodies, **how):
    arguments = {"modulus": 1.0, "tolerance": TO_TOLERANCE, **BOUNDARIES[boundary], **BODIES[bodies], **how}
    return solve_map(heights, SIZE, loads=LOADS, **arguments)


@cache
def by_numpy(rows, columns, boundary, bodies):
    return solved(rough(rows, columns), boundary, bodies)


@pytest.fixture(params=["numpy", "array_api_strict", "torch"])
def device(request, monkeypatch):
    """A library. NumPy's arrays go the way of all others here, which needs no package that may be missing."""
    if request.param != "numpy":
        pytest.importorskip(request.param, reason=f"{request.param} is not installed: maps are not solved with it")
        return request.param
    for module in (arrays, operators):
        monkeypatch.setattr(module, "is_numpy", lambda array: False)
    return None


@pytest.mark.parametrize("bodies", BODIES)
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_a_library_gives_what_numpy_gives(device, boundary, bodies):
    for known, found in zip(
        by_numpy(64, 96, boundary, bodies), solved(rough(64, 96), boundary, bodies, device=device), strict=True
    ):
        assert type(found.pressure) is np.ndarray and found.pressure.dtype == np.float64
        assert not {"not_converged", "load_error"} & {warning.quantity for warning in found.validity_warnings}
        assert found.pressure == pytest.approx(known.pressure, rel=0.0, abs=1e-10 * known.pressure.max())
        for name in THE_SAME:
            assert getattr(found, name) == pytest.approx(getattr(known, name), rel=1e-10, abs=1e-14), name
        assert found.stiffness == pytest.approx(known.stiffness, rel=1e-6)  # of single precision
        assert found.pressure_error < 2.0 * known.pressure_error  # on maps with ends little but rounding


@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_a_start_from_coarser_points_is_the_same(device, boundary):
    """This map is solved on every second point first."""
    (known, _), (found, _) = (
        by_numpy(192, 288, boundary, "hard"), solved(rough(192, 288), boundary, "hard", device=device),
    )  # fmt: skip
    assert found.pressure == pytest.approx(known.pressure, rel=0.0, abs=1e-10 * known.pressure.max())


def test_devices_that_are_not_there_get_a_line(monkeypatch):
    with refusal("device", "jax", "torch", "cupy"):
        solved(rough(64, 96), "periodic", "elastic", device="jax:gpu")
    monkeypatch.setitem(sys.modules, "cupy", None)
    with refusal("device", "cupy"):
        solved(rough(64, 96), "periodic", "elastic", device="cupy")
    monkeypatch.setitem(sys.modules, "array_api_compat", None)
    with refusal("device", "array_api_compat", "stiction[device]"):
        solved(rough(64, 96), "periodic", "elastic", device="torch")


def test_a_device_that_its_library_lacks_gets_a_line():
    pytest.importorskip("torch", reason="torch is not installed: maps are not solved with it")
    with refusal("device", "torch:nowhere") as caught:
        solved(rough(64, 96), "periodic", "elastic", device="torch:nowhere")
    assert "\n" not in str(caught.value)


def test_factors_are_copied_for_every_device(monkeypatch):
    monkeypatch.setattr(operators, "like", lambda factors, values: (factors, values.device))
    kernel = operators._Kernel(np.ones((2, 2)))
    arrays_on = [SimpleNamespace(dtype=np.dtype(float), device=place) for place in ("cuda:0", "cuda:1", "cuda:0")]
    assert [kernel.like(values)[1] for values in arrays_on] == ["cuda:0", "cuda:1", "cuda:0"]
