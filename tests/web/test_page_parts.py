"""Parts of the page without a page: what is ready before it is asked, charts at every width, studies that end, digits."""

import asyncio
import math
import re
import subprocess
import sys
import threading
import time
from pathlib import Path

import matplotlib
import pytest
from matplotlib.figure import Figure

import stiction as st
import stiction.web
import stiction.web.explorer as explorer_module
from cases import of_one_model
from stiction.engine.compiled import lazy_kernel
from stiction.quantities.errors import InputError
from stiction.report.html_report import report_record
from stiction.studies.report_data import collect_report_data
from stiction.web.background import Progress
from stiction.web.chart_layout import fitted
from stiction.web.charts import chart, curve_chart, curve_legend, line
from stiction.web.explorer import Explorer
from stiction.web.fields import first_case
from stiction.web.pictures import drawing_of
from stiction.web.query import Query, answered, headline, solved
from stiction.web.share_tab import report_of
from stiction.web.studies_tab import run_design_study


@pytest.fixture(scope="module")
def answer():
    return solved(Query(of_one_model()))


def test_laws_are_imported_before_the_server_answers():
    code = (
        "import sys; from stiction.web import query, server; of = server.query_of(None)\n"
        "before = set(sys.modules); case = query.read_query(of)\n"
        "query.law_names(case), query.option_values(query.solved(of).data)\n"
        "print(sorted(one for one in set(sys.modules) - before if one.startswith('stiction')))"
    )
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True, timeout=300)
    assert found.stdout.strip() == "[]"


def test_an_answer_is_kept_only_if_its_case_names_no_file(tmp_path):
    tables = {**of_one_model(), "title": "kept"}
    first, again = (answered(Query(tables, folder)) for folder in (Path("a"), Path("b")))
    assert again.data is first.data and again.query.folder == Path("b")
    other = answered(Query({**tables, "title": "another"}))
    assert other.data is not first.data and other.data.attrs["case"] == "another"
    file, names = tmp_path / "own.toml", frozenset({"own.toml"})
    query = Query(tables | {"materials": "own.toml", "contact": tables["contact"] | {"first": "own"}}, tmp_path, names)
    found = []
    for hardness in ("3 GPa", "6 GPa"):
        own = f'[materials.own]\nyoungs_modulus = "210 GPa"\npoissons_ratio = 0.3\nhardness = "{hardness}"\n'
        file.write_text(own, encoding="utf-8")
        found.append(answered(query).case.subject.first.hardness)
    assert [float(one) for one in found] == pytest.approx([3e9, 6e9])


# Of the frameworks, or of the page for its own use.
OTHER = {"no-wrap", "text-negative", "items-stretch"}


def test_a_prediction_of_several_contacts_is_refused():
    tables = first_case()
    tables["contact"]["work_of_adhesion"] = ["0.1 J/m^2", "0.5 J/m^2"]
    with pytest.raises(st.InputError, match=r"contact\.work_of_adhesion: .*; allowed: one number for a prediction on a page"):
        answered(Query(tables))


def test_every_class_that_is_used_is_in_the_style_of_the_page():
    """No library makes styles in the browser: a class that nobody defines does nothing."""
    folder = Path(stiction.web.__file__).parent
    style = (folder / "page.py").read_text(encoding="utf-8")
    used = {
        name
        for path in folder.glob("*.py")
        for text in re.findall(r"classes\(\s*\"([^\"]*)\"", path.read_text(encoding="utf-8"))
        for name in text.split()
    }
    assert len(used) > 30
    assert {one for one in used - OTHER if f".{one} " not in style} <= {"where"}


def _chart(names, **y):
    series = [line(name, [1.0, 2.0], [3.0, 4.0], at) for at, name in enumerate(names)]
    return chart("a chart", {"name": "x"}, {"name": "y", **y}, series, False)


def test_a_legend_has_the_room_that_its_names_take():
    """Every name takes the width that is stated, and its mark: what is drawn begins below the last line of them."""
    found = fitted(_chart([f"{letter} of what is drawn" for letter in "abcdef"]), 420)["media"][1]["option"]
    beside = 420 // (found["legend"]["textStyle"]["width"] + 40)
    assert beside == 2 and found["grid"]["top"] >= 20 * 6 / beside
    alone = fitted(_chart(["a name of so many letters that nothing else stands beside", "b", "c"]), 420)
    alone = alone["media"][1]["option"]
    assert alone["legend"]["textStyle"]["width"] > 210 and alone["grid"]["top"] >= 20 * 3


