"""Write friction tables in the file formats of other programs, with one module for each format.

Each module has a function `content(table)` that returns the content of the file. Its argument is a friction table: the dataset
of `stiction.export`, with mu against the nominal pressure in the units that the user chose. The docstring of a module cites the
manual of the program or the standard of the format, if there is one.
"""

import pkgutil

# System of units -> units of length [m] and force [N], then the names of the units of length, force and pressure.
UNITS = {
    "m-kg-s": (1.0, 1.0, ("m", "N", "Pa")),
    "mm-N-MPa": (1e-3, 1.0, ("mm", "N", "MPa")),
    "um-uN-MPa": (1e-6, 1e-6, ("um", "uN", "MPa")),
    "in-lbf-psi": (0.0254, 4.4482216152605, ("in", "lbf", "psi")),
}


def export_formats() -> list[str]:
    """Return the names of all export formats: the module names of this folder."""
    return [module.name for module in pkgutil.iter_modules(__path__)]
