"""Sweeps: what is stored, what an interruption leaves, who does the work, and one line about everything that is wrong."""

import errno
import filecmp
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import xarray
from typer.testing import CliRunner

from refusals import refusal
from stiction import cli
from stiction.case.text import as_toml
from stiction.quantities.errors import InputError
from stiction.solving.solve import solve
from stiction.studies import evaluate_many
from stiction.studies.sweep import opening as sweep_opening
from stiction.studies.sweep import plan as sweep_plan
from stiction.studies.sweep import run as sweep_run
from stiction.studies.sweep import store as sweep_store
from stiction.studies.sweep import workers as sweep_workers
from stiction.studies.sweep.blocks import merged, statistics_of
from stiction.studies.sweep.plan import make_plan
from stiction.studies.sweep.run import sweep

pytest.importorskip("zarr")

GRID = {
    "indices": {"theta": [20, 40, 80, 160, 320], "lam": {"start": 1, "stop": 100, "count": 4, "spacing": "log"}},
    "solve": {"load": [0.001, 0.01]},
    "sweep": {"block": 12},
}
DRAWN = {
    "indices": {"theta": {"start": 10, "stop": 100}, "lam": {"start": 1, "stop": 100, "spacing": "log"}},
    "solve": {"load": [0.001, 0.01, 0.1]},
    "sweep": {"sample": {"method": "sobol", "count": 64, "seed": 3}, "block": 24},
}
# 5000 blocks: a minute of work, which is to be stopped.
MANY_BLOCKS = (
    "[indices]\ntheta = {start = 10, stop = 100, count = 100}\nlam = {start = 1, stop = 100, count = 100}\n"
    "[solve]\nload = [0.001, 0.01]\n[sweep]\nblock = 4\n"
)


OF_STATISTICS = DRAWN | {"sweep": DRAWN["sweep"] | {"statistics": ["mean", "median"], "keep": ["contact_area"]}}


@pytest.fixture(scope="module")
def stores(tmp_path_factory):
    """Finished stores of two cases, to be compared with or copied, never changed. Loops that are compiled in this process, not
    read from the cache, may differ in the last bit: what is stored is computed a second time."""
    folder = tmp_path_factory.mktemp("stores")
    for name, case in (("drawn", DRAWN), ("statistics", OF_STATISTICS)):
        sweep(case, folder / "first" / name)
        sweep(case, folder / name)
    return {"drawn": folder / "drawn", "statistics": folder / "statistics"}


@pytest.fixture
def whole(stores):
    """The finished store of DRAWN."""
    return stores["drawn"]


@pytest.fixture
def computed(whole):
    """The results in the finished store of DRAWN."""
    with xarray.open_zarr(whole, consolidated=False, chunks=None) as data:
        yield data


def _contacts(plan, region):
    return plan.case.at(plan.arrays(region)).subject


def changed(case, **tables):
    return {**case, **{name: {**case.get(name, {}), **table} for name, table in tables.items()}}


def same(one, other):
    """Whether two stores are the same, file by file and bit by bit."""
    names = [
        sorted(str(file.relative_to(store)) for file in Path(store).rglob("*") if file.is_file()) for store in (one, other)
    ]
    assert names[0] == names[1]
    return filecmp.cmpfiles(one, other, names[0], shallow=False)[0] == names[0]


def test_a_grid_is_what_solve_gives(tmp_path):
    data = sweep(GRID, tmp_path / "store")
    case = make_plan(GRID)
    theta, lam = (one.numbers() for one in case.swept.values())
    whole = solve(_contacts(case, {"theta": slice(None), "lam": slice(None)}), load=[0.001, 0.01])
    assert case.blocks > 3 and data["friction_coefficient"].dims == ("theta", "lam", "load")
    np.testing.assert_array_equal(data["lam"], lam)
    np.testing.assert_array_equal(data["theta"], theta)
    for name in ("friction_coefficient", "contact_area", "mean_separation", "pull_off_force"):
        np.testing.assert_allclose(data[name].transpose(*whole[name].dims), whole[name], rtol=1e-9, atol=1e-300)
        assert data[name].attrs == whole[name].attrs
    assert data.attrs["sources"] == whole.attrs["sources"] and data.attrs["model"] == "soft_coating_2015"


def test_one_worker_compiles_nothing_beforehand(tmp_path, monkeypatch):
    """Kernels are made ready for other processes; a sweep in this process compiles what it needs, if anything."""
    ready = []
    monkeypatch.setattr(sweep_run, "make_ready", lambda: ready.append(1))
    sweep(GRID, tmp_path / "store", workers=1)
    assert not ready
    sweep(GRID, tmp_path / "others", workers=2)
    assert ready == [1]


