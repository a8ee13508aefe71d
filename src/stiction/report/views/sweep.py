"""A sweep as it is shown."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.text import Text

from stiction.report.view import View

if TYPE_CHECKING:
    from stiction.studies.sweep.store import Store


def sweep_view(store: "Store", out: Path, computed: int, seconds: float) -> View:
    """Return what a complete store shows. computed: points that were computed now, in so many seconds."""
    size, doubts = store.plan.size, store.doubts()

    def parts() -> Iterator[Any]:
        rate = f", {computed / seconds:.3g} points/s" if computed else ""
        yield f"{size} points, {computed} of them computed now in {seconds:.3g} s{rate}"
        yield from (Text(f"doubtful in {count} points: {text}", style="yellow") for text, count in doubts.items())
        yield Text(f"stored in {out}: xarray.open_zarr({str(out)!r}, consolidated=False)", no_wrap=True)

    def record() -> dict[str, Any]:
        here = {"points": size, "computed_now": computed, "seconds": seconds, "doubts": doubts}
        return {"store": str(out), "dims": {**store.plan.dims}, "blocks": store.plan.blocks, **here}

    return View("sweep", None, parts, record)
