"""Write commands of Ansys Mechanical APDL: isotropic friction TB,FRIC of material 1 against normal pressure.

Document: Ansys Material Reference, "Contact Friction" (TB,FRIC,,,,ISO with TBFIELD and TBDATA,1,MU) and "Predefined Field
Variables" (NPRES, normal pressure; values in ascending order). The stiffness before sliding is the real constant FKT. A
negative value is absolute, in force over volume (Ansys Contact Technology Guide, "Real Constants"). FKT is written as a
comment for the stated load, because the number of the real constant set is unknown.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return mu against nominal pressure as APDL commands.

    table: dataset of `export`, in its consistent units.
    """
    lines = [f"! {text}" for text in table.attrs["comments"]]
    if "tangential_stiffness" in table:
        stiffness = table["tangential_stiffness"][table.attrs["working_row"]]
        lines += [f"! real constant FKT of the contact elements: {-float(stiffness):.6g}, in {stiffness.attrs['units']}"]
    lines += ["TB,FRIC,1,,,ISO"]
    for pressure, mu in zip(table["nominal_pressure"].values, table["friction_coefficient"].values, strict=True):
        lines += [f"TBFIELD,NPRES,{pressure:.8g}", f"TBDATA,1,{mu:.8g}"]
    return "\n".join(lines) + "\n"
