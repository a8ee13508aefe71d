"""Designs: known optima, limits that are kept, fronts, several loads, and what an interruption leaves."""

import tomllib

import numpy as np
import pytest
from typer.testing import CliRunner

from refusals import refusal
from stiction import cli
from stiction.case.read import parse_case
from stiction.quantities.errors import InputError
from stiction.report.design_pictures import design_figure
from stiction.report.views.design import design_notes, design_view
from stiction.solving.choice import Choice
from stiction.solving.pointwise import REASONS, solve_batch
from stiction.solving.problem import make_problem
from stiction.solving.solve import solve
from stiction.solving.yielded import yielded_shares
from stiction.studies.design import run as design_module
from stiction.studies.design.plan import Limit
from stiction.studies.design.run import _beyond, _front, _search_objective, design, plan_of_design, run_design
from stiction.studies.design.space import _outside
from stiction.studies.prediction.predict import predict

STRENGTH, AREA, LOAD = 200e6, 1e-6, 1.0
ROUGH = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
RADIUS = {"roughness": {"asperity_radius": {"low": "1 um", "high": "500 um"}}}


def case(objective, choose, limits=None, model="persson_2001", load="1 N", **more):
    contact = {
        "first": "hardened_steel_52100",
        "second": "hardened_steel_52100",
        "interfacial_shear_strength": "200 MPa",
        "nominal_area": "1 mm^2",
        "roughness": ROUGH,
    }
    table = {"objective": objective, "choose": choose, "limits": limits or {}, "validity": "any"}
    return {"contact": contact, "solve": {"load": load, "model": model}, "design": table | more}


def coated(objective, choose, limits=None, **more):
    found = case(objective, choose, limits, "soft_coating_2015", **more)
    contact = {key: value for key, value in found["contact"].items() if key != "interfacial_shear_strength"}
    film = {"material": "silver", "thickness": "200 nm", "bodies": "first"}
    return found | {"contact": contact | {"work_of_adhesion": "0.3 J/m^2", "coating": film}}


def subject_of(table):
    return parse_case({key: one for key, one in table.items() if key != "design"}).subject


MOST, LEAST = {"maximise": "friction_coefficient"}, {"minimise": "friction_coefficient"}


def test_the_optimum_of_a_closed_form():
    """Persson's friction is strength times area over load: the most under a limit of the area is at that limit."""
    choose = {"roughness": RADIUS["roughness"] | {"asperity_height_deviation": {"low": "5 nm", "high": "200 nm"}}}
    found = design(case(MOST, choose, {"area_fraction": {"high": 0.001}}))
    assert float(found["friction_coefficient"][0]) == pytest.approx(STRENGTH * 0.001 * AREA / LOAD, rel=2e-6)
    assert bool(found["feasible"][0]) and float(found["constraint_violation"][0]) <= found.attrs["tolerance"] == 1e-6
    assert found.attrs["verdict"] == ""


def test_a_target_is_met():
    table = case({"target": "friction_coefficient", "value": 0.123}, RADIUS)
    found = run_design(plan_of_design(table), lambda count, text: None)
    radius = float(found.data()["roughness.asperity_radius"][0])
    subject = subject_of(table)
    there = subject.replace(roughness=subject.roughness.replace(asperity_radius=radius))
    assert float(solve(there, load=LOAD, model="persson_2001")["friction_coefficient"]) == pytest.approx(0.123, rel=1e-8)
    assert found.data().attrs["missed"] == "" and abs(float(found.data()["friction_coefficient_off_target"][0])) < 1e-8


