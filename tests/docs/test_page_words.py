"""The README and the pages of docs/ are short and use the terms of docs/reference/glossary.md."""

import re

import pytest
from pages import ROOT, pages

README_WORDS, PAGE_WORDS = 700, 2500
# Words of the house that the field does not know, with what stands for them.
OLD = {
    r"doubt\w*": "validity warning",
    r"wish\w*": "objective",
    r"several": "more than one, an array, a sweep",
    r"knobs?": "slider, field",
    r"rooms?": "package, folder",
    r"readings?": "variant",
    r"set aside": "excluded",
    r"kept": "stored, cached, retained",
    r"told": "stated, determined",
    r"says|said": "states, prints, shows",
    r"elasticit\w+": "logarithmic sensitivity",
    r"strengthening": "ageing",
    r"letting go|lets? go": "separate, unload",
    r"rivals?": "alternative model",
    r"verdicts?": "diagnostics",
    r"(?<!pareto )fronts?": "Pareto front",
    r"of which": "a sentence of its own",
}
_OLD = re.compile(rf"\b({'|'.join(OLD)})\b", re.IGNORECASE)
# No prose: blocks, code in a line, targets of links, and tables made from the texts of src/, which have their own check.
_NO_PROSE = re.compile(
    r"^```.*?^```$|`[^`\n]*`|\]\([^)]*\)|<!-- ([\w ,]+): begin.*?<!-- \1: end -->", flags=re.MULTILINE | re.DOTALL
)
PAGES = [pytest.param(path, id=str(path.relative_to(ROOT))) for path in pages()]


def prose(text: str) -> str:
    return _NO_PROSE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def words(text: str) -> int:
    """Count the words outside of tables: a reference table may be long."""
    return sum(len(line.split()) for line in text.splitlines() if not line.lstrip().startswith("|"))


def test_readme_fits_a_screen_and_a_half():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").split()) <= README_WORDS


@pytest.mark.parametrize("path", PAGES)
def test_page_is_short(path):
    assert words(path.read_text(encoding="utf-8")) <= PAGE_WORDS


@pytest.mark.parametrize("path", [*PAGES, pytest.param(ROOT / "CONTRIBUTING.md", id="CONTRIBUTING.md")])
def test_page_has_no_old_words(path):
    lines = enumerate(prose(path.read_text(encoding="utf-8")).splitlines(), 1)
    found = [f"line {number}: {word[0]}" for number, line in lines for word in _OLD.finditer(line)]
    assert not found, found


def test_old_words_are_found_in_prose_alone():
    text = "A doubt.\n\n```text\nwish\n```\n\n`kept` [a](front.md) Pareto front, front"
    assert [word[0] for word in _OLD.finditer(prose(text))] == ["doubt", "front"]
