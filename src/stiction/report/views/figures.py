"""The pictures of the 2015 paper and the map of its claims, as they are shown."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from stiction.report.claims_tables import claims_meaning, claims_table
from stiction.report.files import write_rows
from stiction.report.view import View, picture
from stiction.studies.paper.claims import claim_rows, summary
from stiction.studies.paper.figures import curve_rows

if TYPE_CHECKING:
    from stiction.studies.paper.claims import ClaimMap
    from stiction.studies.paper.figures import PanelCurves


def figures_view(panels: "list[PanelCurves]", claims: "ClaimMap", here: Mapping[str, float], reading: str) -> View:
    """Return what figures 1 to 3 and the claims show. here: theta and lam of the figures."""
    theta, lam = here["theta"], here["lam"]
    rows = summary(claims, theta, lam)

    def parts() -> Iterator[Any]:
        yield from (claims_meaning(rows), "", "Shares of the plane theta 1 to 1e4, lambda 1e-3 to 1e4, logarithmic:")
        yield claims_table(rows, f"theta {theta:g}\nlambda {lam:g}")
        yield "theta and lambda of the figures are not printed in the paper: those used were chosen."

    files = {
        "curves.csv": lambda path: write_rows(path, *curve_rows(panels)),
        "claims.csv": lambda path: write_rows(path, *claim_rows(claims)),
    }
    pictures = {
        f"{one.panel.name}.png": picture(f"figure {one.panel.name[3:]}", "pictures.panel_figure", one) for one in panels
    }
    pictures["claims.png"] = picture("where each claim holds", "pictures.claims_figure", claims, here)
    found = {"theta": theta, "lambda": lam, "reading": reading, "claims": rows}
    return View("figures", None, parts, lambda: found, files, pictures)
