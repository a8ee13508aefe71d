"""Tables and pictures of docs/explanation/truth.md, from the set of solved surfaces in the package.

    python docs/truth_tables.py

draws the pictures; the tables are written by docs/make_tables.py.
"""

import math
from pathlib import Path

import numpy as np

from stiction.solving.accuracy.benchmark_set import BenchmarkSet, benchmark_set

HERE = Path(__file__).parent
_LIGHT, _HEAVY = 0.002, 0.3  # p/(E* h') of which root mean squares are taken
_SHOWN = (0.002, 0.01, 0.05, 0.2, 0.3)
_HARD = (0.03, 0.08, 0.2, 0.5, 1.2)
_BY_NUMBERS = ("mccool", "moments")


def the_set() -> str:
    """What surfaces there are."""
    known = benchmark_set()
    rows = []
    for kind in dict.fromkeys(known["kinds"].tolist()):
        some = known["kinds"] == kind
        ranges = [_range(known.feature(name)[some]) for name in ("alpha", "skewness", "lay", "top")]
        hard = int(np.isfinite(known.areas[some, 1:]).any(axis=(1, 2)).sum())
        films = int(np.isin(np.flatnonzero(some), known["film_surfaces"]).sum())
        rows.append((kind, f"{some.sum()} ({int((some & known['held_out']).sum())})", *ranges, f"{hard}", f"{films}"))
    head = ("kind", "surfaces (held out)", "Nayak's alpha", "skewness", "lay ratio", "top slope", "with hardness", "with films")
    return _table(head, rows)


def elastic() -> str:
    """Mean error of the elastic area of Gaussian isotropic surfaces, by pressure."""
    known = benchmark_set()
    rows = []
    for name in _columns(known):
        error = np.expm1(_of(known, name)[known.gaussian, 0])
        rows.append((_rms(known, error), name, [_mean(error[:, _at(known, p)]) for p in _SHOWN]))
    head = ("model", *(f"{p:g}" for p in _SHOWN), "rms")
    return _table(head, [(_named(name), *cells, _percent(rms)) for rms, name, cells in sorted(rows)])


def by_kind() -> str:
    """Root mean square error of the elastic area, by kind of surface."""
    known = benchmark_set()
    kinds = list(dict.fromkeys(known["kinds"].tolist()))
    rows = []
    for name in _columns(known):
        error = np.expm1(_of(known, name)[:, 0])
        each = [_rms(known, error[known["kinds"] == kind]) for kind in kinds]
        rows.append((each[0], name, each))
    return _table(("model", *kinds), [(_named(name), *map(_percent, each)) for _, name, each in sorted(rows)])


def errors_of(model: str) -> str:
    """The row of `elastic` of a model, in words; nothing if it was not compared."""
    known = benchmark_set()
    for name in _columns(known):
        if name.split("|")[0] == model:
            error = np.expm1(_of(known, name)[known.gaussian, 0])
            at = [(p, _mean(error[:, _at(known, p)])) for p in _SHOWN]
            each = ", ".join(f"{mean} % at {p:g}" for p, mean in at if mean != "-")
            return f"elastic, Gaussian and isotropic, by $p/(E^*h')$: {each}; rms {_percent(_rms(known, error))} %"
    return ""


def with_hardness() -> str:
    """Mean error, and in brackets the root mean square, of the area of Gaussian isotropic surfaces, by hardness."""
    known = benchmark_set()
    rows = []
    for name in _columns(known):
        error = np.expm1(_of(known, name)[known.gaussian])
        each = [error[:, _hard(known, hardness)][:, _loads(known)] for hardness in _HARD]
        cells = [f"{_mean(one)} ({_percent(_root(one))})" if np.isfinite(one).any() else "-" for one in each]
        rows.append((_root(np.concatenate([one.ravel() for one in each])), name, cells))
    ordered = sorted(rows, key=lambda row: (not math.isfinite(row[0]), row[0]))
    return _table(("model", *(f"{hardness:g}" for hardness in _HARD)), [(_named(name), *cells) for _, name, cells in ordered])


def by_way() -> str:
    """The sum of Hertz asperities by how they were found, on all kinds of surface."""
    known = benchmark_set()
    kinds = list(dict.fromkeys(known["kinds"].tolist()))
    rows = []
    for column in known["columns"].tolist():
        model, method = column.split("|")
        if model == "greenwood_williamson_1966":
            error = np.expm1(known.errors(column)[:, 0])
            rows.append((f"`{method}`", *(_percent(_rms(known, error[known["kinds"] == kind])) for kind in kinds)))
    return _table(("asperities found by", *kinds), rows)


def on_films() -> str:
    """Root mean square error of the area on elastic films, by modulus over the substrate's."""
    known = benchmark_set()
    moduli = np.unique(known["films"][:, 0])
    rows = []
    for column in known["film_columns"].tolist():
        error = np.expm1(known.film_errors(column))
        each = [_root(error[:, known["films"][:, 0] == modulus]) for modulus in moduli]
        rows.append((each, column.split("|")[0]))
    alike: dict[tuple[str, ...], list[str]] = {}
    for each, name in sorted(rows, key=lambda row: float(np.sum(row[0]))):
        alike.setdefault(tuple(map(_percent, each)), []).append(f"`{name}`")
    return _table(
        ("models", *(f"{modulus:g}" for modulus in moduli)), [(", ".join(names), *cells) for cells, names in alike.items()]
    )