def test_drawn_points_are_those_of_scipy_in_the_ranges_given(tmp_path):
    from scipy.stats import qmc

    data = sweep(DRAWN, tmp_path / "store")
    shares = qmc.Sobol(2, rng=3, bits=32).random(64)
    np.testing.assert_allclose(data["theta"], 10 + 90 * shares[:, 0], rtol=1e-12)
    np.testing.assert_allclose(data["lam"], 100 ** shares[:, 1], rtol=1e-12)
    assert data["theta"].dims == ("sample",) and data.attrs["seed"] == 3
    for at in (0, 7, 8, 63):
        alone = solve(_contacts(make_plan(DRAWN), {"sample": slice(at, at + 1)}), load=[0.001, 0.01, 0.1])
        np.testing.assert_allclose(data["friction_coefficient"][at], alone["friction_coefficient"][0], rtol=1e-9)


def test_a_latin_hypercube_has_one_point_in_every_stripe(tmp_path):
    case = changed(DRAWN, sweep={"sample": {"method": "latin_hypercube", "count": 50, "seed": 1}})
    theta = sweep(case, tmp_path / "store")["theta"].values
    assert sorted(((theta - 10) / 90 * 50).astype(int)) == list(range(50))


def test_lists_go_together_as_points(tmp_path):
    case = {**GRID, "indices": {"theta": [20, 40, 80], "lam": [1, 10, 100]}, "sweep": {"sample": {"method": "list"}}}
    data = sweep(case, tmp_path / "store")
    assert data["friction_coefficient"].dims == ("sample", "load") and data["lam"].values.tolist() == [1, 10, 100]
    with refusal("indices.lam", "2", "3", "indices.theta"):
        make_plan({**case, "indices": {"theta": [20, 40, 80], "lam": [1, 10]}})


def test_only_what_is_asked_for_is_kept_in_the_precision_asked_for(tmp_path, computed):
    case = changed(DRAWN, sweep={"keep": ["friction_coefficient"], "precision": "float32"})
    data = sweep(case, tmp_path / "store")
    of_blocks = {"validity_warnings_by_block", "checksum_by_block"}
    assert set(data.data_vars) == {"friction_coefficient", "validity_warnings"} | of_blocks
    assert data["friction_coefficient"].dtype == np.float32
    np.testing.assert_allclose(data["friction_coefficient"], computed["friction_coefficient"], rtol=1e-6)
    with refusal("sweep.keep", "friction", "friction_force"):
        sweep(changed(DRAWN, sweep={"keep": ["friction"]}), tmp_path / "other")


def test_statistics_are_those_of_all_points(tmp_path, computed):
    kinds = ["count", "mean", "standard_deviation", "least", "most"]
    data = sweep(changed(DRAWN, sweep={"keep": ["friction_coefficient"], "statistics": kinds}), tmp_path / "store")
    mu = computed["friction_coefficient"].values
    found = data["friction_coefficient"].sel
    wanted = [[64] * 3, mu.mean(axis=0), mu.std(axis=0, ddof=1), mu.min(axis=0), mu.max(axis=0)]
    for kind, values in zip(kinds, wanted, strict=True):
        np.testing.assert_allclose(found(statistic=kind), values, rtol=1e-12)


@pytest.mark.parametrize("count", [64, 61])  # eight blocks of eight contacts; the last of five
def test_percentiles_are_those_of_all_points(tmp_path, count):
    kinds = ["percentile_5", "median", "count", "percentile_95"]
    drawn = changed(DRAWN, sweep={"sample": {**DRAWN["sweep"]["sample"], "count": count}})
    data = sweep(changed(drawn, sweep={"keep": ["friction_coefficient"], "statistics": kinds}), tmp_path / "store")
    mu = sweep(drawn, tmp_path / "whole")["friction_coefficient"].values
    assert data["statistic"].values.tolist() == kinds
    for kind, share in (("percentile_5", 0.05), ("median", 0.5), ("percentile_95", 0.95)):
        wanted = np.quantile(mu, share, axis=0, method="inverted_cdf")
        np.testing.assert_allclose(data["friction_coefficient"].sel(statistic=kind), wanted, rtol=1 / 256)
    np.testing.assert_array_equal(data["friction_coefficient"].sel(statistic="count"), count)


