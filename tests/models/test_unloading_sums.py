"""Rough surfaces that were pressed together and are drawn apart: against integrals over heights written here, and in principle.

The laws of one asperity are written anew below, from their sources' equations in the units of docs/theory.md.
"""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad
from scipy.optimize import brentq

import stiction as st
from refusals import refusal
from stiction.quantities.errors import InputError
from stiction.records.registry import AsperityLaw, of_kind

THETA, LAM, NU, HARDNESS_TO_YIELD = 40.0, 3.0, 0.3, 2.8
GROUPS = {"theta": THETA, "lam": LAM, "nu": NU, "sharpness": 0.01, "tabor_parameter": 6.0, "shear_strength": 0.1}
INDICES = st.Indices(**GROUPS, pressure_coefficient=0.05)
DISTANCES = [0.0, 0.001, 0.03, 0.1, 0.25, 0.3, 0.5, 0.8]
ELASTIC = ("hertz", "jkr", "dmt", "maugis_1992")
FLATTENED = (
    "brizmer_kligerman_etsion_2006",
    "chang_etsion_bogy_1987",
    "jackson_green_2005",
    "kogut_etsion_2002",
    "zhao_maietta_chang_2000",
)
KNOWN = (*ELASTIC, *FLATTENED, "thornton_ning_1998")


def unload(asperity, contact=INDICES, **more):
    turn = {} if "max_load" in more else {"min_separation": 0.3}
    return st.unload(contact, asperity=asperity, **turn | more)


def solve(asperity, contact=INDICES, **more):
    return st.solve(contact, asperity=asperity, **{"model": "greenwood_williamson_1966", "tangential": "none"} | more)


def phi(z):
    return math.exp(-z * z / 2.0) / math.sqrt(2.0 * math.pi)


def eta(lam):
    """pi H sqrt(R/sigma)/K from theta and lambda."""
    return math.sqrt(math.pi) * (18.0 * lam) ** 0.25 / math.sqrt(THETA)


class Flattened:
    """Chang, Etsion and Bogy's asperity, known by the interference w that it was pressed to, let go as a flattened sphere."""

    def __init__(self, lam):
        self.pressure = (0.454 + 0.41 * NU) * eta(lam)
        self.yields = (2.0 / 3.0 * self.pressure) ** 2
        overshoot = brentq(lambda w: self.raw(w), self.yields * (1 + 1e-9), 100.0 * self.yields, xtol=1e-15)
        self.parts = (0.0, self.yields), (self.yields * (1 + 1e-14), overshoot), (overshoot, 9.0)

    def state(self, w):
        if w <= self.yields:
            return w**1.5, w
        return self.pressure * (2.0 * w - self.yields), 2.0 * w - self.yields

    def raw(self, w):
        load, area = self.state(w)
        return w - load / math.sqrt(area)

    def displacement(self, w):
        return w, 1.0

    def recovers(self, w):
        return w - max(self.raw(w), 0.0) if w > self.yields else w

    def after(self, w, distance):
        load, area = self.state(w)
        share = 1.0 - distance / self.recovers(w)
        return (load * share**1.5, area * share) if share > 0.0 else (0.0, 0.0)


class Sticky:
    """Thornton and Ning's asperity, known by its u = (a^2/(R sigma))^(1/4) when it was pressed hardest. JKR's without yield."""

    def __init__(self, lam=math.inf):
        self.S = math.sqrt(6.0 * math.pi / THETA)
        first, self.yields = (2.0 / 3.0 * self.S) ** (1.0 / 3.0), math.inf
        if lam < math.inf:
            self.limit = eta(lam) * 1.6118 / HARDNESS_TO_YIELD  # 1.6118 Y: the largest pressure at first yield, nu = 0.3
            self.limit = eta(lam) * first_yield_pressure() / HARDNESS_TO_YIELD
            self.yields = brentq(lambda u: 3.0 * u**3 - 2.0 * self.limit * u - self.S, 0.1, 100.0, xtol=1e-15)
        middle = min(max(self.yields, first), 2.0)
        self.parts = (first, middle), (middle * (1 + 1e-15), 2.0)

    def displacement(self, u):
        return u**4 - 2.0 / 3.0 * self.S * u, 4.0 * u**3 - 2.0 / 3.0 * self.S

    def turned(self, u):
        """R_p/R and the residual displacement."""
        load = u**6 - self.S * u**3
        if u > self.yields:
            load = self.yields**6 - self.S * self.yields**2 * u + self.limit * (u**4 - self.yields**4)
        radius = u**6 / (load + self.S * u**3)
        return radius, u**4 * (1.0 - 1.0 / radius)

    def let_go(self, v, u):
        """Displacement at u = v on the way back."""
        radius, stays = self.turned(u)
        return stays + v**4 / radius - 2.0 / 3.0 * self.S * v

    def lost(self, u):
        return (self.S * self.turned(u)[0] / 6.0) ** (1.0 / 3.0)

    def recovers(self, u):
        return self.displacement(u)[0] - self.let_go(self.lost(u), u)

    def after(self, u, distance):
        if self.recovers(u) <= distance:
            return 0.0, 0.0
        w = self.displacement(u)[0] - distance
        v = brentq(lambda v: self.let_go(v, u) - w, self.lost(u), 3.0 * u, xtol=1e-15, rtol=1e-14)
        return v**6 / self.turned(u)[0] - self.S * v**3, v**4


