"""Tangential force at which an adhesive contact peels: Savkoor & Briggs 1977."""

import math

from ..compiled import formula


@formula
def slip_resistance(load, theta, K_beta):
    """T = 4 (K beta)^(-1/2) sqrt((2 pi/theta) P + 3 pi^2/theta^2), with P the load carried before shearing.

    Energy balance G_N + G_T = gamma at fixed load; eq (10) of the 2015 paper restated from the state before shearing
    (departure D6). The bracket is a perfect square for a JKR contact, so rounding alone can make it negative.
    """
    pull = math.pi / theta
    return 4.0 * math.sqrt(max(2.0 * pull * load + 3.0 * pull * pull, 0.0) / K_beta)


@formula
def slip_resistance_printed(x, theta, K_beta):
    """Eq (10) of the 2015 paper to the letter: T = 4 (K beta)^(-1/2) sqrt((2 pi/theta) x^(3/2) - 3 pi^2/theta^2)."""
    hertz = x * math.sqrt(x)
    return 4.0 * math.sqrt(max(2.0 * math.pi / theta * hertz - 3.0 * (math.pi / theta) ** 2, 0.0) / K_beta)