@pytest.mark.parametrize("wide", [1, 3, 7])  # 8 contacts a block: some points have as many sizes, some fewer
def test_counts_of_many_sizes_are_in_several_files(tmp_path, monkeypatch, wide):
    case = changed(DRAWN, sweep={"keep": ["friction_coefficient"], "statistics": ["median", "percentile_95"]})
    whole = sweep(case, tmp_path / "whole")["friction_coefficient"].values
    monkeypatch.setattr(sweep_opening, "_SIZES", wide)
    cut = sweep(case, tmp_path / "cut")["friction_coefficient"].values
    assert len(list((tmp_path / "cut" / "counts_by_block").rglob("c/0/0/0/*"))) == -(-8 // wide)
    np.testing.assert_array_equal(cut, whole)


def test_a_block_that_is_larger_than_what_is_solved_at_once_is_solved_in_pieces(tmp_path, monkeypatch):
    sizes = []
    whole = sweep(changed(DRAWN, sweep={"block": 192}), tmp_path / "whole")["friction_coefficient"].values
    monkeypatch.setattr(sweep_plan, "AT_ONCE", 24)
    solved = evaluate_many.solve_batch
    monkeypatch.setattr(
        evaluate_many,
        "solve_batch",
        lambda subject, *a, **b: (sizes.append(subject.theta.size), solved(subject, *a, **b))[1],
    )
    cut = sweep(changed(DRAWN, sweep={"block": 192}), tmp_path / "cut")["friction_coefficient"].values
    assert sizes[1:] == [8] * 8  # the first is the one contact by which the store is made
    np.testing.assert_array_equal(cut, whole)


def test_pieces_of_a_grid_are_all_of_it_once(monkeypatch):
    monkeypatch.setattr(sweep_plan, "AT_ONCE", 6)
    plan = make_plan(changed(GRID, sweep={"block": 1000}))
    pieces = plan.pieces(0)
    held = np.zeros(tuple(plan.dims.values()), dtype=int)
    for piece in pieces:
        held[tuple(piece.values())] += 1
        assert held[tuple(piece.values())].size <= 3
    assert (held == 1).all()


def test_statistics_have_larger_blocks_where_there_are_many_points():
    def block(count, **more):
        plan = make_plan(changed({**DRAWN, "sweep": {}}, sweep={"sample": {"method": "sobol", "count": count}, **more}))
        return plan.tile["sample"] * plan.points

    assert block(2**22) == block(2**10 * 43) == 131_070  # whole contacts of three loads
    assert block(2**20, statistics=["mean"]) == 131_070
    assert block(2**28, statistics=["mean"]) == 8 * (131_072 // 3) * 3  # as many as eight times what is solved at once, whole
    assert block(2**28, statistics=["mean"], block=30) == 30


@pytest.mark.parametrize("count", [2_900_000, 30_000_000, 2**28])
def test_blocks_of_statistics_leave_no_small_rest_that_is_solved_by_itself(count):
    given = {"sample": {"method": "sobol", "count": count}, "statistics": ["mean"]}
    plan = make_plan({**DRAWN, "sweep": given})
    sizes = {one["sample"].stop - one["sample"].start for one in plan.pieces(0)}
    assert sizes == {131_072 // 3}


def test_statistics_leave_out_what_is_no_number():
    one, two = np.array([[1.0], [np.nan], [3.0]]), np.array([[8.0]])
    whole = merged([statistics_of(one, 1), statistics_of(np.full((2, 1), np.nan), 1), statistics_of(two, 1)])
    assert {name: float(value[0]) for name, value in whole.items()} == {
        "count": 3, "mean": 4, "standard_deviation": pytest.approx(13**0.5), "least": 1, "most": 8,
    }  # fmt: skip
    assert np.isnan(merged([statistics_of(np.full((2, 1), np.nan), 1)])["mean"][0])


def meanings(data):
    attributes = data["validity_warnings"].attrs
    return dict(zip(attributes["flag_meanings"], attributes["flag_masks"], strict=True))


def test_warnings_are_kept_for_every_point(tmp_path):
    case = {
        **GRID,
        "indices": {"theta": [0.5, 40], "lam": 10, "tabor_parameter": [1.0, 100.0]},
        "solve": {"separation": [2, -5]},
    }
    data = sweep(case, tmp_path / "store")
    bit = next(mask for text, mask in meanings(data).items() if text.startswith("tabor_parameter is not 5 or more"))
    left = (data["validity_warnings"].transpose("theta", "tabor_parameter", "mean_separation").values & bit) > 0
    assert left[:, 0].all() and not left[:, 1].any()
    near = next(mask for text, mask in meanings(data).items() if text.startswith("mean_separation is not -4"))
    assert ((data["validity_warnings"] & near) > 0).sel(mean_separation=-5.0).all()
    assert not ((data["validity_warnings"] & near) > 0).sel(mean_separation=2.0).any()


def test_what_is_refused_or_not_carried_is_said_and_the_rest_is_there(tmp_path):
    hardness = {"start": "1 GPa", "stop": "9 GPa", "count": 9}
    steel = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": hardness, "yield_stress": "2 GPa"}
    rough = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    contact = {"first": steel, "second": {**steel, "hardness": "20 GPa"}, "roughness": rough,
               "work_of_adhesion": "1 J/m^2", "nominal_area": "1 mm^2"}  # fmt: skip
    solve = {"load": ["1 N", "1 TN"], "model": "soft_coating_2015"}
    data = sweep({"contact": contact, "solve": solve, "sweep": {"block": 6}}, tmp_path / "store")
    assert np.isfinite(data["friction_coefficient"].values).tolist() == [[at > 0, False] for at in range(9)]
    refused, not_carried = (
        mask for text, mask in meanings(data).items() if text.startswith(("the contact is inv", "the contact cannot carry"))
    )
    assert ((data["validity_warnings"] & refused) > 0).values.tolist() == [[at == 0] * 2 for at in range(9)]  # H below Y
    assert ((data["validity_warnings"] & not_carried) > 0).values.tolist() == [[False, at > 0] for at in range(9)]
    by_block = data["validity_warnings_by_block"].values.sum(axis=0)
    assert {int(by_block[bit]) for bit in range(2)} == {2, 8} and (by_block >= 0).all()  # points, of both


class Stopped(Exception):
    pass


def interrupted(case, out, after):
    """A sweep that is stopped when so many blocks are done."""

    def stop(done, size, steps):
        for count, points in enumerate(steps, start=1):
            yield points
            if count == after:
                raise Stopped

    with pytest.raises(Stopped):
        sweep(case, out, progress=stop)


def test_what_is_done_is_not_done_again(tmp_path, monkeypatch, whole):
    parts, done = tmp_path / "parts", []
    interrupted(DRAWN, parts, after=3)
    (parts / "friction_coefficient" / "c" / "0.0123abcd.partial").write_bytes(b"begun")  # as a process that is killed leaves it
    begun = xarray.open_zarr(parts, consolidated=False, chunks=None)
    assert np.isfinite(begun["friction_coefficient"]).all("load").sum() == 24
    assert (begun["validity_warnings"][24:] == 1 << 31).all()
    do = sweep_store.Store.do
    monkeypatch.setattr(sweep_store.Store, "do", lambda store, block: done.append(block) or do(store, block))
    sweep(DRAWN, parts)
    assert done == [3, 4, 5, 6, 7]
    sweep(DRAWN, parts)
    assert len(done) == 5 and same(whole, parts)


def test_the_store_is_the_same_whoever_does_the_work(tmp_path, whole):
    sweep(DRAWN, tmp_path / "two", workers=2)
    assert same(whole, tmp_path / "two")


def test_processes_are_started_once_while_none_dies(monkeypatch):
    started = []

    def pool(store, blocks, workers):
        started.append(workers)
        yield from ((block, 1) for block in blocks)

    monkeypatch.setattr(sweep_workers, "_in_pool", pool)
    assert sum(sweep_workers.done_in_processes(None, list(range(9)), 2)) == 9 and started == [2]


SCRIPT = """
import os, signal, sys, json
from stiction.studies.sweep import store as sweep_store
from stiction.studies.sweep.run import sweep
do, out = sweep_store.Store.do, sys.argv[2]
def dies(store, block):
    points = do(store, block)
    flag = out + ".died"
    if block == 2 and not os.path.exists(flag):
        open(flag, "w").close()
        os.kill(os.getpid(), signal.SIGKILL)
    return points
sweep_store.Store.do = dies
if __name__ == "__main__":
    sweep(json.loads(sys.argv[1]), out, workers=int(sys.argv[3]))
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no such signal")
@pytest.mark.parametrize("workers", [1, 2])
def test_a_kill_loses_nothing(tmp_path, whole, workers):
    """With one process it is the sweep itself that dies, with two a worker, which is replaced."""
    script, out = tmp_path / "script.py", tmp_path / "store"
    script.write_text(SCRIPT, encoding="utf-8")
    words = [sys.executable, str(script), json.dumps(DRAWN), str(out), str(workers)]
    first = subprocess.run(words, capture_output=True, text=True)
    assert (tmp_path / "store.died").exists()
    assert first.returncode == (-signal.SIGKILL if workers == 1 else 0), first.stderr
    sweep(DRAWN, out)
    assert same(whole, out)


def test_a_full_disk_is_one_line_and_nothing_is_lost(tmp_path, monkeypatch, whole):
    do = sweep_store.Store.do

    def full(store, block):
        if block == 2:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return do(store, block)

    with monkeypatch.context() as patched:
        patched.setattr(sweep_store.Store, "do", full)
        with refusal("--out") as error:
            sweep(DRAWN, tmp_path / "store")
        assert "\n" not in str(error.value)
    sweep(DRAWN, tmp_path / "store")
    assert same(whole, tmp_path / "store")


def test_a_disk_that_fills_up_while_statistics_are_merged_is_one_line(tmp_path, monkeypatch, stores):

    def full(store):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patched:
        patched.setattr(sweep_store.Store, "finish", full)
        with refusal("--out", "full"):
            sweep(OF_STATISTICS, tmp_path / "store")
    sweep(OF_STATISTICS, tmp_path / "store")
    assert same(stores["statistics"], tmp_path / "store")


LIMITED = """
import resource, sys
import xarray, zarr
from stiction import cli
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[3]), int(sys.argv[3])))
cli.app(["sweep", sys.argv[1], "--out", sys.argv[2]])
"""


@pytest.mark.skipif(os.name != "posix", reason="no such limit")
@pytest.mark.parametrize("limit", [10, 108])  # bytes: before the store is there, and at the first block
def test_a_file_that_grows_beyond_a_limit_is_one_line_and_nothing_is_lost(tmp_path, computed, limit):
    """By the limit of the operating system, which stands for a disk that is full."""
    case, store = tmp_path / "case.toml", tmp_path / "store"
    case.write_text(as_toml(DRAWN), encoding="utf-8")
    if limit > 100:
        sweep_opening.create(store, make_plan(DRAWN), "", as_toml(DRAWN))
    words = [sys.executable, "-c", LIMITED, str(case), str(store), str(limit)]
    ended = subprocess.run(words, capture_output=True, text=True)
    errors = [line for line in ended.stderr.splitlines() if line.startswith("stiction: ")]
    assert ended.returncode == 2 and len(errors) == 1 and "--out" in errors[0], ended.stderr
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []
    np.testing.assert_array_equal(sweep(case, store).contact_area, computed.contact_area)


def test_a_store_that_another_process_creates_meanwhile_is_used(tmp_path, monkeypatch, whole):
    """The other process is faster while this one writes its store beside the place."""
    fill = sweep_opening._fill
    begun = []

    def beaten(*arguments):
        fill(*arguments)
        if not begun:
            begun.append(True)
            sweep(DRAWN, tmp_path / "store")

    monkeypatch.setattr(sweep_opening, "_fill", beaten)
    sweep(DRAWN, tmp_path / "store")
    assert same(whole, tmp_path / "store")
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_a_clock_that_jumps_changes_nothing(tmp_path, monkeypatch, whole):
    interrupted(DRAWN, tmp_path / "store", after=2)
    jumps = iter(np.random.default_rng(0).uniform(0.0, 4e9, 1_000_000))
    monkeypatch.setattr(time, "time", lambda: next(jumps))
    sweep(DRAWN, tmp_path / "store")
    assert same(whole, tmp_path / "store")


@pytest.mark.parametrize(
    ("other", "where"),
    [
        (changed(DRAWN, indices={"theta": {"start": 10, "stop": 101}}), "indices.theta.stop"),
        (changed(DRAWN, sweep={"sample": {"method": "sobol", "count": 64, "seed": 4}}), "sweep.sample.seed"),
        (changed(DRAWN, solve={"load": [0.1]}), "solve.load"),
    ],
)
def test_a_store_of_another_case_is_left_alone(tmp_path, other, where):
    interrupted(DRAWN, tmp_path / "store", after=2)
    before = {file: file.read_bytes() for file in (tmp_path / "store").rglob("*") if file.is_file()}
    with refusal("--out", where):
        sweep(other, tmp_path / "store")
    assert before == {file: file.read_bytes() for file in (tmp_path / "store").rglob("*") if file.is_file()}


@pytest.mark.parametrize("damage", [None, b"", b'{"zarr_format": 3'])
@pytest.mark.parametrize("file", ["contact_area/zarr.json", "validity_warnings_by_block/zarr.json", "zarr.json"])
def test_a_store_with_a_damaged_description_is_refused_in_one_line(tmp_path, file, damage):
    interrupted(DRAWN, tmp_path / "store", after=2)
    path = tmp_path / "store" / file
    path.unlink() if damage is None else path.write_bytes(damage)
    with refusal("--out"):
        sweep(DRAWN, tmp_path / "store")


def _delete(chunks):
    chunks[1].unlink()


def _damage(chunks):
    content = bytearray(chunks[1].read_bytes())
    content[-3] ^= 0x10
    chunks[1].write_bytes(content)


def _exchange(chunks):
    first, second = chunks[0].read_bytes(), chunks[1].read_bytes()
    chunks[0].write_bytes(second)
    chunks[1].write_bytes(first)


@pytest.mark.parametrize("spoil", [_delete, _damage, _exchange])
@pytest.mark.parametrize(
    ("name", "array"),
    [
        ("drawn", "friction_coefficient"),
        ("drawn", "validity_warnings"),
        ("drawn", "theta"),
        ("statistics", "statistics_by_block/contact_area"),
        ("statistics", "counts_by_block/contact_area"),
    ],
)
def test_blocks_whose_files_were_spoilt_are_done_again(tmp_path, stores, name, array, spoil):
    """Also where a wrong chunk can be read, or a chunk that is absent would be read as its fill value."""
    spoilt = tmp_path / "spoilt"
    shutil.copytree(stores[name], spoilt)
    spoil(sorted(path for path in (spoilt / array / "c").rglob("*") if path.is_file()))
    sweep(DRAWN if name == "drawn" else OF_STATISTICS, spoilt)
    assert same(stores[name], spoilt)


@pytest.mark.parametrize("spoil", [_damage, _exchange])
def test_a_store_whose_coordinates_were_changed_is_refused_in_one_line(tmp_path, spoil):
    sweep(GRID, tmp_path / "store")
    chunks = [path for name in ("lam", "theta") for path in (tmp_path / "store" / name / "c").rglob("*") if path.is_file()]
    spoil(chunks)
    with refusal("--out", "changed or deleted"):
        sweep(GRID, tmp_path / "store")


def test_a_list_of_blocks_that_cannot_be_read_is_refused_in_one_line(tmp_path):
    interrupted(DRAWN, tmp_path / "store", after=2)
    chunk = next(path for path in (tmp_path / "store" / "validity_warnings_by_block" / "c").rglob("*") if path.is_file())
    chunk.write_bytes(b"no chunk")
    with refusal("--out"):
        sweep(DRAWN, tmp_path / "store")


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / "mine.txt").write_text("kept")
    with refusal("--out"):
        sweep(DRAWN, tmp_path)
    with refusal("--out"):
        sweep(DRAWN, tmp_path / "mine.txt")
    assert [file.name for file in tmp_path.iterdir()] == ["mine.txt"]


def test_two_sweeps_do_not_share_a_store(tmp_path):
    sweep(DRAWN, tmp_path / "store")
    with sweep_run.locked(tmp_path / "store"), refusal("--out"):
        sweep(DRAWN, tmp_path / "store")


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"sample": {"method": "sobol"}}, "sweep.sample.count: not given; allowed: a whole number, 1 or more"),
        ({"sample": {"method": "grid", "count": 3}}, "sweep.sample.count: 3; allowed: no value"),
        ({"sample": {"method": "halton", "count": 3}}, "sweep.sample.method: 'halton'; allowed: "),
        ({"precision": "float16"}, "sweep.precision: 'float16'; allowed: "),
        ({"statistics": ["median"]}, "allowed: "),
        ({"block": 0}, "sweep.block: 0; allowed: a whole number, 1 to"),
    ],
)
def test_what_is_wrong_is_one_line(tables, message):
    with pytest.raises(InputError) as error:
        make_plan({**DRAWN, "sweep": tables})
    assert message in str(error.value) and "\n" not in str(error.value)


def test_single_numbers_are_no_sweep():
    with refusal("contact"):
        make_plan({"indices": {"theta": 40, "lam": 10}, "solve": {"load": 1}})


def test_the_command_shows_how_far_it_is_and_what_is_outside(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(
        '[indices]\ntheta = {start = 10, stop = 100}\nlam = 10\n[solve]\nload = [0.01]\n'
        '[sweep]\nsample = {method = "sobol", count = 8}\nkeep = ["friction_coefficient"]\n', encoding="utf-8",
    )  # fmt: skip
    result = CliRunner().invoke(cli.app, ["sweep", str(case), "--out", str(tmp_path / "store")])
    assert result.exit_code == 0, (result.output, result.exception)
    assert (
        result.stderr.startswith("Reading the case")
        and "0 of 8 points" in result.stderr
        and "8 points, 8 of them computed now" in result.stdout
    )
    again = CliRunner().invoke(cli.app, ["sweep", str(case), "--out", str(tmp_path / "store"), "--json"])
    said = json.loads(again.stdout)
    assert (said["points"], said["computed_now"], said["dims"]) == (8, 0, {"sample": 8})
    with xarray.open_zarr(tmp_path / "store", consolidated=False, chunks=None) as data:
        assert data.attrs["case_file"] == case.read_text(encoding="utf-8")


def test_a_cluster_does_the_same(tmp_path):
    distributed = pytest.importorskip("distributed")
    many = changed(DRAWN, sweep={"block": 6})  # more blocks than wait for workers at once
    sweep(many, tmp_path / "one")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0", processes=False, protocol="tcp"
    ) as cluster:
        sweep(many, tmp_path / "two", scheduler=cluster.scheduler_address)
    assert same(tmp_path / "one", tmp_path / "two")


def test_as_many_blocks_wait_as_a_cluster_that_grows_has_use_for(monkeypatch):
    """Workers that come later, out of the queue of a batch system, find blocks that wait for them."""
    clock, workers = [100.0], [0]

    class Client:
        def nthreads(self):
            return dict.fromkeys(range(workers[0]), 2)

    monkeypatch.setattr(sweep_workers, "monotonic", lambda: clock[0])
    room, found = sweep_workers._Room(Client()), []
    for clock[0], workers[0] in ((100.0, 0), (101.0, 500), (106.0, 500), (112.0, 2)):
        found.append(room.now())
    assert found == [256, 256, 3000, 256]


def test_every_contact_is_in_one_block():
    case = changed(GRID, indices={"nu": [0.2, 0.3, 0.4]}, sweep={"block": 14})
    plan = make_plan(case)
    seen = np.zeros(tuple(plan.dims.values()), dtype=int)
    for block in range(plan.blocks):
        region = plan.region(block)
        assert plan.contacts(block) * plan.points <= 14
        seen[tuple(region.values())] += 1
    assert (seen == 1).all() and plan.size == 5 * 4 * 3 * 2


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="processes are told by /proc")
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_workers_end_with_the_process_that_shares_out_the_work(tmp_path, how):
    """A batch system ends a job so: workers that wait for more would wait for ever, and hold its memory."""
    out = tmp_path / "store"
    with sweeping(tmp_path, "--workers", "2", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        within(60.0, lambda: len(list(out.glob("validity_warnings_by_block/c/*"))) > 4)
        process.send_signal(how)
        process.wait(10.0)
        within(60.0, lambda: not alive_of(process.pid))  # as long as a busy machine takes: they would wait for ever
    assert len(list(out.glob("validity_warnings_by_block/c/*"))) > 4


@contextmanager
def sweeping(folder, *more, **streams):
    """The command that sweeps many blocks into `store` of the folder, in a session whose processes are killed at the end."""
    case = folder / "case.toml"
    case.write_text(MANY_BLOCKS, encoding="utf-8")
    words = [sys.executable, "-m", "stiction", "sweep", str(case), "--out", str(folder / "store"), *more]
    process = subprocess.Popen(words, text=True, start_new_session=True, **streams)
    try:
        yield process
    finally:
        for one in alive_of(process.pid):
            os.kill(one, signal.SIGKILL)


def within(seconds, so):
    end = time.monotonic() + seconds
    while not so():
        assert time.monotonic() < end
        time.sleep(0.1)


def alive_of(session):
    """The processes of a session that are no corpses."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            _, _, rest = status.read_text().rpartition(") ")
        except OSError:
            continue
        state, *numbers = rest.split()
        if state != "Z" and int(numbers[2]) == session:
            found.append(int(status.parent.name))
    return found


