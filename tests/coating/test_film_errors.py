"""What was measured of film laws: the tables against closed forms of the laws on the independent table of the exact sphere, and
against numbers that others found; and what stands of it beside results."""

import importlib
import json
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import stiction as st
from stiction.contact.contact import Contact
from stiction.records.registry import FilmLaw, of_kind
from stiction.solving.accuracy import film_tables
from stiction.solving.accuracy.film_errors import in_words
from stiction.solving.accuracy.film_tables import on_a_sphere, on_maps, summary
from tables import column, read

TRUTH = Path(__file__).parents[2] / "truth"
PLAIN = "greenwood_williamson_1966"
# Films that flow: nothing elastic is in them.
FLOW = {"chang_1997", "dayson_1971", "kato_1981", "liu_neville_reuben_2002", "ravindran_ramasamy_laddha_1980"}
WIDTHS = np.array([0.1, 0.5, 1.0, 2.0, 5.0, 20.0])


def at(law, n_E, width, options=None, ratio=1e-3):
    n_E, width = np.broadcast_arrays(np.asarray(n_E, dtype=float), np.asarray(width, dtype=float))
    return on_a_sphere(law, options or {}, n_E, width, np.full(n_E.shape, ratio))


def exact_rows():
    """One film on a rigidly pressed body, nu = 0.3: modulus, a/t, E_P over the film's and D, of the independent table."""
    rows = [row for row in read("layered.csv") if float(row["share"]) == 1.0 and row["nu"] == row["nu_below"] == "0.3"]
    rows = [row for row in rows if float(row["ratio"]) in (0.1, 0.5, 2.0, 10.0)]
    assert len(rows) == 24
    return (column(rows, name) for name in ("ratio", "radius", "load", "approach"))


def test_laws_whose_errors_are_in_closed_form():
    """Half-spaces carry E a^3 4/(3R) at a^2/R. The body alone (ogilvy_1993): area (E_P/E_s)^(2/3), load D^(3/2)/(E_P/E_s) of
    what it should be; the film alone (sequential, while it is not pressed through): E_f in place of E_s."""
    n_E, width, load, approach = exact_rows()
    for law, modulus in (("ogilvy_1993", n_E * load), ("sequential", load)):
        found = at(law, n_E, width)
        pressed = 1e-3 * width**2 * np.maximum(modulus ** (2 / 3), approach)  # over the thickness
        alone = (pressed < 1.0) | (law == "ogilvy_1993")
        assert alone.sum() >= 23
        assert_allclose(found.area[alone], modulus[alone] ** (2 / 3), rtol=2e-3)
        assert_allclose(found.load[alone], (approach**1.5 / modulus)[alone], rtol=2e-3)
    found = at("layered", n_E, width)
    assert_allclose(np.array(found), 1.0, atol=3e-3)


# Per cent, area at given load and load at given approach at WIDTHS, as found independently of this project's tables.
OTHERS = {
    ("sequential", "", 0.1): ((0, 3, 14, 43, 107, 183), (-8, -33, -53, -69, -82, -88)),
    ("sequential", "", 2.0): ((0, -2, -8, -19, -28, -34), (7, 34, 57, 77, 90, 97)),
    ("sequential", "", 10.0): ((0, -8, -29, -53, -68, -75), (50, 279, 488, 665, 790, 855)),
    ("graded", "", 0.1): ((-27, -53, -60, -59, -50, -28), (55, 155, 159, 117, 56, 14)),
    ("graded", "", 10.0): ((5, 21, 14, -7, -17, -11), (38, 121, 138, 130, 90, 35)),
    ("halling_1979", "perriot_barthel_2004", 0.1): ((-3, -16, -22, -25, -27, -21), (-3, -10, -18, -23, -16, 0)),
    ("halling_1979", "perriot_barthel_2004", 10.0): ((39, 180, 161, 91, 40, 13), (-7, -24, -15, -7, -4, -3)),
}


