r"""Static friction of adhesive rough surfaces, bare or with a thin soft film: the 2015 paper.

*Assumes*: asperities of [`roy_chowdhury_ghosh_1994`](#roy_chowdhury_ghosh_1994) are independent, and their friction follows
[the tangential law of 2015](#soft_coating_2015-tangential-law). A film deforms alone until the displacement equals its
thickness, [`sequential`](#sequential). *Source*: [soft_coating_2015], eqs. (1) to (15). The friction coefficient of a bare
surface at the mean separation $h$ (in units of $\sigma$) is

$$
\mu(h)=\frac{\int T(w)\,\varphi(h+w)\,dw}{\int P(w)\,\varphi(h+w)\,dw}
$$

with the load $P$ and the tangential force $T$ of one asperity at the displacement $w$ and the density $\varphi$ of heights. All
equations, and all departures from the printed equations, are in [theory](theory.md). With `variant="published"` the printed
equations are used, [`printed`](#printed). With `transition="gradual"` an asperity becomes plastic gradually, as in
[`graded`](#graded). *Reconstructed*: the coefficients of eq. (11), departure D12.
"""

import numpy as np

from stiction.contact.indices import Groups
from stiction.engine.regime import Regime
from stiction.laws.film.printed import bare_regimes
from stiction.laws.joining import Law
from stiction.quantities.errors import InputError
from stiction.records.registry import JUNCTIONS, NO_JUNCTIONS, FilmLaw, Limit, RoughSurface, Validity, select_options
from stiction.records.sources import Source


def regimes(groups: Groups, law: Law, film: FilmLaw | None, variant: str, transition: str) -> list[Regime]:
    """Return the regimes of a bare or coated surface in the 2015 model (docs/explanation/theory.md, sections 2 to 6).

    A regime is a segment of an asperity law together with the tangential force on it. groups: dimensionless groups of n
    contacts. law: asperity law, tangential law and options. film: film law, or None. variant: "corrected" or "published".
    transition: "jump" or "gradual" onset of plastic contact. Raises InputError for options that exclude each other, or that
    exclude one of the laws.
    """
    printed, gradual = variant == "published", transition == "gradual"
    if law.options.get("branch") == "unloading" and (printed or gradual or groups.has_film):
        allowed = "loading; unloading requires the corrected variant, transition = jump and no film"
        raise InputError("branch", "unloading", allowed)
    if gradual and (printed or groups.has_film):
        allowed = "jump; gradual requires the corrected variant and no film; with a film use the graded film law"
        raise InputError("transition", transition, allowed)
    if (printed or gradual) and law.options.get(JUNCTIONS, NO_JUNCTIONS) != NO_JUNCTIONS:
        raise InputError(
            JUNCTIONS, law.options[JUNCTIONS], f"{NO_JUNCTIONS} with the published variant or the gradual transition"
        )
    for chosen, key in ((law.asperity, RECORD.asperity), (law.tangential, RECORD.tangential)):
        if (printed or gradual) and (chosen is None or chosen.key != key):
            kind, value = (chosen.kind, chosen.key) if chosen else ("tangential", "none")
            raise InputError(kind, value, f"{key} with the published variant or the gradual transition")
    if film is not None:
        return film.regimes(groups, law, **select_options(film, law.options))
    if gradual:
        from stiction.laws.film.graded import bare_regimes_with_transition  # slow to import

        return bare_regimes_with_transition(groups)
    return bare_regimes(groups) if printed else law.regimes(groups)


def _adhesion_without_plasticity(theta: float, eta: float) -> dict[str, float]:
    """Return the adhesion indices {"theta": theta, "lam": lambda} for a given theta and hardness group eta.

    theta is the elastic adhesion index and lambda = eta^4 theta^2 / (18 pi^2) the plastic one. If eta is large, nothing
    yields.
    """
    return {"theta": theta, "lam": eta**4 * theta**2 / (18.0 * np.pi**2)}


RECORD = RoughSurface(
    key="soft_coating_2015",
    title="Static friction in adhesive contact of rough surfaces with soft coatings",
    grade="C",
    sources=(
        Source("soft_coating_2015", "eqs. (1)-(15)", "twelve departures D1-D12, see docs/explanation/theory.md"),
        Source("greenwood_williamson_1966", "the sum over heights"),
    ),
    asperity="roy_chowdhury_ghosh_1994",
    tangential="soft_coating_2015",
    regimes=regimes,
    verified="load, area and friction of both variants, bare and coated, computed independently at 30 digits; limits; the "
    "paper prints no numbers",
    validity=(
        Validity(
            "mean_separation",
            -4.0,
            np.inf,
            "at such small separations asperities interact, which the model neglects (soft_coating_2015, section 4)",
        ),
    ),
    limits=(
        Limit("greenwood_williamson_1966", _adhesion_without_plasticity(1e14, 1e4), ("load", "contact_area"), 1e-6),
        Limit("fuller_tabor_1975", {"lam": 1e30}, ("load", "contact_area"), 1e-9),
        Limit("fuller_tabor_1975", {"lam": 1e30}, ("load", "contact_area"), 1e-9, {"branch": "unloading"}),
    ),
    own_options={"variant": ("corrected", "published"), "transition": ("jump", "gradual")},
    default_film="sequential",
    film_by_option={"published": "printed"},
)
