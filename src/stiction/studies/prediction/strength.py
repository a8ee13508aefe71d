"""Sample the shear strength of the interface at zero pressure, tau_0, and its increase with pressure.

tau_0 is stated as a number, or given by the state of the interface. If neither is stated, it is a mixture over all states that
the pair of materials allows.
"""

from typing import Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.interfaces import Interface, interface, interface_weights
from stiction.laws.ageing.berthoud_1999 import factor
from stiction.studies.prediction.sampled_case import SampledCase, rows_of

# Shear strength by Tresca, Y/2, divided by the shear strength by von Mises, Y/sqrt(3).
_TRESCA = 0.5 * 3.0**0.5
# Ratio of the stated strength to the shear strength of the body above which a metal junction may fail in the body.
_NEAR_BODY = 0.5
# Standard deviation of ln of a strength or pressure coefficient stated as one number: within 2.5 % at 90 % (judgement, grade
# C). Without scatter the interval of a plastic contact, or of surfaces pressed flat, would have no width.
_STATED = 0.015


class Strength:
    """Describe the distribution of the shear strength of an interface over n samples and m points (contacts at a load).

    states: states of the interface with weights; empty if the contact has an interfacial_shear_strength. stated: tau_0 [Pa]
    from `exact_strength`, or None. coefficient: pressure coefficient stated by the contact, 0 if none. takes_states: whether
    the state of the interface supplies the pressure coefficient instead. coefficient_is_exact: whether this coefficient has one
    value, without a range. varied: values of the uncertain numbers and array
    parameters of a stated interface, by name. bodies: strengths of the touching surfaces. metallic: mask (1 or m,) of points
    with metal junctions. aged: factor by which the hold time raises tau_0. Other arrays are (n or 1, m or 1).
    """

    def __init__(self, sampled: SampledCase):
        from xarray import DataArray

        contact, self.bodies = sampled.drawn, sampled.bodies
        self.states, self.stated, self.coefficient = _states(sampled), None, sampled.column(0.0)
        number = exact_strength(contact)
        if number is not None:
            self.stated = sampled.column(number)
        if contact.pressure_coefficient is not None:
            self.coefficient = sampled.column(contact.pressure_coefficient)
        exact = _exact_coefficient(contact)
        self.coefficient_is_exact = exact is not None and len(sampled.column(exact)) == 1
        self.varied = _varied(contact.interface, sampled) if self.states and contact.interface is not None else {}
        self.metallic = sampled.metallic
        self.takes_states = contact.pressure_coefficient is None
        self.aged = sampled.column(1.0)
        if contact.hold_time is not None:
            groups, dims = sampled.groups
            self.aged = sampled.column(DataArray(factor(groups).reshape(tuple(dims.values())), dims=list(dims)))

    @property
    def grows_with_pressure(self) -> bool:
        """Return whether the strength of any possible state of the interface increases with pressure.

        It is False if a pressure coefficient is specified for the contact.
        """
        middle = np.array([0.5])
        return self.takes_states and any(np.any(state.pressure_coefficient_at(middle) > 0.0) for state, _ in self.states)

    @property
    def has_coefficient(self) -> bool:
        """Return whether a pressure coefficient, stated or supplied by a state of the interface, adds to friction."""
        return self.grows_with_pressure or bool(np.any(self.coefficient > 0.0))

    def is_relative_to(self, name: str) -> bool:
        """Return whether tau_0 of any possible state of the interface is a fraction of a property of the softer body.

        name: "shear_strength" for a fraction of its hardness, "strength_over_shear_modulus" for a fraction of its shear
        modulus.
        """
        return any(state.strength == name for state, _ in self.states)

    @property
    def over_body(self) -> float:
        """Return the median of the stated tau_0, after ageing, over the shear strength of the weaker body.

        It is 0 if tau_0 is not stated.
        """
        return 0.0 if self.stated is None else float(np.median(self.stated * self.aged / self.bodies.shear_strength))

    def states_drawn(self, level: np.ndarray) -> np.ndarray:
        """Return the index (n,) of the interface state that each quantile level (n,) selects; 0 if there is at most one."""
        ends = np.cumsum([weight for _, weight in self.states] or [1.0])
        return np.minimum(np.searchsorted(ends, level * ends[-1]), len(ends) - 1)

    def is_of_film(self, level: np.ndarray) -> np.ndarray:
        """Return whether the interface state that each sample selects was measured on films, (n, 1); False without states.

        level: quantile levels (n,) that select the state.
        """
        return np.array([state.of_film for state, _ in self.states] or [False])[self.states_drawn(level)][:, None]

    def hardens(self, strength: np.ndarray, shear_strength: np.ndarray) -> np.ndarray | float:
        """Return the mean degree, 0 to 1, to which the interface hardens together with a metal body, (n, m or 1) or a number.

        strength: tau_0 [Pa]. shear_strength: shear strength of the body [Pa]. The degree is 1 if tau_0 follows from the
        distribution of a state of the interface, such as "clean metal". For a tau_0 stated as a number, it increases from 0 at
        half the shear strength of the body to 1 at this strength.
        """
        return 1.0 if self.stated is None else np.clip((strength / shear_strength - _NEAR_BODY) / (1.0 - _NEAR_BODY), 0.0, 1.0)

    def at(self, state: np.ndarray, strength: np.ndarray, coefficient: np.ndarray, rows: np.ndarray):
        """Return the shear strength tau_0 [Pa] and the pressure coefficient of each of n samples, arrays (n, m or 1).

        state, strength, coefficient: quantile levels (n,) that select the state, tau_0 and the pressure coefficient. rows:
        index of the sampled input numbers of each sample (n,). tau_0 includes ageing. If a metal interface has a stated tau_0
        above half the shear strength of the body, it is at most that of clean metal. tau_0 is limited to the shear strength of
        the weaker body. After this limit, a strength that is stated as one number is scattered, and so is a stated coefficient.
        """
        from scipy.special import ndtri

        bodies = self.bodies
        hardness, shear, modulus = (
            rows_of(table, rows) for table in (bodies.hardness, bodies.shear_strength, bodies.shear_modulus)
        )
        alpha = rows_of(self.coefficient, rows)
        varied = {name: rows_of(table, rows) for name, table in self.varied.items()}
        shapes = [table.shape for table in varied.values()]
        tau = np.zeros(np.broadcast_shapes(hardness.shape, modulus.shape, *shapes))
        alpha = np.broadcast_to(alpha, np.broadcast_shapes((len(rows), alpha.shape[1]), *shapes)).copy()
        which = self.states_drawn(state)
        for index, (table, _) in enumerate(self.states):
            mine = which == index
            of_state = {name: values[mine] for name, values in varied.items()}
            tau[mine] = table.strength_at(strength[mine, None], hardness[mine], modulus[mine], of_state.get(table.strength))
            if self.takes_states:
                alpha[mine] = table.pressure_coefficient_at(coefficient[mine, None], of_state.get("pressure_coefficient"))
        if self.stated is not None:
            tau = rows_of(self.stated, rows)
        tau = tau * rows_of(self.aged, rows)
        if self.stated is not None and self.over_body > _NEAR_BODY:  # a strong metal interface fails as clean metal does
            clean = interface("clean metal").strength_at(strength[:, None], hardness, modulus)
            tau = np.where(self.metallic, np.minimum(tau, clean), tau)
        tau = _capped(tau, shear, strength[:, None], self.metallic)
        if self.stated is not None and len(self.stated) == len(self.aged) == 1:
            tau = tau * np.exp(_STATED * ndtri(strength[:, None]))
        if self.coefficient_is_exact:
            alpha = alpha * np.exp(_STATED * ndtri(coefficient[:, None]))
        return tau, alpha


