"""What every registered model must meet, whatever its name: a new one is held to it by being registered."""

import itertools
import re
from dataclasses import fields, replace

import numpy as np
import pytest

from stiction import registry, summation
from stiction.errors import InputError
from stiction.groups import Groups
from stiction.heights import gaussian
from stiction.quantities import QUANTITIES
from stiction.registry import GRADES, find, records, settle
from stiction.sources import bibliography
from stiction.summation import on_grid, scattered, totals_on_grid
from tables import assert_near, groups, load_size, random_groups

ROUGH = [record for record in records().values() if record.kind == "rough surface"]
FILMS = [record for record in records().values() if record.kind == "film"]
GROUP_NAMES = {field.name for field in fields(Groups)}
COLUMN = {"touching_asperities": 0, "load": 1, "contact_area": 2}


def combinations():
    """Every model with every choice of its options, bare and, where it knows films, coated."""
    for record in ROUGH:
        for values in itertools.product(*record.options.values()):
            options = dict(zip(record.options, values, strict=True))
            for coated in (False, True) if record.coating else (False,):
                yield pytest.param(record, options, coated, id="-".join((record.key, *values, "coated" if coated else "bare")))


def draw(n, coated, seed, **fixed):
    """Groups over the whole range; a film may be thinner than contacts are wide."""
    rng = np.random.default_rng(seed)
    drawn = random_groups(rng, n, coated) | ({"film_aspect": 10.0 ** rng.uniform(-1.5, 2.0, n)} if coated else {})
    return groups(**drawn | fixed)


def regimes_of(record, options, given):
    """The regimes, or a skip with the model's own reason where it refuses this combination."""
    try:
        return record.regimes(given, **settle(record, options))
    except InputError as error:
        pytest.skip(f"refused by the model: {error}")


def size_of_load(load, area, given):
    """At least the integral of |load| (see tables.load_size), for the pull of the film too."""
    if not given.coated:
        return load_size(load, area, given.theta)
    return load_size(load, area, given.theta, given.film_theta / given.n_g**3, np.maximum(given.n_E, 1.0))


each = pytest.mark.parametrize(("record", "options", "coated"), list(combinations()))


@each
def test_nothing_is_negative(record, options, coated):
    """Count, area and resistance of every regime, and a share of asperities that is one at most."""
    given = draw(3000, coated, 31)
    h = np.random.default_rng(37).uniform(-6.0, 8.0, 3000)
    found = scattered(regimes_of(record, options, given), h, gaussian())
    assert np.isfinite(found).all()
    assert (found[..., [0, 2, 3, 4]] >= 0.0).all()
    total = found.sum(axis=0)
    assert total[:, 2].max() > 1.0 and total[:, 0].max() > 0.5
    if record.friction:
        assert total[:, 3:].max() > 0.0
    touching = np.array([regime.touching for regime in regimes_of(record, options, given)])
    if options.get("reading") != "published":  # as printed, some heights are counted twice (D2)
        assert found[touching, :, 0].sum(axis=0).max() <= 1.0 + 1e-10
    if not record.friction:
        assert not found[..., 3:].any()


@each
def test_load_falls_where_declared(record, options, coated):
    """dP/dh <= 0 wherever the load is compressive, if the record (and that of its film) says so."""
    regimes = regimes_of(record, options, draw(400, coated, 43))
    film = find("printed" if options.get("reading") == "published" else options["coating_law"], "film") if coated else None
    if not record.load_falls or (film and not film.load_falls):
        pytest.skip("the record does not claim it")
    h = np.linspace(-5.0, 7.0, 97)
    load = on_grid(regimes, h, gaussian()).sum(axis=0)[:, 1]
    compressive = load[:, 1:] > 0.0
    assert compressive.any()
    assert (np.diff(load, axis=1)[compressive] <= 1e-10 * load[:, :-1][compressive]).all()


@each
def test_grid_and_scattered_agree(record, options, coated, always_grid):
    """Both ways of the engine, for the sums by regime and together: 1e-10."""
    n, h = 60, np.linspace(-4.0, 6.0, 31)
    given = draw(n, coated, 47)
    regimes = regimes_of(record, options, given)
    law = np.repeat(np.arange(n), h.size)
    single = scattered(regimes, np.tile(h, n), gaussian(), law).reshape(len(regimes), n, h.size, 5).transpose(0, 1, 3, 2)
    grid = on_grid(regimes, h, gaussian())
    together, totals = single.sum(axis=0), totals_on_grid(regimes, h, gaussian())
    for place in (0, 2, 3, 4):
        assert_near(grid[:, :, place], single[:, :, place], 1e-10, what=summation.QUANTITIES[place])
    size = size_of_load(together[:, 1].T, together[:, 2].T, given).T
    assert_near(grid.sum(axis=0)[:, 1], together[:, 1], 1e-10, size, "load")
    assert_near(totals[:, 0], together[:, 1], 1e-10, size, "load")
    assert_near(totals[:, 1], together[:, 2], 1e-10, what="area")
    assert_near(totals[:, 2], together[:, 3] + together[:, 4], 1e-10, what="resistance")


