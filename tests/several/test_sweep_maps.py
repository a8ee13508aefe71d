"""Ensembles: a sweep over maps of files, patches and realisations of a spectrum."""

import filecmp
import json

import numpy as np
import pytest
from typer.testing import CliRunner

from refusals import refusal
from stiction import cli
from stiction.case.read import read_case
from stiction.solving.solve import solve
from stiction.studies.sweep.run import sweep
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine

pytest.importorskip("zarr")

SIZE = 20e-6
CONTACT = {
    "first": "hardened_steel_52100",
    "second": "silicon_nitride",
    "interfacial_shear_strength": "300 MPa",
    "nominal_area": "1 mm^2",
}
SPECTRUM = {"hurst": 0.8, "rolloff": "5 um", "shortest": "2.5 um", "deviation": "30 nm", "size": "20 um", "points": 64}
HOW = {"size": "20 um", "unit": "m"}


def case(entries, loads=("10 N", "100 N"), model="boundary_elements", **sweep_table):
    table = {"roughness": entries, **sweep_table}
    return {"contact": CONTACT, "solve": {"load": list(loads), "model": model}, "sweep": table}


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for seed in (1, 2):
        made = gaussian_surface((128, 96), (SIZE, 0.75 * SIZE), SelfAffine(0.8, SIZE / 4, SIZE / 12, 30e-9), seed=seed)
        np.save(f"map{seed}.npy", made.heights)
    return tmp_path


def alone(surface, loads, tmp_path):
    """The friction of one map that the case does not sweep."""
    contact = read_case_contact(tmp_path).replace(roughness=surface)
    return solve(contact, load=list(loads), model="boundary_elements")["friction_coefficient"].values


def read_case_contact(tmp_path):
    lines = "\n".join(f'{key} = "{value}"' for key, value in CONTACT.items())
    numbers = 'asperity_height_deviation = "48 nm"\nasperity_radius = "50 um"\nasperity_density = "1.7e10 1/m^2"'
    path = tmp_path / "plain.toml"
    path.write_text(f'[contact]\n{lines}\n[contact.roughness]\n{numbers}\n[solve]\nload = "1 N"\n', encoding="utf-8")
    return read_case(path).subject


def test_files_patches_and_realisations_are_solved_each_as_alone(files):
    entries = ["map1.npy", {"file": "map2.npy", "patches": 2}, {**SPECTRUM, "realisations": 2, "seed": 5}]
    tables = case(entries[:2])
    tables["contact"] = {**CONTACT, "roughness": {"size": "15 um", "unit": "m"}}
    found = sweep(tables, files / "store")
    assert found["friction_coefficient"].dims == ("place", "load")
    assert found["place"].values.tolist() == [
        "map1.npy", *(f"map2.npy, row {row}, column {column}" for row in (1, 2) for column in (1, 2))
    ]  # fmt: skip
    loads = (10.0, 100.0)
    heights = np.load("map2.npy")
    expected = [
        alone(HeightMap(part, size, ("made",)), loads, files)
        for part, size in (
            (np.load("map1.npy"), (SIZE, 0.75 * SIZE)),
            (heights[:64, :48], (SIZE / 2, 0.375 * SIZE)),
            (heights[:64, 48:], (SIZE / 2, 0.375 * SIZE)),
            (heights[64:, :48], (SIZE / 2, 0.375 * SIZE)),
            (heights[64:, 48:], (SIZE / 2, 0.375 * SIZE)),
        )
    ]
    assert found["friction_coefficient"].values == pytest.approx(np.array(expected), rel=1e-3)
    made = sweep(case(entries[2:]), files / "made")
    waves = SelfAffine(0.8, SIZE / 4, SIZE / 8, 30e-9)
    maps = [gaussian_surface((64, 64), (SIZE, SIZE), waves, seed=seed) for seed in (5, 6)]
    assert made["friction_coefficient"].values == pytest.approx(np.array([alone(one, loads, files) for one in maps]), rel=1e-3)
    assert made["place"].values.tolist() == ["seed 5", "seed 6"]


