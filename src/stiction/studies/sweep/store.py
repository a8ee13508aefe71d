"""The store of a sweep: chunked, labelled, zarr 3; opened again by xarray.open_zarr.

Every block is a chunk of each array, written on its own; the last that is written of a block is its row of
`validity_warnings_by_block`, which says that it is done. A file is either there or not (zarr moves it into place), and the same
bits follow from the same case: what was interrupted is written again as it would have been.
"""

import json
import math
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from stiction import __version__
from stiction.engine.tiers import all_compiled
from stiction.quantities.errors import InputError, nearest
from stiction.quantities.paths import require_place
from stiction.quantities.uninterrupted import uninterrupted
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.pointwise import NOT_COMPUTED, WHY_NOT, meanings_of, pieces
from stiction.studies.prediction.many import count_of
from stiction.studies.prediction.predict import is_predicted
from stiction.studies.sweep.blocks import merged, solve_block, solved_of, statistics_of
from stiction.studies.sweep.maps import PLACE
from stiction.studies.sweep.plan import SAMPLE, Plan
from stiction.studies.sweep.quantile_counts import PERCENTILES, counted, quantiles_of

if TYPE_CHECKING:
    import xarray

_DONE, _WARNINGS, _PARTS, _COUNTS = "validity_warnings_by_block", "validity_warnings", "statistics_by_block", "counts_by_block"
_NOTHING = -1  # of a block that is not done
_LAWS = ("title", "model", "asperity", "tangential", "film", "options", "heights", "grade", "sources", "friction_law")
_PACKAGES = ("numpy", "scipy", "numba", "xarray", "zarr")
_MOST_RULES = 31 - len(WHY_NOT)
_ROWS_AT_ONCE = 1_000_000  # numbers of blocks that are read together
_SIZES = 2048  # of a point that one file holds; few results have more


@dataclass(frozen=True)
class Store:
    """A store of a plan, by its path: any process may open it and do some of its blocks."""

    path: str
    plan: Plan

    @cached_property
    def group(self) -> Any:
        import zarr

        return zarr.open_group(self.path, mode="r+", zarr_format=3, use_consolidated=False)

    @cached_property
    def _arrays(self) -> dict[str, Any]:
        """All arrays by their paths, each opened once: it takes reading a file."""
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
        """Return the blocks that are not done, in order."""
        done = self.group[_DONE][:, 0]
        return np.flatnonzero(done == _NOTHING).tolist()

    def do(self, block: int) -> int:
        """Solve and store a block; returns how many points it has. Raises OSError where it cannot be written."""
        with all_compiled():
            results, validity_warnings = solve_block(self.plan, self._choice, block, self._results, self._points)
        with uninterrupted():
            self._write(block, results, validity_warnings)
        return validity_warnings.size

    def _write(self, block: int, results: Mapping[str, np.ndarray], validity_warnings: np.ndarray) -> None:
        if self.plan.sweep.statistics:
            self._write_statistics(block, results)
        else:
            self._write_points(block, results, validity_warnings)
        bits = np.arange(self._arrays[_DONE].shape[1], dtype=np.uint32)
        counts = [int(((validity_warnings >> bit) & 1).sum()) for bit in bits]
        self._arrays[_DONE][block : block + 1] = np.array([counts])

    def _write_points(self, block: int, results: Mapping[str, np.ndarray], validity_warnings: np.ndarray) -> None:
        region = self.plan.region(block)
        for name, values in results.items():
            place = tuple(region.get(dim, slice(None)) for dim in self._results[name])
            self._arrays[name][place] = values.astype(self._arrays[name].dtype)
        place = (*region.values(), *(slice(None) for _ in self._points))
        self._arrays[_WARNINGS][place] = validity_warnings
        if SAMPLE in region:
            drawn = self.plan.arrays(region)
            for path, one in self.plan.several.items():
                self._arrays[one.name][region[SAMPLE]] = drawn[path].values

    def _write_statistics(self, block: int, results: Mapping[str, np.ndarray]) -> None:
        contacts = len(self.plan.dims)
        for name, values in results.items():
            self._arrays[f"{_PARTS}/{name}"][block : block + 1] = statistics_of(values, contacts)[None]
            if _percentiles(self.plan):
                rows = values.reshape(math.prod(values.shape[:contacts]), -1)
                counts = counted(rows)
                self._arrays[f"{_COUNTS}/{name}"][block : block + 1, :, :, : counts.shape[-1]] = counts[None]

    def finish(self) -> None:
        """When all blocks are done: the statistics of all together, and no file that an interruption left."""
        assert not self.left(), "blocks that nobody has done"
        for name in self._results if self.plan.sweep.statistics else ():
            whole = merged(_each_row(self.group[_PARTS][name]))
            wanted = _percentiles(self.plan)
            if wanted:
                counts = self.group[_COUNTS][name]
                found = quantiles_of(_each_counts(counts), counts.shape[2], wanted.values())
                whole |= dict(zip(wanted, found, strict=True))
            target = self.group[name]
            rows = np.array([whole[one] for one in self.plan.sweep.statistics])
            target[:] = rows.reshape(target.shape).astype(target.dtype)
        for file in Path(self.path).rglob("*.partial"):  # which a process that was killed had begun to write
            file.unlink(missing_ok=True)

    def validity_warnings(self) -> dict[str, int]:
        """At how many points each rule is left, of the blocks that are done; those that are nowhere left out."""
        counts = np.zeros(self.group[_DONE].shape[1], dtype=np.int64)
        for row in _each_row(self.group[_DONE]):
            counts += np.where(row == _NOTHING, 0, row)
        return {text: int(count) for text, count in zip(self.group[_DONE].attrs["meanings"], counts, strict=True) if count}


