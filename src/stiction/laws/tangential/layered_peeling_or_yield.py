r"""The lesser of two forces on an adhesive asperity: that at which it peels, and that at which it first yields anywhere.

*Assumes*: what comes first ends the grip, as [`soft_coating_2015`](#soft_coating_2015) has it, but yield is looked for
everywhere in film, interface and body and not at the trailing edge alone. *Source*: [soft_coating_2015] for the lesser of the
two; [savkoor_briggs_1977] with the stiffness of the layered contact as in [`layered_peeling`](#layered_peeling), stresses as in
[`layered_first_yield`](#layered_first_yield),

$$
T=\min(T_\text{peel},\,T_\text{yield}),\qquad N_f(|s|,q)=Y_f\ \text{or}\ N_s(|s|,q)=Y_s,\qquad s=\frac P{\pi a^2},\quad
q=\frac{T_\text{yield}}{\pi a^2}
$$

*Reconstructed*: as in the 2015 paper, the stresses are those of a sphere pressed without adhesion, at the mean pressure of the
adhesive contact on its area; tension stresses as much as pressure. An asperity that has yielded resists nothing.

*Limit*: without a film, for one like its body, and in the film's groups for $t\to\infty$, the lesser of
[`savkoor_briggs_1977`](#savkoor_briggs_1977) and [`hamilton_1983`](#hamilton_1983) at $|P|$ on the area of the contact.

*Units*: $P$ and $T$ over $KR^{1/2}\sigma^{3/2}$, $A$ over $\pi R\sigma$; [symbols](#1-units).
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.piece import NormalPiece, TangentialResistance
from stiction.laws.registry import TangentialLaw
from stiction.laws.sources import Source
from stiction.laws.tangential.hamilton_1983 import resistance as hamilton
from stiction.laws.tangential.hamilton_1983 import series_for
from stiction.laws.tangential.savkoor_briggs_1977 import no_resistance, slip_resistance
from stiction.laws.tangential.shared.coated_peeling import peeling_columns, peeling_force
from stiction.laws.tangential.shared.coated_strength import strength_at, strengths
from stiction.laws.tangential.shared.lesser import Force, lesser_of

_NEVER = 1e-200  # the share of the tangential energy of what never peels


@formula
def _slip(u, load, area, row):
    """Of a half-space. row: theta, K beta times the peeling."""
    return slip_resistance(load, row[0], row[1])


@formula
def _yield_of_half_space(u, load, area, row):
    """As `Force` has it. row: of Hamilton's law."""
    s = 1.5 * row[1] * abs(load) / (row[0] * area) if area > 0.0 else 0.0
    force = hamilton(u, 0.0, abs(load), area, *row)[1]
    return row[5] - s, force, (s - row[3]) * (s - row[4])


@formula
def _yield_on_a_film(u, load, area, row):
    """The same. row: eta/k, where the load alone yields, and what the spline takes."""
    square = strength_at(u, row[2:]) if u < row[1] else 0.0
    return square if square > 0.0 else -1.0, row[0] * area * square**0.5, 1.0


def tangential_resistance(piece: NormalPiece, groups: Groups) -> TangentialResistance | None:
    """On the elastic piece of a JKR asperity; one that has yielded resists nothing."""
    if piece.state != "elastic":
        return None
    return _of_a_half_space(piece, groups) if groups.n_E is None else _on_a_film(piece, groups.resolved())


def _of_a_half_space(piece: NormalPiece, groups: Groups) -> TangentialResistance:
    share = np.maximum(1.0 if groups.peeling is None else groups.peeling, _NEVER)
    steps, series = series_for(groups.nu)
    of_yield = groups.eta, groups.hardness_to_yield, groups.nu, *steps, *series
    slip = Force(_slip, (groups.theta, groups.K_beta * share))
    return lesser_of(piece, slip, Force(_yield_of_half_space, of_yield), no_resistance(piece, groups))


def _on_a_film(piece: NormalPiece, groups: Groups) -> TangentialResistance:
    own, vanishes = peeling_columns(piece, groups)
    curve, bends = strengths(piece, groups)
    scale = np.broadcast_to(groups.eta / groups.hardness_to_yield, len(groups))
    kinks = bends if vanishes is None else np.concatenate([bends, vanishes], axis=1)
    return lesser_of(piece, Force(peeling_force, own), Force(_yield_on_a_film, (scale, *curve)), kinks)


RECORD = TangentialLaw(
    key="layered_peeling_or_yield",
    title="Peeling or first yield anywhere of an adhesive contact on a film, whichever comes first",
    grade="C",
    sources=(
        Source("soft_coating_2015", "", "the lesser of peeling and yield; yield looked for everywhere here"),
        Source("savkoor_briggs_1977", "", "energy balance, with the stiffness of the layered contact"),
        Source("osullivan_king_1988", "", "stresses in a dragged layer; derived and solved anew here"),
        Source("hamilton_1983", "stresses under the normal and the tangential load", "of which it is the limit"),
    ),
    tangential_resistance=tangential_resistance,
    layered=True,
    wants={"JKR": "peeling releases the energy at the rim of a JKR contact"},
    verified="the lesser of two laws, each checked by other means; closed limits",
    needs=("theta", "lam", "nu", "hardness_to_yield"),
    takes=("peeling",),
    accuracy=5e-3,
    notes="`peeling` 0 is yield alone. A film law that takes film and body as two half-spaces gets the lesser force of each. "
    "The counterbody is taken not to yield.",
)
