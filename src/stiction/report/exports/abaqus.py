"""Write Abaqus input: a *SURFACE INTERACTION with *FRICTION against pressure and, without a film, *SURFACE BEHAVIOR.

Document: Abaqus Keywords Reference Guide, "*FRICTION" (ELASTIC SLIP; data lines: friction coefficient, slip rate, contact
pressure), "*SURFACE BEHAVIOR" (PRESSURE-OVERCLOSURE=TABULAR; data lines: pressure, overclosure) and "*SURFACE INTERACTION". The
slip rate is empty, because mu does not depend on it. ELASTIC SLIP is one number, taken at the stated load; only Abaqus/Standard
reads it. Overclosure is zero at the separation at which the pressure, extrapolated linearly from the first two rows, is zero.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray


def surface_behavior(table: "xarray.Dataset") -> list[str]:
    """Return the *SURFACE BEHAVIOR lines of a friction table: contact pressure against overclosure.

    table: dataset of `export` for bodies without a film. The overclosure is the approach of the mean planes from the separation
    at which the pressure, extrapolated linearly from the first two rows, is 0.
    """
    pressure, gap = table["nominal_pressure"].values, table["mean_separation"].values
    touch = gap[0] + pressure[0] * (gap[0] - gap[1]) / (pressure[1] - pressure[0])
    lines = [f"** overclosure 0: the mean planes are {touch:.6g} {table['mean_separation'].attrs['units']} apart"]
    lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR", "0., 0."]
    return lines + [f"{p:.8g}, {touch - h:.8g}" for p, h in zip(pressure, gap, strict=True)]


def at_stated_load(table: "xarray.Dataset", what: str) -> str:
    """Return a comment line with the load and the pressure at which some numbers of the file hold.

    table: dataset of `export`. what: name of the numbers for which the file has one value, at the stated load.
    """
    row = table.isel(row=table.attrs["working_row"])
    load, pressure = (f"{float(row[name]):.6g} {row[name].attrs['units']}" for name in ("load", "nominal_pressure"))
    return f"** {what} at the load {load}, pressure {pressure}"


def content(table: "xarray.Dataset") -> str:
    """Return mu against nominal pressure as text of an Abaqus input file.

    table: dataset of `export`, in its consistent units.
    """
    lines = [*(f"** {text}" for text in table.attrs["comments"]), "*SURFACE INTERACTION, NAME=STICTION"]
    slip = ""
    if "elastic_slip" in table:
        slip = f", ELASTIC SLIP={float(table['elastic_slip'][table.attrs['working_row']]):.6g}"
        lines += [*surface_behavior(table), at_stated_load(table, "ELASTIC SLIP")]
    rows = zip(table["friction_coefficient"].values, table["nominal_pressure"].values, strict=True)
    lines += [f"*FRICTION{slip}", *(f"{mu:.8g}, , {pressure:.8g}" for mu, pressure in rows)]
    return "\n".join(lines) + "\n"
