"""Compute dimensionless numbers that describe the state of a loaded contact.

The validity conditions of all models use these numbers. They are computed from results per asperity and the dimensionless
groups. With the units of section 1 of theory.md, K = 4 E*/3 and eta = pi H sqrt(R/sigma)/K, the load of an asperity is P = K
R^(1/2) sigma^(3/2) p and its area A = pi R sigma a (E*: contact modulus, H: hardness, R: asperity radius, sigma: rms height),
so  A/A_n       = pi N R sigma a
    P/(A_n H)   = pi N R sigma p / eta
    P/(A H)     = p / (a eta)
    N A_n       = N R sigma (A_n/sigma^2) (sigma/R)
    A/(n A_c)   = a / (share omega_c/sigma)

A_n is the nominal area and N the asperity density. n = share N A_n asperities touch. A_c = pi R omega_c is the area of one
asperity at first yield, and omega_c its interference (Chang, Etsion & Bogy 1987).
"""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.indices import Groups
from stiction.contact.subject import Subject
from stiction.laws.asperity.chang_etsion_bogy_1987 import critical_interference, hardness_coefficient
from stiction.quantities.quotient import quotient
from stiction.solvers.layered.below import pressure_carried_below
from stiction.solving.problem import Problem, number_of_asperities
from stiction.surfaces.theory.touching import expected_share

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap

# Largest pull-off force of a sphere, divided by gamma R (Derjaguin, Muller & Toporov 1975); the JKR theory gives 3/4 of it.
_DMT = 2.0 * math.pi
_MOST_GROWN = 100.0  # largest growth factor


