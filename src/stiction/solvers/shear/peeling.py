"""Solve the adhesive contact of a periodic map that is peeled off by a tangential force.

The map is solved with the attraction of `boundary_elements.adhesive`. A law of `mode_mixity` lowers the work of adhesion w at
every point to y w. The touching points stick and bear the tangential force T; points that do not touch bear no shear. The
energy G_T per area that shear releases at a point of the edge follows from virtual crack closure (Rybicki & Kanninen 1977, Eng.
Fract. Mech. 9, 931):

    G_T = c q s/2                                                                                                         (1)

q is the traction of the point, and s the slip of its neighbours outside the contact. The constant c was determined for discs of
radius a, whose mean G_T is beta T^2/(32 pi a^3) with the tangential compliance beta (Savkoor & Briggs 1977). (1) agrees with
this mean within 3 % at radii of 6 to 40 points. Pixels make G_T uneven, so it is smoothed along the edge over a few points.
Every point of the map takes G_T of the nearest point of the edge. Contact and shear are solved alternately until the area no
longer changes. In these iterations the contact only shrinks.

`peel_map` applies given forces to a contact that sticks. `slide_and_peel` shifts a contact whose points slip at their strength;
G_T is still computed for a contact that sticks under the same force, as in the closed forms.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter

from stiction.quantities.errors import InputError, nearest
from stiction.solvers.boundary_elements.adhesive import AdhesiveState, adhesive_state
from stiction.solvers.shear.compliance import ShearCompliance
from stiction.solvers.shear.minimise import shear
from stiction.solvers.shear.mode_mixity import MODE_MIXITIES, ModeMixity
from stiction.solvers.shear.operators import PeriodicShear, ShearOperator
from stiction.solvers.shear.path import MOST_STEPS, TOLERANCE, SlidingPath, State, Weakening, after_step, follow, slip_step

_OF_DISCS = 1.04
_ALONG = 2.0  # standard deviation of the smoothing, in points
_MOST_TURNS = 40
_STAYS = 2e-3  # largest relative change of the number of touching points, or of the force, in the last iteration
_APPROACH = 0.7  # fraction of the remaining force difference that one iteration covers


@dataclass(frozen=True)
class Peeled:
    """Store the adhesive contact of a map under a tangential force.

    force: tangential force [N]. area: contact area, corrected for pixel size [m2]. share: smallest remaining fraction of the
    work of adhesion. released: energy that shear releases at the nearest edge point, averaged over the points of the map
    [J/m2]; 0 without a law of mode mixity. peeled: whether the contact is lost, or no adhesion remains at some point. turns:
    number of iterations. converged: whether at most 0.2 % of the touching points changed in the last iteration; True if no
    iteration was needed. touching: mask (rows, columns).
    """

    force: float
    area: float
    share: float
    released: float
    peeled: bool
    turns: int
    converged: bool
    touching: np.ndarray = field(repr=False)


def peel_map(
    heights: np.ndarray, size: tuple[float, float], *, modulus: float, load: float, work: float, reach: float,
    compliance: ShearCompliance, forces: Sequence[float], mode_mixity: str | None = None, zeta: float = 1.0,
) -> list[Peeled]:  # fmt: skip
    """Shear an adhesive periodic map by tangential forces [N], in ascending order, until it peels.

    Returns the contact at each force; if the contact peels, the list ends with that state. heights: (rows, columns) [m]. size:
    (y, x) [m]. modulus: contact modulus E* [Pa]. load: normal load [N]. work: work of adhesion [J/m2]. reach: range of
    attraction [m]. compliance: tangential compliance of the bodies. mode_mixity: a key of MODE_MIXITIES; None if shear does not
    change adhesion. zeta: fraction of the shear energy that opens the edge, 0 to 1. The grid is not refined, unlike in
    `solve_adhesive`. Raises InputError for values out of bounds.
    """
    if mode_mixity is not None and mode_mixity not in MODE_MIXITIES:
        raise InputError("mode_mixity", mode_mixity, nearest(mode_mixity, list(MODE_MIXITIES)))
    if not 0.0 <= zeta <= 1.0:
        raise InputError("zeta", zeta, "0 to 1")
    if (np.diff(forces) < 0.0).any() or min(forces) < 0.0:
        raise InputError("forces", list(forces), "0 N or more, in rising order")
    state = adhesive_state(heights, size, modulus=modulus, load=load, work=work, reach=reach)
    operator = PeriodicShear(compliance, state.gap.shape, state.grid.size)
    found = []
    for force in forces:
        state, peeled = _at_force(state, operator, force, work, mode_mixity, zeta)
        found.append(peeled)
        if peeled.peeled:
            break
    return found


def _at_force(
    state: AdhesiveState, operator: ShearOperator, force: float, work: float, mode_mixity: str | None, zeta: float
) -> tuple[AdhesiveState, Peeled]:
    """Return the contact under a tangential force [N], as a state to continue from and as a result.

    state: the contact under a smaller force, from which the iteration starts. operator: tangential compliance. work: work of
    adhesion [J/m2]. mode_mixity: a key of MODE_MIXITIES, or None. zeta: fraction of the shear energy that opens the edge.
    """
    released, left = np.zeros(state.gap.shape), np.ones(state.gap.shape)
    converged, turn = mode_mixity is None or force == 0.0, 0
    while not converged and turn < _MOST_TURNS and state.touching.any():
        turn += 1
        before = state.touching
        released = energy_released(operator, before, force / state.pixel)
        left = np.minimum(left, MODE_MIXITIES[str(mode_mixity)].share(released / work, zeta))
        state = state.with_share(left)
        converged = bool(np.count_nonzero(before != state.touching) <= _STAYS * np.count_nonzero(before))
    peeled = not state.touching.any() or bool((left == 0.0).any())
    touching, share = state.touching, float(left.min())
    return state, Peeled(force, state.area, share, float(released.mean()), peeled, turn, converged, touching)


@dataclass(frozen=True)
class PeelingState(State):
    """Store the state of an adhesive map at one rigid shift.

    contact: the adhesive contact with its remaining work of adhesion. share: remaining fraction of the work of adhesion at
    every point (rows, columns).
    """

    contact: AdhesiveState = field(repr=False)
    share: np.ndarray = field(repr=False)


def slide_and_peel(
    contact: AdhesiveState, operator: ShearOperator, strength: Callable[[AdhesiveState], np.ndarray], shifts: Sequence[float],
    *, work: float, law: ModeMixity, zeta: float, weakening: Weakening | None = None,
) -> SlidingPath:  # fmt: skip
    """Return the path of an adhesive map through rigid shifts along x [m], in the given order, while shear lowers its adhesion.

    The path holds a state for each shift, and the state with the largest force, located by smaller steps. contact:
    the map, solved without shear. operator: tangential compliance. strength: returns the shear strength of every point of a
    contact (rows, columns) [Pa]. work: work of adhesion [J/m2]. law: law of mode mixity. zeta: fraction of the shear energy
    that opens the edge, 0 to 1. weakening: how strength falls with slip; None for constant strength. Points that have lost
    contact do not touch again when the force falls.
    """
    full, zero, none = strength(contact), np.zeros((1, *contact.gap.shape)), np.zeros(contact.gap.shape, dtype=bool)
    start = PeelingState(
        0.0, 0.0, zero, zero, zero[0], none, full > 0.0, 1.0, 0.0, True, contact, np.ones(contact.gap.shape)
    )  # fmt: skip
    unit = _UnitRelease(operator)

    def advance(state: PeelingState, shift: float) -> PeelingState:
        contact, share, acting, stays = state.contact, state.share, state.force, False
        for _ in range(_MOST_TURNS):
            step = slip_step(operator, strength(contact), weakening, state, shift - state.slip, TOLERANCE, MOST_STEPS)
            force = float(step.found.traction.sum())
            stays = force <= acting + _STAYS * abs(acting)
            if stays:
                break
            acting += _APPROACH * (force - acting)  # from below, because lost contact does not form again
            share = np.minimum(share, law.share(unit(contact.touching) * acting**2 / work, zeta))
            contact = contact.with_share(share)
        after = after_step(state, step, contact.touching)
        after["converged"] = after["converged"] and stays
        return PeelingState(shift, **after, contact=contact, share=share)

    states, peak = follow(advance, start, shifts, finer=True, keep_maps=False)
    return SlidingPath(states, peak, full, contact.pixel)


class _UnitRelease:
    """Compute the energy that a unit tangential force releases at the contact edge; reuse it until the contact changes."""

    def __init__(self, operator: ShearOperator):
        self._operator, self._touching, self._released = operator, np.zeros(0, dtype=bool), np.zeros(0)

    def __call__(self, touching: np.ndarray) -> np.ndarray:
        """Return the energy released at the nearest edge point, per area and T^2, for every point (rows, columns).

        T is the tangential force divided by the area of a point [Pa], so the unit is J/(m2 Pa2). touching: mask (rows,
        columns).
        """
        if not np.array_equal(touching, self._touching):
            self._touching = touching
            self._released = energy_released(self._operator, touching, 1.0) if touching.any() else np.zeros(touching.shape)
        return self._released


def energy_released(operator: ShearOperator, touching: np.ndarray, total: float) -> np.ndarray:
    """Return the energy [J/m2] that shear releases at the contact edge, for every point (rows, columns).

    Each point takes the value of the nearest edge point. operator: tangential compliance. touching: mask (rows, columns) of the
    points that touch and stick. total: tangential force on them, divided by the area of a point [Pa].
    """
    shift = np.ones((1, *touching.shape))
    strength = np.where(touching, 1e6 / operator.of_point, 0.0)
    found = shear(operator, strength, shift, 0.0 * shift, tolerance=1e-9, most=2000)
    scale = total / float(found.traction.sum())
    traction, slip = found.traction[0] * scale, (1.0 - operator(found.traction)[0]) * scale
    outside, count = np.zeros_like(slip), np.zeros_like(slip)
    for axis in (0, 1):
        for step in (1, -1):
            apart = ~np.roll(touching, step, axis)
            outside += np.where(apart, np.roll(slip, step, axis), 0.0)
            count += apart
    edge = touching & (count > 0)
    local = np.where(edge, 0.5 * _OF_DISCS * traction * outside / np.maximum(count, 1), 0.0)
    weight = gaussian_filter(edge.astype(float), _ALONG, mode="wrap")
    smooth = gaussian_filter(local, _ALONG, mode="wrap") / np.where(edge, weight, 1.0)
    rows, columns = distance_transform_edt(~edge, return_distances=False, return_indices=True)
    return smooth[rows, columns]
