"""Contact to dimensionless groups. Reference numbers: theory 1 and 4 worked out by hand (with awk)."""

import math

import numpy as np
import pytest
import xarray
from scipy.integrate import quad
from scipy.optimize import brentq

from refusals import refusal
from stiction.contact.contact import Coating, Contact, Indices
from stiction.contact.materials import Material, material, work_of_adhesion
from stiction.quantities.dimensions import axis
from stiction.quantities.errors import InputError
from stiction.solving.solve import solve
from stiction.surfaces.roughness import Roughness

ROUGHNESS = Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
STEEL = "hardened_steel_52100"


def contact(first="silver", second="silver", **changes):
    given = {"roughness": ROUGHNESS, "work_of_adhesion": "2.5 J/m^2", "nominal_area": "1 mm^2"}
    return Contact(**given | {"first": first, "second": second} | changes)


def test_silver_on_silver():
    soft = material("silver", hardness="0.25 GPa")
    pair = contact(soft, soft)
    groups = pair.indices()
    assert 4 / 3 * pair.contact_modulus == pytest.approx(6.333758159e10, rel=1e-9)
    assert groups.theta == pytest.approx(37.67890924, rel=1e-9)  # known as "about 38"
    assert groups.lam == pytest.approx(0.2050196774, rel=1e-9)  # known as "about 0.2"
    assert groups.nu == 0.37 and groups.hardness_to_yield == 2.8 and not groups.has_film
    assert pair.plasticity_index == pytest.approx(5.887329568, rel=1e-9)
    assert pair.tabor_parameter() == pytest.approx(17.24567745, rel=1e-9)
    assert pair.tabor_parameter("0.6 nm") == pytest.approx(pair.tabor_parameter() / 2, rel=1e-12)


def test_unlike_bodies():
    pair = contact("silver", "iron")
    groups = pair.indices()
    assert pair.contact_modulus == pytest.approx(6.686110327e10, rel=1e-9)
    assert groups.K_beta == pytest.approx(6.742726921, rel=1e-9)
    assert groups.nu == 0.37  # of the softer one, silver, on either side
    assert contact("iron", "silver").indices() == groups


@pytest.mark.parametrize(("nu", "K_beta"), [(0.2, 6.0), (0.25, 6.2222222222), (0.3, 6.4761904762), (0.4, 7.1111111111)])
def test_K_beta_depends_on_poissons_ratio_alone(nu, K_beta):
    body = Material(youngs_modulus="210 GPa", poissons_ratio=nu, hardness="7 GPa")
    assert contact(body, body).indices().K_beta == pytest.approx(K_beta, rel=1e-10)
    rigid = Material(youngs_modulus=210e9 * 1e14, poissons_ratio=nu, hardness="70 GPa")
    assert contact(body, rigid).indices().K_beta == pytest.approx(K_beta, rel=1e-10)
    assert Indices(theta=1, lam=1, nu=nu).resolved().K_beta == pytest.approx(K_beta, rel=1e-10)


def test_hardness_to_yield():
    hard = Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="7 GPa", yield_stress="2 GPa")
    harder = Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="8 GPa", yield_stress="2 GPa")
    assert contact(hard, harder).indices().hardness_to_yield == 3.5
    assert contact(harder, hard).indices().hardness_to_yield == 3.5
    assert contact(hard, "silver").indices().hardness_to_yield == 2.8
    assert contact(hard, harder, hardness_to_yield=3).indices().hardness_to_yield == 3
    wrong = Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="1 GPa", yield_stress="2 GPa")
    with refusal("hardness_to_yield", "0.5", ">= 1"):
        contact(wrong, harder).indices()


