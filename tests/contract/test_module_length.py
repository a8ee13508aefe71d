"""No module is longer than what a reader keeps in mind."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MOST = 400


@pytest.mark.parametrize("folder", ["src", "docs", "benchmarks", "truth", "release", "mutation"])
def test_a_module_has_at_most_400_lines(folder):
    lines = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in sorted((ROOT / folder).rglob("*.py"))}
    assert lines and {str(path.relative_to(ROOT)): count for path, count in lines.items() if count > MOST} == {}


def test_files_of_tests_have_names_of_their_own():
    """Folders of tests are no packages: pytest refuses to collect two files of one name."""
    names = [path.name for path in Path(__file__).parents[1].rglob("test_*.py")]
    assert len(names) == len(set(names))
