"""The way to a release, walked: `make release-check` says of each step whether it holds, and then what is left to do by hand.

The version is written once, in pyproject.toml, and the tag has to be the same; it is not taken from the tag, because a clone
without tags, a shallow one and an unpacked archive would then call themselves something else, and results hold the name of the
program that made them.
"""

import re
import sys
from collections.abc import Callable
from functools import partial

from shared import DIST, PAGE, ROOT, canonical, direct, name_of, project, run

VERSION = project()["version"]
TOOLS = ROOT / "build" / "release-tools" / "bin"


def _git(*words: str) -> str:
    return run("git", *words, cwd=ROOT).stdout.rstrip()


def _clean() -> str:
    changed = _git("status", "--porcelain").splitlines()
    return f"not committed: {', '.join(line[3:] for line in changed[:5])}" if changed else ""


def _tag() -> str:
    """The tag of this version does not exist, or is here; a commit with a tag has the tag of its version."""
    at, here = _git("rev-parse", "--verify", "--quiet", f"v{VERSION}^{{commit}}"), _git("rev-parse", "HEAD")
    if at and at != here:
        return f"v{VERSION} is an older commit: raise the version in pyproject.toml"
    others = [tag for tag in _git("tag", "--points-at", "HEAD", "v*").split() if tag != f"v{VERSION}"]
    return f"this commit is {others[0]}, pyproject.toml says {VERSION}" if others else ""


def _changelog() -> str:
    """This version has a day, and stands first."""
    heads = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    good = heads and re.fullmatch(rf"\[{re.escape(VERSION)}\] - \d{{4}}-\d\d-\d\d", heads[0])
    return "" if good else f'CHANGELOG.md begins with "{heads[0]}", not with "[{VERSION}] - YEAR-MONTH-DAY"'


def _citation() -> str:
    """The schema, this version, and the day of the changelog."""
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    told = dict(re.findall(r"^(version|date-released): (.*)$", text, re.MULTILINE))
    day = re.search(rf"^## \[{re.escape(VERSION)}\] - (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    wanted = {"version": VERSION, "date-released": day[1] if day else "that of the changelog"}
    wrong = [
        f"{key}: {told.get(key)}, wanted {value}" for key, value in wanted.items() if told.get(key, "").strip("\"'") != value
    ]
    if wrong or not (TOOLS / "cffconvert").exists():
        return "; ".join(wrong) or "cffconvert is not there: make release-check brings it"
    checked = run(TOOLS / "cffconvert", "--validate", cwd=ROOT)
    return checked.stderr.strip()[-200:] if checked.returncode else ""


def _lock() -> str:
    """Everything that is asked for is pinned."""
    pinned = set(re.findall(r"^([\w.-]+)==", (ROOT / "requirements.lock").read_text(encoding="utf-8"), re.MULTILINE))
    asked = [*project()["dependencies"], *(part for parts in project()["optional-dependencies"].values() for part in parts)]
    names = {canonical(re.match(r"[\w.-]+", one)[0]) for one in asked}  # type: ignore[index]
    missing = sorted(names - {canonical(name) for name in pinned} - {"stiction"})
    return f"requirements.lock lacks {', '.join(missing)}: make lock" if missing else ""


def _versions() -> str:
    """The page tells with what tests ran: the smallest version of all that is allowed is what pyproject.toml allows."""
    page = PAGE.read_text(encoding="utf-8")
    tried = {which: _table(page, f"{which} versions") for which in ("lowest", "newest")}
    limits = {name_of(one): re.search(r">=([\d.]+)", one)[1] for one in direct()}  # type: ignore[index]
    wrong = [f"{name} {tried['lowest'].get(name, 'none')} for {least}" for name, least in limits.items()
             if not f"{tried['lowest'].get(name, '')}.".startswith(f"{least}.")]  # fmt: skip
    wrong += [f"no newest {name}" for name in limits if name not in tried["newest"]]
    return f"{PAGE.name} has {', '.join(wrong[:5])}: release/try_versions.py" if wrong else ""


def _table(page: str, name: str) -> dict[str, str]:
    """Package -> version, of a table that `shared.write_table` wrote."""
    inside = re.search(rf"<!-- {name}: begin.*?<!-- {name}: end -->", page, re.DOTALL)
    return dict(re.findall(r"^\| `([^`]+)` \| (\S+) \|$", inside[0], re.MULTILINE)) if inside else {}


def _does(*words: str) -> str:
    """A command that takes its time, with what it says where it fails."""
    print(f"  {' '.join(words)} ...", flush=True)
    done = run(*words, cwd=ROOT)
    return "" if done.returncode == 0 else f"{' '.join(words)}:\n{(done.stdout + done.stderr)[-1500:]}"


# Step -> what is wrong, "" if it holds. What takes seconds stands first.
STEPS: dict[str, Callable[[], str]] = {
    "nothing is left to commit": _clean,
    f"the tag v{VERSION} is free, or is this commit": _tag,
    f"the changelog has {VERSION} and its day": _changelog,
    f"the citation is valid and has {VERSION} and its day": _citation,
    "everything that is asked for is pinned": _lock,
    "tests ran with the smallest and the newest versions": _versions,
    "style, types and imports": partial(_does, "make", "check"),
    "wheel and sdist": partial(_does, "make", "packages"),
    "tests": partial(_does, "make", "test"),
    "the site": partial(_does, "make", "docs"),
    # Not `make try-install`, which would renew a page that is committed.
    "empty environments": partial(_does, ".venv/bin/python", "release/try_install.py", "each"),
}
BY_HAND = f"""
Left to do by hand, in this order:
  git tag -a v{VERSION} -m "stiction {VERSION}" && git push origin v{VERSION}
  build/release-tools/bin/twine upload {DIST.relative_to(ROOT)}/*
  the site in build/docs/html, the recipe in release/conda with the sum of the sdist, the image of release/Dockerfile"""


def main(asked: list[str]) -> int:
    """Every step, also after one that fails; those that run `make` only where all before hold, and with --quick not at all."""
    failed = 0
    for said, holds in STEPS.items():
        if isinstance(holds, partial) and (failed or "--quick" in asked):
            print(f"not tried  {said}")
            continue
        problem = holds()
        failed += bool(problem)
        print(f"{'NO ' if problem else 'yes'}        {said}{': ' + problem if problem else ''}", flush=True)
    if failed or "--quick" not in asked:
        print(f"\n{failed} to mend first" if failed else BY_HAND)
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
