"""Draw where a contact lies on two maps: the adhesion map and the plasticity map of its asperities."""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stiction.quantities.table import QUANTITIES
from stiction.report.pictures import BLUE, GREY, RED, canvas, finish

if TYPE_CHECKING:
    import xarray

    from stiction.contact.contact import Contact

_LEAST = 0.05  # adhesive part of the load, as a fraction, above which adhesion matters (Johnson & Greenwood 1997)
_FLOWING = 0.02  # plastic fraction of the real area at the onset of plasticity (Greenwood & Williamson 1966)
_TABOR = np.array([1e-3, 0.1, 5.0, 1e3])  # Tabor parameter: below 0.1 DMT, above 5 JKR


def regime_figure(contact: "Contact", data: "xarray.Dataset", title: str = "") -> Figure:
    """Draw where a contact lies on the adhesion map of Johnson & Greenwood and the plasticity map of Greenwood & Williamson.

    The adhesion map needs a work of adhesion, and the plasticity map a contact without a film; at least one of the two must
    apply. contact: a single contact. data: its result. If the result has `touching_asperities`, the adhesion map marks the mean
    asperity in contact at the largest load.
    """
    load = float(data["load"].max())
    drawn: list[Callable[[Axes], None]] = []
    if contact.work_of_adhesion:
        drawn.append(lambda axes: _adhesion(axes, contact, data, load))
    if contact.coating is None:
        drawn.append(lambda axes: _plasticity(axes, contact, load / float(contact.nominal_area)))
    figure, panels = canvas(8.53, 4.8, 1, len(drawn))
    for draw, axes in zip(drawn, panels, strict=True):
        draw(axes)
    figure.suptitle(title, fontsize=11)
    return figure


def _adhesion(axes: Axes, contact: "Contact", data: "xarray.Dataset", load: float) -> None:
    tabor = float(contact.tabor_parameter())
    negligible = np.array([2.0 / _LEAST] * 2 + [negligible_load_of_jkr()] * 2)
    axes.fill_between(_TABOR, negligible, 1e9, color=GREY, alpha=0.2, linewidth=0.0)
    axes.plot(_TABOR, negligible, color=GREY)
    axes.vlines(_TABOR[1:3], 1e-4, negligible[1:3], color=GREY, linestyle="--")
    for x, y, text in (
        (1.0, 1e6, "Hertz: adhesion below 5 % of the load"),
        (0.01, 0.1, "DMT"),
        (0.7, 0.1, "Maugis"),
        (60.0, 0.1, "JKR"),
    ):
        axes.text(x, y, text, ha="center", fontsize=9, zorder=4, bbox={"color": "white", "pad": 1.5})
    touching = (
        float(data["touching_asperities"].values.flat[int(np.argmax(data["load"].values))])
        if "touching_asperities" in data
        else 0.0
    )
    if touching > 0.0 and (work := contact.work_of_adhesion) is not None:
        each = load / touching / (np.pi * float(work) * float(contact.roughness.asperity_radius))
        _dot(axes, (tabor, each), ((1e-3, 1e3), (1e-3, 1e8)), RED, "mean asperity of this contact")
    else:
        axes.axvline(tabor, color=RED, label="this contact")
    name = f"{QUANTITIES['tabor_parameter'].short} ${QUANTITIES['tabor_parameter'].latex}$"
    finish(axes, xscale="log", yscale="log", xlim=(1e-3, 1e3), ylim=(1e-3, 1e8), xlabel=name)
    axes.set_ylabel("load of an asperity over $\\pi w R$")
    axes.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False)


def negligible_load_of_jkr() -> float:
    """Return the load, divided by pi w R, above which adhesion is below 5 % of the load by the JKR theory.

    The adhesive part of the load is 3 + sqrt(6 P + 9), with P the load over pi w R.
    """
    # (P/20 - 3)^2 = 6 P + 9
    return (6.0 + 6.0 * _LEAST) / _LEAST**2


def _plasticity(axes: Axes, contact: "Contact", pressure: float) -> None:
    row, index = QUANTITIES["plasticity_index"], float(contact.plasticity_index)
    rough = contact.roughness
    density = rough.asperity_density * rough.asperity_radius * rough.asperity_height_deviation
    psi = np.geomspace(0.1, 100.0, 200)
    onset = pressures_of_first_flow(psi, float(density))
    axes.fill_between(psi, onset, 10.0, color=RED, alpha=0.12, linewidth=0.0)
    axes.plot(psi, onset, color=GREY)
    axes.text(10.0, 1e-3, "plastic", ha="center", fontsize=9)
    axes.text(0.25, 1e-3, "elastic", ha="center", fontsize=9)
    hardness = min(float(contact.first.hardness), float(contact.second.hardness))
    _dot(axes, (index, pressure / hardness), ((0.1, 100.0), (1e-8, 1.0)), BLUE, "this contact")
    finish(axes, xscale="log", yscale="log", xlim=(0.1, 100.0), ylim=(1e-8, 1.0), xlabel=f"{row.short} ${row.latex}$")
    axes.set_ylabel("nominal pressure over hardness")
    axes.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False)


def _dot(axes: Axes, place: tuple[float, float], ends: tuple[tuple[float, float], ...], colour: str, name: str) -> None:
    """Draw a dot with a name; a dot outside the map is drawn on its edge, and the name states this."""
    x, y = (float(np.clip(value, low, high)) for value, (low, high) in zip(place, ends, strict=True))
    name += "" if (x, y) == place else ", beyond the edge"
    axes.plot(x, y, "o", color=colour, markersize=9, label=name, clip_on=False, zorder=5)


def pressures_of_first_flow(indices: np.ndarray, density: float) -> np.ndarray:
    """Return the nominal pressures over the hardness (n,) at which F_1(s + index^-2) reaches 2 % of F_1(s).

    Greenwood & Williamson (1966) take this as the onset of plastic contact. F_1(s) is the integral of (z - s) phi(z) over z >
    s, with the standard Gaussian density phi and the separation s over sigma. indices (n,): plasticity indices. density: N R
    sigma. The pressure is infinite where no s from -4 to 6 reaches 2 %.
    """
    z, weights, area, load = _gaussian_sums()
    flows = np.clip(z - indices[:, None] ** -2.0, 0.0, None) @ weights >= _FLOWING * area
    last = area.size - 1 - np.argmax(flows[:, ::-1], axis=1)
    return np.where(flows.any(axis=1), 4.0 / 3.0 * density * indices * load[last], np.inf)


@cache
def _gaussian_sums() -> tuple[np.ndarray, ...]:
    """Return the table from which `pressures_of_first_flow` reads, for Gaussian asperity heights with sigma = 1.

    Returns compressions z (n,); the density of the heights s + z at 201 separations s, multiplied by the weights of the
    trapezoidal rule over z (n, 201); and two integrals over z, of z times the density and of z^1.5 times the density, (201,)
    each.
    """
    z, step = np.linspace(0.0, 12.0, 1201, retstep=True)
    density = np.exp(-0.5 * (np.linspace(-4.0, 6.0, 201) + z[:, None]) ** 2) / np.sqrt(2.0 * np.pi)
    density[[0, -1]] *= 0.5
    weights = step * density
    return z, weights, z @ weights, z**1.5 @ weights
