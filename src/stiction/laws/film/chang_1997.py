r"""A plastic film on an elastic-plastic substrate: after Chang 1997.

*Assumes* (abstract of [chang_1997]): asperities that reach the substrate follow a modified law of Chang, Etsion and Bogy;
asperities that touch only the soft film are plastic. *Source*: [chang_1997], its abstract. *Reconstruction*, with any asperity
law without adhesion for the substrate: up to the displacement $\omega=t$, the film thickness, only the film deforms. Beyond it,
the substrate deforms by $\omega-t$ according to its own law, with the load $P_s$ and the area $A_s$. On the rest of the area
$2\pi R\omega$ the film carries a pressure equal to its hardness,

$$
A=2w,\qquad P=\begin{cases}2\eta n_Hw&w<\tau\\P_s(w-\tau)+\eta n_H\left[2w-A_s(w-\tau)\right]&w\ge\tau\end{cases}
$$

where a negative bracket is replaced by 0. Load and area are continuous at $w=\tau$. Only the substrate resists shear, unless
the tangential law describes the interface. *Check* of the abstract's statements: at a high plasticity index the film changes
area and load less than at a low index; a thin film stiffens a lightly loaded contact. *Unknown*: all equations of the source.
*Trap*: even at zero film thickness a rim of film around elastic contacts carries load.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ in units of $KR^{1/2}\sigma^{3/2}$ and contact area $A$ in units of
$\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and $K=\tfrac43E^*$
($E^*$ contact modulus); $\eta=\pi H\sqrt{R/\sigma}/K$ hardness group, $H$ hardness; $n_H$ hardness of the film divided by the
substrate's; $\tau=t/\sigma$ film thickness. Full list: [symbols](#1-units).
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.joining import Weights
from stiction.laws.segment import NormalSegment, displaced, edges_at
from stiction.laws.shared_claims import SOFT_FILM
from stiction.records.registry import Departure, FilmLaw, Validity
from stiction.records.sources import Source


@formula
def film_alone(w, hardness, pull):
    """Return w, dw/du = 1, load and contact area of an asperity that touches only the plastic film; the coordinate u is w.

    The area is 2 w. The load is hardness times the area, minus `pull`. w: displacement. hardness: film hardness divided by
    the substrate's, times the hardness group eta. pull: adhesive force. Units: w in sigma, load and pull in K R^(1/2)
    sigma^(3/2), area in pi R sigma.
    """
    return w, 1.0, 2.0 * hardness * w - pull, 2.0 * w


@cache
def _rim(normal: Callable, coordinate: Callable, parameters: int) -> tuple[Any, Any]:
    @formula
    def rim(u, *row):
        """Return w, dw/du, load and area of the ring of film around the contact with the substrate.

        The area of the ring is 2 pi R omega, with the displacement omega, minus the contact area of the substrate. w:
        displacement. u: coordinate of the substrate's segment. row: parameters of this segment; film thickness in units of
        sigma; film hardness, in units of load divided by area; adhesive force, in the unit of load.
        """
        w, stretch, _, inner = normal(u, *row[:parameters])
        tau, hardness, pull = row[parameters:]
        area = max(2.0 * (w + tau) - inner, 0.0)
        return w + tau, stretch, hardness * area - pull, area

    @formula
    def rim_coordinate(w, *row):
        return coordinate(w - row[parameters], *row[:parameters])

    return rim, rim_coordinate


def plastic_film(groups: Groups, law, pull: np.ndarray) -> list[Regime]:
    """Return the regimes of a surface with a plastic film: film alone, then two regimes for each segment of the asperity law.

    The first of these two regimes is the rim of film around the contact with the substrate, the second is this contact. Forces
    are in units of K R^(1/2) sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated
    contacts. law: asperity law and tangential law of the substrate (a joining.Law). pull (n,): adhesive force on each touching
    asperity. The film resists shear only if the tangential law describes the interface.
    """
    laws = len(groups)
    tau = np.broadcast_to(np.asarray(groups.tau, dtype=float), laws)
    hardness = groups.eta * groups.n_H
    on_film = law if law.interfacial else replace(law, tangential=None)
    edges = edges_at(0.0, tau)
    alone = NormalSegment(film_alone, displaced, (hardness, pull), edges, "plastic")
    regimes = [on_film.join(alone, groups, body="film")]
    for segment in law.segments(groups):
        along, back = _rim(segment.normal, segment.coordinate, len(segment.parameters))
        parameters = (*segment.parameters, tau, hardness, pull)
        lowest = segment.lowest + float(np.min(tau, initial=math.inf))
        rim = NormalSegment(along, back, parameters, segment.edges, "plastic", lowest)
        regimes.append(on_film.join(rim, groups, body="film"))
        regimes.append(law.join(segment, groups, Weights(shift=tau), body="substrate", touching=False))
    return regimes


def regimes(groups: Groups, law) -> list[Regime]:
    """Return the regimes of a surface with a plastic film without adhesion.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: asperity law
    and tangential law of the substrate (a joining.Law).
    """
    return plastic_film(groups, law, np.zeros(len(groups)))


NO_ADHESION = {"no adhesion": "it needs an asperity law without adhesion"}

# Ranges outside which the law fails: for a film of zero thickness, and if not all of the film is plastic.
FLOWING = (
    Validity(
        "tau",
        0.1,
        math.inf,
        "the law overestimates the load on the film around contacts with the substrate; "
        "even a film of zero thickness carries load",
    ),
    Validity("film_plasticity_index", 8.0, math.inf, "the film is modelled as plastic from first touch"),
    Validity(
        "load_share_substrate",
        0.75,
        1.0,
        "the pressure on the film is assumed to equal the film hardness, so the load is too large",
    ),
)

DEPARTURES = (
    Departure("thin", "load", 0.0, math.inf),
    Departure("thin", "contact_area", 0.0, 1.0),
    Departure("thin", "friction_force", 0.0, 1.0),
    Departure("thick", "load", 0.7, math.inf),
    Departure("thick", "contact_area", 0.0, 1.0),
    Departure("thick", "friction_force", 0.0, 1.0),
    Departure("alike", "load", 0.24, math.inf),
    Departure("alike", "contact_area", 0.0, 1.0),
    Departure("alike", "friction_force", 0.0, 1.0),
)

RECORD = FilmLaw(
    key="chang_1997",
    title="Plastic film that asperities press through, on an elastic-plastic substrate",
    grade="C",
    sources=(
        Source("chang_1997", "abstract", "reconstructed: the equations were not available"),
        Source("chang_etsion_bogy_1987", "", "the substrate, with the asperity law of this name"),
    ),
    regimes=regimes,
    asperity="chang_etsion_bogy_1987",
    required_traits=NO_ADHESION,
    departures=DEPARTURES,
    verified="independent sums over heights; load and area continuous at w = tau; trends of the abstract",
    needs=("hardness_group", "n_H", "tau"),
    validity=(SOFT_FILM, *FLOWING),
    notes="The source uses the asperity law chang_etsion_bogy_1987; other laws without adhesion may be chosen. As in the "
    "abstract, the film changes the area less at high plasticity index, and a thin film stiffens a lightly loaded contact. The "
    "film also changes the load less there, unless it is very soft (true for n_H = 0.6, not for 0.1). The area is the outer "
    "contact area at any film thickness, and even at zero thickness a rim of film around elastic contacts carries load. Only "
    "the substrate resists shear, unless the tangential law describes the interface.",
)
