"""Nothing impossible in predictions of random contacts (validation/random_predictions.py has 10^4 of them)."""

import importlib.util
from pathlib import Path

import numpy as np
from xarray import DataArray

import stiction as st
from stiction.case.read import case_in
from stiction.studies.prediction.many import predict_many


def script():
    path = Path(__file__).parents[2] / "validation" / "random_predictions.py"
    spec = importlib.util.spec_from_file_location("random_predictions", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_random_contacts_are_predicted_without_a_fault_or_refused_in_a_line():
    found, refused = script().run(40, seed=2)
    assert found == []
    assert refused[""] >= 15 and sum(refused.values()) == 40


def scattered(fields, load, rng, count):
    """Numbers of many contacts that differ from this one by factors, and their loads over eight decades."""

    def along(values):
        return DataArray(values, dims=("contact",))

    rough = fields["roughness"]
    radius = rough["asperity_radius"] * rng.lognormal(0.0, 1.0, count)
    ratio = rough["asperity_height_deviation"] / rough["asperity_radius"] * rng.lognormal(0.0, 1.5, count)
    sigma = np.minimum(ratio, 1.0) * radius
    numbers = {
        ("contact", "nominal_area"): fields["nominal_area"] * rng.lognormal(0.0, 1.5, count),
        ("contact", "roughness", "asperity_radius"): radius,
        ("contact", "roughness", "asperity_height_deviation"): sigma,
        ("contact", "roughness", "asperity_density"): rng.uniform(0.01, 0.2, count) / radius / sigma,
    }
    if "coating" in fields:
        numbers["contact", "coating", "thickness"] = fields["coating"]["thickness"] * rng.lognormal(0.0, 1.5, count)
    return {path: along(values) for path, values in numbers.items()}, along(load * 10.0 ** rng.uniform(-4.0, 4.0, count))


def test_many_random_contacts_at_once_have_no_fault():
    """Each has an interval above 0 with the median in it and at most the nominal area; or it is refused, and said to be."""
    predicted = 0
    for at in (3, 7, 21, 45):
        rng = np.random.default_rng([7, at])
        fields, load = script().contact_of(rng)
        while "asperity_radius" not in fields["roughness"] or "interface" in fields:
            fields, load = script().contact_of(rng)
        case = case_in({"contact": st.Contact(**fields), "solve": {"load": ["1 N"]}})
        numbers, loads = scattered(fields, load, rng, 24)
        for region, _, found in predict_many(case, numbers, loads, count=128):
            if found is None:
                continue
            answered = found.validity_warnings[1].ravel() == 0
            values = {name: np.ravel(each[1]) for name, each in found.variables.items()}
            for name in ("friction_coefficient", "friction_force", "contact_area"):
                low, middle, high = (values[name + end] for end in ("_low", "", "_high"))
                right = (low > 0.0) & (low <= middle) & (middle <= high) & np.isfinite(high)
                assert np.array_equal(right, answered), (at, name)
            most = numbers["contact", "nominal_area"].values[region["contact"]] * (1.0 + 1e-9)
            assert (values["contact_area_high"] <= most)[answered].all()
            predicted += answered.sum()
    assert predicted > 40
