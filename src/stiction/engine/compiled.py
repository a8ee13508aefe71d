"""Compilation of formulas and kernels, and their cache on disk, which knows the code of all that is called.

A kernel that works for any law is made by a factory: a plain function that takes the law's formulas and returns a kernel that
calls them. Numba compiles such a closure as fast as if the formulas stood in it, but its own cache does not suit it: that
looks only at the file of the kernel, so that a formula edited in another file would go unnoticed, and it takes a formula in a
closure for a new one in every process. Here every compiled kernel has a file whose name is made from the code of the kernel
and, in turn, of all that it names or closes over: a kernel is compiled anew when any of that changes, and only then.
"""

import contextlib
import hashlib
import pickle
import sys
import types
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba.core import config
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps
from numba.np.unsafe.ndarray import to_fixed_tuple

from stiction.engine.taken_in import taken_in
from stiction.quantities.cache import cache_folder, cannot_keep

# `contract` (fused multiply-add) is safe in every formula. Sums may also be reordered, which is what lets them vectorise;
# formulas may not: a reordered range reduction in the exponential loses half its digits. A formula that is called, and not
# taken in, keeps a loop from being vectorised: hence `forceinline`.
FORMULA: dict[str, Any] = {"fastmath": {"contract"}, "forceinline": True, "error_model": "numpy", "nogil": True}
KERNEL: dict[str, Any] = {"fastmath": {"contract", "reassoc", "nsz"}, "error_model": "numpy", "nogil": True}

# unpack(row, length): an array as a tuple, in kernels; the length must be a constant. Numba does not give its type.
# NUMBA_DISABLE_JIT leaves formulas and kernels as plain Python: slow, and right.
_PLAIN: bool = config.DISABLE_JIT  # type: ignore[attr-defined]
unpack: Any = (lambda row, length: tuple(row[:length])) if _PLAIN else to_fixed_tuple

# Bytes at the end of a file of the cache, by which it is known to be whole.
_CHECKSUM = hashlib.sha256().digest_size

# What the compiler knows by itself: their names say enough, and the version of the compiler, which the cache asks for.
_KNOWN = ("numpy", "numba", "math")


def formula(function: Callable) -> Any:
    """Compile a formula of scalars. The kernels take it in whole, so it needs no cache of its own."""
    return taken_in(function, FORMULA)


def loop(function: Callable) -> Any:
    """Compile a part of a kernel, which the kernel takes in whole: its sums may be reordered, as those of the kernel."""
    return taken_in(function, {**KERNEL, "forceinline": True})


def kernel(function: Callable) -> Any:
    """Compile a loop over many inputs, with a cache on disk. It may be a closure over formulas and constants."""
    compiled: Any = numba.njit(**KERNEL)(function)
    if compiled is not function:
        compiled._cache = _KernelCache(compiled)
    return compiled


def plain(compiled: Any) -> Any:
    """The Python function of a formula, which takes arrays too."""
    return getattr(compiled, "py_func", compiled)


