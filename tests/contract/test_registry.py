"""What every registered law must meet, whatever its name: a new one is held to it by being registered."""

import itertools
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from refusals import refusal
from stiction.contact.indices import Groups
from stiction.engine import summation
from stiction.engine.heights import gaussian, height_distribution
from stiction.engine.skeleton import _densities
from stiction.engine.summation import on_grid, scattered, totals_on_grid
from stiction.laws.joining import coordinates, normal_states
from stiction.laws.presliding.kind import Presliding
from stiction.quantities.errors import InputError
from stiction.quantities.table import QUANTITIES
from stiction.records.registry import (
    GRADES,
    TRAITS,
    AsperityLaw,
    FilmLaw,
    RoughSurface,
    TangentialLaw,
    find,
    friction_incompatibility,
    incompatibility,
    kinds,
    of_kind,
    records,
    resolve_options,
    select_options,
)
from stiction.records.sources import bibliography
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import FILM_GROUPS, assert_near, groups, load_size, random_groups, random_others, without_adhesion

ROUGH = [record for record in of_kind(RoughSurface).values() if record.asperity]
CLOSED = [record for record in of_kind(RoughSurface).values() if not record.asperity and record.of_map is None]
ASPERITIES, TANGENTIALS, FILMS = (list(of_kind(kind).values()) for kind in (AsperityLaw, TangentialLaw, FilmLaw))
HOW_MANY = len(records())
GROUP_NAMES = set(Groups.model_fields)
CHOSEN = (RoughSurface, AsperityLaw, TangentialLaw, FilmLaw)
LIMITED = {"touching_asperities", "load", "contact_area", "friction_force"}
FOUND = {"asperity_height_deviation", "asperity_radius", "asperity_density"}  # by a way of finding asperities
PLAIN = "greenwood_williamson_1966"
OF_THE_INTERFACE = next(one.key for one in TANGENTIALS if one.interfacial)
each_record = pytest.mark.parametrize("record", records(), ids=lambda record: f"{record.kind}-{record.key}")


def with_options(choice, *laws):
    """The choice with every combination of the laws' own options."""
    known = {name: values for law in laws for name, values in law.options.items()}
    for values in itertools.product(*known.values()):
        yield replace(choice, options=dict(zip(known, values, strict=True)))


def film_choice(film):
    """A film under a model that it suits."""
    if film.tangential == "interface":
        return Choice(PLAIN, tangential=OF_THE_INTERFACE, film=film.key)
    model = next(
        one for one in ROUGH[::-1] if one.tangential != "none" and not incompatibility(film, find(one.asperity, AsperityLaw))
    )
    return Choice(model.key, film=film.key)


def subjects():
    """Every law in a model that has it, with every choice of its options: (choice, coated)."""
    taken = {record.asperity for record in ROUGH}
    for record in ROUGH:
        for choice in with_options(Choice(record.key), record, find(record.asperity, AsperityLaw)):
            yield choice, False
    for law in ASPERITIES:
        if law.key not in taken:
            yield from ((choice, False) for choice in with_options(Choice(PLAIN, asperity=law.key), law))
    used = {record.tangential for record in ROUGH}
    for law in TANGENTIALS:
        if law.key not in used:
            fitting = next(one for one in ASPERITIES if not incompatibility(law, one))
            yield from ((choice, False) for choice in with_options(Choice(PLAIN, fitting.key, law.key), law))
    for film in FILMS:
        if film.interchangeable:
            yield from ((choice, True) for choice in with_options(film_choice(film), film))
    yield Choice(options={"variant": "published"}), True


def name_of(choice, coated):
    parts = choice.model_key, choice.asperity, choice.tangential, choice.film, *choice.options.values()
    return "-".join([*(part for part in parts if part), "coated" if coated else "bare"])


def draw(n, coated, seed, **fixed):
    """Groups over the whole range; a film may be thinner than contacts are wide."""
    rng = np.random.default_rng(seed)
    drawn = random_groups(rng, n, coated) | ({"film_aspect": 10.0 ** rng.uniform(-1.5, 2.0, n)} if coated else {})
    return groups(**random_others(rng, n) | drawn | fixed)


def problem(choice, given):
    """The problem, or a skip with the model's own reason where it refuses this combination of options."""
    found = problem_of(given, choice)
    try:
        assert found.regimes
    except InputError as error:
        pytest.skip(f"refused by the model: {error}")
    return found