def test_hardening_is_that_of_the_softer_body():
    soft = material("silver", tangent_modulus="0.82 GPa")  # E = 82 GPa
    hard = Material(youngs_modulus="210 GPa", poissons_ratio=0.3, hardness="7 GPa", tangent_modulus="2.1 GPa")
    assert contact(soft, hard).indices().hardening == pytest.approx(0.01, rel=1e-14)
    assert contact("iron", soft).indices().hardening == pytest.approx(0.01, rel=1e-14)
    assert contact("silver", hard).indices().hardening is None and contact().indices().hardening is None
    assert contact(soft, "gold", coating={"material": hard, "thickness": "200 nm"}).indices().film().hardening is None
    assert contact(soft, soft, coating={"material": hard, "thickness": "200 nm"}).indices().film().hardening == 0.82 / 82
    with refusal("hardening", "1.5", ">= 0", "< 1"):
        stretched = material("silver", tangent_modulus="123 GPa")
        contact(stretched, stretched).indices()
    with refusal("tangent_modulus", "-1.0", ">= 0 Pa"):
        material("silver", tangent_modulus=-1)


def test_hardening_along_a_sweep():
    """Known only if it is that of the softer body everywhere."""
    body = {"youngs_modulus": "100 GPa", "poissons_ratio": 0.3, "tangent_modulus": "2 GPa"}
    around, below = axis("hardness", ["1 GPa", "3 GPa"]), axis("hardness", ["1 GPa", "1.5 GPa"])
    unknown = Material(youngs_modulus="200 GPa", poissons_ratio=0.3, hardness="2 GPa")
    other = Material(youngs_modulus="200 GPa", poissons_ratio=0.3, hardness="2 GPa", tangent_modulus="1 GPa")
    assert contact(Material(hardness=below, **body), unknown).indices().hardening == 0.02
    assert contact(unknown, Material(hardness=below, **body)).indices().hardening == 0.02
    assert contact(Material(hardness=around, **body), unknown).indices().hardening is None
    assert contact(unknown, Material(hardness=around, **body)).indices().hardening is None
    assert np.array_equal(contact(Material(hardness=around, **body), other).indices().hardening, [0.02, 0.005])


def test_film_on_equal_bodies_has_the_papers_ratios():
    substrate = Material(youngs_modulus="200 GPa", poissons_ratio=0.3, hardness="5 GPa")
    film = Material(youngs_modulus="100 GPa", poissons_ratio=0.3, hardness="4 GPa")
    coated = contact(substrate, substrate, coating=Coating(material=film, thickness="240 nm"))
    groups = coated.indices()
    assert groups.n_E == pytest.approx(0.5, rel=1e-15)  # E_c/E_s
    assert (groups.n_H, groups.n_g, groups.film_nu) == (0.8, 1.0, 0.3)
    assert groups.tau == pytest.approx(5, rel=1e-15)
    assert groups.film_K_beta == pytest.approx(groups.K_beta, rel=1e-15)
    film_alone = contact(film, film).indices()  # theta_c and lambda_c are those of film against film
    assert groups.film().theta == pytest.approx(film_alone.theta, rel=1e-14)
    assert groups.film().lam == pytest.approx(film_alone.lam, rel=1e-14)
    assert groups.substrate() == contact(substrate, substrate).indices()


def test_film_on_one_body():
    film = {"preset": "silver", "hardness": "0.4 GPa"}
    groups = [
        contact(STEEL, STEEL, coating={"material": film, "thickness": "200 nm", "bodies": body}).indices()
        for body in ("first", "second")
    ]
    assert groups[0] == groups[1]
    assert groups[0].n_E == pytest.approx(0.5832626597, rel=1e-9)
    assert groups[0].n_H == pytest.approx(0.4e9 / material("hardened_steel_52100").hardness, rel=1e-14)
    assert groups[0].tau == pytest.approx(4.166666667, rel=1e-9)
    assert groups[0].film_aspect == pytest.approx(0.1290994449, rel=1e-9)
    assert groups[0].film_nu == 0.37
    assert groups[0].film_K_beta == pytest.approx(6.776029067, rel=1e-9)


def test_film_has_its_own_work_of_adhesion():
    coating = {"material": "gold", "thickness": "200 nm", "work_of_adhesion": "1 J/m^2"}
    groups = contact(coating=coating).indices()
    assert groups.n_g == pytest.approx(0.4, rel=1e-15)
    gold = contact("gold", "gold", work_of_adhesion=1.0).indices()
    assert groups.film().theta == pytest.approx(gold.theta, rel=1e-14)
    assert groups.film().lam == pytest.approx(gold.lam, rel=1e-14)
    assert groups.film().K_beta == pytest.approx(gold.K_beta, rel=1e-14)


