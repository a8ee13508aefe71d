"""Define the command `stiction figures`: the figures of the 2015 paper on soft coatings, and a map of its claims."""

from pathlib import Path

from stiction.cli.options import Json, Out, option
from stiction.cli.program import app, bar, present, solving
from stiction.quantities.extras import require
from stiction.quantities.table import QUANTITIES


def _bounds(name: str) -> str:
    """Return the help text of a quantity: its meaning, bounds and unit."""
    quantity = QUANTITIES[name]
    return f"{quantity.meaning}; {quantity.wanted}"


@app.command()
def figures(
    theta: float = option(_bounds("theta"), 40.0),
    lam: float = option(_bounds("lam"), 10.0),
    variant: str | None = option(
        "Variant of figures 1 to 3: corrected (default), published, or layered (the film is solved exactly)."
    ),
    out: Out = Path("figures"),
    json: Json = False,
) -> None:
    """Draw figures 1 to 3 of the 2015 paper, and a map of theta and lambda that shows where each claim of the paper holds.

    The paper does not state theta and lambda of its figures; its claims (a) to (c) hold for theta = 40 and lambda = 10. The map
    covers theta 1 to 1e4 and lambda 1e-3 to 1e4 for three models: the corrected and the published formulas, and the film solved
    exactly. Files: fig1a.png to fig3.png, curves.csv, claims.png, claims.csv.
    """
    require("figures", "matplotlib")
    with solving():
        from stiction.studies.paper.figures import PANELS, panel_curves

        panels = [panel_curves(panel, theta, lam, variant or "corrected") for panel in PANELS]
    from stiction.report.views.figures import figures_view
    from stiction.studies.paper.claims import claim_map

    claims = claim_map(progress=bar("Testing the claims"))
    present(figures_view(panels, claims, {"theta": theta, "lam": lam}, variant or "corrected"), out, json)
