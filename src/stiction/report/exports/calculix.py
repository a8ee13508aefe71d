"""Write CalculiX input: a *SURFACE INTERACTION with *SURFACE BEHAVIOR and *FRICTION, for bodies without a film.

Document: CalculiX CrunchiX User's Manual, "*FRICTION" (mu, and the stick slope in force per volume; no table over pressure) and
"*SURFACE BEHAVIOR" (PRESSURE-OVERCLOSURE=TABULAR; lines: pressure, overclosure). Both numbers of *FRICTION are taken at the
stated load. Outside the table the pressure stays constant. CalculiX 2.20 ran such a file. It accepts at most 20 rows, and reads
them for node-to-surface contact.
"""

from typing import TYPE_CHECKING

from stiction.quantities.errors import InputError
from stiction.quantities.sampling import spread_rows
from stiction.report.exports.abaqus import at_stated_load, surface_behavior

if TYPE_CHECKING:
    import xarray

_MOST_ROWS = 20


def content(table: "xarray.Dataset") -> str:
    """Return a CalculiX input file: mu and stick slope at the stated load, and a table of pressure against overclosure.

    table: dataset of `export`, in its consistent units. Raises InputError if the table has no tangential stiffness, because
    *FRICTION needs one.
    """
    if "tangential_stiffness" not in table:
        why = next(line for line in table.attrs["comments"] if line.startswith("no stiffness"))
        raise InputError("to", "calculix", "a format that needs no stiffness, e.g. abaqus", why)
    mu, slope = (float(table[name][table.attrs["working_row"]]) for name in ("friction_coefficient", "tangential_stiffness"))
    few = table.isel(row=spread_rows(table.sizes["row"], _MOST_ROWS - 1))  # one row is for zero pressure
    lines = [*(f"** {text}" for text in table.attrs["comments"]), "*SURFACE INTERACTION, NAME=STICTION", *surface_behavior(few)]
    return "\n".join([*lines, at_stated_load(table, "mu and stick slope"), "*FRICTION", f"{mu:.8g}, {slope:.8g}"]) + "\n"