def test_hard_film_against_a_soft_body_yields_as_the_soft_body():
    coating = {"material": "titanium_nitride", "thickness": "200 nm", "bodies": "first"}
    groups = contact(STEEL, "silver", coating=coating).indices()
    assert groups.n_H == 1.0 and groups.film_nu == 0.37


def test_scales():
    scales = contact(STEEL, STEEL).scales()
    assert scales.load == pytest.approx(0.01144019696, rel=1e-9)
    assert scales.contact_area == pytest.approx(7.539822369e-12, rel=1e-9)
    assert scales.separation == 48e-9 and scales.asperities == pytest.approx(17000, rel=1e-15)


def test_groups_do_not_change_with_the_units_of_length_and_force():
    """Metres rescaled by a, newtons by b: every group keeps its value."""
    a, b = 7.0, 0.3

    def rescaled(length, force):
        pressure = force / length**2
        body = Material(
            youngs_modulus=200e9 * pressure, poissons_ratio=0.3, hardness=5e9 * pressure, tangent_modulus=2e9 * pressure
        )
        film = Material(youngs_modulus=80e9 * pressure, poissons_ratio=0.4, hardness=1e9 * pressure)
        rough = Roughness(
            asperity_height_deviation=5e-8 * length,
            asperity_radius=5e-5 * length,
            asperity_density=1e10 / length**2,
        )
        return Contact(
            first=body,
            second=body,
            roughness=rough,
            nominal_area=1e-6 * length**2,
            work_of_adhesion=force / length,
            interfacial_shear_strength=2e7 * pressure,
            pressure_coefficient=0.1,
            peeling=0.5,
            coating=Coating(material=film, thickness=2e-7 * length, friction_constant=3.0 * force / length),
        )

    one, other = rescaled(1.0, 1.0), rescaled(a, b)
    groups, others = one.indices(), other.indices()
    for name in type(groups).model_fields:
        if getattr(groups, name) is None:  # of what the contact does not have
            assert getattr(others, name) is None, name
        elif name not in ("tabor_parameter", "hardness_group"):  # the latter is given where nothing adheres
            assert getattr(groups, name) == pytest.approx(getattr(others, name), rel=1e-12), name
    # The range of the attraction is a length of matter: to keep the Tabor parameter it has to be rescaled too.
    assert groups.tabor_parameter == one.tabor_parameter()
    assert other.tabor_parameter(0.165e-9 * a) == pytest.approx(one.tabor_parameter(0.165e-9), rel=1e-12)


def test_arrays_broadcast_by_the_name_of_their_dimension():
    thickness = axis("thickness", ["100 nm", "200 nm"])
    sigma = axis("asperity_height_deviation", ["40 nm", "50 nm", "100 nm"])
    rough = Roughness(asperity_height_deviation=sigma, asperity_radius="50 um", asperity_density=1.7e10)
    swept = contact(STEEL, STEEL, roughness=rough, coating={"material": "silver", "thickness": thickness})
    groups = swept.indices()
    assert groups.tau.sizes == {"thickness": 2, "asperity_height_deviation": 3}
    assert groups.theta.dims == ("asperity_height_deviation",) and isinstance(groups.n_E, float)
    assert groups.film().theta.dims == ("asperity_height_deviation",)
    one = contact(
        STEEL,
        STEEL,
        coating={"material": "silver", "thickness": "200 nm"},
        roughness=Roughness(asperity_height_deviation="50 nm", asperity_radius="50 um", asperity_density=1.7e10),
    ).indices()
    at = {"thickness": 1, "asperity_height_deviation": 1}
    assert float(groups.tau.isel(at)) == pytest.approx(one.tau, rel=1e-15)
    assert float(groups.theta.isel(asperity_height_deviation=1)) == pytest.approx(one.theta, rel=1e-15)
    assert groups.tau.attrs == {} and groups.tau.coords["thickness"].attrs["units"] == "m"


