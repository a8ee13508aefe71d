"""What a wheel and an sdist have to hold, and what they must not: `python release/contents.py FOLDER` says what is wrong."""

import re
import sys
import tarfile
import zipfile
from email.parser import HeaderParser
from pathlib import Path

from shared import ROOT, project

# Data that the program reads; modules are compared with the tree below.
DATA = (
    "py.typed",
    "__init__.pyi",
    "records/sources.bib",
    "contact/material_data/elements.toml",
    "solvers/layered/curves.npz",
    "solving/accuracy/benchmark_set.npz",
    "surfaces/theory/n_point_heights.txt",
    "report/templates/report.html",
    "web/first.toml",
)
# What tests and documents need besides the package: the tests run from an unpacked sdist.
OF_SDIST = ("tests", "docs", "examples", "benchmarks", "truth", "validation", "release", "pyproject.toml", "Makefile",
            "README.md", "LICENSE", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "ARCHITECTURE.md",
            "requirements.lock")  # fmt: skip
LEFTOVERS = re.compile(r"(^|/)(__pycache__|\.venv|\.git|build|dist|demo|\.\w+_cache|\.hypothesis|\.ci)/|\.(pyc|nbi|nbc|so)$")
# Bytes that no package may hold: keys, and folders of the machine on which it was built.
SECRETS = (b"-----BEGIN " + b"PRIVATE KEY", b"-----BEGIN RSA " + b"PRIVATE KEY", b"-----BEGIN OPENSSH " + b"PRIVATE KEY")
MOST = {".whl": 2.0e6, ".gz": 5.0e6}  # bytes


def secrets_in(name: str, content: bytes) -> list[str]:
    """What a file holds that is only of this machine, or of its owner: a line each."""
    own = [str(place).encode() for place in (ROOT, Path.home()) if len(place.parts) > 2]
    return [f"in {name}: {secret.decode()}" for secret in (*SECRETS, *own) if secret in content]


def tree() -> set[str]:
    """Every file of the package, as git would have it."""
    package = ROOT / "src" / "stiction"
    return {
        path.relative_to(package.parent).as_posix()
        for path in package.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def problems_of_wheel(path: Path) -> list[str]:
    """What is wrong with a wheel, a line each."""
    with zipfile.ZipFile(path) as archive:
        names = set(archive.namelist())
        about = next(name for name in names if name.endswith(".dist-info/METADATA"))
        told = HeaderParser().parsestr(archive.read(about).decode())
        entries = archive.read(about.replace("METADATA", "entry_points.txt")).decode()
        secrets = [line for name in sorted(names) for line in secrets_in(name, archive.read(name))]
    inside = {name for name in names if ".dist-info/" not in name}
    found = [f"missing: {name}" for name in sorted(tree() | {f"stiction/{name}" for name in DATA}) if name not in inside]
    found += [f"too much: {name}" for name in sorted(inside - tree())]
    found += [f"not of a package: {name}" for name in sorted(names) if LEFTOVERS.search(name)]
    if about.replace("METADATA", "licenses/LICENSE") not in names or told["License-Expression"] != project()["license"]:
        found.append("no licence")
    if told["Version"] != project()["version"] or set(told.get_all("Provides-Extra")) != set(
        project()["optional-dependencies"]
    ):
        found.append(f"metadata of another version: {told['Version']}, {told.get_all('Provides-Extra')}")
    if "stiction = stiction.cli:main" not in entries:
        found.append("no command `stiction`")
    return found + secrets + _heavy(path)


def problems_of_sdist(path: Path) -> list[str]:
    """What is wrong with an sdist, a line each."""
    with tarfile.open(path) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        files = {member.name: archive.extractfile(member) for member in archive.getmembers() if member.isfile()}
        secrets = [line for name, file in files.items() if file is not None for line in secrets_in(name, file.read())]
    found = [f"missing: src/{name}" for name in sorted(tree()) if f"src/{name}" not in names]
    found += [f"missing: {part}" for part in OF_SDIST if not any(name == part or name.startswith(f"{part}/") for name in names)]
    found += [f"not of a package: {name}" for name in sorted(names) if LEFTOVERS.search(name)]
    return found + secrets + _heavy(path)


def _heavy(path: Path) -> list[str]:
    size = path.stat().st_size
    return [f"{size / 1e6:.1f} MB"] if size > MOST[path.suffix] else []


def main(folder: Path) -> int:
    """Say what is wrong with the two packages in a folder; how many things are."""
    (wheel,), (sdist,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
    found = [
        f"{path.name}: {problem}"
        for path, of in ((wheel, problems_of_wheel), (sdist, problems_of_sdist))
        for problem in of(path)
    ]
    print("\n".join(found) or f"{wheel.name} and {sdist.name} hold what they should")
    return len(found)


if __name__ == "__main__":
    sys.exit(min(main(Path(sys.argv[1])), 1))
