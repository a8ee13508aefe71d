"""Combine all parts of a prediction in one probabilistic model that samples mu, friction force and contact area."""

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from stiction.quantities.errors import InputError
from stiction.studies.prediction.area import AreaLaw, area_laws, grown_to
from stiction.studies.prediction.junctions import grown, squeezed
from stiction.studies.prediction.levels import Levels
from stiction.studies.prediction.onset import Onset
from stiction.studies.prediction.pull import Pull, pull_of
from stiction.studies.prediction.sampled_case import SampledCase, rows_of
from stiction.studies.prediction.strength import Strength

# n times the variance of ln(area) of n elastic spots under a given load. For Hertz spots with exponentially distributed depths
# d, the area a is proportional to d and the load w to d^1.5. n times the variance is then
# E a^2/(E a)^2 + E w^2/(E w)^2 - 2 E aw/(E a E w) = 2 + 32/(3 pi) - 5 = 0.395.
_OF_SPOTS = 0.395
# Median number of asperities of a solved benchmark surface, and how many of them touch at the lightest load. The errors of
# the area on benchmark surfaces already contain the scatter of so few spots. Between seeds of one design this scatter of
# ln(area) is .10, .07 and .03 at p/(E* h') = .002, .01 and .1, where _OF_SPOTS gives .16, .09 and .04.
_SOLVED, _LEAST_SOLVED = 300.0, 15.0
_MOST_SCATTER = 1.0  # largest standard deviation of ln(area), for contacts with hardly one touching asperity


@dataclass(frozen=True)
class Samples:
    """Store the results of n samples at m loads, arrays (n, m); force and area are NaN for an impossible sample.

    force: friction force [N], NaN also at loads above hardness times nominal area. area: real contact area under shear [m2].
    pull: factor by which adhesion and menisci enlarge the area. growth: factor by which junctions grow under shear. strength,
    coefficient: shear strength of the interface at zero pressure [Pa], and its pressure coefficient, (n, m or 1). pressure:
    ratio of the mean pressure of contact spots to the hardness, before shear. efficiency: ratio of the friction force to the
    summed strength of all spots, 1 unless strength falls with slip.
    """

    force: np.ndarray
    area: np.ndarray
    pull: np.ndarray
    growth: np.ndarray
    strength: np.ndarray
    coefficient: np.ndarray
    pressure: np.ndarray
    efficiency: np.ndarray

    def some(self, rows: np.ndarray, loads: int) -> "Samples":
        """Return the results of the samples with indices `rows`, at the first `loads` loads only."""
        return Samples(*(getattr(self, field.name)[rows, :loads] for field in fields(self)))


