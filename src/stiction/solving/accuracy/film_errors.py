"""Look up the measured error of a film law for a contact, as data, as text, or as errors at points.

The errors were measured on elastic contacts without adhesion: on one sphere against the exact solution, and on rough surfaces
against layered boundary elements (`solving/accuracy/film_tables`). They are looked up by two ratios: film modulus divided by
substrate modulus, and mean contact radius, or shortest wavelength, divided by film thickness.
"""

import json
import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from stiction.quantities.quotient import quotient
from stiction.quantities.shown import span
from stiction.solving.accuracy.benchmark_set import BenchmarkSet, benchmark_set
from stiction.solving.accuracy.errors_near import NORMAL_SCORES, ErrorsNear, bare_errors, film_errors_near, no_words
from stiction.solving.accuracy.film_tables import MEASURED, MEASURED_ON_MAPS, MapFilmErrors, on_a_sphere, on_maps
from stiction.solving.accuracy.solved_near import FILM_SCALES, ContactFeatures
from stiction.solving.problem import Problem

SPHERE, MAPS = "exact sphere on a film, elastic", "rough surfaces on a film by boundary elements, elastic"
_MAPS = 10
_ROUNDING = 1e-3  # relative round-off accepted at the ends of the measured ranges
_BARE, _ON_FILM = "persson_widened|moments", "rough_on_film|moments"  # area laws without and with a film
_FLOWS = "unknown for films that flow plastically: no reference solution includes squeezing-out of the film"


def film_errors(problem: Problem, results: Mapping[str, np.ndarray]) -> list[dict[str, Any]]:
    """Return the measured errors of the film law for these results, as a list of dictionaries.

    results: normalised arrays by name, with the dimensions of the contacts first. Keys of a dictionary: law; against: the
    reference solution; error: lowest and highest relative error of the area at a given load; load_error: lowest and highest
    relative error of the load at a given approach; rms: root mean square of the error of ln(area) on rough surfaces; near:
    range of each parameter used to look up the error; outside: parameters beyond the measured range; why_not: the reason if no
    error is known. Keys that do not apply are absent. The list is empty for a contact without a film law.
    """
    law = problem.chosen.film or (problem.record if problem.record.on_film else None)
    if law is None:
        return []
    rows = [row for row in (_of_sphere(problem, law.key, results), _of_maps(problem, law.key)) if row]
    return rows or [{"law": law.key, "against": SPHERE, "why_not": _FLOWS}]


def _of_sphere(problem: Problem, law: str, results: Mapping[str, np.ndarray]) -> dict[str, Any]:
    width = a_over_t(problem, results)
    if width is None:
        return {}
    n_E = np.broadcast_to(problem.groups.n_E[:, None], width.shape)
    found = on_a_sphere(law, problem.options, n_E, width, _over_radius(problem))
    if found is None:
        return {}
    row = _row({"law": law, "against": SPHERE}, MEASURED, {"n_E": n_E, "a_over_t": width}, found.area, "nothing touches")
    return row | ({"load_error": _ends(found.load - 1.0)} if "error" in row else {})


def _of_maps(problem: Problem, law: str) -> dict[str, Any]:
    found, given = _on_maps(problem, law)
    if found is None:
        return {}
    row = _row({"law": law, "against": MAPS}, MEASURED_ON_MAPS, given, found.mean, "not measured there")
    return row | ({"rms": float(np.nanmax(found.rms))} if "error" in row else {})


def _row(head: dict, ranges: Mapping, given: Mapping[str, np.ndarray], ratio: np.ndarray, nothing: str) -> dict[str, Any]:
    """Return one dictionary of `film_errors`.

    head: the entries `law` and `against`. ranges: measured range of each parameter. given: values of these parameters, by
    name. ratio: computed area divided by exact area. nothing: the reason to state if no error is known and no parameter is
    out of range.
    """
    row, outside = head | {"near": {name: _ends(values) for name, values in given.items()}}, _outside(ranges, given)
    if np.isnan(ratio).all():
        return row | {"why_not": outside or nothing}
    return row | {"error": _ends(ratio - 1.0)} | ({"outside": outside} if outside else {})


def _on_maps(problem: Problem, law: str) -> tuple[MapFilmErrors | None, dict[str, np.ndarray]]:
    """Return the errors of a film law on rough surfaces, and the parameters by which they were looked up, by name.

    law: key of the film law. The errors are None if they are unknown.
    """
    groups = problem.groups.resolved()
    if groups.roughness_parameter is None or groups.film_aspect is None:
        return None, {}
    from stiction.laws.rough_surface.rough_on_film import thickness_over_wave  # only coated contacts need this

    given = {"n_E": groups.n_E, "thickness_over_shortest_wave": thickness_over_wave(groups)}
    return on_maps(law, problem.options, *given.values()), given


# Descriptions of the parameters by which errors are looked up.
_WORDS = {
    "n_E": "film modulus over the modulus of the bodies",
    "a_over_t": "mean contact radius over film thickness",
    "thickness_over_shortest_wave": "film thickness over the shortest wavelength of the surface",
}


