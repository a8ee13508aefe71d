"""Coupled normal and tangential contact of height maps, for bodies of different elastic constants.

The traction q on the upper body and the pressure p displace the faces tangentially (u_t) and normally (u_z) by (Johnson 1985,
Contact Mechanics, eqs. 3.22 and 3.75; sign of q as in `compliance`)

    u_t = C q + D p,    u_z = C_n p + D^T q,    D = M/(2 pi) (x, y)/r^2 *,                                                 (1)
    M = (1 - 2 nu_1)/(2 G_1) - (1 - 2 nu_2)/(2 G_2)

In Fourier space D = -i M k/k^2. M is 0 for two bodies of one material, and for an incompressible body on a rigid one.
Pressure and traction are solved alternately (Panagiotopoulos 1975, Ing.-Arch. 44, 421). The pressure is solved with D^T q
subtracted from the heights. The traction is then solved with D p subtracted from the rigid shift, and with the strength that
this pressure gives. Iteration ends when the pressure no longer changes.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from stiction.quantities.errors import InputError
from stiction.solvers.boundary_elements.operators import components
from stiction.solvers.shear.compliance import ShearCompliance
from stiction.solvers.shear.minimise import shear, size_of
from stiction.solvers.shear.operators import ShearOperator

_MOST_TURNS = 60

Press = Callable[[np.ndarray], np.ndarray]
"""From the displacement (rows, columns) [m] that shear adds between the faces to the pressure (rows, columns) [Pa]."""


class Coupling:
    """Compute the displacements that couple pressure and shear, the operator D of (1).

    The map is periodic, or free of pressure and traction outside. compliance: two bodies without films. shape: (rows,
    columns). size: (y, x) [m]. periodic: whether the map repeats. Raises InputError for bodies with films.
    """

    def __init__(self, compliance: ShearCompliance, shape: tuple[int, int], size: tuple[float, float], *, periodic: bool):
        if compliance.layered:
            raise InputError(
                "film",
                "between bodies of different elasticity",
                "no film, because the solver does not couple pressure and shear in films",
            )
        self.shape, mismatch = shape, compliance.mismatch
        if periodic:
            self._grid = shape
            ky, kx = components(shape, size)
            square = kx**2 + ky**2
            square[0, 0] = math.inf
            self._symbol = [-1j * mismatch * part / square for part in (kx, ky)]
        else:
            self._grid = tuple(next_fast_len(2 * count, real=True) for count in shape)
            pitch = size[0] / shape[0], size[1] / shape[1]
            self._symbol = [mismatch * rfft2(kernel) for kernel in _of_pixels(self._grid, pitch)]

    def dragged(self, pressure: np.ndarray) -> np.ndarray:
        """Return the tangential displacement [m] (2, rows, columns) caused by a pressure [Pa].

        pressure: (rows, columns).
        """
        waves = rfft2(pressure, s=self._grid)
        return self._cut(irfft2(np.stack([symbol * waves for symbol in self._symbol]), s=self._grid))

    def parted(self, traction: np.ndarray) -> np.ndarray:
        """Return the normal displacement [m] (rows, columns) caused by a traction [Pa].

        traction: (2, rows, columns).
        """
        waves = rfft2(traction, s=self._grid)
        both = sum(symbol.conj() * wave for symbol, wave in zip(self._symbol, waves, strict=True))
        return self._cut(irfft2(both, s=self._grid))

    def _cut(self, field: np.ndarray) -> np.ndarray:
        return field[..., : self.shape[0], : self.shape[1]].copy()


@dataclass(frozen=True)
class CoupledState:
    """Store pressure, traction and slip of a map after one loading step.

    pressure [Pa] (rows, columns). traction [Pa] and slip since first contact [m], both (2, rows, columns). stick: fraction of
    the touching points that stick. loss: work dissipated by slip so far, summed over points [Pa m]. turns: alternating
    iterations of pressure and traction. change: relative change of the pressure in the last iteration. converged: whether all
    iterations ended.
    """

    pressure: np.ndarray = field(repr=False)
    traction: np.ndarray = field(repr=False)
    slip: np.ndarray = field(repr=False)
    stick: float
    loss: float
    turns: int
    change: float
    converged: bool


def at_rest(shape: tuple[int, int]) -> CoupledState:
    """Return the state before the faces touch: no pressure, traction or slip."""
    zero = np.zeros((2, *shape))
    return CoupledState(zero[0], zero, zero, 1.0, 0.0, 0, 0.0, True)


def press_and_shear(
    operator: ShearOperator, coupling: Coupling, state: CoupledState, press: Press,
    strength: Callable[[np.ndarray], np.ndarray],
    shift: Sequence[float] = (0.0, 0.0), *, tolerance: float = 1e-5, most: int = 2000,
) -> CoupledState:  # fmt: skip
    """Return the next state after pressing again, at a rigid shift (x, y) [m] measured from first contact.

    press: returns the pressure for a given normal displacement due to shear. strength: returns the shear strength for a given
    pressure [Pa]. tolerance: largest relative change of the pressure in the last iteration. most: largest number of steps of
    the traction solver. Points without contact follow the faces, so that slip starts anew when they touch.
    """
    traction, before = state.traction, state.pressure
    rigid = np.asarray(shift, dtype=float)[:, None, None] - state.slip
    for turn in range(1, _MOST_TURNS + 1):  # noqa: B007
        pressure = press(coupling.parted(traction))
        left = strength(pressure)
        found = shear(operator, left, rigid - coupling.dragged(pressure), traction, tolerance=0.1 * tolerance, most=most)
        change = float(np.abs(pressure - before).sum() / pressure.sum())
        traction, before = found.traction, pressure
        if change <= tolerance:
            break
    touching = left > 0.0
    sliding = touching & (size_of(traction) >= left * (1.0 - 1e-9))
    # Where faces are apart they take up no load, and slip freely: what they have moved by counts when they touch.
    apart = np.where(touching, found.slip, rigid - coupling.dragged(pressure) - operator(traction))
    loss = state.loss + float(np.sum(traction * found.slip))
    stick = 1.0 - np.count_nonzero(sliding) / np.count_nonzero(touching)
    return CoupledState(
        pressure, traction, state.slip + apart, stick, loss, turn, change, change <= tolerance and found.converged
    )


def _of_pixels(shape: tuple[int, ...], pitch: tuple[float, float]) -> list[np.ndarray]:
    """Return (x, y)/(2 pi r^2) integrated over a pixel, on the grid of FFT distances."""
    y, x = (np.fft.fftfreq(count, 1.0 / (count * step)) for count, step in zip(shape, pitch, strict=True))
    kernels = [np.zeros(shape), np.zeros(shape)]
    for across, sign_x in ((0.5, 1.0), (-0.5, -1.0)):
        for down, sign_y in ((0.5, 1.0), (-0.5, -1.0)):
            at_x, at_y = x + across * pitch[1], (y + down * pitch[0])[:, None]
            logarithm, sign = 0.5 * np.log(at_x**2 + at_y**2), sign_x * sign_y / (2.0 * math.pi)
            kernels[0] += sign * (at_x * np.arctan(at_y / at_x) + at_y * logarithm)
            kernels[1] += sign * (at_y * np.arctan(at_x / at_y) + at_x * logarithm)
    kernels[0][:, shape[1] // 2] = 0.0  # as far to either side: odd
    kernels[1][shape[0] // 2] = 0.0
    return kernels
