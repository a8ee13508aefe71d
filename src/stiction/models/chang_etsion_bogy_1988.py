"""Chang, Etsion & Bogy: contact of elastic-plastic asperities (1987) and the static friction of those still elastic (1988)."""

import math

import numpy as np

from ..asperity import hertz
from ..asperity.chang_etsion_bogy_1987 import (
    critical_interference,
    hardness_coefficient,
    plastic_along,
    plastic_coordinate,
)
from ..asperity.chowdhury_ghosh_1994 import hardness_group
from ..asperity.regime import Regime
from ..compiled import formula
from ..friction.chang_etsion_bogy_1988 import first_on_axis, friction_coefficient
from ..groups import Groups
from ..registry import Limit, Record, Validity
from ..sources import Source

_coordinate, _load = hertz.coordinate, hertz.load


@formula
def elastic_along(u, w_c, nu, K_H):
    """Hertz's asperity at u = sqrt(w). Shear makes it yield, so all its resistance is yield-limited."""
    w = u * u
    return w, 2.0 * u, w * u, w, 0.0, w * u * friction_coefficient(w / w_c, nu, K_H)


@formula
def elastic_coordinate(w, w_c, nu, K_H):
    return _coordinate(w)


@formula
def near_yield_along(u, w_c, nu, K_H):
    """The same at u = -sqrt(1 - w/w_c): on the axis the resistance vanishes as that square root."""
    w = w_c * (1.0 - u * u)
    P = _load(w)
    return w, -2.0 * w_c * u, P, w, 0.0, P * friction_coefficient(w / w_c, nu, K_H)


@formula
def near_yield_coordinate(w, w_c, nu, K_H):
    return -math.sqrt(max(1.0 - w / w_c, 0.0))


def regimes(groups: Groups) -> list[Regime]:
    """Elastic, first yielding at the trailing edge, then on the axis; plastic from omega_c on."""
    eta, K_H = hardness_group(groups.theta, groups.lam), hardness_coefficient(groups.nu)
    w_c = critical_interference(eta, K_H)
    on_axis = first_on_axis(groups.nu, K_H)
    parameters, zero = (w_c, groups.nu, K_H), np.zeros_like(w_c)
    edge = np.stack([zero, np.sqrt(on_axis * w_c)], axis=1)
    axis = np.stack([-np.sqrt(1.0 - on_axis), zero], axis=1)
    plastic = np.stack([w_c, np.full_like(w_c, np.inf)], axis=1)
    return [
        Regime(elastic_along, elastic_coordinate, parameters, edge, "elastic"),
        Regime(near_yield_along, near_yield_coordinate, parameters, axis, "elastic"),
        Regime(plastic_along, plastic_coordinate, (w_c, eta, K_H), plastic, "plastic"),
    ]


RECORD = Record(
    key="chang_etsion_bogy_1988",
    kind="rough surface",
    title="Elastic-plastic contact (1987) and static friction (1988) of rough surfaces, without adhesion",
    grade="B",
    sources=(
        Source("chang_etsion_bogy_1987", "critical interference, plastic load and area"),
        Source("chang_etsion_bogy_1988", "", "stress criteria as restated by Eriten, Polycarpou & Bergman 2010"),
        Source("hamilton_1983", "stresses on the axis and at the edge"),
    ),
    regimes=regimes,
    verified="independent integrals at 30 digits; friction of single asperities tabulated independently",
    needs=("theta", "lam", "nu"),
    validity=(
        Validity("plasticity_index", 0.0, 0.6, "plastic asperities are given no friction: mu falls to nothing above"),
        Validity("theta", 10.0, math.inf, "adhesion is left out"),
    ),
    limits=(
        Limit("greenwood_williamson_1966", {"theta": 1.0, "lam": 1e24}, ("load", "contact_area"), 1e-9),
    ),
    load_falls=False,
    notes="The load of an asperity jumps by 1.5 at the critical interference. Adhesion of the 1988 papers is left out.",
)
