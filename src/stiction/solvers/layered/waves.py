"""Compute the response of a film on a half-space to one wave of pressure or shear on its surface.

Lengths are in units of 1/k (k: wavenumber). z is the depth, and x = k t the depth of the interface. Along the wave there is
plane strain, described by a stress function F. A pressure cos(xi) gives s_zz = -F cos, s_xz = F' sin, s_xx = F'' cos. A shear
cos(xi), shifted by a quarter of the wave, gives s_zz = F sin, s_xz = F' cos, s_xx = -F'' sin. In both cases s_yy = nu (s_xx +
s_zz), and

    2 mu u_x = (1 - nu) F'' + nu F,   2 mu u_z = (1 - nu) F''' - (2 - nu) F'    (apart from the sign and the sine or cosine).

On a half-space F = (a + b z) exp(-z): (1 + z) exp(-z) under pressure, -z exp(-z) under shear. A film adds four terms with zero
traction on the surface. The half-space below has two terms. Six equations determine them, and are solved for all waves at once.
The added part falls as exp(-x), so no digits cancel in a thick film. Across the wave (antiplane shear) there is a closed form.
Source: the equations of plane and antiplane strain; O'Sullivan & King (1988) solve a layer in this way.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class CoatedBody:
    """Describe the elastic constants of a film bonded to a half-space.

    ratio: ratio of the plane-strain moduli of film and body below, finite, >= 0 (0 if the body is rigid). nu, nu_below:
    Poisson's ratios of film and body, 0 to 0.5.
    """

    ratio: float
    nu: float
    nu_below: float

    @property
    def shear_ratio(self) -> float:
        """Return the ratio of the shear moduli of film and body below."""
        return self.ratio * (1.0 - self.nu) / (1.0 - self.nu_below)


@dataclass(frozen=True)
class Waves:
    """Store the amplitudes of stress and displacement in film and body, for wavenumbers x = k t (m,).

    t: film thickness. Depths are multiplied by k: z is the depth below the surface, y = x - z the height above the interface, s
    = z - x the depth below the interface. added (4, 2, m): factors of exp(-z), z exp(-z), exp(-y) and y exp(-y) in the stress
    function of the film minus the stress function of a half-space. The second axis is (pressure, shear along the wave). below
    (2, 2, m): factors of exp(-s) and s exp(-s) in the stress function of the body.

    across, across_below (m,): amplitudes under shear across the wave. In the film, displacement times shear modulus is exp(-z)
    + across (exp(-y) + exp(-y - 2 z)). In the body, displacement times shear modulus is across_below exp(-s).
    """

    x: np.ndarray
    added: np.ndarray
    below: np.ndarray
    across: np.ndarray
    across_below: np.ndarray

    def surface_compliances(self, nu: float) -> np.ndarray:
        """Return two surface displacements of each of m waves under unit shear: (2, m).

        The first is the displacement along the wave under shear along the wave, the second the displacement across the wave
        under shear across the wave. They are multiplied by the wavenumber and the shear modulus of the film. On a half-space
        they are 1 - nu and 1. nu: Poisson's ratio of the film.
        """
        F, _, F2, _ = _film(0.0, self.x)
        along = ((1.0 - nu) * (2.0 + np.sum(F2 * self.added[:, 1], axis=0)) + nu * np.sum(F * self.added[:, 1], axis=0)) / 2.0
        return np.stack([along, 1.0 + 2.0 * self.across * np.exp(-self.x)])

    def surface_coupling(self, nu: float) -> np.ndarray:
        """Return the tangential surface displacement (m,) under m waves of unit pressure, positive towards their crests.

        It is multiplied by the wavenumber and the shear modulus of the film. On a half-space it is 1/2 - nu. nu: Poisson's
        ratio of the film.
        """
        F, _, F2, _ = _film(0.0, self.x)
        bent, stress = np.sum(F2 * self.added[:, 0], axis=0), np.sum(F * self.added[:, 0], axis=0)
        return 0.5 * ((1.0 - nu) * (1.0 - bent) - nu * (1.0 + stress))


def waves(x: np.ndarray, body: CoatedBody) -> Waves:
    """Return the amplitudes of waves in film and body under unit pressure and unit shear on the surface.

    x: wavenumber times film thickness (m,), > 0. body: elastic constants of film and body.
    """
    m = body.shear_ratio
    equations, right = np.zeros((x.size, 6, 6)), np.zeros((x.size, 6, 2))
    top, bottom, under = _film(0.0, x), _film(x, x), _decaying(np.zeros_like(x))
    half_space = np.stack([_weigh((1.0, 1.0), x), _weigh((0.0, -1.0), x)], axis=-1)  # F to F''' at the interface (4, m, 2)
    equations[:, 0, :4], equations[:, 1, :4] = top[0].T, top[1].T
    for row, (film, body_below, given) in enumerate(
        zip(
            _continuous(bottom, body.nu, 1.0),
            _continuous(under, body.nu_below, m),
            _continuous(half_space, body.nu, 1.0),
            strict=True,
        )
    ):
        scale = 1.0 if row < 2 else 1.0 / (1.0 + m)
        equations[:, 2 + row, :4], equations[:, 2 + row, 4:] = scale * film.T, -scale * body_below.T
        right[:, 2 + row] = -scale * given
    amplitudes = np.moveaxis(np.linalg.solve(equations, right), 0, -1)
    once, twice = np.exp(-x), np.exp(-2.0 * x)
    across = (m - 1.0) * once / (1.0 + twice + m * (1.0 - twice))
    return Waves(x, amplitudes[:4], amplitudes[4:], across, once - across * (1.0 - twice))


def film_function(waves: Waves, depth: float) -> np.ndarray:
    """Return F, F' and F'' at one depth: (3, 2, m).

    F is the stress function of the film minus the stress function of a half-space. depth: divided by the film thickness, 0 to
    1. The second axis is (pressure, shear), the third the m waves.
    """
    return _sum(_film(depth * waves.x, waves.x), waves.added)


def body_function(waves: Waves, depth: float) -> np.ndarray:
    """Return the stress function F of the body below the film at one depth, with F' and F'': (3, 2, m).

    depth: divided by the film thickness, >= 1. The second axis is (pressure, shear), the third the m waves.
    """
    return _sum(_decaying((depth - 1.0) * waves.x), waves.below)


def _sum(functions: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """Return F, F' and F'' (3, 2, m) of m waves as the sum of basis functions times their amplitudes.

    functions (derivatives, b, m): b basis functions and their derivatives. amplitudes (b, 2, m): under (pressure, shear).
    """
    total = functions[:3, 0, None] * amplitudes[0]
    for function, amplitude in zip(functions[:3].swapaxes(0, 1)[1:], amplitudes[1:], strict=True):
        total += function[:, None] * amplitude
    return total


def _decaying(z) -> np.ndarray:
    """Return exp(-z) and z exp(-z) with their first three derivatives: (4, 2, m)."""
    down = np.exp(-z)
    return np.stack([[down, z * down], [-down, (1.0 - z) * down], [down, (z - 2.0) * down], [-down, (3.0 - z) * down]])


def _film(z, x) -> np.ndarray:
    """Return the four basis functions in a film at depth z (m,), with their first three derivatives: (4, 4, m).

    They are exp(-z), z exp(-z), exp(-y) and y exp(-y), with y = x - z and the depth x of the interface. The derivatives are
    with respect to z.
    """
    z = np.broadcast_to(z, x.shape)
    down, up = _decaying(z), _decaying(x - z)
    up[1::2] *= -1.0
    return np.concatenate([down, up], axis=1)


def _weigh(amplitudes, z) -> np.ndarray:
    """Return the stress function of a half-space at depth z (m,) and its first three derivatives: (4, m).

    amplitudes: factors of exp(-z) and z exp(-z).
    """
    return np.einsum("dbm,b->dm", _decaying(z), np.array(amplitudes))


def _continuous(F: np.ndarray, nu: float, softness: float) -> tuple[np.ndarray, ...]:
    """Return the four quantities that are continuous at the interface of film and body.

    They are the stress function, its derivative with respect to depth, and 2 mu times the displacements along the wave and in
    the depth direction, with mu the shear modulus of the film. F: the stress function and its first three derivatives. nu:
    Poisson's ratio on this side. softness: mu divided by the shear modulus on this side.
    """
    return F[0], F[1], softness * ((1.0 - nu) * F[2] + nu * F[0]), softness * ((1.0 - nu) * F[3] - (2.0 - nu) * F[1])