def test_the_softer_body_may_change_along_a_sweep():
    hardness = axis("hardness", ["0.1 GPa", "0.25 GPa", "5 GPa"])
    groups = contact(material("iron", hardness=hardness), material("silver", hardness="0.25 GPa")).indices()
    assert np.array_equal(groups.nu, [0.28, 0.28, 0.37])
    ratio = groups.lam / groups.lam.isel(hardness=1)
    assert np.allclose(ratio, [0.4**4, 1, 1], rtol=1e-14)


def test_arrays_that_disagree_about_a_dimension_are_refused():
    with refusal("lam", "theta"):
        Indices(theta=axis("theta", [1, 2]), lam=axis("lam", [1, 3], "theta"))
    with refusal("second.hardness"):
        contact(
            material("iron", hardness=axis("hardness", [1e9, 2e9])),
            material("iron", hardness=axis("hardness", [1e9, 2e9, 3e9])),
        )


def test_samples_of_one_name_in_another_order_are_refused():
    theta = xarray.DataArray([40.0, 50.0], dims="sample", coords={"sample": [1, 2]})
    lam = xarray.DataArray([10.0, 20.0], dims="sample", coords={"sample": [2, 1]})
    assert Indices(theta=theta, lam=lam.assign_coords(sample=[1, 2])).lam.values.tolist() == [10.0, 20.0]
    with refusal("lam", "sample"):
        Indices(theta=theta, lam=lam)


def test_work_of_adhesion_from_surface_energies():
    assert work_of_adhesion("silver", "silver", interfacial=0) == 2.5  # twice 1.25
    assert work_of_adhesion("silver", "iron", interfacial="1 J/m^2") == pytest.approx(2.65)
    with refusal("second.surface_energy"):
        work_of_adhesion("silver", STEEL, interfacial=0)
    with refusal("work_of_adhesion", ">= 0 J/m^2"):
        work_of_adhesion("silver", "iron", interfacial=9)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"first": "silvr"}, "first: 'silvr'; allowed: a preset: silver"),
        ({"first": 5}, "first: 5; allowed: a material: the name of a preset, or its numbers"),
        ({"first": {"preset": "silver", "hardness": -1}}, "first.hardness: -1.0; allowed: >= 1000 Pa"),
        ({"first": {"youngs_modulus": 1e9, "poissons_ratio": 0.3}}, "first.hardness: not given; allowed: "),
        ({"work_of_adhesion": -1}, "work_of_adhesion: -1.0; allowed: >= 0 J/m^2"),
        ({"nominal_area": "1 mm"}, "nominal_area: '1 mm'; allowed: > 0 m^2"),
        ({"roughness": {"asperity_radius": 1}}, "roughness.asperity_height_deviation: not given; allowed: "),
        (
            {"coating": {"material": "silver", "thickness": "200"}},
            "coating.thickness: '200'; allowed: a number with",
        ),
        (
            {"coating": {"material": "silver", "thickness": 1e-7, "bodies": "third"}},
            "coating.bodies: 'third'; ",
        ),
        (
            {"coating": {"material": {"preset": "silver", "hardnes": 1}, "thickness": 1e-7}},
            "coating.material.hardnes: unknown key; allowed: hardness or range (all: ",
        ),
        ({"hardness_to_yield": 0.9}, "hardness_to_yield: 0.9; allowed: >= 1"),
        ({"coating": {"": 1}}, 'coating."": unknown key; allowed: '),
    ],
)
def test_bad_contact_is_one_line_with_the_dotted_field(changes, message):
    with pytest.raises(InputError) as error:
        contact(**changes)
    assert str(error.value).startswith(message) and "\n" not in str(error.value)


def test_a_group_that_no_one_stated_is_explained():
    """A yield stress above the hardness is refused by their ratio, which the user has not stated."""
    strong = Material(youngs_modulus="200 GPa", poissons_ratio=0.3, hardness="1 GPa", yield_stress="2 GPa")
    with pytest.raises(InputError) as error:
        contact(strong, strong).indices()
    assert str(error.value) == (
        "hardness_to_yield: 0.5; allowed: >= 1; follows from the numbers of the contact: hardness over yield stress (H/Y)"
    )


