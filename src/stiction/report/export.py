"""Write predicted friction for other programs: one file of `exports/` is one format."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from stiction.quantities.errors import InputError
from stiction.quantities.paths import require_place
from stiction.report.exports import UNITS, export_formats
from stiction.studies.prediction.friction_table import friction_table

if TYPE_CHECKING:
    import xarray

    from stiction.case.arguments import CaseLike
    from stiction.contact.contact import Contact
    from stiction.quantities.arguments import FilePath, QuantityLike

__all__ = ["export"]


def export(
    contact: "Contact | CaseLike",
    to: str,
    out: "FilePath | None" = None,
    *,
    load: "QuantityLike | None" = None,
    level: float = 0.5,
    units: str = "m-kg-s",
) -> "xarray.Dataset":
    """Write the predicted friction of a contact against nominal pressure for another program.

    Parameters
    ----------
    contact : Contact, Case, dict or path
        As `predict` takes it; one contact.
    to : str
        Name of a format, e.g. "abaqus"; an unknown one is refused with the list of all.
    out : path, optional
        File to write; by default nothing is written.
    load : number, text or sequence, optional
        Normal load [N]; by default the loads of the case. More than one: the table spans them; one: two decades either side.
    level : float
        Quantile of mu, between 0 and 1: 0.5 the median, 0.05 a lower bound.
    units : str
        Consistent units of the file, e.g. "mm-N-MPa"; unknown ones are refused with the list of all.

    Returns
    -------
    xarray.Dataset
        What is written, in these units, over `row`: load, nominal_pressure, friction_coefficient and, of bare bodies,
        tangential_stiffness (shear stress over displacement at rest), elastic_slip and mean_separation. `text` among the
        attributes is the content of the file, as text or bytes.

    Raises
    ------
    InputError
        An unknown format or unit, a contact without a prediction, or a file that cannot be written.

    Notes
    -----
    Between rows mu is linear in pressure within 0.1 %. Beyond the first and last row most programs hold mu constant.

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
        require_place(Path(out), "a file, new or existing")
    table = _in_units(friction_table(contact, load=load, level=level), units)
    content = import_module(f"stiction.report.exports.{to}").content(table)
    if out is not None:
        data = content.encode() if isinstance(content, str) else content
        try:
            Path(out).write_bytes(data)
        except OSError as error:
            raise InputError("out", str(out), f"a file that can be written ({error.strerror})") from None
    return table.assign_attrs(text=content)


def _in_units(table: "xarray.Dataset", units: str) -> "xarray.Dataset":
    """Return the table in a system of units."""
    length, force, (meter, newton, pascal) = UNITS[units]
    of = {
        "m": (length, meter),
        "N": (force, newton),
        "Pa": (force / length**2, pascal),
        "N/m^3": (force / length**3, f"{newton}/{meter}^3"),
        "1": (1.0, "1"),
    }
    converted = table.copy()
    for name, variable in table.items():
        factor, unit = of[variable.attrs["units"]]
        converted[name] = (variable / factor).assign_attrs(variable.attrs, units=unit)
    return converted.assign_attrs(table.attrs, units=units, comments=[*table.attrs["comments"], f"units: {units}"])
