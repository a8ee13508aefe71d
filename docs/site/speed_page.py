"""The page of the history of speed: what benchmarks/history.jsonl has, drawn, one line a benchmark, and the last record."""

import sys
import textwrap
from pathlib import Path, PurePosixPath
from typing import Any

import matplotlib.pyplot as plt
from links import ROOT

sys.path.append(str(ROOT / "benchmarks"))

import history

# Heading, name of the picture, and how the names of its benchmarks begin; what is left is drawn last.
GROUPS = (
    ("Evaluations of the paper's model", "speed-evaluations", ("scattered", "grid of", "grid, ")),
    ("Every model and law", "speed-models", ("grid: ",)),
    ("Under given loads", "speed-loads", ("one load each", "solved at one load", "100 loads", "1000 loads", "10000 loads")),
    ("Studies, scans and commands", "speed-rest", ("",)),
)
TEXT = """# How fast, and since when

`make bench` times every part of the program and, in the same run, two things that never change: a loop over
`scipy.integrate.quad` that evaluates the bare corrected model, and the exponentials alone that a direct sum of it needs, by
NumPy. What is drawn here is the ratio

$$
\\frac{\\text{how often a second a benchmark is done}}{\\text{evaluations a second of that loop}}
$$

A machine that is slower today is slower for both, so the ratio tells of the code: 1000 is a thousand times as often as the
loop, and a line that falls has become slower. Benchmarks that take seconds, a command or a scan, count as done once in that
time. Lines with few points are of benchmarks that are new; runs with other work beside them scatter by some ten per cent and
more. A run says which ratio fell by a quarter or more from the last of the same machine; nothing fails by it. Every record,
with commit, date, machine and versions, is a line of `benchmarks/history.jsonl`; the first nine are results as they were
committed. In those the loop was timed once, and cold; since then it is the best of five times, and nearly twice as fast: all
ratios fall by a third there, with no change of the code.
"""


def write(out: Path, records: list[dict[str, Any]] | None = None) -> list[PurePosixPath]:
    """The page and its pictures; records: those of the file, if not given."""
    known = history.read() if records is None else records
    parts = [TEXT]
    for heading, name, picked in _grouped(known):
        drawn = picture(known, picked)
        drawn.savefig(out / f"{name}.png", dpi=110)
        plt.close(drawn)
        parts += [
            f"## {heading}\n",
            f"```{{image}} {name}.png\n:alt: {heading}, ratio to scipy.quad by run\n:class: drawn\n```\n",
        ]
    parts += ["## The last record\n", last(known)]
    (out / "speed.md").write_text("\n".join(parts), encoding="utf-8")
    return []


def _grouped(known: list[dict[str, Any]]) -> list[tuple[str, str, list[str]]]:
    """Heading, picture and the names of its benchmarks, each in the first group that takes it."""
    left, found = list(dict.fromkeys(name for one in known for name in one["ratios"])), []
    for heading, picture_name, begins in GROUPS:
        picked = [name for name in left if name.startswith(begins)]
        left = [name for name in left if name not in picked]
        if picked:
            found.append((heading, picture_name, picked))
    return found


def picture(known: list[dict[str, Any]], names: list[str]) -> plt.Figure:
    """The ratio to scipy.quad of these benchmarks over the records, the fastest first in the legend."""
    figure, axes = plt.subplots(figsize=(11, max(3.5, 0.19 * len(names) + 1.0)), layout="constrained")
    lines = {name: [one["ratios"].get(name, {}).get("to_quad", float("nan")) for one in known] for name in names}
    newest = {name: next((value for value in reversed(values) if value == value), 0.0) for name, values in lines.items()}
    for at, name in enumerate(sorted(names, key=newest.__getitem__, reverse=True)):
        look = {"color": f"C{at % 10}", "linestyle": ("-", "--", ":", "-.")[at // 10 % 4], "marker": "o", "markersize": 3.5}
        axes.semilogy(range(len(known)), lines[name], label=f"{newest[name]:.3g}  {_short(name)}", linewidth=1.2, **look)
    axes.set_xticks(range(len(known)), [f"{one['date']}\n{one['commit']}" for one in known], rotation=60, fontsize="x-small")
    axes.set(ylabel="ratio to scipy.quad", xlim=(-0.5, len(known) - 0.5))
    axes.grid(alpha=0.3)
    figure.legend(
        loc="outside right upper", fontsize="xx-small", title="ratio of the last run that has it", title_fontsize="x-small"
    )
    return figure


def _short(name: str) -> str:
    """What fits a legend: without the unit, and cut where it is long."""
    return textwrap.shorten(name.rpartition(", ")[0].removeprefix("grid: ") or name, 75, placeholder=" ...")


def last(known: list[dict[str, Any]]) -> str:
    """The last record as a table, and what fell in it."""
    if not known:
        return "There is no record yet.\n"
    now = known[-1]
    about = ", ".join((now["machine"]["processor"], f"{now['machine']['processors']} processors", now["machine"]["system"]))
    rows = [
        f"| {name} | {ratios.get('to_quad', float('nan')):.3g} | {ratios.get('to_exponentials', float('nan')):.3g} |"
        for name, ratios in now["ratios"].items()
    ]
    head = ["| benchmark | ratio to scipy.quad | ratio to NumPy's exponentials |", "| --- | --- | --- |"]
    said = [f"- {line}" for line in (*history.moved_peers(known), *history.falls(known))] or [
        "No ratio fell by a quarter or more from the record before it."
    ]
    return "\n".join([f"{now['date']}, {now['commit']}; {about}; {now['versions']}.", "", *said, "", *head, *rows, ""])
