"""The factor by which adhesion and menisci raise the contact area.

The factor g is that of sums over asperities: the area with the pull over that without it, of one law. It goes to 1 without
a step where nothing pulls. Two laws of adhesion answer, equally likely: JKR asperities that yield (the 2015 model) and the
elastic ones of Maugis.

Their asperities do not feel each other, and spots that adhesion widens merge. Maps solved with adhesion have more area
(validation/adhesion.py), g^m with

    m = 1 + 1/(1 + (U/(10 w))^2),

U/w being the elastic energy of flattening the roughness over the work of adhesion (Persson & Tosatti 2001), by its bound
E* h_rms h'/(4 w). Where U/w is small the faces jump into full contact. On these maps ln of the factor was met within 12 %
(standard deviation); twice that is taken, as no surface with yielding spots was solved.

Menisci on 18 maps of silicon, solved with Laplace's pressure (tests/prediction/test_menisci_of_a_prediction.py has four),
raised the area by 1.03 to 5.9 times as much as the law does, most where they pull with less than a tenth of the load; the mean
of ln is .7, its standard deviation .53. They pull at most with Laplace's pressure on the nominal area.
"""

from dataclasses import replace

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.rough_surface.persson_tosatti_2001 import elastic_over_adhesion
from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice
from stiction.studies.prediction.asked import Asked

__all__ = ["Pull", "pull_of"]

_SUM = "greenwood_williamson_1966"
_ADHESION = (Choice("soft_coating_2015", tangential="none"), Choice(_SUM, asperity="maugis_1992", tangential="none"))
_DRY, _WET = (
    Choice(_SUM, asperity="zhao_maietta_chang_2000", tangential="none", beside={"meniscus": law})
    for law in ("none", "equilibrium_meniscus")
)
_ADHESION_ERROR = 0.25  # standard deviation of ln of the factor, over ln of the factor
_STICKY = 10.0  # U/w below which spots that adhesion widens merge
_FLAT = 1e6  # factor of the area of faces that adhesion pulls flat
_MENISCUS_BIAS, _MENISCUS_ERROR = 0.7, 0.53  # of ln of what menisci add to the area, over that by the law


class Pull:
    """Factors of the area by what pulls: adhesion, a list of arrays (n, m), one a law; menisci, an array (n, m).

    most: their largest pull over the load, (n, m)."""

    def __init__(self, adhesion: list[np.ndarray], menisci: np.ndarray, most: np.ndarray):
        self.adhesion, self.menisci, self.most = adhesion, menisci, most

    def at_load(self, at: int) -> "Pull":
        """Return the factors at one of the loads of one contact."""
        *adhesion, menisci, most = (
            table[:, [at]] if table.shape[1] > 1 else table for table in (*self.adhesion, self.menisci, self.most)
        )
        return Pull(adhesion, menisci, most)

    def factor(self, model: np.ndarray, error: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the factor (n, m) of the pull on the area, for these rows of the inputs.

        levels (n,): one selects the law, one its error.
        """
        from scipy.special import ndtri

        score = ndtri(error)[:, None]
        laws = np.stack([table[rows % len(table)] for table in self.adhesion])
        which = np.minimum((model * len(laws)).astype(int), len(laws) - 1)
        log_factor = np.log(laws[which, np.arange(len(which))]) * np.exp(_ADHESION_ERROR * score)
        pulled, most = self.menisci[rows % len(self.menisci)] - 1.0, self.most[rows % len(self.most)]
        more = pulled * np.exp(_MENISCUS_BIAS + _MENISCUS_ERROR * score)
        return np.exp(log_factor) * (1.0 + np.minimum(more, np.maximum(pulled, most)))


def pull_of(asked: Asked) -> Pull:
    """Return the factors of a contact by what it has of work of adhesion and liquid. Raises InputError where no law answers."""
    contact, one = asked.contact, np.ones((1, len(asked.loads)))
    adhesion = _by_adhesion(asked) if contact.adheres else [one]
    menisci, most = one, 0.0 * one
    if contact.liquid is not None:
        film = "layered" if contact.has_film else None
        wet, dry = (asked.areas(replace(choice, film=film), ("liquid",)) for choice in (_WET, _DRY))
        menisci = _factor(wet, dry)
        liquid = asked.drawn.liquid
        assert liquid is not None
        most = asked.column(liquid.suction * asked.drawn.nominal_area) / asked.loads
    return Pull(adhesion, menisci, most)


def _factor(pulled: np.ndarray, alone: np.ndarray) -> np.ndarray:
    """Return one area over the other, at least 1.

    NaN where the area of a sum passes the nominal one: where the pull causes it the faces are pulled flat, and where the load
    alone causes it the pull adds nothing.
    """
    flat = np.where(np.isnan(alone), 1.0, _FLAT)
    return np.where(np.isnan(pulled), flat, np.maximum(pulled / np.where(np.isnan(alone), pulled, alone), 1.0))


def _by_adhesion(asked: Asked) -> list[np.ndarray]:
    found, refusal = [], None
    for choice in _ADHESION[:1] if asked.contact.has_film else _ADHESION:  # the others refuse films
        try:
            pulled, faint = (asked.areas(choice, ("work_of_adhesion",), faint) for faint in (False, True))
            found.append(_factor(pulled, faint) ** _merging(asked))
        except (InputError, ArithmeticError) as error:
            if asked.contacts > 1:
                raise
            refusal = error
    if not found:
        assert refusal is not None
        raise refusal
    return found


def _merging(asked: Asked) -> np.ndarray:
    """Return the power (n or 1, m or 1) of the factor of a sum that solved maps have."""
    from xarray import DataArray

    groups, dims = Groups.of(asked.drawn.indices())
    ratio = np.nan_to_num(elastic_over_adhesion(groups), nan=np.inf) / _STICKY
    return asked.column(DataArray((1.0 + 1.0 / (1.0 + ratio**2)).reshape(tuple(dims.values())), dims=list(dims)))
