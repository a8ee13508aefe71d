r"""Elastic asperities of one radius with distributed heights, without adhesion: Greenwood & Williamson 1966.

*Assumes*: asperities of one radius are independent, each with a [Hertz](#hertz) contact. *Source*: [greenwood_williamson_1966],
load, area and number of contacts. Load $\bar P$ and area $\bar A$ per asperity at the mean separation $h$ (in units of
$\sigma$), with the density $\varphi(z)$ of asperity heights $z$, also in units of $\sigma$, are

$$
\bar P=F_{3/2}(h),\qquad\bar A=F_1(h),\qquad F_n(h)=\int_h^\infty(z-h)^n\varphi(z)\,dz
$$

The fraction $F_0$ of the asperities touches. In SI the nominal pressure is $p=\tfrac43NE^*R^{1/2}\sigma^{3/2}F_{3/2}$ and the
ratio of contact area to nominal area $A/A_n=\pi NR\sigma F_1$, with $N$ asperities per area of the tip radius $R$ and height
deviation $\sigma$, and the contact modulus $E^*$. *Check*, Gaussian heights:

| $h$ | $F_0$ | $F_{1/2}$ | $F_1$ | $F_{3/2}$ | $F_2$ | $F_{5/2}$ |
|---|---|---|---|---|---|---|
| 0 | 0.5 | 0.4110895 | 0.3989423 | 0.4300200 | 0.5 | 0.6166342 |
| 0.5 | 0.3085375 | 0.2253356 | 0.1977966 | 0.1952036 | 0.2096393 | 0.2404016 |
| 1 | 0.1586553 | 0.1041537 | 0.0833155 | 0.0756682 | 0.0753398 | 0.0805623 |
| 1.5 | 6.680720e-2 | 3.988152e-2 | 2.930679e-2 | 2.463948e-2 | 2.284701e-2 | 2.286306e-2 |
| 2 | 2.275013e-2 | 1.248004e-2 | 8.490703e-3 | 6.648178e-3 | 5.768727e-3 | 5.423705e-3 |
| 3 | 1.349898e-3 | 6.418504e-4 | 3.821543e-4 | 2.639676e-4 | 2.034351e-4 | 1.708730e-4 |
| 4 | 3.167124e-5 | 1.340667e-5 | 7.145258e-6 | 4.439155e-6 | 3.090208e-6 | 2.353381e-6 |
"""

from stiction.records.registry import RoughSurface
from stiction.records.sources import Source

RECORD = RoughSurface(
    key="greenwood_williamson_1966",
    title="Elastic contact of nominally flat surfaces",
    grade="B",
    sources=(Source("greenwood_williamson_1966", "load, area and number of contacts"),),
    asperity="hertz",
    verified="sums over Gaussian heights, integrated independently at 30 digits; closed forms for exponential heights",
)
