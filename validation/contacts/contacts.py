"""Read the table of contacts with known friction, and make the contact of a row.

python validation/contacts/contacts.py     # print how many contacts of each class there are
"""

import csv
from collections import Counter
from pathlib import Path

import stiction as st

HERE = Path(__file__).parent


def rows() -> list[dict[str, str]]:
    """Return the rows of contacts.csv, texts by column."""
    return _read("contacts.csv")


def sources() -> dict[str, dict[str, str]]:
    """Return the rows of sources.csv by key."""
    return {row["key"]: row for row in _read("sources.csv")}


def contact_of(row: dict[str, str], **more) -> st.Contact:
    """Return the contact of a row, its roughness known by the finish classes; more: other fields of `Contact`.

    The interface is not part of it: see the column of that name.
    """
    film = row["film"]
    coating = st.Coating(material=st.material(film), thickness=float(row["film_thickness_m"]), bodies="first") if film else None
    return st.Contact(
        first=st.material(row["first"]),
        second=st.material(row["second"]),
        roughness={"first": {"finish": row["finish_first"]}, "second": {"finish": row["finish_second"]}},
        nominal_area=float(row["nominal_area_m2"]),
        work_of_adhesion=float(row["work_of_adhesion_J_m2"] or 0.0),
        coating=coating,
        **more,
    )


def _read(name: str) -> list[dict[str, str]]:
    with (HERE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    for kind, count in sorted(Counter(row["class"] for row in rows()).items()):
        print(f"{count:3d}  {kind}")
