"""What is drawn where numbers of a case are several: read back from the figures."""

import numpy as np
import pytest

from stiction.case.read import parse_case
from stiction.report.swept_pictures import swept_figure
from stiction.report.swept_tables import combinations_shown, swept_table
from stiction.report.views.run import run_view
from stiction.studies.case_results import solve_case


def solved(indices, load=(0.001, 0.01), **more):
    return solve_case(parse_case({"indices": {"lam": 10, **indices}, "solve": {"load": list(load), **more}}))


def test_one_quantity_is_curves_at_each_load():
    data = solved({"theta": [20, 40, 80]})
    against_theta, against_load = swept_figure(data, "title").axes
    assert [text.get_text() for text in against_theta.get_legend().get_texts()] == ["P = 0.001", "P = 0.01"]
    for line, at in zip(against_theta.lines, range(2), strict=True):
        np.testing.assert_array_equal(line.get_xdata(), [20, 40, 80])
        np.testing.assert_array_equal(line.get_ydata(), data["friction_coefficient"][:, at])
    assert len(against_load.lines) == 3
    assert r"\theta" in against_theta.get_xlabel() and r"\mu" in against_theta.get_ylabel()


def test_a_short_quantity_is_a_line_for_each_value_against_a_long_one():
    data = solved({"theta": [20, 40, 80], "lam": {"start": 1, "stop": 100, "count": 5, "spacing": "log"}})
    figure = swept_figure(data)
    first, second = figure.axes
    for axes, place in ((first, 0), (second, 1)):
        low, high = axes.get_ylim()
        assert all(low <= y <= high for line in axes.lines for y in line.get_ydata())  # of a panel whose values are larger, too
        assert axes.get_xscale() == "log" and r"\lambda" in axes.get_xlabel()
        drawn = [line.get_ydata() for line in axes.lines]
        np.testing.assert_array_equal(drawn, data["friction_coefficient"].transpose("theta", "lam", "load")[..., place])
    (legend,) = figure.legends
    assert first.get_title() == "P = 0.001" and [text.get_text() for text in legend.get_texts()] == ["20", "40", "80"]


def test_two_long_quantities_are_a_map_at_each_load():
    theta = {"start": 20, "stop": 80, "count": 7}
    data = solved({"theta": theta, "lam": {"start": 1, "stop": 100, "count": 8, "spacing": "log"}})
    first, second, bar = swept_figure(data).axes
    for axes, at in ((first, 0), (second, 1)):
        drawn = axes.collections[0].get_array()
        np.testing.assert_array_equal(np.ma.getdata(drawn), data["friction_coefficient"].values[..., at])
    assert first.get_xscale() == "log" and first.get_yscale() == "linear"
    assert r"\lambda" in first.get_xlabel() and r"\theta" in first.get_ylabel() and r"\mu" in bar.get_ylabel()


def test_more_are_small_multiples_at_the_middle_load():
    film = {"n_E": [0.5, 1.0], "n_H": [0.5, 1.0], "tau": [1.0, 2.0, 4.0]}
    data = solved({"theta": [20, 40, 80, 160], **film}, load=[0.001, 0.01, 0.1])
    *panels, _bar = swept_figure(data).axes
    assert len(panels) == 4  # of n_E and n_H; theta and tau have most values
    last = np.ma.getdata(panels[-1].collections[0].get_array())
    wanted = data["friction_coefficient"].isel(load=1, n_E=1, n_H=1).transpose("theta", "tau")
    np.testing.assert_array_equal(last, wanted)
    assert "n_E = 1" in panels[-1].get_title() and "P = 0.01" in panels[-1].get_title()


def test_a_model_of_contact_only_shows_the_area():
    data = solved({"theta": [20, 40]}, model="greenwood_williamson_1966", tangential="none")
    np.testing.assert_array_equal(swept_figure(data).axes[0].lines[0].get_ydata(), data["contact_area"][:, 0])


def test_where_mu_is_not_defined_nothing_is_drawn():
    data = solve_case(parse_case({"indices": {"theta": [0.5, 0.6], "lam": 10}, "solve": {"separation": [3.0, 3.5]}}))
    assert not np.isfinite(data["friction_coefficient"]).any()  # adhesion pulls: the load is tensile
    assert all(not axes.lines for axes in swept_figure(data).axes)


@pytest.mark.parametrize(("count", "rows"), [(3, 3), (100, 9)])
def test_the_table_has_a_row_for_each_value_or_some_of_them(count, rows):
    theta = {"start": 20, "stop": 80, "count": count}
    table = swept_table(solved({"theta": theta}))
    assert len(table.rows) == rows
    first = [row[0] for row in table.rows]
    assert (str(first[0]), str(first[-1])) == ("20", "80")


def test_rows_and_loads_that_are_left_out_are_counted():
    case = parse_case({"indices": {"theta": [20, 30, 40, 50], "lam": [5, 10]}, "solve": {"load": [1, 2, 3, 4, 5]}})
    data = solve_case(case)
    words = "6 of 8 combinations and 4 of 5 loads are shown; --all-rows shows all combinations"
    assert combinations_shown(data, "--all-rows").startswith(words) and len(swept_table(data).rows) == 6
    assert any(str(part).startswith(words) for part in run_view(case, data).parts())
    assert combinations_shown(solved({"theta": [20, 40]}), "--all-rows") == ""