@pytest.mark.parametrize(("law", "modulus", "n_E"), OTHERS)
def test_errors_that_others_found(law, modulus, n_E):
    found = at(law, n_E, WIDTHS, {"modulus": modulus})
    area, load = OTHERS[law, modulus, n_E]
    assert_allclose(100.0 * (found.area - 1.0), area, atol=0.8)
    assert_allclose(100.0 * (found.load - 1.0), load, atol=1.2)


def test_between_and_beyond():
    """Exact at the table's places, geometric means halfway, nothing outside; the thickness over the radius counts for one."""
    one, two = at("graded", 2.0, 0.5), at("graded", 5.0, 1.0)
    middle = at("graded", math.sqrt(10.0), math.sqrt(0.5))
    corners = [float(at("graded", n_E, width).area) for n_E in (2.0, 5.0) for width in (0.5, 1.0)]
    assert float(middle.area) == pytest.approx(math.exp(np.log(corners).mean()), rel=1e-9)
    assert float(one.area) != float(two.area)
    outside = at("graded", [0.004, 2.0, 2.0, 120.0, 2.0], [1.0, 0.04, 25.0, 1.0, 0.0])
    assert np.isnan(outside.area).all() and np.isnan(outside.load).all()
    assert at("kato_1981", 1.0, 1.0) is None
    deep, shallow = at("sequential", 0.1, 20.0, ratio=0.1), at("sequential", 0.1, 20.0, ratio=1e-3)
    assert float(shallow.area) > 2.5 and float(deep.area) < 1.0  # pressed through, the body answers
    assert float(at("sequential", 0.1, 20.0, ratio=1e-9).area) == float(shallow.area)
    for law in ("graded", "layered"):
        assert float(at(law, 0.3, 3.0, ratio=0.5).area) == float(at(law, 0.3, 3.0).area)


def test_every_elastic_film_law_is_there():
    elastic = {key for key, one in of_kind(FilmLaw).items() if one.interchangeable} - FLOW
    assert {key for key, _ in film_tables._sphere()} == elastic
    assert {key for key, _ in film_tables._maps()} == elastic | {"rough_on_film"}
    for law in elastic:
        assert summary(law) and st.models([law])[0]["measured_film_error"]
    assert not st.models(["kato_1981"])[0]["measured_film_error"]
    options = {text for key, text in film_tables._sphere() if key == "finkin_1969"}
    assert options == {f"bound {value}" for value in of_kind(FilmLaw)["finkin_1969"].options["bound"]}


def test_on_maps():
    """What is best on maps, what is not; nothing outside."""
    n_E, thickness = np.array([0.2, 8.0, 20.0, 1.5, 1.5]), np.array([1.0, 3.0, 1.0, 0.1, 6.0])
    best = on_maps("rough_on_film", {}, n_E, thickness)
    assert np.isnan(best.rms).tolist() == [False, False, True, True, True]
    for law in ("sequential", "graded", "layered", "ogilvy_1993"):
        other = on_maps(law, {}, n_E[:1], thickness[:1])
        assert other.rms[0] > 2.0 * best.rms[0]
    assert on_maps("dayson_1971", {}, n_E, thickness) is None


def test_a_place_of_the_table_again(monkeypatch):
    """By the script that made it."""
    monkeypatch.syspath_prepend(str(TRUTH))
    made = importlib.import_module("film_laws")
    w = np.geomspace(1e-3, 1e1, 800) * 1e-3
    load, area = made.asperity(made.LAWS["ogilvy_1993", ""], 2.0, math.sqrt(1e-3), 1.0, w)
    assert_allclose(load, w**1.5, rtol=1e-6)  # Hertz
    assert_allclose(area, w, rtol=1e-6)
    density, given, loads = made.as_groups(made.read_films())
    assert density.min() > 0.016 and len(given) == len(loads) == 630
    # NRs and lengths are those of the map: p/(E* h') back from the loads
    assert_allclose(4 / 3 * density * loads / np.sqrt(math.sqrt(3) / 64 / density), made.read_films()["pressure"], rtol=1e-9)


