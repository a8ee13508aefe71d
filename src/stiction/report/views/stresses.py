"""Build the view of the stresses in a film: a table, sentences, files and pictures."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.files import comments_of, record, write_csv, write_netcdf
from stiction.report.table import notes
from stiction.report.tables import curve_table, in_brief, outside_validity, run_summary
from stiction.report.view import View, picture
from stiction.studies.stresses.film_section import film_section
from stiction.studies.stresses.film_stress import middle_point

if TYPE_CHECKING:
    import xarray

    from stiction.case.read import Case


# Meanings of the table columns.
MEANINGS = (
    "mu: by this model alone; `stiction run CASE.toml` predicts mu",
    "a/t: contact radius of the mean touching asperity divided by the film thickness",
    "stress / Y, where: largest von Mises stress divided by the yield stress at the same point, and the location",
    "tension / Y_w, shear / k_w: largest at the interface, divided by the (shear) yield stress of the weaker of film and body",
)
_HEADS = {
    "mean_separation": "separation", "load": "load", "friction_coefficient": "mu", "contact_over_thickness": "a/t",
    "stress_over_yield": "stress\n/ Y", "yields_first": "where", "interface_tension": "tension\n/ Y_w",
    "interface_shear": "shear\n/ k_w",
}  # fmt: skip


def stresses_view(case: "Case", data: "xarray.Dataset", all_rows: bool = False, with_section: bool = False) -> View:
    """Return the view (texts, tables, files and pictures) of the film stresses of a case.

    data: result of `film_stresses` for the case. all_rows: whether to show every point of the curve. with_section: whether to
    compute the stresses in a cross-section too, for a file and a picture.
    """

    def parts() -> Iterator[Any]:
        yield from (run_summary(case, data), "", curve_table(data, all_rows, _HEADS), "")
        yield from notes(MEANINGS)
        if data.attrs.get("remarks"):
            yield Text(data.attrs["remarks"], style="yellow")
        yield from outside_validity(data)

    def short() -> Iterator[Any]:
        yield from (*in_brief(case, data), curve_table(data, heads=_HEADS))
        for meaning in MEANINGS:  # one by one: as many as fit
            yield from notes([meaning])

    files: dict[str, Any] = {"film.csv": lambda path: write_csv(data, path, comments_of(data))}
    pictures = {}
    if with_section:
        point = middle_point(data)
        section = film_section(case.subject, point)

        files["section.nc"] = lambda path: write_netcdf(section, path)
        pictures["film.png"] = picture("stresses under the asperity", "film_pictures.film_figure", point, section, case.title)
    return View("film", data, parts, lambda: record(data, case.subject.groups()), files, pictures, short=short)