def test_a_target_out_of_reach_is_missed_and_it_is_said_by_how_much(tmp_path):
    """Slopes go as (sigma/R)^(1/2): the least friction between 1 and 2 um is that of 1 um, above .0002."""
    radius = {"roughness": {"asperity_radius": {"low": "1 um", "high": "2 um"}}}
    table = case({"target": "friction_coefficient", "value": 0.0002}, radius)
    data = design(table)
    least = design(case(LEAST, radius))
    mu = float(least["friction_coefficient"][0])
    assert float(data["friction_coefficient"][0]) == pytest.approx(mu, rel=1e-6) and mu > 0.0003
    assert float(data["friction_coefficient_off_target"][0]) == pytest.approx(mu / 0.0002 - 1.0, rel=1e-6)
    said = f"friction_coefficient = {mu:.4g}, {100.0 * (mu / 0.0002 - 1.0):.3g} % above 0.0002"
    assert data.attrs["missed"] == said and least.attrs["missed"] == ""
    assert f"objective missed: {said.replace('_', ' ')}" in "\n".join(map(str, design_notes(data)))
    figure = design_figure(data)
    assert said.replace("_", " ") in figure.get_suptitle()
    figure.draw_without_rendering()
    (panel,) = figure.axes
    legend = panel.get_legend()
    assert legend.get_window_extent().y0 > panel.bbox.y1 and "designs evaluated" in legend.get_title().get_text()
    assert said in run_design(plan_of_design(table), lambda count, text: None).case_text(tmp_path)


def test_a_limit_from_below_and_an_end_that_decides():
    found = design(case(LEAST, RADIUS, {"contact_area": {"low": "100 um^2"}}))
    assert float(found["friction_coefficient"][0]) == pytest.approx(STRENGTH * 100e-12 / LOAD, rel=2e-6)
    found = design(case(LEAST, RADIUS))
    assert float(found["roughness.asperity_radius"][0]) == pytest.approx(1e-6, rel=1e-6)


def test_the_best_of_lists_is_that_of_all_combinations():
    names, thicknesses = ["silver", "gold", "indium", "copper"], ["50 nm", "200 nm", "1 um"]
    table = coated(LEAST, {"coating": {"material": names, "thickness": thicknesses}})
    found = design(table)
    subject, least = subject_of(table), {}
    for name in names:
        film = [subject.coating.replace(material=name, thickness=thickness) for thickness in thicknesses]
        least[name] = min(float(solve(subject.replace(coating=one), load=LOAD)["friction_coefficient"]) for one in film)
    best = sorted(least, key=least.get)
    assert found["coating.material"].values.tolist() == best
    np.testing.assert_allclose(found["friction_coefficient"], [least[name] for name in best], rtol=1e-9)
    assert found.attrs["evaluated"] == 12


def test_materials_with_numbers_between_ends_beat_every_point_of_a_grid():
    choose = {
        "coating": {"material": ["silver", "gold"], "thickness": {"low": "20 nm", "high": "1 um"}},
        "roughness": {"asperity_height_deviation": {"low": "20 nm", "high": "100 nm"}},
    }
    table = coated(LEAST, choose, {"area_fraction": {"high": 0.004}})
    found = design(table)
    subject, least = subject_of(table), {}
    axes = {"thickness": np.geomspace(20e-9, 1e-6, 40), "sigma": np.geomspace(20e-9, 100e-9, 40)}
    for name in ("silver", "gold"):
        thickness, sigma = (one.ravel() for one in np.meshgrid(*axes.values()))
        from xarray import DataArray

        rough = subject.roughness.replace(asperity_height_deviation=DataArray(sigma, dims="at"))
        film = subject.coating.replace(material=name, thickness=DataArray(thickness, dims="at"))
        data = solve(subject.replace(coating=film, roughness=rough), load=LOAD)
        kept = data["area_fraction"].values <= 0.004
        least[name] = data["friction_coefficient"].values[kept].min()
    for at, name in enumerate(found["coating.material"].values.tolist()):
        assert bool(found["feasible"][at]) and float(found["friction_coefficient"][at]) <= least[name] * (1 + 1e-9)
        assert float(found["friction_coefficient"][at]) > 0.5 * least[name]


