"""Build the view of the figures of the 2015 paper on soft coatings, and of the map of its claims."""

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from stiction.report.files import write_rows
from stiction.report.table import Column, Table, facts, numbers
from stiction.report.view import View, picture
from stiction.studies.paper.claims import claim_rows, summary
from stiction.studies.paper.figures import curve_rows

if TYPE_CHECKING:
    from stiction.studies.paper.claims import ClaimMap
    from stiction.studies.paper.figures import PanelCurves


def claims_table(rows: Iterable[Mapping[str, Any]], point: str) -> Table:
    """Return a table with a row for each claim and model variant.

    The columns are the fractions of the theta-lambda plane in which the claim holds for all, some or no films.

    rows: results of `claims.summary`. point: theta and lambda of the last column, as text. That column has the fraction of the
    films for which the claim holds at this point.
    """
    some, not_comparable, there = numbers("for some", "not com-\nparable", point, wrap=True)
    columns = [Column("claim"), Column("variant"), Column("holds for all films", wrap=True), some,
               Column("for none", wrap=True), not_comparable, there]  # fmt: skip
    cells = [
        (
            f"({row['claim']})",
            row["variant"],
            f"{row['holds_for_all']:.0%}: {row['where_all']}",
            f"{row['holds_for_some']:.0%}",
            f"{row['holds_for_none']:.0%}: {row['where_none']}",
            f"{row['not_comparable']:.0%}",
            "-" if row["share_here"] is None else f"{row['share_here']:.0%}",
        )
        for row in rows
    ]
    return Table(columns, cells, ruled=True, gap=1)


def claims_meaning(rows: Iterable[Mapping[str, Any]]) -> Table:
    """Return a table with the text of each claim and its exact definition.

    rows: results of `claims.summary`.
    """
    unique = {row["claim"]: f"{row['says']}\nholds if {row['definition']}" for row in rows}
    return facts((f"({key})", text) for key, text in unique.items())


def figures_view(panels: "list[PanelCurves]", claims: "ClaimMap", point: Mapping[str, float], variant: str) -> View:
    """Return the view of figures 1 to 3 of the 2015 paper and of its claims.

    panels: curves of the figures. claims: map of the claims. point: theta and lam of the figures. variant: variant of the model
    that draws the figures.
    """
    theta, lam = point["theta"], point["lam"]
    rows = summary(claims, theta, lam)

    def parts() -> Iterator[Any]:
        yield from (
            claims_meaning(rows),
            "",
            "Fraction of the plane theta 1 to 1e4, lambda 1e-3 to 1e4 (logarithmic) where each claim holds:",
        )
        yield claims_table(rows, f"theta {theta:g}\nlambda {lam:g}")
        yield "The paper does not state theta and lambda of its figures; the values above were chosen."

    files = {
        "curves.csv": lambda path: write_rows(path, *curve_rows(panels)),
        "claims.csv": lambda path: write_rows(path, *claim_rows(claims)),
    }
    pictures = {
        f"{curves.panel.name}.png": picture(f"figure {curves.panel.name[3:]}", "paper_pictures.panel_figure", curves)
        for curves in panels
    }
    pictures["claims.png"] = picture("where each claim holds", "paper_pictures.claims_figure", claims, point)
    content = {"theta": theta, "lambda": lam, "variant": variant, "claims": rows}
    return View("figures", None, parts, lambda: content, files, pictures)
