"""What the scripts of this folder share: the project's own file, what is installed in an environment, the page of tables."""

import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from importlib.metadata import Distribution, distributions
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "how-to" / "installing.md"
DIST = ROOT / "build" / "dist"


def project() -> dict[str, Any]:
    """The table [project] of pyproject.toml."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def extras() -> dict[str, list[str]]:
    """What users can ask for besides: the packages of each extra."""
    return {name: parts for name, parts in project()["optional-dependencies"].items() if name not in ("docs", "dev")}


def direct() -> list[str]:
    """What stiction asks for itself, alone and with its extras."""
    asked = [*project()["dependencies"], *(part for parts in extras().values() for part in parts)]
    return [part for part in dict.fromkeys(asked) if not part.startswith("stiction[")]


def name_of(requirement: str) -> str:
    """The package that a requirement names, in the spelling in which names are compared."""
    return canonical(re.match(r"[\w.-]+", requirement)[0])  # type: ignore[index]


def canonical(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def run(*words: Any, **options: Any) -> subprocess.CompletedProcess:
    """A command, with what it prints; it may fail."""
    return subprocess.run([str(word) for word in words], text=True, capture_output=True, check=False, **options)


def must(*words: Any, **options: Any) -> str:
    """What a command prints; where it fails the script ends, with what it said."""
    done = run(*words, **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def outside() -> dict[str, str]:
    """The environment of a user's shell: nothing of it leads into this folder or its environment."""
    return {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV", "PYTHONHOME")}


def wheel() -> Path:
    """The wheel of the version that pyproject.toml names, as `make packages` built it."""
    found = sorted(DIST.glob(f"stiction-{project()['version']}-*.whl"))
    return found[0] if found else sys.exit("there is no wheel: make packages")  # type: ignore[return-value]


def installed(environment: Path) -> list[Distribution]:
    """What is installed in a virtual environment, but for what installs."""
    site = next((environment / "lib").glob("python*/site-packages"))
    return [one for one in distributions(path=[str(site)]) if canonical(one.name) not in ("pip", "setuptools", "wheel")]


def weight(one: Distribution) -> int:
    """Bytes of the files of a distribution, and of what Python compiled of them: not every installer keeps a record of that."""
    paths = {Path(str(one.locate_file(file))) for file in one.files or ()}
    for path in [path for path in paths if path.suffix == ".py"]:
        paths.update((path.parent / "__pycache__").glob(f"{path.stem}.*.pyc"))
    return sum(path.stat().st_size for path in paths if path.is_file())


def write_table(name: str, heads: Iterable[str], rows: Iterable[Iterable[Any]], said: str = "") -> None:
    """Put a table between the marks of its name on the page."""
    heads = list(heads)
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in (heads, ["---"] * len(heads), *rows)]
    text, places = re.subn(
        rf"(<!-- {name}: begin[^\n]*-->\n).*?(<!-- {name}: end -->)",
        lambda found: found[1] + (f"{said}\n\n" if said else "") + "\n".join(lines) + f"\n{found[2]}",
        PAGE.read_text(encoding="utf-8"),
        flags=re.DOTALL,
    )
    if places != 1:
        raise ValueError(f"{PAGE.name}: {places} places for the table {name!r}")
    PAGE.write_text(text, encoding="utf-8")
