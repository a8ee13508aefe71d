"""Compare what users read in errors and warnings with tests/texts.txt, which is reviewed as text.

After a change on purpose: `python tests/contract/test_texts.py` writes the file anew; read its difference before you commit it.
"""

import math
import re
import sys
from pathlib import Path

import numpy as np

import stiction as st
from stiction.case.read import parse_case
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.quantities.units import to_si
from stiction.records.registry import records
from stiction.records.validity_warning import ValidityWarning
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.solve import solve_map
from stiction.surfaces.fill import fill_missing
from stiction.surfaces.filters import filter_band
from stiction.surfaces.finding import asperities
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import remove_form

TEXTS = Path(__file__).parents[1] / "texts.txt"
SURFACE = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
STEEL = st.material("hardened_steel_52100")
DRY = {"first": STEEL, "second": STEEL, "roughness": SURFACE, "nominal_area": "1 mm^2", "interfacial_shear_strength": "20 MPa"}
CONTACT = st.Contact(**DRY)
FILM = st.Coating(material="silver", thickness="200 nm")
COATED = st.Contact(**DRY, coating=FILM)
GROUPS = st.Indices(theta=40.0, lam=3.0, sharpness=0.01, roughness_parameter=0.05, shear_strength=0.03)
WAVES = HeightMap(1e-8 * np.sin(np.arange(32.0))[:, None] * np.cos(np.arange(32.0)), (1e-6, 1e-6))
PLAIN = {"model": "greenwood_williamson_1966"}
UNLOADED = {"model": "greenwood_williamson_1966", "min_separation": 0.0}


def case(**tables):
    return parse_case({"indices": {"theta": 40.0, "lam": 3.0}, "solve": {"load": [0.1]}, **tables})


