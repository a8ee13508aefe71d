"""Compiled formulas that are there only to be taken in by kernels.

By itself numba makes of every compiled function machine code, and doors through which Python and C come in. A kernel takes a
formula in before all that, so that for formulas it would be made, and thrown away: a quarter of the time of a kernel.
Kernels do the same arithmetic without it: what is linked into them has gone through the same passes as before.
"""

from functools import cached_property
from typing import Any

import numba
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import LoweringPass, register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import NativeLowering


class _NoEnvironment:
    """A formula has no environment: what would look there is the door to Python. In a kernel that comes from the cache no
    formula has one either."""

    @staticmethod
    def set_env(name: str, environment: Any) -> None:
        """Nothing to set."""


class _Code(JITCodeLibrary):
    """Optimised code to be linked into that of kernels; nothing is made of it for the processor."""

    codegen = _NoEnvironment()

    def get_pointer_to_function(self, name: str) -> int:
        self._ensure_finalized()
        return 0  # nobody comes in by an address

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True


@register_pass(mutates_CFG=False, analysis_only=False)
class _IntoCode(LoweringPass):
    """Before lowering: where its result goes."""

    _name = "stiction_into_code"

    def __init__(self) -> None:  # abstract above
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        state.library = _Code(state.targetctx.codegen(), state.func_id.func_qualname)
        return True


class _Compiler(CompilerBase):
    """Numba's own steps, and that one."""

    def define_pipelines(self) -> list:
        manager = DefaultPassBuilder.define_nopython_pipeline(self.state)
        at = next(at for at, (step, _) in enumerate(manager.passes) if step is NativeLowering)
        manager.passes.insert(at, (_IntoCode, "where a formula's code goes"))
        manager.finalize()
        return [manager]


class _TakenIn(CPUDispatcher):
    """A formula as kernels see it. Called from Python it is compiled once more, by itself, with a door."""

    _options: dict[str, Any]

    def __call__(self, *args: Any) -> Any:
        return self._by_itself(*args)

    @cached_property
    def _by_itself(self) -> Any:
        return numba.njit(**self._options)(self.py_func)


def taken_in(function: Any, options: dict[str, Any]) -> Any:
    """The function compiled for kernels, with these options of numba; itself under NUMBA_DISABLE_JIT."""
    doors = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    njit: Any = numba.njit  # its annotations know no options in a dictionary
    compiled = njit(**options, **doors, pipeline_class=_Compiler)(function)
    if compiled is not function:
        compiled.__class__, compiled._options = _TakenIn, options
    return compiled
