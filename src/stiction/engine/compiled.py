"""Compile formulas (functions of numbers) and kernels (loops that call them) with Numba; cache compiled kernels on disk.

A kernel that works for any law is made by a factory: a plain function that takes the formulas of the law and returns a kernel
that calls them. Numba then compiles the kernel as if the formulas were written inside it. The file name of a compiled kernel is
a hash of the code of the kernel and of everything that this code refers to. A kernel is therefore recompiled if, and only if,
some of that code changes. `numba_internals` explains why Numba's own cache cannot do this.

Plain Python runs the kernels at first. Numba is imported when the first kernel is compiled or loaded from the cache, because
importing it takes longer than solving one contact in plain Python.
"""

import hashlib
import types
from collections.abc import Callable
from functools import cache, cached_property
from threading import Lock
from typing import Any

import numpy as np

from stiction.engine.stopping import raise_if_stopped
from stiction.engine.tiers import ENGINE, Allowance, interpreted

# `contract` (fused multiply-add) is safe in every formula. Sums may also be reordered, because only then can the compiler
# vectorise them. Formulas may not: a reordered range reduction in the exponential loses half its digits. `forceinline` is
# needed because a loop that calls a formula instead of inlining it is not vectorised.
FORMULA: dict[str, Any] = {"fastmath": {"contract"}, "error_model": "numpy", "nogil": True}
KERNEL: dict[str, Any] = {"fastmath": {"contract", "reassoc", "nsz"}, "error_model": "numpy", "nogil": True}


def unpack(row, length):
    """Return the first `length` numbers of a one-dimensional array as a tuple; in compiled code `length` must be a constant.

    In plain Python the tuple holds Python floats, with which formulas run three times as fast as with NumPy scalars.
    """
    return tuple(row[:length].tolist())


# Functions of these modules are described by name alone; the version of Numba is part of the name of a cache file.
_KNOWN = ("numpy", "numba", "math")
# Marked functions that are not yet registered with Numba.
_waiting: list[Any] = []
_registering = Lock()


def formula(function: Callable) -> Any:
    """Mark a function of scalars so that compiled loops inline it, and return it.

    Called from Python, the function runs uncompiled and accepts arrays.
    """
    return _inlined(function, FORMULA)


def loop(function: Callable) -> Any:
    """Mark a function that contains a loop, so that compiled loops inline it, and return the function.

    The compiler may reorder its sums.
    """
    return _inlined(function, KERNEL)


def _inlined(function: Any, options: dict[str, Any]) -> Any:
    # Without a wrapper for C, which is never called, compilation takes a tenth less time.
    function.targetoptions = {**options, "forceinline": True, "no_cfunc_wrapper": True}
    _waiting.append(function)
    return function


class Kernel:
    """Run a loop over many inputs in plain Python at first, and as compiled code once compilation saves time.

    function: the loop. allowance: work that plain Python may do, None if the kernel is always compiled. size: function of the
    last argument that returns the work of one call.

    If plain Python raises an arithmetic, type or value error, the compiled kernel repeats the whole call; compiled code does
    not raise, for example, for a division by zero whose result the formula handles later. A kernel with an allowance must
    therefore overwrite its output arrays, never add to them.
    """

    def __init__(self, function: Callable, allowance: Allowance | None, size: Callable[[Any], int] = lambda last: 0):
        self.py_func, self.targetoptions, self._allowance, self._size = function, KERNEL, allowance, size

    @cached_property
    def compiled(self) -> Any:
        """Return the function that Numba compiles, or the plain one if NUMBA_DISABLE_JIT is set."""
        import numba

        from stiction.engine.numba_internals import keep_on_disk

        with _registering:
            _prepare_numba()
        compiled: Any = numba.njit(**KERNEL)(self.py_func)
        if compiled is not self.py_func:
            keep_on_disk(compiled, digest)
        return compiled

    def __call__(self, *args: Any) -> Any:
        raise_if_stopped()
        if self._allowance is not None and interpreted(self._allowance.take(self._size(args[-1]))):
            try:
                with np.errstate(divide="raise", invalid="raise", over="raise"):
                    return self.py_func(*args)
            except (ArithmeticError, TypeError, ValueError):
                self._allowance.end()
        _register_formulas()
        return self.compiled(*args)


def kernel(function: Callable) -> Any:
    """Return the loop `function` as a kernel that is compiled at its first call and cached on disk.

    The function may be a closure over formulas and constants.
    """
    return Kernel(function, None)


