"""Measure the errors of the methods of finding asperities on Gaussian surfaces; write docs/explanation/asperity-errors.md
anew. About half a minute.

    python docs/measure_summits.py
"""

import re
from pathlib import Path

import numpy as np

from stiction.surfaces.finding import asperities, methods
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.prepare import level
from stiction.surfaces.targets import GaussianCorrelation, SelfAffine

PAGE = Path(__file__).parent / "explanation" / "asperity-errors.md"

WAVE = 100e-9  # the unit of length: shortest wave of the one, correlation length of the other
TARGETS = {
    "self-affine": SelfAffine(hurst=0.8, rolloff=8.0 * WAVE, shortest=WAVE, deviation=0.1 * WAVE),
    "Gaussian autocorrelation": GaussianCorrelation(deviation=0.1 * WAVE, length=WAVE),
}
# (points to a wave, side of the map in waves): finer at one size, then larger at one fineness
ROWS = ((2, 64), (4, 64), (8, 64), (16, 64), (8, 16), (8, 32), (8, 128))
NUMBERS = ("σ", "R", "N")
SEEDS = range(8)


def measured(target, points: int, side: int) -> dict[str, np.ndarray]:
    """Errors in per cent of sigma, R and N by each method: (2, 3), their means over the seeds and the errors of these.

    The map is a quarter of a periodic one, levelled, so that its ends do not meet, as of a measured map.
    """
    count, size = points * side, side * WAVE
    found: dict[str, list] = {method: [] for method in methods()}
    for seed in SEEDS:
        whole = gaussian_surface((2 * count, 2 * count), (2.0 * size, 2.0 * size), target, seed)
        surface = level(whole.with_heights(whole.heights[:count, :count].copy(), "a quarter", (size, size)))
        for method, each in found.items():
            one = asperities(surface, method)
            each.append((one.deviation, one.radius, one.density))
    expected = np.array(target.moments.asperities())
    errors = {method: 100.0 * (np.array(each) / expected - 1.0) for method, each in found.items()}
    return {
        method: np.array([each.mean(axis=0), each.std(axis=0, ddof=1) / len(SEEDS) ** 0.5]) for method, each in errors.items()
    }


def lines(target, points: int, side: int) -> list[str]:
    """The three rows of a table that are about one fineness and size."""
    found = measured(target, points, side)
    return [
        f"| {points} | {side} | {name} | " + " | ".join(cell(*found[method][:, k]) for method in methods()) + " |"
        for k, name in enumerate(NUMBERS)
    ]


def cell(error: float, uncertainty: float) -> str:
    digits = 1 if abs(error) < 9.95 else 0
    return f"{error:+.{digits}f} ± {uncertainty:.1f}".replace("-", "−")


def table(target) -> str:
    head = f"| points to a wave | side | | {' | '.join(f'`{method}`' for method in methods())} |"
    rows = [line for points, side in ROWS for line in lines(target, points, side)]
    return "\n".join([head, "|---|---|---|" + "---|" * len(methods()), *rows])


if __name__ == "__main__":
    text = PAGE.read_text(encoding="utf-8")
    for name, target in TARGETS.items():
        marks = rf"(<!-- errors, {name}: begin[^\n]*-->\n).*?(<!-- errors, {name}: end -->)"
        fresh = table(target)
        print(f"{name}\n{fresh}")
        text = re.sub(marks, lambda found, fresh=fresh: f"{found[1]}{fresh}\n{found[2]}", text, flags=re.DOTALL)
    PAGE.write_text(text, encoding="utf-8")