def test_the_worst_of_several_loads_counts():
    """Persson's friction falls with load: a target over two loads is met in the middle."""
    table = case({"target": "friction_coefficient", "value": 0.1}, RADIUS, load=["1 N", "400 N"])
    found = run_design(plan_of_design(table), lambda count, text: None)
    best = found.best()[0]
    positions, objectives = found.positions, found.answers.objectives
    radius = float(found.plan.free[0].at(positions[best, 0]))
    subject = subject_of(table)
    there = subject.replace(roughness=subject.roughness.replace(asperity_radius=radius))
    mu = solve(there, load=[1.0, 400.0], model="persson_2001")["friction_coefficient"].values
    assert objectives[best, 0] == pytest.approx(np.abs(mu - 0.1).max(), rel=1e-9)
    np.testing.assert_allclose(mu[0] - 0.1, 0.1 - mu[1], rtol=1e-4)


def test_the_load_may_be_chosen():
    found = design(case(MOST, {"load": {"low": "1 N", "high": "2000 N"}}))
    assert float(found["load"][0]) == pytest.approx(1.0, rel=1e-6)


def test_where_nothing_keeps_the_limits_it_is_said():
    found = design(case(MOST, RADIUS, {"area_fraction": {"high": 1e-9}}))
    assert not bool(found["feasible"][0]) and found.attrs["verdict"].startswith("no design meets all limits")
    assert float(found["roughness.asperity_radius"][0]) == pytest.approx(1e-6, rel=1e-3)
    assert found.attrs["limits"] == "area_fraction 1e-09 at most"


def test_limits_are_told_with_their_units():
    ends = Limit("contact_area", 5e-12, 1e-9), Limit("contact_area", -np.inf, 1e-9), Limit("contact_area", 5e-12, np.inf)
    between, most, least = (one.words for one in ends)
    assert between == "contact_area 5 µm^2 to 1000 µm^2"
    assert (most, least) == ("contact_area 1000 µm^2 at most", "contact_area 5 µm^2 at least")


def test_validity_is_a_limit():
    """Asperities as high as their tips are wide have a validity warning."""
    choose = {"roughness": {"asperity_height_deviation": {"low": "5 nm", "high": "50 um"}}}
    free, claimed = (
        design(case(LEAST, choose, model="greenwood_williamson_1966", validity=validity)) for validity in ("any", "claimed")
    )
    assert float(free["roughness.asperity_height_deviation"][0]) > 0.09 * 50e-6
    assert float(claimed["roughness.asperity_height_deviation"][0]) <= 0.09 * 50e-6 and bool(claimed["feasible"][0])


@pytest.mark.parametrize(
    ("deviation", "work", "load", "kinds"),
    [
        (48e-9, None, 1.0, set()),
        (48e-9, None, 1e-4, {"statistics"}),
        (48e-9, 50.0, 1.0, {"effect"}),
        (6e-5, None, 1.0, {"statistics", "effect", "assumption", "impossible"}),
    ],
)
def test_what_a_limit_of_validity_counts(deviation, work, load, kinds):
    """Of scattering averages nothing, of what is neglected what is claimed, of what cannot be either."""
    contact = subject_of(case(LEAST, RADIUS))
    rough = contact.roughness.replace(asperity_radius=50e-6, asperity_height_deviation=deviation)
    contact = contact.replace(roughness=rough, work_of_adhesion=work)
    solved = solve_batch(contact, Choice("greenwood_williamson_1966"), load=load)
    bits = int(solved.validity_warnings[1]) >> len(REASONS)
    left = [rule.kind for at, rule in enumerate(solved.rules) if bits >> at & 1]
    assert set(left) == kinds
    counted = {"claimed": len(left) - left.count("statistics"), "possible": left.count("impossible"), "any": 0}
    assert {validity: float(_outside(solved, validity)) for validity in counted} == counted


TWO = [LEAST, {"minimise": "contact_area"}]