def accuracy(found):
    return max(record.accuracy for record in found.records())


def size_of_load(load, area, given):
    """At least the integral of |load| (see tables.load_size), for the pull of the film too."""
    if not given.has_film:
        return load_size(load, area, given.theta)
    return load_size(load, area, given.theta, given.film().theta / given.n_g**3, np.maximum(given.n_E, 1.0))


each = pytest.mark.parametrize(("choice", "coated"), [pytest.param(*one, id=name_of(*one)) for one in subjects()])


@each
def test_nothing_is_negative(choice, coated):
    """Count, area and resistance of every regime, and a share of asperities that is one at most."""
    given = draw(3000, coated, 31)
    h = np.random.default_rng(37).uniform(-6.0, 8.0, 3000)
    found = problem(choice, given)
    sums = scattered(found.regimes, h, gaussian())
    assert np.isfinite(sums).all()
    assert (sums[..., [0, 2, 3, 4]] >= 0.0).all()
    total = sums.sum(axis=0)
    assert total[:, 2].max() > 1.0 and total[:, 0].max() > 0.5
    touching = np.array([regime.touching for regime in found.regimes])
    if choice.options.get("variant") != "published":  # as printed, some heights are counted twice (D2)
        assert sums[touching, :, 0].sum(axis=0).max() <= 1.0 + 1e-10
    assert (total[:, 3:].max() > 0.0) == found.friction


@each
def test_load_falls_where_declared(choice, coated):
    """dP/dh <= 0 wherever the load is compressive, if all the records say so."""
    found = problem(choice, draw(400, coated, 43))
    if not all(record.load_is_monotonic for record in found.records()):
        pytest.skip("a record does not claim it")
    load = found.loads_on_grid(np.linspace(-5.0, 7.0, 97))
    compressive = load[:, 1:] > 0.0
    assert compressive.any()
    assert (np.diff(load, axis=1)[compressive] <= 1e-10 * load[:, :-1][compressive]).all()


@each
def test_grid_and_scattered_agree(choice, coated, always_grid):
    """Both ways of the engine, for the sums by regime and together: 1e-10, or what the records say."""
    n, h = 60, np.linspace(-4.0, 6.0, 31)
    given = draw(n, coated, 47)
    found = problem(choice, given)
    regimes, within = found.regimes, accuracy(found)
    law = np.repeat(np.arange(n), h.size)
    single = scattered(regimes, np.tile(h, n), gaussian(), law).reshape(len(regimes), n, h.size, 5).transpose(0, 1, 3, 2)
    grid = on_grid(regimes, h, gaussian())
    together, totals = single.sum(axis=0), totals_on_grid(regimes, h, gaussian())
    for place in (0, 2, 3, 4):
        assert_near(grid[:, :, place], single[:, :, place], within, what=summation.QUANTITIES[place])
    size = size_of_load(together[:, 1].T, together[:, 2].T, given).T
    assert_near(grid.sum(axis=0)[:, 1], together[:, 1], within, size, "load")
    assert_near(totals[:, 0], together[:, 1], within, size, "load")
    assert_near(totals[:, 1], together[:, 2], within, what="area")
    assert_near(totals[:, 2], together[:, 3] + together[:, 4], within, what="resistance")


@cache
def rules_of(short, long):
    counts = np.full(len(summation._COUNTS), long)
    counts[0] = short
    return counts, summation._make_rules(counts)


def with_nodes(monkeypatch, short, long):
    """Let the engine take these numbers of nodes, multiples of eight, on short and on long segments."""
    counts, rules = rules_of(short, long)
    monkeypatch.setattr(summation, "_COUNTS", counts)
    monkeypatch.setattr(summation, "_RULES", rules)


