"""What abstracts claim of coated and of elastic-plastic asperities, as trends; and what of it does not come out, so that nobody
takes it for granted."""

import numpy as np
import pytest
from scipy.optimize import brentq

from stiction.laws.asperity.brizmer_kligerman_etsion_2006 import critical_values
from stiction.laws.joining import states
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import groups

SHARPNESS = 0.01
# Chen 2019: a soft film on a sphere, E and Y of the film half of the substrate's, E/Y = 1000 of the substrate.
E_OVER_Y, N_E, N_H, NU, K = 1000.0, 0.5, 0.5, 0.3, 2.8
THICKNESSES = np.geomspace(1e-6, 1.0, 19)  # t/R


def sphere(thickness):
    """Groups of one sphere against a rigid flat, t/R given; theta is so large that nothing adheres."""
    eta = 0.75 * np.pi * (K / E_OVER_Y * (1.0 - NU**2)) / SHARPNESS
    theta = 1e8
    tau = thickness / SHARPNESS**2
    film = {"n_E": N_E, "n_H": N_H, "tau": tau, "film_aspect": tau * SHARPNESS}
    return groups(theta, eta**4 * theta**2 / (18.0 * np.pi**2), NU, K, **film, sharpness=SHARPNESS, shear_strength=0.2)


def answer(problem, w):
    """Load and tangential force of one asperity at the displacement w: the regimes that are there, together."""
    total = np.zeros(2)
    for regime in problem.regimes:
        u = np.array([regime.coordinate(w, *(float(np.ravel(one)[0]) for one in regime.parameters))])
        if regime.edges[0, 0] <= u[0] < regime.edges[0, -1]:
            state = states(regime, u)[0]
            total += state[2], state[4] + state[5]
    return total


def friction(thickness, choice, load):
    """mu of one sphere under `load` times the critical load of the film alone."""
    given = sphere(thickness)
    film = given.film()
    critical = float(critical_values(film.eta, film.nu, film.hardness_to_yield)[1][0])
    problem = problem_of(given, choice)
    target = load * critical * N_E
    w = brentq(lambda w: answer(problem, w)[0] - target, 1e-9, 1e6)
    normal, tangential = answer(problem, w)
    assert normal == pytest.approx(target, rel=1e-6)
    return tangential / normal


IN_STICK = Choice("cohen_kligerman_etsion_2008", film="sequential")
AS_ONE_BODY = Choice("greenwood_williamson_1966", tangential="bowden_tabor_1943", film="halling_1979")


@pytest.mark.parametrize("thickness", [1e-5, 1e-4, 1e-2, 1.0])
def test_friction_of_a_coated_sphere_falls_with_the_load(thickness):
    """Chen 2019, abstract."""
    assert np.all(np.diff([friction(thickness, IN_STICK, load) for load in (10.0, 30.0, 100.0, 300.0)]) < 0.0)


def test_film_and_substrate_alone_are_the_ends():
    """A thick film in full stick is a sphere of film: mu = 0.27 coth(0.27 * 100^0.35) = 0.3086 (the published fit)."""
    assert friction(1.0, IN_STICK, 100.0) == pytest.approx(0.3086, abs=5e-5)


def test_no_film_shows_the_published_minimum():
    """Chen 2019 finds that mu first falls, then rises with t/R. Neither film law does that: the sequential film has a greatest
    friction at the thickness that just holds, and half-spaces of effective properties only rise. The numbers of that study are
    not published as formulas, so that no law of it can be here."""
    in_stick = np.array([friction(one, IN_STICK, 100.0) for one in THICKNESSES])
    top = int(np.argmax(in_stick))
    assert 0 < top < len(THICKNESSES) - 1
    assert np.all(np.diff(in_stick[top:]) <= 1e-12)
    as_one_body = np.array([friction(one, AS_ONE_BODY, 100.0) for one in THICKNESSES])
    assert np.all(np.diff(as_one_body) >= -1e-12) and as_one_body[-1] > as_one_body[0]


@pytest.mark.parametrize("model", ["kogut_etsion_2004", "cohen_kligerman_etsion_2008", "chang_etsion_bogy_1988"])
def test_friction_falls_with_load_and_with_the_plasticity_index(model):
    """Kogut & Etsion 2004, abstract: mu depends strongly on load and is governed by the plasticity index."""
    # w_c = sigma/psi^2 by the authors' psi: (2/3 c eta)^2 = 1/psi^2.
    psi = np.array([0.5, 1.0, 2.0, 4.0])
    eta = 1.5 / (0.577 * psi)
    found = problem_of(groups(1e8, eta**4 * 1e16 / (18.0 * np.pi**2)), Choice(model)).on_grid(np.linspace(3.0, 0.0, 7))
    mu = found["friction_coefficient"]
    assert np.all(np.diff(mu, axis=1) < 0.0)  # closer, so more load
    assert np.all(np.diff(mu, axis=0) < 0.0)