def _columns(known: BenchmarkSet) -> list[str]:
    """What a contact by numbers is told: asperities by McCool's relations, or moments."""
    return [column for column in known["columns"].tolist() if column.endswith(_BY_NUMBERS)]


def _of(known: BenchmarkSet, column: str) -> np.ndarray:
    found = known.errors(column)
    assert found is not None
    return found


def _named(column: str) -> str:
    return f"`{column.split('|')[0]}`"


def _at(known: BenchmarkSet, pressure: float) -> int:
    return int(np.argmin(np.abs(known["loads"] - pressure)))


def _hard(known: BenchmarkSet, hardness: float) -> int:
    return int(np.argmin(np.abs(known["hardnesses"] - hardness)))


def _loads(known: BenchmarkSet) -> np.ndarray:
    return (known["loads"] >= _LIGHT) & (known["loads"] <= _HEAVY)


def _rms(known: BenchmarkSet, error: np.ndarray) -> float:
    """Over the pressures of _LIGHT to _HEAVY; error (surfaces, pressures)."""
    return _root(error[:, _loads(known)])


def _root(error: np.ndarray) -> float:
    return math.sqrt(float(np.nanmean(error**2))) if np.isfinite(error).any() else math.nan


def _mean(error: np.ndarray) -> str:
    return f"{100.0 * float(np.nanmean(error)):+.0f}" if np.isfinite(error).any() else "-"


def _percent(value: float) -> str:
    if not math.isfinite(value):
        return "-"
    return f"{100.0 * value:.1f}" if value < 0.0995 else f"{100.0 * value:.0f}"


def _range(values: np.ndarray) -> str:
    return " to ".join(f"{float(f'{end:.2g}'):g}" for end in (values.min(), values.max()))


def _table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


TABLES = {
    "the set": the_set, "elastic": elastic, "kinds of surface": by_kind, "with a hardness": with_hardness,
    "ways of finding asperities": by_way, "elastic films": on_films,
}  # fmt: skip


def areas_figure():
    """Solved area over pressure of every surface, by kind."""
    import matplotlib.pyplot as plt

    known = benchmark_set()
    kinds = list(dict.fromkeys(known["kinds"].tolist()))
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.6), layout="constrained")
    for at, kind in enumerate(kinds):
        areas = known.areas[known["kinds"] == kind, 0]
        left.plot(known["loads"], (areas / known["loads"]).T, color=f"C{at}", alpha=0.35, lw=0.8)
        left.plot([], [], color=f"C{at}", label=kind)
    left.set(xscale="log", yscale="log", xlabel="p/(E* h')", ylabel="(A/A$_0$) / (p/(E* h'))", title="elastic, every surface")
    left.legend(fontsize=8, ncols=2, frameon=False)
    for at, hardness in enumerate(known["hardnesses"]):
        areas = known.areas[known.gaussian, at]
        areas = areas[:, np.isfinite(areas).any(axis=0)]
        label = "elastic" if math.isinf(hardness) else f"H/(E* h') = {hardness:g}"
        loads = known["loads"][: areas.shape[1]]
        right.plot(loads, np.nanmean(areas, axis=0) / loads, "o-", ms=3, label=label)
    right.set(xscale="log", yscale="log", xlabel="p/(E* h')", title="mean of Gaussian isotropic surfaces, by hardness")
    right.legend(fontsize=8, frameon=False)
    return figure


def errors_figure():
    """Error of some models over pressure: mean and middle four fifths, Gaussian and skewed surfaces."""
    import matplotlib.pyplot as plt

    known = benchmark_set()
    shown = ("persson_widened|moments", "persson_2001|moments", "greenwood_williamson_1966|mccool", "greenwood_2006|moments")
    others = np.isin(known["kinds"], ("skewed", "peaked", "flat"))
    panels = {"Gaussian isotropic": known.gaussian, "skewed, peaked, flat": others, "worn": known["kinds"] == "worn"}
    figure, axes = plt.subplots(1, 3, figsize=(12.0, 4.2), layout="constrained")
    for axis, (title, some) in zip(axes, panels.items(), strict=True):
        for at, column in enumerate(shown):
            error = 100.0 * np.expm1(_of(known, column)[some, 0])
            low, middle, high = np.nanpercentile(error, (10.0, 50.0, 90.0), axis=0)
            axis.plot(known["loads"], middle, color=f"C{at}", label=column.split("|")[0])
            axis.fill_between(known["loads"], low, high, color=f"C{at}", alpha=0.15, lw=0)
        axis.axhspan(-5.0, 5.0, color="0.85", zorder=0)
        axis.set(xscale="log", xlabel="p/(E* h')", title=title, ylim=(-100.0, 150.0))
    axes[0].set_ylabel("error of the contact area [%]")
    axes[0].legend(fontsize=8, frameon=False)
    return figure


if __name__ == "__main__":
    areas_figure().savefig(HERE / "explanation" / "truth_areas.png", dpi=90)
    errors_figure().savefig(HERE / "explanation" / "truth_errors.png", dpi=90)
