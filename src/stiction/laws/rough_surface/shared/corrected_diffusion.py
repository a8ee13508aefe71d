"""Solve Persson's diffusion of pressure with a rate that depends on the area in contact.

Let V be the variance of the pressure at a point, V_c the variance in full contact at the same resolution, and A the contact
area divided by the nominal area, A = erf(p / sqrt(2 V)). Persson (2001) has dV = dV_c. Corrected theories have

    dV/dV_c = S(A),   V = 0 at V_c = 0,   S(1) = 1,   at the end V_c = (E* h')^2 / 4

(p: nominal pressure, E*: contact modulus, h': root mean square gradient, S: factor of the theory). V_c plays the role of time,
so only h' of the whole spectrum is needed. With q = p / sqrt(2 V), V = p^2 / (2 q^2), the equation becomes an integral,

    1 / (4 x^2) = J(q) = Int_q^inf dt / (t^3 S(erf t)),   x = p / (E* h'),   A = erf(q).

S = 1 gives Persson's result, q = sqrt(2) x. J decreases with q. Beyond q = 6, where erf is 1 in double precision, J = 1 / (2
q^2).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.special import erf

from stiction.contact.indices import Groups
from stiction.surfaces.theory.moments import reduced_pressure

Rate = Callable[[np.ndarray], np.ndarray]

# A note for the records of models that use this gradient.
GRADIENT = "h' is that of an isotropic Gaussian surface whose summits have this R and N: h'^2 = sqrt(3) / (64 N R^2)."

_FULL = 6.0  # erf is 1 from here on
_LIGHTEST = 1e-9  # below this q the rate equals that of zero contact area, to rounding
_PANELS, _NODES, _STEPS = 120, 16, 8


@dataclass(frozen=True)
class _Table:
    """Hold a table of ln q and of J(q), the integral of 1/(t^3 S(erf t)) over t from q to infinity.

    S: factor of a theory, a function of the relative contact area. q = p / sqrt(2 V), with the nominal pressure p and the
    variance V of the pressure; q grows from light to full contact.
    """

    log_q: np.ndarray
    J: np.ndarray


def area_share(pressure: np.ndarray, rate: Rate) -> np.ndarray:
    """Return the ratio of contact area to nominal area at the reduced pressures p / (E* h') >= 0.

    pressure: array of any shape; p: nominal pressure, E*: contact modulus, h': root mean square gradient. rate: the function
    S(A/A_n) = dV/dV_c of arrays, with the contact area A, the nominal area A_n, the variance V of the pressure and its value
    V_c in full contact; S > 0 and S(1) = 1. Pass the same function object each time, because its table is cached.
    """
    table = _table(rate)
    goal = np.asarray(pressure, dtype=float)
    x = np.clip(goal, 1e-150, _FULL)
    wanted = 1.0 / (4.0 * x * x)
    light, between = wanted > table.J[0], (wanted <= table.J[0]) & (wanted > table.J[-1])
    q = math.sqrt(2.0) * x  # S = 1, beyond _FULL
    q[light] /= math.sqrt(float(rate(np.zeros(1))[0]))
    q[between] = _solved(wanted[between], table, rate)
    return np.where(goal > 0.0, erf(q), 0.0)


def _solved(wanted: np.ndarray, table: _Table, rate: Rate) -> np.ndarray:
    """Return the lower limits q (n,) at which the integral J(q) equals `wanted` (n,).

    J(q) is the integral of 1/(t^3 S(erf t)) over t from q to infinity. table: table of J. rate: the function S. The
    equation is solved by Newton's method in ln q and ln J.
    """
    panel = np.searchsorted(-table.J, -wanted)  # J falls along the table: index of the first J <= wanted
    log_q = np.interp(np.log(wanted), np.log(table.J[::-1]), table.log_q[::-1])
    for _ in range(_STEPS):
        J = table.J[panel] + _integral(log_q, table.log_q[panel], rate)
        q = np.exp(log_q)
        log_q = log_q + np.log(J / wanted) * J * q * q * rate(erf(q))
    return np.exp(log_q)


def _integral(low: np.ndarray, high: np.ndarray, rate: Rate) -> np.ndarray:
    """Return the integral of 1/(t^3 S(erf t)) over t by Gaussian quadrature, where S is the function `rate`.

    low, high: natural logarithms of the limits of t, (n,).
    """
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = (high - low) / 2.0
    t = np.exp((low + half)[:, None] + half[:, None] * nodes)
    return half * np.sum(weights / (t * t * rate(erf(t))), axis=1)


@cache
def _table(rate: Rate) -> _Table:
    log_q = np.linspace(math.log(_LIGHTEST), math.log(_FULL), _PANELS + 1)
    parts = _integral(log_q[:-1], log_q[1:], rate)
    J = np.concatenate([np.cumsum(parts[::-1])[::-1], [0.0]]) + 1.0 / (2.0 * _FULL * _FULL)
    return _Table(log_q, J)


def area_per_asperity(load: np.ndarray, groups: Groups, share: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Return the contact area per asperity (n, H), in units of pi R sigma, at H loads of n contacts; it is 0 under tension.

    load: per asperity, in units of K R^(1/2) sigma^(3/2). share: function that returns the ratio of contact area to nominal
    area at the reduced pressures p / (E* h'), with the contact modulus E* and the root mean square gradient h'.
    """
    density = groups.roughness_parameter[:, None]
    return share(reduced_pressure(np.maximum(load, 0.0), density)) / (math.pi * density)
