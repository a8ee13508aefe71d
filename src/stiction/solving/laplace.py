"""Limit the pull of menisci to the Laplace pressure times the area where the solids do not touch.

The limit is gamma/r (A_n - A), with surface tension gamma, Kelvin radius r, nominal area A_n and contact area A. Meniscus laws
describe a single asperity. Where neighbouring menisci merge, the sum over asperities counts the shared area repeatedly and can
exceed this physical limit.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import MENISCUS, Regime
from stiction.engine.summation import QUANTITIES

_LOAD, _AREA = QUANTITIES.index("load"), QUANTITIES.index("area")


def most_pull(groups: Groups) -> np.ndarray | None:
    """Return two factors (2, n) that determine the upper bound of the meniscus pull of n contacts.

    The first is gamma/(r N) in units of K R^(1/2) sigma^(3/2), the largest pull per asperity, with surface tension gamma,
    Kelvin radius r and asperity density N (K: 4/3 of the contact modulus, R: asperity radius, sigma: rms height). The
    second is pi N R sigma, which converts a normalised area to an area fraction. The result is None if the asperity density
    is unknown or there is no liquid.
    """
    if groups.roughness_parameter is None or groups.meniscus_index is None or groups.meniscus_height is None:
        return None
    pressure = 1.0 / (groups.meniscus_index * groups.meniscus_height * groups.roughness_parameter)
    return np.stack([pressure, np.pi * groups.roughness_parameter])


def pull_and_bound(sums: np.ndarray, regimes: list[Regime], most: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the meniscus pull contained in sums over asperities, and its upper bound, (...,) each, normalised per asperity.

    sums (regimes, ..., 5): only regimes with the state "meniscus" contribute to the pull. most: factors (2, ...) from
    `most_pull`. The bound is the Laplace pressure times the part of the nominal area that is not in contact.
    """
    pull = -sums[_of_menisci(regimes), ..., _LOAD].sum(axis=0)
    return pull, most[0] * np.clip(1.0 - most[1] * sums[..., _AREA].sum(axis=0), 0.0, 1.0)


def bounded(sums: np.ndarray, regimes: list[Regime], most: np.ndarray) -> np.ndarray:
    """Scale the meniscus loads in the sums (regimes, ..., 5) down to their upper bound, in place, and return the sums.

    most: factors (2, ...) from `most_pull`.
    """
    pull, bound = pull_and_bound(sums, regimes, most)
    above = pull > bound
    if above.any():
        sums[_of_menisci(regimes), ..., _LOAD] *= np.where(above, bound, 1.0) / np.where(above, pull, 1.0)
    return sums


def _of_menisci(regimes: list[Regime]) -> list[int]:
    return [index for index, regime in enumerate(regimes) if regime.state == MENISCUS]
