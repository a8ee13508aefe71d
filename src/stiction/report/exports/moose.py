"""Write a [Functions] block of MOOSE: mu against contact pressure, for `function_friction` of a mortar constraint.

Document: MOOSE, "PiecewiseLinear" (x, y, axis) and "ComputeFrictionalForceLMMechanicalContact" (function_friction, "function to
evaluate friction with values from contact pressure and relative tangential velocities": the function receives the pressure as
x).
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return mu against nominal pressure as a [Functions] block of a MOOSE input file.

    table: dataset of `export`, in its consistent units.
    """
    columns = (table["nominal_pressure"].values, table["friction_coefficient"].values)
    x, y = (" ".join(f"{value:.8g}" for value in column) for column in columns)
    lines = [f"# {text}" for text in table.attrs["comments"]]
    lines += ["# in the frictional constraint: function_friction = stiction"]
    lines += ["[Functions]", "  [stiction]", "    type = PiecewiseLinear", "    axis = x"]
    lines += [f"    x = '{x}'", f"    y = '{y}'", "  []", "[]"]
    return "\n".join(lines) + "\n"
