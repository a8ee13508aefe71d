"""Options that commands share, and how their words are completed."""

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
    """Accept the options of models and laws too, by the names in their records: --variant published."""

    def parse_args(self, ctx, args):
        own = {name for parameter in self.params for name in (*parameter.opts, *parameter.secondary_opts)} | {"-h", "--help"}
        if any(word.startswith("--") and word.partition("=")[0] not in own for word in args):
            ctx.meta[OPTIONS], args = _take(args, own)
        return super().parse_args(ctx, args)


OPTIONS = "stiction.options"


def _take(words: list[str], own: set[str]) -> tuple[dict[str, str], list[str]]:
    """Return the options of records among the words of a command line, by name, and the other words.

    own: options of the command itself.
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
    """Return an option of a command; names: by default the name of its parameter."""
    return typer.Option(default, *names, help=text, **more)


def argument(metavar: str, text: str, default: Any = ..., **more: Any) -> Any:
    """Return an argument of a command, required where it has no default."""
    return typer.Argument(default, metavar=metavar, help=text, **more)


def keys_of(kind: str) -> Callable[[str], list[str]]:
    """Return a completer for the keys of the records of a kind, given by its keyword in `solve`."""

    def complete(incomplete: str) -> list[str]:
        from stiction.records.registry import kinds, of_kind

        known = [key for record_kind in kinds() if record_kind.keyword == kind for key in of_kind(record_kind)]
        return [key for key in [*known, *(["none"] if kind == "tangential" else [])] if key.startswith(incomplete)]

    return complete


def names_of(module: str, function: str) -> Callable[[str], list[str]]:
    """Return a completer for the names that a function of the package lists."""
    return lambda incomplete: [name for name in getattr(import_module(module), function)() if name.startswith(incomplete)]


def every_key(incomplete: str) -> list[str]:
    """Complete a word to the key of any record."""
    from stiction.records.registry import records

    return [record.key for record in records() if record.key.startswith(incomplete)]


def chosen_laws(context: typer.Context, case: "Case") -> "Choice":
    """Return the laws and options of a case, with those that a command was given in their place."""
    from stiction.solving.choice import LAWS

    laws = {name: context.params.get(name) for name in LAWS}
    return case.choice.with_changes(laws, context.meta.get(OPTIONS, {}))


def folder(text: str | Path) -> Path:
    """Return a path to a folder; refuse an empty name, which would mean the current folder."""
    if not str(text).strip():
        raise typer.BadParameter(f"'{text}' is not the name of a folder, new or existing (a dot is the current one)")
    return Path(text)


def _checked(out: Path | None) -> Path | None:
    """Refuse a place where no folder can be before anything is computed for it."""
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
Load = Annotated[str | None, typer.Option(metavar="LOAD", help='Load that replaces the points of the case: "1 N".')]
Model = Annotated[str | None, option("Key of a model.", ..., metavar="KEY", autocompletion=keys_of("model"))]
Asperity = Annotated[str | None, option("Asperity law.", ..., autocompletion=keys_of("asperity"), **LAW)]
Tangential = Annotated[
    str | None, option("Tangential law, or none for contact only.", ..., autocompletion=keys_of("tangential"), **LAW)
]
AllRows = Annotated[bool, typer.Option("--all-rows", help="Print every point instead of about twelve.", rich_help_panel=_RARE)]
Details = Annotated[bool, typer.Option("--details", help="Print everything behind the answer.")]
