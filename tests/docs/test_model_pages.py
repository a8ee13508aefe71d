"""A model is its file, its table of reference numbers with the script that made it, and its bibliography entries.

All else that is said of it is made from these: the pages are up to date (test_pages.py), nothing is missing in them, and every
model has its table and its sources, found by rule.
"""

import re

import pytest
from pages import ROOT, make_tables

import stiction as st
from stiction.records.registry import records, text_of
from stiction.records.sources import bibliography

MADE = [(script, table) for script, tables in make_tables.tables_made().items() for table in tables]
# Ways of finding asperities are held to closed forms of surfaces (tests/contract/test_asperity_records.py), not to tables.
TABLED = [record for record in records() if record.kind != "asperity method"]
each_record = pytest.mark.parametrize("record", records(), ids=lambda record: f"{record.kind}-{record.key}")
each_tabled = pytest.mark.parametrize("record", TABLED, ids=lambda record: f"{record.kind}-{record.key}")

# What the docstring of a model's file has, and what stands there.
LAYOUT = {
    "*Assumes*": "what it assumes",
    "$$": "its equations",
    "*Source": "which source they are from",
}
OF_GRADE_C = re.compile(r"\*(Reconstruct(ed|ion)|[Uu]nknown)\*")


def heading(record):
    return make_tables.heading({"key": record.key, "kind": record.kind})


@each_record
def test_file_says_what_is_to_be_known(record):
    """docs/adding-smooth-segments.md describes the layout. One line says what is missing."""
    text = text_of(record)
    assert text, f"{record.key}: the module with its record has no docstring"
    missing = [f"{what} ({mark})" for mark, what in LAYOUT.items() if mark not in text]
    if record.grade == "C" and not OF_GRADE_C.search(text):
        missing.append("what was reconstructed or is not known (*Reconstructed*, *Unknown*)")
    if not re.match(r"[^\n]+[.?]$", text, flags=re.MULTILINE):
        missing.append("a first line that is a title")
    assert not missing, f"{record.key}: the docstring of its file lacks {' and '.join(missing)}"


@each_record
def test_names_in_brackets_are_in_the_bibliography(record):
    named = set(re.findall(r"\[([a-z_]+_\d{4}\w*)\](?!\()", text_of(record)))
    assert named <= bibliography().keys() | record.entries.keys(), f"{record.key}: {named - bibliography().keys()}"


@each_record
def test_record_of_every_model_is_stated(record):
    """Source, grade, validity, and what verified it; test_site.py checks the page around it."""
    text = make_tables.record_lines(next(row for row in st.models() if (row["key"], row["kind"]) == (record.key, record.kind)))
    assert f"- Grade {record.grade}: " in text
    assert all(f"- Source: {source}" in text for source in record.sources)
    assert f"- Checked against: {record.verified}" in text
    assert text.count("- Valid for: ") == max(len(record.validity), 1)
    assert "- Reference values: " in text or record not in TABLED


@each_record
def test_list_of_models_leads_to_the_file_of_every_model(record):
    file = make_tables.file_of({"key": record.key, "kind": record.kind})
    assert (ROOT / file).exists()
    models = (ROOT / "docs" / "reference" / "models.md").read_text(encoding="utf-8")
    assert f"| [`{record.key}`](../../{file.as_posix()}) | {record.title} |" in models


@each_tabled
def test_model_has_a_reference_table(record):
    """reference/KEY.csv, or one of which its script says that it is of this model; asperity laws have the former."""
    tables = make_tables.reference_tables(record)
    assert tables, f"{record.key}: reference/{record.key}.csv is missing, or the line of it in the script that makes it"
    if record.kind == "asperity":
        assert f"{record.key}.csv" in tables, f"{record.key}: reference/{record.key}.csv is missing"


def test_every_reference_table_says_where_it_comes_from():
    """In one script, which writes it and exists; and no script speaks of a table that does not."""
    folder = ROOT / "reference"
    assert sorted(table for _, table in MADE) == sorted(path.name for path in folder.glob("*.csv"))
    for script, table in MADE:
        code = (folder / script).read_text(encoding="utf-8").split('"""', 2)[2]
        assert table.removesuffix(".csv") in code, f"{script} does not write {table}"


def test_every_table_is_of_a_model():
    """What stands after "of" in a script is the heading of a model."""
    known = {heading(record) for record in records()}
    for script, tables in make_tables.tables_made().items():
        for table, models in tables.items():
            assert models <= known, f"{script}: {table} is of {models - known}"
