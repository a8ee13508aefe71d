r"""Strengthening at rest with the logarithm of time, by creep of the junctions: Berthoud et al. 1999, Dieterich 1972.

*Assumes*: the junctions creep under the load, and the real area, and with it the force that shears it, grows with the
logarithm of the time at rest; below the cut-off time $t_\mathrm c$ nothing has grown yet. No shear acts while the contact
waits, and there is no end to the growth. *Source*: [dieterich_1978], abstract, for rocks (first [dieterich_1972]);
[berthoud_1999] for rough polymers, and [baumberger_caroli_2006], of which the abstract was seen: slow growth of the real area
by creep. The form is written down from memory and derived here, below; [jagla_2010], abstract, finds it in a model of creep at
low loads, towards an area that is never passed. [dillavou_rubinstein_2020] has static friction and
area both grow so, friction faster than area where a shear load acts at rest.

$$
\tau_0\,A\;\to\;\tau_0\,A\left[1+m\ln\left(1+\frac{t_\mathrm w}{t_\mathrm c}\right)\right]
$$

It follows from a rate of creep that falls exponentially with the area gained, as of an activated flow under the pressure that
the growing area relieves: $\dot A=(mA_0/t_\mathrm c)\,e^{-(A-A_0)/(mA_0)}$. Measured are the slope of $\mu_s$ over $\ln t$,
over $\mu_s$ at first, which is $m$, and $t_\mathrm c$, where the line bends. A slope $B$ for each factor of ten in time is
$m=B/(\mu_0\ln10)$.

Laws of the interface alone take it, in the part of their force that goes with the area: what rises with the pressure
([`briscoe_tabor_1978`](#briscoe_tabor_1978)) depends on the load, which does not grow. `contact_area` is that at first.
Every other law is refused: how asperities strengthen that peel, yield or grow under shear is not known.

Over about five decades of time it was followed; results that wait longer say so.

*Limit*: no waiting, or $m=0$: nothing changes. *Check*: $m=0.02$ and $t_\mathrm c=1$ s:

| $t_\mathrm w$ | 0 | 1 s | 1 min | 1 h | 1 day | 1 year |
|---|---|---|---|---|---|---|
| strength over that at first | 1 | 1.01386 | 1.08222 | 1.16378 | 1.22734 | 1.34533 |
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.ageing.kind import Ageing
from stiction.records.registry import Validity
from stiction.records.sources import Source


def factor(groups: Groups) -> np.ndarray:
    """Return the strength after the hold time over the initial strength (n,): 1 + m ln(1 + t_w/t_c)."""
    return 1.0 + groups.ageing_rate * np.log1p(groups.waiting)


def aged(groups: Groups) -> Groups:
    return groups.with_changes(shear_strength=groups.shear_strength * factor(groups))


# Times at rest over the cut-off time: from about a second to about a day (Dieterich 1972, by memory).
_MEASURED = 1e5

RECORD = Ageing(
    key="berthoud_1999",
    title="Strengthening at rest with the logarithm of time",
    grade="B",
    sources=(
        Source("berthoud_1999", "", "not seen; the form is from memory, and derived here"),
        Source("dieterich_1972", "", "not seen; as the works below report it"),
        Source("dieterich_1978", "abstract", "creep at points of contact; growth with the logarithm of time"),
        Source("baumberger_caroli_2006", "abstract", "slow growth of the real area via creep of asperities"),
        Source("jagla_2010", "abstract", "area growing as 1 + C ln(1 + t/t_0) at low loads, towards an end"),
        Source("dillavou_rubinstein_2020", "abstract", "static friction and real area both grow with the logarithm of time"),
    ),
    aged=aged,
    verified="the creep law, inverted by quadrature at 20 digits; both parts of a law of the interface by hand",
    needs=("shear_strength", "waiting", "ageing_rate"),
    validity=(Validity("waiting", 0.0, _MEASURED, "the logarithm was followed over some five decades of time", "fit"),),
    notes="Both coefficients are to be measured: nothing here predicts them. contact_area is that before waiting.",
)
