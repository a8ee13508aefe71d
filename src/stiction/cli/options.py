"""Define the options shared by several commands, and complete their values in the shell."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperCommand

from stiction.quantities.errors import InputError

if TYPE_CHECKING:
    from stiction.case.read import Case
    from stiction.solving.choice import Choice


class TakesOptionsOfRecords(TyperCommand):
    """Define a command that also accepts the options of models and laws, such as --variant published."""

    def parse_args(self, ctx, args):
        own = {name for parameter in self.params for name in (*parameter.opts, *parameter.secondary_opts)} | {"-h", "--help"}
        if any(word.startswith("--") and word.partition("=")[0] not in own for word in args):
            ctx.meta[OPTIONS], args = _split_options(args, own)
        return super().parse_args(ctx, args)


OPTIONS = "stiction.options"


def _split_options(words: list[str], own: set[str]) -> tuple[dict[str, str], list[str]]:
    """Split the words of a command line into the options of models and laws, {name: value}, and the other words.

    own: options of the command itself, which remain among the other words. Raises InputError for a value that an option does
    not allow.
    """
    from stiction.records.registry import all_options

    known = {f"--{name.replace('_', '-')}": (name, values) for name, values in all_options().items()}
    options, rest, left = {}, [], iter(words)
    for word in left:
        flag, _, value = word.partition("=")
        if flag in own or flag not in known:
            rest.append(word)
            continue
        name, values = known[flag]
        taken = value or next(left, None)
        if taken not in values:
            raise InputError(flag, taken, ", ".join(values))
        options[name] = taken
    return options, rest


def option(text: str, default: Any = None, *names: str, **more: Any) -> Any:
    """Return a command option with this help text.

    default: value without the option. names: names of the option; by default the name of the parameter. more: arguments of
    `typer.Option`.
    """
    return typer.Option(default, *names, help=text, **more)


def argument(metavar: str, text: str, default: Any = ..., **more: Any) -> Any:
    """Return a positional argument of a command with this help text; without a default it is required.

    metavar: name of the argument in the help. more: arguments of `typer.Argument`.
    """
    return typer.Argument(default, metavar=metavar, help=text, **more)


def keys_of(kind: str) -> Callable[[str], list[str]]:
    """Return a shell completer for the keys of one kind of model or law: a function of the typed text.

    kind: keyword of the kind in `solve`, e.g. "asperity".
    """

    def complete(incomplete: str) -> list[str]:
        from stiction.records.registry import kinds, of_kind

        known = [key for record_kind in kinds() if record_kind.keyword == kind for key in of_kind(record_kind)]
        return [key for key in [*known, *(["none"] if kind == "tangential" else [])] if key.startswith(incomplete)]

    return complete


def names_of(module: str, function: str) -> Callable[[str], list[str]]:
    """Return a shell completer for the names that a function without arguments returns.

    module, function: names of a module and a function in it. The module is imported only when the shell completes.
    """
    return lambda incomplete: [name for name in getattr(import_module(module), function)() if name.startswith(incomplete)]


def every_key(incomplete: str) -> list[str]:
    """Return the keys of all models and laws that begin with this text."""
    from stiction.records.registry import records

    return [record.key for record in records() if record.key.startswith(incomplete)]


def chosen_laws(context: typer.Context, case: "Case") -> "Choice":
    """Return the model, laws and options of a case; those on the command line replace those in the case file."""
    from stiction.solving.choice import LAWS

    laws = {name: context.params.get(name) for name in LAWS}
    return case.choice.with_changes(laws, context.meta.get(OPTIONS, {}))


def folder(text: str | Path) -> Path:
    """Return the path of a folder; raise BadParameter for an empty name, which pathlib would take for the current folder."""
    if not str(text).strip():
        raise typer.BadParameter(f"'{text}' is not the name of a folder, new or existing (a dot is the current one)")
    return Path(text)


def _checked(out: Path | None) -> Path | None:
    """Return the output folder unchanged; raise InputError, before anything is computed, if it cannot be created."""
    if out is not None:
        from stiction.report.files import check_folder

        check_folder(out)
    return out


_RARE = "Rarely used"
LAW: dict[str, Any] = {"metavar": "KEY", "rich_help_panel": "Laws that replace those of the case (stiction models)"}
Out = Annotated[
    Path | None,
    typer.Option("--out", parser=folder, callback=_checked, metavar="FOLDER", help="Folder to write results to."),
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object only.")]
Ranges = Annotated[
    bool | None,
    typer.Option("--ranges/--no-ranges", help="Vary material numbers within their ranges.", rich_help_panel=_RARE),
]
Load = Annotated[
    str | None, typer.Option(metavar="LOAD", help='Load, e.g. "1 N", instead of the loads or separations of the case.')
]
Model = Annotated[str | None, option("Key of a model.", ..., metavar="KEY", autocompletion=keys_of("model"))]
Asperity = Annotated[str | None, option("Asperity law.", ..., autocompletion=keys_of("asperity"), **LAW)]
Tangential = Annotated[
    str | None, option("Tangential law, or none for contact only.", ..., autocompletion=keys_of("tangential"), **LAW)
]
AllRows = Annotated[bool, typer.Option("--all-rows", help="Print every point instead of about twelve.", rich_help_panel=_RARE)]
Details = Annotated[bool, typer.Option("--details", help="Print all details of the answer.")]
