"""Hold all code that uses Numba beyond its public interface; tests fail if a Numba release breaks it.

Numba's own cache (`cache=True`) cannot serve the loops that are compiled here, for three reasons. It hashes a closure by the
identities of the compiled functions in it, which differ in every process. It notices edits only in the loop's own file.
Processes that compile the same loop for different input types at the same time can mix up each other's files, because all types
share one index file.
"""

import hashlib
import os
import pickle
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FunctionType
from typing import Any

import numba
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps
from numba.np.unsafe.ndarray import to_fixed_tuple as to_fixed_tuple

from stiction.engine.compiling import report
from stiction.quantities.cache import cache_folder, is_private, keep_file
from stiction.quantities.notices import notice

_MOST = 500_000_000  # bytes, largest size of the cache; the kernels of all models take a third of it
# Number of bytes of the checksum at the end of a cache file, which shows that the file is complete.
_CHECKSUM = hashlib.sha256().digest_size


def keep_on_disk(compiled: Any, digest: Callable[[Any], str]) -> None:
    """Give a compiled kernel a cache on disk.

    compiled: the function that Numba returned. digest: function that returns a hash of all code that `compiled` depends on. The
    name of a cache file contains a hash of this digest, the input types, the versions of Numba and Python, and the processor.
    """
    compiled._cache = _KernelCache(compiled, digest)


class _KernelCache(NullCache):
    """Cache one kernel (compiled loop) on disk, in one file for each combination of input types and processor.

    Each file is replaced in one step, so that processes that compile at the same time do not mix up their files.
    """

    def __init__(self, compiled: Any, digest: Callable[[Any], str]):
        self._compiled, self._digest_of, self._digest = compiled, digest, ""
        self._name = next(_keys_of_laws(compiled.py_func), compiled.py_func.__name__.strip("_"))

    @property
    def cache_path(self) -> str:
        return str(cache_folder("kernels"))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return the compiled kernel for inputs of the types `sig`; None if it is not in the cache or the cache is not trusted.

        sig, target_context: signature and compilation target, as Numba passes them. The hash of the kernel's code is computed
        here, at the first call, because only then are all functions defined to which the kernel refers.
        """
        if not self._digest:
            # The hash is part of the function's name too, because the linker would mix up two versions loaded in one process.
            self._digest = self._digest_of(self._compiled)
            self._compiled.py_func.__qualname__ += f"_{self._digest[:16]}"
        target_context.refresh()
        loaded = self._loaded(sig, target_context) if _is_trusted() else None
        if loaded is None:
            report(0, self._name)
        return loaded

    def _loaded(self, sig: Any, target_context: Any) -> Any:
        file = self._file(sig, target_context.codegen())
        try:
            content = file.read_bytes()
            os.utime(file)  # marks the file as used; files unused for longest are deleted first
        except OSError:
            return None
        made, checksum = content[:-_CHECKSUM], content[-_CHECKSUM:]
        if not made or hashlib.sha256(made).digest() != checksum:  # truncated or changed: unpickling could run any code
            return None
        try:
            return CompileResult._rebuild(target_context, *pickle.loads(made))
        except ImportError:  # compiled from the same code when part of it was in a module that no longer exists
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        report(1, self._name)
        if data.library.has_dynamic_globals or any(not loop.can_cache for loop in data.lifted) or not _is_trusted():
            return
        file = self._file(sig, data.codegen)
        made = dumps(data._reduce())
        keep_file(file, lambda opened: opened.write(made + hashlib.sha256(made).digest()), _MOST)

    def _file(self, sig: Any, codegen: Any) -> Path:
        made_by = numba.__version__, sys.version_info[:2], codegen.magic_tuple()
        key = hashlib.sha256(repr((self._digest, sig, made_by)).encode()).hexdigest()[:24]
        function = self._compiled.py_func
        return cache_folder("kernels") / f"{function.__module__}.{function.__name__}-{key}.nbi"


def _keys_of_laws(function: Any) -> Iterator[str]:
    """Yield the keys of the laws whose formulas a compiled loop or formula contains (in its closure, searched recursively)."""
    *folders, name = function.__module__.split(".")
    if folders[:2] == ["stiction", "laws"] and len(folders) == 3:
        yield name
    for cell in function.__closure__ or ():
        if isinstance(cell.cell_contents, FunctionType):
            yield from _keys_of_laws(cell.cell_contents)


def _is_trusted() -> bool:
    """Return whether only this user can write to the folder of cached kernels; issue a notice if others can.

    Compiled kernels are loaded by unpickling, which runs code from the file; files by others must not be loaded.
    """
    folder = cache_folder("kernels")
    trusted = is_private(folder)
    if not trusted:
        notice(f"{folder} is not used: it belongs to another user, or others can write to it; loops are compiled anew")
    return trusted
