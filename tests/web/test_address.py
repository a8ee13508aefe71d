"""The state in the address: what is written is read again, and nothing else is."""

import base64
import random
import tomllib
import zlib
from pathlib import Path

import pytest

from stiction.case.text import as_toml
from stiction.quantities.errors import InputError
from stiction.web.address import decoded, encoded, files_named, refuse_other_files

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_a_case_comes_back_from_its_address(path):
    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    assert decoded(encoded(tables)) == tables
    assert tomllib.loads(as_toml(tables)) == tables


def test_a_title_that_would_be_anything_else_comes_back_as_it_was():
    tables = {"title": '<script>alert("x")</script>\n\\ """ \x01 ü 🦆'}
    assert decoded(encoded(tables)) == tables


def _text(content: bytes) -> str:
    return base64.urlsafe_b64encode(content).decode().rstrip("=")


@pytest.mark.parametrize(
    "text",
    [
        "x", "%%%", "é", "a" * 20_001, _text(b"no zip"), _text(zlib.compress(b"\xff\xfe")), _text(zlib.compress(b"[a")),
        _text(zlib.compress(b"title = 'whole'")[:-6]), _text(zlib.compress(b"a=" + b"[" * 50_000)),
        _text(zlib.compress(b"a=" + b"9" * 9_000)),
    ],
)  # fmt: skip
def test_what_is_no_state_is_refused_in_a_line(text):
    with pytest.raises(InputError) as caught:
        decoded(text)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


def test_a_bomb_is_not_unpacked():
    import tracemalloc

    bomb = _text(zlib.compress(b"#" * 10_000_000, 9))  # small enough for an address
    assert len(bomb) < 20_000
    tracemalloc.start()
    with pytest.raises(InputError, match="too large"):
        decoded(bomb)
    assert tracemalloc.get_traced_memory()[1] < 3_000_000
    tracemalloc.stop()


def test_garbage_without_end_is_refused_each_time():
    rng = random.Random(0)
    good = encoded({"title": "a title that is long enough to be cut", "solve": {"load": ["1 N"]}})
    for _ in range(2000):
        letters = list(good)
        for _ in range(rng.randint(1, 4)):
            letters[rng.randrange(len(letters))] = rng.choice("abcXYZ019-_%/ ")
        try:
            decoded("".join(letters))
        except InputError:
            continue


FILES = {
    "materials": "my.toml",
    "contact": {
        "roughness": {"first": {"file": "../../etc/passwd"}, "second": "/etc/shadow"},
        "work_of_adhesion": {"samples": "measured.csv"},
    },
    "sweep": {"roughness": ["/root/map.npz", {"file": "/root/other.npz"}]},
}


def test_every_file_that_a_case_names_is_found():
    assert sorted(files_named(FILES)) == [
        "../../etc/passwd", "/etc/shadow", "/root/map.npz", "/root/other.npz", "measured.csv", "my.toml"
    ]  # fmt: skip


def test_files_of_this_machine_are_not_read_for_whoever_writes_an_address():
    names = files_named(FILES)
    refuse_other_files(FILES, names)
    for name in names:
        with pytest.raises(InputError) as caught:
            refuse_other_files(FILES, set(names) - {name})
        assert caught.value.value == name
