"""Score predictions against the contacts of contacts.csv, leaving one class of contacts out.

python validation/contacts/score.py     # a line for each contact, how often the intervals hold; writes results.csv and FILE

A published range counts by its geometric mean; a kinetic coefficient may be a third below the static one. The interface of each
contact is stated, its roughness is known by the finish classes. The strengths of states come from sources; where a number leans
on the published friction of a class, it is replaced for that class by what is left without it (left_out.toml). Nothing else
is fitted to these contacts.
"""

import csv
import json
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass

import contacts
import numpy as np

import stiction as st
from stiction.contact.interfaces import Interface, interface
from stiction.studies.prediction.beside import FILE

LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)
KINETIC = 1.33  # the static coefficient at most, over the kinetic one
COLUMNS = (
    "class", "contact", "interface", "source", "grade", "printed_low", "printed_high",
    "median", "low_50", "high_50", "low_90", "high_90", "draws_below",
)  # fmt: skip


@dataclass(frozen=True)
class Score:
    """Store a contact with its published range, the predicted quantiles at LEVELS, and the share of draws below its mean."""

    row: dict[str, str]
    low: float
    high: float
    predicted: np.ndarray
    below: float

    def holds(self, level: float) -> bool:
        """Return whether the interval of this level holds the printed mean."""
        return abs(self.below - 0.5) <= 0.5 * level

    @property
    def overlaps(self) -> bool:
        """Return whether the published range overlaps the 90 % interval."""
        return bool(self.low <= self.predicted[-1] and self.high >= self.predicted[0])

    @property
    def width(self) -> float:
        """Return the upper end of the 90 % interval over the lower one."""
        return float(self.predicted[-1] / self.predicted[0])

    def as_row(self) -> list[str]:
        """Return the contact as a row of results.csv."""
        middle = (self.predicted[at] for at in (2, 1, 3, 0, 4))
        numbers = (f"{value:.3g}" for value in (self.low, self.high, *middle, self.below))
        return [*(self.row[name] for name in ("class", "id", "interface", "sources", "grade")), *numbers]


def score(row: dict[str, str], left_out: bool = True) -> Score:
    """Return the score of a contact; left_out: whether its class is unknown to the table of states."""
    contact = contacts.contact_of(row, interface=state_of(row, left_out))
    mu = st.predict(contact, load=float(row["load_N"])).friction_coefficient_samples.values
    mu = mu[np.isfinite(mu)]  # what is excluded is no part of the distribution
    low, high = float(row["mu_low"]), float(row["mu_high"])
    high *= KINETIC if row["which"] == "kinetic" else 1.0
    return Score(row, low, high, np.quantile(mu, LEVELS), float(np.mean(mu < (low * high) ** 0.5)))


def state_of(row: dict[str, str], left_out: bool) -> Interface:
    """Return the state of the interface of a contact, as it is known without the class of the contact."""
    state = interface(row["interface"])
    changes = dict(_left_out().get(row["class"], {}).get(row["interface"], {}))
    changes.pop("why", None)
    if not left_out or not changes:
        return state
    ranges = {**state.range, **changes.pop("range", {})}
    return Interface(**{**state.model_dump(exclude={"range"}, exclude_none=True), **changes, "range": ranges})


def scores(left_out: bool = True) -> Iterator[Score]:
    """Yield the score of each contact in scope."""
    return (score(row, left_out) for row in contacts.rows() if row["in_scope"] == "yes")


def _left_out() -> dict[str, dict]:
    return tomllib.loads((contacts.HERE / "left_out.toml").read_text(encoding="utf-8"))


def _by_state(found: list[Score]) -> dict[str, dict[str, float]]:
    """Return counts and the published friction of the contacts of each interface state.

    "contacts" counts them, "held" counts those whose 90 % interval contains the published mean. "lowest" and "highest" are the
    ends of all published ranges.
    """
    states: dict[str, list[Score]] = {name: [] for name in sorted({one.row["interface"] for one in found})}
    for one in found:
        states[one.row["interface"]].append(one)
    return {
        name: {
            "contacts": len(some),
            "held": sum(one.holds(0.9) for one in some),
            "lowest": min(one.low for one in some),
            "highest": round(max(one.high for one in some), 3),
        }
        for name, some in states.items()
    }


def main() -> None:
    found = []
    for one in scores():
        found.append(one)
        ends = " ".join(f"{value:8.3g}" for value in one.predicted)
        print(f"{one.row['interface']:18} {one.row['id']:26} published {one.low:6.3g} to {one.high:6.3g}  predicted {ends}")
    with (contacts.HERE / "results.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerows([COLUMNS, *(one.as_row() for one in found)])
    FILE.write_text(json.dumps(_by_state(found), indent=1) + "\n", encoding="utf-8")
    for level in (0.5, 0.9):
        print(f"{level:.0%} interval holds {np.mean([one.holds(level) for one in found]):.0%} of {len(found)} contacts")
    print(f"published range overlaps the 90 % interval: {np.mean([one.overlaps for one in found]):.0%}")
    widths = [one.width for one in found]
    middle, narrow = np.median(widths), np.mean(np.less(widths, 10))
    print(f"width of the 90 % interval: a factor {middle:.2g} in the median, below 10 in {narrow:.0%}")


if __name__ == "__main__":
    main()
