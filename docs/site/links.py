"""Where the files of the project are in the site, and the links between them.

A page of docs/ stands at the root of the site; another page that is linked to, or file, under `project/` by its path. Links
to folders become plain text: a site has none.
"""

import os
import re
from pathlib import Path, PurePosixPath

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
    return path.relative_to("docs") if path.parts[0] == "docs" else PurePosixPath("project") / path


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
