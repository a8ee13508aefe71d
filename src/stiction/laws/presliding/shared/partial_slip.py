"""Derive the force, stiffness and sticking area of tangentially displaced contacts from a tangential law.

Each function returns a tangential law in which the strength of a contact is replaced by one of these quantities, before and
during sliding. The engine then sums this quantity over heights. Equations and sources are in
`laws/presliding/mindlin_1949.py`.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.crossings import crossing
from stiction.engine.regime import columns
from stiction.laws.joining import coordinates, with_kinks
from stiction.laws.presliding.mindlin_1949 import loss_share, slip_share, stiffness
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.records.registry import TangentialLaw

_DEEPEST = 100.0  # displacement over sigma beyond which no asperity contributes
_MOST = 4  # largest number of changes between sticking and sliding on a segment


@cache
def _slipping(resistance: Callable, own: int) -> Any:
    """Return a formula for two numbers of a displaced asperity: its tangential force and its energy loss per cycle.

    resistance: formula of the strength, with `own` parameters. The returned formula takes these parameters, then K beta, the
    tangential displacement in units of sigma, and the fraction of its strength that a sliding asperity retains. The energy is
    in the unit of force times sigma, and does not depend on this fraction. Both numbers are 0 for an asperity without strength.
    """
    compliance, moved, residual = own, own + 1, own + 2

    @formula
    def slipping(u, w, load, area, *row):
        slip_limited, yield_limited = resistance(u, w, load, area, *row[:own])
        strength = slip_limited + yield_limited
        if strength <= 0.0:
            return 0.0, 0.0
        slides_at = 1.5 * strength / stiffness(area, row[compliance])
        s = row[moved] / slides_at
        force = strength * slip_share(s) if s < 1.0 else strength * row[residual]
        return force, strength * slides_at * loss_share(s)

    return slipping


@cache
def _sticking_area(resistance: Callable, own: int) -> Any:
    """Return a formula that gives (contact area that still sticks, 0) for a tangentially displaced asperity.

    resistance: formula of the strength, with `own` parameters. The returned formula takes these parameters, then K beta and the
    displacement in units of sigma.
    """
    compliance, moved = own, own + 1

    @formula
    def sticking_area(u, w, load, area, *row):
        slip_limited, yield_limited = resistance(u, w, load, area, *row[:own])
        strength = slip_limited + yield_limited
        if strength <= 0.0:
            return 0.0, 0.0
        return area * max(1.0 - row[moved] * stiffness(area, row[compliance]) / (1.5 * strength), 0.0), 0.0

    return sticking_area


@cache
def _not_yet(normal: Callable, parameters: int, resistance: Callable, own: int) -> Any:
    count = parameters + own

    @formula
    def not_yet(u, row):
        """Return a number that is positive while the asperity at the coordinate u does not slide yet.

        It is 3/2 of the strength minus the initial tangential stiffness times the tangential displacement. row: parameters of
        the asperity law and of the strength, then K beta and the displacement in units of sigma.
        """
        w, _, load, area = normal(u, *row[:parameters])
        slip_limited, yield_limited = resistance(u, w, load, area, *row[parameters:count])
        return 1.5 * (slip_limited + yield_limited) - row[count + 1] * stiffness(max(area, 0.0), row[count])

    return not_yet


def slipping_law(tangential: TangentialLaw, displacement: np.ndarray, residual: float) -> TangentialLaw:
    """Return a tangential law that gives the force of contacts at a tangential displacement, in place of their strength.

    tangential: tangential law that gives the strength. displacement (n,): in units of sigma. residual: fraction of its strength
    that an asperity retains once it slides. The slip-limited part of the returned law is the force. Its yield-limited part is
    the energy lost per cycle of this amplitude, in the unit of force times sigma; it is valid only for a residual of 1.
    """
    return _displaced(tangential, _slipping, displacement, np.full(len(displacement), residual))


def sticking_area_law(tangential: TangentialLaw, displacement: np.ndarray) -> TangentialLaw:
    """Return a tangential law whose resistance is the contact area that still sticks at a tangential displacement.

    tangential: tangential law that gives the strength. displacement (n,): in units of sigma. Contacts without strength have no
    sticking area.
    """
    return _displaced(tangential, _sticking_area, displacement)


def _displaced(
    tangential: TangentialLaw, formula_of: Callable, displacement: np.ndarray, *parameters: np.ndarray
) -> TangentialLaw:
    """Return a tangential law in which the strength is replaced by a formula for displaced contacts.

    tangential: tangential law that gives the strength. formula_of(resistance, number of its parameters): returns the formula
    that replaces the strength; it takes the parameters of the strength, then K beta, the displacement (n,) in units of sigma
    and `parameters`. Coordinates at which asperities begin to slide become kinks and branch points of the law.
    """

    def resistance(segment: NormalSegment, groups: Groups, **options: str) -> TangentialResistance | None:
        strength = tangential.tangential_resistance(segment, groups, **options)
        if strength is None:
            return None
        more = groups.K_beta, displacement, *parameters
        begins = _sliding_onsets(segment, strength, more[:2])
        branches = [begins] if strength.branch is None else [np.reshape(strength.branch, (len(begins), -1)), begins]
        kinks = begins if strength.kinks is None else np.concatenate([strength.kinks, begins], axis=1)
        return TangentialResistance(
            formula_of(strength.resistance, len(strength.parameters)),
            (*strength.parameters, *more),
            kinks,
            np.concatenate(branches, axis=1),
        )

    return replace(tangential, tangential_resistance=resistance)


@cache
def _sticking(resistance: Callable, own: int) -> Any:
    compliance = own

    @formula
    def sticking(u, w, load, area, *row):
        slip_limited, yield_limited = resistance(u, w, load, area, *row[:own])
        return (stiffness(area, row[compliance]) if slip_limited + yield_limited > 0.0 else 0.0), 0.0

    return sticking


def sticking_law(tangential: TangentialLaw) -> TangentialLaw:
    """Return a tangential law whose resistance is the tangential stiffness of the contacts at zero tangential displacement.

    tangential: tangential law that gives the strength. Contacts without strength have no stiffness.
    """

    def resistance(segment: NormalSegment, groups: Groups, **options: str) -> TangentialResistance | None:
        strength = tangential.tangential_resistance(segment, groups, **options)
        if strength is None:
            return None
        formula_of = _sticking(strength.resistance, len(strength.parameters))
        first = np.array(segment.edges[:, :1])
        branches = [first] if strength.branch is None else [np.reshape(strength.branch, (len(first), -1)), first]
        return TangentialResistance(
            formula_of, (*strength.parameters, groups.K_beta), strength.kinks, np.concatenate(branches, axis=1)
        )

    return replace(tangential, tangential_resistance=resistance)


def _sliding_onsets(segment: NormalSegment, strength: TangentialResistance, more: tuple[np.ndarray, ...]) -> np.ndarray:
    """Return the coordinates (n, 4) on a segment at which asperities change between sticking and sliding.

    strength: resistance of the asperities to sliding. more: K beta and the tangential displacement in units of sigma, arrays
    (n,). Displacements w beyond 100 sigma are not searched. Unused entries are the first coordinate of the segment.
    """
    edges = with_kinks(segment.edges, strength.kinks)
    edges = np.ascontiguousarray(np.minimum(edges, coordinates(segment, _DEEPEST)[:, None]))
    excess = _not_yet(segment.normal, len(segment.parameters), strength.resistance, len(strength.parameters))
    parameters = (*segment.parameters, *strength.parameters, *more)
    out = np.empty((len(edges), _MOST))
    crossing(excess, len(parameters))(columns(parameters, len(edges)), edges, out)
    return out
