r"""JKR asperities in Greenwood & Williamson's sum, elastic at any load: Fuller & Tabor 1975.

*Assumes*: [`jkr`](#jkr) asperities of one radius are independent. *Source*: [fuller_tabor_1975]. The load per asperity at the
mean separation $h$ (in units of $\sigma$), with the density $\varphi$ of heights, is

$$
\bar P(h)=\int P_\text{JKR}(w)\,\varphi(h+w)\,dw
$$

*Check*: the pull-off force on the unloading branch, divided by the force $NA_nP_c$ of all $NA_n$ asperities if each had its
maximum $P_c=\tfrac32\pi\gamma R$ at the same time, and the separation $h$ at this force. Both depend on
$1/\Delta_c=\theta^{2/3}/1.94889$, where $\theta$ is the adhesion index and $\Delta_c$ the stretch, in units of $\sigma$, at
which an asperity loses contact:

| $1/\Delta_c$ | 0.1 | 0.2 | 0.3 | 0.5 | 0.75 | 1 | 1.5 | 2 | 2.5 | 3 | 4 |
|---|---|---|---|---|---|---|---|---|---|---|---|
| pull-off | .99384 | .97283 | .93090 | .81231 | .65143 | .50465 | .28108 | .14398 | .06823 | .02994 | .00456 |
| $h$ | 4.71 | 2.11 | 1.13 | 0.45 | 0.29 | 0.33 | 0.58 | 0.90 | 1.23 | 1.56 | 2.23 |
"""

from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="fuller_tabor_1975",
    title="Adhesion of elastic rough surfaces with JKR asperities",
    grade="B",
    sources=(Source("fuller_tabor_1975", "", "pull-off on the unloading branch"),),
    asperity="jkr",
    verified="pull-off force and sums over heights, computed independently at 30 digits; Greenwood & Williamson without "
    "adhesion",
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-4),),
)
