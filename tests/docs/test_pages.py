"""Every example in the documentation runs, prints what the page says, and every table in it is up to date."""

import re
import runpy
import sys
import tomllib

import pytest
from pages import ROOT, blocks, make_tables, pages, refreshed, run, sandbox

from stiction.case.read import parse_case
from stiction.engine.summation import _COUNTS

sys.path.append(str(ROOT / "docs" / "site"))

from links import headings

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
PAGES = [pytest.param(page, id=page.name) for page in pages()]


@pytest.mark.parametrize("path", PAGES)
def test_examples_print_what_the_page_shows(path):
    for example in run(str(path), path.read_text(encoding="utf-8")):
        where = f"{path.name}, line {example.block.line}"
        if example.printed:
            assert example.shown, f"{where}: the output is not shown"
        if example.shown:
            assert example.printed == example.shown.text, where


PAGE = """
```python
# file: two.py
TWO = 2
```

```python
from two import TWO

print(TWO + 2)
```

```text
5
```
"""


def test_the_runner_sees_what_is_wrong():
    (example,) = run("page", PAGE)
    assert (example.printed, example.shown.text, example.block.line) == ("4\n", "5\n", 8)
    assert refreshed(PAGE, [example]) == PAGE.replace("5", "4")
    with pytest.raises(ZeroDivisionError):
        run("page", PAGE.replace("TWO + 2", "TWO / 0"))


@pytest.mark.parametrize("path", PAGES)
def test_case_files_are_cases(path):
    """A toml block with a [solve] table is a whole case file; those that the page itself reads are left to it."""
    for block in blocks(path.read_text(encoding="utf-8")):
        if block.language == "toml" and not block.file:
            content = tomllib.loads(block.text)
            if "solve" in content:
                parse_case(content)


@pytest.mark.parametrize("path", PAGES)
def test_links_lead_somewhere(path):
    """Links to files of the project, and to headings of a page."""
    text = path.read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    for target in re.findall(r"\]\((?!https?:)([^)\s]+)\)", prose):
        file, _, heading = target.partition("#")
        there = path.parent / file if file else path
        assert there.exists(), f"{path.name}: {target}"
        if heading:
            assert heading in headings(there.read_text(encoding="utf-8")), f"{path.name}: {target}"


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.name)
def test_example_scripts_run(script, capsys):
    with sandbox() as folder:
        runpy.run_path(str(script), run_name="__main__")
        assert list(folder.glob("*.png")), "every example leaves a picture"
    assert capsys.readouterr().out


def test_tables_are_up_to_date():
    """`python docs/make_tables.py` writes them."""
    for page, fresh in make_tables.fresh_pages().items():
        assert page.read_text(encoding="utf-8") == fresh, f"{page.name} is out of date: python docs/make_tables.py"


def test_numbers_of_nodes_are_those_of_the_engine():
    """docs/explanation/numerics.md speaks of them."""
    short, long = _COUNTS
    assert f"{short} nodes, or {long}" in (ROOT / "docs" / "explanation" / "numerics.md").read_text(encoding="utf-8")
