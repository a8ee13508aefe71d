"""Plug-ins, which are installed by other packages: found, or ignored in one line that names them."""

import threading
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from refusals import refusal
from stiction import cli
from stiction.case.text import as_toml
from stiction.contact.indices import Indices
from stiction.quantities.notices import Notice, notice
from stiction.records import record as record_finding
from stiction.records.registry import (
    AsperityLaw,
    AsperityMethod,
    FilmLaw,
    RoughSurface,
    TangentialLaw,
    find,
    of_kind,
    records,
    text_of,
)
from stiction.studies.comparison.compare import compare

HOW_MANY = len(records())
COATED = {"theta": 10.0, "lam": 5.0, "n_E": 0.4, "n_H": 0.3, "tau": 2.0}
CHOSEN = (RoughSurface, AsperityLaw, TangentialLaw, FilmLaw)


class Outside:
    """What an installed distribution declares: a name and something to load."""

    module = name = value = __name__

    def __init__(self, record):
        self.record = record

    def load(self):
        return self.record


@pytest.fixture(params=(*CHOSEN, AsperityMethod), ids=lambda kind: kind.kind)
def outside(request, monkeypatch):
    """A law of each kind registered from outside the package, through an entry point of the group "stiction"."""
    record = replace(next(iter(of_kind(request.param).values())), key="somebody_2031", title="A model of somebody else's")
    asked = []

    def entry_points(group):
        asked.append(group)
        return [Outside(record)]

    monkeypatch.setattr(record_finding, "entry_points", entry_points)
    record_finding._from_plug_ins.cache_clear()
    yield record
    assert asked == ["stiction"]
    monkeypatch.undo()
    record_finding._from_plug_ins.cache_clear()


def test_a_model_from_outside_appears(outside):
    assert find("somebody_2031", type(outside)) is outside
    assert len(records()) == HOW_MANY + 1


class Broken(Outside):
    """An installed distribution that cannot be imported, or declares something else than a record."""

    name, value = "theirs", "theirs.law:RECORD"

    def load(self):
        if isinstance(self.record, BaseException):
            raise self.record
        return self.record


class TheirError(BaseException):
    """What somebody else's code raises need not be an Exception."""


@pytest.mark.parametrize(
    "what",
    [
        ModuleNotFoundError("No module named\n'theirs'"),
        SystemExit(1),
        TheirError("of their own"),
        {"key": "no record"},
        replace(next(iter(of_kind(AsperityLaw).values())), key=3),
        replace(next(iter(of_kind(AsperityLaw).values())), key="../x"),
        next(iter(of_kind(AsperityLaw).values())),
    ],
    ids=["import", "exit", "base_exception", "no_record", "number_as_key", "path_as_key", "key_of_ours"],
)
def test_a_broken_plug_in_is_named_and_all_else_goes_on(monkeypatch, what):
    sound = replace(next(iter(of_kind(AsperityLaw).values())), key="somebody_2031")
    monkeypatch.setattr(record_finding, "entry_points", lambda group: [Broken(what), Outside(sound)])
    record_finding._from_plug_ins.cache_clear()
    notice.cache_clear()
    try:
        with pytest.warns(Notice, match=r"^the plug-in theirs \(theirs.law:RECORD\) is ignored: [^\n]+$") as said:
            assert len(records()) == HOW_MANY + 1
        assert find("somebody_2031", AsperityLaw) is sound and text_of(sound)
        with refusal("asperity", "theirs", "somebody_2031"):
            find("theirs", AsperityLaw)
        assert len(said) == 1
    finally:
        monkeypatch.undo()
        record_finding._from_plug_ins.cache_clear()


@pytest.fixture
def installed(monkeypatch):
    """Declare plug-ins; undone after the test."""

    def install(*entries):
        monkeypatch.setattr(record_finding, "entry_points", lambda group: list(entries))
        record_finding._from_plug_ins.cache_clear()
        notice.cache_clear()

    yield install
    monkeypatch.undo()
    record_finding._from_plug_ins.cache_clear()


def test_a_plug_in_takes_no_name_of_ours_nor_of_another_plug_in(installed):
    ours = next(iter(of_kind(AsperityLaw).values()))
    first, second = (replace(ours, key="somebody_2031", title=title) for title in ("First", "Second"))
    installed(Outside(first), Broken(second), Broken(replace(ours, title="Theirs")))
    with pytest.warns(Notice) as said:
        known = of_kind(AsperityLaw)
    assert known[ours.key] is ours and known["somebody_2031"] is first
    assert [str(one.message).partition(":RECORD) is ignored: ")[2].partition(";")[0] for one in said] == [
        "key = 'somebody_2031'",
        f"key = {ours.key!r}",
    ]


def test_a_plug_in_whose_import_does_not_end_is_named(installed, monkeypatch):
    said = threading.Event()

    class Hanging(Broken):
        def load(self):
            assert said.wait(60)  # it would go on without end
            return self.record

    monkeypatch.setattr(record_finding, "_LONG", 0.01)
    monkeypatch.setattr(record_finding, "notice", lambda text: (told.append(text), said.set()))
    told = []
    law = replace(next(iter(of_kind(AsperityLaw).values())), key="somebody_2031")
    installed(Hanging(law))
    assert find("somebody_2031", AsperityLaw) is law
    assert len(told) == 1 and told[0].startswith("the plug-in theirs (theirs.law:RECORD) is still being imported")


def test_an_interruption_of_a_hanging_plug_in_ends_the_command(installed):
    installed(Broken(KeyboardInterrupt()))
    with pytest.raises(KeyboardInterrupt):
        of_kind(AsperityLaw)


def test_a_law_of_a_plug_in_that_raises_is_named_and_all_else_is_compared(installed, tmp_path):
    """Its formulas are somebody else's: a traceback would look like a fault of this package."""

    def segments(groups, **options):
        raise ZeroDivisionError("of theirs")

    installed(Outside(replace(find("brizmer_kligerman_etsion_2006", AsperityLaw), key="somebody_2031", segments=segments)))
    compared = compare(Indices(**COATED), load=1e-3)
    (reason,) = [line for line in compared.attrs["not_applicable"].split("\n") if "somebody_2031 + sequential" in line]
    assert "ZeroDivisionError: of theirs" in reason and compared.sizes["model"] > 1
    case = tmp_path / "case.toml"
    solve = {"load": 1e-3, "model": "greenwood_williamson_1966", "film": "sequential", "asperity": "somebody_2031"}
    case.write_text(as_toml({"indices": COATED, "solve": solve}), encoding="utf-8")
    result = CliRunner().invoke(cli.app, ["run", str(case)])
    (line,) = result.stderr.splitlines()
    assert result.exit_code == 2 and "somebody_2031" in line and "ZeroDivisionError: of theirs" in line