@each
def test_order_of_convergence(choice, coated, monkeypatch):
    """Gauss-Legendre on segments without a kink inside: errors fall geometrically with the number of nodes, down to 1e-10 or
    what the record says, measured against 160 nodes. A kink that is missed would leave an error that falls as a power."""
    given = draw(400, coated, 53)
    h = np.random.default_rng(59).uniform(-4.0, 6.0, 400)
    found = problem(choice, given)

    def sums(short, long):
        with_nodes(monkeypatch, short, long)
        return scattered(found.regimes, h, gaussian()).sum(axis=0)

    best = sums(160, 160)
    size = best.copy()
    size[:, 1] = size_of_load(best[:, 1], best[:, 2], given)
    size[:, 3:] = best[:, 3:].sum(axis=1)[:, None]
    errors = [float((np.abs(sums(n, 2 * n) - best) / (size + 1e-250)).max()) for n in (8, 16, 24, 32)]
    floor = max(3e-11, accuracy(found) / 3.0)  # what rounding leaves, or the law claims
    assert errors[0] > 1e-7, f"too easy to measure anything: {errors}"
    for coarse, fine in itertools.pairwise(errors):
        assert fine < max(coarse / 4.0, floor), errors
    assert errors[-1] < accuracy(found), errors


@each
def test_shipped_rules_suffice(choice, coated, monkeypatch):
    """The worst that the engine's own number of nodes meets: long elastic segments, seen by every height at once (surfaces
    pressed together, hard films, hardly any adhesion)."""
    rng, n = np.random.default_rng(73), 2000
    hard = {"n_E": 10.0 ** rng.uniform(-1.0, 0.0, n), "n_H": 10.0 ** rng.uniform(1.0, 2.0, n)} if coated else {}
    theta, lam = 10.0 ** rng.uniform(3.0, 8.0, n), 10.0 ** rng.uniform(6.0, 8.0, n)
    given = draw(n, coated, 79, theta=theta, lam=lam, **hard)
    h = rng.uniform(-6.0, -3.0, n)
    found = problem(choice, given)
    shipped = scattered(found.regimes, h, gaussian()).sum(axis=0)
    with_nodes(monkeypatch, 160, 160)
    best = scattered(found.regimes, h, gaussian()).sum(axis=0)
    assert_near(shipped[:, [0, 2]], best[:, [0, 2]], accuracy(found))
    assert_near(shipped[:, 1], best[:, 1], accuracy(found), size_of_load(best[:, 1], best[:, 2], given))
    assert_near(shipped[:, 3:].sum(axis=1), best[:, 3:].sum(axis=1), accuracy(found))


def limits():
    for record in records():
        if record.kind == "asperity method":  # see test_asperity_records.py
            continue
        for number, limit in enumerate(record.limits):
            yield pytest.param(record, limit, id=f"{record.kind}-{record.key}-{number}-{limit.parent}")


def choice_of(record, kind, options=None):
    """A model in which a record of this kind is."""
    if kind is FilmLaw:
        return replace(film_choice(record), options=options or {})
    key = {"model": PLAIN} | {kind.keyword: record.key}
    if kind is TangentialLaw:
        key["asperity"] = next(one.key for one in ASPERITIES if not incompatibility(record, one))
    return Choice.of(key.pop("model", None), key | (options or {}))


@pytest.mark.parametrize(("record", "limit"), list(limits()))
def test_declared_limits(record, limit):
    """The law with the groups of the limit is its parent, at every separation and whatever the other groups."""
    given = draw(20, record.kind == "film", 61, **({"film_aspect": np.inf} if record.kind == "film" else {}))
    given = given.with_changes(**{name: np.full(len(given), value) for name, value in limit.groups.items()})
    parent_kind = RoughSurface if record.kind == "film" else type(record)
    parent = find(limit.parent, parent_kind)
    child = problem_of(given, choice_of(record, type(record), dict(limit.options)))
    known = resolve_options([parent, *([find(parent.asperity, AsperityLaw)] if getattr(parent, "asperity", "") else [])], {})
    inherited = {name: value for name, value in limit.options.items() if name in known}
    expected_of = problem_of(given.substrate(), choice_of(parent, parent_kind, inherited))
    if getattr(record, "area_at_load", None):
        loads = np.tile(np.geomspace(1e-6, 10.0, 15), (20, 1))
        found, expected = child.at_load(loads), expected_of.at_load(loads)
    else:
        h = np.linspace(-3.0, 4.0, 15)
        found, expected = child.on_grid(h), expected_of.on_grid(h)
    assert limit.quantities
    for name in limit.quantities:
        size = np.abs(expected[name])
        if name == "load":
            size = load_size(expected["load"], expected["contact_area"], given.theta[:, None])
        assert_near(found[name], expected[name], limit.within, size, name)


