"""Draw surfaces: height maps, spectra, and the asperities that each of the methods finds.

Each length is drawn in the unit that suits its size.
"""

import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import FixedLocator, MaxNLocator, NullLocator

from stiction.quantities.shown import show
from stiction.report.pictures import BLUE, COLOUR_MAP, GREEN, GREY, SKY, canvas, finish, look_of, plain, say
from stiction.report.table import prefix, unit_for
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.spectrum import BinnedSpectrum

_ABSENT: dict[str, Any] = {"facecolor": "#dddddd", "edgecolor": GREY, "hatch": "////"}  # style of missing points
_MOST = 1200  # largest number of points along a side of a picture, which has fewer pixels anyway
_OUTLYING = 0.1  # per cent of the heights at either end that colours and axes leave out
_FAR = 6.0  # heights further from the median than this many robust deviations count as spikes
_BINS = 120
_ENOUGH = 10**6


# ---- heights


def map_figure(surface: HeightMap, title: str = "", asperities: Asperities | None = None) -> Figure:
    """Draw a height map in colours, or a profile as a line, next to a histogram of heights.

    Missing points of a map are grey and hatched. The colour scale and the histogram of a map leave out spikes and the lowest
    and highest 0.1 % of the heights. title: by default the name of the surface. asperities: asperities to mark, if their method
    gives positions.
    """
    shape = (8.0, 3.2) if surface.is_profile else (4.4 * min(max(surface.size[1] / surface.size[0], 0.5), 2.2) + 1.6, 4.8)
    figure = Figure(figsize=(shape[0] + 3.4, shape[1]), layout="compressed")
    figure.suptitle(title or surface.name, fontsize=11)
    picture, bars = figure.subplots(1, 2, width_ratios=(shape[0], 3.0))
    valid = surface.heights[~np.isnan(surface.heights)]
    if valid.size == 0:
        say(picture, "all points are missing")
        say(bars, "no heights")
        return figure
    ends = (float(valid.min()), float(valid.max())) if surface.is_profile else _limits(_some(valid))
    factor, unit = prefix("scan_size", ends[1] - ends[0])
    if surface.is_profile:
        _draw_profile(picture, surface, factor, unit)
    else:
        image = _draw_map(picture, surface, ends, factor)
        beyond = {(False, False): "neither", (True, False): "min", (False, True): "max", (True, True): "both"}
        outside = beyond[bool(valid.min() < ends[0]), bool(valid.max() > ends[1])]
        figure.colorbar(image, ax=picture, extend=outside, label=f"height [{unit}]")
    _histogram(bars, _some(valid) * factor, (ends[0] * factor, ends[1] * factor), unit)
    notes = []
    if surface.missing:
        share = 100.0 * surface.missing / surface.heights.size
        notes.append(f"grey: {surface.missing} points missing ({share:.2g} %)")
    if asperities is not None:
        notes.append(_draw_places(picture, surface, asperities, factor))
    picture.set_title("; ".join(notes), fontsize=9, color=GREY)
    return figure


def _draw_places(axes: Axes, surface: HeightMap, asperities: Asperities, factor: float) -> str:
    """Mark every asperity in a picture of heights, and return a caption with their number.

    If the method gives only averages, nothing is marked and the caption states this. factor: from metres to the unit of the
    height axis. Marks are smaller if there are many.
    """
    if not len(asperities.places):
        return f"{plain(asperities.method)}: averages only, no positions"
    across, _ = prefix("scan_size", surface.size[1] if surface.is_profile else max(surface.size))
    row, column = asperities.places.T
    if surface.is_profile:
        x, y = column * surface.pitch[1] * across, surface.heights[row, column] * factor
    else:
        x, y = ((index + 0.5) * pitch * across for index, pitch in zip((column, row), surface.pitch[::-1], strict=True))
    size = min(max(3000.0 / len(row), 2.0), 30.0)
    axes.scatter(x, y, s=size, c="white", edgecolors="black", linewidths=0.4 if size < 6.0 else 0.8, zorder=3)
    return f"{len(row)} {plain(asperities.method)}"


