r"""Menisci around elastic asperities, with a force that falls with displacement: Maugis's ring on Hertz's shape.

*Assumes*: as [`equilibrium_meniscus`](#equilibrium_meniscus), but the gap around the contact is Hertz's. The ring of liquid
then acts like the attracting ring of [`maugis_1992`](#maugis_1992), with the stress $\gamma_\mathrm L/r$ and the range $2rc$.
It is computed for small Tabor parameters, where it does not deform the solids. *Source*: [maugis_gauthier_manuel_1994], as
[intersurface_adhesion_2018] reports it, treats a meniscus as such a ring: JKR's law in dry air, DMT's in moist air. The
equations follow [maugis_1992] to first order in its parameter $\lambda_M$ of the attraction and are derived here. With
$s=a/\sqrt{b^2-a^2}$, where $a$ is the inner radius of the ring (contact radius) and $b$ the outer radius,

$$
F=s+(1-s^2)\arctan\tfrac1s,\qquad w=\frac{\pi w_\mathrm ms^2}F,\qquad
P=-\frac{2\pi}{\theta_\mathrm m}\left(\frac{2\arctan(1/s)}F-1\right)\quad(w\ge0)
$$

The other symbols, such as the meniscus height $w_\mathrm m=2rc/\sigma$, are those of `equilibrium_meniscus`. If the asperity
does not touch, the linear force of `equilibrium_meniscus` applies; the force is continuous at first touch.

*Limit*: the force of `equilibrium_meniscus` for $w\ll w_\mathrm m$, and half of it for $w\gg w_\mathrm m$, which is DMT's
force as the derivative of an energy, $-2\gamma_\mathrm Lc\,\mathrm d(\pi a^2)/\mathrm d\omega$. *Check*:

| $w/w_\mathrm m$ | 0 | 0.1 | 1 | 10 | 100 |
|---|---|---|---|---|---|
| force over $4\pi R\gamma_\mathrm Lc$ | 1 | 0.7958 | 0.6295 | 0.5355 | 0.5081 |

*Trap*: this is the force at a given displacement. The missing part of the force acts to widen the contact, but the area here
is still Hertz's area at this displacement. At a given contact area the force grows instead: to first order in $\lambda_M$ it
is

$$
\frac{s+(1+s^2)\arctan\frac1s}F=\ 1.086,\ 1.643,\ 4.659\quad\text{times}\ 4\pi R\gamma_\mathrm Lc\ \text{for}\
w/w_\mathrm m=0.1,\ 1,\ 10
$$

Friction by a law of the interface is therefore too low here, more so than with `equilibrium_meniscus`. Use this law for loads
and pull-off forces. Results carry a validity warning above $w=0.1\,w_\mathrm m$.

*Comparison*, on the maps of `equilibrium_meniscus`: this law gives 0.27 to 0.79 times the computed force (mean 0.48), and 1.00
to 1.03 times on flooded maps.

*Units*: $w=\omega/\sigma$, $P$ in units of $KR^{1/2}\sigma^{3/2}$. Full list: [symbols](#1-units).
"""

import math
from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import MENISCUS, Regime
from stiction.laws.asperity import maugis_1992
from stiction.laws.meniscus import equilibrium_meniscus
from stiction.laws.meniscus.kind import Meniscus
from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import Limit, Validity
from stiction.records.sources import Source

_ring = maugis_1992.ring


@formula
def along(s, pull, height):
    """Return the six values of a ring of liquid that a `Regime` requires: displacement w, dw/ds, load, 0, 0, 0.

    The zeros are contact area and tangential forces. s = a/sqrt(b^2 - a^2), with the inner radius a and the outer radius b of
    the ring. pull: attractive force at first touch, in units of K R^(1/2) sigma^(3/2). height: largest bridged gap in units of
    sigma. At s = infinity the load is -pull/2.
    """
    if s == math.inf:
        return math.inf, math.inf, -0.5 * pull, 0.0, 0.0, 0.0
    F, F_falls, _, _, turn = _ring(s)
    w = math.pi * height * s * s / F
    slope = math.pi * height * s * (2.0 + s * s * F_falls / F) / F
    return w, slope, -pull * (2.0 * turn / F - 1.0), 0.0, 0.0, 0.0


@formula
def coordinate(w, pull, height):
    """Return the coordinate s of a ring of liquid at the displacement w in units of sigma, or 0 for w <= 0.

    height: largest bridged gap w_m in units of sigma. Newton's method solves w = pi w_m s^2/F(s). It starts at an upper
    bound of s, which follows from F <= pi/2 and F <= 4/(3 s). `pull` is not used.
    """
    if w == math.inf:
        return math.inf
    y = max(w, 0.0) / (math.pi * height)
    s = min(math.sqrt(0.5 * math.pi * y), (4.0 / 3.0 * y) ** (1.0 / 3.0))
    for _ in range(60):
        F, F_falls, _, _, _ = _ring(s)
        step = (s * s - y * F) / (s * (2.0 + s * s * F_falls / F)) if s > 0.0 else 0.0
        s -= step
        if step <= 1e-14 * s:
            break
    return s


def pull(groups: Groups) -> list[Regime]:
    """Return two regimes: menisci that bridge a gap, for -w_m <= w <= 0, and rings of liquid around contacts, for w >= 0.

    w is the displacement of the asperity and w_m the largest bridged gap, both in units of sigma.
    """
    bridging = equilibrium_meniscus.pull(groups)[0]
    edges = np.tile([0.0, np.inf], (len(groups), 1))
    ring = Regime(along, coordinate, bridging.parameters, edges, MENISCUS, touching=False)
    return [replace(bridging, edges=bridging.edges[:, :2]), ring]


RECORD = Meniscus(
    key="hertzian_meniscus",
    title="Menisci in equilibrium with the vapour, around elastic contacts",
    grade="B",
    sources=(
        Source("maugis_1992", "", "the attracting ring, to first order in the attraction; derived here"),
        Source("maugis_gauthier_manuel_1994", "", "a meniscus treated as such a ring; not available"),
        Source("intersurface_adhesion_2018", "introduction", "report of the work of 1994"),
        Source("thomson_1871", "", "Kelvin's equation: the radius of a meniscus at a given humidity"),
    ),
    pull=pull,
    required_traits={"Hertz's shape": "it assumes the gap around a Hertz contact"},
    verified="the energy of a ring of liquid on Hertz's gap, differentiated numerically at 30 digits",
    needs=("meniscus_index", "meniscus_height"),
    validity=(
        *equilibrium_meniscus.VALIDITY,
        replace(
            equilibrium_meniscus.PULL_ON_MAPS,
            why="solved height maps give up to 3.8 times the meniscus force of this law, so mu may be too low",
        ),
        ELASTIC,
        Validity(
            "penetration_over_meniscus", 0.0, 0.1, "menisci widen the contact, which the law neglects; area and mu are too low"
        ),
    ),
    limits=(Limit("equilibrium_meniscus", {"meniscus_index": 1.0, "meniscus_height": 1e8}, ("load",), 0.002),),
)
