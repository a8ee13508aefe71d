"""`stiction sensitivity`: which input should be measured better."""

from pathlib import Path
from typing import Annotated

import typer

from stiction.cli.program import Details, Json, Out, Ranges, app, bar, busy, present


@app.command()
def sensitivity(
    case: Annotated[Path, typer.Argument(metavar="CASE.toml", help="Case file in which numbers of the contact are uncertain.")],
    load: Annotated[str | None, typer.Option(help='Only at this load, e.g. "1 N"; default: nine of the case at most.')] = None,
    models: Annotated[
        str | None,
        typer.Option(
            metavar="NAMES",
            help="Models to draw from, separated by commas, or: none, for the model of the case alone. Default: the model "
            "of the case, or the prediction where it names none.",
        ),
    ] = None,
    ranges: Ranges = None,
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Which of the inputs should be measured better: of friction, area, load and pull-off.

    Sobol indices with 95 % intervals and Morris effects over what is uncertain, the ways of finding asperities and the models;
    elasticities d ln mu/d ln x for every number of the contact. With --out: sensitivity.csv, elasticities.csv, sensitivity.nc
    (netCDF4) and sensitivity.png. Numbers are uncertain as "0.5 +/- 0.1 GPa", {low, high}, {median, factor} or {samples} in the
    case, or with --ranges, within the ranges of their materials.
    """
    with busy("Reading the case"):
        from stiction.case.read import read_case
        from stiction.studies.sensitivity.run import sensitivity as studied

        chosen = read_case(case, ranges=ranges)
    names = None if models is None else [] if models.strip() == "none" else [one.strip() for one in models.split(",")]
    data = studied(chosen, load=load, models=names, progress=bar)
    from stiction.report.views.sensitivity import sensitivity_view

    present(sensitivity_view(data, chosen.subject.groups()), out, json, details)
