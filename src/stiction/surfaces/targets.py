"""Define power spectra for generated surfaces, with spectral moments in closed form.

The power spectral density C depends on the magnitude q of the wave vector [rad/m]. It is normalised so that the mean square
height is

    m0 = Int C(q) d^2q / (2 pi)^2   of a surface, C in m^4,        m0 = Int C(q) dq / (2 pi)   of a profile, C in m^3,

where every component takes both signs. The moments are those of a profile along a line, as in `surfaces.theory.moments`. For
an isotropic surface let M_k = Int C q^(k+1) dq / (2 pi). Then m0 = M_0, m2 = M_2 / 2 and m4 = 3 M_4 / 8, because the mean
over all directions is 1/2 for cos^2 and 3/8 for cos^4 (Nayak 1971).
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from numbers import Real

import numpy as np

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import require_positive
from stiction.quantities.shown import show
from stiction.surfaces.heightmap import in_metres
from stiction.surfaces.theory.moments import Moments

_SHARES = {1: (1.0, 1.0, 1.0), 2: (1.0, 1.0 / 2.0, 3.0 / 8.0)}  # m_k / M_k of a profile for k = 0, 2, 4, by dimensions
_SOLID = {1: math.pi, 2: 2.0 * math.pi}  # (2 pi)^d over the solid angle of all directions of q, by dimensions d
_EDGE = 1e-9  # relative margin that includes a wave on an edge of the spectrum in spite of round-off


def line_moments(dimensions: int, integrals: Iterable[float]) -> Moments:
    """Return the spectral moments m0, m2, m4 of a profile from integrals over the power spectral density C.

    dimensions: d, 2 if C belongs to a surface, 1 for a profile. integrals: Int C q^(k + d) d ln q for k = 0, 2, 4.
    """
    return Moments(
        *(share * integral / _SOLID[dimensions] for share, integral in zip(_SHARES[dimensions], integrals, strict=True))
    )


def _to_metres(spectrum, *names: str) -> None:
    """Convert the named attributes of a spectrum from text with a unit to metres, in place; numbers stay unchanged."""
    for name in names:
        object.__setattr__(spectrum, name, in_metres(getattr(spectrum, name), name))


def _powers(low: float, high: float, exponent: float) -> float:
    """Return the integral of q^(exponent - 1) over q from low to high."""
    if abs(exponent) < 1e-12:
        return math.log(high / low)
    return (high**exponent - low**exponent) / exponent


@dataclass(frozen=True)
class SelfAffine:
    """Define a self-affine power spectrum between two wavelengths, constant above its roll-off wavelength.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, 0 to 1: C decreases as q^(-2 - 2 H) for a surface and as q^(-1 - 2 H) for a profile.
    rolloff, shortest : float [m] or str with a unit
        Wavelength above which C is constant, and shortest wavelength; 0 < shortest <= rolloff <= longest, and
        shortest < longest.
    deviation : float [m] or str with a unit
        Root mean square height, above 0.
    longest : float [m] or str with a unit, optional
        Wavelength above which C is zero, by default infinite.
    dimensions : int, optional
        2 for a surface (default), 1 for a profile.

    Raises
    ------
    InputError
        A number is out of these bounds.

    Notes
    -----
    C is the power spectral density at the wavenumber q = 2 pi / wavelength [rad/m].

    Examples
    --------
    >>> import stiction as st
    >>> target = st.SelfAffine(hurst=0.8, rolloff="2 um", shortest="200 nm", deviation="10 nm")
    >>> round(target.rms_slope, 2)
    0.06
    """

    hurst: float
    rolloff: float
    shortest: float
    deviation: float
    longest: float = math.inf
    dimensions: int = 2

    def __post_init__(self) -> None:
        _to_metres(self, "rolloff", "shortest", "deviation", "longest")
        if not (isinstance(self.hurst, Real) and 0.0 <= self.hurst <= 1.0):
            raise InputError("hurst", self.hurst, "0 to 1")
        if not isinstance(self.dimensions, Real) or self.dimensions not in _SHARES:
            raise InputError("dimensions", self.dimensions, "2 for a surface, 1 for a profile")
        require_positive(shortest=self.shortest, deviation=self.deviation, rolloff=self.rolloff)
        if not self.shortest <= self.rolloff < math.inf:
            raise InputError("rolloff", self.rolloff, f"a wavelength in m, not below the shortest, {self.shortest:g} m")
        if not self.longest >= self.rolloff:
            raise InputError("longest", self.longest, f"a wavelength in m, not below the roll-off, {self.rolloff:g} m")
        if self.shortest == self.longest:
            raise InputError("longest", self.longest, f"above the shortest wavelength, {self.shortest:g} m")

    def with_slope(self, slope: float) -> "SelfAffine":
        """Return this spectrum multiplied by a factor, so that the rms gradient of its surfaces is `slope` [1], above 0."""
        require_positive(slope=slope)
        return replace(self, deviation=self.deviation * slope / self.rms_slope)

    def __str__(self) -> str:
        lengths = {"roll-off": self.rolloff, "shortest wave": self.shortest, "longest wave": self.longest}
        texts = [f"{name} {show(value, 'mean_separation')}" for name, value in lengths.items() if math.isfinite(value)]
        return f"self-affine, H {self.hurst:g}, {', '.join(texts)}, rms height {show(self.deviation, 'mean_separation')}"

    @property
    def rms_slope(self) -> float:
        """Return the rms gradient [1]: sqrt(2 m2) of a surface, or sqrt(m2) of a profile, with the spectral moment m2."""
        return math.sqrt(self.dimensions * self.moments.m2)

    @property
    def moments(self) -> Moments:
        """Return the spectral moments m0 [m^2], m2 [1], m4 [1/m^2] of a profile, in closed form.

        The integrals assume a continuous spectrum, as on an infinite surface.
        """
        plateau = self._plateau
        return line_moments(self.dimensions, (plateau * self._shape(k) for k in (0, 2, 4)))

    def __call__(self, q: np.ndarray) -> np.ndarray:
        """Return the power spectral density C at wavenumbers q >= 0 [rad/m]: m^4 for a surface, m^3 for a profile.

        C is 0 for waves shorter than `shortest` or longer than `longest`.
        """
        lowest, corner, highest = self._edges()
        inside = (q >= lowest * (1.0 - _EDGE)) & (q <= highest * (1.0 + _EDGE))
        falling = np.maximum(q, corner) / corner
        return np.where(inside, self._plateau * falling ** (-self.dimensions - 2.0 * self.hurst), 0.0)

    @property
    def _plateau(self) -> float:
        """Return the constant power spectral density C [m^4 or m^3] of waves longer than the roll-off wavelength."""
        return self.deviation**2 * _SOLID[self.dimensions] / self._shape(0)

    def _edges(self) -> tuple[float, float, float]:
        """Return the wavenumbers [rad/m] of the longest wave, the roll-off and the shortest wave."""
        return 2.0 * math.pi / self.longest, 2.0 * math.pi / self.rolloff, 2.0 * math.pi / self.shortest

    def _shape(self, k: int) -> float:
        """Return Int C q^(k + dimensions - 1) dq divided by the plateau value of C, the power spectral density at small q."""
        lowest, corner, highest = self._edges()
        d, h = self.dimensions, self.hurst
        flat = _powers(lowest, corner, k + d)
        return flat + corner ** (d + 2.0 * h) * _powers(corner, highest, k - 2.0 * h)


@dataclass(frozen=True)
class GaussianCorrelation:
    """Define the power spectrum of a surface with the autocorrelation deviation^2 exp(-r^2 / length^2) at the distance r.

    Such a surface is smooth and has one length scale. Nayak's alpha is exactly 3. deviation: rms height [m]. length:
    correlation length [m]. Both are above 0 and may be text with a unit. dimensions: 2 for a surface, 1 for a profile.
    Raises InputError for other values.
    """

    deviation: float
    length: float
    dimensions: int = 2

    def __post_init__(self) -> None:
        _to_metres(self, "deviation", "length")
        require_positive(deviation=self.deviation, length=self.length)
        if self.dimensions not in _SHARES:
            raise InputError("dimensions", self.dimensions, "2 for a surface, 1 for a profile")

    def __str__(self) -> str:
        length, deviation = (show(value, "mean_separation") for value in (self.length, self.deviation))
        return f"Gaussian autocorrelation, correlation length {length}, rms height {deviation}"

    @property
    def moments(self) -> Moments:
        """Return the spectral moments m0 [m^2], m2 [1], m4 [1/m^2] of a profile, from the autocorrelation at r = 0."""
        m0 = self.deviation**2
        return Moments(m0, 2.0 * m0 / self.length**2, 12.0 * m0 / self.length**4)

    def __call__(self, q: np.ndarray) -> np.ndarray:
        """Return the power spectral density C at wavenumbers q >= 0 [rad/m]: m^4 for a surface, m^3 for a profile."""
        plateau = self.deviation**2 * (math.sqrt(math.pi) * self.length) ** self.dimensions
        return plateau * np.exp(-np.minimum((0.5 * q * self.length) ** 2, 700.0))
