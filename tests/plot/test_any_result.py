"""Every result has its picture by one accessor; pictures show the numbers of the result."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray

import stiction as st
from cases import STEEL_ON_STEEL
from stiction.case.read import read_case
from stiction.quantities.errors import InputError
from stiction.report.model_pictures import models_figure
from stiction.report.pictures import canvas, finish, friction_panel
from stiction.report.prediction_pictures import prediction_figure, sources_panel
from stiction.report.regime_pictures import negligible_load_of_jkr, pressures_of_first_flow, regime_figure
from stiction.report.view import regime_picture
from stiction.report.views.comparison import comparison_view
from stiction.report.views.prediction import prediction_view
from stiction.studies.prediction.around import AROUND
from stiction.studies.prediction.measured import Measured

LOADS = '[solve]\nmodel = "greenwood_williamson_1966"\nload = ["0.1 N", "1 N", "10 N"]\n'
DESIGN = """
[design]
objective = { minimise = "friction_coefficient" }
[design.choose.roughness]
asperity_radius = { low = "10 um", high = "100 um" }
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("any") / "case.toml"
    path.write_text(STEEL_ON_STEEL + LOADS + DESIGN)
    return path


@pytest.fixture(scope="module")
def compared(path):
    return st.compare(st.read_case(path).subject, load=1.0)


@pytest.mark.parametrize("name", ["solve", "slide", "predict", "several", "sensitivity"])
def test_every_result_has_a_picture(name, path):
    case = st.read_case(path)
    several = STEEL_ON_STEEL.replace('"1 mm^2"', '["1 mm^2", "2 mm^2", "4 mm^2"]')
    results = {
        "solve": lambda: st.solve_case(case),
        "slide": lambda: st.slide_case(case),
        "predict": lambda: st.predict(path, load="1 N"),
        "several": lambda: st.solve_case(st.read_case(_written(path.with_name("several.toml"), several + LOADS))),
        "sensitivity": lambda: st.sensitivity(path),
    }
    figure = results[name]().stiction.plot()
    assert figure.axes and all(axes.get_xlabel() for axes in figure.axes if axes.lines)


def _written(path, text):
    path.write_text(text)
    return path


def test_what_is_no_result_is_refused():
    with pytest.raises(InputError, match="a dataset that a function of stiction returned"):
        xarray.Dataset({"x": ("y", [1.0])}).stiction.plot()


def test_a_design_is_drawn_against_the_number_that_is_designed(path):
    data = st.design(path)
    (axes,) = data.stiction.plot().axes
    x = np.concatenate([line.get_xdata() for line in axes.lines[:2]])
    assert x.size == data.attrs["evaluated"] and {"search limits", "best"} <= set(axes.get_legend_handles_labels()[1])
    assert axes.lines[1].get_ydata().min() == pytest.approx(float(data["friction_coefficient"][0]), rel=1e-9)
    assert [line.get_xdata()[0] for line in axes.lines[-2:]] == pytest.approx([1e-5, 1e-4])


def test_a_comparison_names_three_models_and_has_dots_at_the_working_load(compared):
    prediction = None
    figure = models_figure(compared, None, prediction)
    (axes,) = figure.axes
    labels = axes.get_legend_handles_labels()[1]
    assert len([text for text in labels if text != "other models"]) <= 3 and "other models" in labels
    dots = {round(math.log(line.get_ydata()[0]), 9) for line in axes.lines if len(line.get_xdata()) == 1}
    values = compared["friction_coefficient_at_load"].values
    assert dots <= {round(math.log(value), 9) for value in values[values > 0.0]} and len(dots) > 3


def test_slopes_stand_beside_a_friction_that_varies_by_a_power():
    load = np.geomspace(1e-3, 1e2, 11)
    data = xarray.Dataset({"friction_coefficient": ("load", 0.1 * load ** (-1 / 3))}, {"load": load})
    _, (axes,) = canvas(5, 4)
    friction_panel(axes, data)
    (line,) = [one for one in axes.lines if "-1/3" in str(one.get_label())]
    slope = np.diff(np.log(line.get_ydata())) / np.diff(np.log(line.get_xdata()))
    assert slope == pytest.approx(-1 / 3) and axes.get_yscale() == "log"


def test_no_axis_has_an_offset():
    figure, (axes,) = canvas(5, 4)
    axes.plot([1.0, 2.0], [0.019541, 0.01954100001])
    finish(axes)
    figure.canvas.draw()
    assert axes.yaxis.get_offset_text().get_text() == ""


