"""Choose which loops run: plain Python, shared compiled loops (quick to compile), or one loop per regime (quick to run)."""

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
# So many pairs of a law and a separation are worth a loop of their own: it takes a second to compile and runs twice as fast.
_WORTH_COMPILING = 100_000
_PAIRS_OF_A_LAW = 8  # at least: a law is summed more than once until its load is found


class Allowance:
    """Count down the amount of work that plain Python may do in this process before compiled code pays."""

    def __init__(self, worth: int):
        self._left = worth

    def take(self, work: int) -> bool:
        """Subtract `work` from what is left, and return whether plain Python may still do this work."""
        self._left -= work
        return self._left >= 0

    def end(self) -> None:
        self._left = -1


# Pairs of a law and a separation, of one regime: Python sums them in the time in which Numba and compiled loops are loaded.
ENGINE = Allowance(400)

_compiled = ContextVar("compiled", default=False)


@contextmanager
def all_compiled() -> Iterator[None]:
    """Within the context, compile lazy kernels at their first call.

    Results then have the same bits in every process.
    """
    before = _compiled.set(True)
    try:
        yield
    finally:
        _compiled.reset(before)


@cache
def tier() -> str:
    """Return the value of the environment variable STICTION_LOOPS, by default "auto".

    It is read once, because every call of a kernel needs it. Raises an InputError for a value that is not in TIERS.
    """
    wanted = os.environ.get(VARIABLE, TIERS[0])
    if wanted not in TIERS:
        raise InputError(VARIABLE, wanted, ", ".join(TIERS))
    return wanted


def specialised(laws: int, pairs: int = 0) -> bool:
    """Return whether it pays to compile a loop of its own for a regime.

    laws: number of parameter sets. pairs: number of pairs of a law and a separation that will be summed, if known. The
    environment variable STICTION_LOOPS can force the answer.
    """
    wanted = tier()
    return max(pairs, _PAIRS_OF_A_LAW * laws) >= _WORTH_COMPILING if wanted == TIERS[0] else wanted == TIERS[-1]


def interpreted(little: bool) -> bool:
    """Return whether plain Python, not compiled code, runs a lazy kernel.

    little: whether the kernel has had little work so far. STICTION_LOOPS and `all_compiled` can force the answer.
    """
    wanted = tier()
    return little and not _compiled.get() if wanted == TIERS[0] else wanted == TIERS[1]


def show_config() -> dict[str, str]:
    """Return how this process computes sums over asperities.

    Returns
    -------
    dict[str, str] `stiction`, `numba`: versions. `loops`: value of the environment variable STICTION_LOOPS, one of TIERS; with
        `auto`, loops are compiled when that saves time. `compiler`: `on`, or `off` if NUMBA_DISABLE_JIT is set. `cache`:
        folder of compiled loops.

    Raises
    ------
    InputError
        STICTION_LOOPS is not one of TIERS.

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
