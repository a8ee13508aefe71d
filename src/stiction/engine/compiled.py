"""Compilation of formulas and kernels, cached on disk under names that carry their code."""

import hashlib
import os
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import platformdirs

# `contract` (fused multiply-add) is safe in every formula. Sums may also be reordered, which is what lets them vectorise;
# formulas may not: a reordered range reduction in the exponential loses half its digits. A formula that is called, and not
# taken in, keeps a loop from being vectorised: hence `forceinline`.
FORMULA: dict[str, Any] = {"fastmath": {"contract"}, "forceinline": True, "error_model": "numpy", "nogil": True}
KERNEL: dict[str, Any] = {"fastmath": {"contract", "reassoc", "nsz"}, "error_model": "numpy", "nogil": True}


def cache_folder() -> Path:
    """Where compiled kernels are kept; STICTION_CACHE_DIR moves it."""
    root = os.environ.get("STICTION_CACHE_DIR") or platformdirs.user_cache_dir("stiction", appauthor=False)
    return Path(root) / "kernels"


def formula(function: Callable) -> Callable:
    """Compile a formula of scalars. The kernels take it in whole, so it needs no cache of its own."""
    return numba.njit(**FORMULA)(function)


def kernel(function: Callable) -> Callable:
    """Compile a loop over many inputs, with a cache on disk.

    Numba looks only at the file of a kernel when it decides whether a cached one is still good: a formula edited in another
    file would go unnoticed. So the name under which the kernel is cached carries all that decides its code.
    """
    function.__qualname__ += f"_{hashlib.sha256(_decides(function).encode()).hexdigest()[:16]}"
    settings: Any = numba.config  # numba reads the folder's name when a function is decorated
    before = settings.CACHE_DIR
    settings.CACHE_DIR = str(cache_folder())
    try:
        return numba.njit(cache=True, **KERNEL)(function)
    finally:
        settings.CACHE_DIR = before


def bind(template: Callable, **bindings: Any) -> Callable:
    """A copy of the plain function `template` in which these global names have these values.

    Formulas that enter a kernel as arguments or closures defeat the on-disk cache; as globals they do not.
    """
    names = {**template.__globals__, **bindings}
    copy = types.FunctionType(template.__code__, names, template.__name__, template.__defaults__)
    copy.__qualname__, copy.__module__ = template.__qualname__, template.__module__
    return copy


def _decides(value: Any, seen: tuple[Callable, ...] = ()) -> str:
    """What decides the compiled code of a value: of a function its own code and, in turn, that of all that it names."""
    plain = getattr(value, "py_func", value)
    if not isinstance(plain, types.FunctionType):
        return repr(value)
    if plain in seen:
        return plain.__name__
    code, names = plain.__code__, plain.__globals__
    named = {name: names[name] for name in code.co_names if name in names}
    for module in [one for one in named.values() if isinstance(one, types.ModuleType)]:
        # module.name: whatever name of the code is a formula there
        named |= {name: one for name in code.co_names if hasattr(one := getattr(module, name, None), "py_func")}
    inner = [f"{name}={_decides(one, (*seen, plain))}" for name, one in named.items() if not isinstance(one, types.ModuleType)]
    return f"{plain.__name__} {code.co_code!r} {code.co_consts!r} {inner}"