STEEL = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "600 GPa"}
ROUGH = {"asperity_height_deviation": "50 nm", "asperity_radius": "20 um", "asperity_density": "5e10 1/m^2"}


def coated(n_E=0.1, thickness=200e-9, **more):
    film = {"youngs_modulus": 210e9 * n_E, "poissons_ratio": 0.3, "hardness": 600e9}
    coating = {"material": film, "thickness": thickness, "bodies": "first"}
    rigid = STEEL | {"youngs_modulus": 1e17}
    return Contact(first=STEEL, second=rigid, roughness=ROUGH, nominal_area="1 mm^2", coating=coating, **more)


@pytest.mark.parametrize("film", ["sequential", "graded", "halling_1979"])
def test_beside_a_result(film):
    """Near the radius of the mean contact, by hand from area and number; nothing beside a bare contact."""
    more = {"work_of_adhesion": 1e-9} if film == "graded" else {}
    model = "soft_coating_2015" if film == "graded" else PLAIN
    found = st.solve(coated(**more), load=["10 mN", "1 N"], model=model, film=film)
    radius = np.sqrt(found["contact_area"].values / (math.pi * found["touching_asperities"].values))
    sphere, maps = json.loads(found.attrs["measured_film_error"])
    assert sphere["law"] == maps["law"] == film
    assert_allclose(sphere["near"]["a_over_t"], [radius.min() / 200e-9, radius.max() / 200e-9], rtol=1e-9)
    assert_allclose(sphere["near"]["n_E"], 0.1, rtol=1e-4)
    expected = at(film, 0.1, radius / 200e-9, {"modulus": "gao_chiu_lee_1992"}, ratio=0.01)
    assert_allclose(sphere["error"], [expected.area.min() - 1.0, expected.area.max() - 1.0], rtol=1e-3)
    assert_allclose(sphere["load_error"], [expected.load.min() - 1.0, expected.load.max() - 1.0], rtol=1e-3)
    said = in_words(sphere)
    assert f"{film} against exact sphere" in said and "% at given load" in said and "a_over_t = " in said
    bare = st.solve(coated().replace(coating=None), load="1 N", model=PLAIN)
    assert bare.attrs["measured_film_error"] == "[]"


def test_an_area_law_has_the_same_error_by_film_and_by_model():
    found = st.solve(coated(thickness=2e-6), load="1 N", model="rough_on_film")
    (row,) = [one for one in json.loads(found.attrs["measured_film_error"]) if "rms" in one]
    (area,) = json.loads(found.attrs["measured_error"])["area"]
    assert row["error"][0] != 0.0
    assert area == pytest.approx(row["error"][0], rel=0.01)


def test_what_was_not_measured_says_why():
    flows = st.solve(coated(interfacial_shear_strength="10 MPa"), load="1 N", model=PLAIN, film="kato_1981")
    (row,) = json.loads(flows.attrs["measured_film_error"])
    assert "flow" in row["why_not"] and "error" not in row and "flow" in in_words(row)
    stiff = st.solve(coated(n_E=300.0), load="1 N", model=PLAIN, film="halling_1979")
    rows = json.loads(stiff.attrs["measured_film_error"])
    for row, ends in zip(rows, ("0.005 to 100", "0.1 to 10"), strict=True):
        assert "modulus" in row["why_not"] and " 300," in row["why_not"] and f" {ends}" in row["why_not"]
    area = st.solve(coated(n_E=300.0), load="1 N", model="rough_on_film")
    (row,) = json.loads(area.attrs["measured_film_error"])
    assert "0.1 to 10" in row["why_not"]


