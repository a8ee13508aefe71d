"""Hold exported names to the numpydoc standard: all sections, all parameters, typed signatures, examples that run."""

import doctest
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from pydantic import BaseModel

import stiction as st
from stiction.solving.choice import LawKeywords

EXPORTED = {name: getattr(st, name) for name in st.__all__ if callable(getattr(st, name))}
FUNCTIONS = [name for name, value in EXPORTED.items() if inspect.isfunction(value)]
RAISE_NOTHING = ("Evaluation", "InputError", "InputWarning", "summary")
USER_SCRIPT = """
import numpy as np

import stiction as st

rough = st.Roughness(asperity_height_deviation="48 nm", asperity_radius="50 um", asperity_density="1e9 /m^2")
film = st.Coating(material="silver", thickness="200 nm")
contact = st.Contact(
    first="gold", second=st.material("gold"), roughness=rough, nominal_area="1 mm^2", coating=film,
    interfacial_shear_strength="30 MPa",
)
result = st.solve(contact, load=["1 mN", "10 mN"], model="greenwood_williamson_1966", film="sequential", asperity="hertz_1882")
curve = st.solve(contact, separation=np.linspace(0.0, 1e-7, 5), tangential="tabor_1959", variant="published")
several = st.solve(contact, load=st.axis("load", ["1 mN", "2 mN"]), threads=2)
answer = st.predict(contact, load="1 N", level=0.5)
table = st.compare(contact, load="1 N")
moved = st.slide(contact, load="1 N", residual_strength=0.5)
back = st.unload(contact, max_load="1 N", separation_increase=[0.0, 1e-9])
stresses = st.film_stresses(contact, load="1 N", film="layered")
case = {"indices": {"theta": 40, "lam": 10}, "solve": {"load": 1.0}}
st.solve_case(case).to_netcdf("a.nc")
st.compare_case(st.read_case("case.toml"), load=1.0)
print(st.summary(answer), st.cite(result), [row["key"] for row in st.models()], st.show_config()["loops"])
mu: float = st.predict_value("mu", "load", 10, "first", "gold")
area: float = st.evaluate(np.linspace(0, 3, 10), theta=1.0, lam=1.0).contact_area.sum()
target = st.SelfAffine(hurst=0.8, rolloff=2e-6, shortest=4e-7, deviation=1e-8)
surface = st.gaussian_surface((64, 64), ("10 um", "10 um"), target, seed=1)
st.asperities(surface, "mccool")
st.export(contact, "csv", "a.csv", load="1 N")
st.sweep(case, "store.zarr", workers=2)
st.fit(case, "data.csv", progress=lambda label: iter)
gold = st.material("gold", hardness="1 GPa").replace(poissons_ratio=0.4)
twice = 2.0 * gold.hardness / contact.contact_modulus
if (stress := gold.yield_stress) is not None:
    print(stress / 1e6, contact.coating, rough.height_parameters, contact.roughness.skewness)
water = st.Liquid(relative_humidity=[0.3, 0.5], contact_angle_first="10 deg", contact_angle_second=0)
groups = st.Indices(theta=st.axis("theta", [1.0, 2.0]), lam=1, nu=0.3).replace(lam=2)
print(water.suction, groups.eta, contact.interface_at([0.05, 0.95])[0], contact.unlabelled.scales().load)
"""
MISTAKES = """
st.solve(contact, load=1.0, flim="sequential")
st.evaluate(0.0, 1.0, 1.0, readding="published")
st.Material(youngs_modulus="1 GPa", poissons_ratio=0.3, hardnes="1 GPa", hardness=None)
reveal_type(result)
reveal_type(st.__version__)
reveal_type(gold.hardness)
reveal_type(gold.yield_stress)
"""
OF_OTHERS = {"a_HeightMap.to_topography"}  # returns an object of a library without types
# What NumPy's own types hold of Any: the shape and the kind of numbers of an array.
OF_NUMPY = re.compile(r"tuple\[Any, \.\.\.\]|numpy\.dtype\[Any\]")


