"""Print the licences of all packages that stiction needs at run time, as a table: `python release/licences.py`.

The packages are those of `stiction[all]`, followed from one to the next in the environment of this Python.
"""

import re
import sys
from importlib.metadata import PackageNotFoundError, distribution

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
    return about.get("License-Expression") or ", ".join(classifiers) or (text[0][:60] if text else "not stated")


def problems(licences: dict[str, str]) -> list[str]:
    """Return a line for each package whose licence is not stated, or is the GPL or AGPL alone.

    A package with several classifiers, as docutils, has few files under each; those that are imported are not under the GPL.
    """
    return [
        f"{name}: {text}"
        for name, text in licences.items()
        if text == "not stated" or all(_COPYLEFT.search(part) for part in text.split(", "))
    ]


def main() -> int:
    """Print the table, and what is wrong; how many things are."""
    licences = needed("stiction", frozenset({"all"}), {})
    width = max(map(len, licences))
    for name, text in sorted(licences.items()):
        print(f"{name:{width}}  {text}")
    wrong = problems(licences)
    for line in wrong:
        print(f"licences: {line}", file=sys.stderr)
    return len(wrong)


if __name__ == "__main__":
    sys.exit(main())
