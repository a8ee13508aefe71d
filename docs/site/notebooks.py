"""The tutorials, executed: a page with what was printed and drawn, and a notebook that a reader can download.

A tutorial is Markdown like every page of docs/, and its examples run in the tests as theirs do. Here its blocks of Python are
run again, as a notebook would run them: a block shows what it prints, the figures that it leaves open in pyplot, and the
value of its last line, unless that ends in a semicolon.
"""

import ast
import base64
import contextlib
import io
import json
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path, PurePosixPath
from typing import Any

import matplotlib.pyplot as plt
from links import ROOT, relinked
from matplotlib.artist import Artist
from matplotlib.figure import Figure
from pages import Block, blocks, sandbox

FOLDER = PurePosixPath("docs/tutorials")


@dataclass
class Shown:
    """What a block leaves below itself: text, HTML, and pictures as PNG."""

    text: str = ""
    html: str = ""
    pictures: list[bytes] = field(default_factory=list)


def write(out: Path) -> list[PurePosixPath]:
    """Every tutorial of docs/tutorials, as a page and as a notebook beside it."""
    folder = out / FOLDER.name
    folder.mkdir(parents=True)
    linked = []
    for path in tutorials():
        page, notebook, pictures = executed(path.read_text(encoding="utf-8"), path.stem)
        text, more = relinked(page, FOLDER / path.name)
        (folder / path.name).write_text(text, encoding="utf-8")
        (folder / f"{path.stem}.ipynb").write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        for name, content in pictures.items():
            (folder / name).write_bytes(content)
        linked += more
    return linked


def tutorials() -> list[Path]:
    return sorted(path for path in (ROOT / FOLDER).glob("*.md") if path.name != "index.md")


def executed(text: str, name: str) -> tuple[str, dict, dict[str, bytes]]:
    """A tutorial's text as page, notebook, and pictures by name of file."""
    parts, cells, pictures = [], [], {}
    space: dict = {"__name__": "__main__"}
    place = 0
    found = blocks(text)
    plt.close("all")  # figures of others are not this page's
    with sandbox() as folder:
        for block, after in zip_longest(found, found[1:]):
            start, end = _fence(text, block)
            if block.file:
                (folder / block.file).write_text(block.text, encoding="utf-8")
                cells += [_prose(text[place:start]), _code(f"%%writefile {block.file}\n{block.text}", Shown())]
                parts.append(text[place:end])
            elif block.language == "python":
                shown = _run(block, space, name)
                cells += [_prose(text[place:start]), _code(block.text, shown)]
                parts += [text[place:end], _below(shown, f"{name}-{len(cells)}", pictures)]
                if after and after.language == "text" and not after.file:
                    end = _fence(text, after)[1]
            else:
                continue
            place = end
    parts.append(text[place:])
    cells.append(_prose(text[place:]))
    page = "".join(parts).replace("\n", _OFFER.format(name=name), 1)
    return page, _notebook([cell for cell in cells if cell["source"]]), pictures


_OFFER = "\n\n{{download}}`Download this page as a notebook <{name}.ipynb>`\n"


def _fence(text: str, block: Block) -> tuple[int, int]:
    """Where the block begins and ends with its fences."""
    return text.rindex("```", 0, block.start), block.end + 4


def _run(block: Block, space: dict, name: str) -> Shown:
    """What the block shows in a notebook."""
    tree = ast.parse("\n" * (block.line - 1) + block.text, name)
    silent = block.text.rstrip().endswith(";")  # as in a notebook
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) and not silent else None
    shown = Shown()
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(tree, name, "exec"), space)
        value = eval(compile(last, name, "eval"), space) if last else None
    shown.text = printed.getvalue()
    figures = [plt.figure(number) for number in plt.get_fignums()]
    plt.close("all")
    if isinstance(value, Figure):
        figures.append(value)
    elif hasattr(value, "_repr_html_"):
        shown.html = value._repr_html_()
    elif value is not None and not _drawn(value):
        shown.text += f"{value!r}\n"
    shown.pictures = [_png(figure) for figure in figures]
    return shown


def _drawn(value: Any) -> bool:
    """Whether it is something of a picture, such as a legend or lines, which as text says only where it is in memory."""
    parts = value if isinstance(value, (list, tuple)) and len(value) else [value]
    return all(isinstance(part, Artist) for part in parts)


def _png(figure: Figure) -> bytes:
    written = io.BytesIO()
    figure.savefig(written, format="png", dpi=120)
    return written.getvalue()


def _below(shown: Shown, name: str, pictures: dict[str, bytes]) -> str:
    """What stands below a block on the page."""
    parts = [f"\n```{{code-block}} text\n:class: printed\n\n{shown.text}```\n"] if shown.text else []
    parts += [f"\n```{{raw}} html\n{shown.html}\n```\n"] if shown.html else []
    for at, content in enumerate(shown.pictures):
        pictures[f"{name}-{at}.png"] = content
        parts.append(f"\n```{{image}} {name}-{at}.png\n:alt: what the lines above draw\n:class: drawn\n```\n")
    return "".join(parts)


def _prose(text: str) -> dict:
    return {"cell_type": "markdown", "metadata": {}, "source": _lines(text.strip("\n"))}


def _code(text: str, shown: Shown) -> dict:
    """A cell with its outputs, in the notebook format 4."""
    outputs: list[dict] = []
    if shown.text:
        outputs.append({"output_type": "stream", "name": "stdout", "text": _lines(shown.text)})
    if shown.html:
        outputs.append(_data({"text/html": _lines(shown.html), "text/plain": ["a table"]}))
    pictures = (base64.b64encode(content).decode("ascii") for content in shown.pictures)
    outputs += [_data({"image/png": content, "text/plain": ["a figure"]}) for content in pictures]
    return {
        "cell_type": "code", "execution_count": None, "metadata": {}, "outputs": outputs, "source": _lines(text.rstrip("\n")),
    }  # fmt: skip


def _data(data: dict) -> dict:
    return {"output_type": "display_data", "metadata": {}, "data": data}


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


def _notebook(cells: list[dict]) -> dict:
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return {"cells": cells, "metadata": metadata, "nbformat": 4, "nbformat_minor": 4}
