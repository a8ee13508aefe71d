"""Studies of one case: what to measure better, fit, design, all models, stresses in a film, report, measured series."""

from pathlib import Path
from typing import Any

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
from stiction.cli.output import print_json
from stiction.cli.program import app, bar, busy, console, present, read, solving, telling_how_far


@app.command()
def sensitivity(
    case: Path = argument("CASE.toml", "Case file in which numbers of the contact are uncertain."),
    load: str | None = option('Only at this load, e.g. "1 N"; default: nine of the case at most.'),
    models: str | None = option(
        "Models to draw from, separated by commas, or: none, for the model of the case alone. Default: the model "
        "of the case, or the prediction where it names none.",
        metavar="NAMES",
    ),
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
    chosen = read(case, ranges=ranges)
    from stiction.studies.sensitivity.run import sensitivity as studied

    names = None if models is None else [] if models.strip() == "none" else [one.strip() for one in models.split(",")]
    data = studied(chosen, load=load, models=names, progress=bar)
    from stiction.report.views.sensitivity import sensitivity_view

    present(sensitivity_view(data, chosen.subject.groups()), out, json, details)


@app.command()
def fit(
    case: Path = argument("CASE.toml", "Case file; a table [fit] says what is free."),
    data: Path = option("Measured series, units in the heads.", ..., "--data", metavar="MEASURED.csv"),
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Fit numbers of a case to measured friction, pull-off, contact area or resistance against load.

    The case says in [fit.free] which numbers are free, between which ends. Where it names no model, it is predicted with what
    was measured: draws count by how well they meet the values. With a model, intervals are of 95 %, by the profile of the
    likelihood, and what the data cannot tell is said. With --out: fitted.toml, a case that `stiction run` takes, and pictures
    and tables. Interrupted once the case's model is fitted, it keeps that.
    """
    with busy("Reading the case"):
        from stiction.report.views.fit import fit_view, fitted_prediction_view
        from stiction.studies.fit.predicted import fit_prediction
        from stiction.studies.fit.run import plan_of_fit, run_fit

    with solving():
        answer = fit_prediction(case, data)
    if answer is not None:
        present(fitted_prediction_view(case, *answer, details, out), out, json)
        return
    with busy("Reading the case"):
        plan = plan_of_fit(case, data)

    found = run_fit(plan, bar)
    present(fit_view(found, out), out, json, details)
    if found.stopped:
        raise KeyboardInterrupt


@app.command()
def design(
    case: Path = argument("CASE.toml", "Case file with a table [design]: choices, wishes, limits."),
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Choose materials, thickness, roughness or load so that a wish comes true and limits are kept.

    The case says in [design] what is wished, in [design.choose] what may be chosen, in [design.limits] what must hold.
    With two wishes, also the designs of which none is better in both. With --out: designed.toml, a case that `stiction run`
    takes, design.csv, front.csv, design.png, design.nc. Interrupted, it keeps the best so far.
    """
    with busy("Reading the case"):
        from stiction.studies.design.run import plan_of_design, run_design

        plan = plan_of_design(case)
    with telling_how_far("Designing") as tell:
        found = run_design(plan, lambda count, text: tell(f"Designing: {count} designs asked"))
    from stiction.report.views.design import design_view

    present(design_view(found, out), out, json, details)
    if found.stopped:
        raise KeyboardInterrupt


@app.command()
def compare(
    case: Path = argument("CASE.toml", "Case file: what is in contact."),
    load: str | None = option('Working load, e.g. "1 N"; default: the middle one of the case.'),
    out: Out = None,
    every: bool = option("Show every model in its own row, with its notes.", False, "--all"),
    ranges: Ranges = None,
    json: Json = False,
) -> None:
    """The answer for one contact, and what every applicable model says of it, those that say the same in one row.

    A model fits, or does not and why. The area is off by its mean error on solved surfaces near this contact. A contact that
    states an interfacial_shear_strength gets a friction coefficient from models of contact only, too. With --out: compare.csv
    (the curves), compare_at_load.csv, compare.nc (netCDF4) and compare.png. A working load presses: it is above 0 N; where the
    middle one of the case is not, the nearest that is stands in, and without any there are only curves.
    """
    chosen = read(case, ranges=ranges)
    with busy("Reading the case"):
        from stiction.report.views.comparison import comparison_view
        from stiction.studies.case_results import compare_case
        from stiction.studies.comparison.compare import working_load
        from stiction.studies.prediction.predict import prediction_of

        at = working_load(chosen, load)
    data = compare_case(chosen, at, bar).assign_attrs(case_file=str(case))
    present(comparison_view(chosen, data, prediction_of(chosen, at), every), out, json)


@app.command(cls=TakesOptionsOfRecords)
def film(
    context: typer.Context,
    case: Path = argument("CASE.toml", "Case file of a contact with a film."),
    load: Load = None,
    model: str | None = option("Model in place of the case's, a sum over asperities.", autocompletion=keys_of("model")),
    asperity: Asperity = None,
    tangential: Tangential = None,
    all_rows: AllRows = False,
    out: Out = None,
    details: Details = False,
    json: Json = False,
) -> None:
    """Stresses in a film: where film, interface or body yields first, and what peels the film off.

    Of the mean touching asperity, pressed and dragged, by the stresses of an elastic sphere on a film: the film law is layered,
    whatever the case names. Tension and shear at the interface are over the yield stress, and the shear yield stress, of the
    weaker of film and body. With --out: film.csv, film.nc (netCDF4), and of the middle one of the points that press, or --load,
    section.nc and film.png, the section under the asperity. The options of a model or a law may be given too.
    """
    chosen = read(case, load)
    with solving():
        from stiction.report.views.film import film_view
        from stiction.studies.case_results import film_of_case

        data = film_of_case(chosen, chosen_laws(context, chosen, film="layered"))

    present(film_view(chosen, data, all_rows, out is not None), out, json, details)


@app.command()
def report(
    case: Path = argument("CASE.toml", "Case file: what is in contact and what to solve."),
    out: Path = option("The page; one that is there is replaced.", ..., "--out", metavar="FILE.html"),
    load: str | None = option('Working load, e.g. "1 N"; default: the middle one of the case.'),
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


@app.command()
def validate(
    entry: Path = argument("ENTRY.toml", "Measured series and its contact, or a folder of them."),
    out: Out = None,
    json: Json = False,
) -> None:
    """Compare every model that applies with measured series: by what factor each is off.

    An entry is a TOML file with the tables [contact] of a case file and [measured], which says who measured what and where
    that is printed, beside a CSV file of the values. Of a folder, every entry in it. With --out: a CSV file for each entry,
    with what each model says of every value. The mean ratio is of predicted over measured.
    """
    with busy("Reading the measured series"):
        from stiction.studies.comparison.validation import entries_in, read_entry
        from stiction.studies.comparison.validation import validate as validated

        paths = entries_in(entry) if entry.is_dir() else [entry]
        entries = [read_entry(path) for path in paths]
    found = [validated(one, progress=bar(path.stem)) for one, path in zip(entries, paths, strict=True)]
    from stiction.report.views.validation import validation_view

    present(validation_view({path.stem: data for path, data in zip(paths, found, strict=True)}), out, json)
