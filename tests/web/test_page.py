"""The page, by users who are simulated: no browser is needed."""

import asyncio
import importlib
import math
import sys
from collections.abc import Awaitable, Callable
from contextlib import asynccontextmanager
from itertools import pairwise
from pathlib import Path

import pytest
from nicegui import ui
from nicegui.testing import User, user_simulation
from nicegui.testing.user_interaction import UserInteraction

import stiction as st
from cases import of_one_model
from stiction.quantities.shown import show
from stiction.quantities.units import to_si
from stiction.report.html_words import letters
from stiction.report.table import with_signs
from stiction.web.address import encoded
from stiction.web.fields import first_case

EXAMPLE = Path(__file__).parents[2] / "examples" / "soft_film.toml"
MAIN = Path(__file__).parent / "simulated.py"
LOAD = "normal load, adhesion included P"
# Libraries of the server warn of each other.
pytestmark = pytest.mark.filterwarnings("default")


def in_a_loop(test: Callable[[], Awaitable[None]]) -> Callable[[], None]:
    """A test that waits, as one that pytest runs."""

    def run() -> None:
        asyncio.run(test())

    run.__name__, run.__doc__ = test.__name__, test.__doc__
    return run


@asynccontextmanager
async def _page(state=""):
    ours = {name: one for name, one in sys.modules.items() if name.partition(".")[0] == "stiction"}
    try:
        async with user_simulation(main_file=MAIN) as user:
            await user.open(f"/?s={state}" if state else "/")
            yield user
    finally:  # the simulation forgets the package of the page, and tests after this one would import it a second time
        sys.modules.update(ours)


def _texts(user: User) -> list[str]:
    """The texts of all labels, with plain spaces for those at which lines do not break."""
    return [one.text.replace("\N{NO-BREAK SPACE}", " ") for one in _elements(user, ui.label)]


def _elements(user: User, kind: type) -> list:
    with user:
        return [one for one in user.current_layout.descendants() if isinstance(one, kind)]


def _labelled(user: User, kind: type, label: str):
    return next(one for one in _elements(user, kind) if one.props.get("aria-label") == label)


def _input(user: User, label: str):
    return _labelled(user, ui.input, label)


def _click(user: User, label: str) -> None:
    UserInteraction(user, {_labelled(user, ui.button, label)}, None).click()


def _open(user: User, title: str) -> None:
    """Open a folded section, whose elements exist from then on."""
    _labelled(user, ui.expansion, title).set_value(True)


async def _until(user: User, wanted) -> None:
    for _ in range(1200):  # a minute: kernels may have to be compiled
        if wanted():
            return
        await asyncio.sleep(0.05)
    raise AssertionError(_texts(user))


def _card(user: User) -> str:
    """The answer card, as HTML, with plain spaces for those at which lines do not break."""
    return _elements(user, ui.html)[0].content.replace("\N{NO-BREAK SPACE}", " ")


def _mu(user: User) -> str:
    return next(text for text in _texts(user) if text.startswith("μ "))


def _predicted(tables) -> str:
    """What the page has to say of the prediction of a case."""
    found = st.predict(tables)
    return f"μ = {float(found['friction_coefficient'].sel(load=found.attrs['working_load'])):.2g}"


@in_a_loop
async def test_the_first_screen_shows_the_prediction():
    async with _page() as user:
        _open(user, "Model")
        assert _mu(user) == _predicted(EXAMPLE) and _labelled(user, ui.select, "model").value == "recommended"
        found = st.predict(EXAMPLE)
        here = found.sel(load=found.attrs["working_load"])
        low, high = (f"{float(here[f'friction_coefficient_{end}']):.2g}" for end in ("low", "high"))
        card = _card(user)
        assert f"{low} to {high} (90% interval) at 1 N" in card and found.shares["interface"] > 0.5
        assert f"{found.shares['interface']:.0%} interface strength, 3% other</dd>" in card
        _open(user, "Why")
        assert any("\N{NO-BREAK SPACE}mN (" in one.text for one in _elements(user, ui.label))
        rows = dict(pairwise(_texts(user)))
        assert rows["state"] == letters(found.attrs["regime"])
        assert rows["next"].startswith("measure μ once and fit the case to it; ") and "narrow μ to" in rows["next"]
        assert rows["confidence"].startswith("fair (high: the interval ends within a factor of 1.5 of μ, without a warning")


