"""Where a dragged sphere first makes film or body yield, and how stiff it is against being dragged."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from stiction.laws.tangential.shared import hamilton_field
from stiction.solvers.layered.bodies import bodies_of, per_root
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.edge import edge_curves
from stiction.solvers.layered.first_yield import ANGLES, PLACES, at_interface, first_yield, norms, table_of_norms
from stiction.solvers.layered.shear import shear_compliance, shear_curve, shear_ends
from stiction.solvers.layered.stresses import Stresses, cartesian
from stiction.solvers.layered.waves import CoatedBody
from tables import column, groups, read

FILM = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0, "film_aspect": 1.0}


def under_rigid_sphere(ratio, nu, nu_below, radius):
    return Stresses((Layer.of(1.0, ratio, nu, nu_below),), CoatedBody(ratio, nu, nu_below), radius)


@pytest.mark.parametrize("radius", [0.02, 0.5, 1.0, 2.0, 5.0, 30.0])
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.45])
def test_like_materials_yield_as_hamilton_has_it(radius, nu):
    traction = np.array([0.0, 0.05, 0.1, 0.2, 0.3, 0.35, 0.5, 0.8, 1.0, 2.0, 10.0])
    whole = under_rigid_sphere(1.0, nu, nu, radius)
    expected = [1.5 / hamilton_field.first_yield(one, nu)[0] for one in traction]  # over the mean pressure
    found = norms(whole, np.arctan(traction)).max(axis=0) * np.hypot(1.0, traction)
    assert_allclose(found, expected, rtol=5e-3)
    assert first_yield(whole, 0.3).excess == pytest.approx(expected[4], rel=5e-3)


@pytest.mark.parametrize(
    "bodies", [(0.1, 0.45, 0.3, 0.7), (0.1, 0.3, 0.3, 6.0), (8.0, 0.2, 0.3, 1.2), (8.0, 0.25, 0.3, 20.0), (3.0, 0.0, 0.49, 3.0)]
)
def test_first_yield_by_a_dense_search_of_space(bodies):
    """Film and body on a grid four times as dense and at all angles; nothing of the square forms is used."""
    whole = under_rigid_sphere(*bodies)
    t = whole.thickness
    theta = np.linspace(0.0, math.pi, 13)
    r = np.concatenate([np.sin(np.linspace(0.0, math.pi / 2.0, 81)), np.linspace(1.01, 1.6, 20)])
    for traction in (0.0, 0.2, 0.6, 3.0):
        largest = []
        for part, z in ((whole.in_film, np.linspace(0.0, t, 41)), (whole.in_body, t + np.linspace(0.0, 1.2, 61) ** 1.5)):
            radial = part(r, z)
            mises = [hamilton_field.von_mises(cartesian(radial, np.full(r.size, one), traction)).max() for one in theta]
            largest.append(max(mises))
        found = norms(whole, np.arctan([traction]))[:, 0] * math.hypot(1.0, traction)
        assert_allclose([found[:-1].max(), found[-1]], largest, rtol=1e-2)
        for strength in (0.3, 1.0, 4.0):
            where = first_yield(whole, traction, strength)
            assert where.excess == pytest.approx(max(largest[0] / strength, largest[1]), rel=1e-2)


def test_where_it_yields():
    """A stiff film as wide as the contact is bent and yields where it meets its body, below the axis; a soft strong one leaves
    that to its body; a weak one yields itself; dragged hard, the film's surface does."""
    stiff, soft = under_rigid_sphere(20.0, 0.3, 0.3, 1.0), under_rigid_sphere(0.2, 0.3, 0.3, 4.0)
    assert first_yield(stiff, 0.0).where == "interface"
    assert first_yield(stiff, 0.0).z == pytest.approx(1.0) and first_yield(stiff, 0.0).x == 0.0
    assert first_yield(soft, 0.0, 5.0).where == "body" and first_yield(soft, 0.0, 0.1).where == "film"
    assert first_yield(soft, 2.0) == first_yield(soft, 2.0, 1.0) and first_yield(soft, 2.0).where == "film"
    assert first_yield(soft, 2.0).z == 0.0


def hertz_norms(nu):
    """N of a half-space in the directions of ANGLES, from Hamilton's stresses; the last is all traction, 1e9 of the
    pressure."""
    traction = np.append(np.tan(ANGLES[:-1]), 1e9)
    return np.array([1.5 / hamilton_field.first_yield(one, nu)[0] / math.hypot(1.0, one) for one in traction])


