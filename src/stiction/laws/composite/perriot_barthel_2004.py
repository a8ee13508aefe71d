r"""Modulus of a film and its substrate, fitted to the numerical contact of a coated half-space: Perriot & Barthel 2004.

*Assumes*: a fit to numerical solutions of the contact with a coated half-space. *Source*: [perriot_barthel_2004], as restated
by the documentation of the NIMS toolbox. $E'=E/(1-\nu^2)$ is the reduced modulus; indices $f$ and $s$ denote film and
substrate, no index both together. With the film thickness $t$, the contact radius $a$ and $\xi=t/a$,

$$
\frac{E'}{E'_s}=\frac{E'_f}{E'_s}+\frac{1-E'_f/E'_s}{1+(k_0\xi)^{n}},\qquad
\log_{10}k_0=-0.093+0.792\,\ell+0.05\,\ell^2,\quad\ell=\log_{10}(E'_s/E'_f)
$$

*Unknown*: the exponent $n=1.27$ is from memory; according to the restatement it varies from 1.06 to 1.32 with the moduli.
"""

import math

from stiction.engine.compiled import formula
from stiction.records.registry import Composite, Validity
from stiction.records.sources import Source

# The authors' exponent varies with the moduli, from 1.06 to 1.32 according to the NIMS toolbox; this is the value most quoted.
EXPONENT = 1.27


@formula
def value(film_over_substrate, thickness_over_radius, nu_film, nu_substrate):
    """Return E'/E'_s, the reduced modulus of film and substrate together divided by the substrate's, with E' = E/(1 - nu^2).

    E' = E'_f + (E'_s - E'_f)/(1 + (k0 t/a)^n) with log k0 = -0.093 + 0.792 log(E'_s/E'_f) + 0.05 (log(E'_s/E'_f))^2 (base
    10) and n = 1.27. film_over_substrate: E'_f/E'_s. thickness_over_radius: film thickness divided by contact radius, t/a.
    nu_film and nu_substrate are not used.
    """
    mismatch = -math.log10(film_over_substrate)
    k0 = 10.0 ** (-0.093 + mismatch * (0.792 + 0.05 * mismatch))
    return film_over_substrate + (1.0 - film_over_substrate) / (1.0 + (k0 * thickness_over_radius) ** EXPONENT)


RECORD = Composite(
    key="perriot_barthel_2004",
    title="Modulus of film and substrate together: fitted to numerical solutions",
    grade="C",
    property="modulus",
    value=value,
    sources=(
        Source(
            "perriot_barthel_2004",
            "",
            "k0 as restated by the documentation of the NIMS toolbox; the exponent 1.27 is from memory",
        ),
    ),
    verified="independent evaluation; limits of the film alone and of the substrate alone",
    needs=("n_E", "film_aspect"),
    validity=(Validity("n_E", 0.01, 100.0, "the numerical solutions do not cover such moduli"),),
    notes="In the source the exponent varies from 1.06 to 1.32 with the ratio of the moduli; here it is 1.27 throughout.",
)
