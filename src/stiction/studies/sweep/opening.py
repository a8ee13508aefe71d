"""Open the store of a sweep, or create it if there is none yet.

A store is a folder on disk with the results of a sweep, block by block.
"""

import json
import math
import shutil
from collections.abc import Mapping
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from typing import Any
from uuid import uuid4
from zlib import crc32

import numpy as np

from stiction import __version__
from stiction.quantities.errors import InputError, InWords, nearest
from stiction.quantities.paths import require_place
from stiction.solving.choice import RECOMMENDED, Choice
from stiction.solving.pointwise import NOT_COMPUTED, REASONS, meanings_of, pieces
from stiction.studies.prediction.many import count_of
from stiction.studies.prediction.predict import is_predicted
from stiction.studies.sweep.blocks import solved_of
from stiction.studies.sweep.maps import PLACE
from stiction.studies.sweep.plan import SAMPLE, Plan
from stiction.studies.sweep.store import CHECKSUMS, COUNTS, DONE, NOT_DONE, PARTS, WARNINGS, Store, percentiles

_LAWS = ("title", "model", "asperity", "tangential", "film", "options", "heights", "grade", "sources", "friction_law")
_PACKAGES = ("numpy", "scipy", "numba", "xarray", "zarr")
_MOST_RULES = 31 - len(REASONS)
_COORDINATE_CHECKSUMS = "coordinate_checksums"
_SIZES = 2048  # histogram bins of a point in one file; few results occupy more bins