def test_a_chart_fits_a_telephone_and_a_wide_page():
    found = fitted(_chart(["first", "second"]))
    narrow, wide = (one["option"] for one in found["media"])
    assert found["media"][0]["query"] == {"maxWidth": 420} and "query" not in found["media"][1]
    assert narrow["grid"]["left"] < wide["grid"]["left"] == found["grid"]["left"]
    assert narrow["xAxis"]["splitNumber"] < wide["xAxis"]["splitNumber"]
    long = fitted(_chart(["a name that takes more than a line of a legend on a telephone, so that it is broken", "b"]))
    assert long["media"][0]["option"]["grid"]["top"] >= narrow["grid"]["top"] + 40  # two lines more
    named = fitted(_chart(["one"], type="category", data=["a model"]))["media"][0]["option"]
    assert named["yAxis"]["axisLabel"]["inside"] and named["grid"]["left"] < 20
    scale = {"min": 0, "max": 1, "right": 0}
    coloured = fitted(_chart(["one"]) | {"visualMap": scale})["media"]
    assert coloured[0]["option"]["visualMap"]["orient"] == "horizontal"
    assert coloured[0]["option"]["grid"]["bottom"] > narrow["grid"]["bottom"]
    assert fitted({"grid3D": {}}) == {"grid3D": {}}


def test_panels_of_a_picture_stand_below_one_another_on_a_narrow_page():
    figure = Figure(figsize=(12.0, 4.0), layout="constrained")
    left, right = figure.subplots(1, 2)
    with matplotlib.rc_context():
        assert '<svg role="img" aria-label="two &lt;panels&gt;"' in drawing_of(figure, "two <panels>", narrow=True)
    assert figure.get_figwidth() < 6.0 and left.get_position().y0 > right.get_position().y1


_nothing = lazy_kernel(10**12)(lambda numbers: None)


def _endless(progress):
    """A step that never asks its progress whether it may go on, but runs kernels."""
    while True:
        time.sleep(0.002)
        _nothing(0.0)


@pytest.mark.parametrize("objective", [0.0, -1.0, math.nan, math.inf])
def test_a_wish_that_no_friction_can_be_is_refused(objective):
    with pytest.raises(InputError, match=r"target mu: .*; allowed: a number above 0"):
        run_design_study(Query(first_case()), "1 N", objective, {}, Progress())


def test_a_text_in_place_of_a_table_is_refused_in_plain_words():
    with pytest.raises(InputError) as caught:
        solved(Query({"contact": "x", "solve": {"load": ["1 N"]}}))
    assert str(caught.value) == "contact: 'x'; allowed: a table of named numbers"


def test_a_study_ends_within_a_step_when_it_is_stopped():
    progress = Progress()
    threading.Timer(0.2, progress.stop).start()
    with pytest.raises(KeyboardInterrupt):
        progress.watched(_endless)
    assert not progress.too_long


def test_a_study_ends_within_a_step_after_its_time_which_begins_with_it():
    progress = Progress(seconds=0.3)
    time.sleep(0.4)  # others have their turn
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        progress.watched(_endless)
    assert progress.too_long and time.monotonic() - began > 0.25
    assert Progress(seconds=60.0).watched(lambda progress: 3) == 3


def test_a_study_is_not_stopped_within_a_library():
    """It might hold a lock there, for ever: one of Numba's once kept every later computation of the server waiting."""
    progress, done = Progress(), []

    def work(progress):
        progress.stop()
        time.sleep(0.05)
        done.append("library")
        _nothing(0.0)
        done.append("study")

    with pytest.raises(KeyboardInterrupt):
        progress.watched(work)
    assert done == ["library"]


def test_a_study_that_is_stopped_before_its_turn_does_not_begin():
    progress = Progress()
    progress.stop()
    with pytest.raises(KeyboardInterrupt):
        progress.watched(lambda progress: pytest.fail("it began"))


def test_the_report_is_stopped(answer):
    stopped = Progress()
    stopped.stop()
    with pytest.raises(KeyboardInterrupt):
        report_of(answer, stopped)


