"""Compute the roughness of a contact from scans of its bodies, by every asperity method."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from pydantic import BeforeValidator, Field, model_validator

from stiction.quantities.errors import InputError, InWords, field_as
from stiction.quantities.inputs import Input
from stiction.quantities.shown import show
from stiction.surfaces.finished import is_finished, roughness_of_finish
from stiction.surfaces.roughness import Roughness, StatedKind
from stiction.surfaces.solvable_maps import SolvableMaps

if TYPE_CHECKING:
    from stiction.surfaces.finding import Asperities
    from stiction.surfaces.heightmap import HeightMap

_Contact = TypeVar("_Contact", bound=Input)

_ALIKE = 1.5  # largest ratio of the shortest wavelengths of two scans that count as equally fine


def _length(value):
    if not isinstance(value, str):
        raise InputError("", value, 'a length with its unit, e.g. "10 um"')
    return value


_Length = Annotated[str, BeforeValidator(_length)]


class Scan(Input):
    """Describe a scan file of one body and how to read it.

    file: path, relative to the folder of the case file. size: length of the scan along x, text with a unit, in place of the
    size in the file. unit: unit of the file's numbers. height_unit: unit of its heights, if different. height_scale: factor by
    which heights are multiplied. channel: channel to read, if the file has several. periodic: whether the scan is one period.
    """

    file: str
    size: _Length | None = None
    unit: str | None = None
    height_unit: str | None = None
    height_scale: float | None = None
    channel: str | None = None
    periodic: bool = Field(False, strict=True, description="the scan is one period of an infinite surface; no form is removed")


def _body(value):
    """Return the input for one rough body as a Scan, a HeightMap or a Roughness.

    value: one of these, any input of `as_height_map`, or a table that describes a scan, a finish or a Roughness. Raises
    InputError for any other value, and for a Roughness that cannot be combined with a scan.
    """
    if value is not None and not isinstance(value, Mapping | Scan | Roughness | str | int | float | list):
        from stiction.surfaces.held import as_height_map

        return as_height_map(value, "")
    if isinstance(value, Mapping) and is_finished(value):
        return roughness_of_finish(value)
    if not isinstance(value, Mapping) or "file" in value or not (value.keys() & Roughness.model_fields.keys()):
        if not isinstance(value, Mapping | Scan | Roughness):
            raise InputError("", value, 'a table, e.g. { file = "scan.npy", size = "10 um", unit = "nm" }')
        return Scan(**value) if isinstance(value, Mapping) else value
    numbers = Roughness(**value)
    if numbers.surface is not None:
        raise InputError("surface", InWords("a table"), "no `surface` for this body, because the other body is a scan")
    if numbers.height_distribution != "gaussian":
        raise InputError("height_distribution", numbers.height_distribution, "gaussian, because the other body is a scan")
    return numbers


_Body = Annotated[Any, BeforeValidator(_body, json_schema_input_type=Scan | Roughness)]


def _is_scan(body: Any) -> bool:
    return body is not None and not isinstance(body, Roughness)


def _with_methods(schema: dict[str, Any]) -> None:
    """Set the description of the field `method` in the JSON schema to a list of all asperity methods, in place."""
    from stiction.surfaces.finding import methods

    schema["description"] = f"way of finding asperities: {', '.join(methods())}"


class MeasuredRoughness(Input):
    """Describe the scans of one or both bodies of a contact, and how asperities are found in them.

    first, second: a scan (also a HeightMap or any input of `as_height_map`), a Roughness with Gaussian heights, or None for a
    smooth body; at least one must be a scan. method: key of an asperity method, by default the first that finds enough
    asperities. form: order of the polynomial to remove, 1 for a plane. spikes: number of robust standard deviations from the
    median beyond which points are masked. fill: how missing points are filled. shortest, longest: limits of the wavelengths
    that are kept. heights: distribution of asperity heights: gaussian, weibull, empirical; by default the simplest that fits,
    or gaussian for a profile of a known kind. kind: a finish or a kind of surface, which a profile does not show.
    """

    first: _Body | None = Field(None, description="a table with the scan, or the numbers, of the first body")
    second: _Body | None = Field(None, description="a table with the scan, or the numbers, of the second body")
    method: str | None = Field(None, json_schema_extra=_with_methods)
    form: int = Field(1, ge=0, le=4, strict=True, description="order of the polynomial to remove, 0 to 4")
    spikes: float | None = Field(None, gt=0, description="mask points so many robust deviations from the median, e.g. 10")
    fill: str | None = Field(
        None, description="harmonic or nearest: how missing points are filled; by default they stay missing"
    )
    shortest: _Length | None = Field(None, description="shortest wavelength that is kept")
    longest: _Length | None = Field(None, description="longest wavelength that is kept")
    heights: str | None = Field(None, description="gaussian, weibull or empirical; by default the simplest that fits")
    kind: StatedKind = Field(None, description="a finish or a kind of surface, for a profile; a map of heights shows its kind")

    @model_validator(mode="after")
    def _some_scan(self):
        if not any(_is_scan(body) for body in (self.first, self.second)):
            raise InputError("first or second", None, 'a scan, e.g. first = { file = "scan.npy", size = "10 um", unit = "nm" }')
        return self


@dataclass(frozen=True)
class Measured:
    """Store the roughness of a contact, as every asperity method finds it in the scans.

    Dicts have the keys of the methods, unless stated otherwise. by_method: Roughness. method: the chosen method. failures: why
    a method found no asperities. history: processing steps of each body's scan, by "first" or "second". notes: remarks on the
    results, as text. counts: number of separate asperities; 0 for a method that only computes averages, and for two bodies.
    mean_heights: mean asperity height above the mean plane [m]. validity_warnings: warnings on scans and on their combination.
    of_moments: the method that computes spectral moments. stated: which of "method", "heights" and "kind" the user stated.
    solvable: maps for a point-by-point solution.
    """

    by_method: Mapping[str, Roughness]
    method: str
    failures: Mapping[str, str]
    history: Mapping[str, tuple[str, ...]]
    notes: Mapping[str, str]
    counts: Mapping[str, int]
    mean_heights: Mapping[str, float]
    validity_warnings: tuple[str, ...] = ()
    of_moments: str = ""
    stated: tuple[str, ...] = ()
    solvable: SolvableMaps = field(default_factory=SolvableMaps, repr=False, compare=False)

    def roughness(self) -> Roughness:
        """Return the roughness by the chosen method; its attribute `measured` is this object."""
        found, reduced = self.by_method[self.method], self.with_surface_moments()
        if reduced is not self:
            found = found.replace(surface=self.by_method[self.of_moments].attached(measured=reduced))
        return found.attached(measured=self)

    def contacts(self, contact: _Contact) -> dict[str, _Contact]:
        """Return a copy of a contact for each method, by name, with the roughness it found; the chosen method is first."""
        order = sorted(self.by_method, key=lambda name: name != self.method)
        return {name: contact.model_copy(update={"roughness": self.by_method[name]}) for name in order}

    def with_surface_moments(self) -> "Measured":
        """Return a copy with only the roughness by the method `of_moments`, or this object if that method failed."""
        if self.of_moments not in self.by_method:
            return self
        return replace(self, method=self.of_moments, by_method={self.of_moments: self.by_method[self.of_moments]})

    def attributes(self) -> dict[str, str]:
        """Return the attributes of a dataset of results: the chosen method, and the processing steps of all scans."""
        scans = "\n".join(f"{body} body: {step}" for body, steps in self.history.items() for step in steps)
        return {"roughness_method": self.method, "scans": scans}

    def sources(self) -> list[str]:
        """Return the bibliography keys of the sources of all methods that found asperities, without duplicates."""
        from stiction.surfaces.finding import methods

        known = methods()
        return list(dict.fromkeys(source.key for name in self.by_method for source in known[name].sources))

    def record(self) -> dict[str, Any]:
        """Return the results of all methods and the history of the scans as a dict for JSON, with numbers in SI units."""
        by_method = {
            name: {
                "sigma": one.asperity_height_deviation,
                "R": one.asperity_radius,
                "N": one.asperity_density,
                "height_distribution": one.height_distribution,
                "mean_height": self.mean_heights[name],
                "count": self.counts[name],
                "note": self.notes[name],
            }
            for name, one in self.by_method.items()
        }
        return {
            "method": self.method,
            "units": {"sigma": "m", "R": "m", "N": "1/m^2", "mean_height": "m"},
            "by_method": by_method,
            "failures": dict(self.failures),
            "validity_warnings": list(self.validity_warnings),
            "history": {body: list(steps) for body, steps in self.history.items()},
        }


def of_one_map(found: Roughness, asperities: "Asperities", surface: "HeightMap") -> Measured:
    """Return the Measured object for a contact with one map, from its roughness `found` and its asperities."""
    key = asperities.method
    return Measured(
        by_method={key: found},
        method=key,
        failures={},
        history={"first": surface.history},
        notes={key: asperities.note},
        counts={key: asperities.count},
        mean_heights={key: asperities.mean_height},
        solvable=SolvableMaps({"first": surface}),
    )


def roughness_of(table: Mapping[str, Any], folder: Path = Path()) -> Roughness:
    """Return the roughness of a contact from a table that describes the scans of its bodies.

    table: fields of MeasuredRoughness. folder: base of the file paths. The result also stores the asperities that the other
    methods found. Raises InputError if a scan cannot be read or no asperities are found.
    """
    return measure(MeasuredRoughness(**table), folder).roughness()


def measure(wanted: MeasuredRoughness, folder: Path = Path()) -> Measured:
    """Read and prepare the scans of a contact, and find the asperities by every method.

    wanted: the scans and options. folder: base of the file paths. Raises InputError if a scan cannot be read, if no method or
    not the requested one finds asperities, or if `heights` is unknown, or not "gaussian" with two rough bodies.
    """
    from stiction.surfaces.asperity_set import of_numbers
    from stiction.surfaces.finding import asperities, method_of_moments, methods
    from stiction.surfaces.gaussian_asperities import combine
    from stiction.surfaces.height_model import MODELS, height_model, roughness

    bodies: dict[str, Any] = {"first": wanted.first, "second": wanted.second}
    scans = {
        name: surface_of(body, folder, name) if isinstance(body, Scan) else body
        for name, body in bodies.items()
        if _is_scan(body)
    }
    maps = {name: _prepared(scan, wanted, bodies[name], name) for name, scan in scans.items()}
    known = [of_numbers(body) for body in bodies.values() if isinstance(body, Roughness)]
    alone = len(maps) + len(known) == 1
    if wanted.heights not in (None, *MODELS):
        raise InputError("heights", wanted.heights, ", ".join(MODELS))
    if wanted.heights not in (None, "gaussian") and not alone:
        raise InputError("heights", wanted.heights, "gaussian, because the heights of the two rough bodies are combined")
    periods = {name: _prepared(scan, wanted, bodies[name], name, True) for name, scan in scans.items() if scan.periodic}
    solvable = SolvableMaps(maps | periods, bool(known))
    one_map = _one_map(solvable)
    heights = wanted.heights or ("gaussian" if wanted.kind and one_map is None else None)
    found: dict[str, Asperities] = {}
    surfaces: dict[str, Roughness] = {}
    counts: dict[str, int] = {}
    failures: dict[str, str] = {}
    for method in methods():
        try:
            each = [asperities(one, method) for one in maps.values()]
            together = [*each, *known]
            one = together[0] if alone else combine(*together)
            surfaces[method] = roughness(one, height_model(one, heights)).model_copy(update={"kind": wanted.kind})
            counts[method] = min(map(separate_count, each, maps.values()))
            found[method] = one
        except InputError as error:
            failures[method] = str(error)
    if not found:
        raise InputError(
            "",
            InWords("no asperities by any method"),
            "scans with asperities; run `stiction surface` on each scan to see the asperities it has",
        )
    of_moments = method_of_moments()
    if of_moments in surfaces:
        surface = surfaces[of_moments].attached(map=one_map)
        surfaces = {
            name: surface if name == of_moments else one.model_copy(update={"surface": surface})
            for name, one in surfaces.items()
        }
    method = wanted.method or default_method(found, counts)
    if method not in found:
        why = f"; nothing by {method}: {failures[method]}" if method in failures else ""
        raise InputError("method", method, ", ".join(found) + why)
    validity_warnings = _validity_warnings(list(maps.values()), bool(known), wanted)
    return Measured(
        by_method=surfaces,
        method=method,
        failures=failures,
        history={body: one.history for body, one in maps.items()},
        notes={name: one.note for name, one in found.items()},
        counts=counts if alone else dict.fromkeys(counts, 0),
        mean_heights={name: one.mean_height for name, one in found.items()},
        validity_warnings=(*_spikes(maps), *validity_warnings, *_without_moments(failures.get(of_moments))),
        of_moments=of_moments,
        stated=tuple(name for name in ("method", "heights", "kind") if getattr(wanted, name) is not None),
        solvable=solvable,
    )


def _one_map(solvable: SolvableMaps) -> "HeightMap | None":
    """Return the single map that represents the roughness of both bodies; None if the maps cannot be combined into one."""
    try:
        return solvable.one()
    except InputError:
        return None


def separate_count(found: "Asperities", surface: "HeightMap") -> int:
    """Return the number of separate asperities: the number found, but on a map at most density times area.

    A method may find the same hill on two or more neighbouring profiles and count it each time.
    """
    if surface.is_profile:
        return found.count
    return min(found.count, round(found.density * surface.size[0] * surface.size[1]))


def default_method(found: Mapping[str, "Asperities"], counts: Mapping[str, int]) -> str:
    """Return the key of the asperity method that is used if the user specifies none.

    found: asperities by method. counts: number of separate asperities by method. The result is the first method that finds at
    least FEW asperities, or whose result has averages only (as always for two bodies); if there is none, the first in `found`,
    or "" if it is empty. Methods with `of_summits` come first, because their moments can be added for two bodies.
    """
    from stiction.surfaces.asperity_set import FEW
    from stiction.surfaces.finding import methods

    preferred = [name for name, one in methods().items() if one.of_summits]
    enough = [name for name in (*preferred, *found) if name in found and (counts[name] >= FEW or not found[name].count)]
    return next(iter([*enough, *found]), "")


def _spikes(maps: "Mapping[str, HeightMap]") -> tuple[str, ...]:
    from stiction.surfaces.spikes import SUSPICIOUS, spikes

    counts = {body: int(spikes(one).sum()) for body, one in maps.items()}
    return tuple(
        f"{count} points of the scan of the {body} body are more than {SUSPICIOUS:g} robust deviations from the median: if "
        f"these are spikes, mask them with spikes = {SUSPICIOUS:g}"
        for body, count in counts.items()
        if count
    )


def _without_moments(why: str | None) -> tuple[str, ...]:
    text = f"the spectral moments are unknown ({why}): theories of the whole surface use the asperities found"
    return () if why is None else (text,)


def _validity_warnings(maps: "list[HeightMap]", numbers: bool, wanted: MeasuredRoughness) -> tuple[str, ...]:
    """Return warnings if the resolutions (shortest wavelengths) of two rough bodies differ, or if one of them is unknown.

    maps: maps of the scanned bodies. numbers: whether one body is described by sigma, R and N. wanted: holds `shortest`.
    """
    if numbers:
        return ("the resolution of the body stated by numbers is unknown: it must equal the resolution of the scan",)
    if len(maps) < 2:
        return ()
    from stiction.surfaces.heightmap import metres

    kept = 0.0 if wanted.shortest is None else metres(wanted.shortest, "shortest")
    cutoffs = [max(kept, 2.0 * one.coarsest_pitch) for one in maps]
    if max(cutoffs) <= _ALIKE * min(cutoffs):
        return ()
    first, second = (show(cutoff, "scan_size", 3) for cutoff in cutoffs)
    return (
        f"the scans have different resolutions (shortest waves {first} and {second}), and the finer scan alone determines R "
        "and N: state the same `shortest` for both",
    )


def _prepared(surface: "HeightMap", wanted: MeasuredRoughness, scan: Any, body: str, period: bool = False) -> "HeightMap":
    from stiction.surfaces.prepare import prepared

    own = f"{body}.file" if isinstance(scan, Scan) else body
    with field_as(lambda field: own if field == "scan" else field):
        return prepared(surface, wanted.form, wanted.spikes, wanted.fill, wanted.shortest, wanted.longest, period)


def surface_of(scan: Scan, folder: Path, body: str) -> "HeightMap":
    """Read the scan of a body as a HeightMap; raise InputError if it cannot be read.

    folder: folder to which the file path is relative. body: "first" or "second", for errors.
    """
    from stiction.surfaces.read import read_scan

    given = {name: getattr(scan, name) for name in ("size", "unit", "height_unit", "height_scale", "channel")}
    with field_as(lambda field: f"{body}.{'file' if field == 'scan' else field}"):
        surface = read_scan(folder / scan.file, **given)
    return replace(surface, periodic=scan.periodic or surface.periodic)
