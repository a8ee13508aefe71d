"""Plan a sweep: its contacts, how they are cut into blocks, and which results are stored."""

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from stiction.case.addresses import roughness_in, with_numbers, with_roughness
from stiction.case.read import Case, case_of, with_files_read
from stiction.case.study_tables import study_table
from stiction.case.swept import Address, SweptNumber
from stiction.case.uncertain import SAMPLE, Uncertain
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.inputs import require_names
from stiction.solving.pointwise import Region, pieces, tiles
from stiction.studies.prediction.predict import is_predicted
from stiction.studies.sweep.maps import PLACE, MapOfPlace, maps_of
from stiction.studies.sweep.table import LARGEST_BLOCK, Sample, Sweep

AT_ONCE = 131_072  # points of a block, half a second of work; larger blocks are solved in parts of this size
_MOST_BLOCKS = 50_000_000  # 10^12 points in blocks of the usual size are 7.6 million
_BITS = 32  # bits of the coordinates of Sobol points, the most with which points can be skipped quickly


@dataclass(frozen=True)
class Plan:
    """Describe a checked sweep, cut into blocks: parts of its contacts that are solved and stored at once.

    Any process can compute any block, in any order, and gets the same bits. case: the case with the first value of each array
    parameter. swept: array parameters by address (tuple of keys). sweep: the table [sweep]. dims: number of contacts along each
    dimension. tile: number of contacts in one block along each dimension. points: number of loads or separations of each
    contact. load: loads, None if the case states separations. uncertain: numbers that a prediction samples for every
    contact. scans: attributes that describe measured roughness. maps: one map for each contact, in a sweep over maps. Use
    `make_plan` to build a plan.
    """

    case: Case
    swept: Mapping[Address, SweptNumber]
    sweep: Sweep
    dims: Mapping[str, int] = field(default_factory=dict)
    tile: Mapping[str, int] = field(default_factory=dict)
    points: int = 1
    load: Any = None
    uncertain: tuple[Uncertain, ...] = ()
    scans: Mapping[str, str] = field(default_factory=dict)
    maps: tuple[MapOfPlace, ...] = ()

    @property
    def blocks(self) -> int:
        return math.prod(self._tiles())

    @property
    def size(self) -> int:
        """Return the number of solved points: contacts times loads or separations."""
        return math.prod(self.dims.values()) * self.points

    def _tiles(self) -> list[int]:
        return [-(-length // self.tile[dim]) for dim, length in self.dims.items()]

    def region(self, block: int) -> Region:
        """Return the contacts of the block with the number `block`, as a slice for each dimension."""
        places = np.unravel_index(block, self._tiles()) if self.dims else ()
        starts = {dim: int(at) * self.tile[dim] for dim, at in zip(self.dims, places, strict=True)}
        return {dim: slice(start, min(start + self.tile[dim], self.dims[dim])) for dim, start in starts.items()}

    def pieces(self, block: int) -> Iterator[Region]:
        """Yield the regions into which block number `block` is cut, each solved in one call."""
        return pieces(self.region(block), AT_ONCE // self.points)

    def contacts(self, block: int) -> int:
        """Return the number of contacts in the block with the number `block`."""
        return math.prod(some.stop - some.start for some in self.region(block).values())

    def case_at(self, region: Mapping[str, slice]) -> Case:
        """Return the case for a region of contacts, without the values of its array parameters, which `arrays` returns.

        region: slice by dimension. In a sweep over maps, the case has the roughness of the first map in the region.
        """
        if not self.maps:
            return self.case
        return self.case.at({("contact", "roughness"): self.maps[region[PLACE].start].roughness()})

    def arrays(self, region: Mapping[str, slice]) -> dict[Address, Any]:
        """Return the array parameters of a region of contacts, in SI units by address (tuple of keys); {} in a sweep over maps.

        Each is a labelled array (xarray). region: slice by dimension.
        """
        if self.maps:
            return {}
        if self.sweep.sample.is_drawn:
            return self._drawn(region[SAMPLE])
        listed = self.sweep.sample.method == "list"
        found = {}
        for path, one in self.swept.items():
            dim = SAMPLE if listed else one.dimension
            found[path] = one.array(one.numbers()[region[dim]], dim)
        return found

    def _drawn(self, some: slice) -> dict[Address, Any]:
        """Return the array parameters of the sampled contacts in the slice `some`, by address (tuple of keys).

        Each is a labelled array (xarray). Parameters with the same dimension name are sampled at the same position, so that
        they vary together.
        """
        columns = list(dict.fromkeys(one.dimension for one in self.swept.values()))
        shares = _shares(self.sweep.sample, len(columns), some)
        return {path: one.array(one.at(shares[:, columns.index(one.dimension)]), SAMPLE) for path, one in self.swept.items()}

    def identity(self) -> str:
        """Return JSON text of everything that determines the results; it is equal for equal sweeps."""
        case = self.case
        solve = {"separation": case.separation, "load": case.load, **case.choice.arguments()}
        plain: Any = {name: subject.model_dump() for name, subject in case.tables.items()}
        plain = with_numbers(plain, {path: one.as_table() for path, one in self.swept.items()})
        plain |= {"solve": solve, "uncertainty": case.uncertainty.model_dump(), "sweep": self.sweep.model_dump()}
        files = {}
        if self.maps:
            plain = with_roughness(plain, None)
            files = {"maps": list(dict.fromkeys(one.content for one in self.maps))}
        return json.dumps(plain | files, sort_keys=True, default=_plain)


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else str(value)


def _shares(sample: Sample, columns: int, some: slice) -> np.ndarray:
    """Return the sample points in the slice `some` of all points, (n, columns), with coordinates from 0 to 1.

    columns: number of sampled dimensions. A coordinate is a position between the start (0) and the stop (1) of a range.
    """
    from scipy.stats import qmc

    if sample.method == "latin_hypercube":
        return qmc.LatinHypercube(columns, rng=sample.seed).random(sample.count)[some]
    import warnings

    sobol = qmc.Sobol(columns, rng=sample.seed, bits=_BITS)
    if some.start:
        sobol.fast_forward(some.start)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # SciPy warns that a part of the sequence is not balanced
        return sobol.random(some.stop - some.start)


def make_plan(content: Mapping[str, Any], folder: Path = Path()) -> Plan:
    """Return the sweep plan that the tables of a case file describe.

    folder: folder at which relative paths in the tables start. Raises InputError.
    """
    require_names(content)
    sweep: Sweep = study_table({"sweep": {}, **content}, "sweep", "a table with sample, keep, statistics, precision, block")
    if sweep.roughness:
        return _plan_of_maps(content, folder, sweep)
    content, swept = with_files_read(content, folder)
    case, scans = _without_scans(case_of({key: value for key, value in content.items() if key != "sweep"}))
    uncertain: tuple[Uncertain, ...] = ()
    if not sweep.sample.is_drawn and is_predicted(case):
        uncertain = tuple(one for one in swept.values() if isinstance(one, Uncertain))
        swept = {path: one for path, one in swept.items() if not isinstance(one, Uncertain)}
    plan = Plan(case, swept, sweep, scans=scans, uncertain=uncertain)
    lengths = _lengths(plan)
    first = case.at(replace(plan, dims=lengths).arrays({dim: slice(0, 1) for dim in lengths}))
    (points,) = first.requested_points.values()
    size = int(np.size(points)) if not hasattr(points, "dims") else points.sizes["separation"]
    return _cut(replace(plan, points=size, load=first.load), lengths)


def _plan_of_maps(content: Mapping[str, Any], folder: Path, sweep: Sweep) -> Plan:
    """Return the plan of a sweep over height maps, with one map in each block.

    content: tables of the case. folder: base folder of relative paths. Raises InputError.
    """
    if not isinstance(content.get("contact"), Mapping):
        raise InputError("sweep.roughness", InWords("given"), "a case with [contact]")
    maps = maps_of(sweep.roughness, roughness_in(content), folder)
    first = maps[0].roughness()
    opened_content, swept = with_files_read(with_roughness(content, first), folder)
    if swept:
        one = next(iter(swept.values()))
        raise InputError(one.where, one.words, "a single number, because the sweep is over maps")
    if sweep.sample.method != "grid":
        raise InputError("sweep.sample", sweep.sample.method, "grid or no value, because the sweep is over maps")
    if sweep.block is not None:
        raise InputError("sweep.block", sweep.block, "no value, because the sweep is over maps and each map is a block")
    case = case_of({key: value for key, value in opened_content.items() if key != "sweep"})
    scans = {"maps": "\n".join(one.name for one in maps)}
    case = replace(case, subject=case.subject.as_numbers())
    (points,) = case.requested_points.values()
    return Plan(case, {}, sweep, {PLACE: len(maps)}, {PLACE: 1}, np.size(points), case.load, scans=scans, maps=maps)


def _without_scans(case: Case) -> tuple[Case, dict[str, str]]:
    """Return the case with roughness parameters instead of scans, and attributes that describe the scans.

    The parameters are those that the asperity method of the case finds. Worker processes then need no scan files. A case
    without scans is returned unchanged, with {}.
    """
    if case.measured is None:
        return case, {}
    return replace(case, subject=case.subject.as_numbers()), case.measured.attributes()


def _lengths(plan: Plan) -> dict[str, int]:
    """Return the number of contacts of a sweep along each dimension.

    Raises InputError if there is no array parameter, or if two array parameters along one dimension differ in length.
    """
    if not plan.swept:
        raise InputError(
            "contact", InWords("single numbers only"), "at least one array parameter: a list or {start, stop, count}"
        )
    sample = plan.sweep.sample
    if sample.is_drawn:
        assert sample.count is not None  # checked by the table
        return {SAMPLE: sample.count}
    found: dict[str, tuple[int, SweptNumber]] = {}
    for one in plan.swept.values():
        dim, length = (SAMPLE if sample.method == "list" else one.dimension), len(one.numbers())
        other = found.setdefault(dim, (length, one))
        if other[0] != length:
            raise InputError(one.where, InWords(f"{length} values"), f"{other[0]}, as many as {other[1].where} has")
    return {dim: length for dim, (length, _) in found.items()}


def _cut(plan: Plan, lengths: Mapping[str, int]) -> Plan:
    """Return the plan cut into blocks of the requested or default size.

    lengths: number of contacts along each dimension. Only the first dimensions are cut; every block has the full length of the
    last ones. Raises InputError if there would be too many blocks.
    """
    size = math.prod(lengths.values()) * plan.points
    times = min(max(1, size // (64 * AT_ONCE)), 8) if plan.sweep.statistics else 1
    room = max(1, plan.sweep.block // plan.points if plan.sweep.block else times * (AT_ONCE // plan.points))
    cut = replace(plan, dims=dict(lengths), tile=tiles(lengths, room))
    if cut.blocks > _MOST_BLOCKS:
        allowed = f"{_MOST_BLOCKS} blocks at most: fewer points, or a larger sweep.block, up to {LARGEST_BLOCK}"
        raise InputError("sweep", InWords(f"{cut.size} points in {cut.blocks} blocks"), allowed)
    return cut
