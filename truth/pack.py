"""Packs what was solved and what models say of it into the one small file that the package reads.

python truth/pack.py [FOLDER [FILE]]
"""

import json
import lzma
import math
import sys
from pathlib import Path

import numpy as np

import surfaces as design
from solve import WORK
from stiction.solving.accuracy.benchmark_set import FEATURES, FILE, PACKED, coded

HERE = Path(__file__).parent
HARDNESSES = (math.inf, *design.HARDNESSES)


def table(rows: dict[str, list], loads: int, count: int) -> np.ndarray:
    """(rows, loads), not a number where there is none; rows: key -> values."""
    found = np.full((count, loads), np.nan)
    for at, values in rows.items():
        found[at, : len(values)] = [math.nan if value is None else value for value in values]
    return found


def solved_areas(record: dict) -> np.ndarray:
    """(hardnesses, loads) of a surface."""
    found = np.full((len(HARDNESSES), len(design.LOADS)), np.nan)
    found[0] = record["elastic"]["area"]
    for hardness, one in record["plastic"].items():
        found[HARDNESSES.index(float(hardness)), : len(one["area"])] = one["area"]
    return found


def said_areas(record: dict, rows: list) -> np.ndarray:
    """The same of a model, at the loads that were solved."""
    found = np.full((len(HARDNESSES), len(design.LOADS)), np.nan)
    solved = [("inf", record["elastic"]), *record["plastic"].items()]
    for (hardness, one), row in zip(solved, rows, strict=True):
        count = len(one["area"])
        found[HARDNESSES.index(float(hardness)), :count] = [math.nan if value is None else value for value in row[:count]]
    return found


def features(record: dict) -> list[float]:
    """In the order of FEATURES."""
    slope = 0.5 * record["gradient"] ** 2
    record = record | {"wave": record["deviation"] / math.sqrt(record["alpha"] * slope)}
    return [record[name] for name in FEATURES]


def unique(columns: dict[str, np.ndarray]) -> tuple[list[str], list[int], np.ndarray]:
    """Names, which of the tables each has, and the tables: models that say the same share one."""
    names, which, kept = sorted(columns), [], []
    for name in names:
        code = coded(columns[name])
        at = next((at for at, one in enumerate(kept) if _alike(one, code)), None)
        if at is None:
            at = len(kept)
            kept.append(code)
        which.append(at)
    return names, which, np.array(kept)


def _alike(one: np.ndarray, other: np.ndarray) -> bool:
    return bool(((one == -128) == (other == -128)).all()) and int(np.abs(one.astype(int) - other).max()) <= 1


def main(folder: Path, file: Path) -> None:
    every = design.surfaces()
    records = [json.loads((folder / f"{one.name}.json").read_text()) for one in every]
    models = [json.loads((folder / f"{one.name}.models").read_text()) for one in every]
    areas = np.array([solved_areas(one) for one in records])
    bare = sorted({name for one in models for name in one["bare"]})
    nothing = np.full(areas.shape[1:], np.nan)
    columns = {}
    for name in bare:
        said = [
            said_areas(one, said["bare"][name]) if name in said["bare"] else nothing
            for one, said in zip(records, models, strict=True)
        ]
        with np.errstate(divide="ignore", invalid="ignore"):
            columns[name] = np.log(np.array(said) / areas)
    names, which, tables = unique(columns)
    films = [[one["modulus"], one["thickness"]] for one in next(one["films"] for one in records if one["films"])]
    coated = [at for at, one in enumerate(records) if one["films"]]
    film_names, film_which, film_tables = unique(_on_films(records, models, coated))
    content = {
        "surfaces": np.array([one.name for one in every]), "kinds": np.array([one.kind for one in every]),
        "held_out": np.array([one.held_out for one in every]),
        "features": np.array([features(one) for one in records], np.float32),
        "hardnesses": np.array(HARDNESSES), "loads": np.array(design.LOADS),
        "areas": np.round(np.nan_to_num(-5e3 * np.log(areas), nan=65535.0)).astype(np.uint16),
        "columns": np.array(names), "which": np.array(which, np.uint8), "errors": _steps(tables),
        "film_surfaces": np.array(coated, np.int16), "films": np.array(films),
        "film_loads": np.array([[one["pressure"] for one in records[at]["films"]] for at in coated], np.float32),
        "film_areas": np.array([[one["area"] for one in records[at]["films"]] for at in coated], np.float32),
        "film_columns": np.array(film_names), "film_which": np.array(film_which, np.uint8), "film_errors": _steps(film_tables),
        "gradient_over_shortest": np.array([one["shortest"] for one in records], np.float32),
        "standing": np.array([one["standing"] for one in models]),
    }  # fmt: skip
    for name in PACKED:
        content[f"{name}_shape"] = np.array(content[name].shape)
        packed = lzma.compress(content[name].tobytes(), preset=9 | lzma.PRESET_EXTREME)
        content[name] = np.frombuffer(packed, np.uint8)
    np.savez_compressed(file, **content)
    print(f"{file}: {file.stat().st_size} bytes, {len(every)} surfaces, {len(names)} columns, {len(tables)} different")


def _on_films(records, models, coated) -> dict[str, np.ndarray]:
    names = sorted({name for at in coated for film in models[at]["films"] for name in film})
    areas = np.array([[film["area"] for film in records[at]["films"]] for at in coated])
    found = {}
    for name in names:
        said = np.full(areas.shape, np.nan)
        for row, at in enumerate(coated):
            for column, film in enumerate(models[at]["films"]):
                if name in film:
                    said[row, column] = [math.nan if value is None else value for value in film[name][0]]
        with np.errstate(divide="ignore", invalid="ignore"):
            found[name] = np.log(said / areas)
    return found


def _steps(tables: np.ndarray) -> np.ndarray:
    """Differences along the loads, which repeat and so pack well; they wrap around, as the sums that undo them do."""
    return np.diff(tables.astype(np.int8), axis=-1, prepend=np.int8(0)).astype(np.int8)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else WORK, Path(sys.argv[2]) if len(sys.argv) > 2 else FILE)