@each
def test_order_of_convergence(record, options, coated, monkeypatch):
    """Gauss-Legendre on pieces without a kink inside: errors fall geometrically with the number of nodes, down to 1e-10,
    measured against 160 nodes. A kink that is missed would leave an error that falls as a power."""
    given = draw(400, coated, 53)
    h = np.random.default_rng(59).uniform(-4.0, 6.0, 400)
    regimes = regimes_of(record, options, given)

    def sums(short, long):
        counts = np.full(len(summation._COUNTS), long)  # multiples of eight, as the engine wants them
        counts[0] = short
        monkeypatch.setattr(summation, "_COUNTS", counts)
        monkeypatch.setattr(summation, "_RULES", summation._make_rules(counts))
        return scattered(regimes, h, gaussian()).sum(axis=0)

    best = sums(160, 160)
    size = best.copy()
    size[:, 1] = size_of_load(best[:, 1], best[:, 2], given)
    size[:, 3:] = best[:, 3:].sum(axis=1)[:, None]
    errors = [float((np.abs(sums(n, 2 * n) - best) / (size + 1e-250)).max()) for n in (8, 16, 24, 32)]
    floor = 3e-11  # what rounding leaves
    assert errors[0] > 1e-7, f"too easy to measure anything: {errors}"
    for coarse, fine in itertools.pairwise(errors):
        assert fine < max(coarse / 4.0, floor), errors
    assert errors[-1] < 1e-10, errors


@each
def test_shipped_rules_suffice(record, options, coated, monkeypatch):
    """The worst that the engine's own number of nodes meets: long elastic pieces, seen by every height at once (surfaces
    pressed together, hard films, hardly any adhesion)."""
    rng, n = np.random.default_rng(73), 4000
    hard = {"n_E": 10.0 ** rng.uniform(-1.0, 0.0, n), "n_H": 10.0 ** rng.uniform(1.0, 2.0, n)} if coated else {}
    theta, lam = 10.0 ** rng.uniform(3.0, 8.0, n), 10.0 ** rng.uniform(6.0, 8.0, n)
    given = draw(n, coated, 79, theta=theta, lam=lam, **hard)
    h = rng.uniform(-6.0, -3.0, n)
    regimes = regimes_of(record, options, given)
    shipped = scattered(regimes, h, gaussian()).sum(axis=0)
    counts = np.full(len(summation._COUNTS), 160)
    monkeypatch.setattr(summation, "_COUNTS", counts)
    monkeypatch.setattr(summation, "_RULES", summation._make_rules(counts))
    best = scattered(regimes, h, gaussian()).sum(axis=0)
    assert_near(shipped[:, [0, 2]], best[:, [0, 2]], 1e-10)
    assert_near(shipped[:, 1], best[:, 1], 1e-10, size_of_load(best[:, 1], best[:, 2], given))
    assert_near(shipped[:, 3:].sum(axis=1), best[:, 3:].sum(axis=1), 1e-10)


def limits():
    for record in records().values():
        for number, limit in enumerate(record.limits):
            yield pytest.param(record, limit, id=f"{record.key}-{number}-{limit.parent}")


@pytest.mark.parametrize(("record", "limit"), list(limits()))
def test_declared_limits(record, limit):
    """The model with the groups of the limit is its parent, at every separation and whatever the other groups."""
    film = {"film_aspect": np.inf} if record.kind == "film" else {}
    given = draw(20, bool(film), 61, **film)
    given = replace(given, **{name: np.full(len(given), value) for name, value in limit.groups.items()})
    child, options = record, dict(limit.options)
    if record.kind == "film":
        child = next(one for one in ROUGH if record.key in one.options.get("coating_law", ()))
        options["coating_law"] = record.key
    parent = find(limit.parent, "rough surface")
    inherited = {name: value for name, value in limit.options.items() if name in parent.options}
    bare = replace(given, **{name: None for name in ("n_E", "n_H", "tau", "n_g", "film_aspect", "film_nu", "film_K_beta")})
    h = np.linspace(-3.0, 4.0, 15)
    found = on_grid(child.regimes(given, **settle(child, options)), h, gaussian()).sum(axis=0)
    expected = on_grid(parent.regimes(bare, **settle(parent, inherited)), h, gaussian()).sum(axis=0)
    assert limit.quantities
    for name in limit.quantities:
        place = COLUMN[name]
        size = np.abs(expected[:, place])
        if name == "load":
            size = load_size(expected[:, 1], expected[:, 2], given.theta[:, None])
        assert_near(found[:, place], expected[:, place], limit.within, size, name)


