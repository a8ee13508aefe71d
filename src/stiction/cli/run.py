"""Define the commands `stiction run`, which solves a case, and `stiction slide`, which displaces it until it slides."""

from collections.abc import Callable
from dataclasses import replace
from inspect import Parameter, Signature, signature
from pathlib import Path

import typer

from stiction.cli.options import (
    LAW,
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
from stiction.records.additions import names_of_additions


def run(
    context: typer.Context,
    case: Path = argument("CASE.toml", "Case file: what is in contact and what to solve."),
    out: Out = None,
    load: Load = None,
    model: str | None = option("Key of a model, or recommended.", metavar="KEY", autocompletion=keys_of("model")),
    details: Details = False,
    json: Json = False,
    all_rows: AllRows = False,
    ranges: Ranges = None,
    asperity: Asperity = None,
    tangential: Tangential = None,
    film: str | None = option("Film law.", autocompletion=keys_of("film"), **LAW),
    **beside: str | None,
) -> None:
    """Predict the friction coefficient of a case with its interval, and show what the interval depends on.

    By default all applicable models are combined. If the command or the case names a model, a law or an option, one model is
    solved at the loads or separations of the case. --out writes curve.csv, curve.nc (netCDF4) and pictures. stiction models KEY
    lists the options of a model or law, such as --variant published. Command-line options replace those in the case file.

    In the case file a number may be an array (a list, or {start, stop, count, spacing}) or uncertain ("0.5 +/- 0.1 GPa",
    {low, high}, {median, factor}, {samples}). stiction schema lists every number with its unit and bounds.
    """
    chosen = read(case, load, ranges)
    laws = chosen_laws(context, chosen)
    with solving():
        from stiction.studies.case_results import solve_case
        from stiction.studies.prediction.around import predict_with_curve
        from stiction.studies.prediction.predict import is_predicted, predict

        curve = None
        if predicted := is_predicted(replace(chosen, choice=laws)):
            data, curve = (predict(chosen), None) if out is None else predict_with_curve(chosen)
        else:
            data = solve_case(chosen, laws)
    if predicted:
        from stiction.report.views.prediction import prediction_view

        present(prediction_view(chosen, data, str(case), details, out is not None, curve), out, json)
    else:
        from stiction.report.views.run import run_view

        present(run_view(chosen.with_surface_moments(data.attrs["model"]), data, all_rows), out, json, details or all_rows)


def slide(
    context: typer.Context,
    case: Path = argument("CASE.toml", "Case file: what is in contact and what to solve."),
    out: Out = None,
    load: Load = None,
    model: str | None = option("A sum over asperities, or boundary_elements.", metavar="KEY", autocompletion=keys_of("model")),
    details: Details = False,
    json: Json = False,
    ranges: Ranges = None,
    asperity: Asperity = None,
    tangential: Tangential = None,
    residual_strength: float | None = option("Residual strength of a sliding asperity or map point, as a fraction."),
    weakening_slip: str | None = option("Slip over which a point of a map falls to its residual strength, e.g. '10 nm'."),
    spring_stiffness: str | None = option("Stiffness of the machine that moves a map, e.g. '100 N/mm'."),
    tangential_force: str | None = option("Tangential force on a map, instead of displacements, e.g. '1 mN'."),
    **beside: str | None,
) -> None:
    """Compute the tangential force of a contact against its tangential displacement, from rest to sliding.

    Asperities slip one after another. With --model boundary_elements, the points of a map slip instead. At most five loads or
    separations of the case are computed. --out writes sliding.csv, sliding.nc (netCDF4), a picture and, for a map, the
    animation sliding.gif.
    """
    chosen = read(case, load, ranges)
    laws = chosen_laws(context, chosen)
    with solving():
        from stiction.studies.case_results import slide_case

        data = slide_case(
            chosen, laws, residual_strength=residual_strength, weakening_slip=weakening_slip,
            spring_stiffness=spring_stiffness, tangential_force=tangential_force,
        )  # fmt: skip
    from stiction.report.views.sliding import sliding_view

    present(sliding_view(chosen, data), out, json, details)


def _with_options_of_additions(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command an option for each kind of law that can be added to a model, such as menisci, and return the command."""
    own = [item for item in signature(command).parameters.values() if item.kind is not Parameter.VAR_KEYWORD]
    options = {
        name: option(f"{text.capitalize()}.", autocompletion=keys_of(name), **LAW)
        for name, text in names_of_additions().items()
    }
    beside = [Parameter(name, Parameter.KEYWORD_ONLY, default=item, annotation=str | None) for name, item in options.items()]
    command.__signature__ = Signature([*own, *beside])  # type: ignore[attr-defined]
    return command


app.command("run", cls=TakesOptionsOfRecords)(_with_options_of_additions(run))
app.command("slide", cls=TakesOptionsOfRecords)(_with_options_of_additions(slide))
