"""Build the view of a completed sweep: sentences and JSON."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.text import Text

from stiction.quantities.shown import show
from stiction.report.answer import number
from stiction.report.view import View

if TYPE_CHECKING:
    from stiction.studies.sweep.store import Store


_MOST = 1_000_000  # largest number of points of a store to read for the text


def sweep_view(store: "Store", out: Path, computed: int, seconds: float) -> View:
    """Return the view of a completed sweep.

    store: results of all points. out: folder of the store. computed: number of points computed in this run. seconds: time
    that this run took.
    """
    size, validity_warnings = store.plan.size, store.validity_warnings()

    def parts() -> Iterator[Any]:
        rate = f", {computed / seconds:.3g} points/s" if computed else ""
        yield f"{size} points, {computed} of them computed now in {seconds:.3g} s{rate}"
        yield from _friction(store)
        yield Text(f"stored in {out}: xarray.open_zarr({str(out)!r}, consolidated=False)", no_wrap=True)
        yield from (
            Text(f"validity warning in {count} points: {text}", style="yellow") for text, count in validity_warnings.items()
        )

    def record() -> dict[str, Any]:
        counts = {"points": size, "computed_now": computed, "seconds": seconds, "validity_warnings": validity_warnings}
        return {"store": str(out), "dims": {**store.plan.dims}, "blocks": store.plan.blocks, **counts}

    return View("sweep", None, parts, record)


def _friction(store: "Store") -> Iterator[str]:
    """Yield lines on mu over all points of a sweep: its range, or its scatter between height maps.

    There are none without mu, if only statistics are stored, or for more than a million points.
    """
    names = ("friction_coefficient", "friction_coefficient_low", "friction_coefficient_high")
    known = {name: np.asarray(store.group[name]) for name in names if name in store.group} if store.plan.size <= _MOST else {}
    if store.plan.maps and names[0] in known and not store.plan.sweep.statistics:
        yield from _scatter(known[names[0]], store.plan.load)
        return
    if store.plan.sweep.statistics or names[0] not in known or not np.isfinite(known[names[0]]).any():
        return
    ends = " to ".join(dict.fromkeys((number(np.nanmin(known[names[0]])), number(np.nanmax(known[names[0]])))))
    wide = ""
    if len(known) == len(names):
        low, high = number(np.nanmin(known[names[1]])), number(np.nanmax(known[names[2]]))
        wide = f", intervals from {low} to {high}, {store.group.attrs['draws']} samples of each contact"
    yield f"mu = {ends}{wide}"


def _scatter(mu: np.ndarray, loads: np.ndarray | None) -> Iterator[str]:
    """Yield a line with median, range and standard deviation of mu for each load at which two or more maps give mu.

    mu: (maps, loads), NaN if a map gives none. loads: [N]; None if the sweep states separations.
    """
    for index, column in enumerate(mu.T):
        there = column[np.isfinite(column)]
        if len(there) < 2:
            continue
        where = f"separation {index + 1}" if loads is None else show(float(loads[index]), "load")
        yield (
            f"mu = {number(np.median(there))} at {where}, from place to place {number(there.min())} to {number(there.max())} "
            f"(standard deviation {100.0 * there.std(ddof=1) / there.mean():.2g} %, {len(there)} maps)"
        )