def test_realisations_have_the_skewness_asked_for(files):
    tables = case([{**SPECTRUM, "realisations": 2, "skewness": -1.0, "kurtosis": 5.0}], model="greenwood_williamson_1966")
    found = sweep(tables, files / "store")
    assert np.isfinite(found["friction_coefficient"].values).all()
    assert found.attrs["model"] == "greenwood_williamson_1966"


def test_an_interrupted_ensemble_goes_on_to_the_same_store(files, monkeypatch):
    tables = case([{**SPECTRUM, "realisations": 4}])
    monkeypatch.setenv("STICTION_CACHE_DIR", str(files / "one"))
    sweep(tables, files / "whole")

    def stopped(done, size, steps):
        for number, step in enumerate(steps):
            if number == 2:
                raise KeyboardInterrupt
            yield step

    monkeypatch.setenv("STICTION_CACHE_DIR", str(files / "other"))
    with pytest.raises(KeyboardInterrupt):
        sweep(tables, files / "parts", progress=stopped)
    sweep(tables, files / "parts")
    whole = sorted(path.relative_to(files / "whole") for path in (files / "whole").rglob("c/*") if path.is_file())
    assert whole and filecmp.cmpfiles(files / "whole", files / "parts", whole, shallow=False)[0] == whole
    changed = case([{**SPECTRUM, "realisations": 5}])
    with refusal("--out"):
        sweep(changed, files / "parts")


def test_another_content_of_a_file_is_another_ensemble(files):
    tables = case([{"file": "map1.npy", **HOW}], loads=("100 N",), model="greenwood_williamson_1966")
    sweep(tables, files / "store")
    np.save("map1.npy", 1.1 * np.load("map1.npy"))
    with refusal("--out", "maps"):
        sweep(tables, files / "store")


def test_mu_has_its_scatter_from_place_to_place(files):
    text = json.dumps(SPECTRUM | {"realisations": 3}).replace('":', '" =')
    (files / "case.toml").write_text(
        "[contact]\n" + "\n".join(f'{key} = "{value}"' for key, value in CONTACT.items())
        + f'\n[solve]\nload = "100 N"\nmodel = "boundary_elements"\n[sweep]\nroughness = [{text}]\n',
        encoding="utf-8",
    )  # fmt: skip
    done = CliRunner().invoke(cli.app, ["sweep", "case.toml", "--out", "store"])
    assert done.exit_code == 0, done.output
    from stiction.studies.sweep.store import open_store

    mu = open_store(files / "store")["friction_coefficient"].values[:, 0]
    assert f"standard deviation {100 * mu.std(ddof=1) / mu.mean():.2g} %, 3 maps" in " ".join(done.output.split())


def test_statistics_over_maps(files):
    tables = case([{**SPECTRUM, "realisations": 3}], loads=("100 N",))
    each = sweep(tables, files / "each")["friction_coefficient"].values[:, 0]
    table = tables["sweep"] | {"statistics": ["mean", "standard_deviation"], "keep": ["friction_coefficient"]}
    found = sweep({**tables, "sweep": table}, files / "store")
    assert found["friction_coefficient"].values[:, 0] == pytest.approx([each.mean(), each.std(ddof=1)], rel=1e-9)


def test_one_line_about_what_is_wrong(files):
    for match, tables in (
        (("sweep.roughness.file",), case(["nowhere.npy"])),
        (("sweep.roughness", "size"), case([{"size": "20 um"}])),
        (("sweep.roughness.patches",), case([{"file": "map1.npy", "patches": 0, **HOW}])),
        (("contact.roughness.rms", "3"), {**case(["map1.npy"]), "contact": {**CONTACT, "roughness": {"rms": 3}}}),
        (("contact.roughness",), {**case(["map1.npy"]), "contact": {**CONTACT, "roughness": {"first": {"file": "a"}}}}),
        (
            ("contact.work_of_adhesion",),
            {**case([SPECTRUM]), "contact": {**CONTACT, "work_of_adhesion": ["0.1 J/m^2", "1 J/m^2"]}},
        ),
        (("sweep.block",), case([SPECTRUM], block=4)),
        (("sweep.roughness.skewness",), case([{**SPECTRUM, "skewness": 1.0}])),
    ):
        with refusal(*match):
            sweep(tables, files / "store")
