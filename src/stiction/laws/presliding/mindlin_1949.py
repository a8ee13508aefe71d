r"""Presliding of one elastic contact under a tangential force: Mindlin 1949 (and, before him, Cattaneo 1938).

*Assumes*: elastic contacts that act alone. How stiff they are before they slide, with `presliding="mindlin_1949"`: *Source*:
[mindlin_1949], the stiffness at no force of each contact, summed to `tangential_stiffness`,

$$
k_t=\frac{8a}\beta\ \text{(SI)},\qquad\frac{8\sqrt A}{K\beta}\ \text{in the units here}
$$

For bodies alike $k_t/k_n=2(1-\nu)/(2-\nu)$. The module also has the partial slip of one Hertz contact under Coulomb friction
$f$,

$$
T=fP\left[1-(1-s)^{3/2}\right],\qquad s=\frac{\delta_t}{\delta_f},\quad\delta_f=\frac{3fP\beta}{16a}
$$

Plastic contacts are counted as if they were elastic; the body behind the asperities adds no compliance.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.laws.registry import Presliding, Validity
from stiction.laws.sources import Source


@formula
def stiffness(area, K_beta):
    """dT/d(displacement) at T = 0, when nothing slips: k_t = 8 a/beta for two bodies, 1/beta = G* of the pair.

    With a = sqrt(x R sigma), k_t sigma/(K R^(1/2) sigma^(3/2)) = 8 sqrt(x)/(K beta).
    """
    return 8.0 * math.sqrt(area) / K_beta


@formula
def sliding_displacement(load, area, friction, K_beta):
    """Displacement at which all of a Hertz contact slips, 3 mu P beta/(16 a): 3/2 of what the first stiffness would need."""
    return 1.5 * friction * load / stiffness(area, K_beta)


@formula
def force(displacement, load, area, friction, K_beta):
    """T = mu P (1 - (1 - s)^(3/2)), s = displacement/sliding displacement: slip spreads inwards from the rim, Coulomb's law
    holding at each point, until all slips at T = mu P."""
    left = max(1.0 - displacement / sliding_displacement(load, area, friction, K_beta), 0.0)
    return friction * load * (1.0 - left * math.sqrt(left))


@formula
def displacement(force, load, area, friction, K_beta):
    """The inverse, for 0 <= T <= mu P: the sliding displacement times 1 - (1 - T/(mu P))^(2/3)."""
    left = max(1.0 - force / (friction * load), 0.0)
    return sliding_displacement(load, area, friction, K_beta) * (1.0 - left ** (2.0 / 3.0))


@formula
def resistance(u, w, load, area, K_beta):
    """The stiffness, in the place of a force."""
    return stiffness(area, K_beta), 0.0


def tangential_resistance(piece: NormalPiece, groups: Groups) -> TangentialResistance:
    """On every piece: a contact is stiff by its radius, whatever carries the load."""
    return TangentialResistance(resistance, (groups.K_beta,), branch=np.array(piece.edges[:, 0]))


RECORD = Presliding(
    key="mindlin_1949",
    title="Tangential stiffness of contacts before they slide",
    grade="B",
    sources=(Source("mindlin_1949", "", "the stiffness at no force; partial slip as formulas beside it"),),
    tangential_resistance=tangential_resistance,
    verified="closed forms; ratio of tangential to normal stiffness 2 (1 - nu)/(2 - nu) for bodies alike",
    needs=("K_beta",),
    validity=(Validity("plasticity_index", 0.0, 0.6, "the contact is taken as elastic, plastic ones as if they were"),),
    notes="Asperities act alone; the nominal contact adds no compliance.",
)
