"""Builds the site: build/docs/html, to be opened in a browser; nothing of it needs a network.

    python docs/site/build.py            # all of it; warnings are errors
    python docs/site/build.py --only-sources    # only what Sphinx reads: build/docs/source

What Sphinx reads is laid out first: the pages of docs/ as they are, with the links of the site, and the pages that are made
here of what is said elsewhere: models, names, commands, the case file, executed tutorials and the gallery.
"""

import argparse
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path, PurePosixPath

import matplotlib

matplotlib.use("Agg")
HERE = Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE.parent), str(HERE.parents[1] / "tests" / "docs")]

import case_pages  # noqa: E402 - beside this file
import command_pages  # noqa: E402
import gallery  # noqa: E402
import model_pages  # noqa: E402
import name_pages  # noqa: E402
import notebooks  # noqa: E402
import speed_page  # noqa: E402
from dead_links import dead_links  # noqa: E402
from links import ROOT, place_of, relinked  # noqa: E402

# Pages of the project that are in the site though they are not in docs/; more come by links to them.
OTHERS = ("CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md")
# Each writes its pages into the folder of sources, and gives the files of the project that they lead to.
MADE: tuple[Callable[[Path], list[PurePosixPath]], ...] = (
    model_pages.write, name_pages.write, case_pages.write, command_pages.write, gallery.write, notebooks.write,
    speed_page.write,
)  # fmt: skip


def own_pages() -> Iterator[PurePosixPath]:
    """The pages of docs/ that are in the site as they are; tutorials are executed."""
    for path in sorted((ROOT / "docs").rglob("*.md")):
        page = PurePosixPath(path.relative_to(ROOT).as_posix())
        if page.parent != notebooks.FOLDER or page.name == "index.md":
            yield page


def lay_out(out: Path) -> None:
    """Everything that Sphinx reads, in the folder `out`, which is made anew."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    waiting = [*own_pages(), *map(PurePosixPath, OTHERS)]
    for write in MADE:
        began = time.monotonic()
        waiting += write(out)
        print(f"{write.__module__:14} {time.monotonic() - began:5.1f} s", flush=True)
    done: set[PurePosixPath] = set()
    while waiting:
        path = waiting.pop(0)  # our own first: the README stands where docs/index.md does
        target = out / place_of(path)
        if path in done or target.exists():
            continue
        done.add(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".md":
            text, linked = relinked((ROOT / path).read_text(encoding="utf-8"), path)
            waiting += linked
            target.write_text(_alone(path) + text, encoding="utf-8")
        else:
            shutil.copyfile(ROOT / path, target)


def _alone(path: PurePosixPath) -> str:
    """What stands before a page that is in no table of contents."""
    return "" if path.parts[0] == "docs" or str(path) == "CONTRIBUTING.md" else "---\norphan: true\n---\n\n"


def build(out: Path) -> int:
    """The pages, from what is laid out; the number of Sphinx's exit."""
    from sphinx.cmd.build import build_main

    source, html, kept = (out / name for name in ("source", "html", "kept"))
    shutil.rmtree(html, ignore_errors=True)
    words = ["-W", "--keep-going", "-q", "-b", "html", "-c", str(HERE), "-d", str(kept), str(source), str(html)]
    return build_main(words)


def main() -> int:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--out", type=Path, default=ROOT / "build" / "docs")
    words.add_argument("--only-sources", action="store_true", help="do not build the pages")
    words.add_argument("--only-pages", action="store_true", help="build the pages of sources that are there")
    given = words.parse_args()
    if not given.only_pages:
        lay_out(given.out / "source")
    if given.only_sources:
        return 0
    began = time.monotonic()
    failed = build(given.out)
    print(f"{'sphinx':14} {time.monotonic() - began:5.1f} s")
    dead = list(dead_links(given.out / "html"))
    if dead:
        print(*dead, sep="\n", file=sys.stderr)
    if not (failed or dead):
        print(f"The site is {given.out / 'html' / 'index.html'}")
    return failed or bool(dead)


if __name__ == "__main__":
    sys.exit(main())
