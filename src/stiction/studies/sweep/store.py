"""Read and write the store of a sweep: a zarr 3 folder of chunked, labelled arrays, which xarray.open_zarr opens.

Each block is written separately: one chunk of every array, of histograms one or more. Its row in `validity_warnings_by_block`
is written last and marks the block as done. zarr moves complete files into place, so that no file is half written. An
interrupted block is computed again, with the same bits.
"""

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zlib import crc32

import numpy as np

from stiction.engine.tiers import all_compiled
from stiction.quantities.uninterrupted import uninterrupted
from stiction.solving.choice import Choice
from stiction.studies.sweep.blocks import merged, solve_block, statistics_of
from stiction.studies.sweep.plan import SAMPLE, Plan
from stiction.studies.sweep.quantile_counts import PERCENTILES, histogram, quantiles_of

if TYPE_CHECKING:
    import xarray

DONE, CHECKSUMS, WARNINGS, PARTS, COUNTS = (
    "validity_warnings_by_block",
    "checksum_by_block",
    "validity_warnings",
    "statistics_by_block",
    "counts_by_block",
)
NOT_DONE = -1  # value that marks a block as not done
_ROWS_AT_ONCE = 1_000_000  # numbers that are read from disk together


@dataclass(frozen=True)
class Store:
    """Read and write the store of a sweep plan at a path; several processes may open it and compute different blocks."""

    path: str
    plan: Plan

    @cached_property
    def group(self) -> Any:
        import zarr

        return zarr.open_group(self.path, mode="r+", zarr_format=3, use_consolidated=False)

    @cached_property
    def _arrays(self) -> dict[str, Any]:
        """Return all arrays of the store by their path in the store, each opened once, because opening reads a file."""
        return {path: one for path, one in self.group.members(max_depth=None) if hasattr(one, "shape")}

    @cached_property
    def _choice(self) -> Choice:
        return Choice(**json.loads(self.group.attrs["choice"]))

    @cached_property
    def _results(self) -> dict[str, tuple[str, ...]]:
        return {name: tuple(of) for name, of in json.loads(self.group.attrs["results"]).items()}

    @cached_property
    def _points(self) -> dict[str, int]:
        return json.loads(self.group.attrs["points"])

    def left(self) -> list[int]:
        """Return the numbers of the blocks that are not done, ascending."""
        done = self.group[DONE][:, 0]
        return np.flatnonzero(done == NOT_DONE).tolist()

    def damaged(self) -> list[int]:
        """Return the numbers of finished blocks whose files were changed or deleted later, ascending."""
        left = set(self.left())
        return [block for block in range(self.plan.blocks) if block not in left and not self.is_whole(block)]

    def do(self, block: int) -> int:
        """Solve and store the block with the number `block`; return its number of points, contacts times loads or separations.

        Raises OSError if the block cannot be written.
        """
        with all_compiled():
            results, validity_warnings = solve_block(self.plan, self._choice, block, self._results, self._points)
        with uninterrupted():
            self._write(block, results, validity_warnings)
        return validity_warnings.size

    def is_whole(self, block: int) -> bool:
        """Return whether a finished block, given by its number, can be read and has its original checksum."""
        try:
            return _checksum(self._read(block)) == int(self._arrays[CHECKSUMS][block])
        except Exception:  # zarr raises many kinds of errors for damaged files
            return False

    def _write(self, block: int, results: Mapping[str, np.ndarray], validity_warnings: np.ndarray) -> None:
        if self.plan.sweep.statistics:
            values = self._statistics(results)
        else:
            values = {**results, WARNINGS: validity_warnings, **self._drawn(block)}
        written = []
        for path, place in self._places(block).items():
            written.append(values[path].astype(self._arrays[path].dtype))
            if path.startswith(COUNTS):
                place = (*place, ..., slice(written[-1].shape[-1]))
            self._arrays[path][place] = written[-1]
        self._arrays[CHECKSUMS][block : block + 1] = _checksum(written)
        bits = np.arange(self._arrays[DONE].shape[1], dtype=np.uint32)
        counts = [int(((validity_warnings >> bit) & 1).sum()) for bit in bits]
        self._arrays[DONE][block : block + 1] = np.array([counts])

    def _read(self, block: int) -> Iterator[np.ndarray]:
        """Yield the stored arrays of the block with the number `block`, in the order in which `_write` wrote them."""
        for path, place in self._places(block).items():
            values = self._arrays[path][place]
            if path.startswith(COUNTS):  # occupied bins come first; the empty rest was not written
                values = values[..., : max(1, np.count_nonzero(values[0, 0].any(axis=0)))]
            yield values

    def _places(self, block: int) -> dict[str, tuple]:
        """Return the index at which the values of a block are stored in each array, by path of the array."""
        if self.plan.sweep.statistics:
            parts = [PARTS, COUNTS] if percentiles(self.plan) else [PARTS]
            return {f"{part}/{name}": (slice(block, block + 1),) for part in parts for name in self._results}
        region = self.plan.region(block)
        places = {name: tuple(region.get(dim, slice(None)) for dim in dims) for name, dims in self._results.items()}
        places[WARNINGS] = (*region.values(), *(slice(None) for _ in self._points))
        return places | ({one.name: (region[SAMPLE],) for one in self.plan.swept.values()} if SAMPLE in region else {})

    def _drawn(self, block: int) -> dict[str, np.ndarray]:
        """Return the array parameters of a block of listed or sampled contacts, in SI units by name; otherwise {}."""
        region = self.plan.region(block)
        if SAMPLE not in region:
            return {}
        drawn = self.plan.arrays(region)
        return {one.name: drawn[path].values for path, one in self.plan.swept.items()}

    def _statistics(self, results: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Return statistics over the contacts of a block by path of the stored array.

        results: results of the contacts by name. If percentiles are requested, histograms are included.
        """
        contacts = len(self.plan.dims)
        values = {f"{PARTS}/{name}": statistics_of(table, contacts)[None] for name, table in results.items()}
        if percentiles(self.plan):
            for name, table in results.items():
                rows = table.reshape(math.prod(table.shape[:contacts]), -1)
                values[f"{COUNTS}/{name}"] = histogram(rows)[None]
        return values

    def finish(self) -> None:
        """Complete a store whose blocks are all done: merge their statistics, if requested, and delete partial files."""
        assert not self.left(), "blocks that nobody has done"
        for name in self._results if self.plan.sweep.statistics else ():
            whole = merged(_each_row(self.group[PARTS][name]))
            wanted = percentiles(self.plan)
            if wanted:
                counts = self.group[COUNTS][name]
                found = quantiles_of(_each_counts(counts), counts.shape[2], wanted.values())
                whole |= dict(zip(wanted, found, strict=True))
            target = self.group[name]
            rows = np.array([whole[one] for one in self.plan.sweep.statistics])
            target[:] = rows.reshape(target.shape).astype(target.dtype)
        for file in Path(self.path).rglob("*.partial"):  # left by processes that were killed while they wrote
            file.unlink(missing_ok=True)

    def validity_warnings(self) -> dict[str, int]:
        """Return the number of points with each validity warning or reason for a missing result, by its text.

        A point is a contact at a load or separation. Only finished blocks are counted. Texts without points are omitted.
        """
        counts = np.zeros(self.group[DONE].shape[1], dtype=np.int64)
        for row in _each_row(self.group[DONE]):
            counts += np.where(row == NOT_DONE, 0, row)
        return {text: int(count) for text, count in zip(self.group[DONE].attrs["meanings"], counts, strict=True) if count}


def _checksum(tables: Iterable[np.ndarray]) -> int:
    """Return the CRC-32 checksum of the bytes of several arrays, one after the other."""
    total = 0
    for table in tables:
        total = crc32(np.ascontiguousarray(table).tobytes(), total)
    return total


def percentiles(plan: Plan) -> dict[str, float]:
    """Return the quantile level, 0 to 1, of each percentile among the requested statistics of a sweep, by name."""
    return {name: PERCENTILES[name] for name in plan.sweep.statistics if name in PERCENTILES}


def _each_row(array: Any) -> Iterator[np.ndarray]:
    """Yield the row of each block from a stored array, reading many rows at a time."""
    step = max(1, _ROWS_AT_ONCE // max(1, math.prod(array.shape[1:])))
    for start in range(0, array.shape[0], step):
        yield from array[start : start + step]


def _each_counts(array: Any) -> Iterator[np.ndarray]:
    """Yield the stored histogram of each block, or parts of it one after the other if it has more bins than a chunk.

    The arrays are (2, points, bins), as `histogram` returns them, cut along the bins. Chunks beyond the last occupied bin are
    skipped.
    """
    wide = array.chunks[-1]
    step = max(1, _ROWS_AT_ONCE // math.prod(array.chunks))
    for start in range(0, array.shape[0], step):
        for first in range(0, array.shape[-1], wide):
            parts = array[start : start + step, :, :, first : first + wide]
            yield from parts
            if not parts[..., -1].any():  # occupied bins come first: all further chunks are empty
                break


def open_store(path: str | Path) -> "xarray.Dataset":
    """Open the results of a sweep at a path as a dataset; values are read from disk when used."""
    import xarray

    return xarray.open_zarr(path, consolidated=False, chunks=None)
