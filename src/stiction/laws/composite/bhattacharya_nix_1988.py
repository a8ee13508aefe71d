r"""Hardness of a film on a substrate as a function of depth, fitted to finite elements (a cone): Bhattacharya & Nix 1988.

*Assumes*: a fit to finite elements of conical indentation. *Source*: [bhattacharya_nix_1988], as restated in later works. $H$
is the hardness of film and substrate together at the depth $\omega$, $H_s$ the hardness of the substrate. $n_H$, $n_E$ and
$n_Y$ are hardness, modulus and yield stress of the film, each divided by the substrate's; $n_Y=n_H$ is assumed here. With the
film thickness $t$ and $v=\omega/t$,

$$
\frac H{H_s}=1+(n_H-1)\,e^{-c\,v^m},\qquad c=\frac{n_Y}{n_E}\ (n_H<1),\quad c=\frac{n_H}{n_Y\sqrt{n_E}}\ (n_H>1)
$$

*Unknown*: secondary sources disagree whether $m$ is 2 for soft and 1 for hard films (the default here) or the reverse
(`soft_film_exponent="1"` of [`halling_1979`](#halling_1979)). *Check*: $H/H_s$ for both exponents:

| $n_E$, $n_H$ | $m$ | $v=0$ | 0.25 | 0.5 | 1 | 2 | 4 |
|---|---|---|---|---|---|---|---|
| 0.5, 0.5 | 1 | 0.500 | 0.611 | 0.697 | 0.816 | 0.932 | 0.991 |
| | 2 | 0.500 | 0.530 | 0.611 | 0.816 | 0.991 | 1.000 |
| 0.5, 0.2 | 1 | 0.200 | 0.276 | 0.345 | 0.464 | 0.641 | 0.838 |
| | 2 | 0.200 | 0.220 | 0.276 | 0.464 | 0.838 | 0.999 |
| 1.5, 0.5 | 1 | 0.500 | 0.540 | 0.577 | 0.642 | 0.743 | 0.868 |
| | 2 | 0.500 | 0.510 | 0.540 | 0.642 | 0.868 | 0.998 |
| 2.5, 0.5 | 1 | 0.500 | 0.524 | 0.548 | 0.591 | 0.665 | 0.775 |
| | 2 | 0.500 | 0.506 | 0.524 | 0.591 | 0.775 | 0.980 |
"""

import numpy as np

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.records.registry import Composite
from stiction.records.sources import Source


@formula
def value(hardness_ratio, depth_over_thickness, constant, exponent):
    """Return the hardness of film and substrate together divided by the substrate's: 1 + (H_f/H_s - 1) exp(-c (omega/t)^m).

    hardness_ratio: H_f/H_s, film to substrate. depth_over_thickness: omega/t, with the depth omega and the film thickness
    t. constant: c. exponent: m, 1 or 2.
    """
    power = depth_over_thickness if exponent == 1.0 else depth_over_thickness * depth_over_thickness
    return 1.0 + (hardness_ratio - 1.0) * exponential(-constant * power)


def constants(n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray) -> np.ndarray:
    """Return the constant c (n,) in the exponent by which the film's effect on the hardness decays with depth.

    c is n_Y/n_E for a soft film (n_H < 1), n_H/(n_Y sqrt(n_E)) for n_H >= 1. n_E, n_H, n_Y: modulus, hardness and yield stress
    of the film divided by the substrate's.
    """
    return np.where(n_H < 1.0, n_Y / n_E, n_H / (n_Y * np.sqrt(n_E)))


def landmarks(constant: np.ndarray, exponent: np.ndarray) -> np.ndarray:
    """Return depths (n, 7), divided by the film thickness, at which an integral over depth is split.

    Between two neighbouring depths the decay changes by at most 0.5. constant, exponent: c and m (n,) of the decay exp(-c
    (depth/thickness)^m).
    """
    return constant[:, None] ** (-1.0 / exponent[:, None]) * np.array([0.25, 0.75, 1.5, 3.0, 6.0, 12.0, 30.0])


RECORD = Composite(
    key="bhattacharya_nix_1988",
    title="Hardness of film and substrate together: the effect of the film decays exponentially with depth",
    grade="C",
    property="hardness",
    value=value,
    constants=constants,
    landmarks=landmarks,
    sources=(
        Source("bhattacharya_nix_1988", "", "as restated; sources disagree on m: 2 for soft and 1 for hard films, or reverse"),
    ),
    verified="independent evaluation; limits of the film alone and of the substrate alone",
    needs=("n_E", "n_H", "tau"),
    notes="Fitted to conical indentation; used here for a sphere. Yield stresses are assumed proportional to hardnesses.",
)
