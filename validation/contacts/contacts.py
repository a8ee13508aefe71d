"""Read the table of contacts with known friction, and make the contact of a row.

python validation/contacts/contacts.py     # print how many contacts of each class there are
"""

import csv
import tomllib
from collections import Counter
from functools import cache
from pathlib import Path

import stiction as st

HERE = Path(__file__).parent


def rows() -> list[dict[str, str]]:
    """Return the rows of contacts.csv, texts by column."""
    return _read("contacts.csv")


def sources() -> dict[str, dict[str, str]]:
    """Return the rows of sources.csv by key."""
    return {row["key"]: row for row in _read("sources.csv")}


def material_of(name: str) -> st.Material:
    """Return the material of that name in materials.toml, else the preset."""
    own = _own_materials()
    return st.Material(name=name, source="from memory", **own[name]) if name in own else st.material(name)


def contact_of(row: dict[str, str], **more) -> st.Contact:
    """Return the contact of a row, its roughness known by the finish classes; more: other fields of `Contact`.

    The interface is not part of it: see the column of that name.
    """
    film = row["film"]
    coating = st.Coating(material=material_of(film), thickness=float(row["film_thickness_m"]), bodies="first") if film else None
    return st.Contact(
        first=material_of(row["first"]),
        second=material_of(row["second"]),
        roughness={"first": {"finish": row["finish_first"]}, "second": {"finish": row["finish_second"]}},
        nominal_area=float(row["nominal_area_m2"]),
        work_of_adhesion=float(row["work_of_adhesion_J_m2"] or 0.0),
        coating=coating,
        **more,
    )


def _read(name: str) -> list[dict[str, str]]:
    with (HERE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@cache
def _own_materials() -> dict[str, dict]:
    return tomllib.loads((HERE / "materials.toml").read_text(encoding="utf-8"))["materials"]


if __name__ == "__main__":
    for kind, count in sorted(Counter(row["class"] for row in rows()).items()):
        print(f"{count:3d}  {kind}")
