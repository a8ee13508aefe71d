"""stiction.evaluate: reference values, broadcasting, bad input, and no surprise over the whole range."""

import itertools

import numpy as np
import pytest

from stiction.quantities.errors import InputError
from stiction.solving.evaluate import Evaluation, evaluate
from tables import GROUP_COLUMNS, assert_near, column, film_of, load_size, random_groups, read

KINDS = [(variant, coated) for variant in ("corrected", "published") for coated in (False, True)]
TABLES = ("paper_model.csv", "paper_model_own.csv")
# Central on the row's own separation, so that it is met to the bit.
NEIGHBOURS = 0.25 * np.arange(-6, 7)


def rows_of(table, variant, coated):
    rows = [row for row in read(table) if row["formulation"] == variant and bool(row["n_E"]) == coated]
    assert rows
    laws = {name: column(rows, title) for name, title in GROUP_COLUMNS.items()} | film_of(rows)
    return rows, column(rows, "h"), laws


def scattered(h, laws, variant):
    return evaluate(h, **laws, variant=variant)


def one_law_many_separations(h, laws, variant):
    """13 separations of each law, one call a law."""
    each = [{name: one[i] for name, one in laws.items()} for i in range(h.size)]
    tables = [evaluate(one + NEIGHBOURS, **law, variant=variant) for one, law in zip(h, each, strict=True)]
    return Evaluation(*(np.array([table[at][6] for table in tables]) for at in range(3)))


def one_grid(h, laws, variant):
    """All separations of the table with all laws of the table, in one call."""
    whole = evaluate(h[:, None], **laws, variant=variant)
    return Evaluation(*(np.diagonal(table) for table in whole))


@pytest.mark.parametrize("way", (scattered, one_law_many_separations, one_grid))
@pytest.mark.parametrize(("variant", "coated"), KINDS)
@pytest.mark.parametrize("table", TABLES)
def test_reference_values(table, variant, coated, way, always_grid):
    """160 rows of an independent table, 376 of reference (see its README): 1e-10."""
    rows, h, laws = rows_of(table, variant, coated)
    found = way(h, laws, variant)
    sizes = {"load": np.abs(column(rows, "abs_load"))} if "abs_load" in rows[0] else {}
    for name, title in (("load", "load"), ("contact_area", "area"), ("friction_force", "friction")):
        expected = column(rows, title)
        known = ~np.isnan(expected)  # the smaller table has no published area
        size = sizes.get(title, np.abs(expected))
        assert known.all() or title == "area"
        assert_near(getattr(found, name)[known], expected[known], 1e-10, size[known], f"{table} {name}")


@pytest.mark.parametrize(("table", "rows"), (("paper_model_own.csv", 376), ("paper_model.csv", 160)))
def test_tables_are_whole(table, rows):
    assert len(read(table)) == rows


# fmt: off
SHAPES = [  # shapes of h, theta, tau
    ((), (), ()), ((1,), (), ()), ((20,), (), ()), ((), (5,), ()), ((20,), (20,), ()), ((20,), (5, 1), ()),
    ((20, 1), (5,), ()), ((20,), (5, 1), (4, 1, 1)), ((4, 1, 5), (1, 3, 1), ()), ((1, 4, 1, 5), (3, 1, 1, 1), (2, 1)),
    ((4, 1, 5), (6, 1, 3, 1), (1, 3, 1)), ((20, 1), (20, 7), ()), ((20,), (7, 20), ()), ((7, 20), (7, 1), ()),
    ((20, 1), (1, 3), (1, 1)), ((1, 20), (1, 1), (4, 1)), ((5, 1), (3,), ()),
    ((0,), (), ()), ((0,), (5, 1), ()), ((20,), (0, 1), ()), ((), (0,), ()), ((20,), (5, 1), (0, 1, 1)), ((0, 1), (0,), ()),
]
# fmt: on


@pytest.mark.parametrize("shapes", SHAPES, ids=str)
@pytest.mark.parametrize("coated", (False, True))
def test_broadcasts_like_a_ufunc(shapes, coated, always_grid):
    """Any axes in any order, scalars and empty arrays; each element as if computed alone."""
    rng = np.random.default_rng(7)
    h = rng.uniform(-2.0, 4.0, shapes[0])
    laws = {"theta": 10.0 ** rng.uniform(0.0, 3.0, shapes[1]), "lam": 10.0}
    if coated:
        laws |= {"n_E": 1.5, "n_H": 0.5, "tau": rng.uniform(0.0, 5.0, shapes[2])}
    shape = np.broadcast_shapes(shapes[0], shapes[1], shapes[2] if coated else ())
    found = evaluate(h, **laws)
    separations, *spread = (np.broadcast_to(value, shape) for value in (h, *laws.values()))
    one_by_one = [
        [float(value) for value in evaluate(separations[at], **{name: one[at] for name, one in zip(laws, spread, strict=True)})]
        for at in np.ndindex(shape)
    ]
    expected = np.moveaxis(np.reshape(one_by_one, (*shape, 3)), -1, 0)
    for name, value, true in zip(Evaluation._fields, found, expected, strict=True):
        assert isinstance(value, np.ndarray) and value.shape == shape and value.dtype == np.float64
        assert_near(value, true, 1e-11, np.abs(true) + (0.1 * expected[1] if name == "load" else 0.0), name)


def test_lists_integers_and_fortran_order():
    plain = evaluate(np.array([0.0, 1.0]), 40.0, 10.0)
    for h in ([0, 1], (0.0, 1.0), np.array([0, 1]), np.array([0.0, 1.0], dtype=np.float32)):
        assert np.array_equal(evaluate(h, 40, 10), plain)
    laws = np.asfortranarray(np.full((3, 2), 40.0))
    assert np.array_equal(evaluate(np.asfortranarray([[0.0, 1.0]] * 3), laws, 10.0).load, np.tile(plain.load, (3, 1)))


