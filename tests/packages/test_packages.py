"""What is given away: wheel and sdist hold what they should, and the wheel with what it asks for alone solves a case."""

import ast
import importlib.util
import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib.metadata import distribution, packages_distributions
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def script(name):
    """A script of release/, as a module; those beside it are found."""
    sys.path.insert(0, str(ROOT / "release"))
    try:
        spec = importlib.util.spec_from_file_location(name, ROOT / "release" / f"{name}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    finally:
        sys.path.remove(str(ROOT / "release"))


contents = script("contents")
licences = script("licences")
shared = sys.modules["shared"]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A folder with wheel and sdist, built from this tree without a network."""
    folder = tmp_path_factory.mktemp("dist")
    subprocess.run([sys.executable, "-m", "hatchling", "build", "-d", str(folder)], cwd=ROOT, check=True, capture_output=True)
    return folder


def test_packages_hold_what_they_should(built, capsys):
    assert contents.main(built) == 0, capsys.readouterr().out


def test_a_folder_of_this_machine_or_a_key_in_a_package_is_seen():
    assert contents.secrets_in("a.py", b"nothing") == []
    assert contents.secrets_in("a.py", b"x = '" + str(ROOT / "src").encode()) == [f"in a.py: {ROOT}"]
    assert len(contents.secrets_in("key", contents.SECRETS[1])) == 1


def test_every_dependency_states_a_licence_that_is_not_the_gpl():
    found = licences.needed("stiction", frozenset({"all"}), {})
    assert {"stiction", "numpy", "numba", "nicegui", "zarr", "distributed", "openpyxl"} <= found.keys()
    assert not licences.problems(found)


def test_the_page_of_licences_is_what_the_script_makes():
    """Other versions of Python need other packages: those of this one are on the page."""
    found = licences.needed("stiction", frozenset({"all"}), {})
    made, page = (set(text.splitlines()) for text in (licences.page(found, base_packages()), licences.PAGE.read_text("utf-8")))
    assert made <= page


def test_every_file_that_is_shipped_has_an_origin_and_a_licence(built):
    (sdist,) = built.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = [member.name.partition("/")[2] for member in archive.getmembers() if member.isfile()]
    rows = {licences.origin_of(name) for name in names if not name.endswith((".py", ".md"))}
    assert rows == set(licences.SHIPPED)
    package = {name for name in names if name.startswith("src/stiction/") and not name.endswith(".py")}
    assert len(package) > 20 and all(licences.origin_of(name)[0].startswith("src/stiction/") for name in package)


def _private_uses(file):
    """Return the private parts of other packages in a module, as `package: part`."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    packages, found = {}, set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            modules = {(alias.asname or alias.name).partition(".")[0]: alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            modules = {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
        else:
            continue
        packages |= {name: module.partition(".")[0] for name, module in modules.items()}
        found |= {module for module in modules.values() if re.search(r"\._(?!_)", module)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and re.match("_(?!_)", node.attr) and isinstance(node.value, ast.Name):
            found |= {f"{packages[node.value.id]}.{node.attr}"} if node.value.id in packages else set()
    return {one for one in found if one.partition(".")[0] not in {*sys.stdlib_module_names, "stiction"}}


def test_what_uses_private_parts_of_a_package_bounds_its_versions():
    used = {file.name: _private_uses(file) for file in (ROOT / "src").rglob("*.py")}
    assert {name: parts for name, parts in used.items() if parts} == {"numba_internals.py": {"numba._rebuild"}}
    (bound,) = (Requirement(one).specifier for one in PROJECT["dependencies"] if one.startswith("numba"))
    assert any(part.operator == "<" for part in bound) and distribution("numba").version in bound


@pytest.mark.parametrize("text", ["GPL-3.0-or-later", "AGPL-3.0", "GNU General Public License v3 (GPLv3)", "not stated"])
def test_a_licence_that_would_bind_users_is_seen(text):
    assert licences.problems({"one": text}) == [f"one: {text}"]
    assert not licences.problems({"one": "GNU Lesser General Public License v3 or later (LGPLv3+)", "two": "LGPL-3.0"})


def test_what_is_wrong_with_a_package_is_seen(built, tmp_path):
    """A wheel without the sources of its equations, and with a test in it."""
    (wheel,) = built.glob("*.whl")
    damaged = tmp_path / wheel.name
    with zipfile.ZipFile(wheel) as whole, zipfile.ZipFile(damaged, "w", zipfile.ZIP_DEFLATED) as partial:
        for name in whole.namelist():
            if not name.endswith("sources.bib"):
                partial.writestr(name, whole.read(name))
        partial.writestr("tests/test_one.py", "")
    assert contents.problems_of_wheel(damaged) == ["missing: stiction/records/sources.bib", "too much: tests/test_one.py"]


def base_packages():
    """What `pip install stiction` brings: the names of distributions, by what each asks for without extras."""
    found, waiting = {"stiction"}, list(map(shared.name_of, PROJECT["dependencies"]))
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        found.add(name)
        asked = map(Requirement, distribution(name).requires or ())
        waiting += [shared.canonical(one.name) for one in asked if one.marker is None or one.marker.evaluate({"extra": ""})]
    return found


@pytest.fixture(scope="module")
def alone(built, tmp_path_factory):
    """The wheel as pip installs it, out of the source tree and without a network: its folder, and the environment in which
    every package of this one is hidden that a base installation does not have."""
    (wheel,) = built.glob("*.whl")
    site = tmp_path_factory.mktemp("site")
    install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index", "--no-deps", "--no-compile"]
    subprocess.run([sys.executable, *install, "--target", str(site), str(wheel)], check=True, capture_output=True)
    base = base_packages()
    other = sorted(top for top, by in packages_distributions().items() if not {shared.canonical(one) for one in by} & base)
    assert {"matplotlib", "nicegui", "zarr", "pytest"} <= set(other)
    other.remove("sphinx")  # hidden, it would stand among the modules, where scipy takes it for one that is there
    hide = (
        f"import sys\nfor name in {[name for name in other if name.isidentifier()]}:\n    sys.modules.setdefault(name, None)\n"
    )
    (site / "sitecustomize.py").write_text(hide, encoding="utf-8")
    return site, os.environ | {"PYTHONPATH": str(site)}


def test_the_wheel_alone_is_installed_with_all_it_reads(alone):
    site, environment = alone
    about = site / f"stiction-{PROJECT['version']}.dist-info"
    package = site / "stiction"
    assert (about / "licenses" / "LICENSE").read_bytes() == (ROOT / "LICENSE").read_bytes()
    assert (package / "py.typed").exists() and (package / "__init__.pyi").exists()
    asked = (
        "import stiction as st; print(st.__file__, st.__version__, st.material('silver').name, '@' in st.cite('hertz_1882'))"
    )
    told = subprocess.run([sys.executable, "-c", asked], cwd=site.parent, env=environment, text=True, capture_output=True)
    assert told.stdout.split() == [str(package / "__init__.py"), PROJECT["version"], "silver", "True"], told.stderr


def test_the_wheel_alone_solves_the_demo(alone, tmp_path):
    """By the command that it brings, in an empty folder."""
    site, environment = alone
    words = [site / "bin" / "stiction", "run", ROOT / "examples" / "soft_film.toml", "--out", "demo"]
    done = subprocess.run(list(map(str, words)), cwd=tmp_path, env=environment, text=True, capture_output=True)
    assert done.returncode == 0 and "friction" in done.stdout, done.stderr
    assert sorted(path.name for path in (tmp_path / "demo").iterdir()) == ["curve.csv", "curve.nc"]


def recipe():
    """The recipe of conda as data: its lines of Jinja are settings, and what they set is put in."""
    text = (ROOT / "release" / "conda" / "meta.yaml").read_text(encoding="utf-8")
    settings = dict(re.findall(r'{% set (\w+) = "([^"]+)" %}\n', text))
    text = re.sub(r"{% set .*? %}\n", "", text)
    return settings, yaml.safe_load(re.sub(r"{{ (\w+) }}", lambda found: settings[found[1]], text))


OF_CONDA = {"matplotlib": "matplotlib-base", "lazy-loader": "lazy_loader"}  # packages that have another name there


def test_the_recipe_asks_for_what_the_project_asks_for():
    settings, told = recipe()
    wanted = [f"python >={PROJECT['requires-python'].removeprefix('>=')}"]
    for one in PROJECT["dependencies"]:
        name = shared.name_of(one)
        wanted.append(f"{OF_CONDA.get(name, name)} {one[len(name) :].strip()}")
    assert told["requirements"]["run"] == wanted
    assert settings["version"] == PROJECT["version"]
    assert (told["build"]["noarch"], told["build"]["entry_points"]) == ("python", ["stiction = stiction.cli:main"])
    limits = {shared.name_of(part): part for parts in PROJECT["optional-dependencies"].values() for part in parts}
    for one in told["requirements"]["run_constrained"]:
        name, bound = one.split()
        own = {given: name for name, given in OF_CONDA.items()}.get(name, name)
        assert limits[own] == f"{own}{bound}"


def test_the_citation_has_this_version():
    told = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert told["cff-version"] == "1.2.0" and told["title"] and told["authors"] and told["message"]
    assert (told["version"], told["license"]) == (PROJECT["version"], PROJECT["license"])
    assert told["keywords"] == PROJECT["keywords"]
    assert re.search(
        rf"^## \[(Unreleased\]: )?{re.escape(PROJECT['version'])}", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.M
    )


def test_the_image_is_of_a_python_that_is_supported():
    """And holds no address of a registry, and nothing that is secret."""
    lines = (ROOT / "release" / "Dockerfile").read_text(encoding="utf-8").splitlines()
    images = [line.split()[1] for line in lines if line.startswith("FROM ")]
    least = tuple(map(int, PROJECT["requires-python"].removeprefix(">=").split(".")))
    for image in images:
        version = re.fullmatch(r"python:(\d+)\.(\d+)-slim", image)
        assert version and tuple(map(int, version.groups())) >= least, image
    assert not [line for line in lines if re.search(r"https?://|index-url|token|password|^ARG|^ENV .*=.*secret", line, re.I)]


@pytest.fixture
def release(tmp_path, monkeypatch):
    """The checklist of a release, over a folder in which everything is well."""
    check = script("check")
    version, rows = PROJECT["version"], {}
    for one in shared.direct():
        name, least = re.match(r"([\w-]+)>=([\d.]+)", one).groups()
        rows[shared.canonical(name)] = f"{least}.0"
    for which in ("lowest", "newest"):
        (tmp_path / "page.md").touch()
        table = "".join(f"| `{name}` | {version} |\n" for name, version in rows.items())
        with (tmp_path / "page.md").open("a", encoding="utf-8") as page:
            page.write(f"<!-- {which} versions: begin -->\n{table}<!-- {which} versions: end -->\n")
    (tmp_path / "CHANGELOG.md").write_text(f"# Changelog\n\n## [{version}] - 2030-01-31\n\n## [0.0.1] - 2029-01-01\n", "utf-8")
    (tmp_path / "CITATION.cff").write_text(f"version: {version}\ndate-released: 2030-01-31\n", encoding="utf-8")
    monkeypatch.setattr(check, "ROOT", tmp_path)
    monkeypatch.setattr(check, "PAGE", tmp_path / "page.md")
    monkeypatch.setattr(check, "TOOLS", tmp_path)
    return check, tmp_path


def test_the_checklist_takes_what_is_well(release):
    check, _ = release
    assert (check._changelog(), check._citation()) == ("", "cffconvert is not there: make release-check brings it")
    assert check._versions() == ""


@pytest.mark.parametrize(
    "file, before, after, step, said",
    [
        ("CHANGELOG.md", "## [", "## [Unreleased]: [", "_changelog", "begins with"),
        ("CHANGELOG.md", "# Changelog\n", "# Changelog\n\n## [9.9.9] - 2030-02-01\n", "_changelog", "9.9.9"),
        ("CITATION.cff", "2030-01-31", "2030-01-30", "_citation", "date-released: 2030-01-30, wanted 2030-01-31"),
        ("CITATION.cff", "version: ", "version: 9.", "_citation", "version: 9."),
        ("page.md", "| `numpy` | ", "| `numpy` | 1", "_versions", "numpy 1"),
        ("page.md", "newest versions: begin", "other versions: begin", "_versions", "no newest numpy"),
    ],
)
def test_the_checklist_sees_what_is_not(release, file, before, after, step, said):
    check, folder = release
    text = (folder / file).read_text(encoding="utf-8")
    assert before in text
    (folder / file).write_text(text.replace(before, after), encoding="utf-8")
    assert said in getattr(check, step)()
