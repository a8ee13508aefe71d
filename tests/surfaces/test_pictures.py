"""Pictures of surfaces carry the numbers they are given, in the units their axes name."""

from pathlib import Path

import numpy as np
import pytest
import xarray
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex

from refusals import refusal
from stiction.contact.contact import Contact
from stiction.report.method_pictures import method_spread_figure, resolution_figure
from stiction.report.surface_pictures import asperity_figure, map_figure, spectrum_figure
from stiction.solving.choice import Choice
from stiction.solving.method_spread import with_method_spread
from stiction.solving.solve import solve
from stiction.surfaces.asperity_set import Asperities
from stiction.surfaces.finding import asperities
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.prepare import level
from stiction.surfaces.read import read_scan
from stiction.surfaces.roughness import Roughness
from stiction.surfaces.spectrum import BinnedSpectrum

SCANS = Path(__file__).resolve().parents[2].parent / "shared" / "scans"


@pytest.fixture(autouse=True)
def matplotlib_does_its_own_arithmetic(no_silent_nan):
    """It divides zero by zero inside, and looks at the result afterwards."""
    with np.errstate(all="ignore"):
        yield


def lines(axes):
    return {line.get_label(): line for line in axes.lines}


def legend(figure):
    return [text.get_text() for one in (figure.legends or [figure.axes[0].get_legend()]) for text in one.get_texts()]


def texts(axes):
    return [text.get_text() for text in axes.texts]


