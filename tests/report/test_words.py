"""Words and numbers of a report by themselves: digits that count, sources as they are printed, symbols."""

import re

import pytest

from stiction.records.sources import bibliography
from stiction.report.html_words import formula
from stiction.report.printed_sources import printed, tex_to_text
from stiction.report.significant_digits import rounded
from stiction.solving.overview import entries


@pytest.mark.parametrize(
    "value, ends, text",
    [
        # Half the width is 0.06: the second place after the point is the last that says anything.
        (0.1283, [0.10, 0.22], "0.13"),
        # Half the width is 0.12, led by a 1: one place further.
        (0.1607, [0.08, 0.32], "0.16"),
        (0.2, [0.01, 3.0], "0.2"),
        (0.30004, [0.295, 0.305], "0.300"),  # 0.005: the third place
        (0.045621, [0.0456, 0.0457], "0.0456"),  # three at most
        (0.4, [], "0.40"),  # nothing is known: two
        (0.4, [0.4, 0.4], "0.40"),
        (12.3, [5.0, 20.0], "12"),
        (0.02, [0.02, 0.9], "0.02"),  # one at least
        (0.0, [], "0"),
        (float("nan"), [0.1], "not defined"),
        (123456.0, [], "1.2e+05"),
    ],
)
def test_a_number_has_the_digits_that_its_warning_leaves_it(value, ends, text):
    assert rounded(value, ends) == text


def test_no_entry_is_printed_with_its_tex():
    rows = printed(bibliography())
    assert [row.key for row in rows] == list(bibliography())
    for row in rows:
        assert not re.search(r"[\\{}$]|``|''|--", row.text), row


def test_an_entry_is_printed_as_a_reader_knows_it():
    (row,) = printed(["greenwood_williamson_1966"])
    text = "Greenwood, J. A.; Williamson, J. B. P. (1966). Contact of nominally flat surfaces. Proceedings of the Royal Society"
    assert row.text.startswith(text) and row.doi == "10.1098/rspa.1966.0242"
    assert tex_to_text(r"{\v S}ajgal{\'i}k and M{\"u}ser, MoS$_2$, 1--2") == "Šajgalík and Müser, MoS₂, 1–2"


def test_a_source_is_not_taken_for_the_model_of_its_name():
    """A model of that name has more sources; they were not used."""
    assert entries(["maugis_1992"]).count("@") == 1


def test_symbols_are_letters_and_all_else_is_escaped():
    assert formula("(sigma/R)^(1/2)") == "(σ/R)<sup>1/2</sup>"
    assert formula("mu_T") == "μ<sub>T</sub>"
    assert formula("<b>") == "&lt;b&gt;"
    assert formula("number") == "number"  # which has "nu" and "mb", and neither is Greek