@pytest.mark.parametrize("law", ASPERITIES, ids=lambda law: law.key)
def test_segments_join_where_no_jump_is_reported(law):
    """Where one segment gives way to the next, displacement goes on and load and area are multiplied by what the record says:
    by nothing, if it says nothing. Everywhere else they are one segment and smooth."""
    reported = {jump.segment: jump for jump in law.jumps}
    given = draw(60, False, 83)
    for number in range(1, len(law.segments(given, **resolve_options([law], {})))):
        jump = reported.get(number)
        chosen = given.with_changes(**{name: np.full(60, value) for name, value in (jump.groups if jump else {}).items()})
        before, after = law.segments(chosen, **resolve_options([law], {}))[number - 1 : number + 1]
        there = (before.edges[:, -1] > before.edges[:, 0]) & (after.edges[:, -1] > after.edges[:, 0])
        end, start = normal_states(before, before.edges[:, -1])[there], normal_states(after, after.edges[:, 0])[there]
        assert there.any()
        np.testing.assert_allclose(start[:, 0], end[:, 0], rtol=1e-9, err_msg="displacement")
        for name, column, factor in (("load", 2, jump.load if jump else 1.0), ("area", 3, jump.area if jump else 1.0)):
            within = 1e-3 if jump else 1e-9
            expected = factor * end[:, column]
            np.testing.assert_allclose(start[:, column], expected, rtol=within, err_msg=f"{name}, segment {number}")


def pairs():
    for asperity, tangential in itertools.product(ASPERITIES, TANGENTIALS):
        yield pytest.param(asperity, tangential, id=f"{asperity.key}-{tangential.key}")


@pytest.mark.parametrize(("asperity", "tangential"), list(pairs()))
def test_any_asperity_law_with_any_tangential_law(asperity, tangential):
    """They are summed if the records say that they suit each other, and refused with the reason if not."""
    given = draw(40, False, 89)
    choice = Choice(PLAIN, asperity.key, tangential.key)
    if reason := incompatibility(tangential, asperity):
        with pytest.raises(InputError) as caught:
            problem_of(given, choice)
        assert all(why in str(caught.value) for why in [tangential.key, asperity.key])
        assert any(why in reason for why in tangential.required_traits.values())
        return
    found = problem_of(given, choice)
    sums = scattered(found.regimes, np.linspace(-2.0, 3.0, 40), gaussian())
    assert np.isfinite(sums).all() and (sums[..., [0, 2, 3, 4]] >= 0.0).all() and sums[..., 3:].max() > 0.0
    alone = scattered(problem_of(given, replace(choice, tangential="none")).regimes, np.linspace(-2.0, 3.0, 40), gaussian())
    assert_near(sums[..., :3].sum(axis=0), alone[..., :3].sum(axis=0), 1e-9, np.abs(sums[..., :3]).sum(axis=0) + 1e-12)


SAMPLES = np.random.default_rng(7).gamma(6.0, size=4000)
HEIGHTS = {"exponential": {}, "weibull": {"exponent": 2.5}, "empirical": {"samples": SAMPLES}}


@pytest.mark.parametrize("key", HEIGHTS)
@pytest.mark.parametrize("asperity", ASPERITIES, ids=lambda law: law.key)
def test_any_asperity_law_with_any_heights(asperity, key):
    """Load and area against trapezoidal sums over the displacement, which know nothing of knots, windows and nodes."""
    given, heights = draw(6, False, 103, theta=100.0, lam=10.0), height_distribution(key, **HEIGHTS[key])
    fill_density = _densities(heights.density)
    h = np.linspace(-1.5, 1.5, 6)
    found = scattered(problem_of(given, Choice(PLAIN, asperity.key)).regimes, h, heights).sum(axis=0)
    expected = np.zeros((6, 2))
    for segment in asperity.segments(given, **resolve_options([asperity], {})):
        for i in range(6):
            end = coordinates(replace(segment, edges=segment.edges[:, [0, -1]]), 20.0)[i]  # no height is farther than that
            u = np.linspace(segment.edges[i, 0], max(end, segment.edges[i, 0]), 8001)
            one = replace(segment, parameters=tuple(np.broadcast_to(p, 6)[i] * np.ones(u.size) for p in segment.parameters),
                          edges=np.zeros((u.size, 2)))  # fmt: skip
            w, slope, load, area = normal_states(one, u).T
            dense = np.empty(w.size)
            fill_density(h[i] + w, heights.shape, dense)
            expected[i] += np.trapezoid(load * slope * dense, u), np.trapezoid(area * slope * dense, u)
    size = np.abs(expected) + 1e-3
    assert_near(found[:, 1:3], expected, 3e-4, size)