def test_what_was_measured_at_some_points_only_says_at_which():
    """Contacts that outgrow the table: the error is of the others, and the words say so; of films in the set, nothing more."""
    found = st.solve(coated(thickness=25e-9), load=["1 uN", "1 mN", "100 N"], model=PLAIN, film="halling_1979")
    sphere, maps = json.loads(found.attrs["measured_film_error"])
    assert sphere["near"]["a_over_t"][0] < 20.0 < sphere["near"]["a_over_t"][1]
    assert "of 3 points" in sphere["outside"] and sphere["outside"].endswith("0.05 to 20")
    assert sphere["outside"] in in_words(sphere)
    assert "film thickness" in maps["why_not"]
    inside = st.solve(coated(), load="1 N", model=PLAIN, film="halling_1979")
    assert not any("outside" in row for row in json.loads(inside.attrs["measured_film_error"]))


def test_in_a_comparison():
    data = st.compare(coated(thickness=500e-9, interfacial_shear_strength="100 MPa"), load="0.1 N")
    laws = ("layered", "ogilvy_1993", "rough_on_film")
    rows = {name: json.loads(data["measured_film_error"].sel(model=name).item()) for name in laws}
    assert rows["layered"][0]["error"][1] == pytest.approx(0.0, abs=5e-3)
    assert rows["ogilvy_1993"][0]["error"][1] < -0.2 and rows["rough_on_film"][0]["rms"] < 0.1


# sigma, R and N of maps of validation/maps; kind; modulus, thickness and Poisson's ratio of the film; pressures over E* h';
# areas by the solver of these maps, which shares nothing with the package.
OTHER_KINDS = (
    ((1.378e-8, 7.594e-6, 2.273e11), "lay", (1.847, 1.279e-7, 0.2422), (0.01024, 0.2399), (0.023209, 0.39618)),
    ((1.824e-8, 7.172e-6, 2.166e11), "lay", (2.201, 1.521e-6, 0.2976), (0.01264, 0.3157), (0.017072, 0.31762)),
    ((1.654e-8, 2.077e-6, 1.007e12), "worn", (0.2701, 1.297e-6, 0.3029), (0.002176, 0.01303), (0.06734, 0.28397)),
    ((4.791e-8, 3.046e-6, 4.618e11), "worn", (0.4764, 1.123e-7, 0.3821), (0.009927, 0.08153), (0.15675, 0.28607)),
)


@pytest.mark.parametrize(("numbers", "kind", "film", "pressures", "areas"), OTHER_KINDS)
def test_errors_on_surfaces_with_a_lay_and_worn_ones_hold_areas_of_another_solver(numbers, kind, film, pressures, areas):
    modulus, slope, nominal, hardness = 1e10, 0.08, (20e-6) ** 2, 1e15
    nu = film[2]
    coating = {"youngs_modulus": film[0] * modulus * (1.0 - nu**2), "poissons_ratio": nu, "hardness": hardness}
    sigma, radius, density = numbers
    contact = st.Contact(
        first={"youngs_modulus": 0.91 * modulus, "poissons_ratio": 0.3, "hardness": hardness},
        second={"youngs_modulus": 1e30, "poissons_ratio": 0.3, "hardness": 1e30},
        roughness=st.Roughness(
            asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density, kind=kind
        ),
        coating={"material": coating, "thickness": film[1], "bodies": "first"},
        nominal_area=nominal,
        interfacial_shear_strength=1e3,
    )  # fmt: skip
    loads = [pressure * modulus * slope * nominal for pressure in pressures]
    found = st.solve(contact, load=loads, model="rough_on_film", tangential="none")
    error = json.loads(found.attrs["measured_error"])
    off = np.ravel(found["contact_area"]) / nominal / areas - 1.0
    assert (np.array(error["area_low"]) <= off).all() and (off <= np.array(error["area_high"])).all()
    assert (np.sign(error["area"]) == np.sign(off)).all()  # too large with a lay, too small on plateaus