def first_yield_pressure():
    """Largest pressure of a Hertz contact over the yield stress where von Mises' stress on the axis first reaches that."""

    def stress(z):
        return abs((1.0 + NU) * (1.0 - z * math.atan(1.0 / z)) - 1.5 / (1.0 + z * z))

    return 1.0 / max(stress(z) for z in np.linspace(0.47, 0.50, 100001))


def held(law, nearest, distance):
    """Load and area at nearest + distance, over the heights of what had touched."""
    total = np.zeros(2)
    for low, high in law.parts:
        if law.recovers(high) <= distance:
            continue
        start = low
        if low == 0.0:  # of an elastic part
            start = distance
        elif law.recovers(low) < distance:
            start = brentq(lambda p: law.recovers(p) - distance, low, high, xtol=1e-16, rtol=1e-14)
        nodes, weights = np.polynomial.legendre.leggauss(200)
        near = low - min(low, max(law.recovers(start) - distance, 0.0)) if start == low else start
        ends = math.sqrt(start - near), math.sqrt(high - near)  # the square root of what is left of an asperity is smooth
        for t, weight in zip(nodes, weights, strict=True):
            root = (ends[0] + ends[1]) / 2.0 + t * (ends[1] - ends[0]) / 2.0
            p = near + root * root
            w, slope = law.displacement(p)
            factor = weight * (ends[1] - ends[0]) / 2.0 * 2.0 * root * slope * phi(nearest + w)
            total += factor * np.array(law.after(p, distance))
    return total


@pytest.mark.parametrize("lam", (3.0, 100.0))
@pytest.mark.parametrize(("asperity", "law"), (("chang_etsion_bogy_1987", Flattened), ("thornton_ning_1998", Sticky)))
def test_sum_over_heights(asperity, law, lam):
    found = unload(asperity, st.Indices(**GROUPS | {"lam": lam}), separation_increase=DISTANCES)
    expected = np.array([held(law(lam), 0.3, distance) for distance in DISTANCES])
    assert_allclose(found["load"], expected[:, 0], rtol=1e-8)
    assert_allclose(found["contact_area"], expected[:, 1], rtol=1e-8)


def test_sum_over_heights_of_what_had_touched():
    """JKR: what had not touched at the nearest separation does not hold on."""
    found = unload("jkr", separation_increase=DISTANCES, min_separation=1.0)
    expected = np.array([held(Sticky(), 1.0, distance) for distance in DISTANCES])
    assert_allclose(found["load"], expected[:, 0], rtol=1e-8)
    assert_allclose(found["contact_area"], expected[:, 1], rtol=1e-8)


