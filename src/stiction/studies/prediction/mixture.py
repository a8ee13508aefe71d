"""All parts of a prediction together: mu, friction force and area of every draw."""

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from stiction.quantities.errors import InputError
from stiction.studies.prediction.area import AreaLaw, area_laws, grown_to
from stiction.studies.prediction.asked import Asked
from stiction.studies.prediction.junctions import grown, squeezed
from stiction.studies.prediction.levels import Levels
from stiction.studies.prediction.onset import Onset
from stiction.studies.prediction.pull import Pull, pull_of
from stiction.studies.prediction.strength import Strength

__all__ = ["Mixture", "Samples"]

# Variance of ln of the area of n elastic spots under a given load, times n: of Hertz spots whose depths d are exponential, area
# and load go with d and d^1.5, so that it is E a^2/(E a)^2 + E w^2/(E w)^2 - 2 E aw/(E a E w) = 2 + 32/(3 pi) - 5 = 0.395.
_OF_SPOTS = 0.395
# Asperities of a solved surface, in the median, and how many of these touch at the lightest load: errors of the area on solved
# surfaces hold the scatter of so few. Between seeds of one design it is .10, .07 and .03 at p/(E* h') = .002, .01 and .1, where
# the above has .16, .09 and .04.
_SOLVED, _LEAST_SOLVED = 300.0, 15.0
_MOST_SCATTER = 1.0  # standard deviation of ln of an area that so few asperities carry that none is sure to touch


@dataclass(frozen=True)
class Samples:
    """Results of the draws, arrays (n, m) over draws and loads, NaN where a draw cannot be.

    force [N], area [m2], pull: factor of the area by adhesion and menisci, growth: by shear, strength: tau_0 [Pa] (n, 1),
    pressure: mean pressure of spots over the hardness, before shear; efficiency: force over the sum of strengths, 1 where these
    do not fall with slip.
    """

    force: np.ndarray
    area: np.ndarray
    pull: np.ndarray
    growth: np.ndarray
    strength: np.ndarray
    pressure: np.ndarray
    efficiency: np.ndarray

    def some(self, rows: np.ndarray, loads: int) -> "Samples":
        """Return these rows of the draws, at the first of the loads."""
        return Samples(*(getattr(self, one.name)[rows, :loads] for one in fields(self)))


