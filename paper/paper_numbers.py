"""The numbers of paper.md: each is computed here, from the package, its set of solved surfaces and its documentation.

    python paper/paper_numbers.py    # writes them into paper.md

A number of the text stands in one of PHRASES; a test asks that they are what is computed, and that the text has no others.
"""

import csv
import math
import re
from pathlib import Path

import numpy as np

import stiction as st
from stiction.records.registry import AsperityLaw, FilmLaw, RoughSurface, TangentialLaw, of_kind
from stiction.solving.accuracy.benchmark_set import BenchmarkSet, benchmark_set

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
PAPER = HERE / "paper.md"
SPHERE = ROOT / "src" / "stiction" / "solving" / "accuracy" / "film_errors_on_a_sphere.csv"
# p/(E* h') of which root mean squares are taken, as in docs/truth.md.
LIGHT, HEAVY = 0.002, 0.3
_NUMBER = r"(?:\d+(?:\.\d+)?|\{\w+\})"  # or a name, where it was never written
PHRASES = (
    "{asperity} laws for the normal load on an asperity, {tangential} laws for its tangential strength, {film} laws for films "
    "and {rough} models of a whole rough surface",
    "Each of {departures} departures",
    "is {mu_published} in the first variant and {mu_corrected} in the second",
    "A set of {surfaces} surfaces of {kinds} kinds",
    "was solved at {loads} mean pressures each",
    "the root mean square error is {rms_gw} % for sums of Hertz contacts",
    "{rms_bgt} % for the theory of @bush_gibson_thomas_1975, {rms_persson} % for that of @persson_2001 and {rms_yang} % for "
    "its correction",
    "its area is within {rms_held} % of the solved one in the root mean square, and within 5 % in {within_held} % of the cases",
    "the law of the 2015 paper is off by {film_load} % in load",
    "a root mean square error of {rms_skewed} % on the skewed surfaces of the set, and of {rms_worn} % on the worn ones",
    "are still {film_low} to {film_high} % off on rough maps",
)


def numbers() -> dict[str, str]:
    """Name -> as it is written."""
    kinds = {"asperity": AsperityLaw, "tangential": TangentialLaw, "film": FilmLaw, "rough": RoughSurface}
    known = benchmark_set()
    found = {name: str(len(of_kind(kind))) for name, kind in kinds.items()}
    theory = (ROOT / "docs" / "explanation" / "theory-limits.md").read_text(encoding="utf-8")
    found["departures"] = str(len(re.findall(r"^\| D\d+ \|", theory, re.MULTILINE)))
    for variant in ("published", "corrected"):
        load, _, friction = st.evaluate(1.0, 40.0, 10.0, variant=variant)
        found[f"mu_{variant}"] = f"{float(friction) / float(load):.2f}"
    found |= {"surfaces": str(known["kinds"].size), "kinds": str(len(set(known["kinds"].tolist())))}
    found["loads"] = str(known["loads"].size)
    return found | errors(known) | on_films(known) | {"film_load": film_load()}


def errors(known: BenchmarkSet) -> dict[str, str]:
    """Root mean square errors of elastic areas in per cent: of Gaussian isotropic surfaces, of those held out, of others."""
    columns = {"gw": "greenwood_williamson_1966|mccool", "bgt": "bush_gibson_thomas_1975|moments"}
    columns |= {"persson": "persson_2001|moments", "yang": "yang_persson_2008|moments"}
    found = {f"rms_{name}": _root(relative(known, column)[known.gaussian]) for name, column in columns.items()}
    own = relative(known, "persson_widened|moments")
    held = own[known.gaussian & known["held_out"]]
    found |= {"rms_held": _root(held), "within_held": f"{100.0 * np.mean(np.abs(held) < 0.05):.0f}"}
    return found | {f"rms_{kind}": _root(own[known["kinds"] == kind]) for kind in ("skewed", "worn")}


def relative(known: BenchmarkSet, column: str) -> np.ndarray:
    """Relative error of the elastic area (surfaces, pressures from LIGHT to HEAVY)."""
    found = known.errors(column)
    assert found is not None
    return np.expm1(found[:, 0, (known["loads"] >= LIGHT) & (known["loads"] <= HEAVY)])


def on_films(known: BenchmarkSet) -> dict[str, str]:
    """The least and the largest error of sums over asperities on the exactly solved film, by modulus of the film."""
    found = known.film_errors("layered|mccool")
    assert found is not None
    off = np.expm1(found)
    roots = [math.sqrt(float(np.nanmean(off[:, known["films"][:, 0] == one] ** 2))) for one in np.unique(known["films"][:, 0])]
    return {"film_low": f"{100.0 * min(roots):.0f}", "film_high": f"{100.0 * max(roots):.0f}"}


def film_load() -> str:
    """Error in % of the sequential film's load at a given approach: half the modulus, a contact radius of a thickness."""
    with SPHERE.open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if (row["law"], row["n_E"], row["a_over_t"]) == ("sequential", "0.5", "1")]
    thinnest = min(rows, key=lambda row: float(row["thickness_over_radius"]))
    return f"{100.0 * abs(float(thinnest['load']) - 1.0):.0f}"


def _root(error: np.ndarray) -> str:
    value = 100.0 * math.sqrt(float(np.nanmean(error**2)))
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def place_of(phrase: str) -> re.Pattern[str]:
    """A phrase in the text, whatever its numbers and wherever its lines break; its groups are the words between numbers."""
    return re.compile("".join(_NUMBER if one[0] == "{" else f"({_words(one)})" for one in _parts(phrase)))


def _parts(phrase: str) -> list[str]:
    return [one for one in re.split(r"(\{\w+\})", phrase) if one]


def _words(text: str) -> str:
    return r"\s+".join(map(re.escape, text.split(" ")))


def renewed(text: str) -> str:
    """The text with the numbers that are computed; lines break where they did."""
    found = numbers()
    for phrase in PHRASES:
        place = place_of(phrase).search(text)
        if place is None:
            raise ValueError(f"paper.md has no {phrase!r}")
        words = iter(place.groups())
        whole = "".join(found[one[1:-1]] if one[0] == "{" else next(words) for one in _parts(phrase))
        text = text[: place.start()] + whole + text[place.end() :]
    return text


if __name__ == "__main__":
    PAPER.write_text(renewed(PAPER.read_text(encoding="utf-8")), encoding="utf-8")
