"""The page in a real browser: each tab, by keyboard, at two widths, in light and dark, nothing asked of other machines."""

import io
import json
import math
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
import zipfile
from pathlib import Path

import numpy as np
import pandas
import pytest
from typer.testing import CliRunner

import stiction as st
from cases import of_one_model
from stiction.case.text import as_toml
from stiction.cli import app
from stiction.report.html_words import letters
from stiction.report.views.comparison import groups_of
from stiction.web.address import encoded
from stiction.web.compare_tab import tables_of
from stiction.web.fields import example_cases, first_case
from stiction.web.query import Query, compared

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed: the page is not tried in a browser")
FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
]  # fmt: skip
SECOND = 1000.0  # ms
CARD_TEXT = "document.querySelector('[role=status]').innerText.replaceAll('\\u00a0', ' ')"
SILVER = example_cases()["Silver film, 200 nm, on hardened steel, with adhesion"]
TABS = ("Contact", "Compare", "Regime", "One asperity", "Surface", "Studies", "Share")


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The address of a server of its own; afterwards nothing that was uploaded is left."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    folder = tmp_path_factory.mktemp("temporary")
    environment = os.environ | {"TMPDIR": str(folder)}
    environment.pop("PYTEST_CURRENT_TEST", None)  # of which the server would think that it is a test itself
    command = [sys.executable, "-m", "stiction", "serve", "--port", str(port)]
    with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as server:
        try:
            yield _when_up(f"http://127.0.0.1:{port}", server)
        finally:
            server.terminate()
            server.wait(20)
    assert not list(folder.glob("stiction-*"))


def _when_up(address, server):
    for _ in range(600):
        try:
            with urllib.request.urlopen(address, timeout=120):
                return address
        except OSError:
            assert server.poll() is None, server.stderr.read().decode()
            time.sleep(0.2)
    raise AssertionError("the server does not answer")


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        one = play.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield one
        one.close()


@pytest.fixture(scope="module")
def context(browser):
    """One for all pages, so that what the server gives away is loaded once."""
    one = browser.new_context(viewport={"width": 1280, "height": 900}, color_scheme="light", accept_downloads=True,
                              reduced_motion="reduce")  # fmt: skip
    yield one
    one.close()


@pytest.fixture(scope="module")
def page(context, address):
    """One page for all tests that leave its case as it is."""
    yield from _pages(context, f"{address}/?s={encoded(SILVER)}", address)


@pytest.fixture
def opened(context, address):
    """The page as it is opened without a case, at the size of a small laptop."""
    for page in _pages(context, address):
        page.set_viewport_size({"width": 1280, "height": 800})
        yield page


@pytest.fixture
def of_model(context, address):
    """A page of its own, of a case that names a model."""
    yield from _pages(context, f"{address}/?s={encoded(of_one_model())}", address)


@pytest.fixture
def fresh(context, address):
    """A page of its own."""
    yield from _pages(context, f"{address}/?s={encoded(SILVER)}", address)


def _pages(context, url, address=None):
    address = address or url
    page = context.new_page()
    page.set_default_timeout(90 * SECOND)  # also where loops are compiled first
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: asked.append(f"error: {error}"))
    _open(page, url)
    yield page
    page.close()
    assert not [url for url in asked if not url.startswith((address, address.replace("http", "ws"), "data:", "blob:"))]


def _open(page, url):
    page.goto(url)
    page.locator("canvas").first.wait_for()
    _until(page, "window.socket && window.socket.connected")


def _until(page, condition, arg=None):
    """Wait for a condition, asked ten times a second: at every frame it would keep the browser busy."""
    page.wait_for_function(condition, arg=arg, polling=100)


def _card(page):
    """The first line of the summary card."""
    return page.get_by_role("status").first.inner_text().replace("\N{NO-BREAK SPACE}", " ").splitlines()[0]


def _until_changed(page, before):
    """Wait until the first line of the summary card is another one than before."""
    _until(page, f"before => !{CARD_TEXT}.startsWith(before)", arg=before)


def _number(page):
    return page.locator("header").inner_text().splitlines()[1]


def _tab(page, name):
    page.get_by_role("tab", name=name, exact=True).click()


