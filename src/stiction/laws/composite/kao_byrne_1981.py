r"""Hardness of a film on a substrate from deep impressions: Kao & Byrne 1981.

*Assumes*: impressions are deep. *Source*: [kao_byrne_1981], as restated by the documentation of the NIMS toolbox. With
$v=\omega/t$,

$$
\frac H{H_s}=1+(n_H-1)\min\left(\frac{0.18}v,\,1\right)
$$

*Reconstructed*: the limit to the film's hardness near the surface is this project's own.
"""

import numpy as np

from stiction.engine.compiled import formula
from stiction.records.registry import Composite
from stiction.records.sources import Source

WEIGHT = 0.09  # k1


@formula
def value(hardness_ratio, depth_over_thickness, constant, exponent):
    """Return the hardness of film and substrate over the substrate's, 1 + (H_f/H_s - 1) 2 k1 t/omega.

    Near the surface it is limited to the film's hardness. `exponent` is not used.
    """
    return 1.0 + (hardness_ratio - 1.0) * constant / max(depth_over_thickness, constant)


def constants(n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray) -> np.ndarray:
    """Return the constant 2 k1 = 0.18 (n,)."""
    return np.full_like(n_H, 2.0 * WEIGHT)


def landmarks(constant: np.ndarray, exponent: np.ndarray) -> np.ndarray:
    """Return depths over thickness (n, 9) at which to split the integration, from the first effect of the substrate on."""
    return constant[:, None] * np.array([1.0, 2.0, 6.0, 24.0, 100.0, 500.0, 3e3, 2e4, 2e5])


RECORD = Composite(
    key="kao_byrne_1981",
    title="Hardness of film and substrate: the film's share falls as one over the depth",
    grade="C",
    property="hardness",
    value=value,
    constants=constants,
    landmarks=landmarks,
    sources=(Source("kao_byrne_1981", "", "as restated by the documentation of the NIMS toolbox"),),
    verified="independent evaluation; the substrate alone in the limit",
    needs=("n_H", "tau"),
    notes="Meant for depths well above 0.18 t; nearer to the surface it is held at the film's hardness.",
)
