"""Build the view of a case solved by one model: tables, sentences, files and pictures."""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.quantities.dimensions import in_columns
from stiction.quantities.sampling import spread_rows
from stiction.quantities.table import QUANTITIES
from stiction.report.answer import model_record
from stiction.report.files import comments_of, record, write_csv
from stiction.report.swept_tables import combinations_shown, of_point, points_dimension, shown_quantity, swept_table, varied
from stiction.report.table import Table, notes, numbers, short
from stiction.report.tables import curve_table, in_brief, outside_validity, rows_shown, run_notes, run_summary
from stiction.report.view import Picture, View, picture, regime_picture
from stiction.solving.method_spread import METHOD

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


_ROWS = 12


def band_table(data: "xarray.Dataset") -> Table | Text:
    """Return a table of a result, its quantiles over the uncertain inputs, and the largest sampling error of these quantiles.

    A text is returned if the result does not vary. The table has about twelve loads or separations. For array parameters, only
    the first values are shown.
    """
    name = shown_quantity(data)
    if f"{name}_quantile" not in data:
        return Text(f"{name} does not vary with the uncertain inputs", style="dim")
    dim, several = points_dimension(data), varied(data)
    heads = numbers("at", "nominal", *(f"{share:.0%}" for share in data["quantile"].values), "sampling\nerror")
    rows = []
    # For array parameters, only the first values are shown; the files contain all.
    first = data.isel({point: 0 for point in several})
    for index in spread_rows(data.sizes[dim] if dim else 1, _ROWS):
        point = first.isel({dim: int(index)}) if dim else first
        band, error = point[f"{name}_quantile"].values, point[f"{name}_quantile_error"].values
        worst = float(np.nanmax(error)) if np.isfinite(error).any() else np.nan
        rows.append([of_point(data, int(index)), *(short(value) for value in (float(point[name]), *band)), short(worst, 2)])
    return Table(heads, rows, whole=True)


def band_lines(data: "xarray.Dataset") -> Iterator[Any]:
    """Yield the table of quantiles over uncertain inputs, then notes on these inputs."""
    yield band_table(data)
    yield from notes(uncertain_notes(data))


def uncertain_notes(data: "xarray.Dataset") -> Iterator[str]:
    """Yield notes on the uncertain inputs: names, sampling, fraction of samples excluded, and validity warnings of samples."""
    used = data.attrs
    for line in used["uncertain_inputs"].splitlines():
        yield f"uncertain: {line}"
    if "uncertainty" in used:
        yield draws_in_words(used)
    if used.get("impossible_draws"):
        yield f"excluded from the band as impossible: {used['impossible_draws']:.2g} of the samples"
    for text, share in json.loads(used.get("validity_warnings_of_points", "{}")).items():
        yield in_draws(share, with_meaning(text))


def draws_in_words(used: Mapping[str, Any]) -> str:
    """State the number of random samples of the uncertain inputs and their seed.

    used: attributes of a result.
    """
    return f"random samples of the uncertain inputs: {used['uncertainty'].replace(' points', '')}"


def with_meaning(warning: str) -> str:
    """Return a validity warning in which the name of the quantity at its start is replaced by the quantity's meaning."""
    name, _, rest = warning.partition(" ")
    return f"{QUANTITIES[name].meaning} {rest}" if name in QUANTITIES else warning


def in_draws(share: float, text: str) -> str:
    """State the fraction of the random samples to which a validity warning applies.

    share: the fraction. text: the warning.
    """
    return f"in {share:.1%} of the random samples of the inputs: {text}"


def run_view(case: "Case", data: "xarray.Dataset", all_rows: bool = False) -> View:
    """Return the view (texts, tables, files and pictures) of a case that one model solved.

    data: result of `solve` for the case. all_rows: whether to show every load or separation of the curve.
    """

    def table(path: Path) -> None:
        wide = in_columns(data, METHOD, "by_method")
        wide = in_columns(wide, "quantile", "quantile", lambda share: f"q{round(100.0 * share):02d}")
        write_csv(wide, path, comments_of(data))

    def as_record() -> dict[str, Any]:
        answer = {} if case.is_swept else {"answer": model_record(data)}
        measured = {} if case.measured is None else {"measured": case.measured.record()}
        return answer | record(data, case.subject.groups()) | measured

    def short() -> Iterator[Any]:
        yield from in_brief(case, data)
        yield (swept_table(data) if case.is_swept else curve_table(data))

    return View(
        "curve",
        data,
        lambda: _parts(case, data, all_rows),
        as_record,
        {"curve.csv": table},
        _pictures(case, data),
        short=short,
    )


def _parts(case: "Case", data: "xarray.Dataset", all_rows: bool) -> Iterator[Any]:
    table = swept_table(data, all_rows) if case.is_swept else curve_table(data, all_rows)
    yield from (run_summary(case, data), "", table, "")
    text = combinations_shown(data, "--all-rows") if case.is_swept else rows_shown(data)
    if text and not all_rows:
        yield from (Text(text, style="dim"), "")
    if "uncertain_inputs" in data.attrs:
        yield from (*band_lines(data), "")
    if "point_spacing" in data:
        from stiction.report.views.surface import map_notes

        yield from (*map_notes(data), "")
    elif case.measured is not None:
        from stiction.report.views.surface import roughness_notes, roughness_table

        yield from (roughness_table(case.measured, data), *roughness_notes(case.measured), "")
    yield from notes(run_notes(data))
    yield from outside_validity(data)


def _pictures(case: "Case", data: "xarray.Dataset") -> dict[str, Picture]:
    drawn = "swept_pictures.swept_figure" if case.is_swept else "pictures.curve_figure"
    pictures = {"curve.png": picture("friction, contact area and load", drawn, data, case.title)}
    if not case.is_swept:
        pictures |= regime_picture(case.subject, data, case.title)
    if "friction_coefficient_by_method" in data and not case.is_swept:
        description = "friction by every asperity method"
        pictures["band.png"] = picture(description, "method_pictures.method_spread_figure", data, case.title)
    if "friction_coefficient_quantile" in data and not case.is_swept:
        drawn = "pictures.uncertainty_figure"
        pictures["uncertainty.png"] = picture("friction with its band", drawn, data, case.title)
    return pictures
