"""`stiction run`: one case, solved."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from stiction.cli.options import (
    AllRows,
    Asperity,
    Details,
    Json,
    Load,
    Out,
    Ranges,
    TakesOptionsOfRecords,
    Tangential,
    argument,
    chosen_laws,
    keys_of,
    option,
)
from stiction.cli.program import app, present, read, solving
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES

if TYPE_CHECKING:
    pass

# Inputs of the Python interface that no case file has.
_NOT_IN_CASES = ("interfacial_energy", "equilibrium_distance")


def case_numbers() -> str:
    """Unit and bounds of every number of a case file, a paragraph for each, for --help."""
    rows = [row for row in QUANTITIES.values() if row.example and row.name not in _NOT_IN_CASES]
    lines = [f"{row.name}: {row.meaning}; {row.wanted}" for row in rows]
    return "\n\n".join(["Numbers of a case file, text with its unit where it has one:", *lines])


@app.command(cls=TakesOptionsOfRecords, epilog=case_numbers())
def run(
    context: typer.Context,
    case: Path = argument("CASE.toml", "Case file: what is in contact and what to solve."),
    out: Out = None,
    model: str | None = option("Any model that stiction compare shows, or: recommended.", autocompletion=keys_of("model")),
    asperity: Asperity = None,
    tangential: Tangential = None,
    film: str | None = option("Film law in place of its own.", autocompletion=keys_of("film")),
    presliding: str | None = option("mindlin_1949: also the tangential stiffness before sliding."),
    meniscus: str | None = option("Law of menisci of a liquid; none: without.", autocompletion=keys_of("meniscus")),
    ageing: str | None = option("Law of strengthening at rest; none: without.", autocompletion=keys_of("ageing")),
    contamination: str | None = option("Law of junctions that differ; none: without.", autocompletion=keys_of("contamination")),
    sliding: bool = option(
        "Tangential force against displacement up to sliding, at five of the points at most.", False, "--sliding"
    ),
    kept: float = option("With --sliding: share of its strength that an asperity keeps once it slides, 0 to 1.", 1.0),
    load: Load = None,
    all_rows: AllRows = False,
    details: Details = False,
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """Answer a case: its friction coefficient with an interval, and what the interval comes from.

    Where neither the command nor the case names a model or a law, all that is known is drawn together (st.predict). With a
    model, that model is solved: friction coefficient, contact area and load along a curve, of which the table shows about
    twelve points, --all-rows every one. With --out: curve.csv (with comments after #), curve.nc (netCDF4) and curve.png. What
    is given here overrides the case file; the options of a model or a law may be given too, such as --reading published:
    stiction models KEY names them.
    Any number of the contact may be several, a list or {start, stop, count, spacing}: then the picture and the table show mu
    against it. Where numbers are uncertain, "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or {samples}, or numbers of
    materials vary within their --ranges, mu has a band, with the error of its sampling, drawn in uncertainty.png. Where the
    case names scans, the spread of mu over the methods of finding asperities is its error band, drawn in band.png.
    """
    if kept != 1.0 and not sliding:
        raise InputError("--kept", kept, "nothing without --sliding")
    chosen = read(case, load, ranges)
    laws = chosen_laws(context, chosen)
    with solving():
        from stiction.studies.case_results import slide_case, solve_case
        from stiction.studies.prediction.predict import is_predicted, predict

        predicted = not sliding and is_predicted(replace(chosen, choice=laws))
        data = predict(chosen) if predicted else slide_case(chosen, laws, kept) if sliding else solve_case(chosen, laws)
    if predicted:
        from stiction.report.views.prediction import prediction_view

        present(prediction_view(chosen, data, str(case), details), out, json)
    elif sliding:
        from stiction.report.views.sliding import sliding_view

        present(sliding_view(chosen, data), out, json, details)
    else:
        from stiction.report.views.run import run_view

        present(run_view(chosen.with_surface_moments(data.attrs["model"]), data, all_rows), out, json, details or all_rows)