def _give(page, upload, name, content):
    """Click the upload button and choose a file in the chooser that the browser opens."""
    with page.expect_file_chooser(timeout=5 * SECOND) as chooser:
        page.get_by_role("button", name=upload, exact=True).click()
    chooser.value.set_files({"name": name, "mimeType": "text/plain", "buffer": content})


def _predicted(**contact):
    """Mu of the silver film with these numbers, and the ends of its interval, to two digits."""
    found = st.predict(SILVER | {"contact": SILVER["contact"] | contact})
    here = found.sel(load=found.attrs["working_load"])
    return [f"{float(here[f'friction_coefficient{end}']):.2g}" for end in ("", "_low", "_high")]


# ---- the page as it is opened


# Words that are seen: texts within the window, without pictures and their legend.
WORDS = """() => { const found = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) { const range = document.createRange(), parent = walk.currentNode.parentElement;
    range.selectNodeContents(walk.currentNode); const box = range.getBoundingClientRect();
    if (box.width && box.top < innerHeight && box.bottom > 0 && !parent.closest('i, style, script, .legend')
      && parent.checkVisibility({checkOpacity: true, checkVisibilityCSS: true}))
      found.push(...walk.currentNode.data.split(/\\s+/).filter(one => one)) } return found }"""


def test_the_first_screen_has_the_answer_and_the_whole_form_in_110_words(opened, tmp_path):
    page = opened
    (tmp_path / "case.toml").write_text(as_toml(first_case()), encoding="utf-8")
    answer = json.loads(CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), "--json"]).stdout)["answer"]
    low, high = (f"{end:.2g}" for end in answer["interval"])
    said = f"μ = {answer['friction_coefficient']:.2g} {low} to {high} (90% interval) at {answer['load']:g} N"
    assert _card(page) == said
    words = page.evaluate(WORDS)
    assert 60 < len(words) <= 110 and {"Confidence", "Interface"} <= set(words), (len(words), words)
    parts = page.locator(".group")
    assert [one.splitlines()[0] for one in parts.all_inner_texts()] == FORM
    boxes = [one.bounding_box() for one in (*parts.all(), page.get_by_text("Model", exact=True))]
    assert all(box["y"] + box["height"] <= 800 for box in boxes)
    assert [box["y"] for box in boxes] == sorted(box["y"] for box in boxes)
    for name in TABS:
        _tab(page, name)
        page.get_by_role("tab", name=name, selected=True).wait_for()
        assert _card(page) == said, name
    page.get_by_text("Why", exact=True).click()
    page.get_by_text(letters(answer["regime"]), exact=True).wait_for()


def test_the_next_step_opens_its_tab_also_where_no_room_shows_it(opened):
    opened.set_viewport_size({"width": 390, "height": 844})
    opened.get_by_role("status").get_by_role("button", name="tab Studies", exact=True).click()
    tab = opened.get_by_role("tab", name="Studies", selected=True)
    tab.wait_for()
    opened.wait_for_timeout(SECOND)  # the page and the tabs are moved gradually
    box = tab.bounding_box()
    assert 0 <= box["x"] and box["x"] + box["width"] <= 390
    header = opened.locator("header").bounding_box()["height"]
    assert header <= box["y"] + 1 < 844 / 2  # below the header, with room for what the tab shows
    assert opened.get_by_role("button", name="Sensitivity", exact=True).bounding_box()["y"] < 844


FORM = ["Load", "Bodies", "Film", "Roughness", "Adhesion", "Interface"]


def test_a_film_is_switched_off_and_on_and_the_last_change_is_undone(fresh):
    page = fresh
    before, film = _card(page), page.get_by_role("switch", name="there is a film")
    thickness = "film thickness (the sum of both films if both bodies are coated) t"
    film.click()
    _until_changed(page, before)
    assert not page.get_by_label(thickness, exact=True).count()
    page.get_by_text("Hardened steel 52100 on hardened steel 52100", exact=True).wait_for()
    page.wait_for_timeout(1.5 * SECOND)
    film.click()
    _until(page, f"before => {CARD_TEXT}.startsWith(before)", arg=before)
    assert page.get_by_label(thickness, exact=True).input_value() == "200 nm"
    page.get_by_role("combobox", name="examples").click()
    page.get_by_role("option", name="PTFE on steel").click()
    page.locator("header").get_by_text("PTFE on steel", exact=True).wait_for()
    page.get_by_role("button", name="undo").click()
    _until(page, f"before => {CARD_TEXT}.startsWith(before)", arg=before)
    page.get_by_label(thickness, exact=True).wait_for()


