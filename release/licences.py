"""Write the licences of all that stiction needs or ships to docs/reference/licences.md: `python release/licences.py`.

The packages are those of `stiction[all]`, followed from one to the next in the environment of this Python.
"""

import re
import sys
from collections.abc import Iterable
from fnmatch import fnmatch
from importlib.metadata import PackageNotFoundError, distribution

from shared import ROOT

PAGE = ROOT / "docs" / "reference" / "licences.md"
_OWN = "MIT (this project)"
_FACTS = "MIT (this project); numbers are facts"
# Files of wheel and sdist other than Python and Markdown: pattern, content, origin, licence. The first pattern counts.
SHIPPED = (
    ("src/stiction/*_data/*.toml", "materials, interfaces, finishes", "publications that each entry names", _FACTS),
    ("src/stiction/records/sources.bib", "bibliography", "typed by the authors", _OWN),
    ("src/stiction/*.npz", "benchmark surfaces, layered spheres", "computed by this project", _OWN),
    ("src/stiction/*.csv", "units, quantities, errors of films", "typed or computed by this project", _OWN),
    ("src/stiction/*", "templates, first cases, weights, types", "written or computed by this project", _OWN),
    ("reference/*.csv", "reference tables", "publications and independent evaluations (reference/README.md)", _FACTS),
    ("validation/silicone_on_pla_2024.toml", "measured friction", "Tortos-Vinocour and others (2024)", "MIT (its authors)"),
    ("validation/*", "measured and synthetic contacts", "publications that each file names, or computed", _FACTS),
    ("tests/prediction/handbook.csv", "ranges of friction", "handbooks that each row names", _FACTS),
    ("docs/site/static/*", "style and script of the site", "written by this project", _OWN),
    ("*", "cases, results, pictures, recipes", "written or computed by this project", _OWN),
)

_NAME = re.compile(r"[A-Za-z0-9._-]+")
_EXTRA = re.compile(r"extra\s*==\s*['\"]([\w-]+)['\"]")
_COPYLEFT = re.compile(r"(?<!L)(?<!Lesser )\bA?GPL|GNU (Affero )?General Public", re.IGNORECASE)


def needed(name: str, extras: frozenset[str], found: dict[str, str]) -> dict[str, str]:
    """Add a package and all that it needs to `found`: name -> licence. Packages that are not installed are left out."""
    try:
        package = distribution(name)
    except PackageNotFoundError:  # of another system, or another version of Python
        return found
    key = package.metadata["Name"].lower().replace("_", "-")
    if key in found and not extras:
        return found
    found[key] = licence_of(package)
    for line in package.requires or ():
        marked = _EXTRA.search(line)
        if marked is None or marked[1] in extras:
            inner = re.search(r"\[([\w,\s-]+)\]", line.partition(";")[0])
            wanted = frozenset(part.strip() for part in inner[1].split(",")) if inner else frozenset()
            match = _NAME.match(line)
            if match and not (match[0].lower() == name.lower() and wanted <= extras):
                needed(match[0], wanted, found)
    return found


def licence_of(package) -> str:
    """Return the licence that a package states: its expression, else its classifiers, else the first line of its text."""
    about = package.metadata
    classifiers = [line.rpartition(" :: ")[2] for line in about.get_all("Classifier") or () if line.startswith("License ::")]
    text = (about.get("License") or "").strip().splitlines()
    return about.get("License-Expression") or ", ".join(classifiers) or (text[0].lstrip("# ")[:60] if text else "not stated")


def problems(licences: dict[str, str]) -> list[str]:
    """Return a line for each package whose licence is not stated, or is the GPL or AGPL alone.

    A package with several classifiers, as docutils, has few files under each; those that are imported are not under the GPL.
    """
    return [
        f"{name}: {text}"
        for name, text in licences.items()
        if text == "not stated" or all(_COPYLEFT.search(part) for part in text.split(", "))
    ]


def origin_of(path: str) -> tuple[str, str, str, str]:
    """Return the row of SHIPPED that holds for a file, given by its path from the root."""
    return next(row for row in SHIPPED if fnmatch(path, row[0]))


def page(licences: dict[str, str], base: set[str]) -> str:
    """Return the text of the page. base: names of the packages that stiction needs without extras."""
    text = """# Licences

stiction is under the MIT licence. This page is made by `python release/licences.py`.

## Files

Python modules and pages were written for this project. Other files of the wheel and the source distribution:

"""
    text += _table(("files", "content", "origin", "licence"), ((f"`{row[0]}`", *row[1:]) for row in SHIPPED))
    text += """
The built documentation also contains MathJax (Apache-2.0), a part of the package `sphinx-mathjax-offline`.

## Packages

These packages are installed with stiction and are not part of it. The licences are quoted from the metadata of the packages.

"""
    rows = (
        (f"`{name}`", text, "stiction" if name in base else "extras")
        for name, text in sorted(licences.items())
        if name != "stiction"
    )
    return text + _table(("package", "licence", "needed by"), rows)


def _table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    heads = list(heads)
    return "".join(f"| {' | '.join(row)} |\n" for row in (heads, ["---"] * len(heads), *rows))


def main() -> int:
    """Write the page, and print what is wrong; how many things are."""
    licences = needed("stiction", frozenset({"all"}), {})
    PAGE.write_text(page(licences, set(needed("stiction", frozenset(), {}))), encoding="utf-8")
    wrong = problems(licences)
    for line in wrong:
        print(f"licences: {line}", file=sys.stderr)
    return len(wrong)


if __name__ == "__main__":
    sys.exit(main())
