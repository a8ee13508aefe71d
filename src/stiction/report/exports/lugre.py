"""Write the constants of the LuGre and Dahl friction models at each load as JSON, for multibody programs.

Document: Altair MotionSolve, "Friction Formulation" (LuGre: bristle stiffness sigma_0, static friction; Dahl is a special
case). The kinetic force, the Stribeck velocity and the damping sigma_1 and sigma_2 are not predicted. MotionSolve needs
one set of constants for each normal force.
"""

import json
from typing import TYPE_CHECKING

from stiction.quantities.errors import InputError

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return constants of the LuGre model as JSON text, each as a list with one value for each load of a friction table.

    table: dataset of `export`, in its consistent units. Raises InputError if the table has no tangential stiffness.
    """
    if "elastic_slip" not in table:
        why = next(line for line in table.attrs["comments"] if line.startswith("no stiffness"))
        raise InputError("to", "lugre", "a format that needs no stiffness, e.g. abaqus", why)
    load = table["load"].values
    force = table["friction_coefficient"].values * load
    stiffness = force / table["elastic_slip"].values
    units = {name: table[name].attrs["units"] for name in ("load", "elastic_slip")}
    columns = {"load": load, "sigma_0": stiffness, "static_force": force}
    constants = {"comments": table.attrs["comments"], "force_unit": units["load"], "length_unit": units["elastic_slip"]}
    constants |= {name: [float(f"{value:.9g}") for value in values] for name, values in columns.items()}
    return json.dumps(constants, indent=2) + "\n"
