"""Compile formulas and kernels, and name kernels in the cache by the code of all that they call.

A kernel that works for any law is made by a factory: a plain function that takes the law's formulas and returns a kernel that
calls them, which Numba compiles as fast as if the formulas stood in it. Every compiled kernel has a file whose name is made
from the code of the kernel and, in turn, of all that it names or closes over: a kernel is compiled anew when any of that
changes, and only then. `numba_internals` says why Numba's own cache cannot do that.
"""

import hashlib
import types
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from numba.extending import overload, register_jitable, typeof_impl

from stiction.engine.numba_internals import keep_on_disk, to_fixed_tuple
from stiction.engine.tiers import interpreted

# `contract` (fused multiply-add) is safe in every formula. Sums may also be reordered, which is what lets them vectorise;
# formulas may not: a reordered range reduction in the exponential loses half its digits. A formula that is called, and not
# taken in, keeps a loop from being vectorised: hence `forceinline`.
FORMULA: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True}
KERNEL: dict[str, Any] = {"fastmath": {"contract", "reassoc", "nsz"}, "error_model": "numpy", "nogil": True}


def unpack(row, length):
    """Return the first numbers of an array as a tuple; in kernels the length must be a constant.

    In plain Python they are Python's own floats, with which formulas run three times as fast as with NumPy's.
    """
    return tuple(row[:length].tolist())


@overload(unpack, inline="always")
def _unpack_compiled(row, length):
    return lambda row, length: to_fixed_tuple(row, length)  # type: ignore[call-arg]


# What the compiler knows by itself: their names say enough, and the version of the compiler, which the cache asks for.
_KNOWN = ("numpy", "numba", "math")


def formula(function: Callable) -> Any:
    """Let kernels compile a formula of scalars as a part of themselves. Called from Python it stays plain, and takes arrays."""
    return _inlined(function, FORMULA)


def loop(function: Callable) -> Any:
    """Let kernels compile a loop as a part of themselves: its sums may be reordered, as those of the kernel."""
    return _inlined(function, KERNEL)


def _inlined(function: Any, options: dict[str, Any]) -> Any:
    # The wrapper for C, which nothing calls, would take a tenth of the time of compilation.
    function.targetoptions = {**options, "forceinline": True, "no_cfunc_wrapper": True}
    return register_jitable(**function.targetoptions)(function)


def kernel(function: Callable) -> Any:
    """Compile a loop over many inputs, with a cache on disk. It may be a closure over formulas and constants."""
    compiled: Any = numba.njit(**KERNEL)(function)
    if compiled is not function:
        keep_on_disk(compiled, digest)
    return compiled


class LazyKernel:
    """A kernel that Python runs until it has filled so much that compiling pays.

    Compiling takes a third of a second and more, the interpreter a thousandth for one contact. Where the interpreter refuses
    what compiled code computes (a division by nothing that a formula deals with), the compiled kernel does the work at once:
    hence a lazy kernel fills arrays, and never adds to them.
    """

    def __init__(self, function: Callable, worth: int):
        self.compiled, self.py_func, self._left = kernel(function), function, worth
        self.targetoptions = self.compiled.targetoptions

    def __call__(self, *given: Any) -> Any:
        last = given[-1]
        self._left -= last.size if isinstance(last, np.ndarray) else 1
        if interpreted(self._left >= 0):
            try:
                with np.errstate(divide="raise", invalid="raise", over="raise"):
                    return self.py_func(*given)
            except (ArithmeticError, TypeError, ValueError):
                self._left = -1
        return self.compiled(*given)


@typeof_impl.register(LazyKernel)
def _typeof_lazy(value, _):
    return numba.types.Dispatcher(value.compiled)


def lazy_kernel(worth: int) -> Callable:
    """Return a decorator: as `kernel`, but compiled when it has filled so many elements of its last array, in all calls."""

    def decorate(function: Callable) -> Any:
        return function if numba.config.DISABLE_JIT else LazyKernel(function, worth)  # type: ignore[attr-defined]

    return decorate


def digest(function: Callable) -> str:
    """Return a name for everything that determines the compiled code of a function."""
    return hashlib.sha256(_decides(function, []).encode()).hexdigest()


def _decides(value: Any, seen: list[Callable]) -> str:
    """Return the text that determines the compiled code of a value.

    For a function its own code and that of all that it names or closes over; for anything else its value. seen: functions
    before, which are named by their position.
    """
    function = getattr(value, "py_func", value)
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
    """Return the instructions of a function with their constants and names; its docstring does not count."""
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
