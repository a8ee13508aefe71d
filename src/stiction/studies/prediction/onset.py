"""Compute the loss of friction at the onset of sliding, if the case states that strength falls with slip."""

from dataclasses import dataclass

import numpy as np

from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice
from stiction.solving.on_map import MapProblem
from stiction.solving.problem import make_problem
from stiction.solving.sliding_efficiency import (
    LAW_ERROR,
    SPOTS_ERROR,
    UNLIKE,
    efficiency,
    spot_radius,
    spread_of_edges,
    spread_of_spots,
)
from stiction.solving.spots_on_map import spread_on_map
from stiction.studies.prediction.sampled_case import SampledCase, rows_of

_MAP = "boundary_elements"


@dataclass(frozen=True)
class MapSpots:
    """Store the scatter of the tangential displacements of contact spots on one solved height map, at k contact areas.

    share: real over nominal area (k,). spread: standard deviation of the tangential displacement over all points in contact,
    divided by their shear strength, (k,) [m/Pa]. compliance: tangential compliance [1/Pa] of the two bodies without films.
    side: side [m] of a square with the area of the map.
    """

    share: np.ndarray
    spread: np.ndarray
    compliance: float
    side: float

    def at(self, share: np.ndarray) -> np.ndarray:
        """Return the standard deviation of spot displacements over (shear strength times tangential compliance) [m].

        share: real over nominal area, of any shape; the result has the same shape.
        """
        return np.interp(np.log(share), np.log(self.share), self.spread) / self.compliance


