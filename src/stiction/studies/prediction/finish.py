"""Sample the roughness parameters of a surface that is described by its finish, e.g. "ground"."""

from dataclasses import replace

import numpy as np

from stiction.case.distribution import of_samples
from stiction.case.read import Case
from stiction.case.uncertain import SAMPLE, Uncertain
from stiction.contact.contact import Contact
from stiction.quantities.dimensions import variable
from stiction.quantities.errors import InputError, InWords
from stiction.quantities.sampling import sobol_points
from stiction.surfaces.finished import HEIGHTS

_NUMBERS = ("asperity_height_deviation", "asperity_radius", "asperity_density")
_NAME = "finish of the surface"  # sample dimension of the three parameters, which are sampled together
_ROWS, _SEED = 512, 1
SHARPEST = 1.0  # largest sigma/R: asperities higher than the radius of their tips are impossible


def with_finish(case: Case) -> Case:
    """Return the case with roughness parameters left open by its surface finish as uncertain numbers.

    These are height deviation, radius and density of asperities, which are sampled together; an uncertain Sq or Ra is part of
    them, and no longer an uncertain number of its own. Samples with a height deviation above the radius are excluded, unless
    that would exclude all samples. A case with [indices], without a finish or with a scan is returned unchanged. Otherwise
    InputError is raised if a number of the roughness is an array.
    """
    contact = case.subject
    if not isinstance(contact, Contact) or not contact.roughness.unknowns or contact.measured is not None:
        return case
    if any(True for _ in contact.roughness.arrays()):
        allowed = "single numbers for a surface with a finish; a case file may state several"
        raise InputError("roughness", InWords("several heights"), allowed)
    heights = [number for number in case.uncertain if number.path[-1] in HEIGHTS]
    points = sobol_points(len(heights) + len(contact.roughness.unknowns), _ROWS, _SEED)
    levels = np.clip(points.T, 1e-6, 1.0 - 1e-6)
    sampled = {one.path: variable([SAMPLE], one.at(row)) for one, row in zip(heights, levels[: len(heights)], strict=True)}
    surfaces = case.at(sampled).subject.roughness  # type: ignore[attr-defined]
    drawn = np.array(surfaces.drawn(levels[len(heights) :]))
    possible = drawn[0] <= SHARPEST * drawn[1]
    drawn = drawn[:, possible] if possible.any() else drawn
    order = np.argsort(drawn[1], kind="stable")  # by radius, so that neighbouring quantile levels give similar surfaces
    paths = [("contact", "roughness", name) for name in _NUMBERS]
    more = [Uncertain.of(path, of_samples(path[-1], row[order], False), _NAME) for path, row in zip(paths, drawn, strict=True)]
    return replace(case, uncertain=(*(number for number in case.uncertain if number not in heights), *more))