class _KernelCache(NullCache):
    """What numba asks for a kernel before it compiles one, and gives it afterwards. One file for each kernel, kind of inputs
    and processor, written as a whole: processes that compile at the same time cannot mix up each other's."""

    def __init__(self, compiled: Any):
        self._compiled, self._digest = compiled, ""

    @property
    def cache_path(self) -> str:
        return str(cache_folder("kernels"))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled kernel for inputs of these types, or None. Asked before any is compiled, when all that the kernel
        names is there."""
        if not self._digest:
            # In its name too: two that are loaded into one process must not be taken for each other by the linker.
            self._digest = digest(self._compiled)
            self._compiled.py_func.__qualname__ += f"_{self._digest[:16]}"
        target_context.refresh()
        try:
            content = self._file(sig, target_context.codegen()).read_bytes()
        except OSError:
            return None
        made, checksum = content[:-_CHECKSUM], content[-_CHECKSUM:]
        if not made or hashlib.sha256(made).digest() != checksum:  # cut short or changed: what is in it could do anything
            return None
        try:
            return CompileResult._rebuild(target_context, *pickle.loads(made))
        except ImportError:  # the same code, compiled when a part of it stood in a module that is no more
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        if data.library.has_dynamic_globals or any(not one.can_cache for one in data.lifted):
            return
        file = self._file(sig, data.codegen)
        part = file.with_suffix(f".{uuid.uuid4().hex}")
        made = dumps(data._reduce())
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            part.write_bytes(made + hashlib.sha256(made).digest())
            part.replace(file)
        except OSError as error:  # which costs time, and nothing else
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
            cannot_keep(error)

    def _file(self, sig: Any, codegen: Any) -> Path:
        made_by = numba.__version__, sys.version_info[:2], codegen.magic_tuple()
        key = hashlib.sha256(repr((self._digest, sig, made_by)).encode()).hexdigest()[:24]
        function = plain(self._compiled)
        return cache_folder("kernels") / f"{function.__module__}.{function.__name__}-{key}.nbi"


def digest(function: Callable) -> str:
    """A name for all that decides the compiled code of a function."""
    return hashlib.sha256(_decides(function, []).encode()).hexdigest()


def _decides(value: Any, seen: list[Callable]) -> str:
    """What decides the compiled code of a value: of a function its own code and, in turn, that of all that it names or closes
    over; of anything else, what it is equal to. seen: functions already told, which are named by their place."""
    function = plain(value)
    if isinstance(value, tuple):
        return f"({', '.join(_decides(one, seen) for one in value)})"
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {value.tobytes()!r}"  # the text of a long array leaves out its middle
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__} {getattr(value, '_fields', '')}"
    if not isinstance(function, types.FunctionType):
        return repr(value)
    if _known(function.__module__):
        return f"{function.__module__}.{function.__qualname__}"
    if function in seen:
        return f"function {seen.index(function)}"
    seen.append(function)
    given = getattr(value, "targetoptions", {})
    options = sorted((name, sorted(of) if isinstance(of, set) else of) for name, of in given.items())
    inner = [f"{name}={_decides(one, seen)}" for name, one in sorted(_named(function).items())]
    defaults = _decides(function.__defaults__ or (), seen)
    return f"{function.__name__} {_code(function.__code__, function.__doc__)} {options} {defaults} {inner}"


def _code(code: types.CodeType, doc: str | None = None) -> str:
    """The instructions of a function, with their constants and names; what its docstring says decides nothing."""
    constants = [_code(one) if isinstance(one, types.CodeType) else repr(one) for one in code.co_consts if one is not doc]
    names = code.co_names, code.co_varnames, code.co_freevars, code.co_argcount, code.co_flags
    return f"{code.co_code!r} {constants} {names} {code.co_exceptiontable!r}"


def _named(function: types.FunctionType) -> dict[str, Any]:
    """Values of the names that a function takes from outside: of its closure, its module, and what it takes from modules."""
    codes, names = [function.__code__], set()
    for code in codes:
        names |= {*code.co_names}
        codes += [one for one in code.co_consts if isinstance(one, types.CodeType)]
    found = {name: function.__globals__[name] for name in names if name in function.__globals__}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        found[name] = cell.cell_contents
    modules = [one for one in found.values() if isinstance(one, types.ModuleType)]
    for module in modules:  # those in modules join at the end
        if not _known(module.__name__):
            inside = {f"{module.__name__}.{name}": getattr(module, name) for name in names if hasattr(module, name)}
            modules += [one for one in inside.values() if isinstance(one, types.ModuleType) and one not in modules]
            found |= inside
    return {name: one for name, one in found.items() if not isinstance(one, types.ModuleType)}


def _known(module: str | None) -> bool:
    return (module or "").partition(".")[0] in _KNOWN