@pytest.mark.parametrize("body", [CoatedBody(0.1, 0.3, 0.3), CoatedBody(5.0, 0.1, 0.45), CoatedBody(40.0, 0.3, 0.25)])
def test_table_of_norms(body):
    """At radii between those that are solved: kinks, where another place becomes the worst, are within 3 %, the rest is far
    nearer."""
    pair = (Layer.of(1.0, body.ratio, body.nu, body.nu_below),)
    table = table_of_norms(pair, (body,))
    off = []
    for place in (9, 40, 60, 73, 87, 90, 111, 128, 141, 150):
        radius = ((1.0 + PLACES[place]) / (1.0 - PLACES[place])) ** 2
        *film, below = norms(Stresses(pair, body, radius), ANGLES)
        found = np.exp(table[:, place])
        off.append([found[0] / np.max(film, axis=0) - 1.0, found[1] / (1.0 + radius**-2.0) / below - 1.0])
    assert np.abs(off).max() < 0.03 and np.abs(off).mean() < 2e-3
    assert_allclose(np.exp(table[1, -1]), hertz_norms(body.nu_below), rtol=5e-3)
    assert_allclose(np.exp(table[0, 0]), hertz_norms(body.nu), rtol=5e-3)


@pytest.mark.parametrize(("bodies", "films"), [("first", 1), ("both", 2)])
def test_contact_radius_over_the_thickness_of_one_film(bodies, films):
    """Of an asperity pressed by w, a = (R w)^(1/2): its root over that of t_1 goes as the fourth root of the area, w/sigma."""
    sigma, radius, thickness, w = 5e-8, 4e-5, 3e-7, 2e-8
    rough = {"asperity_height_deviation": sigma, "asperity_radius": radius, "asperity_density": 1e10}
    coating = {"material": "silver", "thickness": thickness, "bodies": bodies}
    coated = st.Contact(first="iron", second="iron", roughness=rough, coating=coating, nominal_area=1e-6)
    given = coated.indices()
    found = per_root(groups(**FILM | {"film_aspect": given.film_aspect, "films": given.films}))
    assert found * (w / sigma) ** 0.25 == pytest.approx(math.sqrt(math.sqrt(radius * w) / (thickness / films)), rel=1e-12)


def test_a_soft_film_much_thinner_than_the_contact_is_pressed_alike_all_through():
    """Without traction, between the two widest contacts that are solved: there the table is smooth, as the film is stressed
    inside, at its last depth and, nearly, on its surface as where it has no thickness."""
    body, place = CoatedBody(0.1, 0.3, 0.3), 151
    pair = (Layer.of(1.0, body.ratio, body.nu, body.nu_below),)
    radius = ((1.0 + PLACES[place]) / (1.0 - PLACES[place])) ** 2
    surface, _, inside, last, _ = norms(Stresses(pair, body, radius), ANGLES[:1])[:, 0]
    assert surface == pytest.approx(last, rel=2e-3) and inside == pytest.approx(last, rel=1e-4)
    assert math.exp(table_of_norms(pair, (body,))[0, place, 0]) == pytest.approx(last, rel=5e-4)


def test_tangential_stiffness():
    """Another basis of tractions, whose waves were solved one by one."""
    rows = read("layered_shear.csv")
    given = groups(
        **FILM
        | {"n_E": column(rows, "ratio"), "film_nu": column(rows, "nu"), "layer_nu": column(rows, "nu")}
        | {"nu": column(rows, "nu_below"), "coated_nu": column(rows, "nu_below"), "film_K_beta": 1.0}
    )
    different, which = bodies_of(given.resolved())
    for row, at in zip(rows, which, strict=True):
        found = shear_compliance(different[at], float(row["radius"]))[0]
        assert found == pytest.approx(float(row["K_beta"]), rel=2e-5)