@pytest.mark.parametrize("film", FILMS, ids=lambda film: film.key)
@pytest.mark.parametrize("asperity", ASPERITIES, ids=lambda law: law.key)
def test_any_film_with_any_asperity_law(film, asperity):
    """The same for films, which then carry a load and, with a shear strength of the interface, friction."""
    if not film.interchangeable:
        pytest.skip("belongs to one variant of one model")
    given = draw(40, True, 97)
    choice = Choice(PLAIN, asperity.key, OF_THE_INTERFACE, film.key)
    if incompatibility(film, asperity):
        with refusal("asperity", film.key):
            problem_of(given, choice)
        return
    if film.tangential not in ("", "interface"):
        with refusal("tangential", film.key):
            problem_of(given, choice)
        return
    regimes = problem_of(given, choice).regimes
    sums = scattered(regimes, np.linspace(-2.0, 3.0, 40), gaussian())
    total = sums.sum(axis=0)
    assert np.isfinite(sums).all() and (sums[..., [0, 2, 3, 4]] >= -1e-25).all() and total[:, 3:].max() > 0.0
    expected = given.eta * given.shear_strength * total[:, 2]  # a constant shear strength times the outer area
    if film.bares_substrate:  # what is bared shears at Y/sqrt(3) in place of that
        bared = sums[[regime.body == "substrate" for regime in regimes], :, 2].sum(axis=0)
        expected += given.eta * (1.0 / (np.sqrt(3.0) * given.hardness_to_yield) - given.shear_strength) * bared
    assert_near(total[:, 3:].sum(axis=1), expected, 1e-9, expected + 1e-12)


AS_ONE = [film for film in FILMS if film.solved_as_one]


def pairs_on_a_film():
    """Every pair, but for the laws of the interface after the first: of a contact they see only load and area, as the first
    does, so that one asperity law is enough for each. Their kernels are the slowest to compile."""
    for asperity, tangential in itertools.product(ASPERITIES, TANGENTIALS):
        if not tangential.interfacial or tangential.key == OF_THE_INTERFACE or asperity is ASPERITIES[0]:
            yield pytest.param(asperity, tangential, id=f"{asperity.key}-{tangential.key}")


@pytest.mark.parametrize("film", AS_ONE, ids=lambda film: film.key)
@pytest.mark.parametrize(("asperity", "tangential"), list(pairs_on_a_film()))
def test_films_solved_as_one_with_any_asperity_and_tangential_law(film, asperity, tangential):
    """Summed, on load and area of the contact alone, if the records say that all three suit each other; if not, refused with
    the reason, and with the law to take where there is one, which is then taken.

    A film is solved for each contact, which takes up to a second."""
    given = draw(8, True, 97)
    choice = Choice(PLAIN, asperity.key, tangential.key, film.key)
    if incompatibility(film, asperity) or incompatibility(tangential, asperity):
        with refusal("asperity"):
            problem_of(given, choice)
        return
    if friction_incompatibility(film, tangential):
        assert tangential.of_half_space
        with pytest.raises(InputError) as caught:
            problem_of(given, choice)
        assert tangential.of_half_space in str(caught.value) and tangential.like in str(caught.value)
        if tangential.like:
            instead = find(tangential.like, TangentialLaw)
            assert not friction_incompatibility(film, instead) and not incompatibility(instead, asperity)
        return
    sums = scattered(problem_of(given, choice).regimes, np.linspace(-2.0, 3.0, 8), gaussian())
    assert np.isfinite(sums).all() and (sums[..., [0, 2, 3, 4]] >= -1e-25).all() and sums[..., 3:].max() > 0.0
    alone = scattered(problem_of(given, replace(choice, tangential="none")).regimes, np.linspace(-2.0, 3.0, 8), gaussian())
    size = np.abs(sums[..., :3]).sum(axis=0) + 1e-12
    assert_near(sums[..., :3].sum(axis=0), alone[..., :3].sum(axis=0), 1e-6, size)


PAPER = find("roy_chowdhury_ghosh_1994", AsperityLaw)
LIKE_A_BODY = [film for film in FILMS if film.tangential != "interface" and not incompatibility(film, PAPER)]


