r"""Full contact of a soft smooth surface that adhesion presses flat: after Persson & Tosatti 2001.

*Assumes*: elastic half-spaces. The surfaces are in full contact if flattening the roughness needs less elastic energy than
the work of adhesion. *Source*: [persson_tosatti_2001], the energy balance as commonly quoted, derived again here. A wave of
the wavevector $q$ and the mean square height $\langle h^2\rangle$ stores $E^*q\langle h^2\rangle/4$ per area, so that

$$
\frac U\gamma=\frac{E^*}{4\gamma}\int q\,C(q)\,d^2q\ \le\ \frac{E^*h_\mathrm{rms}h'}{4\gamma}<1,\qquad A=A_n,\qquad
\mu=\frac{\tau_0A_n}P
$$

The bound (Cauchy and Schwarz) replaces the integral, because sigma, R and N give only the moments. It is exact for waves of
one length, and three times the energy for self-affine surfaces over three decades. *Limit*: waves of one length jump into
full contact by themselves if $U/\gamma<0.49$ (Johnson 1995, $\alpha>0.57$); from there to 1 they may need a load. If the
bound is above 1 the model raises an error, because it does not describe partial contact with adhesion. *Check*: $E^*=2$ MPa,
$h_\mathrm{rms}=0.1$ um, $h'=0.1$, $\gamma=50$ mJ/m^2: $U/\gamma=0.1$. The theory has no separation, and neither have its
results.
"""

import math

import numpy as np

from stiction.contact.indices import Groups
from stiction.laws.shared_claims import ELASTIC_CONTACT
from stiction.quantities.errors import InputError, InWords
from stiction.records.registry import RoughSurface, Validity
from stiction.records.sources import Source
from stiction.surfaces.theory.moments import Moments


def elastic_over_adhesion(groups: Groups) -> np.ndarray:
    """Return an upper bound of the elastic energy over the work of adhesion, U/gamma (n,).

    By the definition of theta, E* sigma/gamma = (3/4) theta sqrt(R/sigma).
    """
    moments = Moments.from_groups(groups.roughness_parameter, 1.0)  # the gradient over sqrt(sigma/R), which drops out
    return 0.75 * groups.theta * np.sqrt(moments.m0) * moments.rms_slope / 4.0


def area_at_load(load: np.ndarray, groups: Groups) -> np.ndarray:
    """Return the nominal area per asperity over pi R sigma (n, H); NaN for contacts that stay partial.

    Raises InputError if all contacts stay partial.
    """
    ratio = elastic_over_adhesion(groups)
    if not (ratio < 1.0).any():
        allowed = f"{ratio.min():.3g} times as much or more: flattening the roughness takes that energy"
        raise InputError("work_of_adhesion", InWords("too small for full contact"), allowed)
    full = np.where(ratio < 1.0, 1.0 / (math.pi * groups.roughness_parameter), np.nan)
    return np.broadcast_to(full[:, None], load.shape).copy()


RECORD = RoughSurface(
    key="persson_tosatti_2001",
    title="Full contact of a soft smooth surface that adhesion presses flat",
    grade="B",
    sources=(
        Source("persson_tosatti_2001", "", "elastic energy of full contact against the work of adhesion, as commonly quoted"),
        Source("johnson_1995", "", "from where waves of one length jump into full contact, as commonly quoted"),
        Source("nayak_1971", "", "height and gradient that belong to sigma, R and N"),
    ),
    area_at_load=area_at_load,
    takes_surface_moments=True,
    up_to_full_contact=True,
    adheres=True,
    verified="energy of waves of one length, in SI units; the nominal area",
    needs=("theta", "roughness_parameter"),
    validity=(
        Validity(
            "elastic_over_adhesion", 0.0, 1.0, "the contact stays partial, but the model assumes full contact", "impossible"
        ),
        Validity("elastic_over_adhesion", 0.0, 0.49, "full contact may need a load: mu may be lower"),
        ELASTIC_CONTACT,
    ),
    notes="mu is the strength of the interface over the nominal pressure. Refused where flattening the roughness takes more "
    "than the work of adhesion.",
)
