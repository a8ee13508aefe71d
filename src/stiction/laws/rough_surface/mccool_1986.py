r"""Greenwood & Williamson's model with the summits of a Gaussian surface as asperities: McCool 1986.

*Assumes*: Greenwood and Williamson's sum. The asperities are the summits of an isotropic Gaussian surface. Their density $N$,
radius $R$ and height deviation $\sigma$ follow from the spectral moments $m_0$, $m_2$ and $m_4$ of a profile, which are the
variances of height, slope and curvature. *Source*: [mccool_1986], [nayak_1971]. The formulas are in
`stiction.surfaces.theory.moments`:

$$
N=\frac{m_4/m_2}{6\pi\sqrt3},\quad R=\frac38\sqrt{\frac\pi{m_4}},\quad\sigma^2=\left(1-\frac{0.8968}\alpha\right)m_0,\quad
\alpha=\frac{m_0m_4}{m_2^2},\quad\text{mean summit height}\ 4\sqrt{\frac{m_0}{\pi\alpha}}
$$

0.8968 is $1+16/\pi-3\sqrt3$; $\alpha$ is the bandwidth parameter. Other sources write these formulas in terms of $NR$:
$\sigma^2=m_0-3.717\cdot10^{-4}/(NR)^2$, mean summit height $0.045944/(NR)$. With $\rho=NR\sigma$ and
$\varsigma=\sqrt{\sigma/R}$, $\alpha=768\pi\,\rho^2+0.8968$, and the root mean square gradient $h'=\sqrt{2m_2}$ is
$\varsigma\,(\sqrt3/(64\rho))^{1/2}$. *Traps*: $m_2$ and $m_4$ belong to a profile, and the mean square gradient of the surface
is $2m_2$; the mean curvature of summits does not depend on $m_2$; separations from the mean plane and from the mean summit
height differ by $1/(\sqrt{48}\pi\rho)$ in units of $\sigma$.

At light load, theories are compared by $\kappa$ in $A/A_n=\kappa\,p/(E^*h')$, with the ratio $A/A_n$ of contact area to
nominal area, the nominal pressure $p$ and the contact modulus $E^*$. *Check*: in this model $\kappa$ depends on the separation
$h$ (in units of $\sigma$):

| $\alpha$ | $h=1$ | 2 | 3 | 4 |
|---|---|---|---|---|
| 2 | 2.919 | 3.385 | 3.838 | 4.267 |
| 5 | 2.102 | 2.438 | 2.763 | 3.072 |
| 10 | 1.722 | 1.997 | 2.264 | 2.517 |
| 50 | 1.130 | 1.311 | 1.486 | 1.652 |

Numerical solutions give $\kappa$ of about 2, so this model gives 0.5 to 2 times the numerical area, depending on $\alpha$ and
$h$.
"""

from stiction.laws.shared_claims import ELASTIC
from stiction.records.registry import Limit, RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="mccool_1986",
    title="Greenwood & Williamson's model with the summits of a Gaussian surface",
    grade="B",
    sources=(
        Source("mccool_1986", "", "asperities from spectral moments"),
        Source("nayak_1971", "", "number, mean curvature and heights of the summits"),
        Source("greenwood_williamson_1966", "", "the sum over heights"),
    ),
    asperity="hertz",
    takes_surface_moments=True,
    verified="ratio of area to load of surfaces with known spectral moments; summit numbers by integrating Nayak's density",
    validity=(ELASTIC,),
    limits=(Limit("greenwood_williamson_1966", {}, ("load", "contact_area"), 1e-14),),
    notes=(
        "For given sigma, R and N the model equals that of Greenwood & Williamson; here sigma, R and N follow from the "
        "spectral moments of the surface. The separation is from the mean summit height; the mean plane is lower by sigma / "
        "(sqrt(48) pi N R sigma)."
    ),
)
