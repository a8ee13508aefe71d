"""`stiction design`: the coating, thickness, roughness and load that come nearest to what is wished."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Out, app, busy, console, telling_how_far, writing, written

if TYPE_CHECKING:
    import xarray

    from stiction.studies.design.run import Designing


@app.command()
def design(
    case: Annotated[
        Path, typer.Argument(metavar="CASE.toml", help="Case file with a table [design]: choices, wishes, limits.")
    ],
    out: Out = None,
    json: Json = False,
) -> None:
    """Choose materials, thickness, roughness or load so that a wish comes true and limits are kept.

    The case says in [design] what is wished, in [design.choose] what may be chosen, in [design.limits] what must hold.
    With two wishes, also the designs of which none is better in both. With --out: designed.toml, a case that `stiction run`
    takes, design.csv, front.csv, design.png, design.nc. Interrupted, it keeps the best so far.
    """
    from stiction.report.files import check_folder

    if out is not None:
        check_folder(out)
    with busy("Reading the case"):
        from stiction.studies.design.run import plan_of_design, run_design

        plan = plan_of_design(case)
    with telling_how_far("Designing") as tell:
        found = run_design(plan, lambda count, text: tell(f"Designing: {count} designs asked"))
    data = found.data()
    names = _write(out, found, data) if out is not None else []
    if json:
        from stiction.report.files import record

        print_json(record(data.drop_vars("best_so_far"), {}))
    else:
        _print(data)
        if out is not None:
            written(out, names)
    if found.stopped:
        raise KeyboardInterrupt


def _print(data: "xarray.Dataset") -> None:
    from stiction.report.design_tables import design_notes, design_table

    terminal = console()
    if "case" in data.attrs:
        terminal.print(data.attrs["case"], style="bold", highlight=False, markup=False)
    terminal.print(f"model {data.attrs['model']}; {data.attrs['asked']} designs asked", "", sep="\n", highlight=False)
    terminal.print("best for each choice from the lists" if data.sizes["design"] > 1 else "best", highlight=False)
    terminal.print(design_table(data, "design"), "")
    if data.sizes.get("front"):
        terminal.print("none is better in both wishes than any of these", highlight=False)
        terminal.print(design_table(data, "front"), "")
    for note in design_notes(data):
        terminal.print(note)


def _figure(data: "xarray.Dataset"):
    from stiction.report.design_pictures import design_figure

    return design_figure(data)


def _write(out: Path, found: "Designing", data: "xarray.Dataset") -> list[str]:
    """Write the designed case, tables and the picture; returns their names."""
    with writing():
        from stiction.report.design_tables import design_rows
        from stiction.report.files import write_folder, write_netcdf, write_picture, write_rows

        files = {
            "designed.toml": lambda path: path.write_text(found.case_text(out), encoding="utf-8"),
            "design.csv": lambda path: write_rows(path, *design_rows(data, "design")),
            "design.png": lambda path: write_picture(_figure(data), path),
            "design.nc": lambda path: write_netcdf(data, path),
        }
        if data.sizes.get("front"):
            files["front.csv"] = lambda path: write_rows(path, *design_rows(data, "front"))
        write_folder(out, files)
    return list(files)
