"""The rough surface of a contact from scans of its bodies in place of numbers: a Roughness for each way to find asperities."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BeforeValidator, Field, model_validator

from stiction.contact import Contact, Roughness
from stiction.errors import InputError
from stiction.inputs import Input

if TYPE_CHECKING:
    from .surfaces.asperities import Asperities
    from .surfaces.heightmap import HeightMap

# What stands for the surface unless a case says otherwise: the first that finds FEW or more. Summits that stand out of the
# noise by a threshold are the least touched by the resolution of the instrument; on a scan with spikes, which set the
# threshold, they may be too few, and on a profile there are none.
PREFERRED = ("persistence", "eight_neighbour", "three_point")


def _length(value):
    if not isinstance(value, str):
        raise InputError("", value, 'a length with its unit, e.g. "10 um"')
    return value


_Length = Annotated[str, BeforeValidator(_length)]


class Scan(Input):
    """A scan of one body. file: path, from the folder of the case file. size: along x, in place of what the file says; unit and
    height_unit: of the numbers in the file; channel: of a file with several. Raises InputError."""

    file: str
    size: _Length | None = None
    unit: str | None = None
    height_unit: str | None = None
    channel: str | None = None


def _body(value):
    """A scan, or the numbers of a body that was not measured."""
    if not isinstance(value, Mapping) or "file" in value or not (value.keys() & Roughness.model_fields.keys()):
        return value if isinstance(value, Scan | Roughness) else Scan(**_table(value))
    numbers = Roughness(**value)
    if numbers.height_distribution != "gaussian":
        raise InputError("height_distribution", numbers.height_distribution, "gaussian, of a body beside one that was measured")
    return numbers


def _table(value) -> Mapping:
    if not isinstance(value, Mapping):
        raise InputError("", value, 'a table, e.g. { file = "scan.npy", size = "10 um", unit = "nm" }')
    return value


_Body = Annotated[Scan | Roughness, BeforeValidator(_body, json_schema_input_type=Scan | Roughness)]


class MeasuredRoughness(Input):
    """Scans of one body, the other being smooth or known by its numbers, or of both, and how asperities are found in them.

    first, second: a scan, or a Roughness with Gaussian heights, one of them a scan. method: key of a way of finding asperities;
    else the first of PREFERRED that finds enough. form: order of the polynomial that is taken off, 1 for a plane. spikes:
    robust deviations from the median beyond which points are masked. fill: how missing points are filled, if they are.
    shortest, longest: wavelengths between which the heights are kept. heights: gaussian, weibull or empirical, the distribution
    of the asperity heights; else the simplest that fits. Raises InputError.
    """

    first: _Body | None = Field(None, description="a table with the scan, or the numbers, of the first body")
    second: _Body | None = Field(None, description="a table with the scan, or the numbers, of the second body")
    method: str | None = Field(None, description="persistence, eight_neighbour, three_point, n_point or mccool")
    form: int = Field(1, ge=0, le=4, strict=True, description="order of the polynomial that is taken off, 0 to 4")
    spikes: float | None = Field(None, gt=0, description="mask points so many robust deviations from the median, e.g. 10")
    fill: str | None = Field(None, description="harmonic or nearest: fill missing points; else they are left out")
    shortest: _Length | None = Field(None, description="shortest wavelength that is kept")
    longest: _Length | None = Field(None, description="longest wavelength that is kept")
    heights: str | None = Field(None, description="gaussian, weibull or empirical; else the simplest that fits")

    @model_validator(mode="after")
    def _some_scan(self):
        if not any(isinstance(body, Scan) for body in (self.first, self.second)):
            raise InputError("first or second", None, 'a scan, e.g. first = { file = "scan.npy", size = "10 um", unit = "nm" }')
        return self


@dataclass(frozen=True)
class Measured:
    """What scans say of the roughness of a contact.

    by_method: method -> Roughness; method: that which stands for the surface; failures: method -> why it found nothing.
    history: of each scan, in words; notes: method -> what was found, and what it rests on; counts: method -> how many
    asperities it found, on the body with fewer; 0 where it has averages only.
    """

    by_method: Mapping[str, Roughness]
    method: str
    failures: Mapping[str, str]
    history: Mapping[str, tuple[str, ...]]
    notes: Mapping[str, str]
    counts: Mapping[str, int]

    def contacts(self, contact: Contact) -> dict[str, Contact]:
        """The contact with the roughness that each method finds, the chosen method first."""
        order = sorted(self.by_method, key=lambda name: name != self.method)
        return {name: contact.model_copy(update={"roughness": self.by_method[name]}) for name in order}

    def attributes(self) -> dict[str, str]:
        """What goes with a result: the method, and what was done to each scan."""
        scans = "\n".join(f"{body} body: {step}" for body, steps in self.history.items() for step in steps)
        return {"roughness_method": self.method, "scans": scans}

    def record(self) -> dict[str, Any]:
        """Everything as plain numbers in SI units, for JSON."""
        by_method = {
            name: {
                "sigma": one.asperity_height_deviation,
                "R": one.asperity_radius,
                "N": one.asperity_density,
                "height_distribution": one.height_distribution,
                "count": self.counts[name],
                "note": self.notes[name],
            }
            for name, one in self.by_method.items()
        }
        return {
            "method": self.method,
            "units": {"sigma": "m", "R": "m", "N": "1/m^2"},
            "by_method": by_method,
            "failures": dict(self.failures),
            "history": {body: list(steps) for body, steps in self.history.items()},
        }


def measure(wanted: MeasuredRoughness, folder: Path) -> Measured:
    """Read the scans, prepare them, and find asperities by every method. Raises InputError for scans that cannot be read or
    where the wanted method finds nothing."""
    from .surfaces.asperities import METHODS, asperities, combine
    from .surfaces.asperity_set import FEW, of_numbers
    from .surfaces.height_model import height_model, roughness

    bodies = {"first": wanted.first, "second": wanted.second}
    maps = {name: _prepared(body, wanted, folder, name) for name, body in bodies.items() if isinstance(body, Scan)}
    known = [of_numbers(body) for body in bodies.values() if isinstance(body, Roughness)]
    found: dict[str, Asperities] = {}
    counts: dict[str, int] = {}
    failures: dict[str, str] = {}
    for method in METHODS:
        try:
            each = [asperities(one, method) for one in maps.values()]
            together = [*each, *known]
            found[method] = together[0] if len(together) == 1 else combine(*together)
            counts[method] = min(one.count for one in each)
        except InputError as error:
            failures[method] = str(error)
    method = wanted.method or next((one for one in PREFERRED if counts.get(one, 0) >= FEW), next(iter(found), ""))
    if method not in found:
        every = "; ".join(f"{name}: {why}" for name, why in failures.items())
        raise InputError("roughness.method", method, f"{', '.join(found)}; {failures.get(method, every or 'no such method')}")
    return Measured(
        {name: roughness(one, height_model(one, wanted.heights)) for name, one in found.items()},
        method,
        failures,
        {body: one.history for body, one in maps.items()},
        {name: one.note for name, one in found.items()},
        counts,
    )


def _prepared(scan: Scan, wanted: MeasuredRoughness, folder: Path, body: str) -> "HeightMap":
    from .surfaces.analysis import prepared
    from .surfaces.read import read_scan

    given: dict[str, Any] = {"size": scan.size, "unit": scan.unit, "height_unit": scan.height_unit, "channel": scan.channel}
    try:
        surface = read_scan(folder / scan.file, **given)
        return prepared(surface, wanted.form, wanted.spikes, wanted.fill, wanted.shortest, wanted.longest)
    except InputError as error:
        raise InputError(f"roughness.{body}.{error.field}", error.value, error.allowed) from None