@dataclass(frozen=True)
class Onset:
    """Store the inputs of the onset of sliding, arrays (n or 1, m or 1) over n samples and m points (contacts at a load).

    slip: weakening slip [m]. residual: residual strength (fraction). deviation [m], radius [m], density [1/m2]: height
    deviation, radius and density of asperities. side: side of the nominal area [m], taken as a square. compliance: tangential
    compliance [1/Pa] of the touching surfaces (bodies or films), and of the two bodies without films. unlike: magnitude of
    Dundurs' beta of the touching surfaces. thickness: film thickness [m], 0 without a film. spots: spots of a solved map; None
    without a map that can be solved.
    """

    slip: np.ndarray
    residual: np.ndarray
    deviation: np.ndarray
    radius: np.ndarray
    density: np.ndarray
    side: np.ndarray
    compliance: tuple[np.ndarray, np.ndarray]
    unlike: np.ndarray
    thickness: np.ndarray
    spots: MapSpots | None

    @classmethod
    def of(cls, sampled: SampledCase) -> "Onset | None":
        """Return the inputs of the onset of sliding for a sampled contact; None if the case states no weakening slip."""
        contact = sampled.drawn
        if contact.weakening_slip is None:
            return None
        rough, coating = contact.roughness, contact.coating
        faces, bodies = (sampled.column(_compliance(pair)) for pair in (contact.touching, (contact.first, contact.second)))
        return cls(
            sampled.column(contact.weakening_slip),
            sampled.column(contact.residual_strength),
            sampled.column(rough.asperity_height_deviation),
            sampled.column(rough.asperity_radius),
            sampled.column(rough.asperity_density),
            sampled.column(contact.nominal_area**0.5),
            (faces, bodies),
            sampled.column(_mismatch(contact.touching)),
            sampled.column(0.0 if coating is None else coating.thickness),
            _spots_of(sampled),
        )

    def efficiency(self, strength: np.ndarray, share: np.ndarray, level: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the friction efficiency (n, m): largest friction force over the sum of the strengths of all spots.

        It is between the residual strength (fraction) and 1. strength: mean shear strength on the contact area [Pa] (n, m).
        share: real over nominal area (n, m). level: quantile levels (n,) at which the error of this formula is sampled. rows:
        index of the sampled input numbers of each sample (n,).
        """
        from scipy.special import ndtri

        score, side, bodies = ndtri(level)[:, None], rows_of(self.side, rows), rows_of(self.compliance[1], rows)
        slip, residual = rows_of(self.slip, rows), rows_of(self.residual, rows)
        if self.spots is None:
            of_spots = self._by_numbers(share, rows) * np.exp(SPOTS_ERROR * score)
            of_edges = bodies * spread_of_edges(side, share)
            return self._coupled(efficiency(strength * np.hypot(of_spots, of_edges) / slip, residual), residual, score, rows)
        # The solution of the map contains waves up to its side; the finite nominal area adds the longer ones.
        longer = np.sqrt(np.maximum(side**2 - self.spots.side**2, 0.0))
        spread = bodies * np.hypot(self.spots.at(share), spread_of_edges(longer, share))
        found = efficiency(strength * spread / slip, residual) * np.exp(-LAW_ERROR * score)
        return self._coupled(np.clip(found, residual, 1.0), residual, score, rows)

    def _coupled(self, like: np.ndarray, residual: np.ndarray, score: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the efficiency (n, m) of unlike bodies: largest force divided by the summed strength.

        Normal and tangential displacements of bodies with unlike elastic constants are coupled. like: efficiency of like bodies
        (n, m). residual: residual strength (fraction). score: standard normal scores (n, 1) for the error of the loss. rows:
        index of the sampled input numbers of each sample (n,). Where like bodies lose no friction, unlike bodies lose none
        either.
        """
        mean, error, most = UNLIKE
        lost = (1.0 - like) / np.maximum(1.0 - residual, 1e-12)
        loss = rows_of(self.unlike, rows) * np.maximum(mean + error * score, 0.0) * -np.expm1(-lost / most)
        return np.maximum(like * np.exp(-loss), np.minimum(residual, like))

    def _by_numbers(self, share: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the scatter of spot displacements divided by the shear strength (n, m) [m/Pa], for contacts without a map.

        share: real over nominal area (n, m). rows: index of the sampled input numbers of each sample (n,). The scatter is the
        standard deviation of the tangential displacement over all contact spots of a sample, estimated from density, radius and
        height deviation of asperities. Spots that are much wider than the film thickness have the compliance of the bodies
        below the film.
        """
        deviation, radius, density = (rows_of(table, rows) for table in (self.deviation, self.radius, self.density))
        spots = spot_radius(share, deviation, radius, density)
        faces, bodies = (rows_of(table, rows) for table in self.compliance)
        thickness = rows_of(self.thickness, rows)
        below = bodies + (faces - bodies) * thickness / (thickness + spots)
        return below * spread_of_spots(spots, share, deviation * radius * density)


def _compliance(pair):
    """Return the tangential compliance [1/Pa] of two bodies: (2 - nu)/(2 G), summed over both.

    nu: Poisson's ratio. G: shear modulus.
    """
    return sum((2.0 - body.poissons_ratio) / (2.0 * body.shear_modulus) for body in pair)


def _mismatch(pair):
    """Return the magnitude of Dundurs' second parameter beta (elastic mismatch) of two bodies."""
    one, other = (((1.0 - 2.0 * body.poissons_ratio) / body.shear_modulus) for body in pair)
    return abs(one - other) / (2.0 * sum((1.0 - body.poissons_ratio) / body.shear_modulus for body in pair))


def _spots_of(sampled: SampledCase) -> MapSpots | None:
    """Solve the height map of a contact, and return the scatter of its spot displacements; None without a map to solve.

    The result is None too if the map cannot be solved. In a parameter sweep, the map of the first contact is used.
    """
    if not sampled.on_map:
        return None
    first = sampled.ends()[0]
    try:
        problem = make_problem(first.nominal(_MAP), Choice(_MAP, tangential="none"))
        assert isinstance(problem, MapProblem)
        share, spread = spread_on_map(problem, sampled.loads)
    except InputError:
        return None
    contact, surface = problem.contact, problem.surface()
    compliance = float(_compliance((contact.first, contact.second)))
    return MapSpots(share, spread, compliance, float(np.sqrt(np.prod(surface.size))))
