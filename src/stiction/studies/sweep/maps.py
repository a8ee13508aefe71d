"""Describe sweeps over measured or generated height maps: each map is the roughness of one contact.

The list `roughness` of the table [sweep] has scan files, files cut into patches, and random maps of a spectrum. The table
[contact.roughness] then holds the settings that apply to every file: size, unit, form, filters.
"""

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic import Field, create_model

from stiction.quantities.errors import InputError, field_below
from stiction.quantities.inputs import Input
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.measured import MeasuredRoughness, Scan, roughness_of, surface_of
from stiction.surfaces.roughness import Roughness

PLACE = "place"  # name of the dimension along which the maps lie
_MOST_PATCHES, _MOST_REALISATIONS = 64, 1_000_000
_PREPARED = {name: one for name, one in MeasuredRoughness.model_fields.items() if name not in ("first", "second")}

# A scan file with the settings of its preparation. patches: number along each side, so that 4 give 16 maps.
_FIELDS: Any = {name: (one.annotation, one) for name, one in _PREPARED.items()}
FileMaps: Any = create_model(
    "FileMaps",
    __base__=Scan,
    patches=(int, Field(1, ge=1, le=_MOST_PATCHES, strict=True, description=f"along each side, 1 to {_MOST_PATCHES}")),
    **_FIELDS,
)


class Realisations(Input):
    """Define periodic random maps with one self-affine spectrum, which differ by their seed.

    hurst: Hurst exponent. rolloff, shortest: wavelengths at which the spectrum levels off and ends, as text with units.
    deviation: standard deviation of the heights. size: side of the square map. Both are text with units. points: number of
    points along a side. realisations: number of maps. seed: seed of the first map. skewness, kurtosis: of the heights, both or
    neither; a Gaussian surface has 0 and 3.
    """

    hurst: float
    rolloff: str
    shortest: str
    deviation: str
    size: str
    points: int = Field(ge=4, strict=True, description="a whole number, 4 or more")
    realisations: int = Field(1, ge=1, le=_MOST_REALISATIONS, strict=True, description=f"1 to {_MOST_REALISATIONS}")
    seed: int = Field(0, ge=0, strict=True, description="a whole number, 0 or more")
    skewness: float | None = None
    kurtosis: float | None = None

    def surface(self, index: int) -> HeightMap:
        """Return the random map with the number `index`; its seed is `seed` + `index`.

        Raises InputError for values that no map can have.
        """
        from stiction.surfaces.generate import gaussian_surface, non_gaussian_surface
        from stiction.surfaces.targets import SelfAffine

        spectrum = SelfAffine(self.hurst, self.rolloff, self.shortest, self.deviation)  # type: ignore[arg-type]  # read there
        grid: Any = ((self.points, self.points), (self.size, self.size), spectrum, self.seed + index)
        if (self.skewness is None) != (self.kurtosis is None):
            raise InputError("skewness", self.skewness, "both skewness and kurtosis, or neither")
        if self.skewness is None or self.kurtosis is None:
            return gaussian_surface(*grid)
        return non_gaussian_surface(*grid, skewness=self.skewness, kurtosis=self.kurtosis)


@dataclass(frozen=True)
class MapOfPlace:
    """Describe one map of a sweep: a scan file, a patch of a scan file, or a random map of a spectrum.

    entry: settings from the list `roughness` of [sweep]. index: number of the patch or random map. folder: folder at which
    relative paths start. content: SHA-256 digest of the file, "" for a random map.
    """

    entry: Any
    index: int
    folder: Path
    content: str = ""

    @property
    def name(self) -> str:
        """Return the name of the map in the results: its file and patch, or its seed."""
        if isinstance(self.entry, Realisations):
            return f"seed {self.entry.seed + self.index}"
        row, column = divmod(self.index, self.entry.patches)
        return self.entry.file if self.entry.patches == 1 else f"{self.entry.file}, row {row + 1}, column {column + 1}"

    def roughness(self) -> Roughness:
        """Return the roughness measured on the map.

        Raises InputError if the map cannot be read or made, or has no asperities.
        """
        with field_below("sweep.roughness"):
            if isinstance(self.entry, Realisations):
                return roughness_of({"first": self.entry.surface(self.index)})
            return roughness_of({"first": self._patch(), **{name: getattr(self.entry, name) for name in _PREPARED}})

    def _patch(self) -> HeightMap:
        whole = _surface(self.entry, self.folder, self.content)
        if self.entry.patches == 1:
            return whole
        count = self.entry.patches
        (rows, columns), (high, wide) = (length // count for length in whole.heights.shape), whole.pitch
        row, column = divmod(self.index, count)
        part = whole.heights[row * rows : (row + 1) * rows, column * columns : (column + 1) * columns]
        step = f"patch of row {row + 1} and column {column + 1}, {count} along each side"
        return whole.with_heights(part.copy(), step, size=(rows * high, columns * wide)).alone()


@lru_cache(maxsize=1)
def _surface(entry: Any, folder: Path, _content: str) -> HeightMap:
    """Return the whole map of a scan file; the map of the last file is cached, because its patches are cut one after another.

    entry: settings of the file. folder: folder at which its path starts. _content: digest of the file, an argument only so that
    a changed file is read again.
    """
    return surface_of(entry, folder, "first")


def maps_of(listed: Sequence[Any], shared: Any, folder: Path) -> tuple[MapOfPlace, ...]:
    """Return a MapOfPlace for each map (file, patch or random map) that the list `roughness` of the table [sweep] describes.

    listed: entries of the list, each a scan file or a spectrum. shared: settings that apply to every entry, or None. folder:
    base folder of relative paths. Raises InputError.
    """
    if not isinstance(shared or {}, Mapping) or (shared or {}).keys() & {"first", "second", "file"}:
        raise InputError("contact.roughness", shared, "settings of all maps, e.g. size, unit; name scans in sweep.roughness")
    for name in sorted((shared or {}).keys() - FileMaps.model_fields.keys() - Realisations.model_fields.keys()):
        allowed = "no value in a sweep over maps, except settings of all maps, e.g. size, unit"
        raise InputError(f"contact.roughness.{name}", shared[name], allowed)
    return tuple(one for entry in listed for one in _of_entry(entry, dict(shared or {}), folder.resolve()))


def _of_entry(entry: Any, shared: dict[str, Any], folder: Path) -> Iterator[MapOfPlace]:
    with field_below("sweep.roughness"):
        if isinstance(entry, str):
            entry = {"file": entry}
        if not isinstance(entry, Mapping) or not entry.keys() & {"file", "hurst"}:
            raise InputError("", entry, "a scan file, a table with file, or a table with hurst and spectrum numbers")
        if "file" not in entry:
            made = Realisations(**{**shared, **entry})
            yield from (MapOfPlace(made, index, folder) for index in range(made.realisations))
            return
        made = FileMaps(**{**shared, **entry})
        try:
            content = hashlib.sha256((folder / made.file).read_bytes()).hexdigest()
        except OSError as error:
            raise InputError("file", made.file, f"a file that can be read ({error.strerror or error})") from None
        yield from (MapOfPlace(made, index, folder, content) for index in range(made.patches**2))
