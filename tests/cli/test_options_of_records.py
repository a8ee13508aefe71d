"""Options of models and laws on the command line: as their records name them."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from stiction.cli import app
from stiction.records.registry import all_options

CASE = str(Path(__file__).parents[2] / "examples" / "silver_on_steel.toml")


def run(*words):
    return CliRunner().invoke(app, ["run", *words, "--json"])


@pytest.mark.parametrize("words", [("--variant", "published"), ("--variant=published",)])
def test_an_option_may_stand_before_the_case_and_after_it(words):
    for order in ((*words, CASE), (CASE, *words)):
        found = run(*order)
        assert found.exit_code == 0, found.output
        assert json.loads(found.stdout)["attrs"]["variant"] == "published"


def test_every_option_of_a_record_is_known():
    options = all_options()
    assert {"variant", "branch", "transition", "modulus", "hardness"} <= options.keys()
    for name in options:
        refused = run(CASE, f"--{name.replace('_', '-')}", "nonsense")
        assert refused.exit_code == 2 and "nonsense" in refused.output and "\n" not in refused.output.strip()


def test_what_no_record_has_is_refused():
    for words, field in ((("--readin", "published"), "--readin"), (("--variant",), "--variant")):
        refused = run(CASE, *words)
        assert refused.exit_code == 2 and field in refused.output


def test_presliding():
    bare = str(Path(CASE).with_name("compare_models.toml"))
    found = json.loads(run(bare, "--model", "greenwood_williamson_1966", "--presliding", "mindlin_1949").stdout)
    assert found["variables"]["tangential_stiffness"]["unit"] == "N/m"