def test_a_front_is_of_designs_that_none_beats():
    choose = {
        "roughness": {"asperity_height_deviation": {"low": "10 nm", "high": "200 nm"}},
        "coating": {"thickness": {"low": "20 nm", "high": "2 um"}},
    }
    table = coated(TWO, choose, effort=30)
    found = design(table)
    front = np.column_stack([found[f"pareto_{name}"].values for name in ("friction_coefficient", "contact_area")])
    assert len(front) > 10 and (np.diff(front[:, 0]) > 0).all() and (np.diff(front[:, 1]) < 0).all()
    from xarray import DataArray

    subject = subject_of(table)
    rng = np.random.default_rng(0)
    rough = subject.roughness.replace(asperity_height_deviation=DataArray(10e-9 * 20 ** rng.random(2000), dims="at"))
    film = subject.coating.replace(thickness=DataArray(20e-9 * 100 ** rng.random(2000), dims="at"))
    data = solve(subject.replace(coating=film, roughness=rough), load=LOAD)
    points = np.column_stack([data["friction_coefficient"].values, data["contact_area"].values])
    # a step of the front apart from it, no point is better in both
    slack = 1.15
    beaten = [(slack * points < one).all(axis=1).any() for one in front]
    assert not any(beaten)


def test_a_front_of_points():
    objectives = np.array([[1.0, 5.0], [2.0, 2.0], [2.0, 3.0], [3.0, 2.0], [4.0, 1.0], [0.5, 0.5]])
    assert _front(objectives, np.array([0.0, 0.0, 0.0, 0.0, 1e-7, 1.0])).tolist() == [0, 1, 4]


def test_a_ceiling_is_of_the_other_wish():
    objectives, worst = np.array([[1.0, 5.0], [2.0, 2.0], [9.0, 1.0]]), np.array([0.0, 0.0, 0.25])
    np.testing.assert_allclose(_beyond(objectives, worst, 0, 2.5), [1.0, 0.0, 0.25], rtol=1e-15)
    np.testing.assert_allclose(_beyond(objectives, worst, 1, 2.5), [0.0, 0.0, 2.6], rtol=1e-15)
    np.testing.assert_allclose(_beyond(-objectives, worst, 0, -2.5), [0.0, 0.2, 0.6], rtol=1e-15)
    np.testing.assert_allclose(_beyond(objectives, worst, 0, None), worst, rtol=0)


def test_what_is_searched_under_a_ceiling_is_best_at_it():
    """Friction is strength times area over load: the most friction under a ceiling of the area has that area."""
    table = case([MOST, {"minimise": "contact_area"}], RADIUS)
    found = run_design(plan_of_design(table | {"design": table["design"] | {"effort": 1}}), lambda count, text: None)
    before = len(found.positions)
    found.plan.__dict__["effort"] = 60
    _search_objective(found, 0, 2e-10, lambda count, text: None)
    objectives = found.answers.objectives
    new = objectives[before:]
    assert new[new[:, 1] <= 2e-10 * (1 + 1e-6), 0].min() == pytest.approx(-STRENGTH * 2e-10 / LOAD, rel=1e-3)


def test_a_front_is_searched_for_one_wish_under_ceilings_of_the_other(monkeypatch):
    """A front of friction, tenths, and area, some 1e-10 m^2: ceilings of one are far from all values of the other."""
    asked, searched = [], design_module._search_objective
    monkeypatch.setattr(design_module, "_search_objective", lambda *given: asked.append(given[1:3]) or searched(*given))
    found = run_design(plan_of_design(case([LEAST, MOST | {"maximise": "contact_area"}], RADIUS, effort=1)), lambda *told: None)
    objectives, worst = found.answers.objectives, found.answers.worst
    assert [number for number, ceiling in asked if ceiling is None] == [0, 1]
    ceilings = [one for one in asked if one[1] is not None]
    assert len(ceilings) == 12
    for number, ceiling in ceilings:
        assert objectives[worst == 0.0, 1 - number].min() < ceiling < objectives[worst == 0.0, 1 - number].max()


@pytest.mark.parametrize("name", ["load_share_yielded", "load_share_substrate_yielded"])
def test_what_has_yielded_is_the_load_that_is_plastic(name):
    subject = subject_of(case(LEAST, RADIUS)).replace(interfacial_shear_strength=None, first="copper")
    choice = Choice("kogut_etsion_2004", tangential="none")
    problem = make_problem(subject, choice)
    h = np.array([[0.5, 1.0, 2.0]])
    data = problem.at(h)
    share = 1.0 - data["load_elastic"] / data["load"]
    np.testing.assert_allclose(yielded_shares(problem, h, name), share, rtol=1e-12)
    assert (share > 0.01).all() and (share < 1.0).all()