def opened_store(path: Path, plan: Plan, title: str, text: str) -> Store:
    """Return the store at a path for a sweep plan; it is created if the folder is new or empty.

    title, text: title and text of the case file, which a new store contains. Raises InputError if the path holds something
    else, a damaged store, or the store of another case or another version of the program.
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
    """Raise InputError if a store is damaged.

    It is damaged if an array is absent, the list of finished blocks cannot be read, or a coordinate was changed. Arrays of
    results are not looked for if the sweep stores statistics.
    """
    try:
        absent = ({DONE, CHECKSUMS} | (set() if store.plan.sweep.statistics else set(store._results))) - store._arrays.keys()
        store.left()
        written = json.loads(store.group.attrs[_COORDINATE_CHECKSUMS])
        whole = not absent and all(_checksum(store._arrays[name][...]) == total for name, total in written.items())
    except Exception:  # zarr raises many kinds of errors for damaged files
        whole = False
    if not whole:
        allowed = "an undamaged store: files of this one were changed or deleted; delete it and run the sweep again"
        raise InputError("--out", str(path), allowed)


def _checksum(coordinate: np.ndarray) -> int:
    """Return the CRC-32 checksum of a coordinate, an array of numbers or texts."""
    return crc32(repr(np.asarray(coordinate).tolist()).encode())


def _attributes(store: Store, path: Path) -> Mapping[str, Any]:
    wanted = "a folder for the store, new, or of this case; this is not a store of a sweep"
    try:
        attributes = dict(store.group.attrs)
    except Exception:  # zarr raises many kinds of errors for folders that are not a store
        raise InputError("--out", str(path), wanted) from None
    if "identity" not in attributes:
        raise InputError("--out", str(path), wanted)
    return attributes


def _difference(one: Any, other: Any, path: str = "") -> str:
    """Return the dotted key at which two nested tables first differ; `path` if they are equal.

    path: dotted key of both tables themselves, "" for the outermost ones.
    """
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        for key in [*one, *(key for key in other if key not in one)]:
            if one.get(key) != other.get(key):
                return _difference(one.get(key), other.get(key), f"{path}.{key}" if path else key)
    return path


def create(path: Path, plan: Plan, title: str, text: str) -> None:
    """Create an empty store for a sweep plan at a path.

    title, text: title and text of the case file. The store is written to a neighbouring folder and moved to the path at the
    end. If another process has created the store meanwhile, that store is kept. Raises InputError if `keep` names an unknown
    result, the model has too many validity ranges, or the path cannot be written. Raises the error of `_first` if the first
    contacts cannot be solved.
    """
    choice, first = _first(plan)
    beside = path.resolve().parent / f".{path.resolve().name}.{uuid4().hex}.begun"
    try:
        beside.parent.mkdir(parents=True, exist_ok=True)
        _fill(beside, plan, first, {"case": title, "case_file": text, "choice": json.dumps(vars(choice), default=dict)})
        if path.exists():
            path.rmdir()
        beside.rename(path)
    except OSError as error:
        shutil.rmtree(beside, ignore_errors=True)
        if path.is_dir() and any(path.iterdir()):
            return
        raise InputError("--out", str(path), f"a folder that can be written ({error.strerror or error})") from None


def _first(plan: Plan) -> tuple[Choice, Any]:
    """Return the model of a sweep, and (case, results) of the first of its contacts that can be solved.

    Raises the last error, InputError or ArithmeticError, if the first five contacts of each of the first three blocks are
    refused.
    """
    from stiction.studies.case_results import choice_of_case

    refused: Exception = InputError("contact", None, "contacts that the model can solve")
    for block in range(min(plan.blocks, 3)):
        for one in islice(pieces(plan.region(block), 1), 5):
            try:
                case = plan.case_at(one).at(plan.arrays(one))
                choice = Choice(RECOMMENDED) if is_predicted(case) else choice_of_case(case, case.choice)
                if choice.model == RECOMMENDED and case.load is None:
                    raise InputError(
                        "solve.separation", InWords("given"), "a load; for separations, name a model as solve.model"
                    )
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
    names = [name for name in plan.sweep.keep or names if name not in dims]  # loads or separations are stored as coordinates
    points = {dim: size for dim, size in zip(dims, bits.shape, strict=True) if dim not in plan.dims}
    points |= {"load": case.load.size} if "load" in points else {}
    layout = {name: tuple(dim for dim in (*plan.dims, *points) if dim in solved.variables[name][0]) for name in names}
    if len(solved.rules) > _MOST_RULES:
        raise InputError(
            "model",
            case.choice.model_key,
            f"a model with at most {_MOST_RULES} ranges of validity, because a sweep stores one bit for each",
        )
    group = zarr.create_group(str(path), zarr_format=3)
    laws: dict[str, Any] = {"model": RECOMMENDED, "draws": count_of(plan.case, plan.size)}
    if "options" in solved.attributes:
        laws = {name: solved.attributes[name] for name in (*_LAWS, *solved.attributes["options"].split())}
    more = {"results": json.dumps(layout), "points": json.dumps(points), "identity": plan.identity()}
    versions = {name: version(name) for name in _PACKAGES}
    group.attrs.update(
        laws
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
    own = [one.name for one in plan.swept.values() if one.name != one.dimension or one.name not in coordinates]
    group.attrs[_COORDINATE_CHECKSUMS] = json.dumps({name: _checksum(values) for name, (_, values, _) in coordinates.items()})
    group.attrs["coordinates"] = " ".join(() if plan.sweep.statistics else own)
    meanings = meanings_of(solved.rules)
    done = group.create_array(
        DONE, shape=(plan.blocks, len(meanings)), chunks=(1, len(meanings)), dtype="int64", fill_value=NOT_DONE,
        dimension_names=("block", "rule"),
    )  # fmt: skip
    sums = group.create_array(
        CHECKSUMS, shape=(plan.blocks,), chunks=(1,), dtype="uint32", fill_value=0, dimension_names=("block",)
    )
    sums.attrs["long_name"] = "CRC-32 checksum of each block"
    done.attrs.update({"long_name": "number of points of each block outside each validity range", "meanings": meanings})


def _of_sample(plan: Plan) -> dict[str, Any]:
    sample = plan.sweep.sample
    return {"sample": sample.method} | ({"seed": sample.seed} if sample.count is not None else {})


def _arrays(group: Any, plan: Plan, layout: Mapping[str, tuple], sizes: Mapping[str, int], solved: Any) -> None:
    """Create the stored arrays of results and validity warnings, with one chunk for each block.

    group: the zarr group of the store. layout: dimensions of each result, by name. sizes: lengths of all dimensions. solved:
    results of the first contact, which give names, units and warnings.
    """
    for name, dims in [*layout.items(), (WARNINGS, tuple(sizes))]:
        validity_warnings = name == WARNINGS
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
    """Create the stored arrays of statistics over all contacts, and of the block statistics that are merged into them.

    group: the zarr group of the store. layout: dimensions of each result, by name. points: length of each dimension (loads or
    separations), by name. solved: results of the first contact, for units and names.
    """
    parts = group.create_group(PARTS)
    kinds = plan.sweep.statistics
    for name, dims in layout.items():
        rest = [dim for dim in dims if dim in points]
        shape = [points[dim] for dim in rest]
        flat = int(np.prod(shape, dtype=int))
        parts.create_array(name, shape=(plan.blocks, 5, flat), chunks=(1, 5, flat), dtype="float64", fill_value=float("nan"))
        if percentiles(plan):
            contacts = math.prod(plan.tile[dim] for dim in dims if dim in plan.dims)
            group.require_group(COUNTS).create_array(
                name, shape=(plan.blocks, 2, flat, contacts), chunks=(1, 2, flat, min(contacts, _SIZES)), dtype="uint32",
                fill_value=0,
            )  # fmt: skip
        array = group.create_array(
            name, shape=[len(kinds), *shape], chunks=[len(kinds), *shape], dtype=plan.sweep.precision, fill_value=float("nan"),
            dimension_names=("statistic", *rest),
        )  # fmt: skip
        array.attrs.update(solved.variables[name][2])


def _coordinates(group: Any, plan: Plan, case: Any, points: Mapping[str, int]) -> dict[str, tuple]:
    """Return the coordinates of the dimensions of a store, as (dimension, values, attributes) by name.

    group: the zarr group of the store. points: dimension (loads or separations) -> its length. For listed or sampled contacts,
    the values of array parameters are written later, with each block; their empty arrays are created here. If the sweep stores
    statistics, contacts have no coordinates.
    """
    found: dict[str, tuple] = {}
    if plan.sweep.statistics:
        found["statistic"] = ("statistic", np.array(plan.sweep.statistics, dtype=object), {"long_name": "over all contacts"})
    if plan.maps and not plan.sweep.statistics:
        found[PLACE] = (PLACE, np.array([one.name for one in plan.maps], dtype=object), {"long_name": "map"})
    for one in () if plan.sweep.statistics else plan.swept.values():
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
