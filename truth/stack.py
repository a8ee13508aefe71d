"""Weigh area laws by stacking on the set of solved surfaces, and write the weights that a prediction combines them by.

    python truth/stack.py

Of every surface and load the laws are asked for ln of the area, each corrected by its errors on the surfaces of other designs,
as a prediction corrects it (studies/prediction/area). The weights have the largest mean log of the density that the mixture
gives to the solved area (Yao and others 2018); every kind of surface counts as much as another. Laws that say the same within
2 % are one law, known by the first of their names. Laws are left out as long as the score falls by less than .02 in all: each
costs time at every prediction.
"""

import json
import math
from pathlib import Path

import numpy as np

from stiction.records.record import of_kind
from stiction.records.registry import RoughSurface
from stiction.solving.accuracy.benchmark_set import OF_KIND, BenchmarkSet, benchmark_set
from stiction.solving.accuracy.errors_near import NORMAL_SCORES, quantiles
from stiction.solving.accuracy.solved_near import ContactFeatures, differences, squared_distance
from stiction.studies.prediction.area_weights import FILE

_SAME = 0.02  # rms difference of ln of the area of two laws that say the same
_FLOWS = 0.05  # rms of ln of the area of Gaussian surfaces, over the load over the hardness, where all flows
_NEEDED = 0.02  # loss of the score up to which a law is left out
_ANSWERS = 0.97  # share of the solved areas that a law must have an answer for
_SHARPEST = 0.015  # standard deviation of what the solved areas are known to
_LIKE_NO_OTHER = 0.42  # standard deviation where no solved surface is near, as in a prediction
_METHODS = {**dict.fromkeys(("numbers", "shape", "kind"), ("mccool", "moments")), "map": ("map", "moments")}
_STEPS = 300


def densities(known: BenchmarkSet, errors: np.ndarray, seen: str) -> np.ndarray:
    """Return ln of the density (s, h, p) that a law gives to the solved areas, corrected by its errors on other designs.

    errors: ln(A/solved A) (s, h, p). seen: what is known of the surface, "numbers", "shape" (in numbers), "kind" or "map".
    """
    near = np.exp(-0.5 * _squared(known, seen)) * _others(known)
    if seen == "kind":
        near *= _kinds(known)[:, None] == _kinds(known)[None, :]
    found = np.full(errors.shape, np.nan)
    for at in np.ndindex(*errors.shape[1:]):
        values = errors[(slice(None), *at)]
        there = np.isfinite(values)
        weights = near[:, there]
        surfaces = np.flatnonzero(there & (weights.sum(axis=1) > 1e-6))
        if not surfaces.size:
            continue
        levels = quantiles(np.broadcast_to(values[there], (len(surfaces), there.sum())), weights[surfaces])
        found[(surfaces, *at)] = [_robust(value, row) for value, row in zip(values[surfaces], levels, strict=True)]
    return found


def _robust(value: float, levels: np.ndarray) -> float:
    """Return ln of the density where one surface in fifty is like no other, so that no single one decides."""
    wide = _log_normal(value, levels[2], _LIKE_NO_OTHER)
    return float(np.logaddexp(math.log(0.98) + log_density(value, levels), math.log(0.02) + wide))


def _log_normal(value: float, middle: float = 0.0, deviation: float = 1.0) -> float:
    """Return ln of the normal density; scipy's takes twenty times as long for one number."""
    return -0.5 * ((value - middle) / deviation) ** 2 - math.log(deviation * math.sqrt(2.0 * math.pi))


def log_density(value: float, levels: np.ndarray) -> float:
    """Return ln of the density at a value of the distribution with these quantiles at errors_near.LEVELS."""
    levels = levels[2] + np.sign(NORMAL_SCORES) * np.hypot(levels - levels[2], _SHARPEST * np.array(NORMAL_SCORES))
    slopes = np.diff(levels) / np.diff(NORMAL_SCORES)
    beyond = (levels[-1] - levels[0]) / (NORMAL_SCORES[-1] - NORMAL_SCORES[0])
    if value < levels[0]:
        return float(_log_normal(NORMAL_SCORES[0] + (value - levels[0]) / beyond) - np.log(beyond))
    if value > levels[-1]:
        return float(_log_normal(NORMAL_SCORES[-1] + (value - levels[-1]) / beyond) - np.log(beyond))
    at = int(np.clip(np.searchsorted(levels, value) - 1, 0, len(slopes) - 1))
    slope = max(slopes[at], 1e-3 * beyond)
    return float(_log_normal(np.interp(value, levels, NORMAL_SCORES)) - np.log(slope))


def stacked(scores: np.ndarray, counts: np.ndarray) -> np.ndarray:
    """Return the weights (k,) with the largest mean log density of the mixture, by expectation and maximisation.

    scores: ln of densities (n, k); counts: how much each of the n cases counts.
    """
    chances = np.exp(scores - scores.max(axis=1, keepdims=True))
    weights, counts = np.full(scores.shape[1], 1.0 / scores.shape[1]), counts / counts.sum()
    for _ in range(_STEPS):
        parts = chances * weights
        weights = counts @ (parts / parts.sum(axis=1, keepdims=True))
    return weights


