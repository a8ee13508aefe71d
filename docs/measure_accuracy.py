"""Measures the errors that docs/explanation/numerics.md states, and writes its table anew. Takes less than a minute.

python docs/measure_accuracy.py
"""

import re
import sys
from pathlib import Path

import numpy as np

from stiction.engine import summation
from stiction.engine.heights import gaussian
from stiction.solving.problem import Choice, problem_of

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "tests"))
from tables import column, groups, groups_of, load_size, random_groups, read  # noqa: E402

KINDS = [(variant, coated) for variant in ("corrected", "published") for coated in (False, True)]
RULES = ((8, 16), (16, 32), (24, 40), (24, 48), (24, 56), (32, 64))  # the kernels take multiples of eight
LAWS = 50_000
REFERENCE_NODES = (160, 160)


def straight_rules(counts):
    """Gauss-Legendre without the map t + 0.3 t (1 - t)."""
    rules = np.zeros((len(counts), 2, max(counts)))
    for rule, count in zip(rules, counts, strict=True):
        nodes, weights = np.polynomial.legendre.leggauss(count)
        rule[:, :count] = (nodes + 1.0) / 2.0, weights / 2.0
    return rules


def totals(regimes, h, counts, rules=summation._make_rules):
    """Load, area and resistance with these numbers of nodes."""
    kept = summation._COUNTS, summation._RULES
    summation._COUNTS, summation._RULES = np.array(counts), rules(np.array(counts))
    try:
        sums = summation.scattered(regimes, h, gaussian()).sum(axis=0)
    finally:
        summation._COUNTS, summation._RULES = kept
    return sums[:, 1], sums[:, 2], sums[:, 3] + sums[:, 4]


def worst(found, expected, sizes):
    """Largest error over size, of any of the three; sizes below 1e-290 are left out."""
    errors = []
    for one, true, size in zip(found, expected, sizes, strict=True):
        errors.append(np.max(np.abs(one - true)[size > 1e-290] / size[size > 1e-290]))
    return max(errors)


def regimes_of(group, variant):
    return problem_of(group, Choice(options={"variant": variant})).regimes


def table_cases():
    """The 376 rows of reference/paper_model_own.csv: regimes, separations, true values, their sizes."""
    for variant, coated in KINDS:
        rows = [row for row in read("paper_model_own.csv") if (row["formulation"], bool(row["n_E"])) == (variant, coated)]
        expected = [column(rows, name) for name in ("load", "area", "friction")]
        sizes = [column(rows, "abs_load"), *expected[1:]]
        yield regimes_of(groups_of(rows), variant), column(rows, "h"), expected, sizes


def random_cases(coated):
    """Random laws of the whole range; the true values are those of many nodes."""
    rng = np.random.default_rng(2015)
    for variant in ("corrected", "published"):
        group = groups(**random_groups(rng, LAWS, coated))
        h = rng.uniform(-6.0, 8.0, LAWS)
        regimes = regimes_of(group, variant)
        expected = totals(regimes, h, REFERENCE_NODES)
        film = (group.film().theta, group.n_E) if coated else ()
        yield regimes, h, expected, [load_size(*expected[:2], group.theta, *film), *expected[1:]]


def table() -> str:
    cases = [list(table_cases()), list(random_cases(False)), list(random_cases(True))]
    lines = [
        "| nodes | positions | 376 reference values | random, bare | random, with a film |",
        "|---|---|---|---|---|",
    ]
    for counts in RULES:
        for name, rules in (("unchanged", straight_rules), ("shifted", summation._make_rules)):
            cells = []
            for case in cases:
                errors = [worst(totals(regimes, h, counts, rules), true, sizes) for regimes, h, true, sizes in case]
                cells.append(f"{max(errors):.0e}")
            lines.append(f"| {counts[0]} / {counts[1]} | {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


if __name__ == "__main__":
    page = HERE / "explanation" / "numerics.md"
    text = page.read_text(encoding="utf-8")
    marks = r"(<!-- accuracy: begin[^\n]*-->\n).*?(<!-- accuracy: end -->)"
    fresh = table()
    print(fresh)
    page.write_text(re.sub(marks, lambda found: f"{found[1]}{fresh}\n{found[2]}", text, flags=re.DOTALL), encoding="utf-8")