def _outside(ranges: Mapping[str, tuple[float, float]], given: Mapping[str, np.ndarray]) -> str:
    """Describe the parameters with values outside their measured range; return "" if there is none.

    ranges, given: measured range and values of each parameter, by name.
    """
    texts = []
    for name, (low, high) in ranges.items():
        known = given[name][np.isfinite(given[name]) & (given[name] > 0.0)]
        beyond = known[(known < low / (1.0 + _ROUNDING)) | (known > high * (1.0 + _ROUNDING))]
        if beyond.size:
            share = "" if beyond.size == known.size else f" at {beyond.size} of {known.size} points"
            texts.append(f"{_WORDS[name]} is {span(_ends(beyond))}{share}, but measured only from {low:g} to {high:g}")
    return "; ".join(texts)


def on_solved_maps(problem: Problem, points: int) -> ErrorsNear | None:
    """Return the errors of the area law for films, measured on rough surfaces with similar films; None for other models.

    The result is also None if the roughness parameter is unknown. points: number of loads of each contact, which all get the
    same errors. Source: truth/films.csv. A film thinner or thicker than the measured films gets the errors at the end of the
    measured range, because the law then approaches the law of the bare body or of the film alone. A film modulus outside the
    measured range also gets the errors at the end of the range, but the result then has a larger `distance`.
    """
    groups = problem.groups.resolved()
    if not problem.record.on_film or groups.roughness_parameter is None or groups.film_aspect is None:
        return None
    from stiction.laws.rough_surface.rough_on_film import thickness_over_wave  # only coated contacts need this

    modulus, thickness = (
        np.clip(values, *MEASURED_ON_MAPS[name])
        for name, values in (("n_E", groups.n_E), ("thickness_over_shortest_wave", thickness_over_wave(groups)))
    )
    found = on_maps(problem.record.key, problem.options, *np.broadcast_arrays(modulus, thickness))
    if found is None:
        return None
    middle, distance = np.log(found.mean), np.abs(np.log(groups.n_E / modulus)) / FILM_SCALES[0]
    levels = middle[:, None] + np.array(NORMAL_SCORES) * found.rms[:, None]
    nearest = np.full(distance.shape, no_words)  # no surface is nearest, because errors are looked up by film alone
    count = np.full(distance.shape, _MAPS)
    each = levels, np.expm1(found.rms), middle, distance + 0.0 * middle, np.ones_like(middle), count, nearest
    return ErrorsNear(*(np.repeat(np.broadcast_to(one, (len(middle), *one.shape[1:])), points, axis=0) for one in each))


def on_other_kinds(problem: Problem, features: ContactFeatures, found: ErrorsNear, area: np.ndarray) -> ErrorsNear:
    """Return the errors of the area law for films on a surface that may be non-Gaussian, for a contact without a map.

    features: features of the contact at k points. found: errors of the law on Gaussian surfaces. area: normalised contact area.
    Two further errors widen the distribution of `found`. The first is the error of the law for bare surfaces of all kinds. It
    is taken for a bare surface that has the same elastic area (Persson 2001) as the contact, and the same yielded fraction of
    this area; its pressure and hardness follow from these. The second is the additional error due to a film, from the
    benchmark surfaces with films; it is omitted for the kind "gaussian". If the kind is known, both also shift the mean.
    """
    from stiction.surfaces.theory.widened_area import MEETING

    elastic, flowing = shares_on_film(problem, features, area)
    pressure = _pressure_of(elastic)
    with np.errstate(divide="ignore", invalid="ignore"):
        hardness = np.where(flowing > 0.0, pressure / flowing, np.inf)
        of_elastic = np.nan_to_num(1.0 / (1.0 + (flowing / elastic) ** MEETING))
    loaded = np.asarray(features.pressure) > 0.0
    bare_features = replace(features, pressure=np.where(loaded, pressure, features.pressure), hardness=hardness)
    bare = bare_errors(benchmark_set(), _BARE, bare_features, anywhere=False)
    if bare is None:
        return found
    apart, shift = [errors.levels - errors.middle[:, None] for errors in (found, bare)], bare.middle
    beyond = _beyond_bare(benchmark_set())
    if beyond is not None and features.kind != "gaussian":  # for Gaussian surfaces the film law itself was measured
        more = film_errors_near(benchmark_set(), beyond, features, np.ones(loaded.shape, dtype=bool))
        middle = np.nan_to_num(more.middle) * of_elastic
        levels = np.nan_to_num(more.levels) * of_elastic[:, None]
        apart.append(levels - middle[:, None])
        shift = shift + middle
    middle = np.where(loaded, found.middle + shift if features.kind_known else found.middle, np.nan)  # NaN without contact
    largest = np.take_along_axis(np.array(apart), np.abs(apart).argmax(axis=0)[None], axis=0)[0]
    levels = middle[:, None] + np.sign(largest) * np.sqrt(np.sum(np.square(apart), axis=0))
    relative = np.hypot(found.relative, bare.relative)
    return found._replace(middle=middle, levels=levels, relative=relative, surfaces=bare.surfaces)