def test_the_substrate_of_a_film():
    subject = subject_of(coated(LEAST, RADIUS)).replace(first="copper")
    subject = subject.replace(coating=subject.coating.replace(thickness="50 nm"))
    problem = make_problem(subject, Choice("soft_coating_2015", film="sequential"))
    h = np.array([[0.0, 1.0, 6.0]])
    substrate, whole = (yielded_shares(problem, h, f"load_share_{name}yielded") for name in ("substrate_", ""))
    assert (substrate < whole).all() and substrate[0, 2] < 0.01 * substrate[0, 0]
    with refusal("load_share_substrate_yielded", "layered", "sequential", "printed"):
        as_one = Choice("greenwood_williamson_1966", film="layered", tangential="none")
        yielded_shares(make_problem(subject, as_one), h, "load_share_substrate_yielded")


def test_no_yield_of_the_substrate_is_a_limit():
    limits = {"load_share_substrate_yielded": {"high": 0.001}}
    table = coated(MOST, {"coating": {"thickness": {"low": "20 nm", "high": "1 um"}}}, limits)
    table["contact"]["first"] = "copper"
    found = design(table)
    thickness = float(found["coating.thickness"][0])
    subject = subject_of(table)
    there = subject.replace(coating=subject.coating.replace(thickness=thickness))
    h = solve(there, load=LOAD)["mean_separation"].values / 48e-9
    share = yielded_shares(make_problem(there, Choice()), h.reshape(1, 1), "load_share_substrate_yielded")
    assert bool(found["feasible"][0]) and share.item() == pytest.approx(0.001, rel=1e-3)
    assert share.item() <= 0.001 * (1 + 1e-6)


@pytest.mark.parametrize("model", ["rough_on_film", "persson_2001"])
@pytest.mark.parametrize("name", ["load_share_yielded", "load_share_substrate_yielded"])
def test_yield_is_refused_for_a_model_without_asperities(model, name):
    """Reject the limit before the search, in one line that names a model that counts its asperities."""
    table = coated(MOST, {"coating": {"thickness": {"low": "20 nm", "high": "1 um"}}}, {name: {"high": 0.001}})
    table["contact"] |= {"interfacial_shear_strength": "200 MPa"}
    table["solve"]["model"] = model
    if model == "persson_2001":
        table["design"]["choose"] = RADIUS
        del table["contact"]["coating"]
    with pytest.raises(InputError) as caught:
        design(table)
    assert (caught.value.field, caught.value.value) == (name, model)
    assert "greenwood_williamson_1966" in caught.value.allowed


def test_broken_limits_are_named_with_their_values():
    """Persson's friction is strength times area over load; at sigma = 20 um and R = 50 um, N R sigma = 17 and
    sqrt(sigma/R) = 0.63 are beyond 1 and 10, and beyond 0.3."""
    bounded = design(case(MOST, RADIUS, {"area_fraction": {"high": 1e-9}, "friction_coefficient": {"low": 1e-9}}))
    area = float(bounded["friction_coefficient"][0]) * LOAD / STRENGTH / AREA
    assert bounded["violated"].values.tolist() == [f"area_fraction 1e-09 at most, but the result is {area:.3g}"]
    table = case(LEAST, {"second": ["silver", "gold"]}, model="greenwood_williamson_1966", validity="claimed")
    table["contact"]["roughness"] = ROUGH | {"asperity_height_deviation": "20 um"}
    rough = design(table)
    for words in rough["violated"].values:
        assert {line.partition(":")[0] for line in words.split("\n")} >= {
            "N R sigma is not 1e-05 to 10",
            "N R sigma is not 0.001 to 1",
            "sqrt(sigma/R) is not 0 to 0.3",
        }
    notes = "\n".join(map(str, design_notes(rough)))
    assert notes.count("N R sigma is not 0.001 to 1") == 2 and "violated (silver): " in notes and "violated (gold): " in notes


