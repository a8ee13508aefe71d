"""Compute the factor by which adhesion and menisci increase the contact area.

An asperity sum gives the factor g: the contact area with the attractive force ("pull") over the area without it. The factor
goes continuously to 1 as the pull vanishes. Two adhesion models are equally likely: JKR asperities that yield (the 2015 model)
and Maugis' elastic ones. On a film only the first is used.

In an asperity sum, asperities do not interact. On real surfaces, contact spots that adhesion widens merge. Height maps solved
with adhesion (validation/adhesion.py) have the larger factor 1 + c (g - 1) with

    c = 1 + 4 (w/U)^0.9,

fitted to these maps. U/w is the elastic energy of flattening the roughness over the work of adhesion (Persson & Tosatti 2001),
estimated by its bound E* h_rms h'/(4 w). If U/w is small, the surfaces jump into full contact. With this form the area stays
finite as the load vanishes: it approaches c times the area due to adhesion alone. On these maps the standard deviation of the
error of ln(factor) was 11 %. Twice that is used, because no map with plastic spots was solved.

Menisci on 18 maps of silicon, solved with the Laplace pressure, raised the area by 1.03 to 5.9 times as much as the
meniscus law does (four of them are in tests/prediction/test_menisci_of_a_prediction.py). The difference is largest if
menisci pull with less than a tenth of the load. The logarithm of this ratio has the mean 0.7 and the standard deviation 0.53.
The relative increase of area is at most the Laplace pressure times the nominal area over the load, or the increase by the
meniscus law if that is larger.
"""

from dataclasses import replace

import numpy as np

from stiction.laws.criterion.persson_tosatti_2001 import elastic_over_adhesion
from stiction.quantities.errors import InputError
from stiction.solving.choice import Choice
from stiction.studies.prediction.sampled_case import SampledCase, rows_of

_SUM = "greenwood_williamson_1966"
_ADHESION = (Choice("soft_coating_2015", tangential="none"), Choice(_SUM, asperity="maugis_1992", tangential="none"))
_DRY, _WET = (
    Choice(_SUM, asperity="zhao_maietta_chang_2000", tangential="none", beside={"meniscus": law})
    for law in ("none", "equilibrium_meniscus")
)
_ADHESION_ERROR = 0.25  # standard deviation of ln of the factor, over ln of the factor
_MERGING, _POWER = 4.0, 0.9  # c - 1 at U/w = 1, and the power of w/U with which it grows
_FLAT = 1e6  # factor of the area of surfaces that adhesion pulls into full contact
# Mean and standard deviation of ln of a ratio: increase of area by menisci on solved maps over increase by the meniscus law.
_MENISCUS_BIAS, _MENISCUS_ERROR = 0.7, 0.53


class Pull:
    """Store the factors by which adhesion and menisci enlarge the contact area, for n samples at m loads.

    adhesion: one array (n, m) for each adhesion model, [] without adhesion. menisci: factors by the meniscus law, and largest
    pull of menisci over the load, two arrays (n, m); [] without menisci. An array that is the same for all samples has n = 1.
    """

    def __init__(self, adhesion: list[np.ndarray], menisci: list[np.ndarray]):
        self.adhesion, self.menisci = adhesion, menisci

    def at_load(self, index: int) -> "Pull":
        """Return the Pull for one load; index: position of this load among the m loads."""
        each = (
            [table[:, [index]] if table.shape[1] > 1 else table for table in tables] for tables in (self.adhesion, self.menisci)
        )
        return Pull(*each)

    def factor(self, model: np.ndarray, error: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Return the factor (n, m or 1) by which adhesion and menisci together enlarge the contact area.

        model: quantile levels (n,) that select the adhesion model. error: quantile levels (n,) that select its error and that
        of the meniscus law. rows: index of the sampled input numbers of each sample (n,).
        """
        from scipy.special import ndtri

        score, factor = ndtri(error)[:, None], np.ones((len(rows), 1))
        if self.adhesion:
            laws = np.stack([rows_of(table, rows) for table in self.adhesion])
            which = np.minimum((model * len(laws)).astype(int), len(laws) - 1)
            factor = np.exp(np.log(laws[which, np.arange(len(which))]) * np.exp(_ADHESION_ERROR * score))
        if self.menisci:
            enlarged, most = (rows_of(table, rows) for table in self.menisci)
            more = (enlarged - 1.0) * np.exp(_MENISCUS_BIAS + _MENISCUS_ERROR * score)
            factor = factor * (1.0 + np.minimum(more, np.maximum(enlarged - 1.0, most)))
        return factor


def pull_of(sampled: SampledCase) -> Pull:
    """Return the `Pull` of a sampled contact: area factors of adhesion and menisci, largest meniscus force over the load.

    Raises InputError or ArithmeticError if no adhesion model applies, if the model with menisci refuses the contact, and if an
    adhesion model refuses one of several contacts.
    """
    contact, liquid, menisci = sampled.contact, sampled.drawn.liquid, []
    adhesion = _by_adhesion(sampled) if contact.adheres else []
    if liquid is not None:
        film = "layered" if contact.has_film else None
        wet, dry = (sampled.areas(replace(choice, film=film), ("liquid",)) for choice in (_WET, _DRY))
        menisci = [_factor(wet, dry), sampled.column(liquid.suction * sampled.drawn.nominal_area) / sampled.loads]
    return Pull(adhesion, menisci)


def _factor(pulled: np.ndarray, alone: np.ndarray) -> np.ndarray:
    """Return the factor (n, m) by which a pull enlarges the contact area, at least 1.

    pulled, alone: areas with and without the pull, NaN where an asperity sum exceeds the nominal area. If only the area with
    pull is NaN, the surfaces are pulled into full contact, and the factor is a million. If the area without pull is NaN, the
    factor is 1.
    """
    flat = np.where(np.isnan(alone), 1.0, _FLAT)
    return np.where(np.isnan(pulled), flat, np.maximum(pulled / np.where(np.isnan(alone), pulled, alone), 1.0))


def _by_adhesion(sampled: SampledCase) -> list[np.ndarray]:
    factors, refusal = [], None
    for choice in _ADHESION[:1] if sampled.contact.has_film else _ADHESION:  # the second model refuses films
        try:
            pulled, faint = (sampled.areas(choice, ("work_of_adhesion",), faint) for faint in (False, True))
            factors.append(1.0 + _merging(sampled) * (_factor(pulled, faint) - 1.0))
        except (InputError, ArithmeticError) as error:
            if sampled.contacts > 1:
                raise
            refusal = error
    if not factors:
        assert refusal is not None
        raise refusal
    return factors


def _merging(sampled: SampledCase) -> np.ndarray:
    """Return the factor c (n or 1, m or 1) that corrects the growth of contact area by adhesion.

    An asperity sum gives the ratio g of the areas with and without adhesion; the corrected ratio is 1 + c (g - 1). c is 1 for
    weak adhesion, and larger for strong adhesion, which makes contact spots merge.
    """
    from xarray import DataArray

    groups, dims = sampled.groups
    with np.errstate(divide="ignore"):
        weakness = np.nan_to_num(elastic_over_adhesion(groups), nan=np.inf) ** -_POWER
    return sampled.column(DataArray((1.0 + _MERGING * weakness).reshape(tuple(dims.values())), dims=list(dims)))
