"""The model this project exists for: static friction of adhesive rough surfaces, bare or with a thin soft film (2015)."""

import numpy as np

from ..asperity.regime import Regime
from ..coating.graded import bare_regimes_with_transition
from ..errors import InputError
from ..friction.adhesive_asperity import PRINTED_GRIP, Asperity, Share, bare_regimes
from ..groups import Groups
from ..registry import Limit, Record, Validity, find
from ..sources import Source


def regimes(groups: Groups, reading: str, coating_law: str, branch: str, transition: str) -> list[Regime]:
    """Regimes of a bare or coated surface (docs/theory.md, sections 2 to 6)."""
    printed, unloading, gradual = reading == "published", branch == "unloading", transition == "gradual"
    if unloading and (printed or groups.coated or gradual):
        raise InputError("branch", branch, "loading; unloading is for the corrected reading of a bare surface that jumps")
    if gradual and (printed or groups.coated):
        raise InputError("transition", transition, "jump; bare surfaces and the graded film have a gradual one, corrected")
    nu, k = groups.nu, groups.hardness_to_yield
    substrate = Asperity(groups.theta, groups.lam, groups.K_beta, nu, k, printed)
    if not groups.coated:
        if gradual:
            return bare_regimes_with_transition(substrate)
        return bare_regimes(substrate, unloading, Share(grip=PRINTED_GRIP) if printed else Share())
    film = Asperity(groups.film_theta, groups.film_lam, groups.film_K_beta, groups.film_nu, k, printed)
    return find("printed" if printed else coating_law, "film").regimes(substrate, film, groups)


def _adhesion_without_plasticity(theta: float, eta: float) -> dict[str, float]:
    """Groups with a given hardness group: lambda = eta^4 theta^2 / (18 pi^2)."""
    return {"theta": theta, "lam": eta**4 * theta**2 / (18.0 * np.pi**2)}


RECORD = Record(
    key="soft_coating_2015",
    kind="rough surface",
    title="Static friction in adhesive contact of rough surfaces with soft coatings",
    grade="C",
    sources=(
        Source("soft_coating_2015", "eqs. (1)-(15)", "twelve departures D1-D12, see docs/theory.md"),
        Source("roy_chowdhury_ghosh_1994", "the asperity: JKR until its mean pressure is the hardness, then plastic"),
        Source("johnson_kendall_roberts_1971", "load and displacement"),
        Source("savkoor_briggs_1977", "slip resistance"),
        Source("hamilton_1983", "stresses at the trailing edge", "C1..C7 of eq. (11) are a reconstruction"),
    ),
    regimes=regimes,
    verified="independent evaluation at 30 digits, both readings, bare and coated; limits below. The paper prints no numbers",
    needs=("theta", "lam", "nu", "hardness_to_yield"),
    validity=(
        Validity("tabor_parameter", 5.0, np.inf, "adhesion acts inside the contact only for soft, large asperities"),
        Validity("mean_separation", -4.0, np.inf, "closer, asperities are no longer independent (section 4 of the paper)"),
    ),
    limits=(
        Limit("greenwood_williamson_1966", _adhesion_without_plasticity(1e14, 1e4), ("load", "contact_area"), 1e-6),
        Limit("fuller_tabor_1975", {"lam": 1e30}, ("load", "contact_area"), 1e-9),
        Limit("fuller_tabor_1975", {"lam": 1e30}, ("load", "contact_area"), 1e-9, {"branch": "unloading"}),
    ),
    own_options={
        "reading": ("corrected", "published"),
        "branch": ("loading", "unloading"),
        "transition": ("jump", "gradual"),
    },
    default_film="sequential",
    load_falls=False,
    notes="The load of an asperity jumps where it becomes plastic: up to twofold. Under strong adhesion it "
    "falls there, and into tension where lambda^(1/4) theta^(-1/6) is below 0.184.",
)
