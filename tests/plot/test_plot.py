"""Pictures: axes with units, and lines that are the numbers of the dataset."""

from pathlib import Path

import matplotlib
import numpy as np
import pytest

from collisions import collisions
from stiction.case.read import read_case
from stiction.contact.contact import Contact, Indices
from stiction.report import pictures as plot
from stiction.report.film_pictures import film_figure
from stiction.report.paper_pictures import claims_figure, panel_figure
from stiction.solving.solve import solve
from stiction.studies.case_results import film_of_case
from stiction.studies.paper import figures as figures
from stiction.studies.paper.claims import claim_map
from stiction.studies.stresses.film_section import film_section
from stiction.studies.stresses.film_stress import middle_point
from stiction.surfaces.roughness import Roughness

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(autouse=True)
def matplotlib_does_its_own_arithmetic(no_silent_nan):
    """It divides zero by zero inside, and looks at the result afterwards."""
    with np.errstate(all="ignore"):
        yield


@pytest.fixture(scope="module")
def silver():
    case = read_case(EXAMPLES / "silver_on_steel.toml")
    return solve(case.subject, separation=case.separation)


@pytest.mark.parametrize("example", ["hard_film_on_steel", "silver_on_steel"])
def test_titles_of_a_film_do_not_collide(example):
    case = read_case(EXAMPLES / f"{example}.toml")
    point = middle_point(film_of_case(case, case.choice.with_changes({"film": "layered"}, {})))
    figure = film_figure(point, film_section(case.subject, point), case.title)
    assert collisions(figure) == []


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def test_a_curve_has_labelled_axes_and_shows_the_numbers(silver):
    figure = plot.curve_figure(silver, "a title")
    friction, area, load, force = figure.axes
    assert "a title" in figure.get_suptitle() and "soft_coating_2015" in figure.get_suptitle()
    for axes in (friction, area, force):
        assert axes.get_xlabel() == "normal load $P$ [N]" and axes.get_xscale() == "log"
    assert area.get_ylabel() == "real contact area $A$ [mm²]"
    assert load.get_xlabel() == "mean separation $d$ [nm]" and load.get_ylabel() == "normal load $P$ [N]"
    np.testing.assert_array_equal(friction.lines[0].get_ydata(), silver["friction_coefficient"])
    np.testing.assert_array_equal(lines(area)["plastic asperities"].get_ydata(), silver["contact_area_plastic"])
    np.testing.assert_array_equal(lines(load)["total"].get_xdata(), silver["mean_separation"])
    np.testing.assert_array_equal(lines(load)["film"].get_ydata(), silver["load_film"])
    np.testing.assert_array_equal(lines(force)["total"].get_ydata(), silver["friction_force"])
    ticks = load.xaxis.get_major_formatter()
    assert ticks(150e-9) == "150"


def test_tension_is_dotted_and_friction_is_drawn_only_under_compression():
    data = solve(Indices(theta=3.0, lam=100.0), separation=np.linspace(4, -4, 33))
    friction, _, load, _ = plot.curve_figure(data).axes
    compressed = data["load"].values > 0.0
    np.testing.assert_array_equal(friction.lines[0].get_xdata(), data["load"].values[compressed])
    assert load.get_xlabel() == r"mean separation $d$ [$\sigma$]"
    assert load.get_ylabel().endswith(r"[$K R^{1/2} \sigma^{3/2}$ per asperity]")
    dotted = [line for line in load.lines if line.get_linestyle() == ":" and len(line.get_xdata())]
    sizes = dotted[0].get_ydata()
    np.testing.assert_array_equal(sizes[~np.isnan(sizes)], -data["load"].values[~compressed & ~np.isnan(sizes)])


def test_a_contact_that_only_pulls_says_so():
    data = solve(Indices(theta=1.0, lam=1e-3), separation=[4.0, 3.0, 2.0])
    assert (data["load"] <= 0.0).all()
    friction = plot.curve_figure(data).axes[0]
    assert "not defined" in friction.texts[0].get_text()


def test_a_model_without_friction_has_two_panels():
    data = solve(Indices(theta=40.0, lam=10.0), separation=[1.0, 0.0], model="greenwood_williamson_1966")
    assert len(plot.curve_figure(data).axes) == 2


@pytest.mark.parametrize("friction", (False, True))
def test_a_model_without_separation_is_drawn_against_load_only(friction):
    steel = "hardened_steel_52100"
    rough = Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    contact = Contact(first=steel, second=steel, work_of_adhesion="0.1 J/m^2", nominal_area="1 mm^2", roughness=rough,
                      interfacial_shear_strength="200 MPa")  # fmt: skip
    law = "bowden_tabor_1943" if friction else "none"
    data = solve(contact, load=["1 N", "2 N"], model="persson_2001", tangential=law)
    axes = plot.curve_figure(data).axes
    assert len(axes) == (3 if friction else 1)
    assert all("load" in one.get_xlabel() for one in axes)
    area = axes[1 if friction else 0]
    np.testing.assert_array_equal(lines(area)["total"].get_ydata(), data["contact_area"])
    if friction:  # mu does not vary, and is seen below the edge
        assert axes[0].get_ylim()[1] > 1.05 * float(data["friction_coefficient"].max())


@pytest.mark.parametrize("panel", figures.PANELS, ids=lambda panel: panel.name)
def test_the_papers_figures_show_films_beside_the_uncoated_surface(panel):
    curves = figures.panel_curves(panel, 40.0, 10.0, "published")
    axes = panel_figure(curves).axes[0]
    assert "not printed in the paper" in axes.get_title() and "published" in axes.get_title()
    drawn = lines(axes)
    assert len(drawn) == 4
    alone = solve(Indices(theta=40.0, lam=10.0), separation=np.linspace(4, -4, 161), variant="published")
    np.testing.assert_array_equal(drawn["uncoated"].get_ydata(), alone["friction_coefficient"])
    value = panel.values[-1]
    film = Indices(theta=40.0, lam=10.0, **{**panel.fixed, panel.along: value})
    alone = solve(film, separation=np.linspace(4, -4, 161), variant="published")
    last = list(drawn.values())[-1].get_ydata()
    shown = ~np.isnan(last)
    np.testing.assert_allclose(last[shown], alone["friction_coefficient"].values[shown], rtol=1e-12)
    np.testing.assert_array_equal(shown, alone["load"].values > 0.0)


def test_the_map_of_the_claims_has_a_panel_for_each_claim_and_reading():
    found = claim_map(np.geomspace(1, 1e4, 3), np.geomspace(1e-3, 1e4, 3))
    figure = claims_figure(found, {"theta": 40.0, "lam": 10.0})
    panels = [axes for axes in figure.axes if axes.collections and axes.get_xscale() == "log"]
    assert len(panels) == 15
    shown = panels[0].collections[0].get_array().reshape(3, 3)
    np.testing.assert_array_equal(np.ma.filled(shown, np.nan), found.share[0, 0].T)
    assert "theta" in panels[-1].get_xlabel() and "published" in panels[5].get_ylabel()
    assert "film solved as a layer" in panels[10].get_ylabel()


def test_no_global_state_is_touched(silver):
    before = dict(matplotlib.rcParams)
    plot.curve_figure(silver)
    assert dict(matplotlib.rcParams) == before
