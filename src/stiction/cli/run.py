"""`stiction run`: one case, solved."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stiction.cli.program import (
    AllRows,
    Asperity,
    Details,
    Json,
    Load,
    Out,
    Ranges,
    TakesOptionsOfRecords,
    Tangential,
    app,
    busy,
    keys_of,
    options_of_records,
    present,
    solving,
)
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case
    from stiction.report.view import View

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
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file: what is in contact and what to solve.")],
    out: Out = None,
    model: Annotated[
        str | None,
        typer.Option(help="Any model that stiction compare shows, or: recommended.", autocompletion=keys_of("model")),
    ] = None,
    asperity: Asperity = None,
    tangential: Tangential = None,
    film: Annotated[str | None, typer.Option(help="Film law in place of its own.", autocompletion=keys_of("film"))] = None,
    presliding: Annotated[str | None, typer.Option(help="mindlin_1949: also the tangential stiffness before sliding.")] = None,
    meniscus: Annotated[
        str | None, typer.Option(help="Law of menisci of a liquid; none: without.", autocompletion=keys_of("meniscus"))
    ] = None,
    ageing: Annotated[
        str | None, typer.Option(help="Law of strengthening at rest; none: without.", autocompletion=keys_of("ageing"))
    ] = None,
    contamination: Annotated[
        str | None, typer.Option(help="Law of junctions that differ; none: without.", autocompletion=keys_of("contamination"))
    ] = None,
    sliding: Annotated[
        bool,
        typer.Option("--sliding", help="Tangential force against displacement up to sliding, at five of the points at most."),
    ] = False,
    kept: Annotated[
        float, typer.Option(help="With --sliding: share of its strength that an asperity keeps once it slides, 0 to 1.")
    ] = 1.0,
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
    with busy("Reading the case"):
        from stiction.case.read import read_case

        chosen = read_case(case, ranges=ranges)
        chosen = chosen if load is None else chosen.at_load(load)
    laws = {
        "model": model,
        "asperity": asperity,
        "tangential": tangential,
        "film": film,
        "presliding": presliding,
        "meniscus": meniscus,
        "ageing": ageing,
        "contamination": contamination,
    }
    if kept != 1.0 and not sliding:
        raise InputError("--kept", kept, "nothing without --sliding")
    if sliding:
        from stiction.report.views.sliding import sliding_view

        present(sliding_view(chosen, _slide(chosen, laws, options_of_records(context), kept)), out, json, details)
        return
    options = options_of_records(context)
    if _is_predicted(chosen, laws, options):
        present(_predicted(chosen, str(case), details), out, json)
        return
    data = _solve(chosen, laws, options)
    chosen = chosen.with_surface_moments(data.attrs["model"])
    from stiction.report.views.run import run_view

    present(run_view(chosen, data, all_rows), out, json, details or all_rows)


def _is_predicted(case: "Case", laws: Mapping[str, str | None], options: Mapping[str, str]) -> bool:
    from stiction.studies.prediction.predict import is_predicted

    return is_predicted(replace(case, choice=case.choice.with_changes(laws, options)))


def _predicted(case: "Case", file: str, details: bool) -> "View":
    with solving():
        from stiction.studies.prediction.predict import predict

        data = predict(case)
    from stiction.report.views.prediction import prediction_view

    return prediction_view(case, data, file, details)


def _solve(case: "Case", laws: Mapping[str, str | None], options: Mapping[str, str]) -> "xarray.Dataset":
    with solving():
        from stiction.studies.case_results import solve_case

        return solve_case(case, case.choice.with_changes(laws, options))


def _slide(case: "Case", laws: Mapping[str, str | None], options: Mapping[str, str], kept: float) -> "xarray.Dataset":
    with solving():
        from stiction.studies.case_results import slide_case

        return slide_case(case, case.choice.with_changes(laws, options), kept)
