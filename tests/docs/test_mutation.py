"""The script that makes the code wrong: its edits are what they say, and the kill rate that is told was found."""

import ast
import sys

import pytest
from pages import ROOT

sys.path.insert(0, str(ROOT / "mutation"))

import edits as edits_of_text
from targets import LAST, PARTS

TEXT = '''"""Text with 1 + 1."""
LIMIT: float = 2.0


def law(a, b: int = 3) -> float:
    """a + b."""
    if a < b and a > 0.5:
        raise InputError("a", a, "at least 4")
    return -min(a, LIMIT) * f(a, b)[0]
'''


def made(kind: str) -> set[tuple[str, str]]:
    return {(one.old, one.new) for one in edits_of_text.edits(TEXT) if one.kind == kind}


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("operator", {("*", "/")}),
        ("comparison", {("<", "<="), ("<", ">="), (">", ">="), (">", "<=")}),
        ("condition", {("and", "or")}),
        ("minus", {("-", "")}),
        ("function", {("min", "max")}),
        ("arguments", {("a, b", "b, a")}),
        ("index", {("0", "1")}),
        ("constant", {("2.0", "2.02"), ("0.5", "0.505"), ("0", "1")}),
    ],
)
def test_what_is_computed_is_edited_and_nothing_else(kind, expected):
    assert made(kind) == expected


def test_an_edit_changes_one_place():
    for one in edits_of_text.edits(TEXT):
        text = one.of(TEXT)
        assert text == TEXT[: one.start] + one.new + TEXT[one.stop :]
        assert ast.dump(ast.parse(text)) != ast.dump(ast.parse(TEXT))
    with pytest.raises(ValueError, match="the text is not"):
        one.of(TEXT[1:])


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.name)
def test_parts_name_modules_and_tests_that_there_are(part):
    folder = ROOT / "src" / "stiction"
    for pattern in part.modules:
        assert list(folder.glob(pattern)), pattern
    for test in (*part.tests, *LAST):
        assert (ROOT / test).exists(), test
    first = next(one for pattern in part.modules for one in sorted(folder.glob(pattern)) if one.name != "__init__.py")
    text = first.read_text(encoding="utf-8")
    for one in edits_of_text.edits(text)[:40]:
        ast.parse(one.of(text))


def test_the_kill_rate_that_is_told_was_found():
    import mutate

    (line,) = [
        one for one in (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").splitlines() if one.startswith("Kill rate: ")
    ]
    assert line == mutate.rate(mutate.known()), "python mutation/mutate.py --report says it"