def test_far_too_many_blocks_are_refused():
    many = {"start": 1, "stop": 2, "count": 100_000}
    with refusal("sweep", "1000000000000000", "50000000"):
        make_plan(
            {"indices": {"theta": many, "lam": many, "nu": {**many, "start": 0.1, "stop": 0.4}}, "solve": {"load": [0.1]}}
        )
    usual = {"indices": {"theta": many, "lam": many}, "solve": {"load": {"start": 0.1, "stop": 1, "count": 100}}}
    assert make_plan(usual).size == 10**12


@pytest.mark.parametrize("workers", [0, 1025, True, 1.5])
def test_workers_are_as_many_as_a_machine_may_have(tmp_path, workers):
    with refusal("--workers", "1", "1024"):
        sweep(DRAWN, tmp_path / "store", workers=workers)


def test_names_of_the_tables_of_a_store_are_no_dimensions(tmp_path):
    for name in ("validity_warnings", "validity_warnings_by_block", "statistics_by_block", "counts_by_block"):
        with refusal("indices.theta.along", name):
            make_plan(changed(GRID, indices={"theta": {"values": [20, 30], "along": name}}))


def test_another_spacing_is_another_case():
    log, linear = ({"theta": {"start": 10, "stop": 100, "spacing": one}, "lam": 10} for one in ("log", "linear"))
    one, other = (make_plan({**DRAWN, "indices": given}).identity() for given in (log, linear))
    assert one != other


