r"""Menisci in equilibrium with their vapour, by Kelvin's equation and circular arcs: Orr, Scriven & Rivas 1975.

*Assumes*: the meniscus is in equilibrium with the vapour. Its total curvature is $1/r$ by Kelvin's equation at every gap, so
approach and separation must be slow (seconds in humid air). The meniscus is small compared with the asperity, $r\ll R$. Its
force does not deform the solids (as in DMT's law), and a sphere that is pressed in is treated as truncated. Neighbouring
menisci do not merge. *Sources*: [thomson_1871] for the radius $r$; [orr_scriven_rivas_1975] for the circle approximation and
the exact meniscus; the force between a sphere and a flat as reviewed by [israelachvili_2011] and [butt_kappl_2009], written
from memory and re-derived: Laplace's pressure $\gamma_\mathrm L/r$ on the ring area $2\pi R(2rc-D)$. [de_boer_de_boer_2007],
abstract, describe menisci between rough surfaces, each in equilibrium; their result for a sphere and a flat agrees, see below.
Radii at which Kelvin's equation was found to hold are from [fisher_gamble_middlehurst_1981], the surface tension of water from
[iapws_2014].

$$
r=\frac{\gamma_\mathrm LV_\mathrm L}{R_\mathrm gT\ln(p_\mathrm s/p)},\quad c=\frac{\cos\theta_1+\cos\theta_2}2,\qquad
F=4\pi R\gamma_\mathrm Lc\left(1-\frac D{2rc}\right)\quad(0\le D\le2rc)\quad\text{(SI)}
$$

$$
P=-\frac{2\pi}{\theta_\mathrm m}\min\left(1,\;1+\frac w{w_\mathrm m}\right)\quad(w\ge-w_\mathrm m),\qquad
\theta_\mathrm m=\frac{K\sigma^{3/2}}{2\gamma_\mathrm Lc\sqrt R},\quad w_\mathrm m=\frac{2rc}\sigma
$$

$\gamma_\mathrm L$ is the surface tension and $V_\mathrm L$ the molar volume of the liquid, $R_\mathrm g$ the gas constant, $T$
the temperature, $p/p_\mathrm s$ the relative vapour pressure (humidity), $\theta_1$ and $\theta_2$ the contact angles on both
faces, $F$ the attractive force at the gap $D$. In the units here, $P$ is the (negative) load of the meniscus at the
displacement $w$ of the asperity; negative $w$ is a gap. $P$ is added to the load of the asperity law.

An asperity that does not touch is bridged by liquid and attracted if its gap is below $2rc$. The force of all menisci is at
most Laplace's pressure on the area where the solids do not touch, $\gamma_\mathrm L(A_n-A)/r$. The meniscus has no contact
area and no resistance to sliding. It presses the solids together, and the tangential law uses the load that they carry. The
work of adhesion of the contact, if any, is the work of adhesion of the solids inside the liquid. With a film, the liquid is on
the film.

*Limit*: as the humidity tends to zero, $w_\mathrm m\to0$, but touching asperities still have the full force, because the force
in contact does not depend on $r$. If $r$ is only a few molecular diameters, no such meniscus exists. Results carry a validity
warning below the radii at which Kelvin's equation was confirmed: 4 nm, or 9 nm for water, which corresponds to 94 % relative
humidity.

*Trap*: for elastic asperities at displacements far above $2rc$ the force falls to half of this value, see
[`hertzian_meniscus`](#hertzian_meniscus). The missing force increases their contact area, so friction by a law of the
interface is closer to the present law. *Comparison*: fourteen Gaussian maps of silicon ($\sigma$ 1 to 50 nm, longest
wavelength a half to a sixteenth of the side, nominal pressure 0.002 to 0.05 times $E^*h'$ with the root mean square gradient
$h'$, 30 to 97 % humidity) were solved with Laplace's pressure on every bridged point
([`boundary_elements`](#boundary_elements)). If the meniscus force exceeds a tenth of the load, this law gives 0.40 to 0.91
times the computed force (mean 0.58), and 1.00 to 1.03 times on flooded maps. For smaller forces it gives 0.24 to 1.08 times
the computed force. *Unknown*: menisci of constant volume, which do not dry up while surfaces separate; their volume depends on
their history.

*Check*: separation of a sphere and a flat in equilibrium needs the work $4\pi R\gamma_\mathrm Lrc^2$, half of the surface
energy $2\gamma_\mathrm Lc\cdot4\pi Rrc$ that is created ([de_boer_de_boer_2007], abstract). For water at 20 °C, $r$ is
0.777 nm at 50 % humidity and 5.112 nm at 90 %. The exact meniscus of the same curvature pulls less than the formula, by

| $2rc/R$ | touching, $\theta_1=\theta_2=0$ | gap $rc$ | touching, 30° and 60° | gap $rc$ |
|---|---|---|---|---|
| $10^{-2}$ | 2.8 % | 7.9 % | 4.4 % | 13.4 % |
| $10^{-4}$ | 0.28 % | 0.79 % | 0.46 % | 1.31 % |

*Units*: $w=\omega/\sigma$, $P$ in units of $KR^{1/2}\sigma^{3/2}$, with the tip radius $R$, the standard deviation $\sigma$ of
the asperity heights and $K=\tfrac43E^*$ ($E^*$ contact modulus). Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.liquid import CONFIRMED, CONFIRMED_OF_WATER
from stiction.engine.compiled import formula
from stiction.engine.regime import MENISCUS, Regime
from stiction.laws.meniscus.kind import Meniscus
from stiction.laws.segment import displaced, edges_at
from stiction.records.registry import Validity
from stiction.records.sources import Source

KELVIN = Validity(
    "kelvin_radius_over_confirmed",
    1.0,
    math.inf,
    f"Kelvin's equation was confirmed only down to {CONFIRMED * 1e9:g} nm ({CONFIRMED_OF_WATER * 1e9:g} nm for water)",
    "fit",
)
VALIDITY = (
    KELVIN,
    Validity(
        "meniscus_over_radius",
        0.0,
        0.01,
        "menisci are not small compared with asperities, and pull at least 3 % less than computed",
    ),
    Validity(
        "meniscus_tabor_parameter", 0.0, 0.1, "menisci deform such soft asperities, but the law neglects this deformation"
    ),
    Validity("meniscus_coverage", 0.0, 0.2, "neighbouring menisci merge and pull less than computed, by a tenth or more"),
)
PULL_ON_MAPS = Validity(
    "meniscus_share",
    0.0,
    0.005,
    "solved height maps give 0.9 to 4 times the meniscus force of this law, so mu may be too low",
    "assumption",
)


@formula
def along(w, pull, height):
    """Return the six values of a meniscus that a `Regime` requires: w, 1 (the derivative dw/du), load, 0, 0, 0.

    The zeros are contact area and tangential forces. The load is negative. The coordinate is the displacement w itself, in
    units of sigma, negative for a gap. pull: attractive force on a touching asperity, in units of K R^(1/2) sigma^(3/2).
    height: largest bridged gap in units of sigma, beyond which the load is 0.
    """
    return w, 1.0, -pull * min(1.0, max(1.0 + w / height, 0.0)), 0.0, 0.0, 0.0


def pull(groups: Groups) -> list[Regime]:
    """Return a list with one regime, the menisci that bridge gaps up to w_m or surround contacts.

    Its coordinate is the displacement w >= -w_m. w and the largest bridged gap w_m are in units of sigma.
    """
    height = groups.meniscus_height
    edges = edges_at(-height, 0.0, np.inf)
    lowest = float(np.min(-height, initial=0.0))
    parameters = (2.0 * math.pi / groups.meniscus_index, height)
    return [Regime(along, displaced, parameters, edges, MENISCUS, touching=False, lowest=lowest)]


RECORD = Meniscus(
    key="equilibrium_meniscus",
    title="Menisci in equilibrium with the vapour, whose force is constant in contact",
    grade="B",
    sources=(
        Source("thomson_1871", "", "Kelvin's equation: the radius of a meniscus at a given humidity"),
        Source("orr_scriven_rivas_1975", "", "circle approximation; the exact meniscus, solved independently as a check"),
        Source("israelachvili_2011", "", "force of a sphere and a flat; written from memory and re-derived"),
        Source("butt_kappl_2009", "", "review of this force; only the abstract was available"),
        Source("de_boer_de_boer_2007", "abstract", "work of separating a sphere and a flat in equilibrium"),
        Source("fisher_gamble_middlehurst_1981", "abstract", "radii at which the Kelvin equation was found to hold"),
        Source("iapws_2014", "", "surface tension of water, from memory, checked against 72.74 mN/m at 20 C"),
    ),
    pull=pull,
    verified="exact menisci of constant curvature, by numerical integration; sums over heights at 20 digits",
    needs=("meniscus_index", "meniscus_height"),
    validity=(
        *VALIDITY,
        PULL_ON_MAPS,
        Validity(
            "penetration_over_meniscus",
            0.0,
            0.1,
            "the meniscus force on elastic asperities is up to twice too large; "
            "mu is still too low, because the law neglects that menisci enlarge contacts",
        ),
    ),
    notes="The force of a touching asperity is constant. This holds for plastic asperities, which are treated as truncated; "
    "for elastic asperities it falls to half as the displacement exceeds the height of the meniscus (hertzian_meniscus).",
)