def test_a_comparison_follows_a_knob_that_moves_while_it_runs(fresh):
    page = fresh
    before = _card(page)
    page.get_by_role("combobox", name="interface", exact=True).click()
    page.get_by_role("option", name="soft-metal film", exact=True).click()
    _until_changed(page, before)
    _tab(page, "Compare")
    page.get_by_text(re.compile(r".+, \d+ s$")).first.wait_for()
    before = _card(page)
    page.get_by_label("film thickness (the sum of both films if both bodies are coated) t", exact=True).fill("1 um")
    _until_changed(page, before)
    page.get_by_text("Inside their range of validity").wait_for(timeout=60 * SECOND)
    _until(page, "() => !document.querySelector('.old') && !document.body.classList.contains('waiting')")
    coating = SILVER["contact"]["coating"] | {"thickness": "1 um"}
    case = SILVER | {"contact": SILVER["contact"] | {"interface": "soft-metal film", "coating": coating}}
    _, found, _ = compared(Query(case), None, lambda _: iter)
    tables = [table for _, table in tables_of(found, groups_of(found))]
    bodies = page.get_by_role("tabpanel").locator("tbody").all()[: len(tables)]
    shown = [[cell.inner_text() for cell in row.locator("td").all()[:2]] for body in bodies for row in body.locator("tr").all()]
    assert shown == [row[:2] for table in tables for row in table.rows] and len(shown) > 5


def test_every_model_beside_the_others_and_its_page(page):
    _tab(page, "Compare")
    page.get_by_text("Outside their range of validity").wait_for()
    assert page.get_by_role("button", name="Chang-Etsion-Bogy 1988, layered").is_visible()
    assert not page.get_by_text(re.compile("^not applicable: ")).first.is_visible()
    page.get_by_text("Every model", exact=True).click()
    page.get_by_role("button", name="soft_coating_2015 + sequential").last.press("Enter")  # by keyboard
    page.get_by_role("dialog").get_by_text(re.compile("Source: ")).first.wait_for()
    said = page.get_by_role("dialog").inner_text()
    assert "$" not in said and "\\" not in said
    drawn = page.get_by_role("img", name="μ(h) = (∫T(w) φ(h + w) dw)/(∫P(w) φ(h + w) dw)")
    assert drawn.evaluate("one => one.naturalWidth > 20 && one.complete")
    assert "[soft_coating_2015], eqs. (1) to (15)" in said
    page.set_viewport_size({"width": 390, "height": 900})
    wide = "one => one.scrollWidth > one.clientWidth + 1 || one.getBoundingClientRect().right > window.innerWidth"
    assert not page.locator(".equations").evaluate(wide) and not page.locator(".equations img").first.evaluate(wide)
    page.set_viewport_size({"width": 1280, "height": 900})
    page.get_by_role("button", name="Close").click()
    page.get_by_role("dialog").wait_for(state="detached")


def test_one_asperity_yields_where_it_is_pressed(page):
    _tab(page, "One asperity")
    page.get_by_text(re.compile("(Yielded, first|Elastic: the largest stress)")).wait_for()
    page.get_by_text(re.compile(r"Contact radius .* load .* mean pressure .* MPa; elastic, without adhesion\.")).wait_for()


def test_studies_are_made(page):
    _tab(page, "Studies")
    page.get_by_role(
        "button", name="Design", exact=True
    ).click()  # an objective that the free number reaches, as it stands there
    page.get_by_text("Notes", exact=True).click()
    page.get_by_text(re.compile("objective: friction_coefficient next to ")).wait_for()
    assert not page.get_by_text(re.compile("^Objective missed")).count()
    page.get_by_label("target μ").fill("0.5")  # beyond what the ends of the free number give
    page.get_by_role("button", name="Design", exact=True).click()
    page.get_by_role("alert").get_by_text(
        re.compile(r"^Objective missed: friction coefficient = 0\.\d+, \d\d.* % below 0\.5\.$")
    ).wait_for()


