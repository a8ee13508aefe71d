"""Packages that only part of the work needs: by which extra of the project each is installed, and one line where it is not."""

import sys
from importlib.util import find_spec
from typing import Any

from stiction.quantities.errors import InputError

# The package that is imported -> the extra of pyproject.toml that brings it.
EXTRA_OF = {
    "matplotlib": "pictures",
    "SurfaceTopography": "scans",
    "openpyxl": "spreadsheet",
    "zarr": "sweep",
    "distributed": "cluster",
    "nicegui": "web",
}


def installed(package: str) -> bool:
    """Return whether a package can be imported, without importing it."""
    return find_spec(package) is not None


def how_to_install(package: str) -> str:
    """Return the command that installs a package of `EXTRA_OF`."""
    return f"pip install 'stiction[{EXTRA_OF[package]}]'"


def require(field: str, *packages: str) -> None:
    """Raise InputError unless all these packages of `EXTRA_OF` can be imported; field: what was asked for."""
    missing = [package for package in packages if not installed(package)]
    if missing:
        raise InputError(field, f"without {missing[0]}", f"an installation with it: {how_to_install(missing[0])}")


def leave_out(package: str) -> None:
    """Let this process do without a package that other libraries import wherever it is installed.

    xarray imports dask and pint with its first array, only to ask whether that is one of theirs: half of the start of a
    command. `bring_back` ends it.
    """
    modules: dict[str, Any] = sys.modules
    modules.setdefault(package, None)


def bring_back(package: str) -> None:
    """Let a package that was left out be imported again."""
    if sys.modules.get(package, sys) is None:
        del sys.modules[package]