def test_curve_of_the_tangential_stiffness():
    """Against solutions between its own radii, with slopes; ends by hand: 8/3 (2 - nu)/(1 - nu) of each material."""
    n_E, share, nu, below, counter = 3.0, 0.8, 0.2, 0.4, 0.1
    given = groups(**FILM | {"n_E": n_E, "nu": below, "film_nu": nu, "layer_nu": nu, "coated_share": share},
                   coated_nu=below, counter_nu=counter).resolved()  # fmt: skip
    (bodies,), _ = bodies_of(given)

    def one(nu):
        return 8.0 / 3.0 * (2.0 - nu) / (1.0 - nu)

    film_share = 1.0 / n_E - (1.0 - share)  # of the film itself in the compliance, over that of the bodies without it
    film, without = shear_ends(bodies)
    assert film == pytest.approx(film_share * one(nu) + (1.0 - share) * one(counter), rel=1e-12)
    assert without == pytest.approx(share * one(below) + (1.0 - share) * one(counter), rel=1e-12)
    for radius in (0.013, 0.3, 1.7, 33.0, 400.0):
        z, step = (math.sqrt(radius) - 1.0) / (math.sqrt(radius) + 1.0), 1e-4
        beta, slope = shear_compliance(bodies, radius)
        between = (1.0 - z * z) * np.polynomial.polynomial.polyval(z, shear_curve(bodies))
        assert math.log(beta) == pytest.approx(
            0.5 * ((1.0 - z) * math.log(film) + (1.0 + z) * math.log(without)) + between, abs=1e-4
        )
        wide, narrow = (shear_compliance(bodies, radius * factor)[0] for factor in (1.0 + step, 1.0 - step))
        assert slope == pytest.approx(math.log(wide / narrow) / (2.0 * step), abs=1e-5)


@pytest.mark.parametrize(("n_E", "nu", "below", "within"), [(8.0, 0.2, 0.3, 1.2e-3), (0.05, 0.3, 0.2, 3e-4)])
def test_curves_of_the_trailing_edge(n_E, nu, below, within):
    """Von Mises of a sphere that is pressed and dragged, against solutions between the radii of the curves; beyond these,
    where nothing was solved, they stay near."""
    given = groups(**FILM | {"n_E": n_E, "nu": below, "film_nu": nu, "layer_nu": nu, "coated_share": 0.9},
                   coated_nu=below, counter_nu=0.1).resolved()  # fmt: skip
    (bodies,), _ = bodies_of(given)
    ends, rest = np.split(edge_curves(bodies), [2], axis=1)
    for radius in (0.0003, 0.0025, 0.013, 0.11, 0.3, 1.7, 33.0, 150.0, 400.0, 2000.0):
        z = (math.sqrt(radius) - 1.0) / (math.sqrt(radius) + 1.0)
        between = np.polynomial.polynomial.polyval(z, rest.T)
        lnD, A, B = ends @ [(1.0 - z) / 2.0, (1.0 + z) / 2.0] + (1.0 - z * z) * between
        radial = Stresses(bodies.pair, bodies.coated[0], radius, 12.0).in_film(np.array([1.0]), np.array([0.0]))
        for traction in (0.0, 0.3, 1.0, 10.0):
            six = cartesian(radial, np.array([math.pi]), traction)
            solved = float(hamilton_field.von_mises(tuple(one[0, 0] for one in six)))
            D, share = math.exp(lnD), 0.04 if radius > 200.0 else within
            found = D * (A + 2.0 * B * traction + traction**2)
            assert found == pytest.approx(solved**2, abs=share * D * (1.0 + traction) ** 2)


@pytest.mark.parametrize(
    ("bodies", "traction"), [((1.0, 0.3, 0.3, 1.0), 0.5), ((0.2, 0.4, 0.3, 2.0), 0.6), ((8.0, 0.2, 0.3, 3.0), 0.2)]
)
def test_it_yields_on_the_side_that_it_says(bodies, traction):
    """Of the two places at this depth and radius, ahead of the axis and behind it, the one where more is stressed."""
    whole = under_rigid_sphere(*bodies)
    found = first_yield(whole, traction)
    radius, depth = np.array([abs(found.x)]), np.array([found.z])
    sides = whole.in_body(radius, depth) if found.where == "body" else whole.in_film(radius, depth)

    def mises(theta):
        x, y, z, xy, yz, xz = (one.item() for one in cartesian(sides, np.array([theta]), traction))
        return math.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3.0 * (xy**2 + yz**2 + xz**2))

    here, there = (mises(angle) for angle in ((0.0, math.pi) if found.x > 0.0 else (math.pi, 0.0)))
    assert abs(found.x) > 0.1 and here > 1.005 * there


@pytest.mark.parametrize(("bodies", "traction"), [((8.0, 0.2, 0.3, 3.0), 1.0), ((0.2, 0.4, 0.3, 1.0), 2.0)])
def test_tension_on_the_interface_is_the_largest_all_around(bodies, traction):
    whole = under_rigid_sphere(*bodies)
    r = np.linspace(0.0, 3.0 * max(1.0, whole.thickness), 200)
    radial = whole.in_film(r, np.array([whole.thickness]))
    around = [cartesian(radial, np.array([angle]), traction)[2].max() for angle in np.linspace(0.0, math.pi, 9)]
    assert max(around) > 1e-3
    assert at_interface(whole, traction)[0] == pytest.approx(max(around), rel=0.01)
