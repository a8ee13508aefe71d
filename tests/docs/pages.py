"""Runs the examples of a page of the documentation, and writes what they print into it.

A page is Markdown. Its ```python blocks run in order, in one namespace, in an empty folder. A ```text block that follows
one directly is what it prints. A block whose first line is "# file: NAME" is not run but written to that file; a
pyproject.toml written so is installed as far as its entry points go.

    python tests/docs/pages.py docs/quickstart.md ...     # write the outputs anew: read the difference before keeping it
"""

import contextlib
import importlib.util
import io
import os
import re
import sys
import tempfile
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from stiction.records import record

ROOT = Path(__file__).parents[2]


def _script(name: str):
    """A script of docs/, as a module."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


make_tables = _script("make_tables")

_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FILE = re.compile(r"# file: (\S+)\n")


@dataclass(frozen=True)
class Block:
    """A fenced block: its language and text, the line at which the text starts, and where the text is in the page."""

    language: str
    text: str
    line: int
    start: int
    end: int

    @property
    def file(self) -> str | None:
        """The name of the file that the block is, if it is one."""
        match = _FILE.match(self.text)
        return match[1] if match else None


@dataclass(frozen=True)
class Example:
    """A block that was run, what it printed, and the block that says what it prints, if there is one."""

    block: Block
    printed: str
    shown: Block | None


def pages() -> list[Path]:
    """The README and every page in docs/ and its folders."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def blocks(page: str) -> list[Block]:
    """All fenced blocks of a page."""
    found = []
    for match in _FENCE.finditer(page):
        line = page.count("\n", 0, match.start(2)) + 1
        found.append(Block(match[1], match[2], line, *match.span(2)))
    return found


def run(name: str, page: str) -> list[Example]:
    """Run the examples of a page, in this process. name: what a traceback calls the page."""
    examples: list[Example] = []
    space = {"__name__": "__main__"}
    found = blocks(page)
    with sandbox() as folder:
        for block, after in zip_longest(found, found[1:]):
            if block.file:
                (folder / block.file).write_text(block.text, encoding="utf-8")
                if block.file == "pyproject.toml":
                    _install(block.text, folder)
            elif block.language == "python":
                # Empty lines before it, so that a traceback names the line of the page.
                code = compile("\n" * (block.line - 1) + block.text, name, "exec")
                with contextlib.redirect_stdout(io.StringIO()) as output:
                    exec(code, space)
                shown = after if after and after.language == "text" else None
                examples.append(Example(block, output.getvalue(), shown))
    return examples


@contextlib.contextmanager
def sandbox() -> Iterator[Path]:
    """An empty folder to work in, from which modules can be imported; nothing of it stays behind."""
    before, path, modules = Path.cwd(), list(sys.path), set(sys.modules)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        os.chdir(folder)
        sys.path.insert(0, str(folder))
        try:
            yield folder
        finally:
            os.chdir(before)
            sys.path[:] = path
            for module in set(sys.modules) - modules:
                if str(getattr(sys.modules[module], "__file__", "")).startswith(str(folder)):
                    del sys.modules[module]
            record._from_plug_ins.cache_clear()


def _install(text: str, folder: Path) -> None:
    """What `pip install` leaves of a project, as far as the registry looks: its name and its entry points."""
    project = tomllib.loads(text)["project"]
    info = folder / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
    lines = []
    for group, entries in project["entry-points"].items():
        lines += [f"[{group}]", *(f"{name} = {place}" for name, place in entries.items())]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
    record._from_plug_ins.cache_clear()


def refreshed(page: str, examples: list[Example]) -> str:
    """The page with what the examples printed in the blocks that show it."""
    for example in reversed(examples):
        if example.shown:
            page = page[: example.shown.start] + example.printed + page[example.shown.end :]
    return page


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:]):
        text = path.read_text(encoding="utf-8")
        path.write_text(refreshed(text, run(str(path), text)), encoding="utf-8")
