"""Define the command `stiction export`, which writes predicted friction for simulation programs."""

from pathlib import Path

from stiction.cli.options import Json, Load, argument, option
from stiction.cli.output import print_json
from stiction.cli.program import app, console, solving
from stiction.report.exports import UNITS, export_formats


@app.command()
def export(
    case: Path = argument("CASE.toml", "Case file: what is in contact and at which loads."),
    to: str = option(f"Format: {', '.join(export_formats())}.", ..., "--to", metavar="FORMAT"),
    out: Path = option("File to write; an existing file is replaced.", ..., "--out", metavar="FILE"),
    load: Load = None,
    level: float = option("Quantile of mu: 0.5 for the median, 0.05 for a lower bound, 0.95 for an upper bound.", 0.5),
    units: str = option(f"Consistent units of the file: {', '.join(UNITS)}.", "m-kg-s"),
    radius: str | None = option('Effective radius of two spheres, e.g. "50 um", for lethe and liggghts.', metavar="LENGTH"),
    json: Json = False,
) -> None:
    """Write mu against nominal pressure, and the tangential stiffness before sliding, as input for another program.

    The table covers the loads of the case or, for a single load, two decades of load below and above it. Stiffness, elastic
    slip and mean separation are computed for bare bodies only; for a coated body the table has only mu.
    """
    with solving():
        from stiction.report.export import export as write

        table = write(case, to, out, load=load, level=level, units=units, radius=radius)
    ends = [float(table["nominal_pressure"][place]) for place in (0, -1)]
    content = {"file": str(out), "format": to, "units": units, "level": level, "comments": table.attrs["comments"]}
    if json:
        columns = {name: {"unit": variable.attrs["units"], "values": variable.values} for name, variable in table.items()}
        print_json(content | {"working_row": table.attrs["working_row"], "table": columns})
        return
    mu, place = (float(table[name][table.attrs["working_row"]]) for name in ("friction_coefficient", "load"))
    force, unit = (table[name].attrs["units"] for name in ("load", "nominal_pressure"))
    terminal = console()
    terminal.print(f"mu = {mu:.3g} at {place:.3g} {force}; {table.sizes['row']} rows, {ends[0]:.3g} to {ends[1]:.3g} {unit}")
    for line in table.attrs["comments"]:
        if line.startswith("no "):
            terminal.print(line, highlight=False, markup=False)
    terminal.print(f"written to {out}", highlight=False, markup=False, soft_wrap=True)
