"""Define the commands that list models, materials, interfaces and citations, and the command `stiction schema`."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from stiction.cli.options import Json, argument, every_key, names_of, option
from stiction.cli.output import print_json
from stiction.cli.program import app, read, show, solving
from stiction.quantities.errors import InputError


def _show(rows: Any, json: bool, parts: Iterable[Any]) -> None:
    if json:
        print_json(rows)
    else:
        show(parts)


@app.command()
def models(
    keys: list[str] | None = argument(
        "[KEY]...",
        "Print everything about these models; without KEY, print one line for each model.",
        None,
        autocompletion=every_key,
    ),
    json: Json = False,
) -> None:
    """List every model and law by kind, with its grade and title.

    With KEY, also print its source, validity, assumptions and equations.
    """
    from stiction.report.tables import grades, model_in_full, models_list
    from stiction.solving.overview import models as all_models

    rows = all_models(keys or None)
    in_full = (part for row in rows for part in (model_in_full(row), ""))
    _show(rows, json, in_full if keys else (*models_list(rows), grades()))


@app.command()
def materials(
    names: list[str] | None = argument(
        "[NAME]...",
        "Print the source of every number of these materials; without NAME, print one line for each material.",
        None,
        autocompletion=names_of("stiction.contact.materials", "material_names"),
    ),
    json: Json = False,
) -> None:
    """List the material presets with modulus, Poisson's ratio, hardness and surface energy, each with its range.

    With NAME, also print the source of each number. stiction cite KEY prints the reference of a key in brackets.
    """
    from stiction.report.lists import material_in_full, material_rows, materials_table

    rows = material_rows(names or None)
    in_full = (part for name in names or () for part in (material_in_full(name), ""))
    _show(rows, json, in_full if names else [materials_table([row["name"] for row in rows])])


@app.command()
def interfaces(
    names: list[str] | None = argument(
        "[NAME]...",
        'Print sources and exclusions of these states, e.g. "oxidised metal"; without NAME, print one line for each state.',
        None,
        autocompletion=names_of("stiction.contact.interfaces", "interface_names"),
    ),
    json: Json = False,
) -> None:
    """List the states of an interface with shear strength and pressure coefficient, each with its range and grade.

    With NAME, also print the sources, and the contacts for which the state must not be used. stiction cite KEY prints the
    reference of a key in brackets.
    """
    from stiction.contact.interfaces import interfaces as rows_of
    from stiction.report.lists import interface_in_full, interfaces_table

    in_full = (part for name in names or () for part in (interface_in_full(name), ""))
    _show(rows_of(names or None), json, in_full if names else [interfaces_table()])


@app.command()
def cite(
    keys: list[str] | None = argument(
        "[KEY|CASE.toml]...",
        "Keys of models or sources, or case files, for the sources of their results; without KEY, print the bibliography.",
        None,
        autocompletion=every_key,
    ),
) -> None:
    """Print the BibTeX entries of models and laws, of keys of the bibliography, or of the result of a case."""
    from stiction.solving.overview import cite as bibtex_of

    wanted = list(keys or [])
    for name in [name for name in wanted if name.endswith(".toml")]:
        case = read(Path(name))
        with solving():
            from stiction.studies.case_results import sources_of_case

            wanted += sources_of_case(case)
        wanted.remove(name)
    print(bibtex_of(wanted or None), end="")


@app.command()
def schema(out: Path | None = option("File to write; by default the schema is printed.")) -> None:
    """Print the JSON schema of a case file, for editors that complete and check TOML."""
    from stiction.case.case_tables import json_schema
    from stiction.report.files import as_json

    if out is None:
        print_json(json_schema())
        return
    try:
        out.write_text(as_json(json_schema()) + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError("--out", str(out), f"a file that can be written ({error.strerror})") from None
