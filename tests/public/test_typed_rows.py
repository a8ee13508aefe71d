"""Dicts that exported functions return have exactly the keys that their types state."""

import stiction as st
from stiction.report.answer import ModelAnswer, PredictionAnswer
from stiction.report.html_report import ReportAnswer
from stiction.solving.overview import ModelRow

CONTACT = {
    "first": "gold", "second": "gold", "nominal_area": "1 mm^2", "interface": "clean metal",
    "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"},
}  # fmt: skip


def test_every_row_of_models_has_the_keys_of_its_type():
    rows = st.models()
    assert all(ModelRow.__required_keys__ <= row.keys() <= ModelRow.__annotations__.keys() for row in rows)
    assert ModelRow.__annotations__.keys() == set().union(*rows)


def test_the_answer_of_a_report_has_the_keys_of_its_type(tmp_path):
    for solve, kind in (({"load": "1 N"}, PredictionAnswer), ({"load": "1 N", "model": "persson_2001"}, ModelAnswer)):
        answer = st.write_report({"contact": CONTACT, "solve": solve}, tmp_path / "report.html")
        assert answer.keys() == ReportAnswer.__annotations__.keys()
        assert answer["answer"].keys() == kind.__annotations__.keys()