@dataclass(frozen=True)
class Mixture:
    """Store the parts of a prediction, and combine them in samples of friction force and contact area at loads (m,) [N].

    sampled: the contact with samples of its uncertain inputs. laws: real contact area by each area model, with its weight and
    errors. pull: factors by which adhesion and menisci enlarge the area. strength: distribution of the shear strength of the
    interface. onset: inputs of the loss of friction at the onset of sliding; None if no weakening slip is stated.
    """

    sampled: SampledCase
    loads: np.ndarray
    laws: list[AreaLaw]
    pull: Pull
    strength: Strength
    onset: Onset | None

    @classmethod
    def of(cls, sampled: SampledCase) -> "Mixture":
        """Return the mixture of area models, adhesion, interface strength and onset of sliding for a sampled contact.

        Raises InputError if a load exceeds hardness times nominal area; for several contacts, only if every load exceeds it.
        Raises InputError or ArithmeticError if no area model or no adhesion model applies, or if it does not apply to all of
        several contacts.
        """
        _refuse_flattened(sampled)
        return cls(sampled, sampled.loads, area_laws(sampled), pull_of(sampled), Strength(sampled), Onset.of(sampled))

    def at_load(self, index: int) -> "Mixture":
        """Return the mixture for one load of a single contact; index: position of this load among the m loads."""
        laws = [law.at_load(index) for law in self.laws]
        return replace(self, loads=self.loads[[index]], laws=laws, pull=self.pull.at_load(index))

    @cached_property
    def touching(self) -> np.ndarray:
        """Return the number of asperities in contact at each load (m,): the weighted mean over the area models.

        It is infinite if it is unknown for any model with a weight.
        """
        return np.sum([law.weight * np.where(law.weight > 0.0, law.touching, 0.0) for law in self.laws], axis=0)

    @cached_property
    def _is_flattened(self) -> np.ndarray:
        """Return a mask (m,) of the loads that exceed hardness times nominal area."""
        return self.loads > _most_load(self.sampled)

    @cached_property
    def _touching_share(self) -> np.ndarray:
        """Return the fraction of all asperities of the nominal contact that touch at each load (m,); 1 if unknown."""
        contact = self.sampled.contact
        every = self.sampled.column(contact.roughness.asperity_density * contact.nominal_area)
        return np.minimum(self.touching / every[0], 1.0)

    def samples(self, levels: Levels, inputs: np.ndarray) -> Samples:
        """Return friction force, area and the other results of samples with these quantile levels.

        inputs: for each sample, the index of the sampled input numbers that it uses, (n,).
        """

        sampled, bodies = self.sampled, self.sampled.bodies
        load = self.loads[None, :]
        nominal, hardness, shear, hardest = (
            rows_of(column, inputs)
            for column in (sampled.column(sampled.drawn.nominal_area), bodies.hardness, bodies.shear_strength, bodies.hardest)
        )
        pull = self.pull.factor(levels["pull_model"], levels["pull_error"], inputs)
        dry = np.minimum(self._dry_area(levels, inputs, nominal), nominal)
        area = grown_to(dry, pull, nominal)
        borne = load * area / dry  # the load that would make this area without adhesion
        elastic = nominal * np.max([law.elastic for law in self.laws], axis=0)
        bears = np.minimum(hardest, borne / np.maximum(elastic, 1e-300))  # the limit by elastic bodies below the film
        area, pressure = self._squeezed(levels, inputs, area, borne, hardness, bears)
        area = grown_to(area, np.exp(self._chance(levels, pressure / hardness)), nominal)
        area = np.maximum(area, np.minimum(borne / hardest, nominal))
        strength, coefficient = self.strength.at(levels["state"], levels["strength"], levels["coefficient"], inputs)
        growth = np.ones_like(area)
        if sampled.metallic.any():
            hardens = self.strength.hardens(strength, shear)
            growth = grown(levels["growth"], borne / area, strength, hardness, shear, hardens)
            growth = np.where(sampled.metallic, growth ** self._growth_exponent(levels, inputs, area), 1.0)
        area = np.minimum(area * growth, nominal)
        force = np.where(self._is_flattened, np.nan, strength * area + coefficient * borne)
        efficiency = np.ones_like(area)
        if self.onset is not None:
            efficiency = self.onset.efficiency(force / area, area / nominal, levels["spots"], inputs)
        return Samples(force * efficiency, area, pull, growth, strength, coefficient, pressure / hardness, efficiency)

    def weights_of_laws(self, levels: Levels, rows: np.ndarray) -> dict[str, float]:
        """Return the fraction of the samples with indices `rows` that use each area model, by its name, at the first load."""
        which = self._laws_drawn(levels)[rows, 0]
        return {law.name: float(np.mean(which == index)) for index, law in enumerate(self.laws)}

    def _laws_drawn(self, levels: Levels) -> np.ndarray:
        """Return the index of the area model that each of n samples uses at each of m loads, (n, m)."""
        ends = np.cumsum([law.weight for law in self.laws], axis=0)
        ends[-1] = 1.0
        return np.argmax(levels["area_model"][:, None, None] <= ends.T[None], axis=-1)

    def _dry_area(self, levels: Levels, inputs: np.ndarray, nominal: np.ndarray) -> np.ndarray:
        """Return the contact area [m2] (n, m) without adhesion and menisci, by the area model that each sample selects.

        The area is corrected by the error that the sample selects. inputs: index of the sampled input numbers of each sample
        (n,). nominal: nominal area [m2], (n, m or 1).
        """
        which = self._laws_drawn(levels)
        areas = np.empty((len(levels), len(self.loads)))
        for index, law in enumerate(self.laws):
            uses_law = which == index
            mine = uses_law.any(axis=1)
            corrected = law.corrected(inputs[mine], self.loads, levels["area_error"][mine], nominal[mine])
            areas[mine] = np.where(uses_law[mine], corrected, areas[mine])
        return areas

    def _growth_exponent(self, levels: Levels, inputs: np.ndarray, area: np.ndarray) -> np.ndarray | float:
        """Return the exponent (n, m), 0 to 1, to which the factor of junction growth is raised; 1 without a film.

        inputs: index of the sampled input numbers of each sample (n,). area: contact area [m2] (n, m). The exponent is
        1/(1 + a/t) for the mean spot radius a and the film thickness t: a narrow spot grows like a spot of a bulk body, a wide
        spot hardly grows, because the body below carries it. The exponent is 0 if the number of spots is unknown, and for a
        state of the interface that was measured on films, because such a state includes growth.
        """
        if (coating := self.sampled.drawn.coating) is None:
            return 1.0
        radius, thickness = self._spot_radius(area), rows_of(self.sampled.column(coating.thickness), inputs)
        return np.where(self.strength.is_of_film(levels["state"]), 0.0, 1.0 / (1.0 + radius / thickness))

    def _spot_radius(self, area: np.ndarray) -> np.ndarray:
        """Return the mean radius [m] (n, m) of contact spots with this total area [m2]; infinite if their number is unknown.

        Each touching asperity is a spot; there is at least one.
        """
        touching = np.where(np.isfinite(self.touching), np.maximum(self.touching, 1.0), 0.0)
        with np.errstate(divide="ignore"):
            return np.sqrt(area / (np.pi * touching))

    def _squeezed(self, levels, inputs, area, borne, hardness, hardest):
        """Return area [m2] and mean pressure [Pa] (n, m) of contact spots after the soft film between the bodies is squeezed.

        inputs: index of the sampled input numbers of each sample (n,). area: contact area before. borne: load that the spots
        carry [N]. hardness, hardest: hardness of the film, and largest pressure that film and bodies bear [Pa]. Squeezing
        matters for spots wider than the film is thick. Without a film, or if the number of spots is unknown, the area is
        unchanged.
        """
        coating, touching = self.sampled.drawn.coating, self.touching
        if coating is None or not np.isfinite(touching).all():
            return area, borne / area
        radius = self._spot_radius(area)
        thickness = rows_of(self.sampled.column(coating.thickness), inputs)
        times = squeezed(levels["confinement"], borne / area, radius, thickness, hardness, hardest)
        return area / times, borne / area * times

    def _chance(self, levels: Levels, pressure: np.ndarray) -> np.ndarray:
        """Return the random deviation of ln(area) of each sample, (n, m).

        pressure: mean pressure over hardness (n, m). The variance is the sum of three parts: the small number of contact spots,
        the scatter of the junction strength (treated as scatter of the area), and the sampling error of a scan. The first part
        is the excess over the scatter that benchmark errors already contain; it is 0 for plastic spots and for a height map.
        The standard deviation is limited to _MOST_SCATTER.
        """
        from scipy.special import ndtri

        elastic = 1.0 - np.clip(pressure, 0.0, 1.0) ** 2
        number = 1.0 / np.maximum(self.touching, 1e-9)
        varied = self.sampled.contact.strength_variation
        sample = sum(law.weight * law.sample**2 for law in self.laws)
        more = np.maximum(number - 1.0 / np.maximum(_SOLVED * self._touching_share, _LEAST_SOLVED), 0.0)
        of_spots = _OF_SPOTS * more * elastic if not self.sampled.on_map else 0.0
        variance = of_spots + sample + (0.0 if varied is None else 2.0 * self.sampled.column(varied).mean(axis=0) ** 2 * number)
        return ndtri(levels["chance"])[:, None] * np.minimum(np.sqrt(variance), _MOST_SCATTER)


def _most_load(sampled: SampledCase) -> np.ndarray:
    """Return hardness times nominal area [N], the largest load that can be carried, for each of m points, (m,) or (1,).

    A point is a contact at a load. The hardness is the median over the samples of the largest pressure that a contact spot can
    bear. The nominal area is the mean over the samples.
    """
    most: np.ndarray = np.median(sampled.bodies.hardest, axis=0) * np.mean(sampled.column(sampled.drawn.nominal_area), axis=0)
    return most


def _refuse_flattened(sampled: SampledCase) -> None:
    """Raise InputError if a load exceeds hardness times nominal area.

    For several contacts, the error is raised only if every load exceeds the limit of its contact.
    """
    most = np.broadcast_to(_most_load(sampled), sampled.loads.shape)
    flattened = sampled.loads > most
    index = int(np.argmax(sampled.loads / most))
    if flattened.all() or (flattened.any() and sampled.contacts == 1):
        shown = (sampled.contact.show(load, "load", 3) for load in (sampled.loads[index], most[index]))
        raise InputError("load", next(shown), f"at most {next(shown)}, the hardness times the nominal area")