ERRORS = {  # wrong input -> call; in the order of the packages that raise the error
    "a length is given with a unit of force": lambda: to_si("1 N", "thickness"),
    "a unit is unknown": lambda: to_si("1 parsnip", "thickness"),
    "a number has no unit": lambda: case(indices={}, contact={"work_of_adhesion": 0.05}),
    "a number has a decimal comma": lambda: to_si("0,25 um", "thickness"),
    "a Rockwell hardness is outside its scale": lambda: to_si("70 HRC", "hardness"),
    "a thickness is negative": lambda: st.Coating(material="silver", thickness="-5 nm"),
    "a modulus of 210 GPa is given as 210": lambda: st.Material(youngs_modulus=210.0, poissons_ratio=0.3, hardness="7 GPa"),
    "a number is NaN": lambda: to_si(math.nan, "poissons_ratio"),
    "a filter wavelength is longer than the scan": lambda: filter_band(WAVES, longest="2 um"),
    "the order of the polynomial to remove is too high": lambda: remove_form(WAVES, 7),
    "the option for filling missing points is unknown": lambda: fill_missing(WAVES, "glue"),
    "the file of a scan does not exist": lambda: st.read_scan("absent.csv"),
    "an asperity method does not have the given option": lambda: asperities(WAVES, "mccool", threshold=1.0),
    "an asperity method is unknown": lambda: asperities(WAVES, "counting"),
    "a profile instead of a map": lambda: asperities(HeightMap(np.sin(np.arange(40.0))[None], (1e-8, 4e-7)), "eight_neighbour"),
    "a map size is given as one length": lambda: HeightMap(WAVES.heights, "10 um"),
    "a material preset is unknown": lambda: st.material("silvr"),
    "an interface is unknown": lambda: st.Contact(**DRY | {"interfacial_shear_strength": None}, interface="oxidized metal"),
    "an interface and its shear strength are both given": lambda: st.Contact(**DRY, interface="oxidised metal"),
    "an impossible interface": lambda: st.Contact(**DRY | {"interfacial_shear_strength": None}, interface="elastomer"),
    "a field of the roughness is unknown": lambda: SURFACE.replace(rms=3),
    "a kind of surface is unknown": lambda: SURFACE.replace(kind="grounded"),
    "a film has no thickness": lambda: st.Coating(material="silver"),
    "a dimension of two lengths": lambda: st.Indices(theta=st.axis("theta", [1.0, 2.0]), lam=st.axis("theta", [1.0, 2.0, 3.0])),
    "a flat map is solved": lambda: solve_map(np.zeros((32, 32)), (1e-6, 1e-6), modulus=1e9, loads=[1e-3], periodic=True),
    "the film of a solved map has zero thickness": lambda: Film(0.0, 1e9, 0.3, 1e11, 0.3),
    "a load is NaN": lambda: solve_map(WAVES.heights, (1e-6, 1e-6), modulus=1e9, loads=[math.nan], periodic=True),
    "a model is unknown": lambda: st.solve(CONTACT, load="1 mN", model="nobody_1900"),
    "two laws cannot be combined": lambda: st.solve(
        CONTACT, load="1 mN", model="greenwood_williamson_1966", asperity="jkr", tangential="chang_etsion_bogy_1988"
    ),
    "an option of a law is unknown": lambda: st.solve(CONTACT, load="1 mN", variant="twice", **PLAIN),
    "a tensile load is given without adhesion": lambda: st.solve(CONTACT, load="-1 mN", **PLAIN),
    "a load is larger than the contact can carry": lambda: st.solve(CONTACT, load="1 MN", **PLAIN),
    "separation and load are both given": lambda: st.solve(CONTACT, load="1 mN", separation="1 nm", **PLAIN),
    "a height distribution is unknown": lambda: st.solve(CONTACT, load="1 mN", heights="normal", **PLAIN),
    "a separation is too large": lambda: st.solve(CONTACT, separation="1 m", **PLAIN),
    "a theory solved at a separation": lambda: st.solve(CONTACT, separation="1 nm", model="persson_2001"),
    "a dimensionless group is missing": lambda: st.solve(st.Indices(lam=3.0), load=0.1),
    "boundary elements are used without a height map": lambda: st.solve(CONTACT, load="1 mN", model="boundary_elements"),
    "a contact with a film is unloaded": lambda: st.unload(COATED, separation_increase="1 nm", **UNLOADED),
    "unloading with two limits": lambda: st.unload(CONTACT, max_load="1 mN", separation_increase="1 nm", **UNLOADED),
    "a contact with a film slides": lambda: st.slide(COATED, load="1 mN", displacement="1 nm", film="sequential", **PLAIN),
    "a theory without asperities slides": lambda: st.slide(CONTACT, load="1 mN", displacement="1 nm", model="persson_2001"),
    "a meniscus law is used without a liquid": lambda: st.solve(CONTACT, load="1 mN", meniscus="equilibrium_meniscus", **PLAIN),
    "a key of a case file is unknown": lambda: case(swep={}),
    "a case has no contact": lambda: parse_case({"solve": {"load": ["1 N"]}}),
    "a case has no load": lambda: parse_case({"indices": {"theta": 40.0, "lam": 3.0}}),
    "models are compared for an array of contacts": lambda: st.compare(
        st.Contact(**DRY, work_of_adhesion=st.axis("work_of_adhesion", ["0.1 J/m^2", "1 J/m^2"])), load="1 mN"
    ),
    "models are compared at zero load": lambda: st.compare(CONTACT, load="0 N"),
    "a prediction is made at zero load": lambda: st.predict(CONTACT, load="0 N"),
    "a load exceeds the hardness times the nominal area": lambda: st.predict(CONTACT, load="1 MN"),
    "a fit has no loads or separations": lambda: st.fit(case(solve={"model": "fuller_tabor_1975"}), "absent.csv"),
    "the case file of a fit does not exist": lambda: st.fit("absent.toml", "absent.csv"),
}  # fmt: skip


def refused(call) -> str:
    """Return the line that refuses the call."""
    try:
        call()
    except InputError as error:
        return re.sub(r"\(all: .*?\)", "(all: ...)", str(error))
    raise AssertionError("nothing was refused")


def outside(rule) -> float:
    """Return a value outside the range of a validity rule that its quantity can have."""
    values = 2.0 * rule.high, 0.5 * rule.low, 2.0 * rule.low, rule.low - 1.0
    bounds = QUANTITIES[rule.quantity]
    possible = (value for value in values if math.isfinite(value) and bounds.lower <= value <= bounds.upper)
    return next(value for value in possible if not rule.low <= value <= rule.high)


def warnings_of_laws() -> list[str]:
    """Return a line for each range of validity that a record states, as a result outside of it would show it."""
    lines = set()
    for record in records():
        for rule in record.validity:
            value = outside(rule)
            lines.add(str(ValidityWarning(rule.why, rule.quantity, value, value, rule.low, rule.high, 1, 1, rule.kind)))
    return sorted(lines)


def texts() -> str:
    """Return the whole file."""
    refusals = [f"{name}\n    {refused(call)}" for name, call in ERRORS.items()]
    errors, warnings = "# Errors: the wrong input, and the message", "# Warnings: results outside the range that authors claim"
    return "\n".join([errors, *refusals, "", warnings, *warnings_of_laws(), ""])


def test_texts_are_those_that_were_reviewed():
    assert texts().splitlines() == TEXTS.read_text(encoding="utf-8").splitlines()


if __name__ == "__main__":
    sys.stdout.write(texts()) if "--show" in sys.argv else TEXTS.write_text(texts(), encoding="utf-8")
