"""Compilation of formulas and kernels, cached on disk in a folder that changes with the source."""

import hashlib
import os
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import platformdirs

# `contract` (fused multiply-add) is safe in every formula. Sums may also be reordered, which is what lets them vectorise;
# formulas may not: a reordered range reduction in the exponential loses half its digits.
FORMULA: dict[str, Any] = {"fastmath": {"contract"}, "forceinline": True, "error_model": "numpy", "nogil": True}
KERNEL: dict[str, Any] = {"fastmath": {"contract", "reassoc", "nsz"}, "error_model": "numpy", "nogil": True}


def _source_fingerprint() -> str:
    """Name of the state of the package's source. Numba looks only at the file of the outermost function when it decides
    whether a cached kernel is still good; a formula edited in another file would go unnoticed."""
    files = sorted(Path(__file__).parent.rglob("*.py"))
    states = [f"{file.name}:{(stat := file.stat()).st_mtime_ns}:{stat.st_size}" for file in files]
    return hashlib.sha256("\n".join(states).encode()).hexdigest()[:16]


def cache_folder() -> Path:
    """Where compiled kernels are kept; STICTION_CACHE_DIR moves it."""
    root = os.environ.get("STICTION_CACHE_DIR") or platformdirs.user_cache_dir("stiction", appauthor=False)
    return Path(root) / "kernels" / _FINGERPRINT


_FINGERPRINT = _source_fingerprint()


def _jit(function: Callable, options: dict[str, Any]) -> Callable:
    """numba.njit with the on-disk cache in our folder; numba reads the folder's name when the function is decorated."""
    settings: Any = numba.config
    before = settings.CACHE_DIR
    settings.CACHE_DIR = str(cache_folder())
    try:
        return numba.njit(cache=True, **options)(function)
    finally:
        settings.CACHE_DIR = before


def kernel(function: Callable) -> Callable:
    """Compile a loop over many inputs."""
    return _jit(function, KERNEL)


def formula(function: Callable) -> Callable:
    """Compile a formula of scalars. The kernels take it in whole, so it needs no cache of its own."""
    return numba.njit(**FORMULA)(function)


def _decides(value: Any, seen: tuple[Callable, ...] = ()) -> str:
    """What decides the compiled code of a value: of a formula its own code and, in turn, that of all that it names."""
    plain = getattr(value, "py_func", value)
    if isinstance(plain, types.ModuleType):
        return plain.__name__
    if not isinstance(plain, types.FunctionType):
        return repr(value)
    if plain in seen:
        return plain.__qualname__
    code = plain.__code__
    named = [name for name in code.co_names if name in plain.__globals__]
    inner = [f"{name}={_decides(plain.__globals__[name], (*seen, plain))}" for name in named]
    return f"{plain.__module__}.{plain.__qualname__} {code.co_code!r} {code.co_consts!r} {inner}"


def bind(template: Callable, **bindings: Any) -> Callable:
    """A copy of the plain function `template` in which these global names have these values.

    Formulas that enter a kernel as arguments or closures defeat the on-disk cache; as globals they do not. The copy
    carries all that decides its code in its own name, which is the key of the cache: models outside the package have
    formulas that `_source_fingerprint` does not see.
    """
    decisive = "\n".join(f"{name}={_decides(value)}" for name, value in sorted(bindings.items()))
    names = {**template.__globals__, **bindings}
    copy = types.FunctionType(template.__code__, names, template.__name__, template.__defaults__)
    copy.__qualname__ = f"{template.__name__}_{hashlib.sha256(decisive.encode()).hexdigest()[:12]}"
    copy.__module__ = template.__module__
    return copy
