r"""Menisci in equilibrium with their vapour, by Kelvin's radius and the circle approximation: Orr, Scriven & Rivas 1975.

*Assumes*: the meniscus neither grows nor dries up: its total curvature is $1/r$, Kelvin's, at every distance (slow approach
and parting, seconds in humid air); it is small beside the asperity, $r\ll R$; the pull leaves the shape of the solids as it
is (as in DMT's law), and the sphere, where it is pressed in, as one that is cut off. Menisci of neighbours do not meet.
*Sources*: [thomson_1871] for the radius; [orr_scriven_rivas_1975] for the circle approximation and the exact meniscus; force
of a sphere and a flat as [israelachvili_2011] and [butt_kappl_2009] review it, written down from memory and derived again:
Laplace's pressure $\gamma_\mathrm L/r$ on the ring $2\pi R(2rc-D)$. Menisci between rough surfaces, each in equilibrium:
[de_boer_de_boer_2007], of which the abstract was seen: its result for a sphere and a flat is met, below. Radii at which
Kelvin's equation was found to hold: [fisher_gamble_middlehurst_1981]; surface tension of water: [iapws_2014].

$$
r=\frac{\gamma_\mathrm LV_\mathrm L}{R_\mathrm gT\ln(p_\mathrm s/p)},\quad c=\frac{\cos\theta_1+\cos\theta_2}2,\qquad
F=4\pi R\gamma_\mathrm Lc\left(1-\frac D{2rc}\right)\quad(0\le D\le2rc)\quad\text{(SI)}
$$

$$
P=-\frac{2\pi}{\theta_\mathrm m}\min\left(1,\;1+\frac w{w_\mathrm m}\right)\quad(w\ge-w_\mathrm m),\qquad
\theta_\mathrm m=\frac{K\sigma^{3/2}}{2\gamma_\mathrm Lc\sqrt R},\quad w_\mathrm m=\frac{2rc}\sigma
$$

It is added to what the asperity law carries. An asperity that does not touch is bridged, and pulls, from a gap of $2rc$ on.
All of them together pull at most with Laplace's pressure where the solids do not touch, $\gamma_\mathrm L(A_n-A)/r$.
No area and no resistance to sliding are the meniscus's own: it presses the solids together, and the tangential law sees the
load that they carry. A work of adhesion, if the contact states one, is what the solids have inside the liquid. With a film
the liquid is on its surface.

*Limit*: no humidity, $w_\mathrm m\to0$: still the whole pull of those that touch, as the force in contact does not depend on
$r$. Where $r$ is a few molecules there is no such meniscus; results say so below the radii at which Kelvin's equation was
confirmed, 4 nm, of water 9 nm: below 94 % relative humidity.

*Trap*: with elastic asperities that are pressed in farther than $2rc$ the pull at a displacement falls to half of this:
[`hertzian_meniscus`](#hertzian_meniscus). Their areas grow instead, so that the friction of an interface is nearer to this
law. *Measured*: fourteen Gaussian maps of silicon ($\sigma$ 1 to 50 nm, longest waves of a half to a sixteenth of the side,
$P/(E^*h')$ 0.002 to 0.05, 30 to 97 % humidity), solved with Laplace's pressure on every point
([`boundary_elements`](#boundary_elements)): where menisci pull with more than a tenth of the load, this law gives 0.40 to 0.91
of their pull (mean 0.58), and 1.00 to 1.03 where the map is flooded; where they pull by less, 0.24 to 1.08. *Unknown*: menisci
of constant volume, which do not dry up as fast as surfaces part: what they hold depends on how they came to be.

*Check*: parted in equilibrium, a sphere and a flat take $4\pi R\gamma_\mathrm Lrc^2$, half of the surface energy
$2\gamma_\mathrm Lc\cdot4\pi Rrc$ that is created ([de_boer_de_boer_2007], abstract). Water at 20 °C: $r$ is 0.777 nm at 50 %
and 5.112 nm at 90 %. The exact meniscus of the same
curvature pulls less, by

| $2rc/R$ | touching, $\theta_1=\theta_2=0$ | gap $rc$ | touching, 30° and 60° | gap $rc$ |
|---|---|---|---|---|
| $10^{-2}$ | 2.8 % | 7.9 % | 4.4 % | 13.4 % |
| $10^{-4}$ | 0.28 % | 0.79 % | 0.46 % | 1.31 % |

*Units*: $w=\omega/\sigma$, $P$ over $KR^{1/2}\sigma^{3/2}$; [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.liquid import CONFIRMED, CONFIRMED_OF_WATER
from stiction.engine.compiled import formula
from stiction.engine.regime import MENISCUS, Regime
from stiction.laws.meniscus.kind import Meniscus
from stiction.laws.piece import displaced, edges_at
from stiction.records.registry import Validity
from stiction.records.sources import Source

KELVIN = Validity(
    "kelvin_radius_over_confirmed",
    1.0,
    math.inf,
    f"Kelvin's equation is not confirmed for menisci below {CONFIRMED * 1e9:g} nm ({CONFIRMED_OF_WATER * 1e9:g} nm for water)",
    "fit",
)
VALIDITY = (
    KELVIN,
    Validity("meniscus_over_radius", 0.0, 0.01, "menisci are not small against asperities: their pull is wrong by about 5 %"),
    Validity("meniscus_tabor_parameter", 0.0, 0.1, "menisci deform asperities that are this soft"),
    Validity("meniscus_coverage", 0.0, 0.2, "neighbouring menisci merge: they pull less than computed, by a tenth or more"),
)
PULL_ON_MAPS = Validity(
    "meniscus_share", 0.0, 0.005, "solved maps gave 0.9 to 4 times the meniscus force of this law", "assumption"
)


@formula
def along(w, pull, height):
    """Return the six values of a `Regime` at the displacement w: only the load, minus the pull of the meniscus, is not zero.

    pull: 2 pi/theta_m. height: w_m. The coordinate is the displacement itself.
    """
    return w, 1.0, -pull * min(1.0, max(1.0 + w / height, 0.0)), 0.0, 0.0, 0.0


def pull(groups: Groups) -> list[Regime]:
    """Return the regime of menisci that bridge a gap from w = -w_m on and surround a contact from w = 0 on."""
    height = groups.meniscus_height
    edges = edges_at(-height, 0.0, np.inf)
    lowest = float(np.min(-height, initial=0.0))
    parameters = (2.0 * math.pi / groups.meniscus_index, height)
    return [Regime(along, displaced, parameters, edges, MENISCUS, touching=False, lowest=lowest)]


RECORD = Meniscus(
    key="equilibrium_meniscus",
    title="Menisci in equilibrium with their vapour, of a pull that does not change in contact",
    grade="B",
    sources=(
        Source("thomson_1871", "", "the radius of a meniscus over its vapour"),
        Source("orr_scriven_rivas_1975", "", "circle approximation; the exact meniscus, solved anew as a check"),
        Source("israelachvili_2011", "", "force of a sphere and a flat; written down from memory and derived again"),
        Source("butt_kappl_2009", "", "the same, reviewed; the abstract was seen"),
        Source("de_boer_de_boer_2007", "abstract", "work of parting a sphere and a flat in equilibrium"),
        Source("fisher_gamble_middlehurst_1981", "abstract", "radii at which the Kelvin equation was found to hold"),
        Source("iapws_2014", "", "surface tension of water, from memory, checked against 72.74 mN/m at 20 C"),
    ),
    pull=pull,
    verified="exact menisci of constant curvature by quadrature; sums over heights at 20 digits",
    needs=("meniscus_index", "meniscus_height"),
    validity=(
        *VALIDITY,
        PULL_ON_MAPS,
        Validity(
            "penetration_over_meniscus",
            0.0,
            0.1,
            "menisci pull such elastic asperities less, down to half, and widen their contact area",
        ),
    ),
    notes="Of plastic asperities, which are "
    "cut off, the pull does not change; of elastic ones it falls to half as they are pressed in farther than a meniscus is "
    "high: hertzian_meniscus.",
)