@in_a_loop
async def test_an_interface_or_a_strength_is_stated():
    async with _page() as user:
        menu = _labelled(user, ui.select, "interface")
        assert menu.value == "soft-metal film" and "not stated" in menu.options and "ice" not in menu.options
        menu.set_value("not stated")
        tables = first_case()
        del tables["contact"]["interface"]
        await _until(user, lambda: _mu(user) == _predicted(tables))
        assert "state the interface" in _card(user)
        _labelled(user, ui.select, "interface").set_value("a stated strength")
        strength = "shear strength of the interface at zero pressure tau_0"
        await _until(user, lambda: any(one.props.get("aria-label") == strength for one in _elements(user, ui.input)))
        _input(user, strength).set_value("20 MPa")
        tables["contact"] |= {"interfacial_shear_strength": "20 MPa"}
        await _until(user, lambda: _mu(user) == _predicted(tables))


@in_a_loop
async def test_a_surface_is_known_by_its_finish():
    async with _page() as user:
        _labelled(user, ui.select, "the surface is stated by").set_value("finish and Sq or Ra")
        await _until(user, lambda: any(one.props.get("aria-label") == "finish" for one in _elements(user, ui.select)))
        _labelled(user, ui.select, "finish").set_value("polished")
        tables = first_case()
        tables["contact"]["roughness"] = {"finish": "polished"}
        await _until(user, lambda: _mu(user) == _predicted(tables))
        _labelled(user, ui.select, "the surface is stated by").set_value("σ, R, N")
        await _until(user, lambda: _mu(user) == _predicted(EXAMPLE))
        await _until(user, lambda: _labelled(user, ui.select, "kind").value == "polished")


@in_a_loop
async def test_a_named_model_answers_with_its_warnings_and_the_prediction_as_large_beside_it():
    async with _page(encoded(of_one_model())) as user:
        assert _mu(user) == "μ ≈ 0.046"
        _open(user, "Why")
        assert any("valid range" in text for text in _texts(user))
        predicted = _predicted({name: table for name, table in of_one_model().items() if name != "solve"} | {
            "solve": {"separation": of_one_model()["solve"]["separation"]}})  # fmt: skip
        await _until(user, lambda: predicted in _card(user))
        big = [part.partition("</span>")[0] for part in _card(user).split('line-height:1.2">')[1:]]
        assert big == ["μ ≈ 0.046", predicted] and "by soft coating 2015" in _card(user)


@in_a_loop
async def test_at_given_separations_it_is_said_that_the_load_moved():
    async with _page(encoded(of_one_model())) as user:
        _open(user, "Why")
        before = _input(user, LOAD).value
        _input(user, "asperities per nominal area N").set_value("2e10 1/m^2")
        await _until(user, lambda: any(text.startswith("The load changed from 2.36 N to ") for text in _texts(user)))
        assert _input(user, LOAD).value != before
        _input(user, LOAD).set_value("3 N")  # from then on the load is given
        await _until(user, lambda: "at a load of 3 N" in " ".join(_texts(user)))


def _point(user: User) -> UserInteraction:
    """The slider of the shown point of the curve."""
    return UserInteraction(user, {_labelled(user, ui.slider, "working load of the answer")}, None)


@in_a_loop
async def test_the_prediction_and_a_stated_load_follow_the_point_of_the_curve():
    async with _page(encoded(of_one_model())) as user:
        _open(user, "Why")
        await _until(user, lambda: "(90% interval) at 2.36 N, recommended" in _card(user))
        _point(user).trigger("update:modelValue", 5)
        await _until(user, lambda: "at a load of 2.36 N" not in " ".join(_texts(user)))
        load = show(to_si(_input(user, LOAD).value, "load"), "load", 3)
        await _until(user, lambda: f"(90% interval) at {with_signs(load)}, recommended" in _card(user))
        _input(user, LOAD).set_value("3 N")
        await _until(user, lambda: "at a load of 3 N" in " ".join(_texts(user)))


