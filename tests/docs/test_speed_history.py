"""The history of speed: what a record keeps of a run, what is said of a fall, and the page that draws it."""

import os
import subprocess
import sys

import matplotlib
import pytest
from pages import ROOT

from stiction.records.registry import RoughSurface, of_kind

matplotlib.use("Agg")
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "benchmarks")]

import history  # noqa: E402 - in benchmarks
import speed_page  # noqa: E402 - in docs/site

MACHINE = {"processor": "A processor", "processors": "2", "system": "Linux"}


def results(**figures: float) -> dict:
    about = {**MACHINE, "versions": "numpy 2", "stiction": "0", "date": "2026-11-22"}
    return {"machine": about, "figures": {history.QUAD: 1000.0, history.EXPONENTIALS: 1e7} | figures}


def test_a_record_keeps_ratios_and_no_speeds_of_others():
    figures = {
        "scattered, evaluations/s": 2e6,
        "a command, processor s": 0.5,
        "scattered, ratio to scipy.quad": 2000.0,
        "map: SurfaceTopography for level, elapsed s": 30.0,
        "peak memory, GB": 0.6,
    }
    kept = history.record(results(**figures), "abc")
    assert kept["ratios"] == {
        "scattered, evaluations/s": {"to_quad": 2000.0, "to_exponentials": 0.2},
        "a command, processor s": {"to_quad": 2e-3, "to_exponentials": 2e-7},  # twice a second
    }
    assert (kept["commit"], kept["machine"]) == ("abc", MACHINE)


def test_a_quarter_less_is_said_and_less_than_that_is_not():
    before = history.record(results(one=8e6, two=8e6), "before")
    now = history.record(results(one=6e6, two=6.1e6), "now")
    said = history.falls([before, now])
    assert said == [
        f"one: ratio to {peer} fell by 25 %, to {now['ratios']['one'][key]:.3g} from {before['ratios']['one'][key]:.3g} "
        "at before, 2026-11-22"
        for key, peer in history.PEERS.items()
    ]


def test_only_the_same_machine_is_compared():
    slow, other = history.record(results(one=1e6), "slow"), history.record(results(one=9e6), "other")
    other["machine"] = MACHINE | {"processors": "64"}
    fast = history.record(results(one=8e6), "fast")
    assert len(history.falls([fast, other, slow])) == 2  # beyond the other machine's record, from the fast one
    assert history.falls([other, slow]) == []
    assert "nothing to compare" in history.told([other, slow])
    assert "No ratio fell" in history.told([slow, fast])


def test_a_peer_that_moved_is_named():
    """Three benchmarks as fast as before, but the loop beside them: that is said once."""
    same = {"one": 8e6, "two": 5e6, "three": 2e6}
    before, now = history.record(results(**same), "before"), history.record(results(**same), "now")
    assert history.moved_peers([before, now]) == []
    for ratios in now["ratios"].values():
        ratios["to_quad"] *= 0.8
    (said,) = history.moved_peers([before, now])
    assert "scipy.quad are 0.80" in said
    assert history.told([before, now]) == said


def test_records_are_appended(tmp_path):
    file = tmp_path / "history.jsonl"
    assert history.read(file) == []
    for commit in ("a", "b"):
        history.append(history.record(results(one=1e6), commit), file)
    assert [one["commit"] for one in history.read(file)] == ["a", "b"]


@pytest.mark.parametrize("count", [0, 1, 2])
def test_the_page_is_made_of_any_number_of_records(tmp_path, count):
    known = [history.record(results(**{"scattered": 1e6, "a command, processor s": 2.0}), f"c{at}") for at in range(count)]
    speed_page.write(tmp_path, known)
    text = (tmp_path / "speed.md").read_text()
    assert len(list(tmp_path.glob("*.png"))) == text.count("{image}") == (2 if count else 0)
    assert ("| scattered | 1e+03 | 0.1 |" in text) == (count > 0)


def test_every_benchmark_of_the_history_is_a_line_of_one_picture():
    known = history.read()
    names = {name for one in known for name in one["ratios"]}
    grouped = [name for _, _, some in speed_page._grouped(known) for name in some]
    assert len(known) >= 9
    assert sorted(grouped) == sorted(names)
    assert all(ratio > 0 for one in known for ratios in one["ratios"].values() for ratio in ratios.values())
    drawn = speed_page.picture(known, grouped[:3])
    assert len(drawn.axes[0].lines) == 3


ASKED = """
import loads, run
from stiction.solving.problem import problem_of

choices = run.model_choices()
for name, choice, film in choices:
    problem_of(run.groups_of_models(2, film, choice), choice)
for key in loads.theories():
    assert loads.theory_at_loads(key, 2) > 0.0
print(*(choice.model for _, choice, _ in choices), *loads.theories())
"""


def test_every_model_can_be_timed():
    """In a process of its own, because benchmarks bind the threads of theirs."""
    place = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT / "benchmarks"), str(ROOT / "src")])}
    done = subprocess.run([sys.executable, "-c", ASKED], env=place, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    models = of_kind(RoughSurface).values()
    assert {one.key for one in models if one.of_map is None} <= set(done.stdout.split())
