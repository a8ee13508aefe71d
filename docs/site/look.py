"""Opens pages of the built site in a browser, on a wide and a narrow screen, light and dark, and says what is broken.

    python docs/site/look.py                        # forty pages of build/docs/html
    python docs/site/look.py --all                  # every page
    python docs/site/look.py --out /some/folder     # and keeps what they look like

Broken is: a picture that is not there, a formula that is not set, marks of Markdown or TeX that are shown as they are written,
a page that is wider than the screen, an error of a script, and anything that is asked of a network. Two links to places in long
pages are followed, and words searched. Chromium must be installed.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Page, sync_playwright
from playwright.sync_api import TimeoutError as NotInTime

SITE = Path(__file__).resolve().parents[2] / "build" / "docs" / "html"
WIDTHS, THEMES, COUNT = (1280, 400), ("light", "dark"), 40
FIRST = (
    "index", "start", "how-to/installing", "tutorials/1-bare-metal", "tutorials/2-soft-film", "tutorials/3-micromachine",
    "tutorials/4-soft-polymer", "tutorials/5-from-a-scan", "how-to/which-thickness", "how-to/measured-disagrees",
    "how-to/which-asperity-method", "how-to/ten-million-contacts", "explanation/theory", "explanation/combining-laws",
    "explanation/numerics", "explanation/trust", "explanation/truth", "explanation/calibration", "explanation/which-film-law",
    "explanation/what-mu-rests-on", "how-to/which-model", "how-to/which-interface-strength", "how-to/which-roughness-numbers",
    "gallery/index", "speed", "reference/names/index", "reference/case-file", "reference/command-line", "reference/laws/index",
    "reference/laws/kogut_etsion_2002", "reference/glossary", "reference/symbols", "genindex",
)  # fmt: skip
PLACES = ("explanation/theory-limits.html#8-departures-from-the-print", "reference/models.html#grades")
SEARCHED = ("plasticity index", "silver", "meniscus", "scan upload AFM")
# Pictures that come only as one scrolls are not asked for; what MathJax has not set stays in its delimiters.
_BROKEN = r"""() => ({
  pictures: [...document.images].filter(one => one.complete && !one.naturalWidth).map(one => one.src),
  formulas: [...document.querySelectorAll('mjx-merror, mjx-container mtext[mathcolor=red]')].map(one => one.textContent)
    .concat([...document.querySelectorAll('.math')].filter(one => !one.querySelector('mjx-container'))
      .map(one => one.textContent)),
  marks: (() => {
    const found = [], texts = document.createTreeWalker(document.querySelector('article'), NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const at = texts.currentNode;
      if (at.parentElement.closest('code, pre, script, style, .math, mjx-container, .sig')) continue;
      if (/\$[^$]+\$|\\(frac|sqrt|mathrm|left|tag)|\]\(|\*\*|:::|`/.test(at.textContent)) found.push(at.textContent.trim());
    }
    return found;
  })(),
  wide: [...document.querySelectorAll('html, article p, article li, article img, article .indextable, article .sig, span.math')]
    .filter(one => !one.closest('.table-wrapper, div.math, pre') && one.getBoundingClientRect().right > window.innerWidth + 1)
    .map(one => one.textContent)
    .concat(document.documentElement.scrollWidth > window.innerWidth + 1 ? [document.documentElement.scrollWidth] : []),
})"""


def pages(site: Path, whole: bool) -> list[Path]:
    """The first ones by name, and others evenly from all; or all."""
    every = sorted(path for path in site.rglob("*.html") if "_" not in path.parts[len(site.parts)][:1])
    first = [site / f"{name}.html" for name in FIRST]
    rest = [path for path in every if path not in first]
    if whole:
        return [*first, *rest]
    step = max(1, len(rest) // max(1, COUNT - len(first)))
    return [*first, *rest[::step]][:COUNT]


def broken(page: Page, path: Path, width: int, theme: str) -> Iterator[str]:
    """What is broken of a page as it is shown."""
    page.set_viewport_size({"width": width, "height": 900})
    page.emulate_media(color_scheme=theme)  # type: ignore[arg-type]
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(f"script: {error}"))
    page.on("request", lambda one: wrong.append(f"asks {one.url}") if one.url.startswith("http") else None)
    page.goto(path.as_uri(), timeout=120_000)
    page.wait_for_function("() => !window.MathJax || (MathJax.startup && MathJax.startup.promise)", timeout=120_000)
    page.evaluate("() => window.MathJax ? MathJax.startup.promise.then(() => true) : true")
    yield from wrong
    for kind, found in page.evaluate(_BROKEN).items():
        yield from (f"{kind}: {str(one)[:120]}" for one in found)


def lost(page: Page, site: Path) -> Iterator[str]:
    """Links to a place in a page that leave the reader elsewhere, and words that the search does not find."""
    for link in PLACES:
        page.goto(f"{site.as_uri()}/{link}", timeout=120_000)
        page.evaluate("() => window.MathJax ? MathJax.startup.promise.then(() => true) : true")
        page.wait_for_timeout(500)
        top = page.evaluate("() => document.getElementById(location.hash.slice(1)).getBoundingClientRect().top")
        if not -5 <= top <= 300:
            yield f"{link}: the place is {top:.0f} px below the top"
    for words in SEARCHED:
        page.goto(f"{site.as_uri()}/index.html", timeout=120_000)
        page.fill("input[name=q]", words)
        page.press("input[name=q]", "Enter")
        try:
            page.wait_for_selector("ul.search li", timeout=20_000)
        except NotInTime:
            yield f"search for {words}: nothing is found"


def main() -> int:
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--site", type=Path, default=SITE)
    words.add_argument("--all", action="store_true", help="every page")
    words.add_argument("--out", type=Path, help="folder for pictures of the pages")
    words.add_argument("--browser", default="/usr/bin/chromium")
    given = words.parse_args()
    count = 0
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=given.browser, args=["--no-sandbox"])
        for one in lost(browser.new_page(), given.site.resolve()):
            count += 1
            print(one, flush=True)
        for path in pages(given.site.resolve(), given.all):
            for width, theme in ((width, theme) for width in WIDTHS for theme in THEMES):
                page = browser.new_page()
                name = path.relative_to(given.site.resolve()).with_suffix("")
                for one in broken(page, path, width, theme):
                    count += 1
                    print(f"{name}, {width} px, {theme}: {one}", flush=True)
                if given.out:
                    given.out.mkdir(parents=True, exist_ok=True)
                    page.screenshot(path=given.out / f"{str(name).replace('/', '-')}-{width}-{theme}.png")
                page.close()
        browser.close()
    print(f"{count} things are broken")
    return bool(count)


if __name__ == "__main__":
    sys.exit(main())
