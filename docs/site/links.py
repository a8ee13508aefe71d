"""Where the files of the project are in the site, and the links between them.

A page of docs/ keeps its folder; the file of a law leads to the page of the law; any other file that is linked to stands under
`project/`. Links to folders become plain text.
"""

import os
import re
from functools import cache
from pathlib import Path, PurePosixPath

import make_tables

from stiction.records.registry import records

ROOT = Path(__file__).resolve().parents[2]

# Fenced blocks and code in a line are left alone; of a link the target is taken.
_PARTS = re.compile(
    r"(?P<code>^(?P<fence>`{3,}|~{3,}).*?^(?P=fence)`*\s*$|`[^`\n]+`(?!\]))"
    r"|(?P<open>!?\[(?P<text>(?:[^\[\]]|\[[^\[\]]*\])*)\])\((?P<target>[^)\s]+)\)",
    re.MULTILINE | re.DOTALL,
)
_ELSEWHERE = re.compile(r"[a-z]+:", re.IGNORECASE)


def place_of(path: PurePosixPath) -> PurePosixPath:
    """Where a file of the project is in the site; both relative to their roots."""
    if path == PurePosixPath("README.md"):
        return PurePosixPath("index.md")
    if path in law_pages():
        return law_pages()[path]
    return path.relative_to("docs") if path.parts[0] == "docs" else PurePosixPath("project") / path


@cache
def law_pages() -> dict[PurePosixPath, PurePosixPath]:
    """Return the page of each law in the site, by the law's file; two kinds may share a key."""
    pages = {}
    for record in records():
        model = {"key": record.key, "kind": record.kind}
        twin = f"-{record.kind}".replace(" ", "-") * make_tables.shares_its_key(model)
        pages[PurePosixPath(make_tables.file_of(model))] = PurePosixPath("reference/laws") / f"{record.key}{twin}.md"
    return pages


@cache
def page_with(stem: str, heading: str = "") -> PurePosixPath | None:
    """Return the page of docs/ of this name with this heading; the page may be a part, as theory-films of theory."""
    for path in sorted((ROOT / "docs").rglob(f"{stem}*.md"), key=lambda path: len(path.stem)):
        if not heading or heading in headings(path.read_text(encoding="utf-8")):
            return PurePosixPath(path.relative_to(ROOT).as_posix())
    return None


def headings(text: str) -> set[str]:
    """Return the anchors of the headings of a page, as the usual viewers make them."""
    titles = re.findall(r"^#+ (.*)$", text, flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def relinked(text: str, page: PurePosixPath, place: PurePosixPath | None = None) -> tuple[str, list[PurePosixPath]]:
    """The text of a page of the project with the links of the site, and the files of the project that it leads to.

    page: relative to the project, from where its links are meant; place: where the text is in the site, if not there.
    """
    place = place or place_of(page)
    linked: list[PurePosixPath] = []

    def new(found: re.Match) -> str:
        if found["code"] or _ELSEWHERE.match(found["target"]):
            return found[0]
        file, mark, heading = found["target"].partition("#")
        goal = PurePosixPath(os.path.normpath(page.parent / file)) if file else page
        if not file and place == place_of(page):
            return found[0]
        if (ROOT / goal).is_dir():
            return found["text"]
        if (ROOT / goal).exists():
            linked.append(goal)
        return f"{found['open']}({os.path.relpath(place_of(goal), place.parent)}{mark}{heading})"

    return _PARTS.sub(new, text), linked
