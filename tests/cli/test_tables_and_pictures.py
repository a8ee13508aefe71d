"""What `run` shows and writes says what it leaves out, and its validity warnings: rows, the table for spreadsheets,
pictures."""

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

import stiction as st
from cases import STEEL_ON_STEEL
from stiction.cli import app
from stiction.laws.validity import warnings_of
from stiction.report.files import comments_of, write_csv
from stiction.report.html_words import letters
from stiction.report.pictures import curve_figure, warnings_below


def run(case, *words) -> str:
    result = CliRunner().invoke(app, ["run", str(case), *map(str, words)], terminal_width=400)
    assert result.exit_code == 0, result.output
    return result.output


@pytest.fixture
def case(tmp_path):
    """A file for this number of loads."""

    def write(count: int):
        loads = [f"{0.1 * (1 + at)} N" for at in range(count)]
        (tmp_path / "case.toml").write_text(
            f"title = 'with # in it'\n{STEEL_ON_STEEL}\n[solve]\nmodel = 'soft_coating_2015'\nload = {loads}\n"
        )
        return tmp_path / "case.toml"

    return write


def rows(text: str) -> int:
    lines = text.splitlines()
    head = next(at for at, line in enumerate(lines) if line.startswith("separation"))
    return next(at for at, line in enumerate(lines[head + 2 :]) if not line.strip())


def test_how_many_rows_are_shown_is_said(case):
    text = run(case(30), "--details")
    assert rows(text) == 12 and "12 of 30 points are shown; --all-rows shows all" in " ".join(text.split())
    whole = run(case(30), "--details", "--all-rows")
    assert rows(whole) == 30 and "are shown" not in whole
    few = run(case(3), "--details")
    assert rows(few) == 3 and "are shown" not in few


@pytest.mark.usefixtures("no_pictures")
def test_the_table_begins_with_what_it_is_and_pandas_reads_it(case, tmp_path):
    run(case(3), "--out", tmp_path / "out")
    path = tmp_path / "out" / "curve.csv"
    table = pd.read_csv(path, comment="#")  # older ones read a last bit wrong
    read = st.read_case(case(3))
    solved = st.solve_case(read)
    np.testing.assert_allclose(table["friction_coefficient"], solved["friction_coefficient"], rtol=4e-16)
    np.testing.assert_allclose(table["load [N]"], solved["load"], rtol=4e-16)
    said = [line[2:] for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
    assert "title: with # in it" in said and any(line.startswith("model: soft_coating_2015, asperity law ") for line in said)
    assert any(line.startswith("grade: C: ") for line in said)
    assert [line.removeprefix("validity warning: ") for line in said if line.startswith("validity warning: ")] == [
        str(one) for one in warnings_of(solved)
    ]
    inputs = dict(line.removeprefix("input: ").split(" = ") for line in said if line.startswith("input: "))
    contact = st.Contact(
        first={name.partition(".")[2]: text for name, text in inputs.items() if name.startswith("first.")},
        second={name.partition(".")[2]: text for name, text in inputs.items() if name.startswith("second.")},
        roughness={name.partition(".")[2]: text for name, text in inputs.items() if name.startswith("roughness.")},
        **{name: text for name, text in inputs.items() if "." not in name},
    )
    for name in ("work_of_adhesion", "nominal_area", "interfacial_shear_strength"):
        assert getattr(contact, name) == getattr(read.subject, name)
    assert contact.roughness == read.subject.roughness
    assert {line.split(":")[1].strip() for line in said if line.startswith("column: ")} == set(map(str, solved.variables))
    assert any(line == "column: load: normal load, adhesion included [N]" for line in said)


def test_a_result_without_warnings_says_so(tmp_path):
    result = st.solve(st.Indices(theta=40, lam=10), load=[1e-3, 2e-3]).assign_attrs(validity_warnings="[]")
    assert "validity warning: none: within the claimed ranges" in comments_of(result)
    write_csv(result, tmp_path / "plain.csv")
    assert not (tmp_path / "plain.csv").read_text().startswith("#")


def contact(**changes) -> st.Contact:
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    given = {"first": "iron", "second": "iron", "work_of_adhesion": "0.1 J/m^2", "nominal_area": "1 mm^2", "roughness": rough}
    return st.Contact(**given | changes)


def test_the_picture_carries_the_warnings_below_its_panels():
    result = st.solve(contact(), load=["1 N", "300 N"])
    figure = curve_figure(result)
    text = " ".join(" ".join(one.get_text() for one in figure.texts).split())
    validity_warnings = [letters(str(one)) for one in warnings_of(result)]
    assert validity_warnings and all(" ".join(one.split()) in text for one in validity_warnings[:5])
    figure.canvas.draw()
    below = max(one.get_window_extent().y1 for one in figure.texts if "outside the range" in one.get_text())
    assert below <= min(axes.get_tightbbox().y0 for axes in figure.axes)  # nothing lies over the labels
    left = figure.bbox.x1
    assert all(one.get_window_extent().x1 <= left for one in figure.texts)
    without = curve_figure(result.assign_attrs(validity_warnings="[]"))
    assert not any("outside the range" in one.get_text() for one in without.texts)


def test_many_warnings_are_counted():
    from stiction.laws.validity import with_warnings
    from stiction.records.validity_warning import ValidityWarning

    many = [ValidityWarning(f"warning {at}") for at in range(8)]
    result = with_warnings(st.solve(contact(), load="1 N").assign_attrs(validity_warnings="[]"), many)
    lines = warnings_below(result, 100)
    assert lines[0].startswith("outside the range") and "warning 4" in lines and "warning 5" not in lines
    assert lines[-1].startswith("and 3 more validity warnings")


@pytest.mark.parametrize(("count", "marked"), [(1, True), (3, True), (20, True), (60, False)])
def test_few_points_are_marked(count, marked):
    figure = curve_figure(st.solve(contact(), load=np.geomspace(0.1, 1.0, count)))
    mu = next(axes for axes in figure.axes if "friction coefficient" in axes.get_ylabel()).lines[0]
    assert (mu.get_marker() == "o") == marked and len(mu.get_xdata()) == count
    area = next(axes for axes in figure.axes if "contact area" in axes.get_ylabel()).lines
    assert all(line.get_marker() == "o" for line in area if len(line.get_xdata())) == marked