def test_a_study_is_stopped(context, address):
    many = SILVER | {"uncertainty": {"count": 4096}}  # so many samples that the study still runs where it is stopped
    for page in _pages(context, f"{address}/?s={encoded(many)}", address):
        _tab(page, "Studies")
        page.get_by_role("button", name="Sensitivity", exact=True).click()
        page.get_by_role("button", name="Stop").click()
        page.get_by_text("stopped", exact=True).wait_for()


def test_a_measured_series_calibrates_a_number(page):
    _tab(page, "Studies")
    upload = "Upload measured series, .csv"
    _give(page, upload, "large.csv", b"0" * (2**21 + 1))
    page.get_by_text("Upload measured series, .csv: refused; allowed: one file of 2 MiB at most").wait_for()
    _give(page, upload, "wrong.csv", b"load [N],mood\n1,2\n")
    page.get_by_text("wrong.csv is stored until the page is closed").wait_for()
    page.get_by_role("button", name="Calibrate").click()
    page.get_by_text(re.compile("--data: 'mood'; allowed: ")).wait_for()
    rows = "".join(f"{load},{mu},0.003\n" for load, mu in ((0.5, 0.06), (1, 0.055), (2, 0.05), (5, 0.04), (10, 0.03)))
    _give(page, upload, "measured.csv", f"load [N],friction_coefficient,friction_coefficient_error\n{rows}".encode())
    page.get_by_text("measured.csv is stored until the page is closed").wait_for()
    page.get_by_role("button", name="Calibrate").click()
    page.get_by_text(re.compile(r"^5 values: interface strength .* to ")).wait_for()  # of the prediction, as no model is named


def test_a_lost_upload_can_be_tried_again(page):
    _tab(page, "Studies")
    upload, sent = "Upload measured series, .csv", re.compile("/upload/")
    page.route(sent, lambda route: route.abort())
    _give(page, upload, "lost.csv", b"load [N],friction_coefficient\n1,0.05\n")
    page.get_by_text(f"{upload}: the file did not arrive; try again").wait_for()
    page.unroute(sent)
    _give(page, upload, "found.csv", b"load [N],friction_coefficient\n1,0.05\n")
    page.get_by_text("found.csv is stored until the page is closed").wait_for()


def test_what_is_downloaded_runs_to_the_same_numbers(page, tmp_path, no_pictures):
    _tab(page, "Share")
    files = {}
    for name in ("case.toml", "curve.csv", "curve.svg"):
        with page.expect_download() as waiting:
            page.get_by_role("button", name=f"download {name}").click()
        waiting.value.save_as(tmp_path / name)
        files[name] = (tmp_path / name).read_text(encoding="utf-8")
    ran = CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out")])
    assert ran.exit_code == 0, ran.output
    tables = [pandas.read_csv(path, comment="#") for path in (tmp_path / "curve.csv", tmp_path / "out" / "curve.csv")]
    pandas.testing.assert_frame_equal(*tables, rtol=1e-13)
    assert "<svg" in files["curve.svg"]


def test_the_report_is_made_with_progress_and_a_stop_and_prints_on_its_paper(page, browser, tmp_path):
    _tab(page, "Share")
    make = page.get_by_role("button", name="Make the report")
    make.click()
    page.get_by_text(re.compile(r"(Asking the models|Drawing|waiting for its turn).*, \d+ s")).wait_for()
    page.get_by_role("button", name="Stop").click()
    page.get_by_text("stopped", exact=True).last.wait_for()
    with page.expect_download(timeout=120 * SECOND) as waiting:  # a busy machine takes its time
        make.click()
    page.get_by_text("report.html is downloaded").wait_for(timeout=120 * SECOND)
    waiting.value.save_as(tmp_path / "report.html")
    _prints_well(browser, tmp_path / "report.html")


PAPER = 680, 1000  # pixels, of the inside of a page of A4 with the margins of the report
OFF = """([width, height]) => [...document.querySelectorAll('body *')].filter(one => { const box = one.getBoundingClientRect();
  return box.right > width + 1 || one.matches('figure') && box.height > height || one.matches('figure, tr')
    && getComputedStyle(one).breakInside !== 'avoid' }).map(one => one.outerHTML.slice(0, 120))"""


