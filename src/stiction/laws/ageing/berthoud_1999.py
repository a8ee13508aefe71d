r"""Growth of static friction with the logarithm of the hold time, by creep: Berthoud et al. 1999, Dieterich 1972.

*Assumes*: the junctions creep under the load. The real contact area, and with it the shear force $\tau_0A$, grows with the
logarithm of the hold time $t_\mathrm w$, the time at rest under load. The growth is small until the reference time
$t_\mathrm c$ and has no upper limit. No shear force acts during the rest. *Source*: [dieterich_1978], abstract, for rocks
(first in [dieterich_1972]); [berthoud_1999] for rough polymers; [baumberger_caroli_2006], abstract: slow growth of the real
area by creep. The formula is written from memory and derived below. [jagla_2010], abstract, finds this formula in a model of
creep at low loads, but in this model the area tends to a limit. In [dillavou_rubinstein_2020], abstract, static friction and
area both grow this way, and friction grows faster than area if a shear load acts at rest.

$$
\tau_0\,A\;\to\;\tau_0\,A\left[1+m\ln\left(1+\frac{t_\mathrm w}{t_\mathrm c}\right)\right]
$$

$\tau_0$ is the shear strength of the interface, $A$ the real contact area and $m$ the ageing rate. The formula follows if the
creep rate falls exponentially with the gained area, as in a thermally activated flow whose pressure decreases while the area
grows: $\dot A=(mA_0/t_\mathrm c)\,e^{-(A-A_0)/(mA_0)}$, with the initial area $A_0$. $m$ and $t_\mathrm c$ must be measured:
$m$ is the slope of the static friction coefficient against $\ln t$, divided by its initial value $\mu_0$; $t_\mathrm c$ is the
time at which the straight line begins. A slope $B$ per decade of time corresponds to $m=B/(\mu_0\ln10)$.

Only tangential laws of the interface accept ageing, for the part of their force that is proportional to the area. The part
that rises with pressure ([`briscoe_tabor_1978`](#briscoe_tabor_1978)) depends on the load and does not grow. The result
`contact_area` is the initial area. Every other tangential law raises an error, because it is unknown how asperities that peel,
yield or grow under shear gain strength.

Experiments followed the growth for about five decades of time; results for longer hold times carry a validity warning.

*Limit*: at zero hold time, or for $m=0$, the strength does not change. *Check*: $m=0.02$ and $t_\mathrm c=1$ s:

| $t_\mathrm w$ | 0 | 1 s | 1 min | 1 h | 1 day | 1 year |
|---|---|---|---|---|---|---|
| strength over initial strength | 1 | 1.01386 | 1.08222 | 1.16378 | 1.22734 | 1.34533 |
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.ageing.kind import Ageing
from stiction.records.registry import Validity
from stiction.records.sources import Source


def factor(groups: Groups) -> np.ndarray:
    """Return the ratio (n,) of the interface strength after the hold time to its initial value.

    It is 1 + m ln(1 + t_w/t_c), with the ageing rate m, the hold time t_w and the reference time t_c.
    """
    return 1.0 + groups.ageing_rate * np.log1p(groups.waiting)


def aged(groups: Groups) -> Groups:
    return groups.with_changes(shear_strength=groups.shear_strength * factor(groups))


# Largest measured hold time over the reference time: from about a second to about a day (Dieterich 1972, from memory).
_MEASURED = 1e5

RECORD = Ageing(
    key="berthoud_1999",
    title="Growth of static friction with the logarithm of the hold time",
    grade="B",
    sources=(
        Source("berthoud_1999", "", "not available; the formula is from memory and derived here"),
        Source("dieterich_1972", "", "not available; as the works below report it"),
        Source("dieterich_1978", "abstract", "creep at points of contact; growth with the logarithm of time"),
        Source("baumberger_caroli_2006", "abstract", "slow growth of the real area via creep of asperities"),
        Source("jagla_2010", "abstract", "area growing as 1 + C ln(1 + t/t_0) at low loads, up to a limit"),
        Source("dillavou_rubinstein_2020", "abstract", "static friction and real area both grow with the logarithm of time"),
    ),
    aged=aged,
    verified="the creep law integrated numerically at 20 digits; the aged and the constant part of a force, by hand",
    needs=("shear_strength", "waiting", "ageing_rate"),
    validity=(
        Validity(
            "waiting",
            0.0,
            _MEASURED,
            "the law was measured over five decades of time; for longer holds it is extrapolated",
            "fit",
        ),
    ),
    notes="Ageing rate and reference time must be measured; no law here predicts them. contact_area is the initial area.",
)
