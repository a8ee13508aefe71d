"""What a hostile visitor tries: folders in names of uploads, files of others and of this machine, markup in names.

What needs a running server or a browser is in test_guard.py, test_address.py, test_serve.py and test_browser.py.
"""

import os
from html.parser import HTMLParser
from pathlib import Path

import pytest

from stiction.quantities.errors import InputError
from stiction.report.views.prediction import prediction_view
from stiction.web.address import files_named
from stiction.web.answer_card import card_on_page
from stiction.web.explorer import Explorer
from stiction.web.fields import first_case
from stiction.web.pictures import drawing_of
from stiction.web.query import Query, read_query, solved

MARKUP = '"><img src=x onerror=alert(1)><script>alert(1)</script>'
STRENGTH = {"samples": "values.csv", "unit": "MPa"}


@pytest.fixture(scope="module")
def answer():
    query = Query(first_case())
    return solved(query)


@pytest.fixture
def visitor(answer):
    explorer = Explorer(answer.query, answer)
    yield explorer
    explorer.close()


class Elements(HTMLParser):
    """The names of all elements and attributes of a page."""

    def __init__(self, text):
        super().__init__()
        self.names, self.attributes = set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.names.add(tag)
        self.attributes |= {name for name, _ in attrs}


@pytest.mark.parametrize(
    "name",
    ["../../evil.sh", "/etc/cron.d/evil.npy", "..\\..\\evil.npy", "a\0b.npy", ".npy", "x." + "y" * 5000, MARKUP, ""],
)
def test_an_upload_stays_in_the_folder_of_its_visitor(visitor, name):
    path = Path(visitor.upload(name, b"content"))
    folder = path.parent
    assert path.resolve() == path and path.read_bytes() == b"content" and path.name.partition(".")[0] == "upload"
    assert [file.name for file in folder.iterdir()] == [path.name] and len(path.name) < 30
    if os.name == "posix":
        assert folder.stat().st_mode & 0o077 == 0  # no other user of this machine reads it


def test_no_visitor_reads_the_upload_of_another(answer):
    mine, other = Explorer(answer.query, answer), Explorer(answer.query, answer)
    try:
        path = mine.upload("scan.npy", b"secret")
        assert Path(other.upload("scan.npy", b"other")).parent != Path(path).parent
        tables = first_case()
        tables["contact"]["roughness"] = {"first": {"file": path, "size": "1 um"}}
        with pytest.raises(InputError, match="a file of the served case") as caught:
            read_query(other.query.with_tables(tables))
        assert str(Path(path).parent) not in caught.value.allowed
    finally:
        mine.close()
        other.close()
    assert not Path(path).parent.exists()


@pytest.mark.parametrize("where", ["materials", "scan", "sweep", "samples"])
def test_no_state_reads_a_file_of_this_machine(where, tmp_path):
    secret = tmp_path / "secret.toml"
    secret.write_text("[secret]\n")
    tables = first_case()
    if where == "materials":
        tables["materials"] = str(secret)
    elif where == "scan":
        tables["contact"]["roughness"] = {"first": str(secret)}
    elif where == "sweep":
        tables["sweep"] = {"roughness": [str(secret)]}
    else:
        tables["contact"]["interfacial_shear_strength"] = STRENGTH | {"samples": str(secret)}
    assert files_named(tables) == [str(secret)]
    with pytest.raises(InputError, match="a file of the served case"):
        read_query(Query(tables))


@pytest.mark.parametrize(
    ("name", "content", "tables"),
    [
        ("own.toml", b"x = [", {"materials": "own.toml"}),
        ("scan.npy", b"no array", {"contact": {"roughness": {"first": {"file": "scan.npy", "size": "1 um"}}}}),
        ("values.csv", b"1\n", {"contact": {"interfacial_shear_strength": STRENGTH}}),
        ("", b"", {"materials": "absent.toml"}),
    ],
)
def test_no_message_names_a_folder_of_this_machine(tmp_path, name, content, tables):
    if name:
        (tmp_path / name).write_bytes(content)
    case = first_case()
    case |= {key: value for key, value in tables.items() if key != "contact"}
    case["contact"] |= tables.get("contact", {})
    with pytest.raises(InputError) as caught:
        read_query(Query(case, tmp_path, frozenset(files_named(case))))
    assert str(tmp_path) not in str(caught.value) and str(tmp_path) not in str(caught.value.value)
    assert (name or "absent.toml") in str(caught.value)


def test_markup_in_names_is_text_on_the_card_and_in_pictures():
    tables = first_case() | {"title": MARKUP}
    tables["materials"] = {"evil": {"preset": "hardened_steel_52100", "name": MARKUP, "source": MARKUP}}
    tables["contact"] |= {"first": "evil"}
    found = solved(Query(tables))
    html = card_on_page(found.data).html(why=True)
    view = prediction_view(found.case, found.data, MARKUP)
    drawings = [drawing_of(picture.draw(), picture.description + MARKUP, False) for picture in view.pictures.values()]
    assert drawings
    for text in (html, *drawings):
        elements = Elements(text)
        assert not elements.names & {"img", "script"} and not any(name.startswith("on") for name in elements.attributes)