def cases(known: BenchmarkSet, seen: str) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Return the laws that count once, ln of their densities (n, k) on the solved areas that all answer, and the kinds of
    surface (n,) of these."""
    laws = _laws(known, _METHODS[seen])
    tables = np.stack([densities(known, known.errors(law), seen) for law in laws], axis=-1)
    every = np.isfinite(tables).all(axis=-1)
    return laws, tables[every], _kinds(known)[np.nonzero(every)[0]]


def alike(kinds: np.ndarray) -> np.ndarray:
    """Return how much each case (n,) counts where every kind counts as much as another."""
    names, which, number = np.unique(kinds, return_inverse=True, return_counts=True)
    return 1.0 / (number[which] * len(names))


def score(scores: np.ndarray, counts: np.ndarray, weights: np.ndarray) -> float:
    """Return the mean log density of the mixture."""
    most = scores.max(axis=1)
    return float(np.average(most + np.log(np.exp(scores - most[:, None]) @ weights), weights=counts))


def weighed(laws: list[str], scores: np.ndarray, counts: np.ndarray) -> list[dict]:
    """Return the laws that are needed, as the package reads them: those that hardly raise the score are left out one by one."""
    weights = stacked(scores, counts)
    best = score(scores, counts, weights)
    while len(laws) > 1:
        fewer = [np.delete(np.arange(len(laws)), at) for at in range(len(laws))]
        others = [stacked(scores[:, some], counts) for some in fewer]
        reached = [score(scores[:, some], counts, one) for some, one in zip(fewer, others, strict=True)]
        at = int(np.argmax(reached))
        if best - reached[at] > _NEEDED:
            break
        laws, scores, weights = [laws[one] for one in fewer[at]], scores[:, fewer[at]], others[at]
    print(f"mean log score {score(scores, counts, weights):.4f}, of all {best:.4f}")
    return [_row(laws[at], weights[at]) for at in np.argsort(-weights)]


def _row(law: str, weight: float) -> dict:
    """Return a law of rough surfaces, or the sum over asperities of a law of one asperity, with its weight."""
    key = law.split("|")[0]
    of_surfaces = key in of_kind(RoughSurface)
    model, asperity = (key, None) if of_surfaces else ("greenwood_williamson_1966", key)
    return {"model": model, "asperity": asperity, "weight": round(float(weight), 3)}


def _laws(known: BenchmarkSet, methods: tuple[str, ...]) -> list[str]:
    solved, found = np.isfinite(known.areas), []
    if "map" in methods:
        solved &= np.isfinite(known.errors("persson_widened|map"))
    columns = sorted(known["columns"], key=lambda name: (not name.startswith("persson_widened|map"), name))
    for column in columns:
        errors = known.errors(column)
        if column.split("|")[1] not in methods or np.isfinite(errors[solved]).mean() < _ANSWERS:
            continue
        if column.startswith("soft_coating_2015"):  # a model of adhesion, here without
            continue
        if not _yields(known, errors):
            continue
        if all(np.sqrt(np.nanmean((errors - known.errors(one)) ** 2)) > _SAME for one in found):
            found.append(str(column))
    return found


def _yields(known: BenchmarkSet, errors: np.ndarray) -> bool:
    """Return whether the area of a law tends to the load over the hardness where spots flow."""
    softest = int(np.argmin(known["hardnesses"]))
    of_gaussian = errors[known.gaussian, softest]
    return bool(np.sqrt(np.nanmean(of_gaussian**2)) < _FLOWS)


def _kinds(known: BenchmarkSet) -> np.ndarray:
    """Return the kind of every surface as a contact states it."""
    return np.array([next(kind for kind, names in OF_KIND.items() if one in names) for one in known["kinds"]])


def _squared(known: BenchmarkSet, seen: str) -> np.ndarray:
    """Return the squared distance (s, s) of each surface from every other, by what is seen of it."""
    rows, one = [], np.ones(1)
    for at in range(len(known["surfaces"])):
        names = ("alpha", "skewness", "kurtosis", "lay", "top")
        alpha, skewness, kurtosis, lay, top = (float(known.feature(name)[at]) for name in names)
        stated = {"skewness": skewness, "kurtosis": kurtosis, "texture_aspect_ratio": 1.0 / lay}
        shape = (skewness, lay, top) if seen == "map" else None
        place = ContactFeatures(one, one, alpha * one, shape, stated=stated if seen == "shape" else {})
        rows.append(squared_distance(differences(known, place))[0])
    return np.array(rows)


def _others(known: BenchmarkSet) -> np.ndarray:
    """Return whether two surfaces (s, s) are of different designs: those of one differ by their seed alone."""
    designs = np.array([name.rsplit("_s", 1)[0] for name in known["surfaces"]])
    return designs[:, None] != designs[None, :]


def main() -> None:
    known, weights = benchmark_set(), {}
    for seen in _METHODS:
        laws, scores, kinds = cases(known, seen)
        weights[seen] = weighed(laws, scores, alike(kinds))
        print(seen, len(laws), "laws", len(scores), "areas:", weights[seen], flush=True)
    Path(FILE).write_text(json.dumps(weights, indent=2) + "\n")


if __name__ == "__main__":
    main()
