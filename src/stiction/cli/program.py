"""The program that the commands belong to, and what they share: options, exit codes, waiting lines and bars."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from typer.core import TyperGroup

from .. import __version__
from ..errors import InputError

_BAD_INPUT, _INTERRUPTED = 2, 130


class _Commands(TyperGroup):
    """Bad input is one line and exit code 2, an interruption exit code 130; neither is a traceback."""

    def invoke(self, ctx):
        try:
            return super().invoke(ctx)
        except InputError as error:
            print(f"stiction: {error}", file=sys.stderr)
            raise typer.Exit(_BAD_INPUT) from None
        except KeyboardInterrupt:
            print("stiction: interrupted", file=sys.stderr)
            raise typer.Exit(_INTERRUPTED) from None


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


Out = Annotated[Path | None, typer.Option("--out", help="Folder for the results; other files in it stay.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Reading = Annotated[str | None, typer.Option(help="corrected (default), or published: the 2015 paper to the letter.")]


def _version(wanted: bool) -> None:
    if wanted:
        print(f"stiction {__version__}")
        raise typer.Exit


@app.callback()
def _stiction(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """Static friction of rough, adhesive, possibly soft-coated contacts: every number with its source."""


def console():
    from rich.console import Console

    return Console()


def solving() -> str:
    """What the waiting line says: a model's first use on this machine takes some ten seconds more."""
    from ..compiled import cache_folder

    compiled = any(cache_folder().rglob("*.nbi"))
    return "Solving" if compiled else "Compiling kernels (once per installation, 10 s)"


@contextmanager
def busy(text: str) -> Iterator[None]:
    """A line with a running clock on the terminal while something goes on, gone when it is done."""
    with _progress() as progress:
        progress.add_task(text, total=None)
        yield


def bar(text: str):
    """A wrapper of a loop's list that shows how far the loop is."""

    def wrapped(steps):
        with _progress() as progress:
            yield from progress.track(steps, description=text)

    return wrapped


def _progress():
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    terminal = Console(stderr=True)
    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    return Progress(*columns, console=terminal, transient=True, disable=not terminal.is_terminal)


def written(folder: Path, names) -> None:
    """Say where the results are."""
    console().print(f"written to {folder}: {', '.join(names)}", highlight=False, markup=False, soft_wrap=True)
