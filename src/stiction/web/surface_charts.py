"""Charts of a scan: its spectrum with the waves that are kept, its heights in three dimensions."""

import math
from typing import Any

import numpy as np

from stiction.quantities.units import show
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.spectrum import BinnedSpectrum
from stiction.web.charts import INK, SHADES, chart, line
from stiction.web.surface_work import Band

_SHOWN = 96  # points along a side of the map in three dimensions

_DECADES = 10  # of the spectrum; a filter leaves rounding below


def wavevectors(surface: HeightMap) -> tuple[float, float]:
    """Wavevectors [rad/m] of the longest and the shortest wave that a scan can have."""
    return 2.0 * math.pi / max(surface.size), math.pi / surface.coarsest_pitch


def spectrum_chart(
    whole: BinnedSpectrum, kept: BinnedSpectrum, band: Band, ends: tuple[float, float], dark: bool
) -> dict[str, Any]:
    """The spectrum as it was and of what is kept, between the ends [rad/m]; shaded where waves are taken out."""
    top = math.ceil(math.log10(whole.density.max()))
    limits = [10.0 ** (top - _DECADES), 10.0**top]
    left_out = []
    for length, end, which in ((band.longest, ends[0], "longer"), (band.shortest, ends[1], "shorter")):
        if length is not None:
            low, high = sorted((end, 2.0 * math.pi / length))
            left_out.append([{"xAxis": low, "name": f"{which} than {show(length, 'scan_size', 3)}"}, {"xAxis": high}])
    area = {
        "silent": True,
        "itemStyle": {"color": "rgba(128, 128, 128, 0.25)"},
        "label": {"color": INK[dark], "position": "insideTop"},
        "data": left_out,
    }
    series = []
    for name, one, at in (("as measured", whole, 1), ("of the waves that are kept", kept, 0)):
        seen = np.where(one.density > limits[0], one.density, np.nan)
        series.append(line(name, one.wavevector, seen, at, showSymbol=False, clip=True))
    series[1]["markArea"] = area
    unit = "m^3" if whole.is_profile else "m^4"
    x = {"type": "log", "name": "wavevector q [rad/m]", "min": ends[0], "max": ends[1]}
    y = {"type": "log", "name": f"C [{unit}]", "min": limits[0], "max": limits[1]}
    return chart("radially averaged power spectrum against the wavevector", x, y, series, dark)


def solid_chart(surface: HeightMap, dark: bool) -> dict[str, Any]:
    """The heights in three dimensions, of some of the points; the vertical is stretched."""
    rows, columns = (max(count // _SHOWN, 1) for count in surface.heights.shape)
    heights = surface.heights[::rows, ::columns] * 1e9
    along_y, along_x = surface.pitch[0] * rows * 1e6, surface.pitch[1] * columns * 1e6
    points = [[j * along_x, i * along_y, None if np.isnan(z) else float(z)] for (i, j), z in np.ndenumerate(heights)]
    seen = [float(np.nanmin(heights)), float(np.nanmax(heights))]
    ink = INK[dark]
    look = {"axisLine": {"lineStyle": {"color": ink}}, "axisLabel": {"color": ink}, "nameTextStyle": {"color": ink}}
    axes = {
        f"{name}Axis3D": {"type": "value", "name": said, "nameGap": 30, "splitNumber": 3, **look}
        for name, said in zip("xyz", ("x [um]", "y [um]", "z [nm]"), strict=True)
    }
    return axes | {
        "grid3D": {"boxHeight": 30, "viewControl": {"distance": 230}},
        "visualMap": {"min": seen[0], "max": seen[1], "dimension": 2, "inRange": {"color": SHADES}, "show": False},
        "series": [{"type": "surface", "wireframe": {"show": False}, "data": points, "dataShape": list(heights.shape)}],
    }
