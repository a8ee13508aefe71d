"""List the optional packages, the extra of the project that installs each, and raise a clear error if one is missing."""

import sys
from importlib.util import find_spec
from typing import Any

from stiction.quantities.errors import InputError, InWords

# The package that is imported -> the extra of pyproject.toml that brings it.
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
    """Return the command that installs a package of `EXTRA_OF`."""
    return f"pip install 'stiction[{EXTRA_OF[package]}]'"


def require(field: str, *packages: str) -> None:
    """Raise an InputError unless all given packages of `EXTRA_OF` are installed; field: the input that needs them."""
    missing = [package for package in packages if not installed(package)]
    if missing:
        raise InputError(
            field, InWords(f"{missing[0]} is not installed"), f"not supported without it: {how_to_install(missing[0])}"
        )


def leave_out(package: str) -> None:
    """Make a package look uninstalled in this process, so that other libraries do not import it.

    When xarray makes its first array, it imports dask and pint, only to check whether the array belongs to them. This takes
    half of the start-up time of a command. `bring_back` makes the package available again.
    """
    modules: dict[str, Any] = sys.modules
    modules.setdefault(package, None)


def bring_back(package: str) -> None:
    """Make a package available again after `leave_out`."""
    if sys.modules.get(package, sys) is None:
        del sys.modules[package]
