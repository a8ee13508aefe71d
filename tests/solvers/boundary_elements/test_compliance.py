"""The compliance of a film on a half-space: against the boundary conditions of one wave solved directly, and limits."""

import math

import mpmath
import numpy as np
import pytest

from refusals import refusal
from stiction.solvers.boundary_elements.compliance import Compliance, Film

RIGID = math.inf


def wave_solved_directly(k, thickness, modulus1, nu1, modulus2, nu2):
    """u_z/p at the face of the film under the pressure cos(k x), from Airy's function in plane strain, with 40 digits.

    phi = f(z) cos(k x), f = (A + B z) e^(-k z) + (C + D z) e^(k z) in the film, (E + F z) e^(-k z) below it. Stresses are
    phi,xx = s_zz, -phi,xz = s_xz, phi,zz = s_xx; displacements by integrating Hooke's law in plane strain. Six conditions:
    pressure and no shear on the face; both stresses and both displacements go on through the interface.
    """
    with mpmath.workdps(40):
        k, t = mpmath.mpf(k), mpmath.mpf(thickness)

        def terms(z, growing):
            """f and its first three derivatives, a row for every constant."""
            rows = []
            for sign in (-1, 1) if growing else (-1,):
                for power in (0, 1):
                    rate, wave = sign * k, mpmath.exp(sign * k * z)
                    value = [wave * (rate**n * z**power + (n * rate ** (n - 1) if power and n else 0)) for n in range(4)]
                    rows.append(value)
            return rows

        def field(z, modulus, nu, growing):
            """s_zz, s_xz, u_x, u_z of every constant, without their cos or sin."""
            shear = mpmath.mpf(modulus) / (2 * (1 + mpmath.mpf(nu)))
            out = []
            for f, f1, f2, f3 in terms(z, growing):
                along = ((1 - nu) * f2 + nu * k**2 * f) / (2 * shear * k)
                along_slope = ((1 - nu) * f3 + nu * k**2 * f1) / (2 * shear * k)
                out.append((-(k**2) * f, k * f1, along, (along_slope - k * f1 / shear) / k))
            return out

        face, above = field(mpmath.mpf(0), modulus1, nu1, True), field(t, modulus1, nu1, True)
        below = field(mpmath.mpf(0), modulus2, nu2, False)
        matrix = mpmath.matrix(6, 6)
        for column in range(4):
            matrix[0, column], matrix[1, column] = face[column][0], face[column][1]
            for row in range(4):
                matrix[2 + row, column] = above[column][row]
        for column in range(2):
            for row in range(4):
                matrix[2 + row, 4 + column] = -below[column][row]
        constants = mpmath.lu_solve(matrix, mpmath.matrix([-1, 0, 0, 0, 0, 0]))
        return float(sum(constants[n] * face[n][3] for n in range(4)))


@pytest.mark.parametrize("nu1", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("ratio", [0.02, 0.5, 1.0, 7.0, 200.0])
def test_a_wave_obeys_its_six_boundary_conditions(ratio, nu1):
    film = Film(2e-6, ratio * 3e9, nu1, 3e9, 0.25)
    for kt in (1e-3, 0.05, 0.3, 0.51, 1.0, 3.0, 9.0):
        k = kt / film.thickness
        direct = wave_solved_directly(k, film.thickness, film.modulus, nu1, 3e9, 0.25)
        assert Compliance(math.inf, film).at(np.array([k]))[0] == pytest.approx(direct, rel=1e-12)


@pytest.mark.parametrize("nu1", [0.0, 0.3, 0.499999, 0.5])
def test_a_film_on_a_rigid_base(nu1):
    film = Film(1.0, 1.0, nu1, RIGID, 0.3)
    for k in (1e-3, 0.1, 1.0, 4.0):
        direct = wave_solved_directly(k, 1.0, 1.0, nu1, 1e25, 0.3)
        assert Compliance(math.inf, film).at(np.array([k]))[0] == pytest.approx(direct, rel=1e-9)


def test_a_thin_film_on_a_rigid_base_gives_way_by_its_oedometric_modulus_unless_incompressible():
    oedometric = 2.0 * (1.0 - 0.3) / ((1.0 + 0.3) * (1.0 - 2.0 * 0.3))
    thin = Compliance(math.inf, Film(1e-3, 2.0, 0.3, RIGID, 0.3)).at(np.array([0.0, 1e-3]))
    assert thin == pytest.approx(1e-3 / oedometric, rel=1e-5)
    # lubrication-like: u/p = k^2 t^3 / (3 mu), mu = E/3
    incompressible = Compliance(math.inf, Film(1e-3, 2.0, 0.5, RIGID, 0.3)).at(np.array([0.0, 1e-2, 1.0]))
    assert incompressible == pytest.approx([0.0, 1e-4 * 1e-9 / 2.0, 1e-9 / 2.0], rel=1e-5)


def test_limits_of_thickness_and_of_equal_materials():
    k = np.geomspace(1.0, 1e4, 9)
    for thickness, modulus in ((1e-12, 5.0 / 0.91), (1e3, 0.7 / (1.0 - 0.4**2))):
        film = Film(thickness, 0.7, 0.4, 5.0, 0.3)
        assert Compliance(math.inf, film).at(k) == pytest.approx(2.0 / (modulus * k), rel=1e-6)
    same = Film(1e-3, 5.0, 0.3, 5.0, 0.3)
    assert Compliance(math.inf, same).at(k) == pytest.approx(2.0 * 0.91 / (5.0 * k), rel=1e-13)
    assert Compliance(5.0 / 0.91, same).at(k) == pytest.approx(4.0 * 0.91 / (5.0 * k), rel=1e-13)  # both bodies give way


@pytest.mark.parametrize(
    ("name", "value"),
    [("thickness", 0.0), ("modulus", math.nan), ("poisson", 0.6), ("substrate_modulus", -1.0), ("substrate_poisson", -1.0)],
)
def test_a_film_that_cannot_be_is_refused(name, value):
    good = {"thickness": 1e-6, "modulus": 1e9, "poisson": 0.4, "substrate_modulus": 1e11, "substrate_poisson": 0.3}
    with refusal(f"film.{name}"):
        Film(**{**good, name: value})


def test_a_rigid_pair_is_refused():
    with refusal("modulus", "> 0 Pa"):
        Compliance(math.inf)
