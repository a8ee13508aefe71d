"""Define the application to which all commands belong, its exit codes and its progress lines."""

import re
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from stiction.cli.interrupting import INTERRUPTED
from stiction.cli.output import closed_pipe, exit_on_write_error, print_json
from stiction.quantities.errors import InputError, InputWarning
from stiction.quantities.extras import how_to_install
from stiction.quantities.notices import Notice
from stiction.quantities.uninterrupted import uninterrupted

if TYPE_CHECKING:
    from stiction.case.read import Case
    from stiction.report.view import View

_BAD_INPUT = 2
_TABLE = re.compile(r"\[(?=[a-z])")
_TRAILING = re.compile(r" +$", re.MULTILINE)
_LINE_ENDS = re.compile(r"(?<!\n)\n *(?=\S)")  # inside a paragraph; the terminal wraps the text itself


class _Commands(TyperGroup):
    """Define the group of all commands, which reports wrong input and wrong usage in one line, without a traceback.

    Exit codes: 2 for wrong input and wrong usage, 130 for an interruption.
    """

    def __init__(self, *positional, **named):
        super().__init__(*positional, **named)
        parts: list[Any] = [part for command in self.commands.values() for part in (command, *command.params)]
        for item in parts:
            if getattr(item, "help", None):  # rich would take "[fit]", a table of a case, for a style
                item.help = _LINE_ENDS.sub(" ", _TABLE.sub(r"\\[", item.help))

    def make_context(self, info_name, args, parent=None, **extra):
        if not args:  # without arguments typer prints the help
            return super().make_context(info_name, args, parent, **extra)
        with _one_line():
            return super().make_context(info_name, args, parent, **extra)

    def resolve_command(self, ctx, args):
        if args[0] not in self.commands and not args[0].startswith("-"):
            raise InputError("command", args[0], ", ".join(self.commands))
        return super().resolve_command(ctx, args)

    def invoke(self, ctx):
        with _one_line():
            return super().invoke(ctx)


@contextmanager
def _one_line() -> Iterator[None]:
    """Return a context manager that prints the errors and warnings meant for users as one line each, and sets the exit code."""
    try:
        with warnings.catch_warnings():
            for category in _SAID:
                warnings.simplefilter("always", category)
            warnings.showwarning = _say_in_a_line
            yield
    except InputError as error:
        print(f"stiction: {error}", file=sys.stderr)
        raise typer.Exit(_BAD_INPUT) from None
    except typer.TyperException as error:
        print(f"stiction: {_as_input(error)}", file=sys.stderr)
        raise typer.Exit(_BAD_INPUT) from None
    except BrokenPipeError as error:
        exit_on_write_error(error)
    except KeyboardInterrupt:
        print("stiction: interrupted", file=sys.stderr)
        raise typer.Exit(INTERRUPTED) from None
    except typer.Exit:
        raise
    except Exception as error:
        from stiction.records.record import plug_in_error

        plug_in = plug_in_error(error)
        if plug_in is None:
            raise
        print(f"stiction: {plug_in}", file=sys.stderr)
        raise typer.Exit(_BAD_INPUT) from None


# Warnings for users: improbable inputs, and things that the program could not do.
_SAID = (InputWarning, Notice)


def _say_in_a_line(message: Any, category: Any, *where: Any, **more: Any) -> None:
    if issubclass(category, _SAID):
        print(f"stiction: {'input warning: ' if category is InputWarning else ''}{message}", file=sys.stderr)


def _as_input(error: Any) -> InputError:
    """Convert a usage error of typer to an InputError with field, value and allowed values."""
    message: str = error.message
    command: Any = getattr(error.ctx, "command", None)
    if hasattr(error, "param_type"):
        meaning = (error.param.help or "a value").replace("\\[", "[")  # undoes the escape of brackets for rich
        return InputError(_name(error.param), None, meaning.rstrip("."))
    if hasattr(error, "param"):
        value, allowed = _refused(error)
        return InputError(_name(error.param), value, allowed)
    if hasattr(error, "possibilities"):
        known = (
            [name for each in command.get_params(error.ctx) for name in each.opts if name.startswith("--")] if command else []
        )
        return InputError("option", error.option_name, ", ".join(known) or "an option of this command")
    if hasattr(error, "option_name"):
        value_text, allowed = (None, "a value after it") if "requires" in message else ("with a value", "without a value")
        return InputError(error.option_name, value_text, allowed)
    if hasattr(command, "commands"):
        return InputError("command", None, ", ".join(command.commands))
    names = [_name(parameter) for parameter in command.params if parameter.param_type_name == "argument"] if command else []
    extra = message.rstrip(").").rpartition("(")[2]  # "Got unexpected extra arguments (b c)"
    return InputError("arguments", extra, " ".join([*names, "and options"]) if names else "options only")


def _name(param: Any) -> str:
    """Return the name of an option as the user types it, e.g. "--load", or the name of an argument."""
    return next((name for name in param.opts if name.startswith("--")), param.metavar or param.name)


def _refused(error: Any) -> tuple[Any, str]:
    """Return the value that typer or pydantic rejected, and a text with the allowed values.

    typer writes "'abc' is not a valid float". pydantic writes "Input should be a valid number, ..." and has the value in the
    cause of the error.
    """
    value, _, allowed = error.message.rstrip(".").rpartition(" is not ")
    if (cause := error.__cause__) is not None and hasattr(cause, "errors"):
        value, allowed = cause.errors()[0]["input"], error.message.removeprefix("Input should be ").partition(", ")[0]
    return value.strip("'") if isinstance(value, str) else value, allowed


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        from stiction import __version__

        print(f"stiction {__version__}")
        raise typer.Exit


