r"""A soft film that deforms alone up to its thickness, followed by the substrate: corrected variant of the 2015 paper.

*Assumes*: the film deforms alone, as a half-space, until the displacement equals its thickness. Beyond this displacement, it
keeps its load and resistance, and the substrate deforms by the displacement minus the film thickness. *Source*:
[soft_coating_2015], eqs. (6) and (15), corrected: [theory, section 5](theory.md#5-coated-surface), [departures D4, D5 and
D10](theory-limits.md#8-departures-from-the-print). With any asperity law, film (index c) and substrate (index s) have the loads
$P_c(w)$ and $P_s(w)$ and the tangential forces $T_c(w)$ and $T_s(w)$ of half-spaces, each in the units of its own modulus;
$n_E$ converts forces of the film. $A_c(w)$ is the contact area on the film. Then

$$
P=\begin{cases}n_EP_c(w)&w<\tau\\n_EP_c(\tau)+P_s(w-\tau)&w\ge\tau\end{cases},\qquad A=A_c(w)
$$

The tangential force follows the same rule, but a law of the interface uses the total load and the outer area. Film and
substrate transmit the same force in series, so their forces do not add up. The paper's sum is therefore too large by the force
of the film. With `film_shear="in_series"` the smaller tangential force applies: the film's at the full displacement, or the
substrate's at the displacement minus the film thickness,

$$
T=\min\left[n_ET_c(w),\,T_s(w-\tau)\right]\quad(w\ge\tau)
$$

which is not in the paper. *Reconstructed*: the departures named above; [`printed`](#printed) has the printed equations.

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $n_E$ modulus of the film divided by the substrate's; $\tau=t/\sigma$ film thickness.
[All symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.engine.regime import Regime
from stiction.laws.film.shared.cut_film import film_regimes
from stiction.laws.film.shared.weaker import weaker_regimes
from stiction.laws.joining import Law, Weights, coordinates, normal_states, states
from stiction.laws.segment import displaced, edges_at
from stiction.laws.shared_claims import DEEP_FILM
from stiction.records.registry import Departure, FilmLaw, Validity
from stiction.records.sources import Source


@formula
def at_rest(w, load, slip_limited, yield_limited):
    """Return w, dw/du = 1, load, 0 and both resistances of a film that no longer deforms; the coordinate u is w.

    The contact area is 0 here, because other regimes include it. load, slip_limited, yield_limited: the constant load and
    resistances.
    """
    return w, 1.0, load, 0.0, slip_limited, yield_limited


def regimes(groups: Groups, law: Law, film_shear: str) -> list[Regime]:
    """Return the regimes of a surface with a film that deforms alone up to its thickness.

    A regime is a segment of an asperity law together with the tangential force on it. Forces are in units of K R^(1/2)
    sigma^(3/2), with K = (4/3) E* of the substrate. groups: dimensionless groups of n coated contacts. law: asperity law and
    tangential law of film and substrate. The contact area is computed for the film at the full displacement, because the outer
    contact is always on the film. A tangential law of the interface uses this area and the total load. With any other
    tangential law, the film's resistance stays constant beyond the film thickness. It is added to the substrate's (film_shear
    "added"), or the smaller of the two acts ("in_series").
    """
    tau, n_E = groups.tau, groups.n_E
    before, after = Weights(unit=n_E), Weights(unit=n_E, load=0.0, friction=0.0)
    deforming = film_regimes(law, groups, tau, lambda segment: (before, after))
    load, slip_limited, yield_limited = _values_at_thickness(law, groups)
    in_series = film_shear == "in_series" and law.tangential is not None and not law.interfacial
    if in_series:
        slip_limited, yield_limited = 0.0 * slip_limited, 0.0 * yield_limited
    edges = edges_at(tau, np.inf)
    rest = Regime(at_rest, displaced, (load, slip_limited, yield_limited), edges, "held", "film", touching=False)
    below = Weights(shift=tau, area=0.0, friction=0.0 if in_series else 1.0)
    substrate = law.regimes(groups.substrate(), below, body="substrate", touching=False)
    return [*deforming, rest, *substrate, *(weaker_regimes(law, groups) if in_series else [])]


def _values_at_thickness(law: Law, groups: Groups) -> np.ndarray:
    """Return load, slip-limited and yield-limited resistance (3, n) of the film at a displacement equal to its thickness.

    The film keeps these values at larger displacements. With a tangential law of the interface, the part of the resistance that
    is proportional to the area is not included, because it is computed from the area elsewhere. The values are 0 for a film of
    infinite thickness.
    """
    film, weights = groups.film(), Weights(unit=groups.n_E, area=0.0 if law.interfacial else 1.0)
    at_thickness = np.zeros((3, len(groups)))
    for segment in law.segments(film):
        regime = law.join(segment, film, weights)
        u = coordinates(segment, groups.tau)
        at_first, at_last = segment.edges[:, 0], segment.edges[:, -1]
        start, _, _, width = normal_states(segment, at_first).T
        # First touch is at zero displacement within rounding. The tolerance includes a film of zero thickness.
        there = (u >= at_first) & (u < at_last) & (groups.tau >= start - 1e-14 * width)
        at_thickness[:, there] = states(regime, np.where(there, u, at_first))[there][:, [2, 4, 5]].T
    return at_thickness


RECORD = FilmLaw(
    key="sequential",
    title="Soft film that deforms alone until the displacement equals its thickness, then the substrate",
    grade="C",
    sources=(Source("soft_coating_2015", "eqs. (6) and (15)", "corrected in departures D4, D5, D8, D9, D10"),),
    regimes=regimes,
    departures=(
        Departure("thin", "contact_area", -0.63, 2.0),
        Departure("thin", "friction_force", -0.63, np.inf),
        Departure("alike", "load", -0.36, 0.0),
        Departure("alike", "friction_force", 0.0, 0.96),
    ),
    verified="loads, areas and friction, computed independently at 30 digits; the film's own asperity law for a thick film",
    needs=("n_E", "n_H", "tau"),
    validity=(
        DEEP_FILM,
        Validity(
            "load_share_substrate",
            0.0,
            0.1,
            "the contact area of the film is used even for asperities that reach the substrate; area and mu are inaccurate",
        ),
    ),
    load_is_monotonic=False,
    own_options={"film_shear": ("added", "in_series")},
    notes="film_shear: the forces of film and substrate are added, as in the paper, or the smaller one applies (in_series); "
    "laws of the interface are not affected. At zero thickness the adhesion of first touch on the film remains, a load of "
    "-4 pi/(3 theta) for each touching JKR asperity.",
)
