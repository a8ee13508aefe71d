"""An adhesive asperity that is elastic (JKR) until its mean pressure reaches the hardness, then plastic.

Roy Chowdhury & Ghosh 1994, as the 2015 paper uses it in eqs (1)-(4), in the units of docs/theory.md: displacements over
sigma, loads over K R^(1/2) sigma^(3/2), areas over pi R sigma.
"""

import math

import numpy as np

from ..compiled import formula


def hardness_group(theta, lam):
    """eta = pi H sqrt(R/sigma) / K = sqrt(pi) 18^(1/4) lambda^(1/4) theta^(-1/2) (half the 7.3 of eq 1). Arrays."""
    return math.sqrt(math.pi) * 18.0**0.25 * lam**0.25 / np.sqrt(theta)


def stiffness_group(nu):
    """K beta = (8/3)(2 - nu)/(1 - nu), when the bodies are alike or one of them is rigid. Arrays."""
    return 8.0 / 3.0 * (2.0 - nu) / (1.0 - nu)


@formula
def largest_root(a, c):
    """The largest real root of v^3 + a v - c = 0, c > 0: Newton from above."""
    v = c ** (1.0 / 3.0) + math.sqrt(max(-a, 0.0))
    for _ in range(100):
        step = (v * (v * v + a) - c) / (3.0 * v * v + a)
        v -= step
        if step <= 1e-15 * v:
            break
    return v


@formula
def plastic_load(w, theta, eta):
    """P = 2 eta w - 2 pi/theta (second integrand of eq 1): hardness over twice the truncated area, less 2 pi gamma R."""
    return 2.0 * eta * w - 2.0 * math.pi / theta


@formula
def plastic_area(w):
    """2 w: contact area over pi R sigma."""
    return 2.0 * w
