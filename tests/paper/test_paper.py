"""The paper: its numbers are what the package computes, its references exist, its figures are drawn, it is short enough."""

import re
import runpy
import shutil
import sys
from pathlib import Path

import matplotlib
import matplotlib.image
import matplotlib.pyplot
import pytest

matplotlib.use("Agg")
ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "paper"
PAPER = runpy.run_path(str(FOLDER / "paper_numbers.py"))
TEXT = (FOLDER / "paper.md").read_text(encoding="utf-8")
BODY = TEXT.split("---\n", 2)[2]
WORDS = 750, 1750  # as the journal asks


def entries(path: Path) -> dict[str, dict[str, str]]:
    """Key -> fields of a file of BibTeX as this project writes it."""
    found = {}
    for key, fields in re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", path.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        found[key] = dict(re.findall(r"^ +(\w+) += \{(.*)\},$", fields, re.MULTILINE))
    return found


def cited(text: str) -> set[str]:
    return set(re.findall(r"@(\w+)", text))


OWN, KNOWN = entries(FOLDER / "paper.bib"), entries(ROOT / "src" / "stiction" / "records" / "sources.bib")


def test_its_numbers_are_computed():
    assert PAPER["renewed"](TEXT) == TEXT, "python paper/paper_numbers.py writes them anew"


def test_it_has_no_other_numbers():
    """Besides those of the phrases: the year of the paper it is named for, inputs, and what is a setting of the text."""
    rest = BODY
    for phrase in PAPER["PHRASES"]:
        assert len(PAPER["place_of"](phrase).findall(rest)) == 1, phrase
        rest = PAPER["place_of"](phrase).sub("", rest)
    rest = re.sub(r"@\w+|2015|\$\\theta=40\$|\$\\lambda=10\$", "", rest)
    assert re.findall(r"\d+", rest) == []


def test_a_number_that_is_wrong_is_noticed():
    place = PAPER["place_of"](PAPER["PHRASES"][1]).search(TEXT)
    assert place is not None
    wrong = TEXT.replace(place.group(), re.sub(r"\d+", "7", place.group()))
    assert wrong != TEXT == PAPER["renewed"](wrong)


def test_every_reference_resolves_and_is_used():
    assert cited(BODY) == set(OWN)


def test_references_are_those_of_the_package():
    """What both have is the same, but for what only the package has to say of a source."""
    for key in OWN.keys() & KNOWN.keys():
        assert OWN[key] == {name: KNOWN[key][name] for name in OWN[key]}, key
    new = {key: one for key, one in OWN.items() if key not in KNOWN}
    assert all("doi" in one or "https://" in one.get("note", "") for one in new.values())
    assert all(re.fullmatch(r"10\.\d{4,}/\S+", one["doi"]) for one in OWN.values() if "doi" in one)


def test_it_is_neither_longer_nor_shorter_than_the_journal_asks():
    counted = len(re.sub(r"!\[.*?\]\(\S+\)", "", BODY, flags=re.DOTALL).split())
    assert WORDS[0] <= counted <= WORDS[1]


@pytest.mark.parametrize("section", ["Summary", "Statement of need", "State of the field", "Software design", "References"])
def test_its_sections(section):
    assert f"\n# {section}\n" in BODY


@pytest.mark.parametrize("name", ["readings", "errors"])
def test_its_figures_are_drawn(name, tmp_path, monkeypatch):
    shutil.copy(FOLDER / f"{name}.py", tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [f"{name}.py"])
    runpy.run_path(f"{name}.py", run_name="__main__")
    matplotlib.pyplot.close("all")
    drawn = matplotlib.image.imread(tmp_path / f"{name}.png")
    kept = matplotlib.image.imread(FOLDER / f"{name}.png")
    assert drawn.shape == kept.shape and drawn.std() > 0.05
    assert f"({name}.png)" in TEXT
