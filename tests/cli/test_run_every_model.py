"""`stiction run` with every rough-surface model: table, picture and JSON, also of those that know no separation."""

import csv
import json
import warnings

import numpy as np
import pytest
from typer.testing import CliRunner

import stiction as st
from cases import STEEL_ON_STEEL
from stiction import cli
from stiction.records.registry import RoughSurface, of_kind

CASE = STEEL_ON_STEEL + "[solve]\nload = {}\n"
MODELS = {key: one for key, one in of_kind(RoughSurface).items() if one.of_map is None}
NO_SEPARATION = [key for key, one in MODELS.items() if not one.asperity and one.curve is None]
# One model of each kind of result: by asperities or not, with a separation or not, with friction of its own or not, on a film.
KINDS = {(bool(one.asperity), key in NO_SEPARATION, one.tangential, one.on_film): key for key, one in MODELS.items()}
DRAWN = set(KINDS.values())


@pytest.fixture(autouse=True)
def matplotlib_does_its_own_arithmetic(no_silent_nan):
    """It divides zero by zero inside, and looks at the result afterwards."""
    with np.errstate(all="ignore"):
        yield


def run(*words):
    """Run the command; a warning is an error, but not what libraries tell each other of names that will go."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", category=DeprecationWarning)
        warnings.filterwarnings("error", category=DeprecationWarning, module="stiction")
        result = CliRunner().invoke(cli.app, ["run", *map(str, words)])
    assert (result.exit_code, result.stderr) == (0, ""), (result.output, result.exception)
    return result.stdout


FILM = '[contact.coating]\nmaterial = "silver"\nthickness = "200 nm"\n'


def case_of(model, loads, folder):
    """A case file that suits the model: with a film if it is of surfaces with one, and sticking if it is in full contact."""
    path = folder / "case.toml"
    suits = CASE.replace("[solve]", FILM + "[solve]") if MODELS[model].on_film else CASE
    suits = suits.replace("0.1 J", "100 J") if model == "persson_tosatti_2001" else suits
    path.write_text(suits.format(loads))
    return path


@pytest.mark.parametrize("tangential", (None, "bowden_tabor_1943"))
@pytest.mark.parametrize("model", MODELS)
def test_table_picture_and_json(model, tangential, tmp_path):
    case = case_of(model, '["0.1 N", "1 N", "10 N"]', tmp_path)
    words = [case, "--model", model, *(["--tangential", tangential] if tangential else [])]
    drawn = model in DRAWN and not (tangential and MODELS[model].tangential != "none")  # friction is drawn once of each kind
    out = ["--out", tmp_path / "out"] if drawn else []
    text = run(*words, "--details", *out)
    assert "contact area" in text and ("pull-off force" in text) == (model not in NO_SEPARATION)
    if out:
        names = {path.name for path in (tmp_path / "out").iterdir()}
        assert names == {"curve.csv", "curve.nc", "curve.png", "regimes.png"}
    found = json.loads(run(*words, "--json"))["variables"]
    np.testing.assert_allclose(found["load"]["values"], [0.1, 1.0, 10.0], rtol=1e-15)
    assert ("mean_separation" in found) == (model not in NO_SEPARATION)
    if tangential:
        film_yields = st.material("silver").hardness / (2.8 * 3.0**0.5)
        strength = min(200e6, film_yields) if MODELS[model].on_film else 200e6
        mu = strength * np.array(found["contact_area"]["values"]) / found["load"]["values"]
        np.testing.assert_allclose(found["friction_coefficient"]["values"], mu, rtol=1e-12)


@pytest.mark.parametrize("model", MODELS)
def test_a_single_load(model, tmp_path):
    run(case_of(model, '"0.1 N"', tmp_path), "--model", model, *(["--out", tmp_path / "out"] if model in DRAWN else []))


def test_there_are_models_without_separation():
    assert {"persson_2001", "persson_2001_elastoplastic"} <= set(NO_SEPARATION)


def test_a_load_of_nothing_has_no_friction_coefficient(tmp_path):
    """The contact holds itself: 0 N is carried, to rounding, and the rounding is not a load."""
    case = tmp_path / "case.toml"
    smooth = CASE.replace("48 nm", "5.8 nm").replace("50 um", "72 um").replace("1.7e10", "5.7e10").replace("0.1 J", "1 J")
    case.write_text(smooth.format('["-1 mN", "0 N", "1 N"]'))
    text = run(case, "--model", "soft_coating_2015", "--details", "--out", tmp_path / "out")
    assert "mu is not defined" in text and "e+16" not in text
    with (tmp_path / "out" / "curve.csv").open(encoding="utf-8", newline="") as file:
        mu = [float(row["friction_coefficient"]) for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    assert np.isnan(mu[:2]).all() and 0.0 < mu[2] < 100.0
