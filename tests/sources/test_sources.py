"""The bibliography is complete and regular, and is handed out in a stable order."""

import re
from dataclasses import FrozenInstanceError
from importlib.resources import files

import pytest

from stiction.quantities.errors import InputError
from stiction.records.sources import Source, bibliography, bibtex

REQUIRED = {
    "article": {"author", "title", "journal", "year"},
    "book": {"author", "title", "publisher", "year"},
    "inproceedings": {"author", "title", "booktitle", "year"},
    "misc": {"title", "year", "note"},
}
ENTRIES = bibliography()


def parse(entry: str) -> tuple[str, str, dict[str, str]]:
    """Type, key and fields of one entry; every line between the first and the last must be a field."""
    first, *lines, last = entry.splitlines()
    kind, key = re.fullmatch(r"@(\w+)\{([\w-]+),", first).groups()
    assert last == "}"
    fields = [re.fullmatch(r"  (\w+) *= \{(.+)\},", line).groups() for line in lines]
    assert len(dict(fields)) == len(fields), "a field is given twice"
    return kind, key, dict(fields)


def balanced(text: str) -> bool:
    depth = 0
    for character in text:
        depth += {"{": 1, "}": -1}.get(character, 0)
        if depth < 0:
            return False
    return depth == 0


def test_file_holds_nothing_but_unique_entries_in_order():
    text = files("stiction.records").joinpath("sources.bib").read_text(encoding="utf-8")
    written = re.findall(r"^@\w+\{([^,\s]+),", text, re.MULTILINE)
    assert written == list(ENTRIES) == sorted(set(written))
    for entry in ENTRIES.values():
        text = text.replace(entry, "")
    assert all(line == "" or line.startswith("%") for line in text.splitlines())


@pytest.mark.parametrize("key", ENTRIES)
def test_entry(key):
    entry = ENTRIES[key]
    kind, parsed_key, fields = parse(entry)
    assert parsed_key == key
    assert balanced(entry)
    assert all(balanced(value) for value in fields.values())
    assert REQUIRED[kind] <= fields.keys()
    assert re.fullmatch(r"\d{4}", fields["year"])
    assert re.search(rf"_{fields['year']}(_|$)", key), "a key is author_year"
    assert "pages" not in fields or re.fullmatch(r"[A-Z]?\d+(--\d+)?", fields["pages"])
    assert "doi" not in fields or re.fullmatch(r"10\.\d{4,}/\S+", fields["doi"])


@pytest.mark.parametrize(
    ("key", "volume", "first_page"),
    [
        ("johnson_kendall_roberts_1971", "324", "301"),
        ("derjaguin_muller_toporov_1975", "53", "314"),
        ("savkoor_briggs_1977", "356", "103"),
        ("hamilton_1983", "197", "53"),
        ("greenwood_williamson_1966", "295", "300"),
        ("fuller_tabor_1975", "345", "327"),
        ("chang_etsion_bogy_1987", "109", "257"),
        ("chang_etsion_bogy_1988", "110", "57"),
        ("chang_etsion_bogy_1988_adhesion", "110", "50"),
        ("roy_chowdhury_ghosh_1994", "174", "9"),
        ("gao_chiu_lee_1992", "29", "2471"),
        ("bhattacharya_nix_1988", "24", "1287"),
        ("zhao_maietta_chang_2000", "122", "86"),
        ("kogut_etsion_2002", "69", "657"),
        ("hertz_1882", "92", "156"),
        ("mindlin_1949", "16", "259"),
        ("finkin_1969", "91", "551"),
        ("dayson_1971", "14", "105"),
        ("nayak_1971", "93", "398"),
        ("finkin_1973", "95", "328"),
        ("bush_gibson_thomas_1975", "35", "87"),
        ("ravindran_ramasamy_laddha_1980", "66", "249"),
        ("kato_1981", "103", "236"),
        ("halling_1982", "25", "528"),
        ("mccool_1986", "107", "37"),
        ("thornton_1991", "24", "1942"),
        ("thornton_ning_1998", "99", "154"),
        ("persson_2001", "115", "3840"),
        ("persson_2001_elastoplastic", "87", "116101"),
        ("kogut_etsion_2004", "126", "34"),
        ("jackson_green_2005", "127", "343"),
        ("greenwood_2006", "261", "191"),
        ("brizmer_kligerman_etsion_2007_junction", "129", "783"),
        ("ciavarella_greenwood_paggi_2008", "265", "729"),
        ("cohen_kligerman_etsion_2008", "130", "031401"),
        ("pastewka_robbins_2014", "111", "3298"),
        ("menga_carbone_dini_2018", "112", "145"),
    ],
)
def test_place_of_the_works_that_the_models_rest_on(key, volume, first_page):
    _, _, fields = parse(ENTRIES[key])
    assert (fields["volume"], fields["pages"].split("--")[0]) == (volume, first_page)


def test_paper_is_cited_by_title_alone():
    kind, _, fields = parse(ENTRIES["soft_coating_2015"])
    assert (kind, set(fields)) == ("misc", {"title", "year", "note"})


def test_bibtex_order_does_not_depend_on_the_request():
    keys = ["savkoor_briggs_1977", "hamilton_1983", "savkoor_briggs_1977"]
    text = bibtex(keys)
    assert text == bibtex(reversed(keys)) == bibtex(set(keys))
    assert text == ENTRIES["hamilton_1983"] + "\n\n" + ENTRIES["savkoor_briggs_1977"] + "\n"
    assert bibtex([]) == ""
    assert list(re.findall(r"^@\w+\{(.+),$", bibtex(ENTRIES), re.MULTILINE)) == list(ENTRIES)


def test_unknown_key_is_refused_in_one_line():
    with pytest.raises(InputError) as caught:
        bibtex(["hamilton_1983", "hamilton_1900"])
    assert (caught.value.field, caught.value.value) == ("source", "hamilton_1900")
    assert "hamilton_1983" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_bibliography_cannot_be_changed_by_a_caller():
    bibliography().clear()
    assert bibliography() == ENTRIES


def test_source_is_frozen_and_readable():
    source = Source("hamilton_1983", "eqs (1)-(3)", "at the trailing edge")
    assert str(source) == "hamilton_1983, eqs (1)-(3) (at the trailing edge)"
    assert str(Source("hamilton_1983", "")) == "hamilton_1983"
    with pytest.raises(FrozenInstanceError):
        source.key = "other"