@pytest.mark.parametrize("film", FILMS, ids=lambda film: film.key)
def test_a_thick_film_hides_its_substrate(film):
    """tau -> inf (theory 7): loads and resistances are n_E times those of a surface that is film all through, in the film's
    own groups; the area is the same."""
    if not film.interchangeable:
        pytest.skip("belongs to one reading: adds film loads without n_E and keeps the substrate's plastic term (D4, D5)")
    model = next(one for one in ROUGH if film.key in one.options.get("coating_law", ()))
    options = settle(model, {"coating_law": film.key})
    # A graded film tends to this as w/t and a/t: 1e14 makes that rounding.
    given = draw(200, True, 67, tau=1e14, film_aspect=1e14)
    own = replace(given, theta=given.film_theta, lam=given.film_lam, n_E=np.ones(200), n_H=np.ones(200))
    h = np.linspace(-3.0, 4.0, 15)
    found, expected = (on_grid(model.regimes(one, **options), h, gaussian()).sum(axis=0) for one in (given, own))
    n_E = given.n_E[:, None]
    size = load_size(expected[:, 1], expected[:, 2], own.theta[:, None])
    assert_near(found[:, 1], n_E * expected[:, 1], 1e-9, n_E * size, "load")
    assert_near(found[:, 2], expected[:, 2], 1e-9, what="area")
    assert_near(found[:, 3] + found[:, 4], n_E * (expected[:, 3] + expected[:, 4]), 1e-9, what="resistance")


@pytest.mark.parametrize("record", list(records().values()), ids=list(records()))
def test_record_is_complete(record):
    assert record.kind in ("rough surface", "film")
    assert re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", record.key)
    assert record.regimes.__module__.rsplit(".", 1)[-1] == record.key, "one file per model, of the model's name"
    assert record.grade in GRADES
    assert record.title and not record.title.endswith(".") and "\n" not in record.title
    assert len(record.verified) > 10
    assert record.grade != "C" or any(source.note for source in record.sources), "grade C says what was reconstructed"


@pytest.mark.parametrize("record", list(records().values()), ids=list(records()))
def test_record_refers_to_what_exists(record):
    assert record.sources and {source.key for source in record.sources} <= bibliography().keys()
    assert set(record.needs) <= GROUP_NAMES <= QUANTITIES.keys()
    for validity in record.validity:
        assert validity.quantity in QUANTITIES and validity.low < validity.high and len(validity.why) > 10
    for limit in record.limits:
        assert find(limit.parent, "rough surface").key != record.key
        assert set(limit.groups) <= GROUP_NAMES and set(limit.quantities) <= COLUMN.keys()
        assert 0.0 < limit.within <= 1e-4
        assert settle(record, limit.options).items() >= limit.options.items()


@pytest.mark.parametrize("record", list(records().values()), ids=list(records()))
def test_options(record):
    """The first value is the default; what is not listed is refused by name."""
    assert settle(record, {}) == {name: values[0] for name, values in record.options.items()}
    assert settle(record, dict.fromkeys(record.options)) == settle(record, {})
    for name, values in record.options.items():
        assert len(set(values)) == len(values) > 0
        with pytest.raises(InputError) as caught:
            settle(record, {name: "no such value"})
        assert caught.value.field == name and values[0] in caught.value.allowed
    with pytest.raises(InputError, match="has no such option"):
        settle(record, {"no such option": "x"})


@pytest.mark.parametrize("record", ROUGH, ids=lambda record: record.key)
def test_a_model_depends_on_what_it_says(record):
    """Groups that `needs` does not name change nothing; each that it names changes something."""
    h = np.full(50, 0.5)
    given = draw(50, False, 71)

    def answer(one):
        return scattered(record.regimes(one, **settle(record, {})), h, gaussian())

    plain = answer(given)
    for name in ("theta", "lam", "nu", "hardness_to_yield"):
        other = replace(given, **{name: getattr(given, name) * 0.9})
        assert np.array_equal(answer(other), plain) == (name not in record.needs), name


def test_order_and_lookup():
    kinds = [record.kind for record in records().values()]
    assert kinds == ["rough surface"] * len(ROUGH) + ["film"] * len(FILMS)
    assert [record.key for record in ROUGH] == sorted(record.key for record in ROUGH)
    for kind, field in (("rough surface", "model"), ("film", "coating_law")):
        with pytest.raises(InputError) as caught:
            find("no_such_model", kind)
        assert caught.value.field == field and "\n" not in str(caught.value)
    with pytest.raises(InputError):
        find(FILMS[0].key, "rough surface")


class Outside:
    """What an installed distribution declares: a name and something to load."""

    def __init__(self, record):
        self.record = record

    def load(self):
        return self.record


@pytest.fixture
def outside(monkeypatch):
    """A model registered from outside the package, through an entry point of the group "stiction"."""
    record = replace(ROUGH[0], key="somebody_2031", title="A model of somebody else's")
    asked = []

    def entry_points(group):
        asked.append(group)
        return [Outside(record)]

    monkeypatch.setattr(registry, "entry_points", entry_points)
    records.cache_clear()
    yield record
    assert asked == ["stiction"]
    monkeypatch.undo()
    records.cache_clear()


def test_a_model_from_outside_appears(outside):
    assert find("somebody_2031", "rough surface") is outside
    assert list(records()).index("somebody_2031") == len(ROUGH)  # last of its kind by its name
    assert len(records()) == len(ROUGH) + len(FILMS) + 1
