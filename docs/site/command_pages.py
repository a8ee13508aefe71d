"""The page of the command line, from its help."""

from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

import typer
from docstrings import as_markdown, cell

from stiction.cli import app


def commands() -> dict[str, Any]:
    """The commands by name, in the order of the help."""
    return dict(typer.main.get_command(app).commands)


def write(out: Path) -> list[PurePosixPath]:
    """One page with a section for each command."""
    folder = out / "reference"
    folder.mkdir(parents=True, exist_ok=True)
    lines = [
        "# Command line", "",
        "This page contains the output of `stiction COMMAND --help`. If an input is invalid, the command prints",
        "one line with the field, its value and the allowed values. The exit code is then 2.", "",
    ]  # fmt: skip
    for name, command in commands().items():
        lines += section(name, command)
    (folder / "command-line.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return []


def section(name: str, command: Any) -> Iterator[str]:
    """One command: what it does, and a table of what it takes."""
    given = " ".join(_asked(one) for one in command.params if not one.opts[0].startswith("-"))
    yield from (f"## `stiction {name}`", "", "```sh", f"stiction {name} {given} [OPTIONS]".replace("  ", " "), "```", "")
    yield from (as_markdown(_plain(command.help or "")), "")
    rows = [one for one in command.params if not one.hidden]
    if rows:
        yield from ("| argument or option | default | meaning |", "|---|---|---|", *map(_row, rows), "")


def _plain(text: str) -> str:
    """The help without the marks of what prints it."""
    return text.replace("\b", "").replace("\f", "").replace("<", "&lt;").replace("*", "\\*")


def _asked(one: Any) -> str:
    name = one.metavar or one.name.upper()
    return name if one.required or name.startswith("[") else f"[{name}]"


def _row(one: Any) -> str:
    if one.opts[0].startswith("-"):
        names = ", ".join(f"`{opt}`" for opt in (*one.opts, *one.secondary_opts))
        value = "" if getattr(one, "is_flag", False) else f" `{one.metavar or _value(one)}`"
    else:
        names, value = f"`{_asked(one)}`", ""
    none = one.default in (None, False, (), []) or callable(one.default)
    default = "" if none else f"`{one.default}`"
    return f"| {cell(names + value)} | {default} | {cell(_plain(one.help or ''))} |"


def _value(one: Any) -> str:
    kinds = {"int": "INTEGER", "float": "NUMBER", "Path": "PATH"}
    return kinds.get(getattr(one.type_descriptor.annotation, "__name__", ""), "TEXT")