@pytest.mark.parametrize("film", LIKE_A_BODY, ids=lambda film: film.key)
def test_a_thick_film_hides_its_substrate(film):
    """tau -> inf (theory 7): loads and resistances are n_E times those of a surface that is film all through, in the film's
    own groups; the area is the same."""
    if not film.interchangeable:
        pytest.skip("belongs to one variant: adds film loads without n_E and keeps the substrate's plastic term (D4, D5)")
    # A graded film tends to this as w/t and a/t: 1e14 makes that rounding.
    given = draw(200, True, 67, tau=1e14, film_aspect=1e14)
    own_groups = given.with_changes(theta=given.film().theta, lam=given.film().lam, n_E=np.ones(200), n_H=np.ones(200))
    h = np.linspace(-3.0, 4.0, 15)
    found, expected = (problem_of(one, film_choice(film)).on_grid(h) for one in (given, own_groups))
    n_E = given.n_E[:, None]
    size = load_size(expected["load"], expected["contact_area"], own_groups.theta[:, None])
    assert_near(found["load"], n_E * expected["load"], 1e-9, n_E * size, "load")
    assert_near(found["contact_area"], expected["contact_area"], 1e-9, what="area")
    assert_near(found["friction_force"], n_E * expected["friction_force"], 1e-9, what="resistance")


@pytest.mark.parametrize("record", CLOSED, ids=lambda record: record.key)
def test_theories_in_closed_form(record):
    """Load (where the record says so) and area that grow together, from nothing; a shear strength of the interface times the
    area is their friction."""
    low, high = next(((one.low, one.high) for one in record.validity if one.quantity == "roughness_parameter"), (0.0, np.inf))
    densities = np.geomspace(max(0.02, 1.01 * low), min(0.3, high), 30)
    sticks = any(one.quantity == "elastic_over_adhesion" for one in record.validity)
    given = draw(30, record.on_film, 101, theta=0.1 if sticks else 1e6, roughness_parameter=densities)
    choice = Choice(record.key, tangential=OF_THE_INTERFACE)
    problem = problem_of(given, choice)
    if record.curve is None:
        results = problem.at_load(np.tile(np.geomspace(1e-6, 10.0, 40), (30, 1)))
    else:
        results = problem.on_grid(np.linspace(4.0, -1.0, 40))
        pairs = problem.loads(np.array([1.0, 0.0, 2.0]), np.array([3, 0, 3]))
        single = problem.at(np.tile([0.0, 1.0, 2.0], (30, 1)))["load"]
        np.testing.assert_allclose(pairs, [single[3, 1], single[0, 0], single[3, 2]], rtol=1e-9)
    load, area = results["load"], results["contact_area"]
    assert np.isfinite(load).all() and (load > 0.0).all()
    assert not record.load_is_monotonic or (np.diff(load, axis=1) > 0.0).all()
    assert (area > 0.0).all() and (np.diff(area, axis=1) >= 0.0).all()
    expected = given.eta[:, None] * given.shear_strength[:, None] * area
    np.testing.assert_allclose(results["friction_force"], expected, rtol=1e-12)
    with pytest.raises(InputError):
        problem_of(given, Choice(record.key, tangential="savkoor_briggs_1977"))
    with pytest.raises(InputError):
        problem_of(draw(3, not record.on_film, 5), choice)


@each_record
def test_record_is_complete(record):
    assert type(record) in kinds()
    assert re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", record.key)
    for what in ("segments", "tangential_resistance", "curve", "area_at_load", "value", "find"):
        if (one := getattr(record, what, None)) is not None:
            module = getattr(one, "py_func", one).__module__
            assert module.rsplit(".", 1)[-1] == record.key, "one file per model, of the model's name"
    assert record.grade in GRADES
    assert record.title and not record.title.endswith(".") and "\n" not in record.title
    assert len(record.verified) > 10
    if record.grade == "C":
        assert any(source.note for source in record.sources), "what was reconstructed?"