def test_mu_has_the_same_digits_on_the_page_and_in_the_report(answer):
    at = answer.middle()
    load = float(answer.curve["load"].values[at])
    found = collect_report_data(answer.case, load=load)
    said = report_record(found)
    number, where = headline(answer, at)
    assert number == f"mu ≈ {said['friction_coefficient_rounded']}"
    assert where.endswith(f"mu to four digits {said['friction_coefficient']:.4g}")


def test_where_the_surfaces_meet_their_separation_is_zero(answer):
    """Mean separations from 4 to -1 standard deviations in steps of 0.1: the 41st is 0, not the rounding of it."""
    assert "mean separation 0 m," in headline(answer, 40)[1]
    assert "mean separation 4.8 nm," in headline(answer, 39)[1] and "mean separation -4.8 nm," in headline(answer, 41)[1]


def test_a_chart_has_symbols_on_its_axes_and_the_number_at_its_mark(answer):
    """Silver film on hardened steel: mu 0.0457 at 2.36 N, by the first screen; drawn by a browser from these options."""
    at = answer.middle()
    options = curve_chart(answer.curve, "friction_coefficient", "load", at, False)
    assert options["xAxis"]["name"] == "normal load P [N]" and options["yAxis"]["name"] == "friction coefficient μ (log)"
    separations = curve_chart(answer.curve, "contact_area", "mean_separation", at, False)
    assert separations["xAxis"]["name"] == "mean separation d [nm]"
    assert separations["yAxis"]["name"] == "real contact area A [mm²]"
    load, mu = options["series"][-1]["data"][0]
    told, where = headline(answer, at)
    assert told == f"mu ≈ {mu:.2g}" and f"at a load of {load:.4g} N" in where and where.endswith(f"four digits {mu:.4g}")
    case = st.read_case(Path(__file__).parents[2] / "examples" / "silver_on_steel.toml")
    assert float(st.solve(case.subject, load=f"{load!r} N")["friction_coefficient"]) == pytest.approx(mu, rel=1e-9)


@pytest.mark.parametrize("name", ["friction_coefficient", "friction_force", "contact_area"])
def test_a_chart_of_a_prediction_has_its_band_and_an_axis_name_that_fits_a_telephone(name):
    case = first_case() | {"solve": {"load": ["1 N", "10 N", "3 N"]}}
    answer = solved(Query(case))
    options = curve_chart(answer.curve, name, "load", answer.middle(), False)
    median, low, high, band, mark = options["series"]
    ends = st.predict(first_case(), load="10 N")
    per = 1e-6 if options["yAxis"]["name"].endswith("[mm²]") else 1.0
    drawn = [per * one["data"][2][1] for one in (low, median, high)]
    assert drawn == pytest.approx([float(ends[name + end]) for end in ("_low", "", "_high")], rel=1e-9)
    assert [x for x, _ in median["data"]] == [1.0, 3.0, 10.0] and mark["data"][0][0] == 10.0
    assert str(high["data"][1][1]) in band[":renderItem"] and not options["legend"]["show"]
    legend = re.findall("</svg> ([^<]*)<", curve_legend(answer.curve, False))
    assert legend == [median["name"], band["name"], mark["name"]] == ["median", "90% interval", "working load"]
    assert 6.5 * len(options["yAxis"]["name"]) < 200  # pixels of letters, and of the axis


def test_digits_are_those_that_the_draws_leave():
    tables = of_one_model()
    tables["contact"]["work_of_adhesion"] = {"median": "1 J/m^2", "factor": 3}
    tables["uncertainty"] = {"count": 64}
    answer = solved(Query(tables))
    band = answer.curve["friction_coefficient_quantile"].values[:, answer.middle()]
    assert band[-1] > 2.0 * band[0]
    assert re.fullmatch(r"mu ≈ 0\.0\d", headline(answer, answer.middle())[0])


def test_what_a_slider_passes_within_a_second_is_undone_at_once(answer, monkeypatch):
    clock = [100.0]
    monkeypatch.setattr(explorer_module.time, "monotonic", lambda: clock[0])
    explorer = Explorer(answer.query, answer)

    async def slide():
        for at, load in ((100.0, "1 mN"), (100.4, "2 mN"), (100.8, "3 mN"), (102.0, "4 mN")):
            clock[0] = at
            await explorer.put(("solve", "load"), [load])
        states = []
        for _ in range(2):
            await explorer.undo()
            states.append(explorer.query.tables["solve"].get("load"))
        return states

    assert asyncio.run(slide()) == [["3 mN"], answer.query.tables["solve"].get("load")]
