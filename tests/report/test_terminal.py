"""Lines on a terminal break between words, never between a number and its unit."""

import io
import re
from pathlib import Path

import pytest
from rich.text import Text
from typer.testing import CliRunner

from stiction.cli import app
from stiction.report.table import Column, Table, facts
from stiction.report.terminal import Terminal

LOADS = "at 2.36 N (middle of the loads 410 µN to 105 N), 0.053 mm² of 1 mm^2, 0.3 GPa, 45 deg, 2 s, 293 K, 1.7e10 1/m², 5 J/m²"
PARTED = re.compile(r"\d$\n\s*(?:[nµmkMG]?(?:N|Pa|J|m|s)|K|deg|1/m)(?!\w)", re.MULTILINE)


def printed(part, width):
    terminal = Terminal(file=io.StringIO(), width=width)
    terminal.print(part)
    return terminal.file.getvalue()


@pytest.mark.parametrize(
    "part", [LOADS, Text(LOADS), facts([("mu = 0.21", LOADS)]), Table([Column("", wrap=True)], [(LOADS,)])], ids=type
)
def test_a_number_stays_with_its_unit_at_any_width(part):
    for width in range(30, 121):
        text = printed(part, width)
        assert not PARTED.search(text), (width, text)
        assert max(map(len, text.splitlines())) <= width
        words = text.removeprefix("mu = 0.21").split()
        assert words == LOADS.split(), (width, text)


@pytest.mark.parametrize("name", ["silver_on_steel", "soft_film", "hard_film_on_steel"])
def test_answers_keep_numbers_with_their_units(name):
    case = str(Path(__file__).parents[2] / "examples" / f"{name}.toml")
    text = CliRunner().invoke(app, ["run", case, "--details"]).output
    assert " µm" in text and not PARTED.search(text), text