def test_a_design_that_is_refused_states_the_reason():
    """An empirical distribution needs ten heights; every design of this case has nine."""
    table = case(LEAST, RADIUS)
    del table["solve"]["model"]
    nine = {"height_distribution": "empirical", "height_parameters": {"samples": list(range(9))}}
    table["contact"]["roughness"] = ROUGH | nine
    refused = design(table)
    assert not refused["feasible"].any() and "10 or more finite heights" in str(refused["violated"].values[0])


def test_what_is_uncertain_is_held_for_nineteen_of_twenty():
    """Friction is strength times area over load: with a strength that is uncertain the area must be so much smaller."""
    table = case({"maximise": "contact_area"}, RADIUS, {"friction_coefficient": {"high": 0.1}})
    sure = float(design(table)["contact_area"][0])
    assert sure == pytest.approx(0.1 * LOAD / STRENGTH, rel=2e-6)
    table["contact"]["interfacial_shear_strength"] = "200 +/- 20 MPa"
    found = design(table)
    deviations = (0.1 * LOAD / float(found["contact_area"][0]) - STRENGTH) / 20e6
    assert 1.3 < deviations < 2.3  # 1.64 if there were more than 32 points
    assert found.attrs["uncertain"] == "interfacial_shear_strength" and bool(found["feasible"][0])
    # what is shown is what the limit is held to: not the one of 32 samples that is beyond it
    assert float(found["friction_coefficient"][0]) == pytest.approx(0.1, rel=2e-6)


def test_a_material_that_is_chosen_brings_its_own_ranges():
    table = coated(LEAST, {"coating": {"material": ["silver", "gold"]}})
    nominal = design(table)
    wide = design(table | {"uncertainty": {"ranges": True}})
    assert wide.attrs["uncertain"] == "numbers of materials within their ranges"
    worse = [
        float(data["friction_coefficient"][data["coating.material"].values.tolist().index(name)])
        for name in ("silver", "gold")
        for data in (nominal, wide)
    ]
    assert worse[1] > worse[0] and worse[3] > worse[2]


def test_an_interruption_keeps_the_best_so_far():
    def stop(count, text):
        if count > 300:
            raise KeyboardInterrupt

    plan = plan_of_design(case(MOST, RADIUS, {"area_fraction": {"high": 0.001}}))
    found = run_design(plan, stop)
    assert found.stopped and 300 < len(found.positions) < 400
    data = found.data()
    assert bool(data["feasible"][0]) and float(data["friction_coefficient"][0]) > 0.19 and data.attrs["stopped"] == 1
    so_far = data["best_so_far"].values
    assert so_far.size == len(found.positions) and (so_far[1:] <= so_far[:-1]).all()
    assert -so_far[-1] == pytest.approx(float(data["friction_coefficient"][0]), rel=1e-12)
    with pytest.raises(KeyboardInterrupt):
        run_design(plan, stop, keep_on_interrupt=False)


def test_json_has_the_designs_and_not_the_way_there():
    found = run_design(plan_of_design(case(MOST, RADIUS)), lambda count, text: None)
    variables = design_view(found).record()["variables"]
    assert "best_so_far" not in variables and "friction_coefficient" in variables and "best_so_far" in found.data()


def test_the_same_seed_gives_the_same_design():
    one, two = (design(case(MOST, RADIUS, {"area_fraction": {"high": 0.001}}, seed=3)) for _ in range(2))
    assert one.identical(two)


def test_what_is_told_is_a_function():
    with refusal("callback", "3"):
        design(case(MOST, RADIUS), callback=3)


@pytest.mark.parametrize("objective", [MOST, [MOST, {"minimise": "contact_area"}]], ids=["one", "two"])
@pytest.mark.parametrize("model", ["persson_2001", None], ids=["model", "prediction"])
def test_the_largest_number_of_designs_is_told_at_once_and_kept(objective, model):
    told = []
    table = case(objective, RADIUS, effort=2)
    if model is None:
        del table["solve"]["model"]
    found = run_design(plan_of_design(table), lambda count, text: told.append((count, text)))
    counts, texts = zip(*told, strict=True)
    assert counts[0] <= 256 and sorted(set(counts)) == list(counts)
    (most,) = {int(text.removeprefix("of at most ").partition(",")[0]) for text in texts}
    assert counts[-1] == len(found.positions) <= most <= 1.5 * len(found.positions) + 400


