"""What film laws make of films without thickness, without end, and like their substrate: how far from what these are."""

from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.records.registry import AsperityLaw, FilmLaw, TangentialLaw, find, incompatibility, of_kind
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import groups

PLAIN, PAPER = "greenwood_williamson_1966", "soft_coating_2015"
INTERFACE = next(one.key for one in of_kind(TangentialLaw).values() if one.interfacial)
QUANTITIES = ("load", "contact_area", "friction_force")
# Mean separations over sigma; plasticity indices of the substrate; soft films and hard ones.
H = np.array([3.0, 2.0, 1.0, 0.0])
PLASTICITY = (0.5, 1.0, 2.0, 8.0, 40.0)
FILMS = tuple({"n_E": n_E, "n_H": n_H} for n_E, n_H in ((0.3, 0.2), (3.0, 4.0), (1.0, 0.02), (1.0, 50.0)))
THICK, THIN = 1e14, 1e-14


def groups_of(limit: str, theta: float = 1e6) -> Groups:
    """Contacts over PLASTICITY and FILMS whose film is thin, thick or alike; hardly any adhesion."""
    rows = [(psi, film) for psi in PLASTICITY for film in (({"n_E": 1.0, "n_H": 1.0},) if limit == "alike" else FILMS)]
    tau = {"thin": THIN, "thick": THICK}
    some = [(psi, film, tau.get(limit, one)) for psi, film in rows for one in ((0.3, 1.0, 3.0) if limit == "alike" else (1.0,))]
    eta = np.array([0.75 * np.pi / psi for psi, *_ in some])
    thickness = np.array([one for *_, one in some])
    return groups(
        theta=theta,
        lam=(eta / np.sqrt(np.pi) / 18**0.25 * np.sqrt(theta)) ** 4,
        n_E=[film["n_E"] for _, film, _ in some],
        n_H=[film["n_H"] for _, film, _ in some],
        tau=thickness,
        film_aspect=0.3 * thickness if limit == "alike" else thickness,
        shear_strength=0.05,
    ).resolved()


def choices(film: FilmLaw):
    """The film with every asperity law that suits it, or that of its source, and what the bare contact of it is asked of."""
    if not film.interchangeable:
        options = {"variant": "published"}
        yield Choice(PAPER, options=options), Choice(PAPER, options=options)
        return
    if film.tangential not in ("", "interface"):
        yield Choice(PAPER, film=film.key), Choice(PAPER, options={"transition": "gradual"})
        return
    if own_of_the_bare(film):  # it is its own law of the bare asperity: with a film like it
        yield (Choice(PLAIN, tangential=INTERFACE, film=film.key),) * 2
        return
    if film.own_asperity:
        yield Choice(PLAIN, tangential=INTERFACE, film=film.key), Choice(PLAIN, tangential=INTERFACE)
        return
    for key, asperity in of_kind(AsperityLaw).items():
        if film.asperity in ("", key) and not incompatibility(film, asperity):
            bare = Choice(PLAIN, asperity.key, INTERFACE)
            yield replace(bare, film=film.key), bare
    own = find("roy_chowdhury_ghosh_1994", AsperityLaw)
    if not film.tangential and not film.asperity and not incompatibility(film, own):
        yield Choice(PAPER, film=film.key), Choice(PAPER)


def own_of_the_bare(film: FilmLaw) -> bool:
    """Whether it is a law of bare asperities, that yield, too."""
    if not film.own_asperity or film.tangential != "interface":
        return False
    regimes = problem_of(groups_of("alike"), Choice(PLAIN, tangential=INTERFACE, film=film.key)).regimes
    return any(one.state == "plastic" for one in regimes)


def departures(film: FilmLaw, limit: str, pairs=None) -> dict[str, np.ndarray]:
    """Quantity -> how far it is off (choices, contacts, H), relative to what it should be; not a number where that is nothing
    or below. What it should be: the substrate alone, under a thick film the film alone, in the substrate's units."""
    given = groups_of(limit)
    given = given.with_changes(tabor_parameter=np.full(len(given), 2.0), sharpness=np.full(len(given), 0.03),
                               hardening=np.full(len(given), 0.01))  # fmt: skip
    bare = given.film() if limit == "thick" else given.substrate()
    unit = {name: given.n_E[:, None] if limit == "thick" and name != "contact_area" else 1.0 for name in QUANTITIES}
    # Where the substrate is bare it shears at a strength of its own, which the bare contact does not state.
    found: dict[str, list] = {name: [] for name in QUANTITIES if not (film.bares_substrate and name == "friction_force")}
    for coated, alone in choices(film) if pairs is None else pairs:
        like = (
            {name: np.ones(len(given)) for name in ("n_E", "n_H", "n_g", "tau", "film_aspect")} if own_of_the_bare(film) else {}
        )
        results = problem_of(given, coated).on_grid(H)
        expected = problem_of(bare.with_changes(**like).resolved(), alone).on_grid(H)
        for name in found:
            whole = unit[name] * expected[name]
            with np.errstate(all="ignore"):
                found[name].append(np.where(whole > 0.0, results[name] / whole - 1.0, np.nan))
    return {name: np.array(values) for name, values in found.items()}