@in_a_loop
async def test_the_load_has_a_field_as_soon_as_it_is_compressive():
    tables, absent = of_one_model(), "The load is not compressive: see the points of the curve."
    tables["solve"]["separation"] = {"start": 30, "stop": 0, "count": 3}
    async with _page(encoded(tables)) as user:
        _point(user).trigger("update:modelValue", 0)
        await _until(user, lambda: "not defined" in _card(user))
        _labelled(user, ui.select, "interface").set_value("soft-metal film")  # builds the form anew
        await _until(user, lambda: absent in _texts(user))
        _point(user).trigger("update:modelValue", 2)
        await _until(user, lambda: absent not in _texts(user))
        assert _input(user, LOAD).value


@in_a_loop
async def test_a_text_that_is_no_load_stays_until_the_next_answer():
    async with _page() as user:
        field = _input(user, LOAD)
        for text, error in (("-1 N", "load: must be > 0 N"), ("abc", "load: 'abc'; allowed: any finite number in N")):
            field.set_value(text)
            await _until(user, lambda error=error: (field.error or "").startswith(error))
        _input(user, "asperity tip radius R").set_value("40 um")
        await _until(user, lambda: field.value == "1 N" and not field.error)


@in_a_loop
async def test_a_slider_follows_its_field():
    async with _page() as user:
        radius, text = "asperity tip radius R", "30000 nm"
        for label, typed, shown, place in ((radius, text, "30 µm", math.log10(30e-6)), (LOAD, "5 N", "5 N", math.log10(5.0))):
            slider, before = _labelled(user, ui.slider, f"{label}, slider"), _card(user)
            _input(user, label).set_value(typed)
            await _until(user, lambda before=before: _card(user) != before)
            assert slider.value == pytest.approx(place) and slider.props["aria-valuetext"] == shown
        assert _input(user, radius).value == text  # a slider that the program moves changes no number


@in_a_loop
async def test_examples_undo_and_reset():
    async with _page() as user:
        _input(user, "asperity tip radius R").set_value("30 um")
        await _until(user, lambda: "tip radius R" in _texts(user) and _mu(user) != "")
        _labelled(user, ui.select, "examples").set_value("Titanium nitride, 2 µm, on steel")
        await _until(user, lambda: "Titanium nitride, 2 µm, on steel" in _texts(user))
        _click(user, "undo")
        await _until(user, lambda: _input(user, "asperity tip radius R").value == "30 µm")
        _click(user, "reset")
        await _until(user, lambda: _input(user, "asperity tip radius R").value == "50 µm" and _mu(user) == _predicted(EXAMPLE))


@in_a_loop
async def test_a_knob_that_moves_changes_the_number():
    async with _page(encoded(of_one_model())) as user:
        before = _mu(user)
        _input(user, "work of adhesion gamma").set_value("0.3 J/m^2")
        await _until(user, lambda: _mu(user) != before)


@in_a_loop
async def test_a_film_that_is_switched_off_and_on_keeps_its_numbers_and_the_title_follows():
    async with _page(encoded(of_one_model())) as user:
        steel, silver = "hardened steel 52100 on hardened steel 52100", of_one_model()["title"]
        assert silver in _texts(user) and _mu(user) == "μ ≈ 0.046"
        _labelled(user, ui.switch, "there is a film").set_value(False)
        await _until(user, lambda: steel.capitalize() in _texts(user))
        assert silver not in _texts(user) and _mu(user) != "μ ≈ 0.046"
        _labelled(user, ui.switch, "there is a film").set_value(True)
        await _until(user, lambda: silver in _texts(user))
        _open(user, "properties of the film")
        assert _mu(user) == "μ ≈ 0.046" and "0.4 GPa" in [one.value for one in _elements(user, ui.input)]
        _input(user, "film thickness (the sum of both films if both bodies are coated) t").set_value("300 nm")
        await _until(user, lambda: f"Silver film, 300 nm, {steel}" in _texts(user))