def engine_kernel(function: Callable) -> Any:
    """Return the loop `function` as a kernel that is compiled when all engine kernels together have done enough work.

    Until then plain Python runs it. The amount of work is `tiers.ENGINE`.
    """
    return Kernel(function, ENGINE)


def lazy_kernel(worth: int) -> Callable:
    """Return a decorator that runs a loop in plain Python first, and compiles it when it has done enough work.

    worth: work of all calls together after which the loop is compiled. The work of one call is the number of elements of its
    last argument.
    """
    return lambda function: Kernel(function, Allowance(worth), lambda last: getattr(last, "size", 1))


@cache
def _prepare_numba() -> None:
    """Register with Numba how compiled kernels call other kernels and the function `unpack`; done once per process."""
    import numba
    from numba.extending import overload, typeof_impl

    from stiction.engine.numba_internals import to_fixed_tuple

    @typeof_impl.register(Kernel)
    def typeof_kernel(value, _):
        return numba.types.Dispatcher(value.compiled)

    @overload(unpack, inline="always")
    def unpack_compiled(row, length):
        return lambda row, length: to_fixed_tuple(row, length)  # type: ignore[call-arg]


def _register_formulas() -> None:
    """Register with Numba all functions marked by `formula` or `loop` since the last call."""
    if not _waiting:  # the list is cleared when all are registered
        return
    from numba.extending import register_jitable

    with _registering:
        for function in _waiting:
            register_jitable(**function.targetoptions)(function)
        _waiting.clear()


def digest(function: Callable) -> str:
    """Return a hash, as hexadecimal text, of everything that determines the compiled code of a function.

    The hash covers the function's own code and, recursively, the code and values of everything to which it refers.
    """
    return hashlib.sha256(_description(function, []).encode()).hexdigest()


def _description(value: Any, seen: list[Callable]) -> str:
    """Return a text that describes everything in a value on which the compiled code depends.

    For a function the text holds its own code and, recursively, every value it refers to. For any other value it is the value
    as text. seen: functions already described; these are named by their index in this list.
    """
    function = getattr(value, "py_func", value)
    if isinstance(value, tuple):
        return f"({', '.join(_description(item, seen) for item in value)})"
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape} {value.tobytes()!r}"  # str() of a long array omits its middle
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__} {getattr(value, '_fields', '')}"
    if not isinstance(function, types.FunctionType):
        return repr(value)
    if _known(function.__module__):
        return f"{function.__module__}.{function.__qualname__}"
    if function in seen:
        return f"function {seen.index(function)}"
    seen.append(function)
    target_options = getattr(value, "targetoptions", {})
    options = sorted((name, sorted(option) if isinstance(option, set) else option) for name, option in target_options.items())
    inner = [f"{name}={_description(item, seen)}" for name, item in sorted(_referenced(function).items())]
    defaults = _description(function.__defaults__ or (), seen)
    return f"{function.__name__} {_code(function.__code__, function.__doc__)} {options} {defaults} {inner}"


def _code(code: types.CodeType, doc: str | None = None) -> str:
    """Return the instructions, constants and names of a code object as text, without its docstring `doc`."""
    constants = [
        _code(constant) if isinstance(constant, types.CodeType) else repr(constant)
        for constant in code.co_consts
        if constant is not doc
    ]
    names = code.co_names, code.co_varnames, code.co_freevars, code.co_argcount, code.co_flags
    return f"{code.co_code!r} {constants} {names} {code.co_exceptiontable!r}"


def _referenced(function: types.FunctionType) -> dict[str, Any]:
    """Return the objects that a function uses from its closure, its module and imported modules, by name.

    Modules themselves, and the contents of the modules in _KNOWN, are excluded.
    """
    codes, names = [function.__code__], set()
    for code in codes:
        names |= {*code.co_names}
        codes += [item for item in code.co_consts if isinstance(item, types.CodeType)]
    named = {name: function.__globals__[name] for name in names if name in function.__globals__}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        named[name] = cell.cell_contents
    modules = [item for item in named.values() if isinstance(item, types.ModuleType)]
    for module in modules:  # the loop appends modules that these modules import
        if not _known(module.__name__):
            inside = {f"{module.__name__}.{name}": getattr(module, name) for name in names if hasattr(module, name)}
            modules += [item for item in inside.values() if isinstance(item, types.ModuleType) and item not in modules]
            named |= inside
    return {name: item for name, item in named.items() if not isinstance(item, types.ModuleType)}


def _known(module: str | None) -> bool:
    return (module or "").partition(".")[0] in _KNOWN