@pytest.mark.parametrize("asperity", KNOWN)
def test_begins_where_loading_ends(asperity):
    pressed = solve(asperity, separation=[0.0, 1.5], tangential="briscoe_tabor_1978")
    found = unload(asperity, min_separation=[0.0, 1.5], separation_increase=0.0, tangential="briscoe_tabor_1978")
    assert set(pressed) - set(found) == {"pull_off_separation"} - set(found)
    for name in set(pressed) - {"pull_off_force", "pull_off_separation"}:
        assert_allclose(found[name].values, pressed[name].values, rtol=1e-10, err_msg=name)
    at = solve(asperity, load=pressed["load"].values)["mean_separation"]
    by_load = unload(asperity, max_load=pressed["load"].values, separation_increase=0.0)
    assert_array_equal(by_load["load"], pressed["load"])  # as it was asked for, to the last digit
    assert_allclose(by_load["min_separation"], at, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("asperity", ("hertz", "dmt"))
def test_elastic_surface_returns_on_itself(asperity):
    separations = [0.3, 0.5, 1.0, 2.5]
    found, pressed = unload(asperity, separation=separations), solve(asperity, separation=separations)
    for name in ("load", "contact_area", "touching_asperities"):
        assert_allclose(found[name], pressed[name], rtol=1e-12)
    assert_allclose(found["mean_separation"], separations)


@pytest.mark.parametrize("asperity", ("jkr", "maugis_1992"))
def test_what_adheres_holds_on_if_it_had_touched(asperity):
    """Pressed far beyond all heights it comes back on the branch of unloading; pressed less, it holds less."""
    adhesive = st.Indices(**GROUPS | {"theta": 1.0})
    apart = {"separation": [0.5, 1.5, 2.5]}
    pressed, branch = (solve(asperity, adhesive, branch=branch, **apart) for branch in ("loading", "unloading"))
    found = unload(asperity, adhesive, min_separation=-9.0, **apart)
    assert_allclose(found["load"], branch["load"], rtol=1e-10)
    assert_allclose(found["pull_off_force"], branch["pull_off_force"], rtol=1e-9)
    assert_allclose(found["pull_off_separation"], branch["pull_off_separation"], rtol=1e-5)
    some = unload(asperity, adhesive, min_separation=0.5, **apart)["contact_area"]
    assert pressed["contact_area"][1] < some[1] < found["contact_area"][1]
    assert some[2] == pytest.approx(float(found["contact_area"][2]))  # all that can still hold had touched
    assert found.attrs["branch"] == "unloading"


def work(asperity, **more):
    """Int P dh from the nearest separation, 0.3, to where nothing touches: of loading, and given back."""
    h, weights = np.polynomial.legendre.leggauss(120)
    h, weights = 0.3 + 4.5 * (h + 1.0), 4.5 * weights
    spent, back = solve(asperity, separation=h), unload(asperity, separation=h)
    return float(weights @ spent["load"].values), float(weights @ back["load"].values)


def test_energy():
    """What yields gives back less than was spent (the law of Zhao, Maietta & Chang has no jump); what does not, all of it."""
    spent, back = work("zhao_maietta_chang_2000")
    assert 0.0 < back < 0.9 * spent
    spent, back = work("hertz")
    assert back == pytest.approx(spent, rel=1e-12)
    spent, back = work("thornton_ning_1998")
    assert back < spent


@pytest.mark.parametrize("asperity", FLATTENED)
def test_the_load_falls_and_nothing_pulls(asperity):
    found = unload(asperity, separation_increase=[0.0, 0.01, 0.1, 0.5, 2.0], tangential="bowden_tabor_1943")
    assert np.all(np.diff(found["load"]) < 0.0) and np.all(found["load"] >= 0.0)
    assert np.all(np.diff(found["contact_area"]) < 0.0)
    assert found["pull_off_force"] == 0.0 and "zero_load_separation" not in found
    # Flatter than Hertz's sphere, of more area under the same load.
    pressed = solve(asperity, load=float(found["load"][3]))
    assert found["contact_area"][3] > 1.2 * pressed["contact_area"]
    assert_allclose(found["friction_force"], 0.1 * eta(LAM) * found["contact_area"], rtol=1e-12)


def test_flattened_asperities_stick_better():
    """Thornton & Ning: the deeper they were pressed, the flatter they are and the more they hold; the load vanishes on the way,
    before the largest tension; and elastic ones hold far less."""
    depths = [1.0, 0.5, 0.0, -0.5]
    found = unload("thornton_ning_1998", min_separation=depths, separation_increase=0.0)
    assert np.all(np.diff(found["pull_off_force"]) > 0.0)
    zero, largest = found["zero_load_separation"], found["pull_off_separation"]
    assert np.all(depths < zero) and np.all(zero < largest)
    load = [
        float(unload("thornton_ning_1998", min_separation=h, separation=z)["load"]) for h, z in zip(depths, zero, strict=True)
    ]
    assert_allclose(load, 0.0, atol=1e-9)
    for h, z, tension in zip(depths, largest, found["pull_off_force"], strict=True):
        near = unload("thornton_ning_1998", min_separation=h, separation=float(z) + np.array([-0.01, 0.0, 0.01]))["load"]
        assert near[1] == pytest.approx(-float(tension), rel=1e-9) and near[1] < near[0] and near[1] < near[2]
    assert np.all(
        found["pull_off_force"] > 100.0 * unload("jkr", min_separation=depths, separation_increase=0.0)["pull_off_force"]
    )


def test_where_there_is_no_tension_it_is_nowhere():
    found = unload("thornton_ning_1998", st.Indices(theta=1e3, lam=1e30), separation_increase=0.0)
    assert found["pull_off_force"] == 0.0
    for name in ("pull_off_separation", "zero_load_separation"):
        assert np.isnan(found[name]) and "NaN if" in found[name].attrs["comment"]


def test_yield_that_is_never_reached_leaves_jkr():
    hard = st.Indices(**GROUPS | {"lam": 1e30})
    found, elastic = (unload(key, hard, separation_increase=DISTANCES) for key in ("thornton_ning_1998", "jkr"))
    assert_allclose(found["load"], elastic["load"], rtol=1e-12)


def contact(**changes):
    surface = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    given = {"nominal_area": "1 mm^2", "work_of_adhesion": "0.1 J/m^2", "roughness": st.Roughness(**surface)}
    return st.Contact(first="silver", second="iron", **given | changes)


def test_of_a_contact_in_si():
    energies = st.axis("work_of_adhesion", [0.05, 0.5])
    pair = contact(work_of_adhesion=energies)
    apart = ["0 nm", "1 nm", "20 nm"]
    found = st.unload(pair, max_load=["1 N", "100 N"], separation_increase=apart, asperity="thornton_ning_1998")
    assert found["load"].dims == ("work_of_adhesion", "max_load", "separation_increase")
    assert found["pull_off_force"].dims == ("work_of_adhesion", "max_load")
    assert_allclose(found["load"].isel(separation_increase=0), [[1.0, 100.0]] * 2, rtol=1e-9)
    assert_allclose(found["separation_increase"], [0.0, 1e-9, 20e-9])
    assert found["min_separation"].attrs["units"] == found["separation_increase"].attrs["units"] == "m"
    assert found["max_load"].attrs["units"] == found["pull_off_force"].attrs["units"] == "N"
    one = pair.indices()
    scales = pair.scales()
    unit = scales.load * scales.asperities
    for i in range(2):
        same = st.unload(
            st.Indices(theta=float(one.theta[i]), lam=float(one.lam[i]), nu=one.nu, hardness_to_yield=one.hardness_to_yield),
            min_separation=float(found["min_separation"][i, 1] / scales.separation),
            separation_increase=20e-9 / scales.separation,
            asperity="thornton_ning_1998",
        )
        assert found["load"][i, 1, 2] == pytest.approx(float(same["load"] * unit), rel=1e-7)
        assert found["pull_off_force"][i, 1] == pytest.approx(float(same["pull_off_force"] * unit), rel=1e-7)
    assert found.attrs["unloading"] == "by the unloading law of thornton_ning_1998" and found.attrs["grade"] == "B"


def test_given_back_as_it_was_found():
    """A separation found from a load is not refused for its rounding."""
    pair = contact()
    nearest = st.unload(pair, max_load="3 N", separation_increase="0 nm")["min_separation"]
    assert st.unload(pair, max_load="3 N", separation=float(nearest))["load"] == pytest.approx(3.0)


def test_other_heights():
    """Exponential heights: those above 0.3 are as those above 1, but for their number."""
    found = unload("kogut_etsion_2002", min_separation=[0.3, 1.0], separation_increase=[0.0, 0.1, 0.4], heights="exponential")
    assert_allclose(found["load"][1] / found["load"][0], math.exp(-0.7), rtol=1e-9)


REFUSED = {
    "yields and adheres": ({"asperity": "roy_chowdhury_ghosh_1994"}, ("asperity", "roy_chowdhury_ghosh_1994")),
    "friction of asperities": (
        {"asperity": "kogut_etsion_2002", "tangential": "kogut_etsion_2003"},
        ("tangential", "kogut_etsion_2003"),
    ),
    "own regimes": ({"model": "soft_coating_2015"}, ("model", "soft_coating_2015")),
    "closed form": ({"model": "bush_gibson_thomas_1975"}, ("model", "bush_gibson_thomas_1975")),
    "branch": ({"asperity": "jkr", "branch": "loading"}, ("branch", "loading")),
    "film law": ({"film": "soft_coating_2015"}, ("film", "soft_coating_2015")),
    "nearer": ({"separation": [0.5, 0.2], "separation_increase": None}, ("separation", "0.2", "0.3")),
    "negative": ({"separation_increase": -0.1}, ("separation_increase", "-0.1", "0")),
    "no distance": ({"separation_increase": None}, ("separation and separation_increase",)),
    "two turns": ({"max_load": 0.1}, ("min_separation and max_load",)),
    "no number": ({"separation_increase": math.inf}, ("separation_increase", "inf")),
    "too far": ({"separation_increase": 1e7}, ("separation_increase", "1e+06")),
    "too near": ({"min_separation": -1e7}, ("min_separation", "1e+06")),
    "load nowhere carried": ({"min_separation": None, "max_load": -0.1}, ("load", "-0.1", "0")),
    "no load": ({"min_separation": None, "max_load": 0.0}, ("load", "0")),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refusals(case):
    changes, expected = REFUSED[case]
    with refusal(*expected):
        st.unload(INDICES, **{"min_separation": 0.3, "separation_increase": 0.1} | changes)


def test_refused_with_a_film():
    film = st.Coating(material={"preset": "silver", "hardness": "0.4 GPa"}, thickness="200 nm", bodies="first")
    for coated in (st.Indices(theta=40.0, lam=3.0, n_E=1.0, n_H=0.5, tau=2.0), contact(coating=film)):
        with refusal("contact"):
            st.unload(coated, min_separation=0.0, separation_increase=0.0)


def test_every_asperity_law_is_known_or_refused():
    groups = INDICES.resolved()
    for key, record in of_kind(AsperityLaw).items():
        if not all(groups.has(name) for name in record.needs):
            assert key not in KNOWN
            continue
        try:
            assert np.all(np.isfinite(unload(key, separation_increase=[0.0, 0.2])["load"]))
        except InputError as error:
            assert "an unloading law" in str(error) and "no adhesion" not in record.traits and key not in KNOWN


def test_energy_given_back_is_that_of_the_asperities():
    """The load over the distance, integrated, is what each asperity gives back, 0.4 P_max times what it recovers."""
    law = Flattened(LAM)

    def stored(w):
        return 0.4 * law.state(w)[0] * law.recovers(w) * phi(0.3 + w)

    expected = sum(quad(stored, low, high, epsabs=1e-14, epsrel=1e-11)[0] for low, high in law.parts)
    t, weights = np.polynomial.legendre.leggauss(300)
    distance, weights = 2.0 * (t + 1.0), 2.0 * weights
    found = unload("chang_etsion_bogy_1987", separation_increase=distance)["load"].values @ weights
    assert found == pytest.approx(expected, rel=1e-6)


def test_a_largest_load_of_nothing():
    """Where nothing is drawn apart yet the load is the one that was asked for, not what a search made of it."""
    found = unload("jkr", max_load=[0.0, 0.01], separation_increase=[0.0, 0.1], tangential="bowden_tabor_1943")
    assert list(found["load"][:, 0]) == [0.0, 0.01]
    assert np.isnan(found["friction_coefficient"][0, 0]) and found["friction_coefficient"][1, 0] > 0.0
    assert found["friction_force"][0, 0] > 0.0 and found["load"][0, 1] < 0.0


def test_a_theory_of_the_surface_is_pressed_and_drawn_apart_on_it():
    """With both asperities found and those of the moments, a model of moments takes the latter all the way."""
    found = {"asperity_height_deviation": "20 nm", "asperity_radius": "5 um", "asperity_density": "1e11 1/m^2"}
    surface = {"asperity_height_deviation": "30 nm", "asperity_radius": "1 um", "asperity_density": "3e11 1/m^2"}
    bodies = {"first": "copper", "second": "hardened_steel_52100", "work_of_adhesion": "0.01 J/m^2", "nominal_area": "1 mm^2"}
    both, alone = (
        st.unload(
            st.Contact(roughness=st.Roughness(**one), **bodies),
            max_load="1 N", separation_increase=["0 nm", "5 nm"], model="mccool_1986",
        )
        for one in (found | {"surface": surface}, surface)
    )  # fmt: skip
    for name in ("load", "contact_area", "min_separation", "mean_separation"):
        assert_allclose(both[name], alone[name], rtol=1e-12, err_msg=name)
