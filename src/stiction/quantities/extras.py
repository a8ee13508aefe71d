"""List the optional packages and the extra of stiction that installs each; raise an error if one is missing."""

import sys
from importlib.util import find_spec
from typing import Any

from stiction.quantities.errors import InputError, InWords

# Name of the package in an import statement -> extra of pyproject.toml that installs it.
EXTRA_OF = {
    "matplotlib": "pictures",
    "SurfaceTopography": "scans",
    "openpyxl": "spreadsheet",
    "zarr": "sweep",
    "distributed": "cluster",
    "nicegui": "web",
    "array_api_compat": "device",
}


def installed(package: str) -> bool:
    """Return whether a package is installed, without importing it."""
    return find_spec(package) is not None


def how_to_install(package: str) -> str:
    """Return the pip command that installs an optional package; package: a key of EXTRA_OF, such as "matplotlib"."""
    return f"pip install 'stiction[{EXTRA_OF[package]}]'"


def require(field: str, *packages: str) -> None:
    """Raise an InputError, with the command that installs the package, unless all given optional packages are installed.

    field: name of the input that needs the packages, for the error message. packages: keys of EXTRA_OF, such as "matplotlib".
    """
    missing = [package for package in packages if not installed(package)]
    if missing:
        raise InputError(
            field, InWords(f"{missing[0]} is not installed"), f"not supported without it: {how_to_install(missing[0])}"
        )


def leave_out(package: str) -> None:
    """Make a package look as if it were not installed in this process, so that other libraries do not import it.

    If it is already imported, nothing changes. xarray imports dask and pint only to test whether an array belongs to them.
    Without these imports a command starts twice as fast. `bring_back` makes the package available again.
    """
    modules: dict[str, Any] = sys.modules
    modules.setdefault(package, None)


def bring_back(package: str) -> None:
    """Undo `leave_out` for a package; do nothing for packages that were not hidden."""
    if sys.modules.get(package, sys) is None:
        del sys.modules[package]
