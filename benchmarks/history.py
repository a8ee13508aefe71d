"""The history of `make bench`: a record of each run in benchmarks/history.jsonl, and what is slower than before.

    python benchmarks/history.py    # says what fell by a quarter or more from the record before of the same machine

What is kept of a benchmark are two ratios of one run: its speed over that of scipy.quad, and over that of NumPy's exponentials
alone, both of the bare corrected model (peers.py). A machine that is slower today is slower for all three; a ratio that falls
is the code's doing, or chance. Nothing fails by it. Records without `to_exponentials` are older than that peer. The first nine
are what results.json was in the commits they name, with the loop timed once and cold, in which it is nearly half as fast.
"""

import json
import statistics
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FILE = Path(__file__).with_name("history.jsonl")
QUAD = "scipy.quad, clipped and split, evaluations/s"
EXPONENTIALS = "the exponentials of that alone, by NumPy, evaluations/s"
FALL = 0.25  # of a ratio, from which on it is said
COMMON = 0.1  # of all ratios to a peer, from which on it is rather the peer
PEERS = {"to_quad": "scipy.quad", "to_exponentials": "NumPy's exponentials"}
# What is measured beside ours, and what is no speed.
_OTHERS = ("scipy", "by NumPy", "SurfaceTopography", "ratio", "relative", "GB")
_MACHINE = ("processor", "processors", "system")


def speeds(figures: dict[str, float]) -> dict[str, float]:
    """Of each benchmark of ours, how often a second: figures in seconds are turned over, what is no speed is left out."""
    ours = {name: value for name, value in figures.items() if not any(word in name for word in _OTHERS)}
    return {name: 1.0 / value if _in_seconds(name) else value for name, value in ours.items()}


def _in_seconds(name: str) -> bool:
    return name.endswith((", processor s", ", elapsed s"))


def record(results: dict[str, Any], commit: str) -> dict[str, Any]:
    """One line of the history, of what `run.py` writes to results.json."""
    about, figures = results["machine"], results["figures"]
    peers = {key: figures[name] for key, name in (("to_quad", QUAD), ("to_exponentials", EXPONENTIALS)) if name in figures}
    ratios = {name: {key: float(f"{one / peer:.4g}") for key, peer in peers.items()} for name, one in speeds(figures).items()}
    machine = {name: about[name] for name in _MACHINE}
    return {"commit": commit, "date": about["date"], "machine": machine, "versions": about["versions"], "ratios": ratios}


def commit_of(root: Path) -> str:
    """Of the code that is run; `-dirty` where src or benchmarks differ from it, empty where nothing is known of it."""

    def said(*words: str) -> str:
        return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True, text=True).stdout.strip()

    try:
        return said("rev-parse", "--short", "HEAD") + "-dirty" * bool(said("status", "--porcelain", "src", "benchmarks"))
    except (OSError, subprocess.CalledProcessError):
        return ""


def read(file: Path = FILE) -> list[dict[str, Any]]:
    """All records, the oldest first."""
    if not file.exists():
        return []
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines() if line.strip()]


def append(one: dict[str, Any], file: Path = FILE) -> None:
    with file.open("a", encoding="utf-8") as out:
        out.write(json.dumps(one, ensure_ascii=False) + "\n")


def before(records: list[dict[str, Any]]) -> dict[str, Any] | None:
    """The last record of the machine of the newest, before that."""
    *others, now = records
    return next((one for one in reversed(others) if one["machine"] == now["machine"]), None)


def falls(records: list[dict[str, Any]]) -> list[str]:
    """In words: what fell by a quarter or more in the last record, from the last before it of the same machine."""
    earlier = before(records)
    return [] if earlier is None else list(_fallen(earlier, records[-1]))


def _fallen(earlier: dict[str, Any], now: dict[str, Any]) -> Iterator[str]:
    for name, ratios in now["ratios"].items():
        for key, peer in PEERS.items():
            was, is_now = earlier["ratios"].get(name, {}).get(key), ratios.get(key)
            if was and is_now is not None and is_now <= (1.0 - FALL) * was:
                less, of = f"{100.0 * (1.0 - is_now / was):.0f} %", f"at {earlier['commit']}, {earlier['date']}"
                yield f"{name}: ratio to {peer} fell by {less}, to {is_now:.3g} from {was:.3g} {of}"


def moved_peers(records: list[dict[str, Any]]) -> list[str]:
    """In words: peers over which half of all ratios fell by a tenth or more, from the same record as in `falls`. It is hardly
    all of the code that got slower at once: rather a peer that was slowed down then, or is less so now."""
    earlier, now, said = before(records), records[-1], []
    if earlier is None:
        return []
    for key, peer in PEERS.items():
        both = [(was[key], now["ratios"][name][key]) for name, was in earlier["ratios"].items()
                if key in was and key in now["ratios"].get(name, {})]  # fmt: skip
        middle = statistics.median([is_now / was for was, is_now in both]) if both else 1.0
        if middle <= 1.0 - COMMON:
            said.append(
                f"All ratios to {peer} are {middle:.2f} of what they were, in the median: look at those to the other peer."
            )
    return said


def told(records: list[dict[str, Any]]) -> str:
    """What `make bench` says at its end."""
    if before(records) is None:
        return "First record of this machine: there is nothing to compare it with."
    return (
        "\n".join([*moved_peers(records), *falls(records)])
        or "No ratio fell by a quarter or more from the last record of this machine."
    )


if __name__ == "__main__":
    known = read()
    print(told(known) if known else "There is no record yet.")