def state_of(problem: Problem, results: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return dimensionless numbers for normalised results, by name, e.g. the mean pressure divided by the hardness.

    results: arrays with the dimensions of the contacts first. Each number is an array (n, m) for n contacts and m points. A
    number is absent if a group that it needs is unknown. Numbers that are relative to the load, such as adhesion_share, are NaN
    where the net load is not compressive.
    """
    groups = problem.groups
    n = len(groups)
    load, area = (np.asarray(results[name]).reshape(n, -1) for name in ("load", "contact_area"))
    touching = results.get("touching_asperities")
    share = None if touching is None else np.asarray(touching).reshape(n, -1)
    pulled = results.get("load_meniscus")
    wet = None if pulled is None else -np.asarray(pulled).reshape(n, -1)
    some = expected_share(area) if share is None else share
    state = _by_asperity(problem, load, area, share, some, _bearing(problem, load, results), wet)
    if groups.roughness_parameter is not None:
        density = math.pi * groups.roughness_parameter[:, None]
        state["area_fraction"] = area_fraction(groups, area)
        state["nominal_pressure_over_hardness"] = density * load / (groups.eta * _softest(groups))[:, None]
        count = number_of_asperities(groups)
        if count is not None:
            state["touching_asperities"] = count * some
    of_surface = _of_the_surface(groups) | (
        _of_attraction(groups, getattr(problem, "map", None)) if problem.record.adheres else {}
    )
    known = {} if problem.subject is None else of_the_map(problem.subject)
    of_map = {name: np.full((n, 1), value) for name, value in known.items()}
    return state | {name: value[:, None] for name, value in of_surface.items()} | of_map


def area_fraction(groups: Groups, area: np.ndarray) -> np.ndarray:
    """Return the ratio of real to nominal contact area (n, m) from normalised areas (n, m) of n contacts.

    The asperity density of the contacts must be known.
    """
    assert groups.roughness_parameter is not None
    return math.pi * groups.roughness_parameter[:, None] * area


def _of_the_surface(groups: Groups) -> dict[str, np.ndarray]:
    """Return the quantities (n,) of rough surface and film that do not depend on load, by name, without unknown quantities.

    The rms slope is sqrt(2 m2). The spectral moments m2 and m4 of a Gaussian surface follow from asperity radius R and density
    N by m4 = (3/8)^2 pi/R^2 and N = m4/(6 pi sqrt(3) m2) (Nayak 1971; McCool 1986).
    """
    quantities = {}
    if groups.sharpness is not None and groups.roughness_parameter is not None:
        slope_squared = 2.0 * (9.0 / 64.0) / (6.0 * math.sqrt(3.0)) / groups.roughness_parameter
        quantities["rms_slope"] = groups.sharpness * np.sqrt(slope_squared)
    if groups.sharpness is not None and groups.has_film and groups.film_aspect is not None:
        quantities["thickness_over_radius"] = groups.film_aspect * groups.sharpness
    if groups.has_film and groups.film_aspect is not None and groups.roughness_parameter is not None:
        from stiction.laws.rough_surface.rough_on_film import STIFF, thickness_over_wave  # only coated contacts need this

        whole = groups.resolved()
        quantities["stiff_film_over_wave"] = np.where(whole.n_E >= STIFF, thickness_over_wave(whole), np.nan)
    return quantities


def of_the_map(subject: Subject) -> dict[str, float]:
    """Return two numbers that describe how well a contact's map resolves and samples its surface, by name; {} without a map.

    They are points per shortest wavelength, and longest wavelengths per side. If the scans of both bodies cannot be
    combined into one map, each number is the smaller value of both scans.
    """
    surface = subject.with_surface_moments().map
    maps = [surface] if surface is not None else [] if subject.measured is None else subject.measured.solvable.filled()
    if not maps:
        return {}
    from stiction.solvers.boundary_elements.map_area import map_area  # only contacts with a map need this

    names = "points_in_shortest_wave", "longest_waves_on_a_side"
    return {name: min(getattr(map_area(surface).waves, name) for surface in maps) for name in names}


def _of_attraction(groups: Groups, surface: "HeightMap | None") -> dict[str, np.ndarray]:
    """Return adhesion quantities (n,) of n rough surfaces, by name.

    Theories without asperities use them. Without a Tabor parameter, only elastic_over_adhesion is returned. surface: the height
    map that the theory uses, or None.
    """
    from stiction.laws.criterion.pastewka_robbins_2014 import range_over_gap, stickiness
    from stiction.laws.criterion.persson_tosatti_2001 import elastic_over_adhesion

    quantities = {"elastic_over_adhesion": elastic_over_adhesion(groups, surface)}
    if groups.tabor_parameter is None:
        return quantities
    return quantities | {"range_over_gap": range_over_gap(groups), "stickiness_ratio": stickiness(groups)}


def _by_asperity(
    problem: Problem,
    load: np.ndarray,
    area: np.ndarray,
    share: np.ndarray | None,
    touching: np.ndarray,
    hardness: np.ndarray,
    pull_of_menisci: np.ndarray | None,
) -> dict[str, np.ndarray]:
    """Return the dimensionless numbers (n, m) that follow from results per asperity, by name.

    load, area: normalised, per asperity. share: fraction of asperities that touch, None if the model does not compute it.
    touching: this fraction or an estimate of it. hardness: hardness of the material that bears the load, divided by the
    hardness of the bodies. pull_of_menisci: normalised pull, or None.
    """
    groups = problem.groups
    compressed = np.where(load > 0.0, load, np.nan)
    pressure = quotient(load, groups.eta[:, None] * hardness * area)
    quantities = {"mean_pressure_over_hardness": pressure} | _grown(groups, pressure)
    if share is not None:
        quantities["touching_share"] = share
        if not groups.has_film:
            yielded = critical_interference(groups.eta, hardness_coefficient(groups.nu))[:, None]
            quantities["asperity_area_over_yield"] = quotient(area, share * yielded)
    quantities |= _below_film(groups, load, area, touching)
    quantities |= _of_menisci(groups, area, share, pull_of_menisci)
    per_theta = np.zeros(len(groups)) if groups.theta is None else _DMT / groups.theta  # 0 without a work of adhesion
    pull = per_theta if groups.n_g is None else per_theta * groups.n_g
    quantities["adhesion_share"] = pull[:, None] * touching / compressed
    if groups.meniscus_index is not None and groups.meniscus_height is not None:
        held = _held_by_menisci(touching, groups.meniscus_height[:, None])
        quantities["meniscus_share"] = (2.0 * math.pi / groups.meniscus_index)[:, None] * held / compressed
    return quantities


def _grown(groups: Groups, pressure: np.ndarray) -> dict[str, np.ndarray]:
    """Return {"grown_area_ratio": factor (n, m) by which junctions grow under shear until the interface fails}, or {}.

    The dict is empty if the strength of the bodies is unknown. The factor is (p/H)/sqrt(1 - c^2), at least 1, with the
    ratio c of interface strength to body strength (Tabor 1959); the root has a lower limit. pressure: mean contact pressure
    divided by hardness, p/H; values above 1 count as 1.
    """
    ratio = groups.strength_over_bodies
    if ratio is None:
        return {}
    left = np.sqrt(np.maximum((1.0 - ratio) * (1.0 + ratio), _MOST_GROWN**-2))
    return {"grown_area_ratio": np.maximum(np.clip(pressure, 0.0, 1.0) / np.reshape(left, (-1, 1)), 1.0)}


def _below_film(groups: Groups, load: np.ndarray, area: np.ndarray, touching: np.ndarray) -> dict[str, np.ndarray]:
    """Return the mean contact pressure (n, m) on hard films, divided by each of two limits, by name; {} without a hard film.

    load, area, touching: normalised load and area, and fraction of touching asperities. One limit is the pressure at which the
    body below the film yields. The other is the pressure that punches through the film, at most H_b + 2 (t/a) tau_f for a plug
    of radius a (upper-bound theorem of plasticity). H_b is the hardness of the body, t the film thickness and tau_f the shear
    strength of the film. The second limit also holds where the other body is softer. Values are NaN for contacts whose film is
    not harder than the body.
    """
    if groups.n_H is None or groups.film_aspect is None or not np.any(groups.n_H > 1.0):
        return {}
    spot = quotient(area, touching)
    carried = pressure_carried_below(spot, groups)
    pressure = quotient(load, groups.eta[:, None] * area)
    thickness = quotient(np.reshape(groups.film_aspect / groups.films, (-1, 1)), np.sqrt(spot))
    strength = groups.resolved().layer_n_H / (math.sqrt(3.0) * groups.hardness_to_yield)
    punching = 1.0 + 2.0 * thickness * np.reshape(strength, (-1, 1))
    hard = np.reshape(groups.n_H, (-1, 1)) > 1.0
    limits = {"pressure_over_body_below": carried, "pressure_over_punching": punching}
    return {name: np.where(hard, pressure / limit, np.nan) for name, limit in limits.items()}


def _held_by_menisci(touching: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Return the fraction of asperities (n, m) that would pull as much as all menisci together if each of them touched.

    An asperity with a gap below the height of the menisci pulls in proportion to (height - gap)/height. touching: fraction
    of asperities that would touch without liquid. height: height of a meniscus, in units of sigma. Heights are Gaussian.
    """
    from scipy.special import ndtr, ndtri  # only contacts with a liquid need this

    contact = -ndtri(np.clip(touching, np.finfo(float).tiny, 1.0 - 1e-16))

    def above(z: np.ndarray) -> np.ndarray:
        """Return the antiderivative of the fraction of asperities with heights above z, in units of sigma."""
        return z * ndtr(-z) - np.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)

    return (above(contact) - above(contact - height)) / height