# Words and numbers of tables that stand on two lines; a key may be broken after an underscore.
BROKEN = """() => { const found = [];
  for (const cell of document.querySelectorAll('th, td')) {
    const walk = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode())
      for (const word of node.data.matchAll(/[^\\s_\\-\u2013\\/]+/g)) {
        const range = document.createRange();
        range.setStart(node, word.index); range.setEnd(node, word.index + word[0].length);
        if (new Set([...range.getClientRects()].map(one => Math.round(one.top))).size > 1) found.push(word[0]); } }
  return found }"""


def _prints_well(browser, report):
    """Nothing is off the paper, no word of a table is broken, and no picture or row is cut in two: each is less than a page
    and kept together."""
    context = browser.new_context(viewport={"width": PAPER[0], "height": PAPER[1]})
    page = context.new_page()
    page.goto(report.as_uri())
    page.emulate_media(media="print")
    assert page.locator("figure").count() >= 2
    assert page.evaluate(OFF, PAPER) == [] and page.evaluate(BROKEN) == []
    context.close()


def _bomb():
    """An archive that would unpack to a hundred times its size, and more."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("heights.npy", bytes(10**8))
    return made.getvalue()


HEAD = b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (100000, 100000), }" + b" " * 40
BAD = {
    "head.npy": HEAD, "cut.npy": b"\x93NUM", "bomb.npz": _bomb(), "words.txt": b"no heights here\n" * 9,
    "../../etc/passwd": b"root", "nothing.csv": b"", "<img src=x onerror='window.broken=1'>.npy": b"\x93NUMPY",
}  # fmt: skip


def test_a_bad_scan_is_refused_in_a_sentence(page):
    _tab(page, "Surface")
    for name, content in BAD.items():
        _give(page, "Upload a scan", name, content)
        # Each by its name: what was said of the file before still stands there.
        refusal = page.get_by_role("status").filter(has_text=Path(name).name).filter(has_text="; allowed: ")
        refusal.first.wait_for()
        assert "/tmp" not in page.locator("body").inner_text(), name
    plain = io.BytesIO()
    np.save(plain, np.arange(64.0).reshape(8, 8))
    _give(page, "Upload a scan", "plain.npy", plain.getvalue())
    page.get_by_text(re.compile("^unit: not given; allowed: the length unit of the numbers in the file")).wait_for()
    assert page.evaluate("window.broken") is None
    _tab(page, "Contact")
    page.get_by_text(re.compile(r"^μ = 0\.")).first.wait_for()


OF_MODEL = "at a load of"


def test_a_surface_its_asperities_and_what_its_cutoff_does_to_friction(of_model):
    page = of_model
    _tab(page, "Surface")
    page.get_by_role("button", name="Generate an example").click()
    said = page.get_by_role("tabpanel").get_by_role("status").filter(has_text=OF_MODEL)
    said.wait_for()
    before = said.inner_text()
    page.get_by_role("img", name="marked: eight-neighbour summits").wait_for()
    page.get_by_role("slider", name="shortest wave that is kept").locator("[tabindex='0']").focus()
    for _ in range(3):
        page.keyboard.press("PageDown")
    _until(page, "before => ![...document.querySelectorAll('[role=status]')].some(one => one.innerText === before)"
                           " && document.body.innerText.includes('" + OF_MODEL + "')", arg=before)  # fmt: skip
    page.get_by_label("asperities on the map").click()
    page.get_by_role("option", name="persistent summits").click()
    page.get_by_role("img", name="marked: persistent summits").wait_for()


NAMELESS = """() => [...document.querySelectorAll('input, button, [role=slider], [role=tab], [role=switch], [role=img], img')]
  .filter(one => one.offsetParent !== null && one.type !== 'file')
  .filter(one => !(one.getAttribute('aria-label') || one.innerText || one.getAttribute('alt') || one.labels && one.labels.length
    && one.labels[0].innerText || one.closest('[aria-label]') || one.title))
  .map(one => one.outerHTML.slice(0, 200))"""


# Charts and pictures that are wider than their place, or moved sideways in it.
SIDEWAYS = """() => [...document.querySelectorAll('canvas, img, [role=img]')].filter(one => one.offsetParent !== null)
  .filter(one => one.getBoundingClientRect().right > window.innerWidth || one.scrollWidth > one.clientWidth + 1
    || one.closest('.results') && one.getBoundingClientRect().width > one.closest('.results').clientWidth)
  .map(one => one.outerHTML.slice(0, 120))"""


def test_everything_that_is_used_has_a_name_and_the_page_is_as_wide_as_its_window(page):
    for name in TABS:
        _tab(page, name)
        page.get_by_role("tab", name=name, selected=True).wait_for()
        assert page.evaluate(NAMELESS) == [], name
    page.set_viewport_size({"width": 400, "height": 900})
    for scheme in ("dark", "light"):
        page.emulate_media(color_scheme=scheme)
        _until(page, f"document.body.classList.contains('body--dark') === {json.dumps(scheme == 'dark')}")
        for name in TABS:
            _tab(page, name)
            assert page.evaluate("document.documentElement.scrollWidth") <= 400, name
            assert page.evaluate(SIDEWAYS) == [], name
    page.set_viewport_size({"width": 1280, "height": 900})
    assert page.evaluate("document.documentElement.lang").startswith("en")


SERIOUS = """async () => (await axe.run({exclude: ['.q-loading-bar']}, {resultTypes: ['violations']})).violations
  .filter(one => ['serious', 'critical'].includes(one.impact))
  .map(one => one.id + ': ' + one.nodes.map(node => node.html.slice(0, 160)).join(' | '))"""


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (400, "dark")])
def test_no_serious_fault_for_who_does_not_see_or_has_no_mouse(page, width, scheme):
    """By axe-core, on every tab as the tests before have left it."""
    axe = pytest.importorskip("axe_playwright_python", reason="axe-core is not installed")
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=scheme)
    _until(page, f"document.body.classList.contains('body--dark') === {json.dumps(scheme == 'dark')}")
    page.wait_for_timeout(0.5 * SECOND)  # colours change gradually
    if page.evaluate("typeof axe") == "undefined":
        page.evaluate((Path(axe.__file__).parent / "axe.min.js").read_text(encoding="utf-8"))
    found = {}
    for name in TABS:
        _tab(page, name)
        page.get_by_role("tab", name=name, selected=True).wait_for()
        found[name] = page.evaluate(SERIOUS)
    page.set_viewport_size({"width": 1280, "height": 900})
    page.emulate_media(color_scheme="light")
    assert not any(found.values()), found


# ---- pages of which the case changes


# The page waits for tens of milliseconds only: too short to be looked at.
WAITED = """() => { const seen = changes => window.waited ||= changes.some(one => one.oldValue?.includes('waiting'));
  new MutationObserver(seen).observe(document.body, {attributeFilter: ['class'], attributeOldValue: true}) }"""


def test_an_interface_is_chosen_from_its_menu_and_what_is_old_is_said_until_the_number_is_there(fresh):
    page = fresh
    old = page.get_by_text("Computing: the numbers shown belong to the previous case.")
    page.evaluate(WAITED)
    page.get_by_role("combobox", name="interface", exact=True).click()
    page.get_by_role("option", name="soft-metal film", exact=True).click()
    number, low, high = _predicted(interface="soft-metal film")
    assert number != _predicted()[0]
    _until(page, "() => window.waited && !document.body.classList.contains('waiting')")
    assert _card(page) == f"μ = {number} {low} to {high} (90% interval) at 2.36 N" and not old.is_visible()
    page.evaluate("document.body.classList.add('waiting')")
    assert old.is_visible()


def test_a_knob_moves_by_keyboard_and_its_text_and_number_follow(of_model):
    page = of_model
    slider = page.get_by_role("slider", name="asperity tip radius R")
    slider.locator("[tabindex='0']").focus()
    for at in range(5):
        before = page.evaluate("document.querySelector('[role=status]').innerText")
        page.keyboard.press("ArrowRight")
        _until(page, "before => document.querySelector('[role=status]').innerText !== before", arg=before)
        radius = f"{10.0 ** (0.01 * round(100 * math.log10(50.0)) + 0.01 * (at + 1)):.4g} µm"  # on the steps of the slider
        _until(page, "said => document.querySelector('input[aria-label=\"asperity tip radius R\"]').value === said",
                               arg=radius)  # fmt: skip
        assert slider.get_attribute("aria-valuetext") == radius


def test_the_address_opens_the_same_page_elsewhere_and_what_is_wrong_stands_beside_its_field(of_model, browser, address):
    page = of_model
    before = page.url
    page.get_by_label("work of adhesion gamma", exact=True).first.fill("0.3 J/m^2")
    _until(page, "() => !document.querySelector('[role=status]').innerText.startsWith('μ ≈ 0.046')")
    page.wait_for_url(lambda url: url != before)
    said, url = _number(page), page.url
    page.get_by_label("asperity tip radius R", exact=True).fill("50")
    page.get_by_text("contact.roughness.asperity_radius: '50'; allowed: a number with its unit").wait_for()
    assert _number(page) == said
    _open(page, url)
    assert _number(page) == said


def test_a_free_number_is_searched_from_a_third_of_it_to_three_times_as_much(fresh):
    page = fresh
    _tab(page, "Studies")
    page.get_by_label("free number").first.click()
    page.get_by_role("option", name="thickness t, film").click()  # 200 nm
    _until(page, "() => [...document.querySelectorAll('input')].some(one => one.value === '66.67 nm')")
    assert [page.get_by_label(name, exact=True).first.input_value() for name in ("from", "to")] == ["66.67 nm", "600 nm"]


OLD = re.compile("^This result belongs to earlier numbers: press “Compare all models at this load”")


def test_a_comparison_of_earlier_numbers_says_so_until_it_is_made_again(of_model):
    page = of_model
    page.get_by_text("Why", exact=True).click()
    before = _mu_of_the_case(page)
    _tab(page, "Compare")
    page.locator("tr", has_text="soft_coating_2015 + sequential").last.wait_for(state="attached")
    assert not page.get_by_text(OLD).is_visible() and _mu_of_the_row(page) == float(f"{before:.2g}")
    page.get_by_label("work of adhesion gamma", exact=True).first.fill("0.3 J/m^2")
    grey = "(text) => document.querySelectorAll('.old').length === 1 && document.body.innerText.includes(text)"
    _until(page, grey, OLD.pattern.removeprefix("^"))  # both at once, because the new comparison may follow within a second
    page.get_by_text(OLD).wait_for(state="hidden")
    after = _mu_of_the_case(page)
    assert abs(after / before - 1.0) > 0.05 and _mu_of_the_row(page) == float(f"{after:.2g}")


def _mu_of_the_case(page):
    """The number of the named model, from what "Why" unfolds."""
    said = page.locator(".rows").first
    _until(page, "() => document.querySelector('.rows')?.textContent.includes('mu to four digits')")
    return float(re.search(r"mu to four digits ([\d.]+)", said.text_content())[1])


def _mu_of_the_row(page):
    """The number of the model of the case in the table of the tab Compare, two digits."""
    return float(page.locator("tr", has_text="soft_coating_2015 + sequential").last.locator("td").nth(1).text_content())


def test_the_place_with_a_figure_as_the_case(fresh):
    page = fresh
    _tab(page, "Regime")
    page.get_by_text(re.compile(r"The bodies: θ = 229, λ = 2\.15e\+05")).wait_for()
    page.get_by_text("Figure 1(a) of the 2015 paper, corrected variant").wait_for()
    page.get_by_role("button", name="Use as the case").click()
    _until(page, "() => document.body.innerText.includes('elastic adhesion index')")


def test_a_scan_is_the_roughness_of_the_case(of_model):
    page = of_model
    _tab(page, "Surface")
    page.get_by_role("button", name="Generate an example").click()
    page.get_by_text(re.compile("256 x 256 points")).wait_for()
    page.get_by_role("switch", name="use it in the case").click()
    page.get_by_text("measured: see the tab Surface").wait_for()
    _until(page, "() => !document.querySelector('header').innerText.includes('μ ≈ 0.046')")
    _tab(page, "Share")
    page.get_by_text(re.compile("The address does not contain .*The recipient needs these files")).wait_for()


def test_a_title_is_never_executed(fresh, address):
    title = "<img src=x onerror='window.broken=1'><script>window.broken=1</script>"
    page = fresh
    _open(page, f"{address}/?s={encoded(SILVER | {'title': title})}")
    _tab(page, "Share")
    page.get_by_text("The same numbers, to the last digit").wait_for()
    page.locator("code, pre").first.wait_for()
    assert title in page.locator("header").inner_text() and page.evaluate("window.broken") is None


# ---- callers that are no browser


def test_garbage_in_the_address_is_refused_and_the_server_lives(address):
    before = _resident(address)
    for number in range(20):
        with urllib.request.urlopen(f"{address}/?s=garbage{number}", timeout=60) as answer:
            assert b"The address was not used" in answer.read()
    assert before is None or _resident(address) - before < 100_000  # kB


def test_no_file_of_this_machine_is_served(address):
    port = int(address.rpartition(":")[2])
    up = "..%2f" * 8
    for path in ("/../../../../etc/passwd", "/_nicegui/3/static" + "/.." * 8 + "/etc/passwd", f"/{up}etc/passwd",
                 f"/_nicegui/3/static/{up}etc%2fpasswd"):  # fmt: skip
        with socket.create_connection(("127.0.0.1", port), 30) as caller:
            caller.sendall(f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n".encode())
            answer = b"".join(iter(lambda: caller.recv(65536), b""))
        assert answer.split()[1] in (b"404", b"400") and b"root:" not in answer


def test_sockets_that_are_opened_and_left_keep_nobody_out(address):
    port = int(address.rpartition(":")[2])
    lines = ["GET /_nicegui_ws/socket.io/?EIO=4&transport=websocket HTTP/1.1", f"Host: 127.0.0.1:{port}", "Upgrade: websocket",
             "Connection: Upgrade", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="]  # fmt: skip
    head = "".join(f"{line}\r\n" for line in [*lines, ""])
    before, left = _resident(address), []
    try:
        for _ in range(100):
            one = socket.create_connection(("127.0.0.1", port), 30)
            left.append(one)
            one.sendall(head.encode())
            assert one.recv(12) == b"HTTP/1.1 101"
        with urllib.request.urlopen(address, timeout=60) as answer:
            assert answer.status == 200
        assert before is None or _resident(address) - before < 50_000  # kB
    finally:
        for one in left:
            one.close()


def _resident(address):
    """Memory of the server that listens there [kB]; None where this system does not say."""
    port = f":{int(address.rpartition(':')[2]):04X}"
    try:
        lines = Path("/proc/net/tcp").read_text(encoding="utf-8").splitlines()
    except OSError:
        return None
    inode = next(line.split()[9] for line in lines[1:] if line.split()[1].endswith(port) and line.split()[3] == "0A")
    for one in Path("/proc").glob("[0-9]*/fd/*"):
        try:
            if f"socket:[{inode}]" == str(one.readlink()):
                status = (one.parents[1] / "status").read_text(encoding="utf-8")
                return int(re.search(r"VmRSS:\s+(\d+)", status)[1])
        except OSError:
            continue
    return None


def test_an_upload_that_is_too_large_is_refused(address):
    request = urllib.request.Request(f"{address}/_nicegui/client/x/upload/1", data=b"", method="POST")
    request.add_unredirected_header("Content-Length", str(2 * 2**30))
    with pytest.raises(urllib.error.HTTPError) as caught:
        urllib.request.urlopen(request, timeout=60)
    assert caught.value.code == 413 and caught.value.read().startswith(b"Refused: ")


WATCH = """() => { window.seen = []; const status = document.querySelector('[role=status]');
  new MutationObserver(() => requestAnimationFrame(() => window.seen.push(performance.now())))
    .observe(status, {subtree: true, childList: true, characterData: true});
  document.addEventListener('keydown', () => { window.began = performance.now() }, true); }"""


def test_a_single_load_has_charts_around_it_on_the_first_screen(context, address):
    finished = {"finish": "ground", "rms_height": "0.4 um"}
    steel = {"first": "hardened_steel_52100", "second": "hardened_steel_52100", "interface": "oxidised metal"}
    case = {"contact": steel | {"nominal_area": "1 cm^2", "roughness": finished}, "solve": {"load": "50 N"}}
    for page in _pages(context, f"{address}/?s={encoded(case)}", address):
        page.set_viewport_size({"width": 1280, "height": 800})
        assert _card(page).endswith("at 50 N")
        page.get_by_role("img", name=re.compile("^friction coefficient .* against normal load P")).first.wait_for()
        low = "[...document.querySelectorAll('canvas')].map(one => one.getBoundingClientRect().bottom)"
        _until(page, f"() => {{ const low = {low}; return low.length === 3 && Math.max(...low) <= 800 }}")
