"""`stiction report`: one case as one page, to be read, printed and sent."""

from pathlib import Path
from typing import Annotated, Any

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, Ranges, app, bar, busy, console


@app.command()
def report(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact and what to solve.")],
    out: Annotated[Path, typer.Option("--out", metavar="FILE.html", help="The page; one that is there is replaced.")],
    load: Annotated[str | None, typer.Option(help='Working load, e.g. "1 N"; default: the middle one of the case.')] = None,
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """One file of HTML that holds all of itself: the answer with its doubt, inputs and sources, pictures, every model compared.

    It is read without a network and without scripts, on paper too, and holds the case file to run it again. With --json the
    answer is printed as numbers, besides. Where numbers of the case are several, models are not compared.
    """
    with busy("Reading the case"):
        from stiction.report.html_report import write_report
    found: dict[str, Any] = write_report(case, out, load=load, ranges=ranges, progress=bar)
    if json:
        print_json(found | {"file": str(out)})
        return
    terminal = console()
    terminal.print(found["answer_in_words"], highlight=False, markup=False)
    terminal.print(f"written to {out}", highlight=False, markup=False, soft_wrap=True)
