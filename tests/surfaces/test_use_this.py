"""`stiction surface`: fifteen lines that end with what to paste into a case, and the kind that is found from the map."""

import tomllib

import numpy as np
import pytest
from typer.testing import CliRunner

from stiction import cli
from stiction.case.read import parse_case
from stiction.solving.accuracy.solved_near import kind_of_map
from stiction.surfaces.generate import gaussian_surface
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine

SIDE = 20e-6
SPECTRUM = SelfAffine(hurst=0.8, rolloff=SIDE / 8, shortest=SIDE / 24, deviation=1e-8)
SHAPES = {
    "gaussian": lambda z: z,
    "skewed": lambda z: np.exp(0.5 * z),
    "worn": lambda z: np.minimum(z, 0.5),
    "lay": lambda z: z,
}


def made(kind, seed=9100, points=192):
    """Not one of the set: other seeds, size and spectrum."""
    z = gaussian_surface((points, points), (SIDE, SIDE), SPECTRUM, seed=seed, stretch=4.0 if kind == "lay" else 1.0).heights
    return HeightMap(SHAPES[kind](z / z.std()) * 1e-8, (SIDE, SIDE), periodic=True)


@pytest.mark.parametrize("kind", SHAPES)
def test_the_kind_is_found_from_the_map(kind):
    maps = [made(kind, seed) for seed in range(9100, 9105)]
    windows = [HeightMap(one.heights[:128, :128], (SIDE * 2 / 3, SIDE * 2 / 3)) for one in maps]
    assert [kind_of_map(one) for one in maps].count(kind) >= 4
    assert [kind_of_map(one) for one in windows].count(kind) >= 4


def test_of_a_profile_and_of_holes_no_kind_is_found():
    heights = made("gaussian").heights.copy()
    assert kind_of_map(HeightMap(heights[:1], (SIDE / 192, SIDE))) is None
    heights[3, 4] = np.nan
    assert kind_of_map(HeightMap(heights, (SIDE, SIDE))) is None


CASE = """
[contact]
first = "iron"
second = "copper"
nominal_area = "1 mm^2"
interface = "oxidised metal"

ROUGHNESS

[solve]
load = "1 N"
model = "greenwood_williamson_1966"
"""


def shown(folder, kind="worn", *words, name="a scan.npy"):
    np.save(folder / name, made(kind).heights)
    runner = CliRunner(env={"COLUMNS": "80"})
    result = runner.invoke(cli.app, ["surface", str(folder / name), "--size", "20 um", "--unit", "m", *words])
    assert result.exit_code == 0, result.output
    return result.stdout


def tables(text):
    """The two tables to paste, as they stand in the text."""
    parts = [part.partition("\n")[2] for part in text.split("[contact.roughness]  # ")[1:]]
    keep = [[line for line in part.splitlines() if " = " in line] for part in parts]
    return ["[contact.roughness]\n" + "\n".join(lines) for lines in keep]


@pytest.mark.parametrize("words", [(), ("--form", "2", "--shortest", "1 um")])
@pytest.mark.parametrize("kind", SHAPES)
def test_fifteen_lines_that_end_with_what_to_paste(tmp_path, monkeypatch, kind, words):
    monkeypatch.chdir(tmp_path)
    np.save("scan.npy", made(kind).heights)
    runner = CliRunner(env={"COLUMNS": "80"})
    result = runner.invoke(cli.app, ["surface", "scan.npy", "--size", "20 um", "--unit", "m", *words])
    lines = result.stdout.rstrip().splitlines()
    assert result.exit_code == 0 and len(lines) <= 15 + len(words) // 2, result.output
    assert max(map(len, lines)) <= 80 and "…" not in result.stdout
    assert any(line.rstrip().endswith(f"; kind: {kind}") for line in lines)
    of_scan, of_numbers = (
        parse_case(tomllib.loads(CASE.replace("ROUGHNESS", one)), tmp_path).subject.roughness for one in tables(result.stdout)
    )
    assert of_scan.measured is not None and of_numbers.surface_kind == kind
    for name in ("asperity_height_deviation", "asperity_radius", "asperity_density"):
        assert getattr(of_numbers, name) == pytest.approx(getattr(of_scan, name), rel=6e-3)


def test_details_have_the_rest(tmp_path):
    text = shown(tmp_path, "gaussian", "--details")
    assert "Nayak's" in text and "mccool" in text and text.count("[contact.roughness]") == 2
    assert len(text.splitlines()) > 20


def test_spikes_are_said_and_what_masks_them(tmp_path):
    surface = made("gaussian")
    surface.heights[50, 50] = 1e-6
    np.save(tmp_path / "scan.npy", surface.heights)
    result = CliRunner(env={"COLUMNS": "80"}).invoke(
        cli.app, ["surface", str(tmp_path / "scan.npy"), "--size", "20 um", "--unit", "m"]
    )
    assert "points stand out: mask them with --spikes 10" in result.stdout


def test_json_has_kind_and_method(tmp_path):
    import json

    found = json.loads(shown(tmp_path, "lay", "--json"))
    assert found["kind"] == "lay" and found["standing"] in found["asperities"]