@each_record
def test_record_refers_to_what_exists(record):
    assert record.sources and {source.key for source in record.sources} <= bibliography().keys()
    assert set(record.needs) <= GROUP_NAMES <= QUANTITIES.keys()
    for validity in record.validity:
        assert validity.quantity in QUANTITIES and validity.low < validity.high and len(validity.why) > 10
    for limit in record.limits:
        assert find(limit.parent, RoughSurface if record.kind == "film" else type(record)).key != record.key
        assert set(limit.groups) <= GROUP_NAMES
        assert set(limit.quantities) <= (FOUND if record.kind == "asperity method" else LIMITED)
        assert 0.0 < limit.within <= 0.05
    assert set(getattr(record, "traits", ())) | set(getattr(record, "required_traits", ())) <= TRAITS.keys()
    if record.kind == "rough surface" and record.asperity:
        asperity = find(record.asperity, AsperityLaw)
        assert record.tangential == "none" or not incompatibility(find(record.tangential, TangentialLaw), asperity)
        assert not record.default_film or find(record.default_film, FilmLaw)


@each_record
def test_options(record):
    """The first value is the default; what is not listed is refused by name."""
    defaults = {name: values[0] for name, values in record.options.items()}
    assert resolve_options([record], {}) == defaults == select_options(record, defaults)
    assert resolve_options([record], dict.fromkeys(record.options)) == resolve_options([record], {})
    for name, values in record.options.items():
        assert len(set(values)) == len(values) > 0
        with pytest.raises(InputError) as caught:
            resolve_options([record], {name: "no such value"})
        assert caught.value.field == name and values[0] in caught.value.allowed
    with refusal("no such option"):
        resolve_options([record], {"no such option": "x"})


def test_options_of_one_name_mean_the_same():
    """Laws that are combined may share an option, never a name for two things."""
    values = {}
    for record in records():
        for name, allowed in record.options.items():
            assert values.setdefault(name, allowed) == allowed, name


# What solves a map depends on the contact, not on its groups.
DECIDED = [(record, kind) for kind in CHOSEN for record in of_kind(kind).values() if getattr(record, "of_map", None) is None]


@pytest.mark.parametrize(("record", "kind"), [pytest.param(*one, id=f"{one[1].kind}-{one[0].key}") for one in DECIDED])
def test_a_law_depends_on_what_it_says(record, kind, force_loops):
    """Groups that `needs` of the laws at work do not name change nothing; each that the record names changes something."""
    force_loops("shared")  # answers are compared bit by bit: one tier for all
    given = draw(50, kind is FilmLaw or getattr(record, "on_film", False), 71)
    choice = choice_of(record, kind)
    if kind is FilmLaw and not record.interchangeable:
        choice = Choice(options={"variant": "published"})
    if not {"theta", "lam", "tabor_parameter"} & {name for one in problem_of(given, choice).records() for name in one.needs}:
        given = without_adhesion(given)
    found = problem_of(given, choice)

    def answer(one):
        made = replace(found, groups=one)
        if getattr(record, "area_at_load", None):
            return list(made.at_load(np.full((50, 2), 0.5)).values())
        if kind is RoughSurface and not record.asperity:
            return list(made.on_grid(np.array([0.5, 1.5])).values())
        return list(made.on_grid(np.linspace(-1.0, 2.0, 4)).values())

    plain = answer(given)
    needed = {name for one in found.records() for name in one.needs}
    for name in ("theta", "lam", "hardness_group", "nu", "hardness_to_yield", "tabor_parameter", "sharpness",
                 "roughness_parameter", "nominal_width", "shear_strength", "pressure_coefficient", "n_E", "n_H",
                 "tau"):  # fmt: skip
        if getattr(given, name) is None:
            continue
        other = answer(given.with_changes(**{name: getattr(given, name) * 0.9}))
        same = all(np.array_equal(one, two, equal_nan=True) for one, two in zip(plain, other, strict=True))
        if name in record.needs:
            assert not same, f"{name} changes nothing"
        if not same and not (name in ("theta", "lam") and "hardness_group" in needed):  # which follows from both
            assert name in needed or (kind is FilmLaw and name in FILM_GROUPS), f"{name} is not said to be needed"


def test_order_and_lookup():
    found = [record.kind for record in records()]
    assert found == sorted(found, key=[kind.kind for kind in kinds()].index)
    for kind in kinds():
        keys = [record.key for record in records() if record.kind == kind.kind]
        assert keys == sorted(keys) and len(set(keys)) == len(keys) > 0
    for kind in (*CHOSEN, Presliding):
        with pytest.raises(InputError) as caught:
            find("no_such_model", kind)
        assert caught.value.field == kind.keyword and "\n" not in str(caught.value)
    with pytest.raises(InputError):
        find(FILMS[0].key, RoughSurface)