def inside(figure):
    """Nothing of the drawn picture is beyond its edge, and its axes have a size: the layout has found room."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    box = figure.get_tightbbox(canvas.get_renderer())
    width, height = figure.get_size_inches()
    assert min(box.x0, box.y0) >= -0.01 and box.x1 <= width + 0.01 and box.y1 <= height + 0.01, box
    return all(min(axes.get_position().size) > 0.01 for axes in figure.axes)


# ---- heights


def bumps(rows=40, columns=60, name="bumps"):
    heights = np.random.default_rng(5).normal(0.0, 3e-9, (rows, columns))
    return HeightMap(heights, (rows * 50e-9, columns * 50e-9), name=name)


def test_a_map_shows_its_heights_in_nanometres_on_axes_of_micrometres():
    surface = bumps()
    figure = map_figure(surface)
    picture, bars, colours = figure.axes
    (image,) = picture.images
    np.testing.assert_allclose(image.get_array(), surface.heights * 1e9, rtol=1e-14)
    assert image.get_extent() == pytest.approx((0.0, 3.0, 0.0, 2.0)) and image.origin == "lower"
    assert picture.get_xlabel() == "x [µm]" and picture.get_ylabel() == "y [µm]" and picture.get_aspect() == 1.0
    assert colours.get_ylabel() == bars.get_ylabel() == "height [nm]" and bars.get_xlabel() == "share of the points [1/nm]"
    assert figure.get_suptitle() == "bumps" and map_figure(surface, "a title").get_suptitle() == "a title"
    assert inside(figure)


def test_the_histogram_is_that_of_the_heights():
    """Shares add up to what lies between its ends; the Gaussian curve beside it has the mean and deviation of the points."""
    surface = bumps()
    bars = map_figure(surface).axes[1]
    shares, edges, _ = bars.patches[0].get_data()
    heights = surface.heights * 1e9
    assert np.sum(shares * np.diff(edges)) == pytest.approx(np.mean((heights >= edges[0]) & (heights <= edges[-1])))
    np.testing.assert_allclose(shares * np.diff(edges) * heights.size, np.histogram(heights, edges)[0], atol=1e-6)
    curve, z = bars.lines[0].get_data()
    assert z[np.argmax(curve)] == pytest.approx(heights.mean(), abs=0.1)
    assert curve.max() == pytest.approx(1.0 / (np.sqrt(2.0 * np.pi) * heights.std()), rel=1e-3)


def test_missing_points_are_masked_grey_and_counted():
    surface = bumps()
    heights = surface.heights.copy()
    heights[3:9, 10:20] = heights[0, 0] = np.nan
    picture = map_figure(surface.with_heights(heights, "holes")).axes[0]
    np.testing.assert_array_equal(np.ma.getmaskarray(picture.images[0].get_array()), np.isnan(heights))
    assert to_hex(picture.get_facecolor()) == "#dddddd" and picture.patch.get_hatch()
    assert picture.get_title() == "grey: 61 points missing (2.5 %)"
    canvas = FigureCanvasAgg(picture.figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[..., :3]
    x, y = picture.transData.transform((15 * 0.05, 6 * 0.05))
    hole = pixels[pixels.shape[0] - int(y) - 4 : pixels.shape[0] - int(y) + 4, int(x) - 8 : int(x) + 8].astype(int)
    assert (np.ptp(hole, axis=-1) < 3).all() and (hole == 0xDD).any()  # grey, with darker hatches


def test_a_few_spikes_do_not_take_the_colours():
    surface = bumps(100, 100)
    heights = surface.heights.copy()
    heights[::10, ::10] = 1e-6  # one point in a hundred, a hundred times as high
    picture, bars, _ = map_figure(surface.with_heights(heights, "spikes")).axes
    low, high = picture.images[0].get_clim()
    assert -30.0 < low < -6.0 and 6.0 < high < 30.0
    assert picture.images[0].colorbar.extend == "both" and legend_of(bars)[0] == "points (1.1 % outside)"


def legend_of(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_large_maps_are_thinned_and_still_end_where_they_end():
    heights = np.arange(2500.0 * 8.0).reshape(8, 2500) * 1e-9
    picture = map_figure(HeightMap(heights, (8e-6, 2500e-6))).axes[0]
    np.testing.assert_allclose(picture.images[0].get_array(), heights[:, ::3] * 1e6, rtol=1e-14)
    assert picture.get_xlim() == pytest.approx((0.0, 2.5)) and picture.get_xlabel() == "x [mm]"
    assert picture.images[0].get_extent()[1] == pytest.approx(2.502)


def test_a_profile_is_a_line_with_gaps_shaded():
    heights = np.random.default_rng(1).normal(0.0, 2e-6, (1, 200))
    heights[0, 50:60] = heights[0, 199] = np.nan
    figure = map_figure(HeightMap(heights, (1e-6, 1e-3)))
    axes, bars = figure.axes
    assert not axes.images and axes.get_xlabel() == "x [mm]" and axes.get_ylabel() == bars.get_ylabel() == "height [µm]"
    x, z = axes.lines[0].get_data()
    np.testing.assert_allclose(x, np.arange(200) * 0.005)
    np.testing.assert_allclose(z, heights[0] * 1e6)
    gaps = [(patch.get_x(), patch.get_width()) for patch in axes.patches]
    np.testing.assert_allclose(gaps, [(49.5 * 0.005, 10 * 0.005), (198.5 * 0.005, 0.005)])
    assert inside(figure)


@pytest.mark.parametrize("heights, says", [(np.nan, "all points are missing"), (1e-9, None)])
def test_maps_of_nothing(heights, says):
    figure = map_figure(HeightMap(np.full((9, 9), heights), (1e-6, 1e-6)))
    assert texts(figure.axes[0]) == ([says] if says else [])
    assert inside(figure)


def test_a_measured_map_with_missing_points():
    path = SCANS / "frt-2.frt"
    if not path.exists():
        pytest.skip("the scans are not beside the project")
    pytest.importorskip("SurfaceTopography", reason="the optional extra `scans` is not installed")
    surface = level(read_scan(path))
    figure = map_figure(surface)
    picture, _, colours = figure.axes
    assert picture.get_xlabel() == "x [mm]" and colours.get_ylabel() == "height [µm]"
    assert np.ma.count_masked(picture.images[0].get_array()) == surface.missing > 1000
    assert inside(figure)


# ---- spectra


def spectrum(is_profile=False, top=1e-27):
    q = 2.0 * np.pi / np.array([10e-6, 5e-6, 2e-6, 1e-6, 0.5e-6, 0.2e-6])
    return BinnedSpectrum(q, top * (q[0] / q) ** 3.6, np.arange(2, 14, 2), 3e-6, 0.4e-6, is_profile, "hann")


@pytest.mark.parametrize("is_profile, unit", [(False, "µm⁴"), (True, "µm³")])
def test_a_spectrum_is_drawn_with_its_reliable_band(is_profile, unit):
    one = spectrum(is_profile)
    figure = spectrum_figure(one, "a title")
    axes, above = figure.axes
    assert axes.get_xlabel() == r"wavevector $q = 2\pi$ / wavelength [rad/µm]"
    assert axes.get_ylabel() == f"power spectral density $C$ [{unit}]" and axes.get_xscale() == axes.get_yscale() == "log"
    factor = 1e18 if is_profile else 1e24
    np.testing.assert_allclose(axes.lines[0].get_xdata(), one.wavevector / 1e6)
    np.testing.assert_allclose(axes.lines[0].get_ydata(), one.density * factor)
    drawn = lines(axes)
    np.testing.assert_allclose(drawn["average of a bin, reliable"].get_ydata(), one.density[2:5] * factor)
    np.testing.assert_allclose(drawn["average of a bin, not reliable"].get_ydata(), one.density[[0, 1, 5]] * factor)
    (band,) = axes.patches
    np.testing.assert_allclose([band.get_x(), band.get_x() + band.get_width()], [2.0 * np.pi / 3.0, 2.0 * np.pi / 0.4])
    assert band.get_label() == "reliable band: wavelengths of 3 µm to 400 nm" and figure.get_suptitle() == "a title"
    assert inside(figure)
    marks = dict(zip([text.get_text() for text in above.get_xticklabels()], above.get_xticks(), strict=True))
    assert marks == {"10 µm": pytest.approx(0.2 * np.pi), "1 µm": pytest.approx(2.0 * np.pi)}
    assert above.get_xlim() == axes.get_xlim() and above.get_xlabel() == "wavelength"


def test_several_spectra_have_their_names():
    axes = spectrum_figure({"worn": spectrum(), "new": spectrum(top=1e-25)}).axes[0]
    assert {"worn, reliable", "new, reliable"} <= set(legend_of(axes))
    assert lines(axes)["new, reliable"].get_ydata()[0] == pytest.approx(100.0 * lines(axes)["worn, reliable"].get_ydata()[0])


def test_a_spectrum_without_waves_says_so():
    figure = spectrum_figure(spectrum(top=0.0))
    assert texts(figure.axes[0]) == ["no waves: all heights are alike"] and inside(figure)


# ---- asperities


def samples(method, mean, count=2000):
    heights = np.random.default_rng(count).normal(mean, 4e-9, count)
    return Asperities(method, 12.3e12, 4e-9, 1.5e-6, mean, 0.0, "", heights, np.full(count, 1.5e-6))


def test_asperities_are_densities_with_sigma_radius_and_number_in_the_legend():
    found = [samples("persistence", 5e-9), Asperities("mccool", 0.5e12, 3e-9, 200e-9, 2e-9, 0.0, "")]
    figure = asperity_figure(found, title="a title")
    (axes,) = figure.axes
    assert axes.get_xlabel() == "height over the mean plane [nm]" and axes.get_ylabel() == "share of the asperities [1/nm]"
    assert legend(figure) == [
        "persistent summits: 2000\n$\\sigma$ = 4 nm, $R$ = 1.5 µm,\n$N$ = 12.3/µm²",
        "moments (McCool), averages only\n$\\sigma$ = 3 nm, $R$ = 200 nm,\n$N$ = 0.5/µm²",
    ]
    shares, edges, _ = axes.patches[0].get_data()
    np.testing.assert_allclose(shares * np.diff(edges) * 2000, np.histogram(found[0].heights * 1e9, edges)[0], atol=1e-6)
    assert np.sum(shares * np.diff(edges)) == pytest.approx(1.0, abs=0.01)
    z, curve = axes.lines[0].get_data()
    assert axes.lines[0].get_linestyle() == "--" and z[np.argmax(curve)] == pytest.approx(2.0, abs=0.1)
    assert np.sum(curve[1:] * np.diff(z)) == pytest.approx(1.0, abs=1e-3)
    assert np.sqrt(np.sum(curve[1:] * (z[1:] - 2.0) ** 2 * np.diff(z))) == pytest.approx(3.0, rel=5e-3)
    assert figure.get_suptitle() == "a title" and inside(figure)


def test_the_heights_of_all_points_are_beneath():
    surface = bumps()
    figure = asperity_figure([asperities(surface, "eight_neighbour")], surface)
    shares, edges, _ = figure.axes[0].patches[0].get_data()
    heights = (surface.heights - surface.heights.mean()) * 1e9
    np.testing.assert_allclose(shares * np.diff(edges) * heights.size, np.histogram(heights, edges)[0], atol=1e-6)
    assert legend(figure)[0] == "all 2400 points" and figure.get_suptitle() == "bumps"


def test_asperities_are_marked_on_the_map_where_they_are():
    surface = bumps()
    found = asperities(surface, "eight_neighbour")
    (marks,) = map_figure(surface, asperities=found).axes[0].collections
    across = {"µm": 1e6, "nm": 1e9}[map_figure(surface).axes[0].get_xlabel().removeprefix("x [").removesuffix("]")]
    points = np.asarray(marks.get_offsets()) / across / surface.pitch[::-1] - 0.5
    np.testing.assert_allclose(points[:, ::-1], found.places, atol=1e-9)
    averages = map_figure(surface, asperities=asperities(surface, "mccool")).axes[0]
    assert averages.get_title() == "moments (McCool): averages only, no positions" and not averages.collections


def test_one_method_is_one_colour_in_every_picture():
    alone = asperity_figure([samples("n_point", 0.0)])
    among = asperity_figure([samples("three_point", 0.0), samples("n_point", 0.0)])
    shown = resolution_figure(fan_of(methods=("three_point", "n_point")))
    colours = {
        to_hex(alone.axes[0].patches[0].get_edgecolor()),
        to_hex(among.axes[0].patches[1].get_edgecolor()),
        to_hex(lines(shown.axes[0])["n-point asperities"].get_color()),
    }
    assert len(colours) == 1


def test_asperities_of_nothing():
    assert texts(asperity_figure([]).axes[0]) == ["no asperities"]
    equal = Asperities("three_point", 1e8, 0.0, 1e-6, 2e-9, 0.0, "", np.full(4, 2e-9), np.full(4, 1e-6))
    figure = asperity_figure([equal])
    assert figure.axes[0].lines[0].get_xdata() == pytest.approx([2.0, 2.0]) and inside(figure)
    assert "$N$ = 100/mm²" in legend(figure)[0]


# ---- the fan


def fan_of(methods=("three_point", "mccool"), friction=True):
    shape = (len(methods), 3)
    table = np.exp(np.random.default_rng(2).normal(0.0, 1.0, shape))
    names = {"sigma": 20e-9, "R": 3e-6, "N": 5e12} | ({"mu": 0.1} if friction else {})
    data = {name: (("asperity_method", "cutoff"), size * table) for name, size in names.items()}
    data["failure"] = (("asperity_method", "cutoff"), np.full(shape, "", dtype=object))
    coords = {"asperity_method": list(methods), "cutoff": [0.0, 100e-9, 400e-9]}
    return xarray.Dataset(data, coords, {"title": "The resolution fan", "surface": "a scan"})


def test_the_fan_has_a_line_for_each_method_in_every_panel():
    resolution_study = fan_of()
    figure = resolution_figure(resolution_study)
    labels = [
        "deviation of asperity heights $\\sigma$ [nm]", "asperity radius $R$ [µm]", "asperities per area $N$ [1/µm²]",
        "static friction coefficient $\\mu$",
    ]  # fmt: skip
    assert [axes.get_ylabel() for axes in figure.axes] == labels
    for axes, (name, factor) in zip(figure.axes, {"sigma": 1e9, "R": 1e6, "N": 1e-12, "mu": 1.0}.items(), strict=True):
        assert axes.get_xscale() == axes.get_yscale() == "log" and axes.get_xlabel().endswith("wavelength kept [nm]")
        assert len(axes.lines) == 2
        for method, label in (("three_point", "three-point peaks"), ("mccool", "moments (McCool)")):
            x, y = lines(axes)[label].get_data()
            np.testing.assert_allclose(x, [50.0, 100.0, 400.0])
            np.testing.assert_allclose(y, resolution_study[name].sel({"asperity_method": method}) * factor, rtol=1e-12)
        assert [text.get_text() for text in axes.get_xticklabels()] == ["none", "100", "400"]
    assert legend(figure) == ["three-point peaks", "moments (McCool)"]
    assert figure.legends[0].get_title().get_text() == "The resolution fan: a scan"
    assert figure.get_supxlabel() == "" and inside(figure)


def test_without_friction_the_fan_has_three_panels_and_the_cutoffs_may_fall():
    resolution_study = fan_of(friction=False)
    figure = resolution_figure(resolution_study.isel({"cutoff": [2, 1, 0]}), "a title")
    assert len(figure.axes) == 3 and figure.legends[0].get_title().get_text() == "a title"
    np.testing.assert_allclose(lines(figure.axes[0])["moments (McCool)"].get_xdata(), [50.0, 100.0, 400.0])
    np.testing.assert_allclose(lines(figure.axes[0])["moments (McCool)"].get_ydata(), resolution_study["sigma"][1] * 1e9)


def test_where_a_method_failed_its_line_has_a_gap_and_a_note():
    resolution_study = fan_of(("three_point", "persistence", "mccool"))
    for name in ("sigma", "R", "N", "mu"):
        resolution_study[name][1, 2] = np.nan
    resolution_study["failure"][1, 2] = "only 1 found"
    resolution_study["mu"][0, 1] = 0.0
    resolution_study["mu"][2] = np.nan
    figure = resolution_figure(resolution_study)
    for axes in figure.axes:
        drawn = ~np.isnan(lines(axes)["persistent summits"].get_ydata())
        assert drawn.tolist() == [True, True, False]
    friction = lines(figure.axes[3])
    assert np.isnan(friction["three-point peaks"].get_ydata()).tolist() == [False, True, False]
    assert figure.get_supxlabel().split("\n") == [
        "Not drawn: three-point peaks at 100 nm; moments (McCool) at every cutoff (mu: 0 or none)",
        "Not drawn: persistent summits at 400 nm (only 1 found)",
    ]
    assert inside(figure)


def test_the_marks_of_friction_say_which_heights_it_rests_on():
    resolution_study = fan_of()
    names = np.array([["empirical", "weibull", "gaussian"], ["gaussian"] * 3])
    resolution_study["height_distribution"] = (("asperity_method", "cutoff"), names)
    for one in (resolution_study, resolution_study.isel({"cutoff": [1, 2, 0]})):
        axes = resolution_figure(one).axes[3]
        hollow = [line for line in axes.lines if line.get_label() == "_empirical"]
        np.testing.assert_allclose(hollow[0].get_xdata(), [50.0, np.nan, np.nan])
        np.testing.assert_allclose(hollow[0].get_ydata(), resolution_study["mu"][0])
        assert hollow[0].get_markerfacecolor() == "white" and np.isnan(hollow[1].get_xdata()).all()
        half = next(line for line in axes.lines if line.get_label() == "_weibull")
        assert half.get_fillstyle() == "left" and np.isnan(half.get_xdata()).tolist() == [True, False, True]
        assert legend_of(axes) == ["Gaussian heights", "Weibull heights", "heights as found"]


def test_a_fan_of_failures_says_so():
    resolution_study = fan_of(friction=False)
    for name in ("sigma", "R", "N"):
        resolution_study[name][:] = np.nan
    assert texts(resolution_figure(resolution_study).axes[2]) == ["no method gives a value"]


# ---- friction over methods


@pytest.fixture(scope="module")
def with_range_over_methods():
    """A contact read in three ways. The last surface is so smooth that all asperities flow: its friction is 0 at high loads."""
    return banded_at(np.geomspace(1e-3, 10.0, 5))


def banded_at(load):
    def contact(sigma, radius, density):
        return Contact(
            first="hardened_steel_52100", second="hardened_steel_52100", work_of_adhesion=0.1, nominal_area=1e-6,
            roughness=Roughness(asperity_height_deviation=sigma, asperity_radius=radius, asperity_density=density),
        )  # fmt: skip

    contacts = {
        "persistence": contact(31e-9, 335e-9, 3.9e11),
        "mccool": contact(35e-9, 193e-9, 1.97e13),
        "n_point": contact(21e-9, 1.08e-6, 4e11),
    }
    counts = dict.fromkeys(contacts, 1000)
    return with_method_spread(solve(contacts["persistence"], load=load), contacts, counts, Choice())


def test_the_band_lies_between_the_lowest_and_the_highest_of_the_methods(with_range_over_methods):
    figure = method_spread_figure(with_range_over_methods, "a title")
    (axes,) = figure.axes
    load, taken = axes.lines[0].get_data()
    assert axes.lines[0].get_label() == "used: persistent summits"
    np.testing.assert_array_equal(load, with_range_over_methods["load"])
    np.testing.assert_array_equal(taken, with_range_over_methods["friction_coefficient"])
    table = with_range_over_methods["friction_coefficient_by_method"].values
    drawn = {line.get_label().partition("\n")[0]: line for line in axes.lines}
    assert {label for label in drawn if not label.startswith("slope")} == {
        "used: persistent summits",
        "moments (McCool)",
        "n-point asperities",
    }
    np.testing.assert_array_equal(drawn["moments (McCool)"].get_ydata(), table[1])
    np.testing.assert_array_equal(drawn["n-point asperities"].get_ydata(), table[2])
    assert axes.lines[0].get_linewidth() > 2.0 * drawn["n-point asperities"].get_linewidth()
    edge = axes.collections[0].get_paths()[0].vertices
    floor = axes.get_ylim()[0]
    for at, one in enumerate(load):
        column = edge[edge[:, 0] == one, 1]
        assert column.min() == pytest.approx(max(np.nanmin(table[:, at]), floor))
        assert column.max() == pytest.approx(np.nanmax(table[:, at]))
    assert axes.get_xlabel() == "normal load $P$ [N]" and axes.get_ylabel().startswith("static friction coefficient $\\mu$")
    assert "a title" in figure.get_suptitle() and "grade" in figure.get_suptitle()
    assert legend(figure)[0] == "range over methods of\nfinding asperities" and inside(figure)


def test_gaps_and_zeros_are_named(with_range_over_methods):
    table = with_range_over_methods["friction_coefficient_by_method"].values.copy()
    table[0], table[1], table[2] = [0.5, 0.4, 0.3, 0.2, 0.1], [0.3, 0.2, 0.01, 1e-3, 0.0], [0.3, 0.2, np.nan, np.nan, np.nan]
    changed = with_range_over_methods.assign(
        friction_coefficient_by_method=(with_range_over_methods["friction_coefficient_by_method"].dims, table)
    )
    changed["friction_coefficient_low"] = (changed["load"].dims, np.fmin.reduce(table))
    changed["friction_coefficient_high"] = (changed["load"].dims, np.fmax.reduce(table))
    said = legend(method_spread_figure(changed))
    assert "moments (McCool)\n(not drawn where mu = 0)" in said
    assert "n-point asperities\n(does not carry every load)" in said


def test_one_load_is_a_bar():
    figure = method_spread_figure(banded_at(1e-2))
    (axes,) = figure.axes
    assert axes.lines[0].get_marker() == "o" and axes.get_xlim() == pytest.approx((1e-2 / 3.0, 3e-2))
    (bar,) = axes.collections[0].get_segments()
    table = banded_at(1e-2)["friction_coefficient_by_method"].values
    np.testing.assert_allclose(bar[:, 1], [table.min(), table.max()])


def test_a_result_without_band_is_refused(with_range_over_methods):
    with refusal("friction_coefficient_by_method"):
        method_spread_figure(with_range_over_methods.drop_vars("friction_coefficient_by_method"))