def check_types(folder, text):
    """Return what mypy --strict reports of a user's script, without its summary."""
    script = folder / "script.py"
    script.write_text(text, encoding="utf-8")
    assert (Path(st.__file__).parent / "py.typed").exists()  # or a type checker would not look into the installed package
    cache = f"--cache-dir={Path(__file__).parents[2] / '.mypy_cache' / 'of_a_user'}"  # libraries are read once
    options = ["--strict", "--follow-imports=silent", "--config-file=", cache, "--no-error-summary"]
    command = [sys.executable, "-m", "mypy", *options, str(script)]
    environment = os.environ | {"MYPYPATH": str(Path(st.__file__).parents[1])}
    return subprocess.run(command, text=True, capture_output=True, env=environment, cwd=folder, check=False).stdout


@pytest.mark.parametrize("name", EXPORTED)
def test_examples_run(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(EXPORTED[name]), {}, name, None, 0)
    assert example.examples and doctest.DocTestRunner(verbose=False).run(example).failed == 0


@pytest.mark.parametrize("name", EXPORTED)
def test_sections_are_complete(name):
    value, text = EXPORTED[name], inspect.getdoc(EXPORTED[name])
    parameters = inspect.signature(value).parameters if name != "InputWarning" else {}
    sections = ["Examples", *(["Parameters"] if parameters else []), *(["Returns"] if name in FUNCTIONS else [])]
    sections += [] if name in RAISE_NOTHING else ["Raises"]
    assert not [title for title in sections if f"\n{title}\n{'-' * len(title)}\n" not in text]
    fields = [each for each in parameters if each not in ("unnamed_values", "args", "kwargs")]
    described = text.split("Parameters\n", 1)[1].split("\n\n", 1)[0] if parameters else ""
    if "**laws" in described:
        fields = [field for field in fields if field not in LawKeywords.__annotations__]
    assert not [field for field in fields if field not in described]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_signatures_are_typed(name):
    signature = inspect.signature(EXPORTED[name])
    annotations = {each.name: str(each.annotation) for each in signature.parameters.values()}
    assert not [each for each, annotation in annotations.items() if "Any" in annotation or "_empty" in annotation]
    assert signature.return_annotation is not inspect.Signature.empty


def public_members():
    """Return one expression for each exported name, and for each public member of an exported class."""
    members = {f"st.{name}": value for name, value in EXPORTED.items()}
    for name, value in EXPORTED.items():
        if inspect.isclass(value) and not issubclass(value, Exception | Warning):
            names = {*dir(value), *getattr(value, "model_fields", {})} - {*dir(BaseModel), *dir(tuple)}
            members |= {f"a_{name}.{each}": value for each in names if not each.startswith("_")}
    return members


def test_a_strict_type_checker_reads_the_script_of_a_user(tmp_path):
    """It accepts what is right, finds misspelt keywords, and sees the types of results. One run, as mypy is slow to start."""
    members = sorted(public_members())
    declared = sorted({each.split(".")[0] for each in members} - {"st"})
    public = [*(f"{each}: st.{each[2:]}" for each in declared), *(f"reveal_type({each})" for each in members)]
    lines = check_types(tmp_path, USER_SCRIPT + MISTAKES + "\n".join(public)).splitlines()
    errors = [line for line in lines if ": error:" in line]
    found = [re.findall(r'Argument "(\w+)"|keyword argument "(\w+)"', error) for error in errors]
    assert [left or right for ((left, right),) in found] == ["flim", "readding", "hardnes", "hardness"]
    types = [line.split('Revealed type is "', 1)[1][:-1] for line in lines if "Revealed type" in line]
    number = "float | xarray.core.dataarray.DataArray"
    assert types[:4] == ["xarray.core.dataset.Dataset", "str", number, f"{number} | None"]
    assert len(types[4:]) == len(members)
    with_any = {each for each, kind in zip(members, types[4:], strict=True) if re.search(r"\bAny\b", OF_NUMPY.sub("", kind))}
    assert with_any == OF_OTHERS