@pytest.mark.parametrize(
    ("record", "given", "message"),
    [
        (Contact, {}, "first: not given; allowed: a material: the name of a preset, or its numbers"),
        (Contact, {"first": "iron", "second": "iron"}, "roughness: not given; allowed: a table with sigma, R and N"),
        (Roughness, {}, "asperity_height_deviation: not given; allowed: standard deviation of the asperity heights, > 0 m"),
    ],
)
def test_what_is_missing_is_told_in_its_own_words(record, given, message):
    with pytest.raises(InputError) as error:
        record(**given)
    assert str(error.value).startswith(message)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"theta": -1}, "theta: -1.0; allowed: >= 1e-12 and <= 1e+40"),
        ({"theta": float("nan")}, "theta: nan; allowed: finite, >= 1e-12 and <= 1e+40"),
        ({"lamda": 1}, "lamda: unknown key; allowed: lam"),
        ({"nu": 0.5}, "nu: 0.5; allowed: >= 0 and < 0.5"),
        ({"n_E": 1.5, "n_H": 0.5}, "tau: not given; allowed: a film needs n_E, n_H and tau together"),
        (
            {"film_nu": 0.3},
            "n_E: not given; allowed: a film needs n_E, n_H and tau together (film_nu is given)",
        ),
        ({"n_g": 2}, "n_E: not given; allowed: a film needs n_E, n_H and tau together (n_g is given)"),
    ],
)
def test_bad_indices_are_one_line(given, message):
    with pytest.raises(InputError) as error:
        Indices(**{"theta": 40, "lam": 10} | given)
    assert str(error.value).startswith(message)


def test_numbers_out_of_all_proportion_are_refused_not_overflowed():
    body = Material(youngs_modulus=1e200, poissons_ratio=0.3, hardness=1e100)
    with pytest.raises(InputError):
        contact(body, body).indices()


def test_indices_fill_in_what_is_left_out():
    bare = Indices(theta=40, lam=10, n_g=1.0)
    assert not bare.has_film and bare.resolved().film_nu is None
    with refusal("tau", "n_E", "n_H"):
        bare.film()
    coated = Indices(theta=40, lam=10, n_E=1.5, n_H=0.5, tau=2)
    whole = coated.resolved()
    assert whole.film_nu == 0.3 and whole.film_K_beta == whole.K_beta
    assert whole.resolved() == whole
    assert coated.film().theta == 60 and coated.film().lam == pytest.approx(10 * 0.0625 / 2.25, rel=1e-15)
    other = Indices(theta=40, lam=10, n_E=1.5, n_H=0.5, tau=2, film_nu=0.4)
    assert other.resolved().film_K_beta == pytest.approx(7.1111111111, rel=1e-10)


def test_records_cannot_be_changed():
    with refusal("lam", "-1.0", ">= 1e-60"):
        Indices(theta=1, lam=-1)
    with refusal("Indices.theta"):
        Indices(theta=1, lam=1).theta = 2


def test_quantities_along_one_dimension_go_together():
    """Point by point, each under its own name; of two bodies under the name of the field."""
    from stiction import solve

    pairs = Indices(theta=axis("theta", [10, 40, 90], "batch"), lam=axis("lam", [1, 2, 5], "batch"))
    found = solve(pairs, separation=[1.0, 0.0])
    assert found["load"].dims == ("batch", "mean_separation")
    assert found["theta"].values.tolist() == [10, 40, 90] and found["lam"].values.tolist() == [1, 2, 5]
    for i, (theta, lam) in enumerate([(10, 1), (40, 2), (90, 5)]):
        alone = solve(Indices(theta=theta, lam=lam), separation=[1.0, 0.0])
        np.testing.assert_allclose(found["load"][i], alone["load"], rtol=1e-13)
    alone = solve(Indices(theta=axis("theta", [10, 40], "batch"), lam=1), separation=1.0)
    assert alone["batch"].values.tolist() == [10, 40]  # a single one names the points of the dimension
    two = contact(
        material("iron", hardness=axis("hardness", [1e9, 2e9], "batch")),
        material("iron", hardness=axis("hardness", [3e9, 5e9], "batch")),
    )
    found = solve(two, separation=["1 nm"])
    assert found["first.hardness"].values.tolist() == [1e9, 2e9] and found["second.hardness"].values.tolist() == [3e9, 5e9]
    assert found["load"].sizes == {"batch": 2, "mean_separation": 1}
    with refusal("lam", "batch", "2", "theta"):
        Indices(theta=axis("theta", [10, 40, 90], "batch"), lam=axis("lam", [1, 2], "batch"))


