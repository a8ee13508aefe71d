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
TEXT = """# Speed over time

`make bench` measures every part of the program. In the same run it measures two references that do not change with the
code: a loop over `scipy.integrate.quad` for the corrected model without a film, and NumPy's exponentials of a direct sum.
The pictures show the ratio

$$
\\frac{\\text{runs of a benchmark per second}}{\\text{evaluations of the loop per second}}
$$

A slow machine slows down the benchmark and the loop, so the ratio measures the code. If a line falls, a part of the program
has become slower. If the machine also does other work, the ratios scatter by ten per cent or more. Every run reports each
ratio that is lower than in the last run on the same machine by a quarter or more.

`benchmarks/history.jsonl` contains every record, with commit, date, machine and versions. In the first nine records the
loop was measured once. In later records the speed of the loop is the best of five measurements, nearly twice the earlier
speed. After the ninth record all ratios therefore fall by a third without a change of the code.
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
        "No ratio is lower than in the previous record by a quarter or more."
    ]
    return "\n".join([f"{now['date']}, {now['commit']}; {about}; {now['versions']}.", "", *said, "", *head, *rows, ""])
