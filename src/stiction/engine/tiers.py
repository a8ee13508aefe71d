"""Choose which loops run: plain Python, compiled loops that all laws share, or one compiled loop per regime.

A regime is a smooth part of an asperity's behaviour, given by formulas. Shared loops compile quickly; loops for one regime run
quickly.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib.metadata import version

from stiction.quantities.cache import cache_folder
from stiction.quantities.errors import InputError

TIERS = ("auto", "interpreted", "shared", "specialised")
VARIABLE = "STICTION_LOOPS"
# Above this number of sums, a loop compiled for one regime saves time: compiling takes a second, and the loop is twice as fast.
_WORTH_COMPILING = 100_000
_PAIRS_OF_A_LAW = 8  # smallest number of sums of one law, because the separation at a load is found by iteration


class Allowance:
    """Count down the amount of work that plain Python may do in this process before compiled code takes over.

    worth: amount of work that is allowed, in a unit that the caller chooses.
    """

    def __init__(self, worth: int):
        self._left = worth

    def take(self, work: int) -> bool:
        """Subtract `work` from the remaining allowance, and return whether plain Python may still do this work."""
        self._left -= work
        return self._left >= 0

    def end(self) -> None:
        self._left = -1


# Number of sums of one regime that plain Python computes in the time that loading Numba and the compiled loops would take.
ENGINE = Allowance(400)

_compiled = ContextVar("compiled", default=False)


@contextmanager
def all_compiled() -> Iterator[None]:
    """Return a context manager within which loops always run as compiled code, even at their first call.

    Results are then bit-identical in every process. STICTION_LOOPS = interpreted overrides this.
    """
    before = _compiled.set(True)
    try:
        yield
    finally:
        _compiled.reset(before)


@cache
def tier() -> str:
    """Return the value of the environment variable STICTION_LOOPS, by default "auto".

    The variable is read once per process, because every call of a compiled loop needs its value. Raises an InputError for a
    value other than "auto", "interpreted", "shared" and "specialised".
    """
    wanted = os.environ.get(VARIABLE, TIERS[0])
    if wanted not in TIERS:
        raise InputError(VARIABLE, wanted, ", ".join(TIERS))
    return wanted


def specialised(laws: int, pairs: int = 0) -> bool:
    """Return whether compiling a loop for this one regime saves time over the shared loops.

    laws: number of parameter sets. pairs: number of sums (parameter set and separation) that will be computed, 0 if unknown. A
    value of STICTION_LOOPS other than "auto" decides instead.
    """
    wanted = tier()
    return max(pairs, _PAIRS_OF_A_LAW * laws) >= _WORTH_COMPILING if wanted == TIERS[0] else wanted == TIERS[-1]


def interpreted(little: bool) -> bool:
    """Return whether to run a loop in plain Python instead of compiling it.

    little: whether the loop has done so little work so far that compiling it would not pay. This decides if STICTION_LOOPS is
    "auto", except within `all_compiled`, which compiles every loop. Every other value of STICTION_LOOPS decides instead.
    """
    wanted = tier()
    return little and not _compiled.get() if wanted == TIERS[0] else wanted == TIERS[1]


def show_config() -> dict[str, str]:
    """Return the versions and settings with which this process computes sums over asperities.

    Returns
    -------
    dict[str, str]
        `stiction`, `numba`: versions. `loops`: value of the environment variable STICTION_LOOPS: "auto", "interpreted",
        "shared" or "specialised"; with "auto", loops are compiled when that saves time. `compiler`: "on", or "off" if
        NUMBA_DISABLE_JIT is set. `cache`: folder of compiled loops.

    Raises
    ------
    InputError
        STICTION_LOOPS has another value.

    Examples
    --------
    >>> import stiction as st
    >>> sorted(st.show_config())
    ['cache', 'compiler', 'loops', 'numba', 'stiction']
    """
    import numba

    return {
        "stiction": version("stiction"),
        "numba": numba.__version__,
        "loops": tier(),
        "compiler": "off" if numba.config.DISABLE_JIT else "on",  # type: ignore[attr-defined]
        "cache": str(cache_folder("kernels")),
    }
