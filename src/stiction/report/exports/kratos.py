"""Write parameters of a frictional contact process of Kratos Multiphysics as JSON, with mu at the stated load.

Document: Kratos, "Contact Process Settings Reference" (contact_type "Frictional", frictional_law "Coulomb" and
friction_coefficients by interface, one number each: a table over pressure is not read). Kratos 10.4 accepted the file.
"""

import json
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return mu at the stated load as JSON text, to be put below "Parameters" of the Kratos contact process.

    table: dataset of `export`.
    """
    mu = round(float(table["friction_coefficient"][table.attrs["working_row"]]), 8)
    parameters = {"contact_type": "Frictional", "frictional_law": "Coulomb", "friction_coefficients": {"0": mu}}
    return json.dumps(parameters, indent=4) + "\n"
