"""What is uncertain, as it is shown."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from stiction.report.files import record
from stiction.report.uncertainty_tables import band_lines, spread_table
from stiction.report.view import Picture, View

if TYPE_CHECKING:
    import xarray


def uncertainty_view(data: "xarray.Dataset") -> View:
    """Return what the bands of uncertain numbers show, and what friction differs by."""
    has_band = "friction_coefficient_quantile" in data

    def parts() -> Iterator[Any]:
        if has_band:
            yield from band_lines(data)
        if "spread_factor" in data:
            yield spread_table(data)

    def band() -> Any:
        from stiction.report.uncertainty_pictures import uncertainty_figure

        return uncertainty_figure(data)

    def spread() -> Any:
        from stiction.report.uncertainty_pictures import spread_figure

        return spread_figure(data)

    pictures = {}
    if has_band:  # what friction differs by is beside it
        pictures["uncertainty.png"] = Picture("friction with its band", band)
    elif "spread_factor" in data:
        pictures["spread.png"] = Picture("what friction differs by: inputs, methods, models", spread)
    return View("uncertainty", data, parts, lambda: record(data, {}), pictures=pictures)