def _pressure_of(share: np.ndarray) -> np.ndarray:
    """Return the pressure divided by E* h' at which a bare elastic surface has the area fraction `share` (Persson 2001).

    E*: contact modulus. h': rms slope. share: an array of any shape; the result has the same shape.
    """
    from scipy.special import erfinv

    return erfinv(share) / math.sqrt(2.0)


@cache
def _beyond_bare(known: BenchmarkSet) -> np.ndarray | None:
    """Return the errors of the area law for films minus those of the law for bare surfaces, on benchmark surfaces with films.

    Errors are ln(A/A_ref), where A is the area by the law and A_ref the area by the reference solution; the array is (coated
    surfaces, films, loads). The bare-surface errors are interpolated to the pressure at which, according to Persson (2001), a
    bare surface has the contact area that the film law computes. The result is None if the set has no such errors.
    """
    errors, bare = known.film_errors(_ON_FILM), known.errors(_BARE)
    if errors is None or bare is None:
        return None
    pressure = np.log(_pressure_of(np.minimum(np.exp(errors) * known["film_areas"], 1.0 - 1e-9)))
    of_bare = [
        np.interp(row, np.log(known["loads"]), bare[at, 0]) for at, row in zip(known["film_surfaces"], pressure, strict=True)
    ]
    return errors - np.array(of_bare)


def shares_on_film(problem: Problem, features: ContactFeatures, area: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return two ratios (k,): real to nominal area without plastic flow, and nominal pressure to flow pressure.

    The film law computes the area fraction as (first^m + second^m)^(1/m), with m = MEETING. features: features of the contact
    at k points. area: normalised contact area.
    """
    from stiction.laws.rough_surface.rough_on_film import elastic_share  # only coated contacts need this
    from stiction.surfaces.theory.widened_area import MEETING

    groups = problem.groups.resolved()
    share = np.minimum(math.pi * np.reshape(groups.roughness_parameter, (-1, 1)) * area, 1.0 - 1e-9)
    elastic = np.minimum(elastic_share(np.maximum(features.pressure, 0.0).reshape(share.shape), groups), share)
    return elastic.ravel(), ((share**MEETING - elastic**MEETING) ** (1.0 / MEETING)).ravel()


def a_over_t(problem: Problem, results: Mapping[str, np.ndarray]) -> np.ndarray | None:
    """Return the ratio (n, m) of an asperity's mean contact radius to the thickness of one film, for n contacts at m points.

    results: normalised arrays by name. The result is None for a bare contact or a model without single asperities. It is 0
    if the film thickness divided by the asperity size is unknown, because such a film counts as infinitely thick.
    """
    groups = problem.groups.resolved()
    if "touching_asperities" not in results or groups.film_aspect is None:
        return None
    area, touching = (np.asarray(results[name]).reshape(len(groups), -1) for name in ("contact_area", "touching_asperities"))
    mean = quotient(area, touching)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.sqrt(np.maximum(mean, 0.0)) * (groups.films / groups.film_aspect)[:, None]


def _over_radius(problem: Problem) -> np.ndarray:
    """Return the ratio (n, 1) of film thickness to asperity radius, computed from two other dimensionless groups.

    With thickness t, radius R and rms height sigma it equals (t/sqrt(R sigma))^2/(t/sigma). If it is unknown, 1 is
    returned, which is far outside the measured range.
    """
    found = quotient(problem.groups.film_aspect**2, problem.groups.tau)
    return np.where(np.isfinite(found) & (found > 0.0), found, 1.0)[:, None]


def _ends(values: np.ndarray) -> list[float]:
    known = values[np.isfinite(values)]
    return [float(known.min()), float(known.max())] if known.size else []


def as_attributes(problem: Problem, results: Mapping[str, np.ndarray]) -> dict[str, str]:
    """Return the measured errors of the film law as one attribute of a result, a JSON text, which a netCDF file can store."""
    return {"measured_film_error": json.dumps(film_errors(problem, results))}


def in_words(row: Mapping[str, Any]) -> str:
    """Describe one dictionary of `film_errors` in one line of text."""
    near = ", ".join(f"{name} = {span(ends)}" for name, ends in row.get("near", {}).items() if ends)
    head = f"{row['law']} against {row['against']}" + (f", near {near}" if near else "")
    if "why_not" in row:
        return f"{head}: {row['why_not']}"
    parts = [f"area {span(row['error'], '+.0%')} at given load"]
    parts += [f"load {span(row['load_error'], '+.0%')} at given approach"] if "load_error" in row else []
    parts += [f"off by {row['rms']:.2g} in ln(area), rms"] if "rms" in row else []
    parts += [f"unknown where {row['outside']}"] if "outside" in row else []
    return f"{head}: {', '.join(parts)}"