def test_the_time_left_is_told_where_it_is_long(monkeypatch):
    clock = iter(range(0, 100_000, 100))
    monkeypatch.setattr(design_module.time, "monotonic", lambda: float(next(clock)))
    told = []
    design(case(MOST, RADIUS, effort=2), callback=lambda count, text: told.append((count, text)))
    count, text = told[0]
    most = int(text.split()[3].strip(","))
    assert text.endswith(f"at most {100.0 / count * (most - count) / 60.0:.0f} min left") or 100.0 / count * (most - count) < 90


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"objective": {}}, ("design.objective",)),
        (
            {"objective": {"minimise": "frction_coefficient"}},
            ("design.objective", "frction_coefficient", "friction_coefficient"),
        ),
        ({"objective": {"target": "friction_coefficient"}}, ("design.objective.value",)),
        ({"objective": {"target": "contact_area", "value": 1.0}}, ("design.objective.value", "1.0")),
        ({"objective": [LEAST] * 3}, ("design.objective",)),
        ({"choose": {}}, ("design.choose",)),
        ({"choose": {"roughness": {"asperity_radius": "3 um"}}}, ("design.choose.roughness.asperity_radius",)),
        (
            {"choose": {"coating": {"material": ["silver"]}}},
            ("design.choose.coating.material",),
        ),
        ({"choose": {"first": ["steal"]}}, ("contact.first", "steal")),
        ({"choose": {"first": {"low": 1, "high": 2}}}, ("design.choose.first",)),
        (
            {"choose": {"nominal_area": {"low": "1 mm^2", "high": "2 mm^2", "each_sample": True}}},
            ("design.choose.nominal_area.each_sample",),
        ),
        ({"limits": {"area_fraction": {}}}, ("design.limits.area_fraction",)),
        ({"limits": {"contact_area": {"high": "1 N"}}}, ("design.limits.contact_area.high", "1 N")),
        ({"limits": {"contact_area": {"high": "1 um^2", "low": "2 um^2"}}}, ("design.limits.contact_area",)),
        ({"limits": {"tau": {"high": 1.0}}}, ("design", "tau", "persson_2001")),
        ({"validity": "none"}, ("design.validity",)),
    ],
)
def test_one_line_about_a_bad_table(table, said):
    given = case(LEAST, RADIUS)
    given["design"] |= table
    with refusal(*said) as caught:
        design(given)
    assert "\n" not in str(caught.value)


CASE_FILE = """
title = "Which metal?"
[contact]
first = "hardened_steel_52100"
second = "hardened_steel_52100"
work_of_adhesion = "0.3 J/m^2"
nominal_area = "1 mm^2"
[contact.roughness]
asperity_height_deviation = "48 nm"
asperity_radius = "50 um"
asperity_density = "1.7e10 1/m^2"
[contact.coating]
material = "silver"
bodies = "first"
thickness = "200 nm"
[solve]
load = "1 N"
[design]
objective = [{ minimise = "friction_coefficient" }, { minimise = "contact_area" }]
validity = "any"
effort = 2
[design.choose.coating]
material = ["silver", "gold"]
thickness = { low = "20 nm", high = "1 um" }
"""


