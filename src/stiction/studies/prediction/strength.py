"""Strength of the interface: tau_0 and its growth with pressure, as stated, of a state, or of all states the pair allows."""

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.interfaces import Interface, interface, interface_weights
from stiction.laws.ageing.berthoud_1999 import factor
from stiction.studies.prediction.asked import Asked

__all__ = ["Strength"]


class Strength:
    """The distribution of the strength of an interface.

    states: each with its weight, which sum to 1; none where the strength is stated. stated: tau_0 [Pa] (n, 1) or None.
    coefficient: its growth with pressure as stated (n, 1); takes_states: whether it is that of the state in place of it. aged:
    factor (n, 1) of tau_0 by rest.
    """

    def __init__(self, asked: Asked):
        contact, self.bodies = asked.drawn, asked.bodies
        self.states, self.stated, self.coefficient = _states(asked), None, asked.column(0.0)
        if contact.interfacial_shear_strength is not None:
            self.stated = asked.column(contact.interfacial_shear_strength)
        if contact.pressure_coefficient is not None:
            self.coefficient = asked.column(contact.pressure_coefficient)
        self.takes_states = contact.pressure_coefficient is None
        groups, _ = Groups.of(contact.indices())
        self.aged = asked.column(1.0 if groups.waiting is None else factor(groups))

    @property
    def over_body(self) -> float:
        """Return the stated strength over the shear strength of the weaker body; 0 where none is stated."""
        return 0.0 if self.stated is None else float(np.median(self.stated / self.bodies.shear_strength))

    def at(self, state: np.ndarray, strength: np.ndarray, coefficient: np.ndarray, rows: np.ndarray):
        """Return tau_0 [Pa], capped at the shear strength of the weaker body, and the pressure coefficient, arrays (n, 1).

        state, strength, coefficient: levels (n,). rows: of the inputs.
        """
        bodies = self.bodies
        hardness, shear, modulus = (
            one[rows % len(one)][:, 0] for one in (bodies.hardness, bodies.shear_strength, bodies.shear_modulus)
        )
        alpha = self.coefficient[rows % len(self.coefficient)][:, 0]
        if self.stated is not None:
            tau = self.stated[rows % len(self.stated)][:, 0]
        else:
            tau = np.zeros(len(rows))
            ends = np.cumsum([weight for _, weight in self.states])
            which = np.minimum(np.searchsorted(ends, state * ends[-1]), len(ends) - 1)
            for at, (one, _) in enumerate(self.states):
                mine = which == at
                tau[mine] = one.strength_at(strength[mine], hardness[mine], modulus[mine])
                if self.takes_states:
                    alpha[mine] = one.pressure_coefficient_at(coefficient[mine])
        tau = tau * self.aged[rows % len(self.aged)][:, 0]
        return np.minimum(tau, shear)[:, None], alpha[:, None]


def _states(asked: Asked) -> list[tuple[Interface, float]]:
    contact = asked.contact
    if contact.interfacial_shear_strength is not None:
        return []
    if contact.interface is not None:
        return [(contact.interface, 1.0)]
    return [(interface(name), weight) for name, weight in interface_weights(*contact.touching).items()]
