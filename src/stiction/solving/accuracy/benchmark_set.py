"""Read the benchmark set that `make truth` writes into the package (docs/explanation/truth.md).

The set holds surfaces whose contact was solved, and the errors of models on them. An error is the logarithm of the ratio of a
model's contact area to the solved area. Each error is stored in one byte, as its signed square root in steps of 1/60. The
rounding error is then at most 0.002 at an error of 1 %, and 0.03 at a factor of ten.
"""

import lzma
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import numpy as np

from stiction.surfaces.finishes import shares_of_kinds

FILE = Path(__file__).parent / "benchmark_set.npz"
# Features of each surface: Nayak's alpha; skewness and kurtosis of its heights; root of the ratio of the eigenvalues of the
# gradient tensor; rms gradient of the highest 5 %, divided by the rms gradient of the map; sqrt(m2/m4) [m].
FEATURES = ("alpha", "skewness", "kurtosis", "lay", "top", "wave")
# Kinds of surface in the set, by the kind specified for a contact. A periodic surface is a wave along x with roughness on it.
OF_KIND = {
    "gaussian": ("gaussian",),
    "skewed": ("skewed", "peaked"),
    "worn": ("worn", "flat"),
    "lay": ("lay", "mixed", "periodic"),
    "two-scale": ("bimodal", "periodic"),
}
# Tables that are compressed with LZMA, because a zip file would be larger.
PACKED = ("errors", "film_errors")
_NOTHING, _STEP = -128, 1.0 / 60.0


def coded(errors: np.ndarray) -> np.ndarray:
    """Encode logarithmic errors, limited to -4.5 to 4.5, as bytes (int8) of the same shape; NaN has its own code."""
    whole = np.clip(np.round(np.sign(errors) * np.sqrt(np.abs(errors)) / _STEP), -127, 127)
    return np.where(np.isfinite(errors), whole, _NOTHING).astype(np.int8)


def decoded(codes: np.ndarray) -> np.ndarray:
    """Decode bytes (int8) to logarithmic errors of the same shape, NaN where no error was stored."""
    root = codes * _STEP
    return np.where(codes == _NOTHING, np.nan, np.sign(root) * root**2)


@dataclass(frozen=True)
class BenchmarkSet:
    """Store the benchmark set: surfaces whose contact was solved, and the errors of models on them.

    content: arrays by name, as in the file, for s surfaces, h hardnesses (the first is infinite) and p mean pressures.
    Pressures and hardnesses are divided by E* h', with the contact modulus E* and the rms slope h'. Films are listed by
    plane-strain modulus divided by the substrate modulus, and by thickness divided by the shortest wavelength.
    """

    content: dict[str, np.ndarray]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.content[name]

    def feature(self, name: str) -> np.ndarray:
        """Return the values (s,) of one feature of all surfaces; name: one of FEATURES."""
        return self["features"][:, FEATURES.index(name)].astype(float)

    @cached_property
    def gaussian(self) -> np.ndarray:
        """Return a mask (s,) of the Gaussian and isotropic surfaces of the set."""
        return self["kinds"] == "gaussian"

    @cache  # noqa: B019
    def of_kind(self, kind: str | None) -> np.ndarray:
        """Return a mask (s,) of the surfaces of a kind, a key of OF_KIND; True everywhere if the kind is None.

        For a mixture of kinds the result is an array of weights from 0 to 1 instead of a mask. The total weight of each
        kind is then proportional to its fraction of the mixture.
        """
        if kind is None or kind in OF_KIND:
            return np.ones(len(self["kinds"]), dtype=bool) if kind is None else np.isin(self["kinds"], OF_KIND[kind])
        masks = [(share, self.of_kind(name)) for name, share in shares_of_kinds(kind).items()]
        weights = np.sum([share * mask / mask.sum() for share, mask in masks], axis=0)
        return weights / weights.max()

    @cached_property
    def areas(self) -> np.ndarray:
        """Return the ratio of solved to nominal contact area (surfaces, hardnesses, pressures), NaN where it was not solved."""
        found = self["areas"]
        return np.where(found == 65535, np.nan, np.exp(-2e-4 * found.astype(float)))

    @cache  # noqa: B019 - there is only one set, and it is needed until the process ends
    def errors(self, column: str) -> np.ndarray | None:
        """Return the errors ln(A/A_ref) of a model (surfaces, hardnesses, pressures); None if the model was not measured.

        column: "model|asperity method". A, A_ref: contact area by the model and by the reference solution.
        """
        return self._of("columns", "which", "errors", column)

    @cache  # noqa: B019
    def film_errors(self, column: str) -> np.ndarray | None:
        """Return the errors ln(A/A_ref) of a model on films (coated surfaces, films, loads); None if it was not measured.

        column: "model|asperity method". A, A_ref: contact area by the model and by the reference solution.
        """
        return self._of("film_columns", "film_which", "film_errors", column)

    def _of(self, names: str, which: str, tables: str, column: str) -> np.ndarray | None:
        at = np.flatnonzero(self[names] == column)
        if not at.size:
            return None
        return decoded(np.cumsum(self[tables][self[which][at[0]]], axis=-1, dtype=np.int8))

    def __hash__(self) -> int:
        return id(self)


@cache
def benchmark_set() -> BenchmarkSet:
    """Return the benchmark set of the package."""
    with np.load(FILE, allow_pickle=False) as file:
        content = {name: file[name] for name in file.files}
    for name in PACKED:
        plain = np.frombuffer(lzma.decompress(content[name].tobytes()), np.int8)
        content[name] = plain.reshape(content.pop(f"{name}_shape"))
    return BenchmarkSet(content)
