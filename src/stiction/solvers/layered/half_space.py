"""Compute stresses in a half-space under a round contact with any smooth pressure.

The pressure has the Hankel transform P(k) = Integral_0^1 g(s) cos(k s) ds for contact radius 1, where k is the wavenumber and g
an even polynomial. With the depth z, the radius r, the Bessel functions J_n, zeta = z + i s, R = sqrt(r^2 + zeta^2) and w =
r/(R + zeta), the stresses are sums of the integrals

    H_mn = Integral_0^infinity k^m exp(-k z) J_n(k r) P(k) dk = Re Integral_0^1 g(s) K_mn(r, zeta) ds,
    K_1n = w^n (n R + zeta)/R^3,    K_2n = w^n [(n^2 - 1) R^2 + 3 n R zeta + 3 zeta^2]/R^5

(derivatives of Lipschitz's integral of J_n with respect to zeta). On the real axis the integrand is singular at s = r if z = 0.
Because g is a polynomial, the path of integration may leave the real axis. It starts at s = -i T, where T decreases with the
order of g, and follows a quarter of an ellipse to s = 1, where nodes are dense. The part on the imaginary axis contributes
nothing, because g is even. The integrand is equally smooth at the surface and at any depth.
"""

from functools import lru_cache

import numpy as np

from stiction.engine.compiled import kernel
from stiction.solvers.layered.sphere import value_of

_CLOSEST = 1e-9  # least radius, divided by the contact radius, because r = 0 would divide by zero
# Largest depth T of the path, and largest T times the number of coefficients of g, because g grows off the real axis.
_DEEPEST, _GROWTH = 0.35, 3.0


def integrals(g: np.ndarray, r: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return the stress integrals H_mn of this module at radii r (p,) and depths z (k,).

    The shape is (2, 4, k, p), for orders m = 1, 2 and n = 0 to 3. r and z are divided by the contact radius. g: coefficients of
    the pressure in orthonormal even polynomials, as `sphere.pressure` returns them.
    """
    s, weights = _path(min(_DEEPEST, _GROWTH / g.size))
    out = np.empty((2, 4, z.size, r.size))
    _add_up(s, weights * value_of(g, s), np.maximum(r, _CLOSEST), z, out)
    return out


@kernel
def _add_up(s, weighed, r, z, out):
    for i in range(z.size):
        for j in range(r.size):
            sums = np.zeros(8)
            for at in range(s.size):
                zeta = z[i] + 1j * s[at]
                R = np.sqrt(zeta * zeta + r[j] * r[j])
                w, inverse = r[j] / (R + zeta), 1.0 / R
                first = weighed[at] * inverse * inverse * inverse
                for n in range(4):
                    both = n * R + zeta
                    sums[n] += (first * both).real
                    sums[4 + n] += (first * inverse * inverse * ((n * n - 1) * R * R + 3.0 * zeta * both)).real
                    first *= w
            for n in range(4):
                out[0, n, i, j], out[1, n, i, j] = sums[n], sums[4 + n]


@lru_cache(maxsize=64)
def _path(depth: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the nodes s and weights ds of the complex integration path from s = -i `depth` to s = 1."""
    v, weights = np.polynomial.legendre.leggauss(int(60.0 + 9.0 / depth))
    v, weights = (v + 1.0) / 2.0, weights / 2.0
    left, step = np.pi / 2.0 * v**2, np.pi * v
    s = np.cos(left) - 1j * depth * np.sin(left)
    return s, weights * step * (np.sin(left) + 1j * depth * np.cos(left))
