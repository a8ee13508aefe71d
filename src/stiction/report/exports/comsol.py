"""Write a table for an interpolation function of COMSOL Multiphysics, in its spreadsheet format.

Document: COMSOL Programming Reference Manual, "Spreadsheet Data Format" (columns, arguments first, functions after them; "%"
begins a comment) and Reference Manual, "Interpolation" (several functions from one file). The first column is the pressure.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return all columns of a friction table but the load as text of a COMSOL spreadsheet file.

    table: dataset of `export`, in its consistent units.
    """
    names = [name for name in table if name != "load"]
    heads = [f"{name} [{table[name].attrs['units']}]" for name in names]
    lines = [f"% {text}" for text in (*table.attrs["comments"], "   ".join(heads))]
    rows = zip(*(table[name].values for name in names), strict=True)
    return "\n".join([*lines, *("   ".join(f"{value:.8g}" for value in row) for row in rows)]) + "\n"