def test_the_command_writes_everything(tmp_path):
    (tmp_path / "case.toml").write_text(CASE_FILE, encoding="utf-8")
    result = CliRunner().invoke(cli.app, ["design", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0 and "gold" in result.output
    names = {"designed.toml", "design.csv", "design.png", "design.nc", "pareto.csv"}
    assert {one.name for one in (tmp_path / "out").iterdir()} == names
    again = predict(tmp_path / "out" / "designed.toml")
    first = (tmp_path / "out" / "design.csv").read_text().splitlines()
    at = first[0].split(",").index("friction_coefficient")
    assert float(again["friction_coefficient"][0]) == pytest.approx(float(first[1].split(",")[at]), rel=1e-8)
    assert "design" not in tomllib.loads((tmp_path / "out" / "designed.toml").read_text())


@pytest.mark.usefixtures("no_pictures")
def test_the_command_is_interrupted_and_keeps(tmp_path, monkeypatch):
    from stiction.studies.design import run as module

    def interrupted(*given):
        raise KeyboardInterrupt

    monkeypatch.setattr(module, "_search_objective", interrupted)
    monkeypatch.setattr(module, "_evolve_front", interrupted)
    (tmp_path / "case.toml").write_text(CASE_FILE, encoding="utf-8")
    result = CliRunner().invoke(cli.app, ["design", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out")])
    assert result.exit_code == 130 and "stopped before the end: the best so far" in result.output
    assert (tmp_path / "out" / "designed.toml").exists()


def test_a_front_of_predictions_reaches_its_ends_in_few_designs():
    """Friction and area of a metal pair rise together with the finish: the ends of the front are at least as
    good as the smoothest and the roughest corner."""
    plan = plan_of_design(
        {
            "contact": {
                "first": "hardened_steel_52100",
                "second": "hardened_steel_52100",
                "interface": "boundary lubricant",
                "nominal_area": "1 mm^2",
                "roughness": {
                    "asperity_height_deviation": "60 nm",
                    "asperity_radius": "40 um",
                    "asperity_density": "1.7e10 1/m^2",
                    "kind": "ground",
                },
            },
            "solve": {"load": "1 N"},
            "design": {
                "objective": [{"minimise": "friction_coefficient_high"}, {"maximise": "contact_area"}],
                "choose": {
                    "roughness": {
                        "asperity_height_deviation": {"low": "40 nm", "high": "200 nm"},
                        "asperity_radius": {"low": "20 um", "high": "100 um"},
                    }
                },
            },
        }
    )
    found = run_design(plan, lambda count, text: None)
    assert len(found.positions) <= 500
    front = found.data()
    area = front["pareto_contact_area"].values
    smooth, rough = (
        predict(plan.given | {"contact": plan.given["contact"] | {"roughness": plan.given["contact"]["roughness"] | numbers}})
        for numbers in (
            {"asperity_height_deviation": "40 nm", "asperity_radius": "100 um"},
            {"asperity_height_deviation": "200 nm", "asperity_radius": "20 um"},
        )
    )
    assert area.max() > 0.99 * smooth["contact_area"].item()
    least = front["pareto_friction_coefficient_high"].values.min()
    assert least < 1.01 * rough["friction_coefficient_high"].item()


def test_the_high_end_of_a_predicted_interval_is_drawn():
    found = design(case({"minimise": "friction_coefficient_high"}, RADIUS, model=None, effort=2))
    axes = design_figure(found).axes[0]
    assert axes.get_ylabel().startswith("high end of the interval of the\n")
    assert axes.lines[-3].get_ydata() == [float(found["friction_coefficient_high"][0])]


@pytest.mark.parametrize("body", ["", "first"])
def test_the_height_of_a_finish_is_chosen_and_its_design_is_predicted(body):
    found = case({"target": "friction_coefficient", "value": 0.5}, {}, model=None, effort=2)
    rough = {"finish": "polished", "rms_height": "48 nm"}
    found["contact"]["roughness"] = {body: rough} if body else rough
    height = {"rms_height": {"low": "20 nm", "high": "80 nm"}}
    found["design"]["choose"] = {"roughness": {body: height} if body else height}
    best = design(found).isel(design=0)
    name = ".".join(filter(None, ("roughness", body, "rms_height")))
    rough["rms_height"] = f"{float(best[name])!r} m"
    again = predict({key: one for key, one in found.items() if key != "design"}, load=LOAD)
    assert float(best["friction_coefficient"]) == pytest.approx(again.friction_coefficient.item(), rel=1e-9)
    assert 20e-9 <= float(best[name]) <= 80e-9
