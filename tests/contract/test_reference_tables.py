"""Every law against the table that is named for it, reference/KEY.csv: a new one is compared by being there.

What a table says it has, it is compared in: load and area of one asperity at the displacement `w`, the force at which one gives
way (`friction`), and sums over Gaussian heights at the separation `h`. Columns named as a group or as an option of the law are
its inputs. Tables of another shape have tests of their own.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from stiction.engine.heights import gaussian
from stiction.engine.summation import scattered
from stiction.laws.asperity import hertz, jkr
from stiction.laws.joining import Law, coordinates, normal_states
from stiction.records.registry import AsperityLaw, FilmLaw, Record, RoughSurface, TangentialLaw, find, of_kind, resolve_options
from stiction.solving.choice import Choice
from stiction.solving.problem import problem_of
from tables import REFERENCE, column, columns_of_groups, groups, load_size, read

PLAIN = "greenwood_williamson_1966"
OF_THE_INTERFACE = next(one for one in of_kind(TangentialLaw).values() if one.interfacial)
FILM = {"n_E": 1.0, "n_H": 1.0, "tau": 1.0}


def tabled(kind: type[Record], *columns: str):
    """The records of a kind whose own table has these columns."""
    known = [record for record in of_kind(kind).values() if (REFERENCE / f"{record.key}.csv").exists()]
    found = [record for record in known if set(columns) <= set(read(f"{record.key}.csv")[0])]
    assert found
    return [pytest.param(record, id=record.key) for record in found]


def parts(record, rows):
    """The rows with one choice of options each: (options, rows). A row that leaves an option empty is of no choice."""
    names = [name for name in record.options if name in rows[0]]
    for values in dict.fromkeys(tuple(row[name] for name in names) for row in rows if all(row[name] for name in names)):
        chosen = dict(zip(names, values, strict=True))
        yield resolve_options([record], chosen), [row for row in rows if all(row[name] == chosen[name] for name in names)]


@pytest.mark.parametrize("law", of_kind(AsperityLaw).values(), ids=lambda law: law.key)
def test_one_asperity(law):
    """Load and area at w, on the segment that reaches there: 1e-10. Every asperity law has a table with these columns. No
    segment is displaced less than it says."""
    compared = list(parts(law, read(f"{law.key}.csv")))
    assert compared, "no row has all the options of the law that are columns"
    for options, rows in compared:
        w, expected = column(rows, "w"), np.column_stack([column(rows, "load"), column(rows, "area")])
        found = np.full_like(expected, np.nan)
        for segment in law.segments(groups(**{"theta": np.ones(len(rows))} | columns_of_groups(rows)), **options):
            first, last = (normal_states(segment, segment.edges[:, end])[:, 0] for end in (0, -1))
            assert (first >= segment.lowest - 1e-14)[segment.edges[:, 0] < segment.edges[:, -1]].all()
            rounding = 1e-12 * np.abs(w)  # a row may be the very displacement at which a contact is lost
            here = (first <= w + rounding) & (w <= last) & (segment.edges[:, 0] < segment.edges[:, -1])
            u = np.where(np.abs(w - first) <= rounding, segment.edges[:, 0], coordinates(segment, np.maximum(w, first)))
            found[here] = normal_states(segment, u)[here, 2:]
        assert_allclose(found, expected, rtol=1e-10, err_msg=str(options))


@pytest.mark.parametrize("law", tabled(AsperityLaw, "load_sum", "area_sum"))
def test_sums_of_asperities(law):
    """Where the table has sums over Gaussian heights too."""
    for options, rows in parts(law, read(f"{law.key}.csv")):
        regimes = Law(law, options=options).regimes(groups(**columns_of_groups(rows)))
        found = scattered(regimes, column(rows, "h"), gaussian()).sum(axis=0)
        assert_allclose(found[:, 1], column(rows, "load_sum"), rtol=law.accuracy)
        assert_allclose(found[:, 2], column(rows, "area_sum"), rtol=law.accuracy)


@pytest.mark.parametrize("law", tabled(TangentialLaw, "friction"))
def test_one_sheared_asperity(law):
    """The force, all of it limited by slip or all by yield. What the table leaves out of w, load and area is Hertz's."""
    rows = read(f"{law.key}.csv")
    given = groups(**columns_of_groups(rows))
    w = column(rows, "w") if "w" in rows[0] else np.ones(len(rows))
    load = column(rows, "load") if "load" in rows[0] else w**1.5
    area = column(rows, "area") if "area" in rows[0] else w
    ends = np.full(len(rows), np.inf)
    segment = jkr.elastic(given.theta, "loading", ends) if "JKR" in law.required_traits else hertz.elastic(ends)
    tangential_resistance = law.tangential_resistance(segment, given, **resolve_options([law], {}))
    parameters = [np.broadcast_to(one, len(rows)) for one in tangential_resistance.parameters]
    found = np.array(
        [tangential_resistance.resistance(*state) for state in zip(np.sqrt(np.abs(w)), w, load, area, *parameters, strict=True)]
    )
    assert_allclose(found.sum(axis=1), column(rows, "friction"), rtol=3e-12)
    assert np.all(found.min(axis=1) == 0.0)


def compare_sums(record, choice, rows, more=None):
    """Load, area and friction of a rough surface at the separations h, for every choice of its options."""
    for options, some in parts(record, rows):
        given = groups(**(more or {}) | columns_of_groups(some))
        problem = problem_of(given, replace(choice, options={name: options[name] for name in record.options}))
        found = {name: values[:, 0] for name, values in problem.at(column(some, "h")[:, None]).items()}
        within = max(one.accuracy for one in problem.records())
        load = column(some, "load")
        size = load_size(np.abs(load), column(some, "area"), given.theta)
        assert_allclose(found["load"] / size, load / size, rtol=0, atol=within)
        assert_allclose(found["contact_area"], column(some, "area"), rtol=within)
        if "friction" in rows[0]:
            assert_allclose(found["friction_force"], column(some, "friction"), rtol=within)


@pytest.mark.parametrize("film", tabled(FilmLaw, "h", "load", "area"))
def test_films(film):
    """With the asperity law of its source, if it takes one, and a shear strength of the interface."""
    if film.tangential not in ("", "interface"):
        pytest.skip(f"brings its own friction, {film.tangential}: it has a test of its own")
    asperity = find(film.asperity or "chang_etsion_bogy_1987", AsperityLaw)
    rows = read(f"{film.key}.csv")
    choice = Choice(PLAIN, asperity.key, OF_THE_INTERFACE.key, film.key)
    compare_sums(film, choice, rows, FILM | {"shear_strength": 0.1})


@pytest.mark.parametrize("model", tabled(RoughSurface, "h", "load", "area"))
def test_rough_surfaces(model):
    compare_sums(model, Choice(model.key), read(f"{model.key}.csv"), {"theta": 1e3})


def test_a_derived_group_is_refused():
    with pytest.raises(ValueError, match=r"column eta: .* hardness_group"):
        columns_of_groups([{"w": "1.0", "eta": "2.0"}])
