"""One number from names and values, as a cell of a spreadsheet asks for it."""

import shutil
import subprocess
from datetime import datetime

import pytest

import stiction as st
from stiction.quantities.errors import InputError
from stiction.studies.prediction import one_value

CASE = """
contact.first = "copper"
contact.second = "copper"
contact.interface = "oxidised metal"
contact.roughness = { rms_height = "0.2 um", finish = "ground" }
contact.nominal_area = "1 cm^2"
solve.load = ["1 N", "10 N"]
"""
PAIRS = ["first", "copper", "second", "copper", "interface", "oxidised metal", "nominal_area", 1e-4]
PAIRS += ["roughness.rms_height", 2e-7, "roughness.finish", "ground", "load", 10]


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "copper.toml"
    path.write_text(CASE, encoding="utf-8")
    return path


def test_numbers_are_those_of_the_prediction(case):
    answer = st.predict(case, load="10 N")
    for name in ("friction_force", "contact_area_low", "friction_coefficient_high"):
        output = name.replace("friction_coefficient", "mu")
        assert st.predict_value(output, *PAIRS) == pytest.approx(float(answer[name]), rel=1e-9), name


def test_a_case_file_is_changed_by_pairs(case):
    given = ["case", str(case), "load", "10 N", "nominal_area", "2 cm^2", "first.hardness", "0.5 GPa"]
    tables = {
        "first": {"preset": "copper", "hardness": "0.5 GPa"}, "second": "copper", "interface": "oxidised metal",
        "roughness": {"rms_height": "0.2 um", "finish": "ground"}, "nominal_area": "2 cm^2",
    }  # fmt: skip
    answer = st.predict({"contact": tables, "solve": {"load": ["10 N"]}})
    assert st.predict_value("contact_area", *given) == pytest.approx(answer.contact_area.item(), rel=1e-9)


def test_a_changed_file_is_read_again(case):
    before = st.predict_value("contact_area", "case", str(case), "load", 1)
    case.write_text(CASE.replace("copper", "aluminium"), encoding="utf-8")
    assert st.predict_value("contact_area", "case", str(case), "load", 1) != before


def test_cells_share_a_prediction():
    one_value._predicted.cache_clear()
    low, mu, high = (st.predict_value(name, *PAIRS) for name in ("mu_low", "mu", "mu_high"))
    assert low < mu < high and one_value._predicted.cache_info().misses == 1


@pytest.mark.parametrize(
    ("words", "field"),
    [
        (["wear", *PAIRS], "output"),
        (["mu", *PAIRS[:-1]], "pairs"),
        (["mu", *PAIRS, "colour", "red"], "contact.colour"),
        (["mu", *PAIRS[:-1], -1.0], "load"),
        (["mu", "case", "no_such.toml"], "case file"),
    ],
)
def test_refusals(words, field):
    with pytest.raises(InputError) as told:
        st.predict_value(*words)
    assert told.value.field.startswith(field)


def test_two_loads_are_no_cell(case):
    with pytest.raises(InputError, match="2 contacts or loads"):
        st.predict_value("mu", "case", str(case))


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("Rscript", ["-e", 'cat(reticulate::import("stiction")$predict_value("mu", "case", "copper.toml", "load", 10))']),
        (
            "julia",
            ["-e", 'using PythonCall; print(pyimport("stiction").predict_value("mu", "case", "copper.toml", "load", 10))'],
        ),
        ("octave", ["--eval", "pkg load pythonic; disp(py.stiction.predict_value('mu', 'case', 'copper.toml', 'load', 10))"]),
    ],
)
def test_other_languages(case, program, words):
    if shutil.which(program) is None:
        pytest.skip(f"{program} is not installed")
    done = subprocess.run([program, *words], cwd=case.parent, text=True, capture_output=True, check=True)
    assert float(done.stdout) == pytest.approx(st.predict_value("mu", *PAIRS), rel=1e-4)


@pytest.mark.parametrize("cell", [None, ((5.0, 6.0),), True, datetime(2026, 10, 5)])
def test_a_cell_without_a_number_and_a_range_are_refused(cell):
    with pytest.raises(st.InputError) as refused:
        st.predict_value("mu", "load", cell, "first", "copper")
    assert refused.value.field == "load"
