"""`stiction figures`: the pictures of the 2015 paper, and the map of its claims."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stiction.cli.output import print_json
from stiction.cli.program import Json, app, bar, busy, console, folder, solving
from stiction.quantities.extras import require
from stiction.quantities.table import QUANTITIES

if TYPE_CHECKING:
    from stiction.studies.paper.claims import ClaimMap
    from stiction.studies.paper.figures import PanelCurves


def _bounds(name: str) -> str:
    """Meaning, bounds and unit of a quantity, for --help."""
    quantity = QUANTITIES[name]
    return f"{quantity.meaning}; {quantity.wanted}"


@app.command()
def figures(
    theta: Annotated[float, typer.Option(help=_bounds("theta"))] = 40.0,
    lam: Annotated[float, typer.Option(help=_bounds("lam"))] = 10.0,
    reading: Annotated[
        str | None,
        typer.Option(
            help="Of figures 1 to 3: corrected (default), published, or layered: its asperities on a film that is solved."
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(parser=folder, metavar="FOLDER", help="Folder for the pictures and tables; other files in it stay.")
    ] = Path("figures"),
    json: Json = False,
) -> None:
    """Figures 1 to 3 of the 2015 paper, and where in the plane of theta and lambda each of its claims holds.

    theta and lambda of the figures are not printed in the paper: 40 and 10 show its claims (a) to (c). The map of the claims
    covers theta 1 to 1e4 and lambda 1e-3 to 1e4 in both readings, and with the film solved in place of its law. Written:
    fig1a.png to fig3.png, curves.csv, claims.png, claims.csv.
    """
    from stiction.report.files import check_folder

    require("figures", "matplotlib")
    check_folder(out)
    with solving():
        from stiction.studies.paper.figures import PANELS, panel_curves

        panels = [panel_curves(panel, theta, lam, reading or "corrected") for panel in PANELS]
    from stiction.studies.paper.claims import claim_map, summary

    claims = claim_map(progress=bar("Judging the claims"))
    rows = summary(claims, theta, lam)
    with busy("Drawing"):
        _write_figures(out, panels, claims, {"theta": theta, "lam": lam})
    if json:
        print_json({"theta": theta, "lambda": lam, "reading": reading or "corrected", "claims": rows})
        return
    from stiction.report.claims_tables import claims_meaning, claims_table

    terminal = console()
    terminal.print(claims_meaning(rows), "", "Shares of the plane theta 1 to 1e4, lambda 1e-3 to 1e4, logarithmic:")
    terminal.print(claims_table(rows, f"theta {theta:g}\nlambda {lam:g}"))
    terminal.print("theta and lambda of the figures are not printed in the paper: those used were chosen.", highlight=False)
    terminal.print(f"written to {out}", highlight=False, markup=False, soft_wrap=True)


def _write_figures(out: Path, panels: "list[PanelCurves]", claims: "ClaimMap", here: dict[str, float]) -> None:
    from functools import partial

    from stiction.report.files import write_folder, write_picture, write_rows
    from stiction.report.pictures import claims_figure, panel_figure
    from stiction.studies.paper.claims import claim_rows
    from stiction.studies.paper.figures import curve_rows

    def draw(make: Any, path: Path) -> None:
        write_picture(make(), path)

    files: dict[str, Callable[[Path], None]] = {}
    files |= {f"{curves.panel.name}.png": partial(draw, partial(panel_figure, curves)) for curves in panels}
    files["claims.png"] = partial(draw, partial(claims_figure, claims, here))
    files["curves.csv"] = lambda path: write_rows(path, *curve_rows(panels))
    files["claims.csv"] = lambda path: write_rows(path, *claim_rows(claims))
    write_folder(out, files)