@in_a_loop
async def test_what_is_wrong_is_said_beside_its_field_and_the_last_answer_stays():
    async with _page(encoded(of_one_model())) as user:
        before, field = _mu(user), _input(user, "asperity tip radius R")
        field.set_value("50")
        await _until(user, lambda: field.error)
        assert field.error.startswith("contact.roughness.asperity_radius: '50'; allowed: a number with its unit")
        assert _mu(user) == before and "This is the last answer without an error: see the field in red." in _texts(user)
        field.set_value("40 um")
        await _until(user, lambda: not field.error and _mu(user) != before)


@in_a_loop
async def test_sections_are_open_if_they_have_stated_numbers_and_are_built_once():
    tables = first_case()
    tables["contact"]["second"] = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "7 GPa"}
    tables["contact"]["hardness_to_yield"] = 3.0
    async with _page(encoded(tables)) as user:
        assert _input(user, "hardness over yield stress (H/Y) k").value == "3.0"
        assert _input(user, "Young's modulus E").value == "210 GPa"  # only the second body has its own numbers
        counts = []
        for is_open in (True, False, True):
            for section in ("More", "properties of the first body"):
                _labelled(user, ui.expansion, section).set_value(is_open)
            counts.append(len(_elements(user, ui.input)))
        assert len(set(counts)) == 1


@in_a_loop
async def test_an_error_moves_to_its_field_when_the_section_of_the_field_opens():
    async with _page() as user:
        section, ratio = "properties of the first body", "Poisson's ratio nu"
        _open(user, section)
        _input(user, ratio).set_value("7")
        await _until(user, lambda: _input(user, ratio).error)
        _labelled(user, ui.select, "interface").set_value("not stated")  # builds the form anew, with closed sections
        await _until(user, lambda: not any(one.props.get("aria-label") == ratio for one in _elements(user, ui.input)))
        above = next(one for one in _elements(user, ui.label) if one.text.startswith("contact.first.poissons_ratio: 7.0"))
        assert above.visible
        _open(user, section)
        await _until(user, lambda: not above.visible)
        assert _input(user, ratio).error == "contact.first.poissons_ratio: 7.0; allowed: >= 0 and < 0.5" and not above.visible


@in_a_loop
async def test_the_address_holds_the_case():
    tables = of_one_model()
    tables["contact"]["work_of_adhesion"] = "0.3 J/m^2"
    async with _page(encoded(tables)) as user:
        assert _input(user, "work of adhesion gamma").value == "0.3 J/m²" and _mu(user) != "μ ≈ 0.046"


@in_a_loop
async def test_an_address_that_holds_nothing_is_told_and_the_first_case_shown():
    async with _page("garbage") as user:
        assert _mu(user) == _predicted(EXAMPLE)
        assert any(text.startswith("The address was not used: address: 'garbage'") for text in _texts(user))


@in_a_loop
async def test_an_address_cannot_ask_for_a_file():
    tables = first_case()
    tables["contact"]["roughness"] = {"first": {"file": "/etc/passwd"}}
    async with _page(encoded(tables)) as user:
        assert any("The address was not used: file: '/etc/passwd'" in text for text in _texts(user)), _texts(user)[:6]


@in_a_loop
async def test_a_title_is_text():
    tables = first_case() | {"title": "<script>window.broken = 1</script>"}
    async with _page(encoded(tables)) as user:
        assert tables["title"] in _texts(user)  # of a label, which a browser writes as text


