"""Links of the built site that lead nowhere: to no file of it, or to no place in a page; and what is loaded from a network.

python docs/site/dead_links.py build/docs/html
"""

import re
import sys
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

_FAR = re.compile(r"(?:https?:)?//")
_LOADED_BY_STYLE = re.compile(r"""(?:url\(|@import)\s*["']?((?:https?:)?//[^"')\s]+)""")


class _Page(HTMLParser):
    """What a page links to, what of that it loads to be shown, and the places in it that can be linked to."""

    def __init__(self, text: str):
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.places: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value for name, value in attrs if value}
        self.places |= {given[name] for name in ("id", "name") if name in given}
        links = [given[name] for name in ("href", "src") if name in given]
        self.links += links
        self.loaded += [] if tag == "a" else links


@cache
def _read(path: Path) -> _Page:
    return _Page(path.read_text(encoding="utf-8"))


def dead_links(site: Path) -> Iterator[str]:
    """One line for each link that is dead, or that needs a network while the page is shown."""
    for path in sorted(site.rglob("*.html")):
        for link in _read(path).links:
            problem = _problem(path, link)
            if problem:
                yield f"{path.relative_to(site)}: {link}: {problem}"
        yield from (f"{path.relative_to(site)}: {link}: needs a network" for link in _read(path).loaded if _FAR.match(link))
    for path in sorted(site.rglob("*.css")):
        for link in _LOADED_BY_STYLE.findall(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(site)}: {link}: needs a network"


def _problem(path: Path, link: str) -> str:
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return ""
    goal = path if not parts.path else (path.parent / unquote(parts.path))
    if goal.is_dir():
        goal = goal / "index.html"
    if not goal.exists():
        return "no such file"
    place = unquote(parts.fragment)
    if place and goal.suffix == ".html" and place not in _read(goal.resolve()).places:
        return "no such place in the page"
    return ""


if __name__ == "__main__":
    found = list(dead_links(Path(sys.argv[1])))
    print("\n".join(found) or "every link leads somewhere")
    sys.exit(bool(found))