def test_an_interruption_waits_until_a_block_is_written(tmp_path, monkeypatch):
    """Or zarr is cut off as it writes, and complains of its coroutines after the last line that the user should see."""
    write, written = sweep_store.Store._write, []

    def interrupted(store, block, *found):
        signal.raise_signal(signal.SIGINT)
        write(store, block, *found)
        written.append(block)

    monkeypatch.setattr(sweep_store.Store, "_write", interrupted)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # processes in the background may ignore Ctrl-C
    try:
        with pytest.raises(KeyboardInterrupt):
            sweep(DRAWN, tmp_path / "store")
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)
    assert len(written) == 1


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no groups of processes")
@pytest.mark.parametrize("more", [[], ["--workers", "2"]])
def test_an_interruption_of_the_command_keeps_what_is_done(tmp_path, more):
    """Ctrl-C reaches all processes of a terminal at once."""
    out = tmp_path / "store"
    with sweeping(tmp_path, *more, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        within(60.0, lambda: len(list(out.glob("validity_warnings_by_block/c/*"))) > 4)
        os.killpg(process.pid, signal.SIGINT)
        printed, said = process.communicate(timeout=30.0)
    lines = said.splitlines()
    assert (process.returncode, printed) == (130, "") and "Traceback" not in said
    assert lines[-2].startswith("stopped: ") and lines[-2].endswith("run the command again to continue")
    assert lines[-1] == "stiction: interrupted"
    assert 4 < len(list(out.glob("validity_warnings_by_block/c/*"))) < 5000


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no groups of processes")
def test_an_interruption_while_workers_import_their_modules_prints_no_traceback(tmp_path):
    out = tmp_path / "store"
    with sweeping(tmp_path, "--workers", "2", stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        within(60.0, lambda: len(alive_of(process.pid)) > 1 and out.exists())
        os.killpg(process.pid, signal.SIGINT)
        _, said = process.communicate(timeout=60.0)
    assert process.returncode == 130 and "Traceback" not in said
    assert said.splitlines()[-1] == "stiction: interrupted"


def test_workers_may_die_as_often_as_they_do_something_between(monkeypatch):
    from concurrent.futures.process import BrokenProcessPool

    def dying(store, blocks, workers):
        yield blocks[0], 1
        raise BrokenProcessPool

    monkeypatch.setattr(sweep_workers, "_in_pool", dying)
    left = list(range(sweep_workers._DEATHS + 2))
    done = sweep_workers.done_in_processes(None, left, 2)
    assert [next(done) for _ in left] == [1] * len(left)


def test_a_store_of_another_version_is_left_alone(tmp_path, monkeypatch):
    interrupted(DRAWN, tmp_path / "store", after=2)
    monkeypatch.setattr(sweep_opening, "__version__", "0.0.other")
    with refusal("--out", "0.1.0"):
        sweep(DRAWN, tmp_path / "store")


def test_a_load_that_flattens_the_faces_is_not_predicted_and_the_others_are(tmp_path):
    steel = {"preset": "hardened_steel_52100", "hardness": ["6 GPa", "8 GPa"]}
    rough = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    contact = {"first": steel, "second": "hardened_steel_52100", "roughness": rough, "nominal_area": "1 mm^2"}
    data = sweep({"contact": contact, "solve": {"load": ["1 N", "1 TN"]}}, tmp_path / "store")
    assert np.isfinite(data["friction_coefficient"].values).tolist() == [[True, False]] * 2


def test_the_first_contact_may_be_refused(tmp_path):
    """The model knows no surfaces of few asperities; which laws answer is asked of the first contact that is one."""
    rough = {"asperity_height_deviation": "50 nm", "asperity_radius": "50 um", "asperity_density": ["5e9 1/m^2", "2e10 1/m^2"]}
    contact = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2",
               "interfacial_shear_strength": "20 MPa", "roughness": rough}  # fmt: skip
    data = sweep({"contact": contact, "solve": {"load": "1 N", "model": "hariri_zu_ben_mrad_2006"}}, tmp_path / "store")
    mu = data["friction_coefficient"].values.ravel()
    assert np.isnan(mu[0]) and mu[1] > 0.0


@pytest.mark.parametrize("block", [1, 2])
def test_a_block_whose_contacts_are_all_refused_is_no_number_and_the_others_are_predicted(tmp_path, block):
    rough = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    area = ["1 mm^2", "1e-12 mm^2"]
    contact = {"first": "copper", "second": "copper", "roughness": rough, "nominal_area": area}
    data = sweep({"contact": contact, "solve": {"load": ["0.1 N"]}, "sweep": {"block": block}}, tmp_path / "store")
    assert np.isfinite(data["friction_coefficient"].values).ravel().tolist() == [True, False]