@in_a_loop
async def test_the_number_on_the_page_is_that_of_a_closed_form():
    """Persson (2001): mu = tau_0 A_n erf(sqrt(2) p/(E* h'))/P, of the summits h'^2 = sqrt(3)/(64 N R^2)."""
    body = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "7.3 GPa"}
    rough = {"asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2"}
    contact = {
        "first": body,
        "second": body,
        "nominal_area": "1 mm^2",
        "interfacial_shear_strength": "200 MPa",
        "roughness": rough,
    }
    slope = math.sqrt(math.sqrt(3.0) / (64.0 * 1.7e10 * 50e-6**2))
    area = 1e-6 * math.erf(math.sqrt(2.0) * 2.0 / 1e-6 / (210e9 / (2.0 * (1.0 - 0.3**2)) * slope))
    async with _page(encoded({"contact": contact, "solve": {"load": "2 N", "model": "persson_2001"}})) as user:
        _open(user, "Why")
        where = next(text for text in _texts(user) if text.startswith("at a load of"))
        assert where.startswith(f"at a load of 2 N, real contact area {area * 1e12:.4g} µm²")
        assert where.endswith(f"mu to four digits {200e6 * area / 2.0:.4g}")


@in_a_loop
async def test_a_slider_that_moves_faster_than_the_answers_ends_at_its_last_load():
    """Each event scales the range of loads from the load before it, not from that of the last answer."""
    async with _page() as user:
        slider = UserInteraction(user, {_labelled(user, ui.slider, f"{LOAD}, slider")}, None)
        for load in (2.0, 4.0, 3.0, 3.0):
            slider.trigger("update:modelValue", math.log10(load))
        await _until(user, lambda: "at 3 N" in _card(user))
        assert _input(user, LOAD).value == "3 N"
        tables = first_case()
        tables["solve"]["load"] |= {"start": "0.3 N", "stop": "30 N"}
        assert _mu(user) == _predicted(tables)


@in_a_loop
async def test_no_field_shows_python():
    tables = first_case()
    tables["contact"]["work_of_adhesion"] = {"median": "1 J/m^2", "factor": 3}
    tables["uncertainty"] = {"count": 64}
    tables["solve"] = {"separation": [2, 0.5]}
    async with _page(encoded(tables)) as user:
        assert _input(user, "work of adhesion gamma").value == "1 J/m² within a factor 3"
        _open(user, "Model")
        _open(user, "Points of the curve")
        assert "separation: [2, 0.5]" in _texts(user)
        assert _labelled(user, ui.slider, "work of adhesion gamma, slider").value == 0.0  # of the median, 10^0 J/m^2
        _input(user, "work of adhesion gamma").set_value("1 J/m^2 within a factor 1.5")
        await asyncio.sleep(1.0)
        assert not _input(user, "work of adhesion gamma").error


@in_a_loop
async def test_dimensionless_groups_and_several_numbers_have_a_page():
    groups = {"theta": 40, "lam": 10, "n_E": [0.5, 1.5], "n_H": 0.5, "tau": 2}
    for points in {"separation": [2, 1, 0]}, {"load": [0.01, 0.1]}:
        async with _page(encoded({"indices": groups, "solve": points})) as user:
            _open(user, "Why")
            assert "The curves show the first value of each array: n_E." in _texts(user)
            assert _input(user, "elastic adhesion index K sigma^(3/2) / (gamma R^(1/2)) theta").value == "40"


def test_a_simulated_page_leaves_the_package_as_it_was():
    before = sys.modules["stiction"], importlib.import_module("stiction.web.server")

    async def visit() -> None:
        async with _page():
            pass

    asyncio.run(visit())
    assert (sys.modules["stiction"], sys.modules["stiction.web.server"]) == before


@in_a_loop
async def test_what_one_visitor_does_no_other_sees():
    import httpx
    from nicegui import core

    state = encoded(of_one_model())
    async with _page(state) as one:
        other = User(httpx.AsyncClient(transport=httpx.ASGITransport(core.app), base_url="http://test"))
        await other.open(f"/?s={state}")
        before = _mu(one)
        _input(other, "work of adhesion gamma").set_value("0.1 J/m^2")
        await _until(other, lambda: _mu(other) != before)
        assert _mu(one) == before and _input(one, "work of adhesion gamma").value == "1 J/m²"
