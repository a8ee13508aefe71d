r"""Hardness of a film on a substrate from deep impressions: Kao & Byrne 1981.

*Assumes*: impressions are deeper than about a fifth of the film thickness $t$. *Source*: [kao_byrne_1981], as restated by the
documentation of the NIMS toolbox. $H$ is the hardness of film and substrate together at the depth $\omega$, $H_s$ the hardness
of the substrate, $n_H$ the hardness of the film divided by $H_s$. With $v=\omega/t$,

$$
\frac H{H_s}=1+(n_H-1)\min\left(\frac{0.18}v,\,1\right)
$$

*Reconstructed*: near the surface $H$ is limited to the film's hardness; this is the project's own choice.
"""

import numpy as np

from stiction.engine.compiled import formula
from stiction.records.registry import Composite
from stiction.records.sources import Source

WEIGHT = 0.09  # k1


@formula
def value(hardness_ratio, depth_over_thickness, constant, exponent):
    """Return the hardness of film and substrate together divided by the substrate's, 1 + (H_f/H_s - 1) (2 k1) t/omega.

    At depths below 2 k1 t it is the film's hardness, H_f/H_s. hardness_ratio: H_f/H_s. depth_over_thickness: omega/t, with the
    depth omega and the film thickness t. constant: the number 2 k1. `exponent` is not used.
    """
    return 1.0 + (hardness_ratio - 1.0) * constant / max(depth_over_thickness, constant)


def constants(n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray) -> np.ndarray:
    """Return the constant 2 k1 = 0.18 for each contact, (n,); only the length of n_H is used."""
    return np.full_like(n_H, 2.0 * WEIGHT)


def landmarks(constant: np.ndarray, exponent: np.ndarray) -> np.ndarray:
    """Return depths (n, 9), divided by the film thickness, at which an integral over depth is split.

    The substrate contributes only beyond the first depth. constant: the number 2 k1 = 0.18 of each contact (n,). `exponent` is
    not used.
    """
    return constant[:, None] * np.array([1.0, 2.0, 6.0, 24.0, 100.0, 500.0, 3e3, 2e4, 2e5])


RECORD = Composite(
    key="kao_byrne_1981",
    title="Hardness of film and substrate together: the effect of the film falls as one over the depth",
    grade="C",
    property="hardness",
    value=value,
    constants=constants,
    landmarks=landmarks,
    sources=(Source("kao_byrne_1981", "", "as restated by the documentation of the NIMS toolbox"),),
    verified="independent evaluation; limit of the substrate alone",
    needs=("n_H", "tau"),
    notes="Valid for depths well above 0.18 t; at smaller depths the hardness is that of the film.",
)
