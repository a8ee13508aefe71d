"""Measure the marks of stilted English in docstrings, and hold every package to few of them."""

import ast
import re
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "src" / "stiction"
MARKS = (
    r"^What ",
    r"\b(?:of which|of those|that of|beside|comes off|for that|it is that which)\b",
    r"\b(?:is|are) (?:said|told|asked)\b",
    r"\bknows?\b",
)
LARGEST_SHARE = 0.03  # of docstrings with a mark, in each package


def docstrings(folder, kinds):
    for path in sorted(folder.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, kinds) and (text := ast.get_docstring(node)):
                name = getattr(node, "name", "module")
                yield f"{path.relative_to(SOURCE)}: {name}", text


def marked(folder, kinds):
    """Return the names of docstrings with a mark, and the number of all docstrings."""
    texts = list(docstrings(folder, kinds))
    return [name for name, text in texts if any(re.search(mark, text, re.MULTILINE) for mark in MARKS)], len(texts)


@pytest.mark.parametrize("package", sorted(folder.name for folder in SOURCE.iterdir() if (folder / "__init__.py").exists()))
def test_docstrings_of_a_package_have_few_marks(package):
    names, count = marked(SOURCE / package, (ast.FunctionDef, ast.ClassDef))
    print(f"{package}: {len(names)} of {count} docstrings, {len(names) / count:.1%}")
    assert len(names) <= LARGEST_SHARE * count, names


def test_all_docstrings_together_have_few_marks():
    names, count = marked(SOURCE, (ast.FunctionDef, ast.ClassDef, ast.Module))
    assert count > 3000 and len(names) <= LARGEST_SHARE * count, names
