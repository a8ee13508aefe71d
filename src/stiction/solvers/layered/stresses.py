"""Compute stresses in a film and in the body below it, under a pressed and dragged sphere.

The pressure is taken from the frictionless contact (`sphere`). The traction is proportional to it, as in Hamilton (1983) for a
half-space. Both have the same Hankel transform P(k), and a wave k produces the amplitudes of `waves` at every depth. Let s_xx
and s_yy be the stresses along and across a wave. Averaged over all directions, the pressure produces

    s_zz = <s_zz>_0,  s_rz = <s_xz>_1,  s_rr, s_tt = <s_xx + s_yy>_0/2 -+ <s_xx - s_yy>_2/2,  <f>_n = Int f k P(k) J_n(k r) dk

with the Bessel functions J_n. The traction has the component cos(phi) along a wave in the direction phi and -sin(phi) across
it. It produces cos(theta) or sin(theta) times the sums in `_dragged` (theta: angle from the direction of the traction).
Stresses in the film are the stresses of a half-space (`half_space`) plus the part that the interface reflects. The reflected
part falls as exp(-k (2 t - z)), so that both parts are accurate at the surface too. Stresses in the body are computed by a
single transform. Tension is positive.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from stiction.solvers.layered.compliance import Pair
from stiction.solvers.layered.half_space import integrals
from stiction.solvers.layered.sphere import gauss, pressure, transform
from stiction.solvers.layered.waves import CoatedBody, Waves, body_function, film_function, waves

# Wavenumbers k t at which integrals are split, because amplitudes are smooth between them.
_ENDS = (0.0, 0.03, 0.1, 0.3, 0.8, 2.0, 4.5)
# For k r below this, the Bessel functions of orders 2 and 3 are computed by their series.
_SMALL = 0.05


class Radial(NamedTuple):
    """Store stresses (n, m) at depths (n,) and radii (m,) in cylindrical coordinates, divided by the mean pressure.

    pressed: (rr, tt, zz, rz) due to the pressure. dragged: (rr, tt, zz, rz, rt, tz) due to a traction of the same size in the
    direction x; the first four are to be multiplied by cos(theta), rt and tz by sin(theta). theta: angle from x. r, t, z:
    radial, tangential and depth direction.
    """

    pressed: tuple[np.ndarray, ...]
    dragged: tuple[np.ndarray, ...]


class Stresses:
    """Compute the stresses in one coated body under a sphere with contact radius a.

    pair: layers of the two bodies in contact. body: elastic constants of the coated body whose stresses are computed; it must
    be one of the layers in pair. radius: a divided by the film thickness, at most 1000. reach: largest value of wavenumber
    times film thickness in the integrals; the relative error of the film's contribution is exp(-reach). Lengths are divided by
    a and stresses by the mean pressure.
    """

    def __init__(self, pair: Pair, body: CoatedBody, radius: float, reach: float = 36.0):
        self.body, self.thickness = body, 1.0 / radius
        self._g = pressure(pair, radius)
        x, weights = _nodes(radius, reach)
        self._k = radius * x
        self._waves = waves(x, body)
        self._weights = radius * weights * self._k * transform(self._g, self._k)

    def in_film(self, r: np.ndarray, z: np.ndarray) -> Radial:
        """Return the stresses in the film at radii r (m,) and depths z (n,) from 0 to its thickness.

        Radii and depths are divided by the contact radius.
        """
        near = integrals(self._g, r, z)
        nu, depth = self.body.nu, z[:, None]

        def of_half_space(constant: float, linear: float, order: int) -> np.ndarray:
            return constant * near[0, order] + linear * depth * near[1, order]

        half = _half_space(nu)
        sent_back = self._transformed(r, z, nu, film_function, _across_film)
        return _assembled(lambda name, order: of_half_space(*half[name], order) + sent_back(name, order))

    def in_body(self, r: np.ndarray, z: np.ndarray) -> Radial:
        """Return the stresses in the body at radii r (m,) and at depths z (n,) of at least the film thickness.

        Radii and depths are divided by the contact radius; depths are measured from the surface of the film.
        """
        return _assembled(self._transformed(r, z, self.body.nu_below, body_function, _across_body))

    def _transformed(self, r, z, nu: float, function: Callable, across: Callable) -> Callable:
        """Return a function of (name, order) that returns the Hankel transform of a stress amplitude, an array (n, m).

        name: name of the amplitude f. The transform of order n is the integral of f k P(k) J_n(k r) over the wavenumber k, with
        the pressure's transform P(k). r (m,), z (n,): radii and depths divided by the contact radius. nu: Poisson's ratio at
        these depths. function: returns the stress function of all waves at a depth. across: returns their antiplane stresses at
        a depth.
        """
        F = np.stack([function(self._waves, depth / self.thickness) for depth in z], axis=2)  # (3, 2, n, waves)
        amplitudes = _amplitudes(F, nu)
        sides = [across(self._waves, depth / self.thickness) for depth in z]
        amplitudes |= {name: np.stack([one[at] for one in sides]) for at, name in enumerate(("across_z", "across_x"))}
        bessel = _bessel(self._k, r) * self._weights[:, None]
        return lambda name, order: amplitudes[name] @ bessel[order]


def cartesian(radial: Radial, theta: np.ndarray, traction: float) -> tuple[np.ndarray, ...]:
    """Return the Cartesian stresses xx, yy, zz, xy, yz, xz at the points of `radial`, divided by the mean pressure.

    radial: stresses at n depths and m radii. theta: angle (m,) of each radius from the direction x. traction: ratio of the
    traction, along x, to the pressure.
    """
    c, s = np.cos(theta), np.sin(theta)
    rr, tt, zz, rz = (one + traction * c * other for one, other in zip(radial.pressed, radial.dragged[:4], strict=True))
    rt, tz = (traction * s * one for one in radial.dragged[4:])
    return (
        rr * c * c + tt * s * s - 2.0 * rt * c * s,
        rr * s * s + tt * c * c + 2.0 * rt * c * s,
        zz,
        (rr - tt) * c * s + rt * (c * c - s * s),
        rz * s + tz * c,
        rz * c - tz * s,
    )


def _half_space(nu: float) -> dict[str, tuple[float, float]]:
    """Return the coefficients (c, d) of each stress amplitude (c + d k z) exp(-k z) in a half-space, by name.

    k: wavenumber, z: depth, nu: Poisson's ratio.
    """
    return {
        "pressed_zz": (-1.0, -1.0), "pressed_xz": (0.0, -1.0), "pressed_xx": (-1.0, 1.0), "pressed_yy": (-2.0 * nu, 0.0),
        "dragged_zz": (0.0, -1.0), "dragged_xz": (-1.0, 1.0), "dragged_xx": (-2.0, 1.0), "dragged_yy": (-2.0 * nu, 0.0),
        "across_z": (-1.0, 0.0), "across_x": (-1.0, 0.0),
    }  # fmt: skip


def _amplitudes(F: np.ndarray, nu: float) -> dict[str, np.ndarray]:
    """Return the stress amplitudes (n, waves) by name, from the stress function of each wave at n depths.

    F: the function and its first two derivatives with respect to depth, (3, 2, n, waves). The second axis is (pressure, shear).
    nu: Poisson's ratio.
    """
    (p, q), (p1, q1), (p2, q2) = F
    return {
        "pressed_zz": -p, "pressed_xz": p1, "pressed_xx": p2, "pressed_yy": nu * (p2 - p),
        "dragged_zz": q, "dragged_xz": q1, "dragged_xx": -q2, "dragged_yy": nu * (q - q2),
    }  # fmt: skip


def _across_film(waves: Waves, depth: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the two antiplane shear stresses (waves,) that the film adds to the half-space's at one depth.

    depth: divided by the film thickness. The first stress acts on planes of constant depth, the second on vertical planes along
    the wave.
    """
    up, down = waves.across * np.exp((depth - 1.0) * waves.x), waves.across * np.exp(-(depth + 1.0) * waves.x)
    return up - down, -up - down


