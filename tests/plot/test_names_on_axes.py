"""Names and units of results fit on the axes of xarray's own plots."""

import matplotlib
import numpy as np
import pytest

import stiction as st
from stiction.quantities.table import QUANTITIES

CLIPPED_BY_TICKS = 22.0  # points: long numbers of the ticks move a label of one line out by so much, whatever it says


def contact() -> st.Contact:
    rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1.7e10 1/m^2")
    film = st.Coating(material="silver", thickness="200 nm", bodies="first")
    return st.Contact(
        first="iron", second="iron", roughness=rough, coating=film, work_of_adhesion="0.1 J/m^2", nominal_area="1 mm^2"
    )


def test_every_name_takes_one_line():
    """xarray breaks labels at 30 characters; normalised results have no other unit than 1."""
    for row in QUANTITIES.values():
        shown = f"{row.attributes['long_name']} [{row.attributes['units']}]"
        assert len(shown) <= 30, shown
        assert row.meaning in (row.attributes["long_name"], row.attributes.get("comment"))


@pytest.mark.parametrize("case", ["separations", "indices", "unloaded", "study"])
def test_the_plots_of_xarray_are_not_clipped(case):
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    if case == "separations":
        data = st.solve(contact(), separation=np.linspace(150e-9, 0.0, 12))
    elif case == "indices":
        data = st.solve(st.Indices(theta=st.axis("theta", [10, 20, 40]), lam=10), load=1e-3)
    elif case == "unloaded":
        bare = contact().replace(coating=None)
        data = st.unload(
            bare, min_separation="20 nm", separation_increase=np.linspace(0, 50e-9, 6), model="greenwood_williamson_1966"
        )
    else:
        spectrum = st.SelfAffine(hurst=0.8, rolloff=5e-6, shortest=0.7e-6, deviation=30e-9)
        data = st.resolution_study(st.gaussian_surface((64, 64), (20e-6, 20e-6), spectrum, 1), cutoffs=[0.0, 2e-6])
        data = data.isel(asperity_method=0, drop=True)
    for name, one in data.data_vars.items():
        if one.ndim != 1 or one.dtype.kind != "f":
            continue
        figure, axes = plt.subplots()
        with np.errstate(all="ignore"):
            one.plot(ax=axes)
            figure.canvas.draw()
        for axis in (axes.xaxis, axes.yaxis):
            assert "\n" not in axis.label.get_text(), (name, axis.label.get_text())
            box = axis.label.get_window_extent()
            assert box.x0 >= -CLIPPED_BY_TICKS * figure.dpi / 72.0 and box.y0 >= 0.0, name
            assert box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1, name
        plt.close(figure)
