"""A fixed share of the generated cases and other inputs of `make fuzz`: each ends in an answer or in one line."""

import contextlib
import json
import multiprocessing
import random
import sys
from collections import Counter
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "fuzz"))

import case_files
import generate
import inputs
import run

import stiction as st
from stiction.case.read import case_in

SEEDS = range(12)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_generated_case_is_answered_or_refused_in_one_line(seed):
    outcomes = Counter()
    assert not list(run.failures_of(seed, 600, outcomes))
    assert sum(outcomes.values()) > 0


@pytest.mark.parametrize("target", inputs.TARGETS, ids=lambda target: target.__name__)
def test_other_inputs_are_read_or_refused_in_one_line(target):
    assert not [failure for seed in range(20) for failure in run.failures_of_inputs(seed, target.__name__, 60)]


def test_a_worker_that_dies_is_a_failure_and_the_next_goes_on(monkeypatch):
    monkeypatch.syspath_prepend(Path(run.__file__).parent)  # benchmarks have a module `run` too
    others = set(multiprocessing.active_children())
    tried = run.in_workers(range(1, 500), ["measured_tables"], 60)
    next(tried)
    (worker,) = set(multiprocessing.active_children()) - others
    worker.kill()
    seed, failures = next((seed, failures) for seed, failures, _ in tried if failures)
    assert failures == [f"seed {seed}: the process ended with -9"]
    following, failures, _ = next(tried)
    tried.close()
    assert (following, failures) == (seed + 1, []) and set(multiprocessing.active_children()) <= others


def test_another_error_than_an_input_error_is_a_failure():
    (failure,) = inputs.refused_or_fine("here", lambda: 1 / 0)
    assert failure.startswith("here: ZeroDivisionError")
    assert not list(inputs.refused_or_fine("here", lambda: st.Indices(theta=-1, lam=1)))


def test_random_contacts_are_solved_and_a_difference_of_solutions_is_found():
    """Contacts that are refused would compare nothing."""
    solved = [inputs._solvable(random.Random(seed)) for seed in range(5)]
    assert None not in solved
    subject, _, _, found = solved[0]
    other = found.assign(contact_area=found["contact_area"] * (1.0 + 1e-9))
    assert list(inputs._differences(subject, found, other, 1e-10))
    assert not list(inputs._differences(subject, found, found, 1e-12))


def test_most_built_cases_are_read_and_a_seed_makes_the_same_case(tmp_path):
    folders = [tmp_path / name for name in ("one", "other")]
    for folder in folders:
        folder.mkdir()
    built = [[case_files.built_case(random.Random(seed), folder) for seed in range(60)] for folder in folders]
    assert repr(built[0]) == repr(built[1])
    read = 0
    for seed in range(60):
        tables = case_files.built_case(random.Random(seed), tmp_path)
        with contextlib.suppress(st.InputError):
            read += bool(case_in(tables, tmp_path))
    assert read > 25
    assert {name for case in built[0] for name in case} >= {"contact", "indices", "solve", "uncertainty", "sweep", "design"}


def test_a_seed_makes_the_same_case_and_seeds_make_different_ones():
    cases = [repr(generate.case_of(seed)) for seed in SEEDS]
    assert cases == [repr(generate.case_of(seed)) for seed in SEEDS]
    assert len(set(cases)) == len(cases)


@pytest.mark.parametrize(
    ("result", "fault"),
    [
        ('{"answer": {"friction_coefficient": 1.0, "interval": [NaN, 2.0]}}', "interval is nan"),
        ('{"answer": {"friction_coefficient": 3.0, "interval": [1.0, 2.0]}}', "not in 0 to its interval"),
        ('{"answer": {"friction_coefficient": 1.0, "interval": [1.0, 1.0]}}', "without width"),
        ('{"answer": {"friction_coefficient": null, "warnings": []}}', "answer: mu is null without a warning"),
        ('{"curve": {"load": [1.0, 2.0], "friction_coefficient": [0.2, null]}}', "curve: mu is null without a warning"),
        ('{"models": [{"why_not": "no film", "x": {}}, {"friction_coefficient": null}]}', "models: mu is null without"),
        ('{"curve": {"load": [-1.0, 2.0], "friction_coefficient": [null, null]}}', "curve: mu is null without a warning"),
        ('{"curve": {"contact_area_low": [1.0, -1e-30]}}', "curve.contact_area_low is negative"),
        ('{"curve": {"load": [1.0, Infinity]}}', "load is inf"),
        ("no result", "no JSON"),
    ],
)
def test_a_fault_in_a_result_is_found(result, fault):
    assert any(fault in found for found in run.faults_of(result))


@pytest.mark.parametrize(
    "said",
    [
        '{"answer": {"load": -1.5, "friction_coefficient": null}}',
        '{"curve": {"load": [-1.0, 2.0], "friction_coefficient": [null, 0.3]}}',
        '{"answer": {"friction_coefficient": null}, "attrs": {"friction_law": "none: this model computes no friction"}}',
    ],
)
def test_a_null_at_a_tensile_load_or_without_friction_is_no_fault(said):
    assert not list(run.faults_of(said))


def test_a_null_with_a_reason_is_no_fault():
    said = '{"answer": {"friction_coefficient": null, "warnings": ["no load"]}, "curve": {"friction_coefficient": [null]}}'
    assert not list(run.faults_of(said))


@pytest.mark.parametrize(
    ("mu", "regime", "faults"), [(0.0, "Elastic.", 0), (0.3, "Elastic.", 1), (0.3, "Pressed flat, A = A_n.", 0)]
)
def test_an_interval_without_width_is_a_fault_where_mu_depends_on_roughness(mu, regime, faults):
    said = json.dumps({"answer": {"friction_coefficient": mu, "interval": [mu, mu], "regime": regime}})
    assert len(list(run.faults_of(said))) == faults


@pytest.mark.parametrize("command", ["validate", "sweep", "film", "slide"])
def test_a_command_answers_the_case_that_is_suited_to_it(command, tmp_path):
    case = generate.example_cases()["Silver film, 200 nm, on hardened steel, with adhesion"]
    path, chance = tmp_path / "case.toml", random.Random(1)
    path.with_name("measured.csv").write_text(generate.measured_text(chance), encoding="utf-8")
    assert run.written(generate.suited_to(command, case, chance), path, command)
    code, out = run.said_of(command, path, 600)
    assert code == 0 and not list(run.faults_of(out))


def test_several_heights_of_a_finish_are_predicted_one_by_one():
    contact = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2"}

    def predicted(height):
        rough = {"finish": "ground", "mean_height": height}
        return st.predict({"contact": contact | {"roughness": rough}, "solve": {"load": ["1 N"]}})

    both = predicted(["0.2 um", "2 um"])
    for place, height in enumerate(("0.2 um", "2 um")):
        alone = predicted(height)
        for name in ("friction_coefficient", "contact_area_low", "contact_area_high"):
            assert float(both[name][place].squeeze()) == pytest.approx(float(alone[name].squeeze()), rel=1e-12)


@pytest.mark.parametrize("text", ["elastic", "e", "-", "boundary lubricant"])
def test_text_without_a_number_is_exchanged_and_not_scaled(text):
    assert isinstance(generate.scaled(random.Random(1), text), str)