def _of_menisci(groups: Groups, area: np.ndarray, share: np.ndarray | None, pull: np.ndarray | None) -> dict[str, np.ndarray]:
    """Return wetted fraction of the surface and ratio of asperity indentation to meniscus height, (n, m), by name.

    The result is empty without menisci. The wetted fraction is missing if the asperity density is unknown. area, share:
    normalised contact area and fraction of touching asperities. pull: meniscus pull, normalised (n, m). The pull is the Laplace
    pressure times the wetted area, so this area includes menisci that bridge a gap. Around elastic asperities the pull is
    smaller; each touching asperity then adds the ring 2 pi R 2 r c (asperity radius R, Kelvin radius r, mean cosine c of the
    contact angles). If the pull is at its upper limit, the Laplace pressure on the whole area without contact, it does not
    determine the bridged area; the area is then computed from Gaussian heights.
    """
    if groups.meniscus_height is None or groups.meniscus_index is None or share is None or pull is None:
        return {}
    height = groups.meniscus_height[:, None]
    quantities = {"penetration_over_meniscus": quotient(area, share * height)}
    if groups.roughness_parameter is not None:
        ring = 2.0 * math.pi * groups.roughness_parameter[:, None] * height
        bridged = np.maximum(pull * groups.meniscus_index[:, None] / (2.0 * math.pi), share)
        free = 1.0 - math.pi * groups.roughness_parameter[:, None] * area
        flooded = ring * bridged >= free * (1.0 - 1e-9)
        quantities["meniscus_coverage"] = ring * np.where(
            flooded, np.maximum(bridged, _held_by_menisci(share, height)), bridged
        )
    return quantities


def _softest(groups: Groups) -> np.ndarray | float:
    """Return the smaller of film hardness and body hardness, divided by the hardness of the bodies; 1 without a film."""
    return 1.0 if groups.n_H is None else np.minimum(groups.n_H, 1.0)


def _bearing(problem: Problem, load: np.ndarray, results: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the hardness (n, m) of the material that bears the load, divided by the hardness of the bodies.

    If a film law separates film and substrate, the hardness is averaged over the two, weighted by their loads. Otherwise, or
    where the substrate confines the film, it is the larger of the two, an upper bound of the mean pressure.
    """
    groups, film = problem.groups, problem.chosen.film
    if groups.n_H is None:
        return np.ones_like(load)
    n_H = groups.n_H[:, None]
    if "load_film" not in results or film is None or film.composites or film.confined:
        return np.maximum(n_H, 1.0) * np.ones_like(load)
    of_film = np.asarray(results["load_film"]).reshape(load.shape)
    share = np.clip(quotient(of_film, load, 1.0), 0.0, 1.0)
    return share * n_H + (1.0 - share)
