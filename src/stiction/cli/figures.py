"""`stiction figures`: the pictures of the 2015 paper, and the map of its claims."""

from pathlib import Path

from stiction.cli.options import Json, Out, option
from stiction.cli.program import app, bar, present, solving
from stiction.quantities.extras import require
from stiction.quantities.table import QUANTITIES


def _bounds(name: str) -> str:
    """Return the meaning, bounds and unit of a quantity, for --help."""
    quantity = QUANTITIES[name]
    return f"{quantity.meaning}; {quantity.wanted}"


@app.command()
def figures(
    theta: float = option(_bounds("theta"), 40.0),
    lam: float = option(_bounds("lam"), 10.0),
    variant: str | None = option(
        "Of figures 1 to 3: corrected (default), published, or layered: its asperities on a film that is solved."
    ),
    out: Out = Path("figures"),
    json: Json = False,
) -> None:
    """Draw figures 1 to 3 of the 2015 paper, and where in the plane of theta and lambda each of its claims holds.

    The paper does not print theta and lambda of its figures; 40 and 10 show its claims (a) to (c). The map of the claims covers
    theta 1 to 1e4 and lambda 1e-3 to 1e4 in both variants, and with the film solved instead of its law. Files: fig1a.png to
    fig3.png, curves.csv, claims.png, claims.csv.
    """
    require("figures", "matplotlib")
    with solving():
        from stiction.studies.paper.figures import PANELS, panel_curves

        panels = [panel_curves(panel, theta, lam, variant or "corrected") for panel in PANELS]
    from stiction.report.views.figures import figures_view
    from stiction.studies.paper.claims import claim_map

    claims = claim_map(progress=bar("Judging the claims"))
    present(figures_view(panels, claims, {"theta": theta, "lam": lam}, variant or "corrected"), out, json)
