"""The soft film of the 2015 paper to the letter of its eqs (6) and (15): film terms in the film's own units (D4), the
substrate's elastic term from tau + x0 with its law unshifted, its plastic term from w1 (D5). Kept to reproduce the print.
"""

import numpy as np

from ..asperity.regime import Regime
from ..friction import adhesive_asperity as asperities
from ..friction.adhesive_asperity import PRINTED_GRIP, Asperity, Share
from ..groups import Groups
from ..registry import Record, Validity
from ..sources import Source
from .film import clip, film_regimes


def regimes(substrate: Asperity, film: Asperity, groups: Groups) -> list[Regime]:
    """Regimes of a coated surface. Limits that cross make an empty integral (D9); of the film, only asperities
    with x < tau resist (D10). The area, which is not printed, is the film's own."""
    tau = groups.tau
    elastic_shares = Share(grip=PRINTED_GRIP), Share(grip=0.0)
    plastic_shares = Share(), Share(force=0.0)
    film_part = film_regimes(film, groups.film_aspect, (tau**0.25, tau), elastic_shares, plastic_shares)
    edges, branch = substrate.kinks()
    labels = {"body": "substrate", "touching": False}
    from_film = clip(edges, (tau + edges[:, 0] ** 4) ** 0.25, np.inf)
    from_film = np.minimum(from_film, edges[:, -1:])
    share = Share(grip=PRINTED_GRIP, cover=0.0)
    first = asperities.onset_of_plasticity(substrate, edges)
    return [
        *film_part,
        asperities.elastic_regime(substrate, from_film, branch, share, **labels),
        asperities.plastic_regime(substrate, first, np.inf, Share(cover=0.0), **labels),
    ]


RECORD = Record(
    key="printed",
    kind="film",
    title="Soft film to the letter of the 2015 paper; the film law of the published reading",
    grade="C",
    sources=(Source("soft_coating_2015", "eqs. (6)-(9) and (15)", "as printed but D7-D11; C1..C7 reconstructed"),),
    regimes=regimes,
    verified="independent evaluation at 30 digits. The paper prints no numbers",
    needs=("n_E", "n_H", "tau"),
    validity=(Validity("load_share_beyond_film", 0.0, 0.5, "the film is a half-space: contact radius below thickness"),),
    interchangeable=False,
    load_falls=False,
    notes="Adds loads in units of the film to loads in units of the substrate (D4).",
)
