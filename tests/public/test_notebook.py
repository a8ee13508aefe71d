"""What a notebook shows of records and results: all numbers with units, sources, and validity warnings; text of users is
escaped."""

from html.parser import HTMLParser

import pytest

import stiction as st
from stiction.laws.validity import warnings_of


class Cells(HTMLParser):
    """The texts of an HTML page; every element has to be closed."""

    def __init__(self, page: str):
        super().__init__()
        self.texts: list[str] = []
        self.open: list[str] = []
        self.feed(page)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        of_cards = ("p", "span", "svg", "line", "rect", "circle", "text", "dl", "dt", "dd", "details", "summary")
        assert tag in ("div", "strong", "table", "tbody", "tr", "th", "td", "ul", "li", *of_cards), tag
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.append(data)


def contact() -> st.Contact:
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    given = {"work_of_adhesion": "0.1 J/m^2", "nominal_area": "1 mm^2", "interfacial_shear_strength": "20 MPa"}
    return st.Contact(first="iron", second={"preset": "silver", "name": "<b>silver</b>"}, roughness=rough, **given)


def test_a_contact_shows_its_numbers_with_units():
    texts = Cells(contact()._repr_html_()).texts
    assert texts[0] == "Contact" and "roughness.asperity_height_deviation" in texts and "second.hardness" in texts
    assert any(text.startswith("48 nm  (standard deviation of the asperity heights") for text in texts)
    assert "<b>silver</b>" in texts  # as text, not as markup
    swept = contact().replace(work_of_adhesion=st.axis("work_of_adhesion", [0.1, 0.2]))
    assert any(
        text.startswith("2 values, 100 mJ/m^2 to 200 mJ/m^2, along work_of_adhesion")
        for text in Cells(swept._repr_html_()).texts
    )


def test_a_material_shows_its_sources():
    iron = st.material("iron")
    texts = Cells(iron._repr_html_()).texts
    assert texts[0] == "Material" and any(text.startswith("hardness: ") for text in texts)
    assert all(f"{field}: {source}" in texts for field, source in iron.source.items() if source)
    assert "source: a book" in Cells(iron.replace(source="a book")._repr_html_()).texts
    assert Cells(st.Indices(theta=40, lam=10)._repr_html_()).texts[0] == "Indices"


def test_a_result_shows_its_warnings_and_what_was_not_used():
    result = st.solve(contact(), load=["1 N", "100 N"], model="soft_coating_2015")
    shown = st.summary(result)
    texts = Cells(shown._repr_html_()).texts
    validity_warnings = [f"validity warning: {one}" for one in warnings_of(result)]
    assert validity_warnings and set(validity_warnings) <= set(texts)
    assert any("interfacial_shear_strength is not used" in text for text in texts)
    assert all(line in repr(shown) for line in validity_warnings) and "soft_coating_2015" in repr(shown)
    load = next(text for name, text in shown.rows if name == "load")
    assert load == "1 to 100 N, along load"
    assert hasattr(result, "_repr_html_")  # that of xarray, as ever


@pytest.mark.parametrize("made", ["compared", "groups", "single"])
def test_every_result_has_a_summary(made):
    if made == "compared":
        result = st.compare(contact(), load="1 N")
    elif made == "groups":
        result = st.solve(st.Indices(theta=40, lam=10), separation=[1.0, 0.0])
    else:
        result = st.solve(contact(), load="1 N", model="greenwood_williamson_1966")
        assert ("load", "1 N") in st.summary(result).rows
    assert Cells(st.summary(result)._repr_html_()).texts


def test_a_prediction_shows_its_answer():
    answer = st.predict(contact(), load="1 N")
    texts = Cells(st.summary(answer)._repr_html_()).texts
    ends = (float(answer[f"friction_coefficient{end}"]) for end in ("", "_low", "_high"))
    mu, low, high = (f"{float(f'{end:.2g}'):g}" for end in ends)
    assert texts[0] == "Prediction" and f"μ = {mu}" in texts[1] and f"{low} to {high}" in "".join(texts)
    lines = repr(st.summary(answer)).splitlines()
    assert answer.attrs["regime"] in " ".join(line.strip() for line in lines) and max(map(len, lines)) <= 100
