"""Compute the stresses in a half-space below a pressed and sheared Hertz contact, and its first yield: Hamilton 1983.

Lengths are in units of the contact radius a, stresses in units of the largest pressure p0. Hamilton's equations divide by
powers of the distance r from the axis and lose accuracy near it. Here they are rearranged in oblate spheroidal coordinates M
>= 0, 0 <= N <= 1, with the depth z:

    z = M N,   r^2 = (1 + M^2)(1 - N^2)

All these powers cancel in the new coordinates, so the formulas are accurate everywhere. The contact is at M = 0, the free
surface at N = 0, the axis at N = 1.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

Stress = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def stress(x: ArrayLike, y: ArrayLike, z: ArrayLike, mu: ArrayLike, nu: ArrayLike) -> Stress:
    """Return the six stresses (x, y, z, xy, yz, xz) below a Hertz contact under normal and tangential force, in units of p0.

    The contact carries the pressure p0 sqrt(1 - r^2) and a traction along +x of mu times this pressure; r: distance from
    the axis. x, y, z: coordinates of a point, with the depth z >= 0. Lengths are in units of the contact radius. mu: ratio
    of tangential to normal force, any sign. nu: Poisson's ratio, 0 to 0.5. All arguments are broadcast. Tension is
    positive. Source: Hamilton (1983); `pressed` and `dragged` are the two parts.
    """
    normal, tangential = pressed(x, y, z, nu), dragged(x, y, z, nu)
    xx, yy, zz, xy, yz, xz = (normal_part + mu * other for normal_part, other in zip(normal, tangential, strict=True))
    return xx, yy, zz, xy, yz, xz


def pressed(x: ArrayLike, y: ArrayLike, z: ArrayLike, nu: ArrayLike) -> Stress:
    """Return the six stresses (x, y, z, xy, yz, xz) in a half-space under the pressure p0 sqrt(1 - r^2) alone, in units of p0.

    x, y, z: coordinates of a point, with the depth z >= 0. r: distance from the axis. Lengths are in units of the contact
    radius. nu: Poisson's ratio. All arguments are broadcast. Tension is positive. Source: Hamilton (1983), the stresses of the
    normal load. In the cylindrical coordinates r, theta, z they agree with Huber (1904).
    """
    x, y, z, nu = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (x, y, z, nu)))
    M, N, S, phi, cos, sin = _spheroidal(x, y, z)
    m = 1.0 + M * M
    spread = (1.0 - 2.0 * nu) / 3.0 * (1.0 + N + N * N) / ((1.0 + N) * m)  # (1 - 2 nu)(1 - N^3)/(3 r^2)
    sink = (1.0 + nu) * M * phi
    radial = spread + N * N * N / S + N * ((1.0 - nu) * M * M / m + sink - 2.0)
    hoop = -spread - N * (2.0 * nu + (1.0 - nu) * M * M / m - sink)
    shear = -np.hypot(x, y) * N * N * M / (S * m)
    return (
        radial * cos * cos + hoop * sin * sin,
        radial * sin * sin + hoop * cos * cos,
        -N * N * N / S,
        (radial - hoop) * cos * sin,
        shear * sin,
        shear * cos,
    )


def dragged(x: ArrayLike, y: ArrayLike, z: ArrayLike, nu: ArrayLike) -> Stress:
    """Return the stresses (x, y, z, xy, yz, xz) in a half-space under the traction q0 sqrt(1 - r^2) along +x, in units of q0.

    x, y, z: coordinates of a point, with the depth z >= 0. r: distance from the axis. Lengths are in units of the contact
    radius. nu: Poisson's ratio. All arguments are broadcast. Tension is positive. Source: Hamilton (1983), the stresses of
    the tangential load.
    """
    x, y, z, nu = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (x, y, z, nu)))
    M, N, S, phi, cos, sin = _spheroidal(x, y, z)
    m = 1.0 + M * M
    b = M / (12.0 * m * m)
    g = phi / 4.0 - b * (3.0 * M * M + 5.0)
    E = 4.0 * (1.0 - 2.0 * nu)
    e = E / ((1.0 + N) * (1.0 + N))
    # In r, theta, z: sigma_r = x radial, sigma_theta = x hoop, tau_r,theta = y twist.
    radial = b * (e - 12.0 * M * M * (1.0 - N * N) / S) - (4.0 + nu) * g
    hoop = b * (E - e) - 3.0 * nu * g
    twist = b * e + (2.0 - nu) * g
    along = 1.5 * M * N * phi - N * (3.0 * M**4 + M * M * N * N + 4.0 * M * M + 2.0 * N * N) / (2.0 * m * S)  # tau_xz at y = 0
    # The difference of tau_xz at x = 0 and at y = 0, so that no angle is needed on the axis.
    across = -M * M * N * (1.0 - N * N) / (m * S)
    return (
        x * (radial * cos * cos + (hoop - 2.0 * twist) * sin * sin),
        x * (radial * sin * sin + hoop * cos * cos + 2.0 * twist * sin * sin),
        -x * M * N * N / (m * S),
        y * ((radial - hoop) * cos * cos + twist * (cos * cos - sin * sin)),
        across * cos * sin,
        along - across * sin * sin,
    )


def von_mises(stress: Stress) -> np.ndarray:
    """Return the von Mises stress; a material yields where it reaches the yield stress of a tensile test.

    stress: the six components (x, y, z, xy, yz, xz); the result has their unit and shape.
    """
    x, y, z, xy, yz, xz = stress
    return np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3.0 * (xy * xy + yz * yz + xz * xz))


def first_yield(mu: float, nu: float) -> tuple[float, tuple[float, float]]:
    """Return p0/Y and the point (x, z) at which a sheared Hertz contact first yields (von Mises).

    p0: largest pressure; Y: yield stress. mu: ratio of tangential to normal force, 0 or more. nu: Poisson's ratio, 0 to
    0.5. x, z: in units of the contact radius; x < 0 is the trailing side, z the depth. The point is in the plane y = 0,
    where the stress is always largest. p0/Y is accurate to 1e-12.
    """
    # The grid includes the trailing edge, where the stress has a cusp, and the axis.
    x, z = np.linspace(-1.1, 1.1, 221), np.linspace(0.0, 0.8, 81)
    coarse = von_mises(stress(x[:, None], 0.0, z, mu, nu))
    index = np.unravel_index(coarse.argmax(), coarse.shape)
    best_x, best_z, least = least_over(
        lambda x, z: -von_mises(stress(x, 0.0, z, mu, nu)), x[index[0]], z[index[1]], x[1] - x[0], z[1] - z[0]
    )
    return float(-1.0 / least), (float(best_x), float(best_z))


def least_over(
    function: Callable, x: ArrayLike, z: ArrayLike, reach_x: float, reach_z: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the minimum of function(x, z) near each point (x, z); return three arrays: x, z and value at the minimum.

    function: takes arrays and returns an array of their shape. x, z: arrays that are broadcast; z stays >= 0. Grids around
    the best point are refined, starting with the size reach_x by reach_z. The point is accurate to 1e-7 at best, the value
    to the square of this.
    """
    x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
    step_x, step_z = (steps.ravel() for steps in np.meshgrid((-1.0, 0.0, 1.0), (-1.0, 0.0, 1.0)))
    while max(reach_x, reach_z) > 1e-7:
        near_x, near_z = x[..., None] + reach_x * step_x, np.maximum(z[..., None] + reach_z * step_z, 0.0)
        best = function(near_x, near_z).argmin(axis=-1)[..., None]
        x, z = (np.take_along_axis(near, best, axis=-1)[..., 0] for near in (near_x, near_z))
        reach_x, reach_z = 0.6 * reach_x, 0.6 * reach_z
    return x, z, function(x[..., None], z[..., None])[..., 0]


def _spheroidal(x, y, z):
    """Return M, N, S = M^2 + N^2, arctan(1/M), and cosine and sine of the angle around the axis (1 and 0 on the axis).

    M and N are the oblate spheroidal coordinates of the point x, y, z, with z = M N and r^2 = (1 + M^2)(1 - N^2); r:
    distance from the axis. Lengths are in units of the contact radius. At the edge of the contact S is returned as 1, not
    0.
    """
    r = np.hypot(x, y)
    A = (r - 1.0) * (r + 1.0) + z * z
    S = np.hypot(A, 2.0 * z)
    larger = np.sqrt((S + np.abs(A)) / 2.0)  # of M and N; their product is z
    smaller = np.divide(z, larger, out=np.zeros_like(z), where=larger > 0.0)
    M, N = np.where(A >= 0.0, larger, smaller), np.where(A >= 0.0, smaller, larger)
    cos = np.divide(x, r, out=np.ones_like(r), where=r > 0.0)
    sin = np.divide(y, r, out=np.zeros_like(r), where=r > 0.0)
    # At the edge M = N = S = 0. Every term that is divided by S vanishes there, so that S = 1 gives the right value.
    return M, N, np.where(S > 0.0, S, 1.0), np.arctan2(1.0, M), cos, sin