def _some(heights: np.ndarray) -> np.ndarray:
    """Return at most a million of the heights, every k-th one, to speed up a histogram."""
    return heights[:: -(-heights.size // _ENOUGH)]


def _limits(heights: np.ndarray) -> tuple[float, float]:
    """Return the height limits of a picture, which leave out spikes and the outer 0.1 % of heights at each end.

    If all other heights are equal, the limits are the minimum and maximum of all.
    """
    low, below, middle, above, high = np.percentile(heights, (_OUTLYING, 17.0, 50.0, 83.0, 100.0 - _OUTLYING))
    reach = _FAR * 0.5 * (above - below)
    if reach > 0.0:
        low, high = max(low, middle - reach), min(high, middle + reach)
    return (float(low), float(high)) if high > low else (float(heights.min()), float(heights.max()))


def _draw_map(axes: Axes, surface: HeightMap, ends: tuple[float, float], factor: float) -> AxesImage:
    step = [-(-count // _MOST) for count in surface.heights.shape]
    shown = np.ma.masked_invalid(surface.heights[:: step[0], :: step[1]]) * factor
    across, length = prefix("scan_size", max(surface.size))
    # With skipped points the last pixel reaches beyond the map; xlim and ylim end the picture at the map.
    top, right = (n * k * pitch * across for n, k, pitch in zip(shown.shape, step, surface.pitch, strict=True))
    if surface.missing:
        axes.patch.set(**_ABSENT)
    look: dict[str, Any] = {"cmap": COLOUR_MAP, "vmin": ends[0] * factor, "vmax": ends[1] * factor, "interpolation": "nearest"}
    image = axes.imshow(shown, extent=(0.0, right, 0.0, top), origin="lower", **look)
    axes.set_aspect("equal" if max(surface.size) < 4.0 * min(surface.size) else "auto")
    axes.set(xlim=(0.0, surface.size[1] * across), ylim=(0.0, surface.size[0] * across))
    axes.set(xlabel=f"x [{length}]", ylabel=f"y [{length}]")
    return image


def _draw_profile(axes: Axes, surface: HeightMap, factor: float, unit: str) -> None:
    across, length = prefix("scan_size", surface.size[1])
    pitch = surface.pitch[1] * across
    for start, end in _runs(np.isnan(surface.heights[0])):
        axes.axvspan((start - 0.5) * pitch, (end - 0.5) * pitch, linewidth=0.0, **_ABSENT)
    axes.plot(np.arange(surface.heights.shape[1]) * pitch, surface.heights[0] * factor, color=BLUE, linewidth=0.9)
    finish(axes, xlabel=f"x [{length}]", ylabel=f"height [{unit}]", xlim=(0.0, surface.size[1] * across))


def _runs(marked: np.ndarray) -> np.ndarray:
    """Return (first, last + 1) of each run of consecutive marked points, shape (n, 2)."""
    steps = np.diff(np.concatenate(([0], marked.astype(np.int8), [0])))
    return np.column_stack((np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)))


def _histogram(axes: Axes, heights: np.ndarray, ends: tuple[float, float], unit: str) -> None:
    """Draw a horizontal histogram of heights, and the Gaussian with the same mean and deviation."""
    edges, share = _shares(heights, ends, _BINS)
    outside = 100.0 * float(np.mean((heights < ends[0]) | (heights > ends[1])))
    text = "points" + (f" ({outside:.2g} % outside)" if outside else "")
    axes.stairs(share, edges, orientation="horizontal", fill=True, color=SKY, label=text)
    mean, deviation = float(heights.mean()), float(heights.std())
    if deviation > 0.0:
        z = np.linspace(edges[0], edges[-1], 300)
        axes.plot(
            _bell(z, mean, deviation), z, color="black", linestyle="--", linewidth=1.2, label="Gaussian of the\nsame deviation"
        )
    axes.set(xlabel=f"share of the points [1/{unit}]", ylabel=f"height [{unit}]")
    axes.xaxis.set_major_locator(MaxNLocator(2))
    axes.yaxis.set_label_position("right")
    axes.yaxis.tick_right()
    finish(axes)


def _shares(heights: np.ndarray, ends: tuple[float, float], most: int) -> tuple[np.ndarray, np.ndarray]:
    """Return edges (n + 1,) and densities (n,) of a histogram of heights between the two limits `ends`.

    The densities refer to all heights, also those outside the limits. most: largest number of bins.
    """
    number, edges = np.histogram(heights, bins=min(most, max(6, math.isqrt(heights.size))), range=ends)
    return edges, number / (heights.size * np.diff(edges))


def _bell(z: np.ndarray, mean: float, deviation: float) -> np.ndarray:
    return np.exp(-0.5 * np.minimum(((z - mean) / deviation) ** 2, 1400.0)) / (math.sqrt(2.0 * math.pi) * deviation)


# ---- spectra


def spectrum_figure(spectrum: BinnedSpectrum | Mapping[str, BinnedSpectrum], title: str = "") -> Figure:
    """Draw power spectra against the wavevector; the reliable band of wavelengths is shaded, and its points are filled.

    spectrum: one spectrum, or spectra by name, all of maps or all of profiles. The shaded band belongs to the first spectrum.
    """
    named = {"": spectrum} if isinstance(spectrum, BinnedSpectrum) else dict(spectrum)
    figure, (axes,) = canvas(8.2, 5.6)
    first = next(iter(named.values()))
    if not any((drawn.density > 0.0).any() for drawn in named.values()):
        say(axes, "no waves: all heights are alike")
        return figure
    factor, unit = prefix("scan_size", float(first.wavelength.max()))
    power = 3 if first.is_profile else 4
    for number, (name, drawn) in enumerate(named.items()):
        _spectrum_line(axes, drawn, factor, power, name, look_of("", number))
    if first.longest > first.shortest:
        band = [2.0 * math.pi / (length * factor) for length in (first.longest, first.shortest)]
        ends = " to ".join(show(length, "mean_separation", 3) for length in (first.longest, first.shortest))
        axes.axvspan(*band, color=GREEN, alpha=0.1, linewidth=0.0, label=f"reliable band: wavelengths of {ends}")
    figure.suptitle(title, fontsize=11)
    axes.set_xlabel(rf"wavevector $q = 2\pi$ / wavelength [rad/{unit}]")
    axes.set_ylabel(f"power spectral density $C$ [{unit}{'³' if first.is_profile else '⁴'}]")
    finish(axes, xscale="log", yscale="log")
    _wavelengths_above(axes, factor)
    return figure


def _spectrum_line(axes: Axes, spectrum: BinnedSpectrum, factor: float, power: int, name: str, look: dict[str, Any]) -> None:
    q, density = spectrum.wavevector / factor, spectrum.density * factor**power
    drawn = density > 0.0
    axes.plot(q[drawn], density[drawn], color=look["color"], linewidth=0.8, alpha=0.45)
    for part, inside, text in (
        (drawn & ~spectrum.reliable, "white", "not reliable"),
        (drawn & spectrum.reliable, None, "reliable"),
    ):
        text = f"{name}, {text}" if name else f"average of a bin, {text}"
        axes.plot(q[part], density[part], linestyle="", mfc=inside, label=text if part.any() else None, **look)


def _wavelengths_above(axes: Axes, factor: float) -> None:
    low, high = (2.0 * math.pi / (q * factor) for q in reversed(axes.get_xlim()))
    above = axes.twiny()
    above.set(xscale="log", xlim=axes.get_xlim(), xlabel="wavelength")
    marks = _round_lengths(low, high)
    above.xaxis.set_major_locator(FixedLocator([2.0 * math.pi / (length * factor) for length in marks]))
    above.xaxis.set_minor_locator(NullLocator())
    above.set_xticklabels([show(length, "mean_separation") for length in marks])


def _round_lengths(low: float, high: float) -> list[float]:
    """Return the powers of ten [m] between two lengths; if there are fewer than two, return 1, 2 and 5 times powers of ten."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    tens, more = ([lead * 10.0**power for power in powers for lead in leads] for leads in ((1,), (1, 2, 5)))
    tens, more = ([length for length in lengths if low <= length <= high] for lengths in (tens, more))
    return tens if len(tens) > 1 else more


# ---- asperities


def asperity_figure(asperity_sets: Iterable[Asperities], surface: HeightMap | None = None, title: str = "") -> Figure:
    """Draw the distribution of asperity heights by each method, with sigma, R and N in the legend.

    A method that gives averages only is drawn as a dashed Gaussian. surface: height map whose height distribution is drawn in
    grey.
    """
    sets = list(asperity_sets)
    figure = Figure(figsize=(11, 5.2), layout="constrained")
    figure.suptitle(title or (surface.name if surface else ""), fontsize=11)
    axes = figure.subplots()
    if not sets:
        say(axes, "no asperities")
        return figure
    ends = _ends(sets)
    factor, unit = prefix("scan_size", ends[1] - ends[0])
    per_area = unit_for("asperity_density", max(asperities.density for asperities in sets))
    if surface is not None and surface.missing < surface.heights.size:
        heights = surface.heights[~np.isnan(surface.heights)]
        edges, share = _shares((_some(heights) - heights.mean()) * factor, (ends[0] * factor, ends[1] * factor), _BINS)
        axes.stairs(share, edges, fill=True, color="#dddddd", label=f"all {heights.size} points")
    for number, asperities in enumerate(sets):
        _height_line(axes, asperities, factor, look_of(asperities.method, number)["color"], _summed_up(asperities, *per_area))
    axes.set(xlabel=f"height over the mean plane [{unit}]", ylabel=f"share of the asperities [1/{unit}]")
    finish(axes, legend=False, xlim=(ends[0] * factor, ends[1] * factor), ylim=(0.0, None))
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=9, labelspacing=0.9, frameon=False)
    return figure


def _ends(sets: list[Asperities]) -> tuple[float, float]:
    """Return the height limits [m] of the picture of asperities.

    They follow from the heights of single asperities or, if no method gives these, from mean and deviation of the heights.
    """
    each = [_limits(asperities.heights) for asperities in sets if asperities.count and asperities.deviation > 0.0]
    each = each or [
        (asperities.mean_height - 4.0 * asperities.deviation, asperities.mean_height + 4.0 * asperities.deviation)
        for asperities in sets
    ]
    low, high = min(low for low, _ in each), max(high for _, high in each)
    room = 0.1 * (high - low) or 1e-9
    return low - room, high + room


def _summed_up(asperities: Asperities, factor: float, unit: str) -> str:
    """Return the legend text of one asperity method: its name, the number of asperities, sigma, R and N."""
    count = f": {asperities.count}" if asperities.count else ", averages only"
    sigma, radius = show(asperities.deviation, "asperity_height_deviation", 3), show(asperities.radius, "asperity_radius", 3)
    density = f"{asperities.density * factor:.3g}{unit.removeprefix('1')}"
    return f"{plain(asperities.method)}{count}\n$\\sigma$ = {sigma}, $R$ = {radius},\n$N$ = {density}"


def _height_line(axes: Axes, asperities: Asperities, factor: float, colour: str, text: str) -> None:
    look: dict[str, Any] = {"color": colour, "label": text, "linewidth": 1.6}
    mean, deviation = asperities.mean_height * factor, asperities.deviation * factor
    if asperities.count and asperities.deviation > 0.0:
        low, high = _limits(asperities.heights)
        edges, share = _shares(asperities.heights * factor, (low * factor, high * factor), _BINS // 2)
        axes.stairs(share, edges, **look)
    elif asperities.deviation > 0.0:
        z = np.linspace(mean - 4.0 * deviation, mean + 4.0 * deviation, 200)
        axes.plot(z, _bell(z, mean, deviation), linestyle="--", **look)
    else:
        axes.axvline(mean, **look)
