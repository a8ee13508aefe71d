"""Names in tables can be copied, on a terminal of any width."""

import io

import pytest
from rich.console import Console
from rich.text import Text

from stiction.report.table import Column, Table, numbers

NAMES = ["hertz", "ciavarella_greenwood_paggi_2008 + sequential", "cohen_kligerman_etsion_2008 + layered", "jkr"]


def printed(width: int, *, status: bool = False, head: bool = True) -> list[str]:
    heads = ("model", "mu", "contact\narea", "status") if head else [""] * 4
    columns = [Column(heads[0]), *numbers(*heads[1:3]), Column(heads[3], wrap=True)]
    words = "because of this and of that" if status else "-"
    rows = [[name, f"0.{at}", Text(f"{at} um^2"), words] for at, name in enumerate(NAMES)]
    table = Table(columns, rows, looks=["bold"] * len(NAMES), gap=1, whole=True)
    file = io.StringIO()
    Console(file=file, width=width).print(table)
    return [line.rstrip() for line in file.getvalue().splitlines()]


def widths_beside(status: bool, head: bool) -> int:
    """Of mu, area and status, with a space between columns: "0.0", "contact" or "0 um^2", the words or the head."""
    return 1 + (3 + 1) + (7 if head else 6) + 1 + (28 if status else 6 if head else 1)


@pytest.mark.parametrize("status", [False, True])
@pytest.mark.parametrize("head", [False, True])
@pytest.mark.parametrize("width", [50, 60, 80, 100, 200])
def test_no_name_is_broken_and_nothing_is_lost(width, status, head):
    """A name that has no room is alone on its line, with its numbers in their columns below."""
    lines = printed(width, status=status, head=head)
    for at, name in enumerate(NAMES):
        (line,) = (line for line in lines if name in line)
        beside = line if line != name else lines[lines.index(line) + 1]
        assert f"0.{at}" in beside and beside.index(f"0.{at}") == next(one for one in lines if "0.0" in one).index("0.0")
        assert (line == name) == (len(name) > width - widths_beside(status, head))


def test_with_room_it_is_the_table_itself():
    assert [line.split()[0] for line in printed(200)[2:]] == [name.split()[0] for name in NAMES]
    assert len(printed(200)) == 2 + len(NAMES)
