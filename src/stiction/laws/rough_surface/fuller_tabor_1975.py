r"""JKR asperities in Greenwood & Williamson's sum, elastic at any load: Fuller & Tabor 1975.

*Assumes*: [`jkr`](#jkr) asperities of one radius are independent. *Source*: [fuller_tabor_1975].

$$
\bar P(h)=\int P_\text{JKR}(w)\,\varphi(h+w)\,dw
$$

*Check*: the pull-off force on the unloading branch, over $NA_nP_c$, against $1/\Delta_c=\theta^{2/3}/1.94889$, where
$\Delta_c$ is the stretch over $\sigma$ at which one asperity loses contact, and the separation $h$ at the pull-off force:

| $1/\Delta_c$ | 0.1 | 0.2 | 0.3 | 0.5 | 0.75 | 1 | 1.5 | 2 | 2.5 | 3 | 4 |
|---|---|---|---|---|---|---|---|---|---|---|---|
| pull-off | .99384 | .97283 | .93090 | .81231 | .65143 | .50465 | .28108 | .14398 | .06823 | .02994 | .00456 |
| $h$ | 4.71 | 2.11 | 1.13 | 0.45 | 0.29 | 0.33 | 0.58 | 0.90 | 1.23 | 1.56 | 2.23 |
"""

from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="fuller_tabor_1975",
    title="Adhesion of elastic solids with rough surfaces",
    grade="B",
    sources=(Source("fuller_tabor_1975", "", "pull-off on the unloading branch"),),
    asperity="jkr",
    verified="pull-off curve and integrals at 30 digits; Greenwood-Williamson without adhesion",
    limits=(Limit("greenwood_williamson_1966", {"theta": 1e14}, ("load", "contact_area"), 1e-4),),
)