@app.callback()
def _stiction(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """Predict the static friction of rough, adhesive, possibly soft-coated contacts: every number with its source."""


def console():
    from stiction.report.terminal import Terminal

    terminal: Any = Terminal()
    terminal.on_broken_pipe = closed_pipe  # rich's own handler ends the program without a message
    return terminal


@contextmanager
def busy(text: str) -> Iterator[None]:
    """Return a context manager that shows a line with a text and a running clock on the terminal."""
    with _line(text):
        yield


@contextmanager
def progress_text() -> Iterator[Callable[[str], None]]:
    """Return a context manager that provides a function, which shows its argument (a text) as progress.

    On a terminal each text replaces the previous one. Elsewhere a text is printed at most every ten seconds.
    """
    with _line("") as line:
        if line is not None:
            yield line.say
            return
        from time import monotonic

        printed_at = [-inf]

        def say(how_far: str) -> None:
            if monotonic() - printed_at[0] > _EVERY:
                printed_at[0] = monotonic()
                print(how_far, file=sys.stderr, flush=True)

        yield say


_EVERY = 10.0  # seconds between printed lines if the output is not a terminal


@contextmanager
def solving() -> Iterator[None]:
    """Return a context manager that shows a clock, the number of compiled kernels and the solver's residual on the terminal."""
    with _line("Solving") as line, _showing_solver_state(line, "Solving"):
        yield


def bar(text: str):
    """Return a function that takes a list and yields its items while showing a progress bar.

    text: label of the bar.
    """

    def wrapped(steps):
        with _line(text) as line, _showing_solver_state(line, text):
            yield from line.over(steps) if line else steps

    return wrapped


@dataclass(frozen=True)
class _Line:
    """Show a progress line on the terminal, with a text that can be replaced."""

    progress: Any
    task: Any

    def say(self, text: str) -> None:
        self.progress.update(self.task, description=text)

    def over(self, steps: Iterable) -> Iterable:
        return self.progress.track(steps, task_id=self.task)


@contextmanager
def _line(text: str) -> Iterator[_Line | None]:
    """Return a context manager that provides a progress line, or None if standard error is not a terminal.

    text: label of the line, which has a bar and a clock.
    """
    from rich.console import Console

    terminal = Console(stderr=True)
    if not terminal.is_terminal:
        yield None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=terminal, transient=True) as progress:
        yield _Line(progress, progress.add_task(text, total=None))


@contextmanager
def _showing_solver_state(line: _Line | None, text: str) -> Iterator[None]:
    """Return a context manager that shows the number of compiled kernels and the residual of the map solver in a progress line.

    line: progress line, or None to show nothing. text: label of the line.
    """
    if line is None:
        yield
        return
    from stiction.engine.compiling import telling
    from stiction.solvers.boundary_elements.listeners import listening as listening_to_solver

    with (
        telling(lambda done, name: line.say(f"{text}: compiling {name}, once per installation ({done} kernels done)")),
        listening_to_solver(
            lambda step: line.say(f"{text}: load {step.load + 1} of {step.loads}, residual {step.residual:.1e}")
        ),
    ):
        yield


def read(path: Path, load: str | None = None, ranges: bool | None = None) -> "Case":
    """Return the case of a case file.

    load: replaces the loads or separations of the case. ranges: replaces the setting whether material numbers vary within their
    ranges. None leaves the case unchanged.
    """
    with busy("Reading the case"):
        from stiction.case.read import read_case

        return read_case(path, ranges=ranges).at_load(load)


def present(view: "View", out: Path | None, json: bool, details: bool = True) -> None:
    """Print a result, or its JSON, and write its files if an output folder is given.

    details: print everything instead of the short answer. Raises KeyboardInterrupt at the end if the study was interrupted.
    """
    names = []
    if out is not None:
        with busy("Writing the results"), uninterrupted():  # Ctrl-C must not lose results that took long
            names = view.write(out)
    if json:
        print_json(view.record())
    else:
        from stiction.report.view import in_short

        brief = details or view.is_brief
        show(view.parts() if brief else in_short((view.short or view.parts)(), console().width, out is not None))
        if out is not None:
            written(out, names)
    if view.data is not None and view.data.attrs.get("stopped"):
        raise KeyboardInterrupt


def show(parts: Iterable[Any]) -> None:
    """Print texts and tables on the terminal.

    A text with `no_wrap` is printed on one line. If its `overflow` allows it, a terminal cuts this line at its width; a file or
    pipe receives the whole line. Trailing blanks are removed.
    """
    from rich.text import Text

    terminal = console()
    for part in parts:
        text = Text(part) if isinstance(part, str) else part
        line = isinstance(text, Text) and bool(text.no_wrap)
        cut = text.overflow if line and terminal.is_terminal else None
        with terminal.capture() as printed:
            terminal.print(text, soft_wrap=line and not cut, no_wrap=line, overflow=cut)
        terminal.file.write(_TRAILING.sub("", printed.get()))


def written(folder: Path, names) -> None:
    """Print the names of the written files, and of the pictures that were not drawn because matplotlib is missing.

    folder: folder of the files. names: names of all files, whether drawn or not.
    """
    from stiction.report.files import undrawn_of

    undrawn = undrawn_of(names)
    there = [name for name in names if name not in undrawn]
    terminal = console()
    lines = wrap(f"written to {folder}: {', '.join(there)}", terminal.width, break_long_words=False, break_on_hyphens=False)
    terminal.print("\n".join(lines), highlight=False, markup=False, soft_wrap=True)
    if undrawn:
        print(f"stiction: not drawn without matplotlib: {', '.join(undrawn)}; {how_to_install('matplotlib')}", file=sys.stderr)
