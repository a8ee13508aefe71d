"""The most that a liquid between two faces can pull: Laplace's pressure, gamma/r, on the nominal area.

Laws of menisci know one asperity each. Where the menisci of neighbours meet, their sum counts what they share as often as they
share it, and may pass this bound; nothing can.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import MENISCUS, Regime
from stiction.engine.summation import QUANTITIES

__all__ = ["bounded", "most_pull"]

_LOAD = QUANTITIES.index("load")


def most_pull(groups: Groups) -> np.ndarray | None:
    """gamma A_n/r per asperity and normalised (n,): gamma/(r N) over K R^(1/2) sigma^(3/2); None where the density of
    asperities is not known, or there is no liquid."""
    if groups.roughness_parameter is None or groups.meniscus_index is None or groups.meniscus_height is None:
        return None
    return 1.0 / (groups.meniscus_index * groups.meniscus_height * groups.roughness_parameter)


def bounded(sums: np.ndarray, regimes: list[Regime], most: np.ndarray) -> np.ndarray:
    """The sums (regimes, ..., 5), with loads of menisci that together pull by no more than `most` (...,). Changes them."""
    wet = [at for at, regime in enumerate(regimes) if regime.state == MENISCUS]
    pull = -sums[wet, ..., _LOAD].sum(axis=0)
    above = pull > most
    if above.any():
        share = np.where(above, most, 1.0) / np.where(above, pull, 1.0)
        sums[wet, ..., _LOAD] *= share
    return sums