def _across_body(waves: Waves, depth: float) -> tuple[np.ndarray, np.ndarray]:
    below = -waves.across_below * np.exp((1.0 - depth) * waves.x)
    return below, below


def _assembled(of: Callable[[str, int], np.ndarray]) -> Radial:
    """Return all stresses under pressure and traction, assembled from transforms of the stress amplitudes.

    of: function (name of the amplitude, order of the Bessel function) -> transform at depths and radii.
    """
    mean = (of("pressed_xx", 0) + of("pressed_yy", 0)) / 2.0
    difference = (of("pressed_xx", 2) - of("pressed_yy", 2)) / 2.0
    pressed = mean - difference, mean + difference, of("pressed_zz", 0), of("pressed_xz", 1)
    return Radial(pressed, _dragged(of))


def _dragged(of: Callable[[str, int], np.ndarray]) -> tuple[np.ndarray, ...]:
    """Assemble the stresses (rr, tt, zz, rz, rt, tz) due to a traction along x from transforms of orders 0 to 3.

    The first four are to be multiplied by cos(theta), rt and tz by sin(theta), as in `Radial`. of: function (name of the
    amplitude, order of the Bessel function) -> transform at depths and radii. With psi the angle between wave and radius, c =
    cos(psi), s = sin(psi), and J0 to J3 at k r, the averages over psi are <c^2 cos(k r c)> = (J0 - J2)/2, <s^2 cos(k r c)> =
    (J0 + J2)/2, <c^3 sin(k r c)> = (3 J1 - J3)/4 and <c s^2 sin(k r c)> = (J1 + J3)/4.
    """
    along, both = {}, {}
    for name in ("dragged_xx", "dragged_yy"):
        first, third = of(name, 1), of(name, 3)
        along[name], both[name] = (3.0 * first - third) / 4.0, (first + third) / 4.0
    turned, turned_3 = of("across_x", 1), of("across_x", 3)
    shear_0, shear_2 = of("dragged_xz", 0) / 2.0, of("dragged_xz", 2) / 2.0
    across_0, across_2 = of("across_z", 0) / 2.0, of("across_z", 2) / 2.0
    twice = (turned + turned_3) / 2.0
    return (
        along["dragged_xx"] + both["dragged_yy"] + twice,
        both["dragged_xx"] + along["dragged_yy"] - twice,
        of("dragged_zz", 1),
        shear_0 - shear_2 + across_0 + across_2,
        both["dragged_yy"] - both["dragged_xx"] - (turned - turned_3) / 2.0,
        -shear_0 - shear_2 - across_0 + across_2,
    )


@lru_cache(maxsize=64)
def _nodes(radius: float, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes and weights for integrals over x = k t up to `reach` (k: wavenumber, t: film thickness).

    radius: contact radius divided by t. The nodes are dense enough to integrate J(k r) cos(k) up to r = 3 contact radii.
    """
    return gauss((*_ENDS, *((12.0,) if reach > 12.0 else ()), reach), 2.0 * radius)


def _bessel(k: np.ndarray, r: np.ndarray) -> np.ndarray:
    """Return the Bessel functions J_0 to J_3 of k r for all wavenumbers k and radii r: (4, k, r)."""
    from scipy import special  # slow to import, and this module is imported whenever tangential laws are listed

    x = np.outer(k, r)
    safe = np.maximum(x, _SMALL)
    J0, J1 = special.j0(x), special.j1(x)
    J2 = np.where(x < _SMALL, x * x / 8.0 * (1.0 - x * x / 12.0 * (1.0 - x * x / 32.0)), 2.0 * J1 / safe - J0)
    J3 = np.where(x < _SMALL, x**3 / 48.0 * (1.0 - x * x / 16.0 * (1.0 - x * x / 40.0)), 4.0 * J2 / safe - J1)
    return np.stack([J0, J1, J2, J3])
