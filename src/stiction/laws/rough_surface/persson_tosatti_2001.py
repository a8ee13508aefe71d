r"""Full contact of a soft, smooth surface that adhesion flattens: after Persson & Tosatti 2001.

*Assumes*: elastic half-spaces. The surfaces are in full contact if flattening the roughness needs less elastic energy $U$ per
area than the work of adhesion $\gamma$. *Source*: [persson_tosatti_2001], the energy balance as commonly quoted, re-derived
here. A wave of the wavenumber $q$ and the mean square height $\langle h^2\rangle$ stores $E^*q\langle h^2\rangle/4$ per area,
so that

$$
\frac U\gamma=\frac{E^*}{4\gamma}\int q\,C(q)\,d^2q\ \le\ \frac{E^*h_\mathrm{rms}h'}{4\gamma}<1,\qquad A=A_n,\qquad
\mu=\frac{\tau_0A_n}P
$$

with the power spectrum $C(q)$, the rms height $h_\mathrm{rms}$, the root mean square gradient $h'$, the contact modulus $E^*$,
the shear strength $\tau_0$ of the interface and the load $P$ on the nominal area $A_n$. The upper bound (by Cauchy and
Schwarz) replaces the integral, because $\sigma$, $R$ and $N$ give only the moments. It is exact if all waves have one
wavelength, and three times the energy of self-affine surfaces over three decades of wavelengths. If the contact names scans,
the spectrum of their map gives the integral. *Limit*: waves of one wavelength jump into full contact without a load if
$U/\gamma<0.49$ ([johnson_1995], parameter $\alpha>0.57$); for 0.49 to 1 they may need a load. If $U/\gamma$ is above 1 the
model raises an error, because it does not describe partial contact with adhesion. *Check*: $U/\gamma=0.1$ for $E^*=2$ MPa,
$h_\mathrm{rms}=0.1$ um, $h'=0.1$, $\gamma=50$ mJ/m^2. The theory does not compute the separation.
"""

import math
from typing import TYPE_CHECKING

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.criterion.persson_tosatti_2001 import elastic_over_adhesion
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.quantities.errors import InputError, InWords
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source

if TYPE_CHECKING:
    from stiction.surfaces.heightmap import HeightMap


def area_at_load(load: np.ndarray, groups: Groups, surface: "HeightMap | None" = None) -> np.ndarray:
    """Return the nominal area per asperity (n, H), in units of pi R sigma, in full contact, and NaN for all other contacts.

    load (n, H): only its shape is used. surface: map that represents the roughness of both faces, from whose spectrum the
    elastic energy of full contact is computed; with None, an upper bound is computed from sigma, R and N. Raises InputError
    if no contact is in full contact.
    """
    ratio = elastic_over_adhesion(groups, surface)
    if not (ratio < 1.0).any():
        allowed = f"at least {ratio.min():.3g} times this value, the elastic energy needed to flatten the roughness"
        raise InputError("work_of_adhesion", InWords("too small for full contact"), allowed)
    full = np.where(ratio < 1.0, 1.0 / (math.pi * groups.roughness_parameter), np.nan)
    return np.broadcast_to(full[:, None], load.shape).copy()


RECORD = RoughSurface(
    key="persson_tosatti_2001",
    title="Full contact of a soft, smooth surface that adhesion flattens",
    grade="B",
    sources=(
        Source("persson_tosatti_2001", "", "elastic energy of full contact against the work of adhesion, as commonly quoted"),
        Source("johnson_1995", "", "the jump into full contact of waves of one wavelength, as commonly quoted"),
        Source("nayak_1971", "", "height and gradient of the surface from sigma, R and N"),
    ),
    area_at_load=area_at_load,
    area_on_map=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    adheres=True,
    verified="elastic energy of waves of one wavelength, in SI units; contact area equal to the nominal area",
    needs=("theta", "roughness_parameter"),
    validity=(
        Validity(
            "elastic_over_adhesion",
            0.0,
            1.0,
            "adhesion may not suffice for full contact, which the model assumes",
            "impossible",
        ),
        Validity(
            "elastic_over_adhesion", 0.0, 0.49, "at small loads the contact may be partial; mu is then lower than computed"
        ),
        ELASTIC_CONTACT,
    ),
    notes="mu is the shear strength of the interface divided by the nominal pressure. The model raises an error if flattening "
    "the roughness needs more energy than the work of adhesion.",
)