def test_different_quantities_of_a_contact_along_one_dimension_go_together():
    """Groups depend on different ones of them, and none may take the others' values for names of its points."""
    hardnesses, adhesions, radii = [1.2e9, 2e9, 9e9], [0.1, 0.3, 0.6], [1e-5, 2e-5]

    def made(hardness, work_of_adhesion, radius):
        return Contact(
            first=material("copper", hardness=hardness),
            second="hardened_steel_52100",
            roughness=Roughness(asperity_height_deviation=6e-8, asperity_radius=radius, asperity_density=2e10),
            work_of_adhesion=work_of_adhesion,
            nominal_area=1e-6,
        )

    swept = made(
        axis("hardness", hardnesses, "batch"), axis("work_of_adhesion", adhesions, "batch"), axis("asperity_radius", radii)
    )
    found = solve(swept, load=[0.1, 1.0])
    assert found["hardness"].values.tolist() == hardnesses and found["hardness"].dims == ("batch",)
    assert found["work_of_adhesion"].values.tolist() == adhesions and found["asperity_radius"].values.tolist() == radii
    for i, (hardness, adhesion) in enumerate(zip(hardnesses, adhesions, strict=True)):
        for j, radius in enumerate(radii):
            alone = solve(made(hardness, adhesion, radius), load=[0.1, 1.0])["contact_area"]
            np.testing.assert_allclose(found["contact_area"].isel(batch=i, asperity_radius=j), alone, rtol=1e-9)


def test_nominal_width():
    """The side of a square of the nominal area over sigma: 1 mm over 48 nm, and of two bodies' surfaces over their sigma."""
    assert contact().indices().nominal_width == pytest.approx(1e-3 / 48e-9, rel=1e-12)
    assert contact(nominal_area="4 mm^2").indices().nominal_width == pytest.approx(2e-3 / 48e-9, rel=1e-12)
    rough = Roughness(asperity_height_deviation="12 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    assert contact(roughness=rough).indices().nominal_width == pytest.approx(1e-3 / 12e-9, rel=1e-12)


def test_asperities_of_a_wider_contact_sink_farther():
    """Interaction by the mean pressure p: u = 0.9464 p sqrt(A_n)/E*, the mean displacement of a square under it (Love). At the
    separation d asperities carry what alone they do at d + u."""
    sigma, radius, count = 48e-9, 50e-6, 1.7e10

    def alone(h):  # (4/3) N R^(1/2) sigma^(3/2) F_(3/2): the mean pressure over E*
        share = quad(lambda w: w**1.5 * math.exp(-((h + w) ** 2) / 2.0), 0.0, 12.0, epsabs=0.0, epsrel=1e-11)[0]
        return 4.0 / 3.0 * count * radius**0.5 * sigma**1.5 * share / math.sqrt(2.0 * math.pi)

    root = math.sqrt(2.0)
    mean = 4.0 / math.pi * (math.log(1.0 + root) - (root - 1.0) / 3.0)
    for side in (1e-4, 1e-3):
        pair = contact(nominal_area=side**2, work_of_adhesion="0.1 J/m^2")
        found = solve(pair, separation=1.5 * sigma, model="ciavarella_greenwood_paggi_2008", tangential="none")
        apart = brentq(lambda h: h - 1.5 - mean * alone(h) * side / sigma, 1.5, 12.0, xtol=1e-14)  # noqa: B023
        assert float(found["load"]) == pytest.approx(alone(apart) * pair.contact_modulus * side**2, rel=1e-8)