def test_a_single_load_stands_on_the_curve_around_it(tmp_path):
    case = read_case(_written(tmp_path / "one.toml", STEEL_ON_STEEL + '[solve]\nload = "1 N"\n'))
    data = st.predict(case)
    mu, low, high = (float(data[f"friction_coefficient{end}"].item()) for end in ("", "_low", "_high"))
    drawn = [
        prediction_view(case, data, "one.toml").pictures["curve.png"].draw(),
        comparison_view(case, st.compare_case(case, load="1 N"), data).pictures["compare.png"].draw(),
    ]
    for figure in drawn:
        (axes,) = figure.axes
        lines = [one for one in axes.lines if len(one.get_xdata()) == len(AROUND) and one.get_linestyle() == "-"]
        line = max(lines, key=lambda one: one.get_linewidth())  # those of single models are thin
        assert line.get_xdata()[[0, 10, -1]] == pytest.approx([0.1, 1.0, 10.0]) and line.get_ydata()[10] == pytest.approx(mu)
        corners = axes.collections[0].get_paths()[0].vertices  # of the band
        at_load = corners[np.isclose(corners[:, 0], 1.0), 1]
        assert [at_load.min(), at_load.max()] == pytest.approx([low, high])


def test_the_parts_of_an_interval_are_shorter_than_it(path):
    data = st.predict(path, load="1 N")
    _, (axes,) = canvas(5, 4)
    sources_panel(axes, data)
    widths = [np.ptp(np.log(bars.get_segments()[0][:, 0])) for bars in axes.collections]
    low, high = (float(data[f"friction_coefficient_{end}"]) for end in ("low", "high"))
    share = max(data.attrs["shares"].values())
    assert widths[:2] == pytest.approx([math.log(high / low), math.sqrt(share) * math.log(high / low)])


def test_the_maps_are_those_of_their_authors(path):
    """Greenwood and Williamson: below psi = .6 plastic flow needs extreme pressures, above 1 nearly none does without."""
    load = negligible_load_of_jkr()
    assert 3.0 + math.sqrt(6.0 * load + 9.0) == pytest.approx(0.05 * load)
    low, high = pressures_of_first_flow(np.array([0.5, 1.5]), 0.04)
    assert low > 0.01 and high < 1e-8
    contact = st.read_case(path).subject
    data = st.solve(contact, load=[1.0], model="greenwood_williamson_1966")
    _, plasticity = regime_figure(contact, data).axes
    (dot,) = [line for line in plasticity.lines if line.get_marker() == "o"]
    assert dot.get_xdata()[0] == pytest.approx(contact.plasticity_index)
    assert dot.get_ydata()[0] == pytest.approx(1.0 / 1e-6 / contact.first.hardness)


def test_a_film_has_no_plasticity_map_of_bare_bodies():
    """The demo is plastic in its soft film, and elastic by the index of the steel below."""
    case = read_case(Path(__file__).parents[2] / "examples" / "soft_film.toml")
    data = st.predict(case)
    assert not case.subject.work_of_adhesion and not regime_picture(case.subject, data, "")
    adhering = case.subject.model_copy(update={"work_of_adhesion": 0.5})
    (figure,) = regime_picture(adhering, data, "").values()
    (adhesion,) = figure.draw().axes
    assert "Tabor" in adhesion.get_xlabel()
    highest = max(line.zorder for line in adhesion.lines)  # the contact is a line across the map here
    assert all(text.zorder > highest and text.get_bbox_patch() for text in adhesion.texts)


def test_measured_friction_is_drawn_with_its_errors(path):
    measured = Measured(np.array([0.2, 5.0]), np.log([0.1, 0.2]), np.array([0.1, 0.2]))
    (axes,) = prediction_figure(st.predict(path), measured=measured).axes
    (bars,) = (bars for bars in axes.containers if bars.get_label().startswith("measured"))
    assert bars.lines[0].get_xdata().tolist() == [0.2, 5.0] and bars.lines[0].get_ydata() == pytest.approx([0.1, 0.2])
    ends = [segment[:, 1] for segment in bars.lines[2][0].get_segments()]
    assert ends == [pytest.approx([0.1 * math.exp(-0.1), 0.1 * math.exp(0.1)]),
                    pytest.approx([0.2 * math.exp(-0.2), 0.2 * math.exp(0.2)])]  # fmt: skip


def test_the_legend_of_a_prediction_covers_no_title(path):
    figure = prediction_figure(st.predict(path), "A title as wide as the picture, of a contact that has a long name")
    figure.canvas.draw()
    (title,) = (text for text in figure.texts if text.get_text().startswith("A title"))
    (legend,) = figure.legends
    assert not legend.get_window_extent().overlaps(title.get_window_extent())
    (axes,) = figure.axes
    low, high = axes.get_ylim()
    assert all(low <= y <= high for line in axes.lines for y in line.get_ydata())
