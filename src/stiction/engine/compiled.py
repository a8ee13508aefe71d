"""Compile formulas and kernels with Numba and cache compiled kernels on disk.

A kernel that works for any law is made by a factory: a plain function that takes the formulas of the law and returns a kernel
that calls them. Numba then compiles the kernel as if the formulas were written inside it. The file name of a compiled kernel
is a hash of the code of the kernel and of everything that this code refers to. A kernel is therefore compiled anew if, and
only if, some of that code changes. `numba_internals` explains why Numba's own cache cannot do this.
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
    """Return the first `length` numbers of an array as a tuple; in kernels `length` must be a constant.

    In plain Python the tuple holds Python floats, with which formulas run three times as fast as with NumPy scalars.
    """
    return tuple(row[:length].tolist())


@overload(unpack, inline="always")
def _unpack_compiled(row, length):
    return lambda row, length: to_fixed_tuple(row, length)  # type: ignore[call-arg]


# What the compiler knows by itself: their names say enough, and the version of the compiler, which the cache asks for.
_KNOWN = ("numpy", "numba", "math")


def formula(function: Callable) -> Any:
    """Mark a function of scalars so that kernels inline it; called from Python it runs uncompiled and accepts arrays."""
    return _inlined(function, FORMULA)


def loop(function: Callable) -> Any:
    """Mark a loop so that kernels inline it; the compiler may reorder its sums."""
    return _inlined(function, KERNEL)


def _inlined(function: Any, options: dict[str, Any]) -> Any:
    # The wrapper for C, which nothing calls, would take a tenth of the time of compilation.
    function.targetoptions = {**options, "forceinline": True, "no_cfunc_wrapper": True}
    return register_jitable(**function.targetoptions)(function)


def kernel(function: Callable) -> Any:
    """Compile a loop over many inputs and cache the result on disk.

    The function may be a closure over formulas and constants.
    """
    compiled: Any = numba.njit(**KERNEL)(function)
    if compiled is not function:
        keep_on_disk(compiled, digest)
    return compiled


class LazyKernel:
    """Represent a kernel that runs in plain Python until enough elements were computed for compiling to pay.

    Compiling takes a third of a second or more; the interpreter needs a millisecond for one contact. If plain Python raises an
    arithmetic error where compiled code would not (a division by zero that the formula handles later), the compiled kernel
    repeats the whole call. A lazy kernel must therefore overwrite its output arrays, never add to them.
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
    """Return a decorator that makes a `LazyKernel`.

    worth: number of elements of the last argument, summed over all calls, after which the kernel is compiled.
    """

    def decorate(function: Callable) -> Any:
        return function if numba.config.DISABLE_JIT else LazyKernel(function, worth)  # type: ignore[attr-defined]

    return decorate


def digest(function: Callable) -> str:
    """Return a hash of everything that determines the compiled code of a function."""
    return hashlib.sha256(_decides(function, []).encode()).hexdigest()


def _decides(value: Any, seen: list[Callable]) -> str:
    """Return the text that determines the compiled code of a value.

    For a function the text holds its own code and, recursively, every value it refers to. For any other value it is the value
    as text. seen: functions already described; these are named by their index in this list.
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
    """Return the instructions, constants and names of a code object as text, without its docstring `doc`."""
    constants = [_code(one) if isinstance(one, types.CodeType) else repr(one) for one in code.co_consts if one is not doc]
    names = code.co_names, code.co_varnames, code.co_freevars, code.co_argcount, code.co_flags
    return f"{code.co_code!r} {constants} {names} {code.co_exceptiontable!r}"


def _named(function: types.FunctionType) -> dict[str, Any]:
    """Return the values, by name, that a function takes from its closure, its module and imported modules."""
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
