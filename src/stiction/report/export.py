"""Write predicted friction in the file formats of other programs. Each module of `exports/` writes one format."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction.quantities.errors import InputError, field_named
from stiction.quantities.paths import require_place
from stiction.quantities.units import to_si
from stiction.report.exports import UNITS, export_formats
from stiction.report.spheres import spheres_of
from stiction.studies.prediction.friction_table import friction_table
from stiction.studies.prediction.predict import case_given

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseLike
    from stiction.contact.contact import Contact
    from stiction.quantities.arguments import FilePath, QuantityLike


def export(
    contact: "Contact | CaseLike",
    to: str,
    out: "FilePath | None" = None,
    *,
    load: "QuantityLike | None" = None,
    level: float = 0.5,
    units: str = "m-kg-s",
    radius: "QuantityLike | None" = None,
) -> "xarray.Dataset":
    """Write the predicted friction of a contact as a table for another program.

    The table holds mu against the nominal pressure.

    Parameters
    ----------
    contact : Contact, Case, dict or path
        One contact, in any form that `predict` accepts.
    to : str
        Name of the format, e.g. "abaqus". The error for an unknown name lists all formats.
    out : path, optional
        File to write. By default no file is written.
    load : number, text or sequence, optional
        Normal load [N]; by default the loads of the case. For more than one load, the table covers their range. For one load,
        it covers two decades of load below and above it.
    level : float
        Quantile of mu to write, between 0 and 1: 0.5 is the median, 0.05 a lower bound.
    units : str
        Consistent units of the file, e.g. "mm-N-MPa". The error for unknown units lists all choices.
    radius : float [m] or str with a unit, optional
        Effective radius of two spheres, 1/R = 1/R_1 + 1/R_2, for the formats "lethe" and "liggghts", which require it. The load
        is then the force between the spheres, and the nominal area is the area of their contact.

    Returns
    -------
    xarray.Dataset
        The exported table in the chosen units, with dimension `row`: load, nominal_pressure and friction_coefficient. For
        bodies without a film also tangential_stiffness (shear stress over displacement at rest), elastic_slip and
        mean_separation. The attribute `text` is the content of the file (str or bytes).

    Raises
    ------
    InputError
        If the format or the units are unknown, the format needs a radius, the contact has no prediction, or the file cannot be
        written.

    Notes
    -----
    Linear interpolation of mu between two rows is accurate to 0.1 %, and to 0.3 % where mu has a small step. Most programs
    hold mu constant below the first and above the last row.

    Examples
    --------
    >>> import stiction as st
    >>> pair = st.Contact(
    ...     first="copper", second="copper", interface="oxidised metal", nominal_area="1 cm^2",
    ...     roughness=dict(asperity_height_deviation="0.2 um", asperity_radius="20 um", asperity_density="1e10 1/m^2"),
    ... )
    >>> table = st.export(pair, "csv", load="10 N", units="mm-N-MPa")
    >>> table.nominal_pressure.attrs["units"]
    'MPa'
    """
    if to not in export_formats():
        raise InputError("to", to, ", ".join(export_formats()))
    if units not in UNITS:
        raise InputError("units", units, ", ".join(UNITS))
    if out is not None:
        require_place(Path(out), "a file, new or existing", in_place=True)
    table = _in_units(friction_table(contact, load=load, level=level), units)
    described = table if radius is None else table.assign_attrs(spheres=_spheres(contact, load, radius, units))
    content = import_module(f"stiction.report.exports.{to}").content(described)
    if out is not None:
        data = content.encode() if isinstance(content, str) else content
        try:
            Path(out).write_bytes(data)
        except OSError as error:
            raise InputError("out", str(out), f"a file that can be written; the system reports: {error.strerror}") from None
    return table.assign_attrs(text=content)


def _spheres(contact: "Contact | CaseLike", load: "QuantityLike | None", radius: "QuantityLike", units: str) -> dict[str, Any]:
    """Return radius, work of adhesion, Young's moduli and Poisson's ratios of two spheres, for discrete-element formats.

    contact, load: as for `export`. radius: effective radius of the spheres, a length in m or with a unit. units: key of UNITS,
    the system of units in which the values are returned.
    """
    with field_named("radius"):
        effective_radius = to_si(radius, "asperity_radius")
        if np.ndim(effective_radius):
            raise InputError("radius", radius, 'a single length, e.g. "50 um"')
    length, force, _ = UNITS[units]
    return spheres_of(case_given(contact, load).subject.as_numbers(), float(effective_radius), length, force)


def _in_units(table: "xarray.Dataset", units: str) -> "xarray.Dataset":
    """Convert a friction table, a dataset of `friction_table` in SI units, to another system of units.

    units: key of UNITS.
    """
    length, force, (meter, newton, pascal) = UNITS[units]
    converted_units = {
        "m": (length, meter),
        "N": (force, newton),
        "Pa": (force / length**2, pascal),
        "N/m^3": (force / length**3, f"{newton}/{meter}^3"),
        "1": (1.0, "1"),
    }
    converted = table.copy()
    for name, variable in table.items():
        factor, unit = converted_units[variable.attrs["units"]]
        converted[name] = (variable / factor).assign_attrs(variable.attrs, units=unit)
    return converted.assign_attrs(table.attrs, units=units, comments=[*table.attrs["comments"], f"units: {units}"])
