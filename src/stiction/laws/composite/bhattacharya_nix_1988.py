"""Hardness of a film on a substrate against depth, fitted to finite elements (a cone): Bhattacharya & Nix 1988."""

import numpy as np

from stiction.engine.compiled import formula
from stiction.engine.vectorised import exponential
from stiction.laws.registry import Composite
from stiction.laws.sources import Source


@formula
def value(hardness_ratio, depth_over_thickness, constant, exponent):
    """H/H_s = 1 + (H_f/H_s - 1) exp(-c (omega/t)^m), m = 1 or 2."""
    power = depth_over_thickness if exponent == 1.0 else depth_over_thickness * depth_over_thickness
    return 1.0 + (hardness_ratio - 1.0) * exponential(-constant * power)


def constants(n_E: np.ndarray, n_H: np.ndarray, n_Y: np.ndarray) -> np.ndarray:
    """c (n,): n_Y/n_E of a soft film, n_H/(n_Y sqrt(n_E)) of a hard one; n_Y: yield stress of the film over the substrate's."""
    return np.where(n_H < 1.0, n_Y / n_E, n_H / (n_Y * np.sqrt(n_E)))


def landmarks(constant: np.ndarray, exponent: np.ndarray) -> np.ndarray:
    """omega/t (n, 7) between which the hardness changes little enough to be integrated."""
    return constant[:, None] ** (-1.0 / exponent[:, None]) * np.array([0.25, 0.75, 1.5, 3.0, 6.0, 12.0, 30.0])


RECORD = Composite(
    key="bhattacharya_nix_1988",
    title="Hardness of film and substrate: the film's share fades with depth",
    grade="C",
    property="hardness",
    value=value,
    constants=constants,
    landmarks=landmarks,
    sources=(
        Source("bhattacharya_nix_1988", "", "as restated; sources disagree on m: 2 if soft and 1 if hard, or the other way"),
    ),
    verified="independent evaluation; film and substrate alone in the limits",
    needs=("n_E", "n_H", "tau"),
    notes="Fitted to conical indentation; used here for a sphere. The yield stresses are taken to be as the hardnesses.",
)