@dataclass(frozen=True)
class Mixture:
    """The parts of a prediction at its loads (m,), ready to be drawn from."""

    asked: Asked
    loads: np.ndarray
    laws: list[AreaLaw]
    pull: Pull
    strength: Strength
    onset: Onset | None

    @classmethod
    def of(cls, asked: Asked) -> "Mixture":
        """Return the parts for a contact.

        Raises InputError where no law applies to it, and for a load that presses all of its faces together above the hardness.
        """
        _refuse_flattened(asked)
        return cls(asked, asked.loads, area_laws(asked), pull_of(asked), Strength(asked), Onset.of(asked))

    def at_load(self, at: int) -> "Mixture":
        """Return the parts of one contact at one of its loads."""
        laws = [law.at_load(at) for law in self.laws]
        return replace(self, loads=self.loads[[at]], laws=laws, pull=self.pull.at_load(at))

    @property
    def touching(self) -> np.ndarray:
        """Return the number of asperities that touch at each load (m,)."""
        return np.sum([law.weight * np.where(law.weight > 0.0, law.touching, 0.0) for law in self.laws], axis=0)

    @cached_property
    def _is_flattened(self) -> np.ndarray:
        """Return where (m,) the load presses the faces together with more than the hardness."""
        return self.loads > _most_load(self.asked)

    @property
    def _touching_share(self) -> np.ndarray:
        """Return the share of all asperities of the nominal contact that touch at each load (m,)."""
        contact = self.asked.contact
        every = self.asked.column(contact.roughness.asperity_density * contact.nominal_area)
        return np.minimum(self.touching / every[0], 1.0)

    def samples(self, levels: Levels, inputs: np.ndarray) -> Samples:
        """Return the results at these levels; inputs: the row of the drawn contacts that each draw takes."""
        asked, bodies = self.asked, self.asked.bodies
        load = self.loads[None, :]
        nominal, hardness, shear, hardest = (
            self._of(one, inputs)
            for one in (asked.column(asked.drawn.nominal_area), bodies.hardness, bodies.shear_strength, bodies.hardest)
        )
        pull = self.pull.factor(levels["pull_model"], levels["pull_error"], inputs)
        dry = np.minimum(self._dry_area(levels, inputs, nominal), nominal)
        area = grown_to(dry, pull, nominal)
        borne = load * area / dry  # the load that would make this area alone
        elastic = nominal * np.max([law.elastic for law in self.laws], axis=0)
        bears = np.minimum(hardest, borne / np.maximum(elastic, 1e-300))  # bodies that touch through their film bear no more
        area, pressure = self._squeezed(levels, inputs, area, borne, hardness, bears)
        area = grown_to(area, np.exp(self._chance(levels, pressure / hardness)), nominal)
        area = np.maximum(area, np.minimum(borne / hardest, nominal))
        strength, coefficient = self.strength.at(levels["state"], levels["strength"], levels["coefficient"], inputs)
        growth = np.ones_like(area)
        if asked.metallic.any():
            growth = np.where(asked.metallic, grown(levels["growth"], borne / area, strength, hardness, shear), 1.0)
        area = np.minimum(area * growth, nominal)
        force = np.where(self._is_flattened, np.nan, strength * area + coefficient * borne)
        efficiency = np.ones_like(area)
        if self.onset is not None:
            efficiency = self.onset.efficiency(force / area, area / nominal, levels["spots"], inputs)
        return Samples(force * efficiency, area, pull, growth, strength, pressure / hardness, efficiency)

    def _of(self, column: np.ndarray, inputs: np.ndarray) -> np.ndarray:
        """Return the rows of a column (n, 1), or of one number, for these rows of the inputs."""
        return column[inputs % len(column)]

    def weights_of_laws(self, levels: Levels, rows: np.ndarray) -> dict[str, float]:
        """Return the share of each law of the area among these rows of the draws."""
        which = self._laws_drawn(levels)[rows, 0]
        return {law.name: float(np.mean(which == at)) for at, law in enumerate(self.laws)}

    def _laws_drawn(self, levels: Levels) -> np.ndarray:
        """Return the number of the law of the area of each draw at each load (n, m)."""
        ends = np.cumsum([law.weight for law in self.laws], axis=0)
        ends[-1] = 1.0
        return np.argmax(levels["area_model"][:, None, None] <= ends.T[None], axis=-1)

    def _dry_area(self, levels: Levels, inputs: np.ndarray, nominal: np.ndarray) -> np.ndarray:
        """Return the area (n, m) without what pulls: of the law drawn by its weight, less the error drawn for it."""
        which = self._laws_drawn(levels)
        areas = np.empty((len(levels), len(self.loads)))
        for at, law in enumerate(self.laws):
            here = which == at
            mine = here.any(axis=1)
            rows = inputs[mine] % len(law.log_area)
            said = law.corrected(rows, self.loads, levels["area_error"][mine], self._of(nominal, np.flatnonzero(mine)))
            areas[mine] = np.where(here[mine], said, areas[mine])
        return areas

    def _squeezed(self, levels, inputs, area, borne, hardness, hardest):
        """Return area and mean pressure (n, m), of a soft film that is squeezed out of spots wider than it is thick."""
        coating, touching = self.asked.drawn.coating, self.touching
        if coating is None or not np.isfinite(touching).all():
            return area, borne / area
        radius = np.sqrt(area / (np.pi * np.maximum(touching, 1.0)))
        thickness = self._of(self.asked.column(coating.thickness), inputs)
        times = squeezed(levels["confinement"], borne / area, radius, thickness, hardness, hardest)
        return area / times, borne / area * times

    def _chance(self, levels: Levels, pressure: np.ndarray) -> np.ndarray:
        """Return ln of the area (n, m) over its mean, for the scatter of few spots.

        Zero where all is plastic, or where the map shows its spots.
        """
        from scipy.special import ndtri

        elastic = 1.0 - np.clip(pressure, 0.0, 1.0) ** 2
        number = 1.0 / np.maximum(self.touching, 1e-9)
        varied = self.asked.contact.strength_variation
        sample = sum(law.weight * law.sample**2 for law in self.laws)
        more = np.maximum(number - 1.0 / np.maximum(_SOLVED * self._touching_share, _LEAST_SOLVED), 0.0)
        of_spots = _OF_SPOTS * more * elastic if not self.asked.on_map else 0.0
        variance = of_spots + sample + (0.0 if varied is None else 2.0 * self.asked.column(varied).mean(axis=0) ** 2 * number)
        return ndtri(levels["chance"])[:, None] * np.minimum(np.sqrt(variance), _MOST_SCATTER)


def _most_load(asked: Asked) -> np.ndarray:
    """Return the hardness times the nominal area at each point, or of one contact (m or 1,) [N]."""
    most: np.ndarray = np.median(asked.bodies.hardest, axis=0) * np.mean(asked.column(asked.drawn.nominal_area), axis=0)
    return most


def _refuse_flattened(asked: Asked) -> None:
    """Raise InputError for a load that presses the faces together above the hardness.

    Of many contacts only if all are pressed so.
    """
    most = np.broadcast_to(_most_load(asked), asked.loads.shape)
    flattened = asked.loads > most
    at = int(np.argmax(asked.loads / most))
    if flattened.all() or (flattened.any() and asked.contacts == 1):
        shown = (asked.contact.show(one, "load", 3) for one in (asked.loads[at], most[at]))
        raise InputError("load", next(shown), f"at most {next(shown)}, the hardness times the nominal area")
