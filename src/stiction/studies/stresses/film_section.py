"""Compute the stresses in a section under the mean touching asperity of a coated contact.

The fields of `solvers.layered.stresses` are evaluated at the radius, mean pressure and friction force that `film_stresses`
finds for the mean asperity. They are elastic: a von Mises stress above the yield stress shows by how much yield is exceeded,
not the true stress.
"""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.contact.contact import Contact
from stiction.contact.indices import Groups
from stiction.contact.subject import Subject, as_subject
from stiction.quantities.errors import InputError
from stiction.solvers.layered.bodies import Bodies, bodies_of
from stiction.solvers.layered.first_yield import Yield, first_yield
from stiction.solvers.layered.stresses import Stresses, cartesian
from stiction.studies.stresses.film_stress import (
    coated_bodies,
    contact_over_thickness,
    part_that_yields,
    pressure_over_yield,
    require_proportion,
)
from stiction.studies.stresses.one_asperity import section

if TYPE_CHECKING:
    import xarray

_X = np.linspace(-2.0, 2.0, 81)
_ROWS, _SHALLOW, _DEEP = 61, 1.8, 4.0  # number of depths; smallest and largest depth of a section over the contact radius
_ASIDE = 1e-9  # distance from the interface, relative to the thickness, of the last depth inside the film


def film_section(contact: Subject, point: "xarray.Dataset") -> "xarray.Dataset":
    """Compute the stresses in a section under the mean touching asperity.

    contact: a Contact or Indices with a film. point: one load or separation of its `film_stresses` result. Returns a dataset
    over depth z and position x along the tangential force, both divided by the contact radius. stress_over_yield (z, x) is the
    von Mises stress over the local yield stress. interface_normal_stress (tension above 0) and interface_shear_stress are along
    x at the interface, in the middle plane: in Pa for a Contact, over the mean pressure for Indices. Attributes: contact_radius
    and film_thickness [m] and mean_pressure [Pa] of a Contact; thickness_over_radius; largest, largest_x, largest_z: largest
    stress_over_yield and its position; where: part that yields first. Raises InputError if no asperity presses, or if the ratio
    of contact radius to film thickness is outside the range in which stresses were checked.
    """
    subject = as_subject(contact)
    groups, _ = Groups.of(subject.indices())
    radius, pressure, traction, in_si = _asperity(subject, groups, point)
    (bodies,), _ = bodies_of(groups.resolved())
    strength = float(groups.n_H[0])
    stresses, worst = _worst(bodies, radius, traction, strength)
    thickness = stresses.thickness
    deepest = min(1.3 * thickness, _DEEP) if _SHALLOW < 1.3 * thickness < 1.3 * _DEEP else _SHALLOW
    both_sides = np.array([1.0 - _ASIDE, 1.0]) * thickness  # stresses parallel to the interface jump at the interface
    z = np.union1d(np.linspace(0.0, deepest, _ROWS), both_sides[both_sides < deepest])
    field = pressure * section(stresses, traction, strength, _X, z)
    radial = stresses.in_film(np.abs(_X), np.array([thickness]))
    six = cartesian(radial, np.where(_X < 0.0, math.pi, 0.0), traction)  # at the interface, over the mean pressure
    attrs = in_si | {
        "thickness_over_radius": thickness, "largest": pressure * worst.excess, "largest_x": worst.x, "largest_z": worst.z,
        "where": part_that_yields(subject, worst.where),
    }  # fmt: skip
    return _dataset(z, field, six[2][0], six[5][0], attrs)


def _asperity(subject: Subject, groups: Groups, point: "xarray.Dataset") -> tuple[float, float, float, dict[str, Any]]:
    """Return normalised radius, pressure and traction of the mean touching asperity, and its sizes in SI units.

    groups: dimensionless groups of the contact. point: one load or separation of a `film_stresses` result. The radius is
    divided by the thickness of one film, the mean pressure by the body's yield stress, and the traction is friction force over
    load (0 without friction). The sizes are dataset attributes by name; {} for Indices. Raises InputError if no asperity
    touches.
    """
    count, area, load = (float(point[name]) for name in ("touching_asperities", "contact_area", "load"))
    if not (count > 0.0 and load > 0.0 and math.isfinite(float(point["stress_over_yield"]))):
        raise InputError("load", load, "a load or separation at which asperities touch")
    factors = subject.scales().factors()
    one, force = area / count / factors["m^2"] * factors["count"], load / count / factors["N"] * factors["count"]
    radius = contact_over_thickness(groups, one)
    require_proportion(radius)
    pressure = pressure_over_yield(groups, one, force)
    traction = float(point["friction_force"]) / load if "friction_force" in point else 0.0
    if not isinstance(subject, Contact):
        return radius, pressure, traction, {}
    width = math.sqrt(area / (math.pi * count))
    return radius, pressure, traction, {
        "contact_radius": width, "film_thickness": width / radius, "mean_pressure": load / area,
    }  # fmt: skip


def _worst(bodies: Bodies, radius: float, traction: float, strength: float) -> tuple[Stresses, Yield]:
    """Return the stress solution of the coated body that is closer to yield, and where that body first yields.

    radius: contact radius over film thickness. traction: friction force over load. strength: film hardness over body hardness.
    """
    each = coated_bodies(bodies, radius)
    return max(((one, first_yield(one, traction, strength)) for one in each), key=lambda pair: pair[1].excess)


def _dataset(
    z: np.ndarray, field: np.ndarray, normal: np.ndarray, shear: np.ndarray, attrs: dict[str, Any]
) -> "xarray.Dataset":
    import xarray

    unit, scale = ("Pa", attrs["mean_pressure"]) if "mean_pressure" in attrs else ("1", 1.0)
    over = {} if unit == "Pa" else {"normalised_by": "mean pressure"}

    def described(words: str, **more: str) -> dict[str, str]:
        return {"long_name": words, "units": "1"} | more

    along = {"units": unit} | over
    return xarray.Dataset(
        {
            "stress_over_yield": (("z", "x"), field, described("von Mises stress over the yield stress of film or body")),
            "interface_normal_stress": (
                "x",
                scale * normal,
                described("stress across the interface, tension above 0", **along),
            ),
            "interface_shear_stress": ("x", scale * shear, described("shear stress on the interface along x", **along)),
        },
        coords={
            "x": ("x", _X, described("place in the direction of the tangential force", normalised_by="contact radius")),
            "z": ("z", z, described("depth", normalised_by="contact radius")),
        },
        attrs=attrs,
    )