def exact_strength(contact: Contact) -> Any:
    """Return tau_0 [Pa] if the contact specifies it, or its interface gives it as a stress without a range; else None.

    It is a number or a labelled array (xarray). A strength relative to hardness or shear modulus gives None.
    """
    state = contact.interface
    if contact.interfacial_shear_strength is None and state is not None and "interfacial_shear_strength" not in state.range:
        return state.interfacial_shear_strength
    return contact.interfacial_shear_strength


def _exact_coefficient(contact: Contact) -> Any:
    """Return the pressure coefficient if the contact specifies it, or its interface gives it without a range; else None."""
    state = contact.interface
    if contact.pressure_coefficient is None and state is not None and "pressure_coefficient" not in state.range:
        return state.pressure_coefficient
    return contact.pressure_coefficient


def _capped(tau: np.ndarray, shear: np.ndarray, level: np.ndarray, metallic: np.ndarray) -> np.ndarray:
    """Return the shear strength tau_0 [Pa] of the interface, limited by the shear strength of the weaker body.

    tau: tau_0 before this limit [Pa]. shear: shear strength of the body [Pa]. level: quantile levels (n, 1). metallic: mask of
    points with metal junctions. For metals the limit is the von Mises value. For other materials the quantile level selects a
    limit between the values of Tresca and von Mises. The width of this range grows from 0, if tau_0 is at most the body's
    strength, to its full size at twice that strength.
    """
    if metallic.all():
        return np.minimum(tau, shear)
    with np.errstate(divide="ignore"):
        beyond = np.clip(np.log2(tau / shear), 0.0, 1.0)
    return np.minimum(tau, np.where(metallic, shear, shear * (1.0 - (1.0 - _TRESCA) * beyond * (1.0 - level))))


def _varied(state: Interface, sampled: SampledCase) -> dict[str, np.ndarray]:
    numbers = {name: getattr(state, name) for name in (state.strength, "pressure_coefficient")}
    return {name: sampled.column(value) for name, value in numbers.items() if hasattr(value, "dims")}


def _states(sampled: SampledCase) -> list[tuple[Interface, float]]:
    contact = sampled.contact
    if contact.interfacial_shear_strength is not None:
        return []
    if contact.interface is not None:
        return [(contact.interface, 1.0)]
    return [(interface(name), weight) for name, weight in interface_weights(*contact.touching).items()]
