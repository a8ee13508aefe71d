"""Strength of the interface: tau_0 and its growth with pressure, as stated, of a state, or of all states the pair allows."""

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.interfaces import Interface, interface, interface_weights
from stiction.laws.ageing.berthoud_1999 import factor
from stiction.studies.prediction.asked import Asked

__all__ = ["Strength"]


# Shear strength by Tresca, Y/2, over that by Mises, Y/sqrt(3).
_TRESCA = 0.5 * 3.0**0.5


# Stated strength over that of the body, below which no metal is so weak that it fails in the body.
_NEAR_BODY = 0.5


class Strength:
    """Hold the distribution of the strength of an interface.

    states: with weights that sum to 1; none where the strength is stated. stated: tau_0 [Pa] or None. coefficient: its growth
    with pressure as stated; takes_states: whether that of the state replaces it. aged: factor of tau_0 by hold time. Arrays (n
    or 1, m or 1) over draws and points.
    """

    def __init__(self, asked: Asked):
        from xarray import DataArray

        contact, self.bodies = asked.drawn, asked.bodies
        self.states, self.stated, self.coefficient = _states(asked), None, asked.column(0.0)
        if contact.interfacial_shear_strength is not None:
            self.stated = asked.column(contact.interfacial_shear_strength)
        if contact.pressure_coefficient is not None:
            self.coefficient = asked.column(contact.pressure_coefficient)
        self.metallic = asked.metallic
        self.takes_states = contact.pressure_coefficient is None
        groups, dims = Groups.of(contact.indices())
        self.aged = asked.column(1.0)
        if groups.waiting is not None:
            self.aged = asked.column(DataArray(factor(groups).reshape(tuple(dims.values())), dims=list(dims)))

    @property
    def grows_with_pressure(self) -> bool:
        """Return whether a state of the interface adds strength in proportion to pressure."""
        middle = np.array([0.5])
        return self.takes_states and any(np.any(one.pressure_coefficient_at(middle) > 0.0) for one, _ in self.states)

    @property
    def over_body(self) -> float:
        """Return the stated strength, aged, over the shear strength of the weaker body; 0 where none is stated."""
        return 0.0 if self.stated is None else float(np.median(self.stated * self.aged / self.bodies.shear_strength))

    def at(self, state: np.ndarray, strength: np.ndarray, coefficient: np.ndarray, rows: np.ndarray):
        """Return tau_0 [Pa], capped at the shear strength of the weaker body, and the pressure coefficient, arrays (n, m or 1).

        state, strength, coefficient: levels (n,). rows: of the inputs.
        """
        bodies = self.bodies
        hardness, shear, modulus = (
            one[rows % len(one)] for one in (bodies.hardness, bodies.shear_strength, bodies.shear_modulus)
        )
        alpha = self.coefficient[rows % len(self.coefficient)]
        if self.stated is not None:
            tau = self.stated[rows % len(self.stated)]
        else:
            tau = np.zeros(np.broadcast_shapes(hardness.shape, modulus.shape))
            alpha = np.broadcast_to(alpha, (len(rows), alpha.shape[1])).copy()
            ends = np.cumsum([weight for _, weight in self.states])
            which = np.minimum(np.searchsorted(ends, state * ends[-1]), len(ends) - 1)
            for at, (one, _) in enumerate(self.states):
                mine = which == at
                tau[mine] = one.strength_at(strength[mine, None], hardness[mine], modulus[mine])
                if self.takes_states:
                    alpha[mine] = one.pressure_coefficient_at(coefficient[mine, None])
        tau = tau * self.aged[rows % len(self.aged)]
        if self.stated is not None and self.over_body > _NEAR_BODY:  # a metal's then fails as clean metal does
            clean = interface("clean metal").strength_at(strength[:, None], hardness, modulus)
            tau = np.where(self.metallic, np.minimum(tau, clean), tau)
        return _capped(tau, shear, strength[:, None], self.metallic), alpha


def _capped(tau: np.ndarray, shear: np.ndarray, level: np.ndarray, metallic: np.ndarray) -> np.ndarray:
    """Return tau_0, at most the shear strength of the weaker body.

    Beyond that strength it lies between the values of Tresca and Mises; from twice the strength on, anywhere between them at
    this level. For metals the growth of junctions is wider by far.
    """
    with np.errstate(divide="ignore"):
        beyond = np.clip(np.log2(tau / shear), 0.0, 1.0)
    return np.minimum(tau, np.where(metallic, shear, shear * (1.0 - (1.0 - _TRESCA) * beyond * (1.0 - level))))


def _states(asked: Asked) -> list[tuple[Interface, float]]:
    contact = asked.contact
    if contact.interfacial_shear_strength is not None:
        return []
    if contact.interface is not None:
        return [(contact.interface, 1.0)]
    return [(interface(name), weight) for name, weight in interface_weights(*contact.touching).items()]
