"""Stresses in a film as they are shown."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.files import comments_of, record, write_csv, write_netcdf
from stiction.report.film_tables import MEANINGS, film_table
from stiction.report.number_table import few_rows
from stiction.report.tables import in_brief, outside_validity, run_summary
from stiction.report.view import View, picture
from stiction.studies.stresses.film_section import film_section
from stiction.studies.stresses.film_stress import middle_point

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


def film_view(case: "Case", data: "xarray.Dataset", all_rows: bool = False, with_section: bool = False) -> View:
    """Return what the stresses in the film of a case show. with_section: also those under the asperity, in files."""

    def parts() -> Iterator[Any]:
        yield from (run_summary(case, data), "", film_table(data, all_rows), "")
        yield from (Text(one, style="dim") for one in MEANINGS)
        if data.attrs.get("remarks"):
            yield Text(data.attrs["remarks"], style="yellow")
        if (beyond := outside_validity(data)) is not None:
            yield beyond

    def short() -> Iterator[Any]:
        yield from (*in_brief(case, data), few_rows(film_table(data), 4), *(Text(one, style="dim") for one in MEANINGS))

    files: dict[str, Any] = {"film.csv": lambda path: write_csv(data, path, comments_of(data))}
    pictures = {}
    if with_section:
        point = middle_point(data)
        section = film_section(case.subject, point)

        files["section.nc"] = lambda path: write_netcdf(section, path)
        pictures["film.png"] = picture("stresses under the asperity", "film_pictures.film_figure", point, section, case.title)
    return View("film", data, parts, lambda: record(data, case.subject.groups()), files, pictures, short=short)
