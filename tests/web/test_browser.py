"""The page in a real browser: each tab, by keyboard, at two widths, in light and dark, nothing asked of other machines."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest

from stiction.web.address import packed
from stiction.web.first import first_case

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed: the page is not tried in a browser")
FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1",
]  # fmt: skip
SECOND = 1000.0  # ms


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


@pytest.fixture
def page(browser, address):
    yield from _pages(browser, address, width=1280)


def _pages(browser, address, width, scheme="light"):
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme, accept_downloads=True)
    page = context.new_page()
    page.set_default_timeout(60 * SECOND)
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: asked.append(f"error: {error}"))
    _open(page, address)
    yield page
    context.close()
    assert not [url for url in asked if not url.startswith((address, address.replace("http", "ws"), "data:", "blob:"))]


def _open(page, url):
    page.goto(url)
    page.locator("canvas").first.wait_for()
    page.wait_for_function("window.socket && window.socket.connected")


def _status(page):
    return page.get_by_role("status").first.inner_text()


def _tab(page, name):
    page.get_by_role("tab", name=name, exact=True).click()


def test_the_first_screen_is_an_answer(page):
    assert _status(page).startswith("mu = 0.04562\nat a load of 2.36 N")
    assert page.get_by_text("Leaves out what matters here").count() == 1


def test_a_slider_moves_by_keyboard_and_the_number_with_it(page):
    before = _status(page)
    slider = page.get_by_role("slider", name="asperity tip radius R")
    slider.locator("[tabindex='0']").focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    page.wait_for_function("before => document.querySelector('[role=status]').innerText !== before", arg=before)
    radius = page.get_by_label("asperity tip radius R", exact=True)
    page.wait_for_timeout(SECOND)
    assert radius.input_value() == slider.get_attribute("aria-valuetext") == "56.23 µm"  # 10^-4.25 m, on the slider's steps


def test_the_address_opens_the_same_page_elsewhere(page, browser, address):
    page.get_by_label("work of adhesion gamma", exact=True).first.fill("0.3 J/m^2")
    page.wait_for_function("() => !document.querySelector('[role=status]').innerText.startsWith('mu = 0.04562')")
    page.wait_for_url(re.compile(r"\?s="))
    said, url = _status(page), page.url
    for other in _pages(browser, address, width=1280):
        _open(other, url)
        assert _status(other) == said


def test_what_is_wrong_stands_beside_its_field(page):
    page.get_by_label("asperity tip radius R", exact=True).fill("50")
    page.get_by_text("contact.roughness.asperity_radius: '50'; allowed: a number with its unit").wait_for()
    assert _status(page).startswith("mu = 0.04562")


def test_every_model_beside_the_others_and_its_page(page):
    _tab(page, "Compare")
    page.get_by_text(re.compile("^(Recommended|No model is recommended)")).wait_for()
    page.get_by_role("cell", name="soft_coating_2015 + sequential").click()
    page.get_by_role("dialog").get_by_text(re.compile("Source: ")).first.wait_for()
    page.get_by_role("button", name="Close").click()


def test_the_place_with_a_claim_and_a_figure_as_the_case(page):
    _tab(page, "Where am I")
    page.get_by_text(re.compile(r"The bodies: theta = 229, lambda = 1\.58e\+05")).wait_for()
    page.get_by_text("Figure 1(a) of the 2015 paper, corrected reading").wait_for()
    page.get_by_role("button", name="Open as the case").click()
    page.wait_for_function("() => document.body.innerText.includes('elastic adhesion index')")


def test_one_asperity_yields_where_it_is_pressed(page):
    _tab(page, "One asperity")
    page.get_by_text(re.compile("(It has yielded, first|Elastic: the largest stress)")).wait_for()


def test_a_surface_and_what_its_cutoff_does_to_friction(page):
    _tab(page, "Surface")
    page.get_by_role("button", name="Make an example").click()
    page.get_by_text(re.compile("256 x 256 points")).wait_for()
    page.get_by_role("switch", name="use it in the case").click()
    status = page.get_by_text(re.compile("^mu = .*at a load of"))
    status.last.wait_for()
    page.wait_for_function("() => document.querySelectorAll('img').length >= 2")
    assert "measured: see the tab Surface" in page.locator("body").inner_text()


@pytest.mark.parametrize(
    ("name", "content"),
    [
        (
            "broken.npy",
            b"\x93NUMPY\x01\x00v\x00{'descr': '<f8', 'fortran_order': False, 'shape': (100000, 100000), }" + b" " * 40,
        ),
        ("cut.npy", b"\x93NUM"),
        ("words.txt", b"no heights here\n" * 9),
        ("../../etc/passwd", b"root"),
        ("nothing.csv", b""),
    ],
)
def test_a_bad_scan_is_refused_in_a_sentence(page, name, content):
    _tab(page, "Surface")
    page.locator("input[type=file]").first.set_input_files({"name": name, "mimeType": "text/plain", "buffer": content})
    page.get_by_text("; allowed: ").first.wait_for()
    _tab(page, "Contact")
    page.get_by_text("mu = 0.04562", exact=True).wait_for()


def test_studies_are_made_and_shown(page):
    _tab(page, "Studies")
    page.get_by_role("button", name="Design", exact=True).click()
    page.get_by_text(re.compile("wished: friction_coefficient next to 0.1")).wait_for()


def test_what_is_downloaded_runs_to_the_same_numbers(page, tmp_path):
    _tab(page, "Share")
    files = {}
    for name in ("case.toml", "curve.csv", "curve.svg"):
        with page.expect_download() as waiting:
            page.get_by_role("button", name=f"download {name}").click()
        waiting.value.save_as(tmp_path / name)
        files[name] = (tmp_path / name).read_text(encoding="utf-8")
    command = [sys.executable, "-m", "stiction", "run", "case.toml", "--out", "out"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, timeout=600)
    rows = [[line for line in text.splitlines() if not line.startswith("#")]
            for text in (files["curve.csv"], (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8"))]  # fmt: skip
    assert rows[0] == rows[1] and "<svg" in files["curve.svg"]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_narrow_page_is_not_wider_than_its_window(browser, address, scheme):
    for page in _pages(browser, address, width=400, scheme=scheme):
        for name in ("Contact", "One asperity", "Studies", "Share"):
            _tab(page, name)
            page.wait_for_timeout(500)
            assert page.evaluate("document.documentElement.scrollWidth") <= 400, name
        assert page.evaluate("document.body.classList.contains('body--dark')") == (scheme == "dark")


NAMELESS = """() => [...document.querySelectorAll('input, button, [role=slider], [role=tab], [role=switch], [role=img], img')]
  .filter(one => one.offsetParent !== null && one.type !== 'file')
  .filter(one => !(one.getAttribute('aria-label') || one.innerText || one.getAttribute('alt') || one.labels && one.labels.length
    && one.labels[0].innerText || one.closest('[aria-label]') || one.title))
  .map(one => one.outerHTML.slice(0, 200))"""


@pytest.mark.parametrize("tab", ["Contact", "Where am I", "One asperity", "Surface", "Studies", "Share"])
def test_everything_that_is_used_has_a_name(page, tab):
    _tab(page, tab)
    page.wait_for_timeout(1000)
    assert page.evaluate(NAMELESS) == []
    assert page.evaluate("document.documentElement.lang").startswith("en")


def test_a_title_is_never_executed(browser, address):
    title = "<img src=x onerror='window.broken=1'><script>window.broken=1</script>"
    for page in _pages(browser, address, width=1280):
        _open(page, f"{address}/?s={packed(first_case() | {'title': title})}")
        _tab(page, "Share")
        page.wait_for_timeout(500)
        assert title in page.locator("header").inner_text() and page.evaluate("window.broken") is None


def test_garbage_in_the_address_is_refused_and_the_server_lives(address):
    before = _resident(address)
    for number in range(150):
        with urllib.request.urlopen(f"{address}/?s=garbage{number}", timeout=60) as answer:
            assert b"The address was not used" in answer.read()
    assert before is None or _resident(address) - before < 300_000  # kB


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


def test_a_knob_is_answered_at_once(page):
    """A loose bound, for machines that do other things too."""
    page.evaluate(WATCH)
    page.get_by_role("slider", name="asperity tip radius R").locator("[tabindex='0']").focus()
    times = []
    for _ in range(9):
        page.evaluate("window.seen = []")
        page.keyboard.press("ArrowRight")
        page.wait_for_function("window.seen.length > 0")
        times.append(page.evaluate("window.seen[0] - window.began"))
        page.wait_for_timeout(150)
    assert sorted(times)[len(times) // 2] < SECOND, json.dumps(times)