def _percentiles(plan: Plan) -> dict[str, float]:
    """Return the requested percentiles with their shares."""
    return {name: PERCENTILES[name] for name in plan.sweep.statistics if name in PERCENTILES}


def _each_row(array: Any) -> Iterator[np.ndarray]:
    """Yield the row of each block, reading few blocks at a time."""
    step = max(1, _ROWS_AT_ONCE // max(1, math.prod(array.shape[1:])))
    for start in range(0, array.shape[0], step):
        yield from array[start : start + step]


def _each_counts(array: Any) -> Iterator[np.ndarray]:
    """Yield the stored counts of each block in chunks; chunks beyond the last occupied bin are skipped."""
    wide = array.chunks[-1]
    step = max(1, _ROWS_AT_ONCE // math.prod(array.chunks))
    for start in range(0, array.shape[0], step):
        for first in range(0, array.shape[-1], wide):
            parts = array[start : start + step, :, :, first : first + wide]
            yield from parts
            if not parts[..., -1].any():  # sizes stand in front: none is after these
                break


def opened_store(path: Path, plan: Plan, title: str, text: str) -> Store:
    """Open the store at a path; create it if there is none.

    Raises InputError where the path holds something else, or the store of another case.
    """
    require_place(path, "a folder for the store, new, or of this case")
    if path.is_file():
        raise InputError("--out", str(path), "a folder for the store, new, or of this case; this is a file")
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        create(path, plan, title, text)
    store = Store(str(path), plan)
    attributes = _attributes(store, path)
    if attributes.get("program") != f"stiction {__version__}":
        raise InputError("--out", str(path), f"a new store: this one was begun by {attributes.get('program')}")
    if attributes["identity"] != plan.identity():
        where = _difference(json.loads(attributes["identity"]), json.loads(plan.identity()))
        raise InputError("--out", str(path), f"a new store, or the store of this case; {where} differs")
    _check_whole(store, path)
    return store


def _check_whole(store: Store, path: Path) -> None:
    """Raise InputError if an array of the store is absent, or its description or its list of blocks cannot be read."""
    try:
        absent = ({_DONE} | (set() if store.plan.sweep.statistics else set(store._results))) - store._arrays.keys()
        store.left()
    except Exception:  # zarr raises many kinds of errors for damaged files
        absent = {"a readable array"}
    if absent:
        allowed = "an undamaged store: files of this one were changed or deleted; delete it and run the sweep again"
        raise InputError("--out", str(path), allowed)


def _attributes(store: Store, path: Path) -> Mapping[str, Any]:
    wanted = "a folder for the store, new, or of this case; this is no store of a sweep"
    try:
        attributes = dict(store.group.attrs)
    except Exception:  # of what is no store, zarr raises many things
        raise InputError("--out", str(path), wanted) from None
    if "identity" not in attributes:
        raise InputError("--out", str(path), wanted)
    return attributes


def _difference(one: Any, other: Any, path: str = "") -> str:
    """Return the address of the first difference of two trees of tables."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        for key in [*one, *(key for key in other if key not in one)]:
            if one.get(key) != other.get(key):
                return _difference(one.get(key), other.get(key), f"{path}.{key}" if path else key)
    return path


def create(path: Path, plan: Plan, title: str, text: str) -> None:
    """Make an empty store, in one move. Raises InputError for what no contact of the sweep takes, or where it cannot be."""
    choice, first = _first(plan)
    beside = path.resolve().parent / f".{path.resolve().name}.begun"
    try:
        shutil.rmtree(beside, ignore_errors=True)
        beside.parent.mkdir(parents=True, exist_ok=True)
        _fill(beside, plan, first, {"case": title, "case_file": text, "choice": json.dumps(vars(choice), default=dict)})
        if path.exists():
            path.rmdir()
        beside.rename(path)
    except OSError as error:
        shutil.rmtree(beside, ignore_errors=True)
        raise InputError("--out", str(path), f"a place that can be written ({error.strerror or error})") from None


def _first(plan: Plan) -> tuple[Choice, Any]:
    """Return the choice, and case and results of the first contact that is not refused."""
    from stiction.studies.case_results import choice_of_case

    refused: Exception = InputError("contact", None, "contacts that the model can solve")
    for block in range(min(plan.blocks, 3)):
        for one in islice(pieces(plan.region(block), 1), 5):
            try:
                case = plan.case_at(one).at(plan.arrays(one))
                choice = Choice(RECOMMENDED) if is_predicted(case) else choice_of_case(case, case.choice)
                if choice.model == RECOMMENDED and case.load is None:
                    raise InputError("solve.separation", "given", "load, or a named model, which accepts separations")
                for _, solved in solved_of(plan, choice, one, None):  # a prediction may be refused at some of the loads
                    if solved is not None:
                        return choice, (case, solved)
            except (InputError, ArithmeticError) as error:
                refused = error
    raise refused


def _fill(path: Path, plan: Plan, first: Any, attributes: Mapping[str, str]) -> None:
    import xarray
    import zarr

    case, solved = first
    names = list(solved.variables)
    for name in plan.sweep.keep:
        if name not in names:
            raise InputError("sweep.keep", name, nearest(name, names))
    dims, bits = solved.validity_warnings
    names = [name for name in plan.sweep.keep or names if name not in dims]  # what is asked for is a coordinate
    points = {dim: size for dim, size in zip(dims, bits.shape, strict=True) if dim not in plan.dims}
    points |= {"load": case.load.size} if "load" in points else {}
    layout = {name: tuple(dim for dim in (*plan.dims, *points) if dim in solved.variables[name][0]) for name in names}
    if len(solved.rules) > _MOST_RULES:
        raise InputError("model", case.choice.model_key, f"at most {_MOST_RULES} validity ranges in a sweep")
    group = zarr.create_group(str(path), zarr_format=3)
    said: dict[str, Any] = {"model": RECOMMENDED, "draws": count_of(plan.size)}
    if solved.attributes:
        said = {name: solved.attributes[name] for name in (*_LAWS, *solved.attributes["options"].split())}
    more = {"results": json.dumps(layout), "points": json.dumps(points), "identity": plan.identity()}
    versions = {name: version(name) for name in _PACKAGES}
    group.attrs.update(
        said
        | dict(attributes)
        | more
        | dict(plan.scans)
        | _of_sample(plan)
        | {"program": f"stiction {__version__}", "versions": versions}
    )
    if plan.sweep.statistics:
        _statistics(group, plan, layout, points, solved)
    else:
        _arrays(group, plan, layout, dict(plan.dims) | points, solved)
    coordinates = _coordinates(group, plan, case, points)
    xarray.Dataset(coords=coordinates).to_zarr(path, mode="a", consolidated=False, zarr_format=3)
    own = [one.name for one in plan.several.values() if one.name != one.dimension or one.name not in coordinates]
    group.attrs["coordinates"] = " ".join(() if plan.sweep.statistics else own)
    meanings = meanings_of(solved.rules)
    done = group.create_array(
        _DONE, shape=(plan.blocks, len(meanings)), chunks=(1, len(meanings)), dtype="int64", fill_value=_NOTHING,
        dimension_names=("block", "rule"),
    )  # fmt: skip
    done.attrs.update({"long_name": "points of a block at which a rule is left", "meanings": meanings})


def _of_sample(plan: Plan) -> dict[str, Any]:
    sample = plan.sweep.sample
    return {"sample": sample.method} | ({"seed": sample.seed} if sample.count is not None else {})


def _arrays(group: Any, plan: Plan, layout: Mapping[str, tuple], sizes: Mapping[str, int], solved: Any) -> None:
    """Create the arrays of results and validity warnings, chunked as the blocks."""
    for name, dims in [*layout.items(), (_WARNINGS, tuple(sizes))]:
        validity_warnings = name == _WARNINGS
        array = group.create_array(
            name,
            shape=[sizes[dim] for dim in dims],
            chunks=[plan.tile.get(dim, sizes[dim]) for dim in dims],
            dtype="uint32" if validity_warnings else plan.sweep.precision,
            fill_value=int(NOT_COMPUTED) if validity_warnings else float("nan"),
            dimension_names=dims,
        )
        array.attrs.update(_warning_attributes(meanings_of(solved.rules)) if validity_warnings else solved.variables[name][2])


def _warning_attributes(meanings: list[str]) -> dict[str, Any]:
    return {
        "long_name": "validity warnings",
        "comment": "bits, by flag_masks and flag_meanings",
        "flag_masks": [1 << bit for bit in range(len(meanings))] + [int(NOT_COMPUTED)],
        "flag_meanings": [*meanings, "not computed yet"],
    }


def _statistics(group: Any, plan: Plan, layout: Mapping[str, tuple], points: Mapping[str, int], solved: Any) -> None:
    """Create the arrays of statistics, and of the parts from which they are merged."""
    parts = group.create_group(_PARTS)
    kinds = plan.sweep.statistics
    for name, dims in layout.items():
        rest = [dim for dim in dims if dim in points]
        shape = [points[dim] for dim in rest]
        flat = int(np.prod(shape, dtype=int))
        parts.create_array(name, shape=(plan.blocks, 5, flat), chunks=(1, 5, flat), dtype="float64", fill_value=float("nan"))
        if _percentiles(plan):
            contacts = math.prod(plan.tile[dim] for dim in dims if dim in plan.dims)
            group.require_group(_COUNTS).create_array(
                name, shape=(plan.blocks, 2, flat, contacts), chunks=(1, 2, flat, min(contacts, _SIZES)), dtype="uint32",
                fill_value=0,
            )  # fmt: skip
        array = group.create_array(
            name, shape=[len(kinds), *shape], chunks=[len(kinds), *shape], dtype=plan.sweep.precision, fill_value=float("nan"),
            dimension_names=("statistic", *rest),
        )  # fmt: skip
        array.attrs.update(solved.variables[name][2])


def _coordinates(group: Any, plan: Plan, case: Any, points: Mapping[str, int]) -> dict[str, tuple]:
    """Return the coordinates of the dimensions: name -> dimension, values, attributes.

    Numbers of listed or drawn contacts are written with their block instead.
    """
    found: dict[str, tuple] = {}
    if plan.sweep.statistics:
        found["statistic"] = ("statistic", np.array(plan.sweep.statistics, dtype=object), {"long_name": "over all contacts"})
    if plan.maps and not plan.sweep.statistics:
        found[PLACE] = (PLACE, np.array([one.name for one in plan.maps], dtype=object), {"long_name": "map"})
    for one in () if plan.sweep.statistics else plan.several.values():
        attributes = one.array(one.values[:1])[one.name].attrs
        if plan.sweep.sample.method == "grid":
            found[one.name] = (one.dimension, one.numbers(), attributes)
        else:
            array = group.create_array(
                one.name, shape=(plan.dims[SAMPLE],), chunks=(plan.tile[SAMPLE],), dtype="float64", fill_value=float("nan"),
                dimension_names=(SAMPLE,),
            )  # fmt: skip
            array.attrs.update(attributes)
    for dim in points:
        values = case.load if dim == "load" else case.separation if dim == "mean_separation" else case.separation[dim].values
        attributes = case.separation[dim].attrs if dim == "separation" else case.subject.attributes(dim)
        found[dim] = (dim, np.asarray(values), attributes)
    return found


def open_store(path: str | Path) -> "xarray.Dataset":
    """Open the results of a sweep as a dataset that is read as it is used."""
    import xarray

    return xarray.open_zarr(path, consolidated=False, chunks=None)
