"""Solve the coupled normal and tangential contact of height maps, for bodies of different elastic constants.

The traction q on the upper body and the pressure p displace the faces tangentially (u_t) and normally (u_z) by (Johnson 1985,
Contact Mechanics, eqs. 3.22 and 3.75; sign of q as in `compliance`)

    u_t = C q + D p,    u_z = C_n p + D^T q,    D = M/(2 pi) (x, y)/r^2 *,                                                 (1)
    M = (1 - 2 nu_1)/(2 G_1) - (1 - 2 nu_2)/(2 G_2)

with the tangential and normal compliance operators C and C_n, Poisson's ratios nu, shear moduli G, and * for a convolution. In
Fourier space D = -i M k/k^2. M is 0 for two bodies of one material, and for an incompressible body on a rigid one. For films M
depends on k (see `compliance`). Dundurs' parameter beta is M divided by the sum of (1 - nu)/G.

Pressure and traction are solved alternately (Panagiotopoulos 1975, Ing.-Arch. 44, 421). The pressure is solved with D^T q
subtracted from the heights. The traction is then solved with D p subtracted from the rigid shift, and with the strength that
this pressure gives. Iteration ends when the pressure no longer changes.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from stiction.quantities.errors import InputError, InWords
from stiction.solvers.boundary_elements.minimise import Problem, minimise
from stiction.solvers.boundary_elements.operators import components
from stiction.solvers.shear.compliance import ShearCompliance
from stiction.solvers.shear.operators import ShearOperator
from stiction.solvers.shear.path import SlidingPath, State, Weakening, after_step, follow, slip_step

_MOST_TURNS = 60
_PRESSED_IN = 16  # number of steps in which the load rises before the map is shifted
_TOLERANCE = 1e-4  # largest relative change of the pressure in the last turn of a step
_FREE_TURNS = 3  # number of turns before changes of strength are limited
_PART = 0.3  # fraction of the change of strength that a point makes after it has begun or ceased to touch
_OF_PRESSURE = 1e-6  # tolerance of the pressure solver
_MOST_STEPS = 2000

Press = Callable[[np.ndarray], np.ndarray]
"""Function of the normal displacement (rows, columns) [m] due to shear, which returns the pressure (rows, columns) [Pa]."""

Strength = Callable[[np.ndarray], np.ndarray]
"""Function of the pressure that returns the shear strength, both (rows, columns) [Pa]."""


class Coupling:
    """Compute the tangential displacement that a pressure causes, and the normal displacement that a traction causes.

    Both vanish for two bodies of one material without films, or with films of this material, and for an incompressible body on
    a rigid one. The map is periodic, or has no pressure and traction outside. compliance: tangential compliance of the two
    bodies. shape: (rows, columns). size: (y, x) [m]. periodic: whether the map repeats. beta: largest magnitude of Dundurs'
    parameter over all waves. Raises InputError for bodies with films on a map that is not periodic.
    """

    def __init__(self, compliance: ShearCompliance, shape: tuple[int, int], size: tuple[float, float], *, periodic: bool):
        self.shape = shape
        ky, kx = components(shape, size)
        k = np.hypot(kx, ky)
        k[0, 0] = math.inf
        waves = np.where(np.isinf(k), np.min(k), k)
        mismatch = compliance.coupling(waves)
        self.beta = float(np.max(np.abs(mismatch) / compliance.times_k(waves)[0]))
        if periodic:
            self._grid = shape
            self._symbol = [-1j * mismatch * part / k**2 for part in (kx, ky)]
        elif compliance.layered:
            raise InputError("film", InWords("on a map that is not periodic"), "no film, or a map that is periodic")
        else:
            self._grid = tuple(next_fast_len(2 * count, real=True) for count in shape)
            pitch = size[0] / shape[0], size[1] / shape[1]
            self._symbol = [float(mismatch[0, 0]) * rfft2(kernel) for kernel in _of_pixels(self._grid, pitch)]

    def dragged(self, pressure: np.ndarray) -> np.ndarray:
        """Return the tangential displacement [m] (2, rows, columns), along x and y, caused by a pressure [Pa].

        pressure: (rows, columns).
        """
        waves = rfft2(pressure, s=self._grid)
        return self._cut(irfft2(np.stack([symbol * waves for symbol in self._symbol]), s=self._grid))

    def parted(self, traction: np.ndarray) -> np.ndarray:
        """Return the normal displacement [m] (rows, columns) caused by a traction [Pa].

        traction: (2, rows, columns), along x and y.
        """
        waves = rfft2(traction, s=self._grid)
        both = sum(symbol.conj() * wave for symbol, wave in zip(self._symbol, waves, strict=True))
        return self._cut(irfft2(both, s=self._grid))

    def _cut(self, field: np.ndarray) -> np.ndarray:
        return field[..., : self.shape[0], : self.shape[1]].copy()


class Pressing:
    """Solve the pressure of a map under a mean pressure, each time starting from the last solution.

    problem: the contact of the map without shear. pressure: first start (rows, columns) [Pa]. converged: whether all solutions
    so far have converged.
    """

    def __init__(self, problem: Problem, pressure: np.ndarray):
        self._problem, self._last, self.converged = problem, pressure, True

    def __call__(self, parted: np.ndarray) -> np.ndarray:
        """Return the pressure [Pa] if shear displaces the faces normally by `parted` [m]; both are (rows, columns)."""
        problem = replace(self._problem, heights=self._problem.heights - parted)
        found = minimise(problem, self._last, tolerance=_OF_PRESSURE, most=_MOST_STEPS)
        self._last, self.converged = found.pressure, self.converged and found.converged
        return found.pressure

    def under(self, share: float) -> "Pressing":
        """Return the solver of the same contact under a fraction `share` of the mean pressure."""
        return Pressing(replace(self._problem, mean=share * self._problem.mean), share * self._last)


@dataclass(frozen=True)
class CoupledState(State):
    """Store pressure, traction and slip of a map after one step.

    pressure, strength [Pa]: (rows, columns). strength is the shear strength that a point has before any slip. turns: number of
    iterations, each of which solves pressure, then traction. change: relative change of the pressure in the last iteration.
    misfit: sum over the points of the absolute difference between the strength used and the strength that the pressure gives,
    divided by the sum of the strengths that the pressure gives. misfit is above 0 if points at the edge alternate between
    contact and no contact, because the solver then limits or fixes their strength (see `_Strengths`).
    """

    pressure: np.ndarray = field(repr=False)
    strength: np.ndarray = field(repr=False)
    turns: int
    change: float
    misfit: float


def at_rest(shape: tuple[int, int]) -> CoupledState:
    """Return the state of a map before the faces touch: no pressure, traction or slip. shape: (rows, columns)."""
    zero = np.zeros((2, *shape))
    no = np.zeros(shape, dtype=bool)
    return CoupledState(0.0, 0.0, zero, zero, zero[0], no, no, 1.0, 0.0, True, zero[0], zero[0], 0, 0.0, 0.0)


def press_and_shear(
    operator: ShearOperator, coupling: Coupling, state: CoupledState, press: Press, strength: Strength,
    shift: Sequence[float] = (0.0, 0.0), *, weakening: Weakening | None = None, tolerance: float = 1e-5,
    most: int = _MOST_STEPS,
) -> CoupledState:  # fmt: skip
    """Solve pressure and traction of a map at a rigid shift, starting from the state after the previous step.

    operator: tangential compliance. coupling: displacements that couple pressure and shear. shift: (x, y) [m], measured from
    first contact. press: returns the pressure for a given normal displacement due to shear. strength: returns the shear
    strength for a given pressure [Pa]. weakening: how strength falls with slip; None for constant strength. tolerance: largest
    relative change of the pressure in the last turn (one solution of the pressure and one of the traction). most: largest
    number of steps of the traction solver. Points without contact move with the faces, so that their slip starts anew when they
    touch.
    """
    start, before, strengths = state, state.pressure, _Strengths()
    rigid = np.asarray(shift, dtype=float)[:, None, None] - state.slip
    for turn in range(1, _MOST_TURNS + 1):
        pressure = press(coupling.parted(start.traction))
        full, moved = strengths.next(strength(pressure)), rigid - coupling.dragged(pressure)
        step = slip_step(operator, full, weakening, start, moved, 0.1 * tolerance, most)
        change = float(np.abs(pressure - before).sum() / pressure.sum())
        start, before = replace(start, traction=step.found.traction), pressure
        if change <= tolerance and turn > 1:  # the first pressure was computed with the old traction
            break
    touching = full > 0.0
    # Open points bear no traction and slip freely. Their displacement is stored, because it counts from when they touch.
    after = after_step(state, step, touching, moved - operator(step.found.traction))
    after["converged"] = after["converged"] and change <= tolerance
    return CoupledState(
        float(shift[0]), **after, pressure=pressure, strength=full, turns=turn, change=change, misfit=strengths.misfit
    )


class _Strengths:
    """Limit the changes in strength of a point between turns, so that the iteration ends.

    A turn solves the pressure once and then the traction once. Without a limit, some points at the edge would touch in one turn
    and not in the next. After the third turn, the strength of a point that has begun or ceased to touch changes in each turn by
    only 30 % of its difference from the computed strength. When the point begins or ceases to touch a second time, its strength
    is fixed. misfit: as in `CoupledState`.
    """

    def __init__(self) -> None:
        self._turn, self._part, self._touching, self._now = 0, np.ones(()), np.zeros((), dtype=bool), np.zeros(())
        self.misfit = 0.0

    def next(self, wanted: np.ndarray) -> np.ndarray:
        """Return the strengths to use in this turn [Pa] (rows, columns).

        wanted: strengths computed from the pressure of this turn [Pa] (rows, columns). The result equals `wanted`, except at
        points that have begun or ceased to touch after the third turn. The strength of such a point changes by only 30 % of its
        difference from `wanted`. It does not change once the point has begun or ceased to touch twice.
        """
        self._turn += 1
        touching = wanted > 0.0
        if self._turn > _FREE_TURNS:
            self._part = np.where(touching == self._touching, self._part, np.where(self._part == 1.0, _PART, 0.0))
        self._touching, self._now = touching, np.where(self._part == 1.0, wanted, self._now + self._part * (wanted - self._now))
        self.misfit = float(np.abs(self._now - wanted).sum() / wanted.sum())
        return self._now


def slide_coupled(
    operator: ShearOperator, coupling: Coupling, pressing: Pressing, strength: Strength, shifts: Sequence[float], *,
    pixel: float, weakening: Weakening | None = None,
) -> SlidingPath:  # fmt: skip
    """Press a map of bodies with unlike elastic constants, then shift it through rigid shifts along x [m], in the given order.

    The load rises in steps, because points already slip while it rises (Spence 1968). This slip does not weaken the points.
    operator: tangential compliance. coupling: displacements that couple pressure and shear. pressing: the contact under its
    full load. strength: returns the shear strength for a given pressure [Pa]. weakening: how strength falls with slip; None for
    constant strength. pixel: area of a point [m2].
    """
    state = at_rest(coupling.shape)
    for step in range(1, _PRESSED_IN + 1):
        press = pressing.under((step / _PRESSED_IN) ** 2)
        state = press_and_shear(operator, coupling, state, press, strength, tolerance=_TOLERANCE)
    start = replace(state, slipped=np.zeros(coupling.shape), loss=0.0)

    def advance(state: CoupledState, shift: float) -> CoupledState:
        if shift == state.shift:
            return state  # not solved again, because round-off would decide which points at their strength stick
        return press_and_shear(
            operator, coupling, state, pressing, strength, (shift, 0.0), weakening=weakening, tolerance=_TOLERANCE
        )

    states, peak = follow(advance, start, shifts, finer=weakening is not None, keep_maps=False)
    limit = None
    if weakening is None:
        limit, settled = force_when_all_slide(coupling, pressing, strength, states[-1].pressure)
        states = (*states[:-1], replace(states[-1], converged=states[-1].converged and settled))
    return SlidingPath(states, peak, start.strength, pixel, limit)


def force_when_all_slide(
    coupling: Coupling, pressing: Pressing, strength: Strength, pressure: np.ndarray
) -> tuple[float, bool]:  # fmt: skip
    """Return the strength summed over points [Pa] when every point slides along x, and whether the iteration converged.

    Pressure and strength are computed alternately, because shear changes the pressure. coupling, pressing: as in
    `slide_coupled`. strength: returns the shear strength for a given pressure. pressure: first guess (rows, columns) [Pa].
    """
    strengths, change = _Strengths(), math.inf
    for _ in range(_MOST_TURNS):
        full = strengths.next(strength(pressure))
        now = pressing(coupling.parted(np.stack([full, np.zeros_like(full)])))
        change, pressure = float(np.abs(now - pressure).sum() / now.sum()), now
        if change <= _TOLERANCE:
            break
    return float(full.sum()), change <= _TOLERANCE and pressing.converged


def _of_pixels(shape: tuple[int, ...], pitch: tuple[float, float]) -> list[np.ndarray]:
    """Return x/(2 pi r^2) and y/(2 pi r^2), each integrated over a pixel, at every point of a periodic grid: (rows, columns).

    x, y: coordinates relative to the first point; r: distance from it. shape: (rows, columns). pitch: point spacings (y, x)
    [m].
    """
    y, x = (np.fft.fftfreq(count, 1.0 / (count * step)) for count, step in zip(shape, pitch, strict=True))
    kernels = [np.zeros(shape), np.zeros(shape)]
    for across, sign_x in ((0.5, 1.0), (-0.5, -1.0)):
        for down, sign_y in ((0.5, 1.0), (-0.5, -1.0)):
            at_x, at_y = x + across * pitch[1], (y + down * pitch[0])[:, None]
            logarithm, sign = 0.5 * np.log(at_x**2 + at_y**2), sign_x * sign_y / (2.0 * math.pi)
            kernels[0] += sign * (at_x * np.arctan(at_y / at_x) + at_y * logarithm)
            kernels[1] += sign * (at_y * np.arctan(at_x / at_y) + at_x * logarithm)
    # The kernels are odd, and 0 at points that are equally far from the first point on both sides.
    kernels[0][:, shape[1] // 2] = 0.0
    kernels[1][shape[0] // 2] = 0.0
    return kernels
