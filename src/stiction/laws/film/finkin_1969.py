r"""A thin elastic layer between a rigid ball and a rigid substrate, as two bounds: after Finkin 1969.

*Assumes* (abstract of [finkin_1969]): for an elastic layer much softer than substrate and indenter, friction is a product of
powers of thickness and load. *Source*: [finkin_1969], its abstract; the elastic foundation as in [johnson_1985]. *Unknown*:
the powers. *Reconstruction*: two bounds, of a compressible and of an incompressible layer, are derived here for a layer thin
compared with the contact radius $a$, between a rigid ball and a rigid substrate. $\omega$ is the displacement, $R$ the radius
of the ball, $t$ the layer's thickness (`film_aspect` times $\sqrt{R\sigma}$), $G$ its shear modulus and
$M=2G(1-\nu)/(1-2\nu)$ its confined (uniaxial strain) modulus; $r$ is the distance from the axis and $\tau_0$ the shear
strength of the interface:

| `bound` | pressure | load | area | $\mu=\tau_0A/P$ is proportional to |
|---|---|---|---|---|
| `compressible` | $M$ times the strain | $\pi MR\omega^2/t$ | $2\pi R\omega$ | $t^{1/2}P^{-1/2}R^{1/2}$ |
| `incompressible`, $q=12$ | $qG(a^2-r^2)^2/(32Rt^3)$ | $\pi qGa^6/(96Rt^3)$ | $4\pi R\omega$ | $t\,P^{-2/3}R^{1/3}$ |
| `incompressible_frictionless`, $q=3$ | the same | the same | the same | the same |

The layer is bonded to the substrate. With $q=12$ it does not slip on the ball either; with $q=3$ it slips there without
friction. If both bodies are coated, $t$ is the sum of the two layers: the same pressure squeezes both, and by symmetry no shear
stress acts between them. Then $q=12$, whether they slip on each other or not.

The incompressible bounds follow from the volume balance of the squeezed layer, as in lubrication. Under the pressure $p$ the
outward flow per width is

$$
-\frac{t^3}{qG}\frac{dp}{dr}
$$

and it is zero at the edge. Only tangential laws of the interface can be combined with this film law. The substrate is rigid, so
the law is valid for $n_E$ below about 0.1. Results include the load fraction on asperities whose contact radius is smaller than
the film thickness; the law is not valid for them.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $n_E$ modulus of the film divided by the substrate's; $\nu$ Poisson's ratio. Full list:
[symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.segment import NormalSegment, displaced, edges_at
from stiction.laws.shared_claims import THIN_LAYER
from stiction.records.registry import Departure, FilmLaw, Validity
from stiction.records.sources import Source

_PI = math.pi
# Factor q of an incompressible layer, power of the displacement in the load, and contact area over displacement.
BOUNDS = {
    "compressible": (0.0, 2.0, 2.0),
    "incompressible": (12.0, 3.0, 4.0),
    "incompressible_frictionless": (3.0, 3.0, 4.0),
}


@formula
def normal(w, stiffness, power, widening):
    """Return displacement w, dw/du = 1, load and contact area of an asperity on a thin layer; the coordinate u is w.

    The load is stiffness times w^power, the area widening times w. power: 2 or 3. Units: w in sigma, load in K R^(1/2)
    sigma^(3/2), area in pi R sigma.
    """
    return w, 1.0, stiffness * w * w * (w if power == 3.0 else 1.0), widening * w


def stiffness(groups: Groups, bound: str) -> np.ndarray:
    """Return the ratio (n,) of an asperity's load to w^power, with the displacement w and the power 2 or 3 of this bound.

    bound: key of BOUNDS. Units: w in sigma, load in K R^(1/2) sigma^(3/2). The load uses the film's confined modulus M = E'_f
    (1 - nu)^2/(1 - 2 nu) if the bound is "compressible", else its shear modulus G = E'_f (1 - nu)/2, with E'_f = E_f/(1 -
    nu^2), Young's modulus E_f and Poisson's ratio nu. If both bodies are coated, "incompressible_frictionless" gives the value
    of "incompressible".
    """
    resolved = groups.resolved()
    nu, film = resolved.layer_nu, 0.75 * resolved.film_modulus
    if bound == "compressible":
        return _PI * film * (1.0 - nu) ** 2 / (1.0 - 2.0 * nu) / resolved.film_aspect
    k = np.where(np.asarray(resolved.films) == 2.0, BOUNDS["incompressible"][0], BOUNDS[bound][0])
    return _PI * k / 96.0 * film * (1.0 - nu) / 2.0 * (BOUNDS[bound][2] / resolved.film_aspect) ** 3


def regimes(groups: Groups, law, bound: str) -> list[Regime]:
    """Return the regimes of a surface with a thin elastic layer on a rigid substrate.

    A regime is a segment of an asperity law together with the tangential force on it. groups: dimensionless groups of n coated
    contacts. law: only its tangential law is used, which must be one with interfacial=True. bound: key of BOUNDS. The first
    regime holds for contact radii below the film thickness (in_half_space=True), the second for larger radii
    (in_half_space=False).
    """
    laws = len(groups)
    _, power, widening = BOUNDS[bound]
    parameters = (np.broadcast_to(stiffness(groups, bound), laws), np.full(laws, power), np.full(laws, widening))
    as_wide = np.broadcast_to(groups.film_aspect**2 / widening, laws)  # a = t
    within = edges_at(0.0, as_wide)
    beyond = edges_at(as_wide, np.inf)
    return [
        law.join(
            NormalSegment(normal, displaced, parameters, edges, "elastic"), groups, body="film", in_half_space=in_half_space
        )
        for edges, in_half_space in ((within, True), (beyond, False))
    ]


RECORD = FilmLaw(
    key="finkin_1969",
    title="Thin elastic layer on a rigid substrate, compressible or incompressible",
    grade="C",
    sources=(
        Source("finkin_1969", "abstract", "elastic layer on a rigid substrate; the equations, not available, are derived here"),
        Source("johnson_1985", "", "thin layers; the elastic foundation"),
    ),
    regimes=regimes,
    tangential="interface",
    accuracy=2e-10,  # relative error of loads at large separations, where sums lose digits
    own_asperity=True,
    own_options={"bound": tuple(BOUNDS)},
    departures=(
        Departure("thin", "load", 0.0, math.inf),
        Departure("thin", "contact_area", 1.0, 1.0),
        Departure("thin", "friction_force", 1.0, 1.0),
        Departure("thick", "load", -1.0, -1.0),
        Departure("thick", "contact_area", 1.0, 1.0),
        Departure("thick", "friction_force", 1.0, 1.0),
        Departure("alike", "load", 0.0, math.inf),
        Departure("alike", "contact_area", 1.0, 1.0),
        Departure("alike", "friction_force", 1.0, 1.0),
    ),
    verified="the volume balance of the layer, by numerical differentiation; the powers of thickness and load",
    needs=("n_E", "film_aspect", "films", "layer_nu", "coated_share"),
    validity=(
        THIN_LAYER,
        Validity("n_E", 0.0, 0.1, "the law assumes that substrate and counter-body are rigid compared with the film"),
        Validity(
            "film_stiffness",
            0.0,
            0.1,
            "the law assumes a rigid substrate, but the substrate deforms more than a tenth as much as the film",
        ),
    ),
    notes="The substrate is rigid at any displacement: for films of much smaller modulus than substrate and indenter. It is "
    "unknown which of the bounds the paper uses. The compressible bound is not valid for layer_nu near 1/2.",
)
