"""Select and combine parts of sums over asperities by the labels of their regimes."""

import numpy as np

from stiction.engine.regime import Regime
from stiction.quantities.quotient import quotient


def sum_selected(parts: np.ndarray, chosen: list[bool]) -> np.ndarray:
    """Return the sum (n, m) over the selected regimes of `parts` (regimes, n, m).

    chosen: for each regime, whether it is selected.
    """
    return parts[chosen].sum(axis=0)


def states_of(regimes: list[Regime]) -> list[str]:
    """Return the asperity states to report: "elastic", "plastic", and "elastic-plastic" if a regime has this state."""
    return list(
        dict.fromkeys(["elastic", "plastic", *(regime.state for regime in regimes if regime.state == "elastic-plastic")])
    )


def share_beyond(regimes: list[Regime], parts: np.ndarray) -> np.ndarray:
    """Return the fraction (n, m) of summed absolute `parts` from regimes too deep for the film law to be valid.

    parts: (regimes, n, m), loads or friction forces. The fraction is 0 where all parts are 0.
    """
    sizes = np.abs(parts)
    return quotient(sum_selected(sizes, [not regime.in_half_space for regime in regimes]), sizes.sum(axis=0), 0.0)


def share_without(regimes: list[Regime], loads: np.ndarray, friction: np.ndarray) -> np.ndarray:
    """Return the fraction (n, m) of the load on asperities without full tangential resistance.

    loads, friction: (regimes, n, m). Two kinds of regimes count: regimes without friction, and regimes in which part of the
    contact flows plastically. The fraction is relative to the net load, which attractive regimes reduce. It is at most 1,
    and 0 where the net load is 0.
    """
    flowing = np.array([regime.yields_by_degrees for regime in regimes])[:, None, None]
    lost, net = np.where(flowing | (friction == 0.0), np.abs(loads), 0.0).sum(axis=0), np.abs(loads.sum(axis=0))
    return np.minimum(quotient(lost, net, 0.0), 1.0)
