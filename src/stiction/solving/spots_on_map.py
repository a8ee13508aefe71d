"""Compute the scatter of the shear displacement over the contact spots of a solved map.

It is the standard deviation over all points in contact under a uniform shear stress. `sliding_efficiency` uses it.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from stiction.laws.rough_surface.boundary_elements import bodies_of, shear_compliance_of
from stiction.solving.on_map import MapProblem

if TYPE_CHECKING:
    from stiction.solvers.boundary_elements.solve import MapContact
    from stiction.solvers.shear.operators import ShearOperator

_BEYOND, _STEP, _MOST = 1.5, 1.5, 12  # pressures of the table: factor beyond the loads, ratio of neighbours, largest number
_HEAVIEST, _OF_HARDNESS = 0.5, 0.5  # largest pressure: divided by modulus times gradient, and divided by the hardness


def spread_on_map(problem: MapProblem, loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the standard deviation of shear displacement over all points in contact, as a function of contact area.

    Parameters
    ----------
    problem : MapProblem
        A contact with a map. A large map is solved only on as many points as the contact area needs.
    loads : numpy.ndarray
        Loads [N] near which the result is needed.

    Returns
    -------
    tuple of numpy.ndarray
        Ratio of real to nominal area (k,), rising to 1, and s/tau_p (k,) [m/Pa]. s is the standard deviation of the
        displacement over all points in contact if each bears the stress tau_p.

    Raises
    ------
    InputError
        The map cannot be solved.
    """
    from stiction.solvers.boundary_elements.curve import curve_of_map  # slow to import
    from stiction.solvers.boundary_elements.measures import waves
    from stiction.solvers.shear.operators import MirroredShear, PeriodicShear
    from stiction.surfaces.heightmap import every_point  # only contacts of scans need it

    contact, surface = problem.contact, problem.surface()
    bodies = bodies_of(contact)
    largest = _HEAVIEST * float(contact.contact_modulus) * waves(surface.heights, surface.size, surface.periodic).gradient
    if bodies.hardness is not None:
        largest = min(largest, _OF_HARDNESS * bodies.hardness)
    least, most = (float(load) / contact.nominal_area for load in (loads.min(), loads.max()))
    steps = min(math.ceil(math.log(most / least * _BEYOND**2) / math.log(_STEP)), _MOST)
    near = np.geomspace(least / _BEYOND, most * _BEYOND, steps + 1)
    curve = curve_of_map(surface, bodies, [*near[near < largest].tolist(), largest], sampled=True)
    solved = [state for state in curve.contacts if state is not None]
    heights, size = every_point(surface.heights, surface.size, curve.every)
    boundary = PeriodicShear if surface.periodic else MirroredShear
    operator = boundary(shear_compliance_of(contact), heights.shape, size)
    share = [state.area / state.nominal_area for state in solved]
    return np.array([*share, 1.0]), np.array([*(_spread(operator, state) for state in solved), 0.0])


def _spread(operator: "ShearOperator", state: "MapContact") -> float:
    """Return the standard deviation of the shear displacement of the points in contact, divided by the shear stress [m/Pa].

    The divisor is the shear stress on the corrected contact area. The pixels in contact bear this stress times the ratio of the
    corrected contact area to their own area, so that the force is the same. operator: computes shear displacements. state:
    contact at one load.
    """
    assert state.pressure is not None
    spots = state.pressure > 0.0
    return float(np.std(operator(spots[None] * (state.area / state.area_pixels))[0][spots]))
