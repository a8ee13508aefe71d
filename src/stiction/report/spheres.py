"""Compute properties of two adhesive spheres, for the export formats of discrete-element programs."""

from math import pi
from typing import TYPE_CHECKING, Any

from stiction.quantities.errors import InputError

if TYPE_CHECKING:
    import xarray


def spheres_of(numbers: Any, radius: float, length: float, force: float) -> dict[str, Any]:
    """Return radius, work of adhesion, Young's moduli and Poisson's ratios of two spheres, as a dict.

    numbers: contact with numbers in SI units. radius: effective radius [m]. length [m], force [N]: units of the returned
    values.
    """
    bodies = (numbers.first, numbers.second)
    return {
        "radius": radius / length,
        "work_of_adhesion": float(numbers.work_of_adhesion or 0.0) / (force / length),
        "youngs_modulus": [float(body.youngs_modulus) / (force / length**2) for body in bodies],
        "poissons_ratio": [float(body.poissons_ratio) for body in bodies],
    }


def sphere_contact(table: "xarray.Dataset") -> tuple[dict[str, Any], float, float, float]:
    """Return (spheres, load, mu, pull-off force) of a friction table at the load that the user stated.

    table: dataset of `export` with the attribute `spheres`, a dict of `spheres_of`. The pull-off force is (3/2) pi w R, by
    Johnson, Kendall and Roberts (1971). Raises InputError if the table has no spheres.
    """
    spheres = table.attrs.get("spheres")
    if spheres is None:
        raise InputError("radius", None, 'the effective radius of two spheres, e.g. "50 um"')
    load, mu = (float(table[name][table.attrs["working_row"]]) for name in ("load", "friction_coefficient"))
    return spheres, load, mu, 1.5 * pi * spheres["work_of_adhesion"] * spheres["radius"]


def sphere_comments(table: "xarray.Dataset") -> list[str]:
    """Return the comment lines of a friction table, with a line on friction force, load and pull-off force of two spheres."""
    _, load, mu, pull_off = sphere_contact(table)
    unit = table["load"].attrs["units"]
    limit = f"limit force {mu * load:.6g} {unit} at the load {load:.6g} {unit}; pull-off force {pull_off:.6g} {unit}"
    return [*table.attrs["comments"], limit, "the pull-off force is that of smooth spheres: roughness lowers it"]
