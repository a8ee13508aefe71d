r"""Modulus of a film and its substrate as two springs in series under a flat punch: Bec, Tonck & Loubet 2006.

*Assumes*: film and substrate act as two springs in series under a flat punch of radius $a$. *Source*: [bec_2006], as restated
by the documentation of the NIMS toolbox. $E'=E/(1-\nu^2)$ is the reduced modulus of film and substrate together, $E'_f$ of the
film, $E'_s$ of the substrate. With the film thickness $t$ and $\xi=t/a$,

$$
\frac{E'_s}{E'}=f\,\frac{E'_s}{E'_f}+1-f,\qquad f=\frac{2\xi}{\pi+2\xi}
$$
"""

import math

from stiction.engine.compiled import formula
from stiction.records.registry import Composite
from stiction.records.sources import Source


@formula
def value(film_over_substrate, thickness_over_radius, nu_film, nu_substrate):
    """Return E'/E'_s, the reduced modulus of film and substrate together divided by the substrate's, with E' = E/(1 - nu^2).

    It follows from E'_s/E' = f E'_s/E'_f + 1 - f with f = 2 t/(pi a + 2 t). film_over_substrate: E'_f/E'_s.
    thickness_over_radius: film thickness divided by contact radius, t/a. nu_film and nu_substrate are not used.
    """
    substrate = 1.0 / (1.0 + thickness_over_radius / (0.5 * math.pi))
    return 1.0 / ((1.0 - substrate) / film_over_substrate + substrate)


RECORD = Composite(
    key="bec_2006",
    title="Modulus of film and substrate together: two springs in series",
    grade="B",
    property="modulus",
    value=value,
    sources=(Source("bec_2006", "", "as restated by the documentation of the NIMS toolbox"),),
    verified="independent evaluation; limits of the film alone and of the substrate alone",
    needs=("n_E", "film_aspect"),
)
