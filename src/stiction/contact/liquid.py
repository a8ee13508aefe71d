"""Define the class Liquid, which describes a liquid that condenses into menisci between two bodies."""

from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import model_validator

from stiction.quantities.errors import InputError
from stiction.quantities.inputs import Input, Number, OptionalNumber, by_default
from stiction.quantities.shown import show

if TYPE_CHECKING:
    from stiction.quantities.arguments import NumberOrArray

# Molar gas constant [J/(mol K)], exact since 2019 (CODATA 2018).
GAS_CONSTANT = 8.31446261815324
# Molar volume of liquid water at 20 C [m^3/mol]: 18.015 g/mol over 0.99821 g/cm^3; between 0 and 60 C it changes by 1.7 %.
WATER = 18.05e-6
# Smallest radii [m] at which experiments confirmed Kelvin's equation: for organic liquids, and for water, measured down to a
# relative humidity of 94.5 % (Fisher, Gamble & Middlehurst 1981, and sources cited there).
CONFIRMED, CONFIRMED_OF_WATER = 4e-9, 9e-9
# Critical temperature of water, and the temperatures between which it is a liquid [K] (IAPWS R1-76, revised 2014).
_CRITICAL, _LIQUID = 647.096, (248.15, 647.096)

_LEAST_WETTING = 1e-6  # a smaller mean cosine may be the round-off of angles that add up to 180 deg


class Liquid(Input):
    """Describe a liquid whose vapour around a contact is in equilibrium with its menisci, such as water in humid air.

    Parameters
    ----------
    relative_humidity : float or array
        Vapour pressure divided by saturation pressure, above 0 and below 1.
    temperature : float [K] or str with a unit
        Temperature of vapour and bodies, by default 293.15 K.
    contact_angle_first, contact_angle_second : float [rad] or str with a unit
        Contact angle on each body, or on the film that it carries; 0 for a liquid that spreads.
    surface_tension : float [N/m] or str with a unit, optional
        By default the value of water at the temperature, which must then be at least 248.15 K and below 647.096 K.
    molar_volume : float [m^3/mol] or str with a unit, optional
        By default the value of water at 20 C.

    Raises
    ------
    InputError
        A number is out of its bounds, or the liquid does not condense: the cosines of both angles must add up to more than 0.

    Examples
    --------
    >>> import stiction as st
    >>> water = st.Liquid(relative_humidity=0.5, contact_angle_first="10 deg", contact_angle_second="10 deg")
    >>> round(float(water.kelvin_radius) * 1e9, 2)
    0.78
    """

    relative_humidity: Number
    contact_angle_first: Number
    contact_angle_second: Number
    temperature: Number = by_default(293.15)
    surface_tension: OptionalNumber = by_default(None)
    molar_volume: OptionalNumber = by_default(None)

    @model_validator(mode="after")
    def _wets(self):
        self.check_dimensions()
        if not np.all(np.asarray(self.wetting) > _LEAST_WETTING):
            allowed = "contact angles whose cosines sum to more than 0: no meniscus forms here, so leave out the liquid"
            angles = {name: float(np.max(getattr(self, name))) for name in ("contact_angle_second", "contact_angle_first")}
            name = max(angles, key=lambda name: angles[name])
            raise InputError(name, show(angles[name], name), allowed)
        if self.surface_tension is None:
            low, high = _LIQUID
            outside = (np.asarray(self.temperature) < low) | (np.asarray(self.temperature) >= high)
            if outside.any():
                raise InputError(
                    "surface_tension", None, f"a value of your own, because the preset water holds from {low} to {high} K only"
                )
        return self

    @property
    def wetting(self) -> "NumberOrArray":
        """Return the wetting factor c = (cos theta_1 + cos theta_2)/2 with the contact angles theta on both bodies."""
        cosines: Any = np.cos(self.contact_angle_first) + np.cos(self.contact_angle_second)
        return cosines / 2

    @property
    def tension(self) -> "NumberOrArray":
        """Return the surface tension [N/m]: the specified value, or the value of water at the temperature.

        Water: 0.2358 (1 - T/T_c)^1.256 (1 - 0.625 (1 - T/T_c)) (IAPWS R1-76).
        """
        if self.surface_tension is not None:
            return self.surface_tension
        below = 1 - self.temperature / _CRITICAL
        return 0.2358 * below**1.256 * (1 - 0.625 * below)

    @property
    def kelvin_radius(self) -> "NumberOrArray":
        """Return the Kelvin radius [m], the radius of a meniscus in equilibrium with the vapour.

        It is gamma_L V/(R_g T ln(p_s/p)), with surface tension, molar volume, gas constant and p_s/p = 1/relative_humidity
        (Thomson 1871).
        """
        volume = WATER if self.molar_volume is None else self.molar_volume
        potential: Any = -np.log(self.relative_humidity)
        return self.tension * volume / (GAS_CONSTANT * self.temperature * potential)

    @property
    def kelvin_radius_over_confirmed(self) -> "NumberOrArray":
        """Return the Kelvin radius divided by the smallest radius at which experiments confirmed Kelvin's equation.

        That radius is 9 nm for water and 4 nm for other liquids. A liquid with the default surface tension or molar volume
        counts as water.
        """
        of_water = self.molar_volume is None or self.surface_tension is None
        return self.kelvin_radius / (CONFIRMED_OF_WATER if of_water else CONFIRMED)

    @property
    def height(self) -> "NumberOrArray":
        """Return the largest gap [m] that a meniscus bridges: 2 r c, with Kelvin radius r and wetting factor c."""
        return 2 * self.kelvin_radius * self.wetting

    @property
    def suction(self) -> "NumberOrArray":
        """Return the Laplace pressure [Pa] by which a meniscus pulls: surface tension divided by Kelvin radius."""
        return self.tension / self.kelvin_radius

    @property
    def work(self) -> "NumberOrArray":
        """Return the energy per area to separate two wetted faces [J/m^2]: 2 gamma_L c.

        gamma_L: surface tension. c: wetting factor.
        """
        return 2 * self.tension * self.wetting
