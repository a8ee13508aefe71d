"""The gallery: every script of docs/gallery is run, and shown with its picture.

A script begins with its title, and what its picture tells, as a docstring; run by itself it writes the picture beside
itself, NAME.png.
"""

import ast
import re
import runpy
import shutil
import sys
from pathlib import Path, PurePosixPath

import matplotlib.pyplot as plt
from docstrings import as_markdown
from links import ROOT
from pages import sandbox

FOLDER = PurePosixPath("docs/gallery")


def scripts() -> list[Path]:
    """In the order of the gallery, which their docstrings do not need: that of their names' numbers."""
    return sorted((ROOT / FOLDER).glob("*.py"))


def name_of(script: Path) -> str:
    """Of its page and picture: without the number."""
    return re.sub(r"^\d+_", "", script.stem)


def told(script: Path) -> tuple[str, str]:
    """Title and text of a script, from its docstring."""
    text = ast.get_docstring(ast.parse(script.read_text(encoding="utf-8"))) or ""
    title, _, rest = text.partition("\n")
    return title.rstrip("."), rest.strip()


def run(script: Path, target: Path) -> None:
    """Run a script in a folder that has nothing but the examples, and keep its picture."""
    with sandbox() as folder:
        (folder / "examples").symlink_to(ROOT / "examples")
        before = sys.argv
        sys.argv = [str(script)]
        try:
            runpy.run_path(str(script), run_name="__main__")
        finally:
            sys.argv = before
            plt.close("all")
        shutil.copyfile(folder / f"{name_of(script)}.png", target)


def write(out: Path) -> list[PurePosixPath]:
    """A page for each script, and the gallery itself."""
    folder = out / FOLDER.name
    folder.mkdir(parents=True)
    cards = []
    for script in scripts():
        name, (title, text) = name_of(script), told(script)
        run(script, folder / f"{name}.png")
        code = script.read_text(encoding="utf-8").split('"""', 2)[2].strip("\n")
        (folder / f"{name}.md").write_text(
            "---\norphan: true\n---\n\n"
            f"# {title}\n\n{as_markdown(text, (), '../')}\n\n```{{image}} {name}.png\n:alt: {title}\n:class: drawn\n```\n\n"
            f"```python\n{code}\n```\n\nAs a file: {{download}}`{script.name} </project/{FOLDER}/{script.name}>`.\n",
            encoding="utf-8",
        )
        cards.append(
            f"::::{{grid-item-card}} {title}\n:link: {name}\n:link-type: doc\n:img-top: {name}.png\n:img-alt: {title}\n::::"
        )
    (folder / "index.md").write_text(_index(cards), encoding="utf-8")
    files = out / "project" / FOLDER
    files.mkdir(parents=True)
    for script in scripts():
        shutil.copyfile(script, files / script.name)
    return []


def _index(cards: list[str]) -> str:
    return (
        "# Gallery\n\nEach picture is shown with the short script that draws it. The tests run all scripts.\n\n"
        ":::::{grid} 1 2 2 3\n:gutter: 3\n\n" + "\n\n".join(cards) + "\n:::::\n"
    )
