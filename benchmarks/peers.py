"""What the engine is measured beside: the bare corrected model by scipy.integrate.quad, and the exponentials alone by NumPy."""

import itertools
import math
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from stiction.engine.regime import Regime
from stiction.engine.summation import _COUNTS
from stiction.laws.joining import states

REACH = 72.0  # z^2, beyond which the density is left out


class Asperity(NamedTuple):
    """One asperity as functions of u, from `first` contact to `last`, where it yields."""

    load: Callable
    slip_limited: Callable
    yield_limited: Callable
    displacement: Callable
    slope: Callable
    first: float
    last: float


def asperity(theta: float, lam: float, nu: float, k: float) -> Asperity:
    """docs/theory.md, sections 2 and 3, written down anew."""
    S = math.sqrt(6 * math.pi / theta)
    eta = math.sqrt(math.pi) * 18**0.25 * lam**0.25 / math.sqrt(theta)
    K_beta = 8 / 3 * (2 - nu) / (1 - nu)
    n, p, q = (1 - 2 * nu) / (2 * math.pi), 3 * (4 + nu) / 16, 9 * nu / 16
    d = p * p + q * q - p * q

    def load(u):
        return u**6 - S * u**3

    def slip_limited(u):
        return 4 * math.sqrt(max(2 * math.pi / theta * load(u) + 3 * (math.pi / theta) ** 2, 0) / K_beta)

    def yield_limited(u):
        P, strength = load(u), eta * u**4 / (math.pi * k)
        root = 4 * d * strength**2 - 3 * n**2 * (p + q) ** 2 * P**2
        return max((math.sqrt(root) - 3 * n * (p - q) * P) / (2 * d), 0.0) if root > 0 else 0.0

    first = (2 / 3 * S) ** (1 / 3)
    last = brentq(lambda u: u**3 - eta * u - S, first, 2 + 2 * S ** (1 / 3) + 2 * math.sqrt(eta), xtol=1e-15)
    return Asperity(
        load, slip_limited, yield_limited, lambda u: u**4 - 2 / 3 * S * u, lambda u: 4 * u**3 - 2 / 3 * S, first, last
    )


def kinks(one: Asperity, end: float) -> list[float]:
    """Where the smaller resistance changes, and where that of yield begins or ends, found by a scan."""
    scan = np.linspace(one.first, end, 25)
    sign = [one.slip_limited(u) < one.yield_limited(u) for u in scan]
    alive = [one.yield_limited(u) > 0 for u in scan]
    found = [
        brentq(lambda u: one.slip_limited(u) - one.yield_limited(u), a, b, xtol=1e-15)
        for a, b, s, t, on, still in zip(scan, scan[1:], sign, sign[1:], alive, alive[1:], strict=False)
        if s != t and on and still
    ]
    for a, b, on, still in zip(scan, scan[1:], alive, alive[1:], strict=False):
        while on != still and b - a > 1e-14 * b:
            middle = (a + b) / 2
            a, b = (middle, b) if (one.yield_limited(middle) > 0) == on else (a, middle)
        if on != still:
            found.append(b)
    return sorted(found)


def quad_loop(h: float, theta: float, lam: float, nu: float = 0.3, k: float = 2.8) -> tuple[float, float, float]:
    """Load, area and friction, clipped where the density is negligible and split at kinks."""
    one = asperity(theta, lam, nu, k)
    reach = math.sqrt(max(h, 0) ** 2 + REACH) - h
    end = one.last
    if one.displacement(end) > reach:
        end = brentq(lambda u: one.displacement(u) - reach, one.first, end, xtol=1e-15)
    edges = [one.first, *kinks(one, end), end]

    def weight(u):
        z = h + one.displacement(u)
        return math.exp(-z * z / 2) / math.sqrt(2 * math.pi) * one.slope(u)

    def integral(integrand):
        segments = [(a, b) for a, b in itertools.pairwise(edges) if b > a]
        return sum(quad(lambda u: integrand(u) * weight(u), a, b, epsabs=0, epsrel=1e-11, limit=200)[0] for a, b in segments)

    load, area = integral(one.load), integral(lambda u: u**4)
    friction = integral(lambda u: min(one.slip_limited(u), one.yield_limited(u)))
    eta = math.sqrt(math.pi) * 18**0.25 * lam**0.25 / math.sqrt(theta)
    z = h + one.displacement(one.last)
    upper, dense = math.erfc(z / math.sqrt(2)) / 2, math.exp(-z * z / 2) / math.sqrt(2 * math.pi)
    first_moment = dense - h * upper
    return load + 2 * eta * first_moment - 2 * math.pi / theta * upper, area + 2 * first_moment, friction


def nodes_a_point(regimes: Sequence[Regime], h: np.ndarray) -> float:
    """Exponentials of one evaluation, on average over laws and separations h (n,) one each: the nodes of all segments that have
    any weight."""
    total = 0
    for regime in regimes:
        ends = [states(regime, np.minimum(edge, 1e6))[:, 0] for edge in regime.edges.T]
        for left, right in itertools.pairwise(ends):
            nearest = np.maximum(h + left, 0.0) + np.minimum(h + right, 0.0)
            reach = np.sqrt(nearest**2 + REACH)
            length = np.minimum(h + right, reach) - np.maximum(h + left, -reach)
            total += np.sum(np.where(length > 0.0, np.where(length <= 1.0, _COUNTS[0], _COUNTS[1]), 0))
    return total / h.size


def seconds_of_exponential() -> float:
    """Processor time of one exponential among many by NumPy, in the processor's cache."""
    x, out, times = -np.linspace(0.0, 36.0, 8192), np.empty(8192), []
    for _ in range(20):
        start = time.thread_time()
        for _ in range(100):
            np.exp(x, out=out)
        times.append((time.thread_time() - start) / 100 / x.size)
    return min(times)
