r"""Junctions that grow under shear until their interface slides: McFarlane & Tabor 1950, Tabor 1959.

*Assumes*: a junction is fully plastic if its mean pressure $p$ and its mean shear stress $\tau$ satisfy $p^2+\alpha\tau^2=H^2$,
with the hardness $H$. A plastic junction grows under shear at constant load, so the pressure falls and the shear stress may
rise. Its interface slides at the shear strength $\tau_0=c\,\tau_b$, the fraction $c$ of the shear strength
$\tau_b=H/\sqrt\alpha$ of the bulk. *Sources*: [mcfarlane_tabor_1950] and [tabor_1959]; the texts were not available. The
criterion and its consequences are as commonly quoted, and re-derived here.

A plastic junction slides at the pressure $p=H\sqrt{1-c^2}$. An asperity with a lower pressure does not grow. An asperity with
a higher pressure grows until its pressure has fallen to this value:

$$
T=\tau_0\max\left(A,\ \frac P{H\sqrt{1-c^2}}\right)\quad\text{(SI)};\qquad
\frac TP=\frac c{\sqrt{\alpha\,(1-c^2)}}\ \text{for a junction that is plastic without shear}
$$

A mean pressure above $H$, which some asperity laws give, counts as $H$. The option `alpha` is `von_mises`, $3(H/Y)^2$, for a
bulk that shears at $Y/\sqrt3$, or 9, quoted from Tabor's experiments.

*Limits*: [`bowden_tabor_1943`](#bowden_tabor_1943) for a weak interface. For $c\to1$ (clean metal) $T$ has no bound; for
$c\ge1$ the law raises an error. Effects that limit the growth (hardening, the shape of the junction) are not included;
[`junction_growth`](#junction_growth) limits it to full stick. *Check*: friction coefficient $\mu=T/P$ of plastic junctions for
$\alpha=9$ and $3\cdot2.8^2=23.52$:

| $c$ | 0.1 | 0.3 | 0.5 | 0.8 | 0.95 | 0.99 |
|---|---|---|---|---|---|---|
| $\mu$, $\alpha=9$ | 0.0335 | 0.1048 | 0.1925 | 0.4444 | 1.0141 | 2.3393 |
| $\mu$, $\alpha=23.52$ | 0.0207 | 0.0648 | 0.1190 | 0.2749 | 0.6273 | 1.4471 |
| area over initial area | 1.0050 | 1.0483 | 1.1547 | 1.6667 | 3.2026 | 7.0888 |

*Symbols*: displacement $w=\omega/\sigma$, load $P$ and tangential force $T$ in units of $KR^{1/2}\sigma^{3/2}$ and contact
area $A$ in units of $\pi R\sigma$ of one asperity, with its tip radius $R$, the standard deviation $\sigma$ of the heights and
$K=\tfrac43E^*$ ($E^*$ contact modulus); $k=H/Y$ hardness divided by yield stress. Full list: [symbols](#1-units).
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.compiled import formula
from stiction.laws.segment import NormalSegment, TangentialResistance
from stiction.laws.tangential.shared.junctions import ALPHA, interface_over_bulk, where_pressure_is
from stiction.quantities.errors import InputError
from stiction.records.registry import Limit, TangentialLaw, Validity
from stiction.records.sources import Source

_ROUNDING = 1e-12


@formula
def grown_area(load, area, eta, share):
    """Return the contact area at which the interface of a junction slides, or `area` if the junction does not grow.

    Units: load W in K R^(1/2) sigma^(3/2), areas in pi R sigma. area: contact area before shear. eta: hardness group; load/eta
    represents W/H, with the hardness H. share: c, strength of the interface divided by the bulk's. The area A follows
    from W^2 + alpha T^2 = H^2 A^2 with the force of the interface, T = c H A/sqrt(alpha). A mean pressure above H counts as H.
    """
    return max(area, min(load / eta, area) / math.sqrt((1.0 - share) * (1.0 + share)))


@formula
def resistance(u, w, load, area, eta, shear_strength, share):
    return shear_strength * eta * grown_area(load, area, eta, share), 0.0


def tangential_resistance(segment: NormalSegment, groups: Groups, alpha: str) -> TangentialResistance:
    """Return the tangential resistance on a segment: strength of the interface times the area after growth under shear.

    It has kinks where growth begins and where the mean pressure reaches the hardness. segment: one smooth part of an asperity
    law. groups: dimensionless groups of n contacts. alpha: key of ALPHA, "von_mises" or "9". Raises InputError if the interface
    is as strong as the bulk or stronger.
    """
    share = interface_over_bulk(groups, alpha)
    endless = share >= 1.0 - _ROUNDING
    if np.any(endless):
        strength = float(groups.shear_strength[endless][0])
        bound = float((groups.shear_strength / share)[endless][0])
        why = f"below {bound:.4g}, the shear strength of the bulk over H: stronger junctions grow without limit"
        raise InputError("shear_strength", strength, f"{why} in tabor_1959; use junction_growth")
    pressures = [groups.eta * np.sqrt((1.0 - share) * (1.0 + share)), groups.eta]
    kinks = np.concatenate([where_pressure_is(segment, pressure) for pressure in pressures], axis=1)
    return TangentialResistance(resistance, (groups.eta, groups.shear_strength, share), kinks)


RECORD = TangentialLaw(
    key="tabor_1959",
    title="Junctions that grow under shear until their interface slides",
    grade="B",
    sources=(
        Source("mcfarlane_tabor_1950", "", "yield under pressure and shear, p^2 + alpha tau^2 = H^2, as commonly quoted"),
        Source("tabor_1959", "", "growth limited by an interface weaker than the bulk, as commonly quoted; re-derived"),
    ),
    tangential_resistance=tangential_resistance,
    yielded="junction growth",
    of_half_space="it describes junctions of one material, not of a film on a body",
    like="bowden_tabor_1943",
    verified="the criterion solved by bisection at 30 digits; closed form for plastic junctions; bowden_tabor_1943 for c -> 0",
    needs=("hardness_group", "shear_strength", "hardness_to_yield"),
    validity=(
        Validity(
            "grown_area_ratio", 1.0, 3.0, "hardening would limit this growth but is not modelled, so mu is too high", "effect"
        ),
    ),
    limits=(Limit("bowden_tabor_1943", {"shear_strength": 1e-7}, ("friction_force",), 1e-11),),
    own_options={"alpha": tuple(ALPHA)},
    notes="alpha: 3 (H/Y)^2 (von_mises) or 9, quoted from experiments. An interface as strong as the bulk, "
    "tau_0 sqrt(alpha) >= H, raises an error, because the growth would have no end. Asperities that are elastic under load and "
    "shear have the force of bowden_tabor_1943.",
)
