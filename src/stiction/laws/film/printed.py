r"""The equations of the 2015 paper exactly as published, for bare surfaces and for the soft film of eqs. (6) and (15).

*Assumes*: the printed equations. This film law belongs to the published variant of the model and serves to reproduce the paper.
*Source*: [soft_coating_2015], eqs. (1) to (15); [theory, section 5](theory.md#5-coated-surface). The corrected variant departs
from the printed equations in twelve points, [D1 to D12](theory-limits.md#8-departures-from-the-print); here the printed form is
kept, as follows. Without a film, the sum over heights $z=h+x$ uses the apparent displacement $x$ in place of the displacement
$w$ (D2); with the mean separation $h$, the height density $\varphi$ and $S=\sqrt{6\pi/\theta}$,

$$
\bar P(h)=\int\left(x^{3/2}-S\,x^{3/4}\right)\varphi(h+x)\,dx\quad\text{(elastic asperities)}
$$

The slip resistance is eq. (10) (D6), and the sum of the resistance lacks the factor $1/\sqrt{2\pi}$ of the density (D3). With
a film, the film terms are in the film's own units (D4). The elastic term of the substrate starts at $\tau+x_0$ ($x_0$: first
contact) without a shift of its law, and its plastic term at the displacement $w_1$ of yield (D5). *Reconstructed*: the
coefficients of eq. (11), as in the corrected variant (D12), and the contact area, which the paper does not define as a sum
over heights.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\theta=K\sigma^{3/2}/(\gamma R^{1/2})$ elastic adhesion index, $\gamma$ work of adhesion;
$\tau=t/\sigma$ film thickness. Full list: [symbols](#1-units).
"""

import math
from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.asperity import jkr
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import RECORD as CORRECTED
from stiction.laws.asperity.roy_chowdhury_ghosh_1994 import flow, onset
from stiction.laws.film.shared.cut_film import film_regimes
from stiction.laws.joining import Law, Weights, within
from stiction.laws.segment import NormalSegment, edges_at
from stiction.laws.shared_claims import DEEP_FILM
from stiction.laws.tangential.soft_coating_2015 import RECORD as TANGENTIAL
from stiction.laws.tangential.soft_coating_2015 import tangential_resistance_printed
from stiction.records.registry import Departure, FilmLaw, Validity
from stiction.records.sources import Source

# Eqs (12)-(15) weigh the resistance with exp(-z^2/2) in place of phi(z) (D3).
_FRICTION_FACTOR = math.sqrt(2.0 * math.pi)

_adhesion, _load = jkr.adhesion, jkr.load


@formula
def normal(u, theta):
    """Return displacement x = u^4, dx/du, JKR's load and contact area of an elastic asperity according to eq (1) as published.

    The paper uses x = a^2/(R sigma), with the contact radius a, as the displacement in units of sigma. theta: elastic adhesion
    index. Units: load in K R^(1/2) sigma^(3/2), area in pi R sigma.
    """
    x = u * u * u * u
    return x, 4.0 * u * u * u, _load(u, _adhesion(theta)), x


@formula
def coordinate(x, theta):
    return max(x, 0.0) ** 0.25


def segments(groups: Groups, branch: str) -> list[NormalSegment]:
    u_1, w_1 = onset(groups)
    edges = edges_at(jkr.first_contact(groups.theta, "loading"), u_1)
    return [NormalSegment(normal, coordinate, (groups.theta,), edges, "elastic"), flow(groups, w_1)]


LAW = Law(
    replace(CORRECTED, segments=segments),
    replace(TANGENTIAL, tangential_resistance=tangential_resistance_printed, junctions=()),
    {"branch": "loading"},
)


def bare_regimes(groups: Groups) -> list[Regime]:
    """Return the elastic and the plastic regime of a surface without film, by the equations of soft_coating_2015 as published.

    groups: dimensionless groups of n contacts.
    """
    return LAW.regimes(groups, Weights(friction=_FRICTION_FACTOR))


def _film_weights(segment: NormalSegment) -> tuple[Weights, Weights]:
    """Return two `Weights` for a segment of the film, as published: for displacements below and above the film thickness.

    Beyond the film thickness the printed equations keep the elastic load without its friction, and drop the plastic load
    (departures D5, D9). Both keep the contact area.
    """
    return Weights(friction=_FRICTION_FACTOR), Weights(friction=0.0) if segment.state == "elastic" else Weights(load=0.0)


def regimes(groups: Groups, law: Law) -> list[Regime]:
    """Return the regimes of a coated surface according to the equations of soft_coating_2015 as published.

    A regime is a segment of an asperity law together with the tangential force on it. groups: dimensionless groups of n coated
    contacts. `law` is not used, because the printed equations contain their own laws. An integral whose lower limit exceeds
    the upper one is empty (D9). In the film only asperities with a displacement below the film thickness resist shear (D10).
    The contact area, which the paper does not define, is the contact area on the film.
    """
    tau = groups.tau
    film_part = film_regimes(LAW, groups, tau, _film_weights)
    substrate = groups.substrate()
    elastic, plastic = LAW.segments(substrate)
    from_film = within(elastic, (tau + elastic.edges[:, 0] ** 4) ** 0.25, np.inf)
    labels = {"body": "substrate", "touching": False}
    return [
        *film_part,
        LAW.join(from_film, substrate, Weights(friction=_FRICTION_FACTOR, area=0.0), **labels),
        LAW.join(plastic, substrate, Weights(area=0.0), **labels),
    ]


RECORD = FilmLaw(
    key="printed",
    title="Soft film exactly as published in the 2015 paper; the film law of the published variant",
    grade="C",
    sources=(
        Source(
            "soft_coating_2015",
            "eqs. (6)-(9) and (15)",
            "as published except departures D1 and D7-D12; C1..C7 reconstructed (D12)",
        ),
    ),
    regimes=regimes,
    departures=(
        Departure("thin", "load", 0.0, math.inf),
        Departure("thin", "contact_area", -0.5, 1.0),
        Departure("thick", "load", -0.67, math.inf),
        Departure("thick", "friction_force", -0.67, math.inf),
        Departure("alike", "load", 0.0, 1.0),
    ),
    verified="loads, areas and friction, computed independently at 30 digits; the paper prints no numbers",
    needs=("theta", "lam", "n_E", "n_H", "tau"),
    validity=(
        DEEP_FILM,
        Validity(
            "load_share_substrate", 0.0, 0.1, "soft_coating_2015 computes the load of the substrate as if no film covered it"
        ),
        Validity(
            "n_E",
            0.9,
            1.1,
            "soft_coating_2015 adds loads of film and substrate in different units, which are equal only for equal moduli",
        ),
    ),
    required_traits={"2015": "it needs the asperity law roy_chowdhury_ghosh_1994"},
    own_asperity=True,
    tangential="soft_coating_2015",
    interchangeable=False,
    load_is_monotonic=False,
    notes="The printed equations add loads in units of the film to loads in units of the substrate (departure D4).",
)