@pytest.mark.parametrize(("variant", "coated"), KINDS)
def test_grid_and_scattered_agree(variant, coated):
    """The two ways of the engine, over random laws of the whole range, at every separation: the promised 1e-10."""
    laws = random_groups(np.random.default_rng(11), 1500, coated)
    h = np.linspace(-6.0, 8.0, 29)
    column_laws = {name: one[:, None] for name, one in laws.items()}
    grid = evaluate(h, **column_laws, variant=variant)
    single = evaluate(np.tile(h, (1500, 1)), **column_laws, variant=variant)
    theta = column_laws["theta"]
    film = (theta * column_laws["n_E"], column_laws["n_E"]) if coated else ()
    assert_near(grid.contact_area, single.contact_area, 1e-10)
    assert_near(grid.load, single.load, 1e-10, load_size(single.load, single.contact_area, theta, *film))
    assert_near(grid.friction_force, single.friction_force, 1e-10)


@pytest.mark.parametrize("way", ("scattered", "grid"))
@pytest.mark.parametrize(("variant", "coated"), KINDS)
def test_whole_range_is_finite(variant, coated, way):
    """Random inputs of the whole range: 1.2e6 in all the cases. Any warning is an error here."""
    rng = np.random.default_rng(13)
    if way == "scattered":
        found = evaluate(rng.uniform(-6.0, 8.0, 200_000), **random_groups(rng, 200_000, coated), variant=variant)
    else:
        laws = {name: one[:, None] for name, one in random_groups(rng, 1000, coated).items()}
        found = evaluate(rng.uniform(-6.0, 8.0, 100), **laws, variant=variant)
    assert all(np.isfinite(value).all() for value in found)
    assert (found.contact_area >= 0.0).all()
    assert (found.friction_force >= 0.0).all()
    # A film presses on and on; without one, every input that touches at all has some area.
    assert np.count_nonzero(found.contact_area) > 0.4 * found.contact_area.size


@pytest.mark.parametrize(("variant", "coated"), KINDS)
def test_corners_of_the_range(variant, coated):
    names = ("h", "theta", "lam", "nu", "hardness_to_yield", "n_E", "n_H", "tau")
    ends = ((-6, 8), (1e-3, 1e8), (1e-6, 1e8), (0, 0.499), (1.5, 4), (1e-2, 1e2), (1e-2, 1e2), (0, 1e3))
    corners = np.array(list(itertools.product(*(ends if coated else ends[:5]))), dtype=float)
    found = evaluate(**dict(zip(names, corners.T, strict=False)), variant=variant)
    assert all(np.isfinite(value).all() for value in found)
    assert (found.contact_area >= 0.0).all() and (found.friction_force >= 0.0).all()


GOOD = {"h": 1.0, "theta": 40.0, "lam": 10.0}
FILM = {"n_E": 1.5, "n_H": 0.5, "tau": 2.0}
BAD = [  # what is given, the field that is named, the value, a piece of what is allowed
    ({"theta": -1.0}, "theta", "-1", ">= 1e-12"),
    ({"theta": 0.0}, "theta", "0", ">= 1e-12"),
    ({"theta": [1.0, -3.0]}, "theta", "-3", ">= 1e-12"),
    ({"theta": np.inf}, "theta", "inf", ">= 1e-12"),
    ({"theta": "forty"}, "theta", "forty", ">= 1e-12"),
    ({"lam": np.nan}, "lam", "nan", ">= 1e-60"),
    ({"nu": 0.5}, "nu", "0.5", "< 0.5"),
    ({"nu": -0.1}, "nu", "-0.1", ">= 0"),
    ({"hardness_to_yield": 0.5}, "hardness_to_yield", "0.5", ">= 1"),
    ({"h": np.nan}, "h", "nan", "finite"),
    ({"h": [0.0, -np.inf]}, "h", "-inf", "finite"),
    ({"n_E": 1.5}, "n_H", "not given", "together"),
    ({"tau": 1.5}, "n_E", "not given", "together"),
    (FILM | {"tau": -1.0}, "tau", "-1", ">= 0"),
    (FILM | {"n_E": 0.0}, "n_E", "0", ">= 1e-12"),
    (FILM | {"n_H": -2.0}, "n_H", "-2", ">= 1e-12"),
    ({"variant": "literal"}, "variant", "literal", "corrected, published"),
    ({"h": [1.0, 2.0], "theta": [1.0, 2.0, 3.0]}, "h and groups", "(2,)", "broadcast"),
]


@pytest.mark.parametrize(("given", "field", "value", "allowed"), BAD, ids=lambda one: str(one)[:40])
def test_bad_input(given, field, value, allowed):
    """One line that names the field, its value and what is allowed."""
    with pytest.raises(InputError) as caught:
        evaluate(**GOOD | given)
    message = str(caught.value)
    assert "\n" not in message
    assert caught.value.field == field and message.startswith(f"{field}: ")
    said, allows = message.removeprefix(f"{field}: ").split("; allowed: ")
    assert value in said and allowed in allows


def test_arguments_are_not_changed():
    h, theta = np.linspace(-1.0, 1.0, 15), np.array([[1.0], [10.0]])
    kept = h.copy(), theta.copy()
    evaluate(h, theta, 10.0)
    assert np.array_equal(h, kept[0]) and np.array_equal(theta, kept[1])
