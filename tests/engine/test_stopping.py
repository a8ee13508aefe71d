"""Long computations stop at the next kernel or the next step of a solver."""

import math

import numpy as np
import pytest

import stiction as st
from cases import SILICON_ON_SILICON
from stiction.engine.stopping import raise_if_stopped, stopped_by
from stiction.engine.summation import in_threads
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.minimise import shear
from stiction.solvers.shear.operators import PeriodicShear

SIDE = (1.0, 1.0)


def _solve():
    st.solve(SILICON_ON_SILICON, load="1 N", model="greenwood_williamson_1966")


def _press():
    heights = np.random.default_rng(1).normal(0.0, 1e-3, (16, 16))
    solve_map(heights, SIDE, modulus=1.0, loads=[1e-4], periodic=True)


def _shear():
    operator = PeriodicShear(ShearCompliance((HalfSpace(1.0, 0.0), HalfSpace(math.inf, 0.0))), (16, 16), SIDE)
    strength, zero = np.full((16, 16), 1e-3), np.zeros((2, 16, 16))
    shear(operator, strength, zero + 1e-4, zero, tolerance=1e-6, most=50)


def _in_threads():
    in_threads(lambda part: None, range(10), threads=2)


@pytest.mark.parametrize("work", [_solve, _press, _shear, _in_threads])
def test_each_computation_asks_whether_it_may_go_on(work):
    asked = []

    def second():
        asked.append(True)
        if len(asked) > 1:
            raise KeyboardInterrupt

    work()  # nobody stops it
    with stopped_by(second), pytest.raises(KeyboardInterrupt):
        work()
    assert len(asked) == 2
    raise_if_stopped()  # the check ended with its context
    assert len(asked) == 2
