"""Sum asperity laws at many separations by Taylor series about a few separations, for Gaussian heights.

At the mean separation h, an asperity of height z has the displacement w = z - h (all in units of sigma). The height density at
a separation h + d is exp(-(z + d)^2/2) = exp(-z^2/2) exp(-d z) exp(-d^2/2), up to a constant. The sum of a law at h + d is
therefore exp(-d^2/2) times a power series in d, whose coefficients are sums at h of the values of the law times (-z)^k/k!.
These coefficients are summed once for all separations within half a step of h, at the integration nodes for h.
"""

import math

import numpy as np

from stiction.engine.compiled import engine_kernel
from stiction.engine.heights import gaussian_density
from stiction.engine.sum_kernels import LONGEST

# Distance between neighbouring series in units of sigma, and number of terms in a series. |d z| is at most 13/8 where the
# density is not negligible (h up to 10), and the first omitted term is below 1e-16 of the sum.
STEP, TERMS = 0.25, 22
_FARTHEST = 10.0
# Series save time for _MANY sums or more, if each series is used for at least _EACH sums on average.
_MANY, _EACH = 1000, 10


def series_for(h: np.ndarray, law: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Choose expansion points for Taylor series that replace m sums over asperity heights.

    h (m,): mean separation of each sum, in units of sigma. law (m,): index of the law (parameter set) that is summed. Returns
    the separations (s,) and law indices (s,) of s series, and for each sum the index (m,) of its series. Returns None if
    computing each sum separately takes less time, or if a separation is beyond 10 sigma.
    """
    if h.size < _MANY or not np.abs(h).max() <= _FARTHEST:
        return None
    step = np.rint(h / STEP).astype(np.int64)
    first, last = step.min(), step.max()
    steps = int(last - first) + 1
    place = law * steps + (step - first)
    needed = np.zeros((int(law.max()) + 1) * steps, dtype=bool)
    if needed.size > h.size:
        return None
    needed[place] = True
    every = np.flatnonzero(needed)
    if _EACH * every.size > h.size:
        return None
    return (first + every % steps) * STEP, every // steps, (np.cumsum(needed) - 1)[place]


@engine_kernel
def expand(h, shape, evaluated, out):
    """Store the coefficients of s Taylor series, each about its mean separation h (s,), in `out` (s, TERMS, 5).

    The last axis contains the fraction touching, load, area, slip-limited and yield-limited resistance. h: in units
    of sigma. shape: parameters of the height density. evaluated: the fields of `nodes.Evaluated`, the values of the laws at
    integration nodes.
    """
    owner, counts, weights, states = evaluated
    out[:] = 0.0
    for row in range(owner.size):
        state, weight, separation, series = states[row], weights[row], h[owner[row]], out[owner[row]]
        for node in range(counts[row]):
            z = separation + state[node]
            term = weight[node] * state[LONGEST + node] * gaussian_density(z, shape)
            load, area = state[2 * LONGEST + node], state[3 * LONGEST + node]
            slip_limited, yield_limited = state[4 * LONGEST + node], state[5 * LONGEST + node]
            for k in range(TERMS):
                series[k, 0] += term
                series[k, 1] += term * load
                series[k, 2] += term * area
                series[k, 3] += term * slip_limited
                series[k, 4] += term * yield_limited
                term *= -z / (k + 1)


@engine_kernel
def read_series(d, number, coefficients, out):
    """Store m sums, each exp(-d^2/2) times a power series in d, in `out` (m, 5).

    d (m,): separation of each sum minus separation of its series, in units of sigma. number (m,): index of the series.
    coefficients (s, TERMS, 5): coefficients that `expand` computed. The five values are fraction touching, load, area,
    slip-limited and yield-limited resistance.
    """
    for i in range(d.size):
        series, x = coefficients[number[i]], d[i]
        touching = load = area = slip_limited = yield_limited = 0.0
        for k in range(TERMS - 1, -1, -1):
            touching = touching * x + series[k, 0]
            load = load * x + series[k, 1]
            area = area * x + series[k, 2]
            slip_limited = slip_limited * x + series[k, 3]
            yield_limited = yield_limited * x + series[k, 4]
        factor = math.exp(-0.5 * x * x)
        out[i, 0], out[i, 1], out[i, 2] = factor * touching, factor * load, factor * area
        out[i, 3], out[i, 4] = factor * slip_limited, factor * yield_limited
