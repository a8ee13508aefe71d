"""Define the commands of all studies in the package `studies`, and the commands `report` and `validate`."""

import inspect
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import typer

from stiction.cli.options import (
    OPTIONS,
    AllRows,
    Asperity,
    Details,
    Json,
    Load,
    Model,
    Out,
    Ranges,
    TakesOptionsOfRecords,
    Tangential,
    argument,
    option,
)
from stiction.cli.output import print_json
from stiction.cli.program import app, bar, busy, console, present, progress_text
from stiction.studies.study import Study, studies

# Name of a parameter of `study.plan` -> annotation and default of its option.
_SHARED: dict[str, tuple[Any, Any]] = {
    "load": (Load, None), "ranges": (Ranges, None), "model": (Model, None), "asperity": (Asperity, None),
    "tangential": (Tangential, None), "all_rows": (AllRows, False), "out": (Out, None), "details": (Details, False),
    "json": (Json, False),
}  # fmt: skip


def _add_command(folder: str, study: Study) -> None:
    """Add the command of a study to the application.

    folder: folder of the study in the package `studies`. The options are the parameters of `study.plan`, and --out, --details
    and --json.
    """
    own = inspect.signature(study.plan).parameters

    def command(context: typer.Context, **arguments: Any) -> None:
        arguments["options"] = context.meta.get(OPTIONS, {})
        with busy("Reading the case"):
            plan = study.plan(**{name: arguments[name] for name in own})
        if "callback" in inspect.signature(study.run).parameters:
            with progress_text() as callback:
                result = study.run(plan, callback)
        else:
            result = study.run(plan, bar)
        place = f"stiction.report.views.{folder}"
        if find_spec(place):
            view = getattr(import_module(place), f"{folder}_view")
        else:
            from stiction.report.views.dataset import dataset_view

            view = partial(dataset_view, study.name)
        present(view(*result), arguments["out"], arguments["json"], arguments["details"])

    taken: dict[str, Any] = {
        "context": (typer.Context, inspect.Parameter.empty),
        "case": (Path, argument("CASE.toml", study.case)),
    }
    for name, parameter in own.items():
        if name not in ("case", "options"):
            taken[name] = (
                (parameter.annotation, parameter.default) if hasattr(parameter.annotation, "__metadata__") else _SHARED[name]
            )
    taken |= {name: _SHARED[name] for name in ("out", "details", "json") if name not in taken}
    command.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, annotation=annotation, default=default)
            for name, (annotation, default) in taken.items()
        ]
    )
    app.command(study.name, help=study.help, cls=TakesOptionsOfRecords if "options" in own else None)(command)


for _folder, _study in studies():
    _add_command(_folder, _study)


@app.command()
def report(
    case: Path = argument("CASE.toml", "Case file: what is in contact and what to solve."),
    out: Path = option("File to write; an existing file is replaced.", ..., "--out", metavar="FILE.html|.pdf"),
    load: str | None = option('Working load, e.g. "1 N"; default: the middle load of the case.'),
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """Write a report to one file: answer, validity warnings, inputs with sources, pictures, and a comparison of all models.

    The file needs neither network nor scripts, can be printed, and contains the case file. --json prints the answer as JSON
    instead of in words. Models are not compared if any number in the case is an array.
    """
    with busy("Reading the case"):
        from stiction.report.html_report import write_report
    answer = write_report(case, out, load=load, ranges=ranges, progress=bar)
    if json:
        print_json(answer | {"file": str(out)})
        return
    terminal = console()
    terminal.print(answer["answer_in_words"], highlight=False, markup=False)
    terminal.print(f"written to {out}", highlight=False, markup=False, soft_wrap=True)


@app.command()
def validate(
    entry: Path = argument("ENTRY.toml", "Entry (a file with a contact and a measured series), or a folder of entries."),
    out: Out = None,
    json: Json = False,
) -> None:
    """Compare the prediction and every applicable model with measured friction.

    ENTRY.toml has the table [contact] of a case file, and the table [measured] with the source and a CSV file of measured
    values. Tables [[measured.band]] with published ranges may replace the CSV file. For a folder, all entries in it are
    compared. The result is the ratio of predicted to measured friction. --out writes a CSV file for each entry with the values
    of each model, and a picture of the prediction.
    """
    with busy("Reading the measured series"):
        from stiction.studies.validation import entries_in, read_entry
        from stiction.studies.validation import validate as validated

        paths = entries_in(entry) if entry.is_dir() else [entry]
        entries = [read_entry(path) for path in paths]
    results = [validated(entry_read, progress=bar(path.stem)) for entry_read, path in zip(entries, paths, strict=True)]
    from stiction.report.views.validation import validation_view

    present(validation_view({path.stem: data for path, data in zip(paths, results, strict=True)}), out, json)
