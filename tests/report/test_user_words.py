"""What a first user has to understand: validity warnings below pictures, spreads that are none, models that say very little,
words."""

import numpy as np
import pytest
import xarray
from rich.text import Text

import stiction as st
from stiction.case.read import parse_case
from stiction.quantities.errors import InputError
from stiction.quantities.units import to_si
from stiction.report.report_answer import answer_in_words
from stiction.report.swept_pictures import swept_figure
from stiction.report.views.comparison import run_command
from stiction.report.views.run import uncertain_notes
from stiction.report.views.sensitivity import sensitivity_notes
from stiction.studies.case_results import film_of_case
from stiction.studies.report_data import collect_report_data
from stiction.web.fields import example_cases


def _case(thickness="200 nm", **solve):
    tables = example_cases()["Silver film, 200 nm, on hardened steel, with adhesion"]
    tables["contact"]["coating"]["thickness"] = thickness
    tables["solve"] = {"load": ["0.5 N", "1 N"], **solve}
    return tables


def _words(figure):
    return "\n".join(one.get_text() for one in figure.findobj(lambda one: hasattr(one, "get_text")))


def test_a_picture_of_several_numbers_says_what_is_outside():
    data = st.solve_case(parse_case(_case(["100 nm", "200 nm"])))
    assert "outside the range of validity" in _words(swept_figure(data))
    assert "outside the range" not in _words(swept_figure(data.assign_attrs(validity_warnings="[]", outside_validity="")))


def test_draws_are_called_what_they_are():
    attributes = {
        "uncertain_inputs": "x: 1 to 2",
        "uncertainty": "64 points, seed 0",
        "validity_warnings_of_points": '{"y is not 1": 0.333, "area_fraction is not 0 to 0.1: too near": 0.2}',
    }
    said = "\n".join(one for one in uncertain_notes(xarray.Dataset(attrs=attributes)))
    assert "random samples of the uncertain inputs: 64, seed 0" in said
    assert "in 33.3% of the random samples of the inputs: y is not 1" in said
    assert "inputs: real contact area divided by the nominal area is not 0 to 0.1: too near" in said


def test_the_command_of_a_comparison_has_a_load_that_is_read():
    load = xarray.DataArray(np.array([1.0]), dims="point", attrs={"units": "N"})
    data = xarray.Dataset({"load": load}, attrs={"working_load": 2.3604761904761906, "case_file": "a.toml"})
    assert run_command(data, "m").endswith("--load '2.36048 N'")
    for load, said in ((1e-3, "1 mN"), (2.5e-6, "2.5 uN"), (2e4, "20 kN")):
        assert run_command(data.assign_attrs(working_load=load), "m").endswith(f"--load '{said}'")
        assert to_si(said, "load") == pytest.approx(load, rel=1e-12)
    assert run_command(data, "m", exact=True).endswith("--load '2.3604761904761906 N'")


def test_stresses_in_films_of_several_thicknesses_are_refused_in_a_line_that_says_what_to_do():
    case = parse_case(_case(["100 nm", "200 nm"]))
    with pytest.raises(
        InputError, match=r"coating\.thickness: 2 numbers, .* to .*; allowed: a single value; .* one contact per case"
    ):
        film_of_case(case, case.choice)


def test_sensitivity_names_every_law_that_answers():
    case = _case(model="soft_coating_2015", variant="published")
    case["solve"]["load"] = ["1 N"]
    case["contact"]["work_of_adhesion"] = {"median": "1 J/m^2", "factor": 1.2}
    case["uncertainty"] = {"count": 64}
    data = st.sensitivity(case, models=[])
    said = "\n".join(one.plain for one in sensitivity_notes(data) if isinstance(one, Text))
    assert "models: soft_coating_2015 + variant published 100%" in said
    line = next(one for one in said.splitlines() if one.startswith("logarithmic sensitivities: "))
    assert "tangential law soft_coating_2015, film law printed, variant published" in line


def test_uncertain_inputs_that_a_model_does_not_take_do_not_change_its_answer():
    """A law that shears no interface has no use for its strength, which the case states with an error."""
    strength = {"interfacial_shear_strength": "200 +/- 40 MPa"}
    case = _case(model="soft_coating_2015")
    case["contact"] = case["contact"] | strength
    case["uncertainty"] = {"count": 64}
    said = answer_in_words(collect_report_data(parse_case(case)))
    assert "the uncertain inputs give 0.065" in said
