"""Tables of docs/reference/interfaces.md, from the states and finishes of the package; written by docs/make_tables.py."""

from markdown_table import table

import stiction as st
from stiction.quantities.data_files import GRADES
from stiction.quantities.ranges import range_in_words
from stiction.quantities.shown import show
from stiction.quantities.table import QUANTITIES
from stiction.report.lists import grade_of, median_in_words, range_of
from stiction.surfaces.finishes import NUMBERS, finishes

_OF_A_STATE = ("strength", "pressure_coefficient")


def states() -> str:
    """Each state with its two numbers."""
    head = ("interface", "tau_0", "90 % range", "grade", "alpha", "90 % range", "grade")
    cells = (median_in_words, range_of, grade_of)
    return table(
        head, [(f"`{row['name']}`", *(say(row[key]) for key in _OF_A_STATE for say in cells)) for row in st.interfaces()]
    )


def grades() -> str:
    """What the letters mean."""
    return table(("grade", "meaning"), list(GRADES.items()))


def sources() -> str:
    """Where each number of a state comes from."""
    rows = [
        (f"`{row['name']}`", QUANTITIES[row[key]["quantity"]].symbol, row[key]["source"])
        for row in st.interfaces()
        for key in _OF_A_STATE
        if row[key] is not None
    ]
    limits = {row["name"]: row["pressure_limit"] for row in st.interfaces()}
    symbol = QUANTITIES["pressure_limit"].symbol
    rows += [(f"`{name}`", symbol, limit["source"]) for name, limit in limits.items() if limit is not None]
    return table(("interface", "number", "source"), rows)


def limits() -> str:
    """Where a state must not be used, and the pressure that it bears."""
    rows = []
    for row in st.interfaces():
        limit = row["pressure_limit"]
        bears = "" if limit is None else f"{show(limit['value'], 'pressure_limit')} ({limit['grade']})"
        rows.append((f"`{row['name']}`", row["not_for"], bears))
    return table(("interface", "not for", "pressure limit (grade)"), rows)


def weights() -> str:
    """The prior weights of a state, by pair."""
    rows = []
    for row in st.interfaces():
        film = " (a film)" if row["of_film"] else ""
        pairs = "; ".join(f"{pair}{film if not weight else ''}: {weight:g}" for pair, weight in row["pairs"].items())
        only = f" (one body of {' or '.join(row['only_with'])})" if row["only_with"] else ""
        rows.append((f"`{row['name']}`", pairs + only))
    return table(("interface", "classes of the two materials: weight"), rows)


def of_finishes() -> str:
    """Each finish with its ranges."""
    head = ("finish", "kind of surface", *(f"{QUANTITIES[name].symbol} (grade)" for name in NUMBERS))
    rows = [
        (f"`{row['name']}`", row["surface_kind"], *(_range(row["numbers"][name], name) for name in NUMBERS))
        for row in finishes()
    ]
    return table(head, rows)


def _range(number: dict, name: str) -> str:
    return f"{range_in_words(*number['range'], name)} ({number['grade']})"


def sources_of_finishes() -> str:
    """Where the numbers of finishes come from, finishes with the same words taken together."""
    found: dict[tuple[str, str], list[str]] = {}
    for row in finishes():
        for name in NUMBERS:
            found.setdefault((QUANTITIES[name].symbol, row["numbers"][name]["source"]), []).append(f"`{row['name']}`")
    rows = [
        (symbol, source, "all" if len(names) == len(finishes()) else ", ".join(names))
        for (symbol, source), names in found.items()
    ]
    return table(("number", "source", "finishes"), sorted(rows))


TABLES = {
    "states": states,
    "grades of numbers": grades,
    "sources of states": sources,
    "limits of states": limits,
    "weights of states": weights,
    "finishes": of_finishes,
    "sources of finishes": sources_of_finishes,
}
