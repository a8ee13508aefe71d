"""Tables for other programs are read back by parsers written from the documents of their readers."""

import csv
import io
import json
import math
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import stiction as st
import stiction.report.export as writer
from stiction.quantities.errors import InputError
from stiction.report.exports import export_formats

BARE = """
contact.first = "silicon"
contact.second = "silicon"
contact.interface = "ceramic"
contact.roughness = { rms_height = "20 nm", finish = "polished" }
contact.nominal_area = "2 cm^2"
solve.load = "10 N"
"""
FILM = Path(__file__).parents[2] / "examples" / "soft_film.toml"
AREA = 2e-4  # m^2
# Pa in a unit of pressure, m in a unit of length and N in a unit of force, by hand.
SYSTEMS = {
    "m-kg-s": (1.0, 1.0, 1.0),
    "um-uN-MPa": (1e6, 1e-6, 1e-6),
    "mm-N-MPa": (1e6, 1e-3, 1.0),
    "in-lbf-psi": (6894.757293168, 0.0254, 4.4482216152605),
}
LOADS = [0.17, 1.3, 10.0, 77.0, 610.0]


def written(tmp_path_factory, text):
    """Return the path of a case file with this text."""
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return written(tmp_path_factory, BARE)


@pytest.fixture(scope="module")
def predicted(case):
    return st.predict(case, load=LOADS).friction_coefficient.values


@pytest.fixture(autouse=True)
def table_made_once(monkeypatch):
    monkeypatch.setattr(writer, "friction_table", TABLE)


TABLE = cache(writer.friction_table)


def keyword_lines(text):
    """Abaqus: lines of data by keyword, with its parameters; "**" begins a comment, an empty field is None."""
    found = {}
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            keyword, *parameters = [part.strip() for part in line[1:].split(",")]
            found[keyword] = (dict(one.partition("=")[::2] for one in parameters), [])
        else:
            found[keyword][1].append([float(field) if field.strip() else None for field in line.split(",")])
    return found


def abaqus(text):
    _, data = keyword_lines(text)["FRICTION"]
    assert all(rate is None for _, rate, _ in data)
    return [row[2] for row in data], [row[0] for row in data]


def ansys(text):
    """Ansys: a number of TBDATA belongs to the field that TBFIELD set last."""
    table, pressure, pairs = None, None, []
    for line in text.splitlines():
        words = line.partition("!")[0].split(",")
        if words[0] == "TB":
            table = words[1:]
        elif words[0] == "TBFIELD":
            assert words[1] == "NPRES"
            pressure = float(words[2])
        elif words[0] == "TBDATA":
            pairs.append((pressure, float(words[2])))
    assert table == ["FRIC", "1", "", "", "ISO"]
    return zip(*pairs, strict=True)


def comsol(text):
    return np.loadtxt(io.StringIO(text), comments="%").T[:2]


def moose(text):
    """MOOSE: parameters of a block, "[name]" begins and "[]" ends one."""
    found, path = {}, []
    for line in text.splitlines():
        word = line.partition("#")[0].strip()
        if word == "[]":
            path.pop()
        elif word.startswith("["):
            path.append(word.strip("[]"))
        elif word:
            name, _, value = word.partition("=")
            found["/".join([*path, name.strip()])] = value.strip().strip("'")
    assert not path and found["Functions/stiction/type"] == "PiecewiseLinear" and found["Functions/stiction/axis"] == "x"
    return ([float(one) for one in found[f"Functions/stiction/{name}"].split()] for name in "xy")


def of_rows(rows):
    heads, *rows = rows
    at = [next(place for place, head in enumerate(heads) if head.startswith(name)) for name in ("nominal", "friction")]
    return np.array([[float(row[one]) for one in at] for row in rows]).T


def xlsx(content):
    openpyxl = pytest.importorskip("openpyxl")
    return of_rows(openpyxl.load_workbook(io.BytesIO(content)).active.values)


READERS = {"abaqus": abaqus, "ansys": ansys, "comsol": comsol, "moose": moose, "xlsx": xlsx}
READERS["csv"] = lambda text: of_rows(csv.reader(io.StringIO(text)))


@pytest.mark.parametrize("units", SYSTEMS)
@pytest.mark.parametrize("name", READERS)
def test_a_reader_finds_the_prediction(case, predicted, name, units):
    text = st.export(case, name, units=units).text
    pressure, mu = (np.array(column, dtype=float) for column in READERS[name](text))
    assert (np.diff(pressure) > 0.0).all()
    read = np.interp(np.array(LOADS) / AREA / SYSTEMS[units][0], pressure, mu)
    np.testing.assert_allclose(read, predicted, rtol=1e-3)


@pytest.mark.parametrize("units", SYSTEMS)
def test_constants_of_multibody_programs(case, predicted, units):
    """Dahl's force-displacement curve begins with the stiffness of the asperities and ends at the friction force."""
    _, length, force = SYSTEMS[units]
    found = json.loads(st.export(case, "lugre", units=units).text)
    read = np.interp(np.array(LOADS) / force, found["load"], found["static_force"]) * force
    np.testing.assert_allclose(read / LOADS, predicted, rtol=1e-3)
    stiffness = np.interp(10.0 / force, found["load"], found["sigma_0"]) * force / length
    own = {"model": "greenwood_williamson_1966", "asperity": "zhao_maietta_chang_2000"}
    curve = st.slide(st.read_case(case).subject.as_numbers(), load=10.0, displacement=[1e-12], **own)
    assert stiffness == pytest.approx(float(curve["tangential_force"].squeeze()) / 1e-12, rel=2e-3)


@pytest.mark.parametrize("units", SYSTEMS)
def test_calculix_takes_one_coefficient_and_a_stick_slope(case, predicted, units):
    of_pressure, _, _ = SYSTEMS[units]
    found = keyword_lines(st.export(case, "calculix", units=units).text)
    ((mu, slope),) = found["FRICTION"][1]
    assert mu == pytest.approx(predicted[LOADS.index(10.0)], rel=1e-6)
    slip = float(keyword_lines(st.export(case, "abaqus", units=units).text)["FRICTION"][0]["ELASTIC SLIP"])
    assert slope * slip == pytest.approx(mu * 10.0 / AREA / of_pressure, rel=1e-4)
    assert found["SURFACE BEHAVIOR"][1][-1][0] == pytest.approx(1000.0 / AREA / of_pressure, rel=1e-6)


def test_kratos_takes_one_coefficient(case, predicted):
    found = json.loads(st.export(case, "kratos").text)
    assert found["friction_coefficients"]["0"] == pytest.approx(predicted[LOADS.index(10.0)], rel=1e-6)
    assert (found["contact_type"], found["frictional_law"]) == ("Frictional", "Coulomb")


def test_kratos_itself_takes_the_file(case):
    kratos = pytest.importorskip("KratosMultiphysics")
    process = pytest.importorskip("KratosMultiphysics.ContactStructuralMechanicsApplication.alm_contact_process")
    model = kratos.Model()
    model.CreateModelPart("Structure").ProcessInfo[kratos.DOMAIN_SIZE] = 2
    table = st.export(case, "kratos")
    made = process.ALMContactProcess(model, kratos.Parameters(table.text))
    mu = made.contact_settings["friction_coefficients"]["0"].GetDouble()
    assert mu == pytest.approx(float(table.friction_coefficient[table.attrs["working_row"]]), rel=1e-6)


@pytest.mark.parametrize("units", SYSTEMS)
def test_abaqus_gets_the_compliance_of_the_interface(case, units):
    """Overclosure is the change of the mean separation; elastic slip is stress over stiffness."""
    of_pressure, length, _ = SYSTEMS[units]
    found = keyword_lines(st.export(case, "abaqus", units=units).text)
    parameters, rows = found["SURFACE BEHAVIOR"]
    assert parameters == {"PRESSURE-OVERCLOSURE": "TABULAR"} and rows[0] == [0.0, 0.0]
    pressure, closure = np.array(rows).T
    assert (np.diff(pressure) > 0.0).all() and (np.diff(closure) > 0.0).all()
    own = {"model": "greenwood_williamson_1966", "asperity": "zhao_maietta_chang_2000"}
    gap = st.solve(st.read_case(case).subject.as_numbers(), load=[1.3, 77.0], **own).mean_separation.values
    read = np.interp(np.array([1.3, 77.0]) / AREA / of_pressure, pressure, closure) * length
    assert np.diff(read) == pytest.approx(-np.diff(gap), rel=0.03)  # rows interpolate the separation to 2 % of itself
    rows_of = np.array([1, len(pressure) // 2, len(pressure) - 1])
    loads = pressure[rows_of] * of_pressure * AREA
    gap = st.solve(st.read_case(case).subject.as_numbers(), load=loads.tolist(), **own).mean_separation.values
    assert np.diff(closure[rows_of]) * length == pytest.approx(-np.diff(gap), rel=1e-4)
    stated = re.search(r"ELASTIC SLIP at the load (\S+) \w+, pressure (\S+)", st.export(case, "abaqus", units=units).text)
    force = SYSTEMS[units][2]
    assert [float(one) for one in stated.groups()] == pytest.approx([10.0 / force, 10.0 / AREA / of_pressure], rel=1e-5)
    table = st.export(case, "csv")
    at = table.attrs["working_row"]
    slip = float(table.friction_coefficient[at] * table.nominal_pressure[at] / table.tangential_stiffness[at])
    assert float(found["FRICTION"][0]["ELASTIC SLIP"]) * length == pytest.approx(slip, rel=1e-4)


BLOCKS = """
*NODE, NSET=BELOW
1, 0., 0., -0.1
2, 1., 0., -0.1
3, 1., 1., -0.1
4, 0., 1., -0.1
5, 0., 0., 0.
6, 1., 0., 0.
7, 1., 1., 0.
8, 0., 1., 0.
*NODE, NSET=ABOVE
11, 0., 0., 0.
12, 1., 0., 0.
13, 1., 1., 0.
14, 0., 1., 0.
15, 0., 0., 0.1
16, 1., 0., 0.1
17, 1., 1., 0.1
18, 0., 1., 0.1
*NSET, NSET=TOP
15, 16, 17, 18
*ELEMENT, TYPE=C3D8, ELSET=EALL
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 11, 12, 13, 14, 15, 16, 17, 18
*MATERIAL, NAME=STIFF
*ELASTIC
1e6, 0.
*SOLID SECTION, ELSET=EALL, MATERIAL=STIFF
*SURFACE, NAME=MASTER
1, S2
*SURFACE, NAME=SLAVE
2, S1
*CONTACT PAIR, INTERACTION=STICTION, TYPE=NODE TO SURFACE
SLAVE, MASTER
*BOUNDARY
BELOW, 1, 3
ABOVE, 2, 2
TOP, 1, 1
*STEP, INC=1000
*STATIC
0.1, 1.
*BOUNDARY
TOP, 3, 3, {pressed:.6e}
*END STEP
*STEP, INC=1000
*STATIC
0.1, 1.
*BOUNDARY
TOP, 1, 1, {moved:.6e}
*NODE PRINT, NSET=TOP, TOTALS=ONLY
RF
*END STEP
"""


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize(("slips", "expected"), [(0.2, 0.2), (0.9, 0.9), (1.5, 1.0), (3.0, 1.0)])
def test_a_block_sticks_and_slides_in_calculix(case, tmp_path, slips, expected):
    """Two blocks of 1 mm^2 pressed to a closure: the normal force is that of the table, the shear force rises with the stick
    slope to mu times it and stays there."""
    table = st.export(case, "calculix", units="mm-N-MPa")
    pressure, closure = np.array(keyword_lines(table.text)["SURFACE BEHAVIOR"][1]).T
    row = table.isel(row=table.attrs["working_row"])
    wanted = float(row["nominal_pressure"])
    pressed = float(np.interp(wanted, pressure, closure))
    deck = table.text + BLOCKS.format(pressed=-pressed, moved=slips * float(row["elastic_slip"]))
    (tmp_path / "blocks.inp").write_text(deck, encoding="utf-8")
    subprocess.run(["ccx", "blocks"], cwd=tmp_path, check=True, capture_output=True)
    shear, _, normal = map(float, (tmp_path / "blocks.dat").read_text(encoding="utf-8").split()[-3:])
    assert -normal == pytest.approx(wanted, rel=5e-3)
    assert shear == pytest.approx(expected * float(row["friction_coefficient"]) * wanted, rel=5e-3)


RADIUS, ADHESION = 50e-6, 0.05  # m, J/m^2
STICKY = BARE.replace("2 cm^2", "4 um^2").replace("10 N", "10 uN") + f'contact.work_of_adhesion = "{ADHESION} J/m^2"\n'


@pytest.fixture(scope="module")
def sticky(tmp_path_factory):
    return written(tmp_path_factory, STICKY)


@pytest.fixture(scope="module")
def limit_force(sticky):
    return float(st.predict(sticky).friction_force.squeeze())


def lethe_parameters(text):
    """Lethe: "set" in nested subsections; "#" begins a comment."""
    found, path = {}, []
    for line in text.splitlines():
        word, _, rest = line.partition("#")[0].strip().partition(" ")
        if word == "subsection":
            path.append(rest.strip())
        elif word == "end":
            path.pop()
        elif word == "set":
            name, _, value = rest.partition("=")
            found["/".join([*path, name.strip()])] = value.strip()
    assert not path
    return found


@pytest.mark.parametrize("units", SYSTEMS)
def test_lethe_slides_at_the_predicted_force(sticky, limit_force, units):
    """The formulas are those of Lethe's theory guide: effective surface energy, pull-off force and Coulomb limit."""
    of_pressure, length, force = SYSTEMS[units]
    found = lethe_parameters(st.export(sticky, "lethe", units=units, radius=RADIUS).text)
    place = "lagrangian physical properties"
    particle = {
        name: float(found[f"{place}/particle type 0/{name} particles"]) for name in ("surface energy", "friction coefficient")
    }
    wall = {name: float(found[f"{place}/{name} wall"]) for name in particle}
    first, second = particle["surface energy"], wall["surface energy"]
    energy = first + second - 2.0 * (math.sqrt(first) - math.sqrt(second)) ** 2
    assert energy * force / length == pytest.approx(ADHESION, rel=1e-6)
    pull_off = 1.5 * math.pi * energy * RADIUS / length
    assert particle["friction coefficient"] == wall["friction coefficient"]
    limit = particle["friction coefficient"] * (1e-5 / force + 2.0 * pull_off)
    assert limit * force == pytest.approx(limit_force, rel=1e-3)
    modulus = st.material("silicon").youngs_modulus / of_pressure
    assert float(found[f"{place}/particle type 0/young modulus particles"]) == pytest.approx(modulus, rel=1e-6)
    methods = {found[f"model parameters/particle {other} contact force method"] for other in ("particle", "wall")}
    assert methods == {"hertz_JKR", "JKR"}


@pytest.mark.parametrize("units", SYSTEMS)
def test_liggghts_slides_at_the_predicted_force(sticky, limit_force, units):
    """Hertz's force less k A, A = 2 pi delta 2 R*: its largest tension is JKR's, and mu times Hertz's force the limit."""
    of_pressure, *_ = SYSTEMS[units]
    text = st.export(sticky, "liggghts", units=units, radius=RADIUS).text
    found = dict(re.findall(r"^variable (\w+) equal (\S+)$", text, flags=re.MULTILINE))
    mu, cohesion = float(found["stictionFriction"]), float(found["stictionCohesion"]) * of_pressure
    silicon = st.material("silicon")
    modulus = silicon.youngs_modulus / 2.0 / (1.0 - silicon.poissons_ratio**2)

    def hertz(overlap):
        return 4.0 / 3.0 * modulus * math.sqrt(RADIUS * overlap) * overlap

    def net(overlap):
        return hertz(overlap) - cohesion * 2.0 * math.pi * overlap * 2.0 * RADIUS

    overlaps = np.geomspace(1e-12, 1e-7, 20001)
    forces = np.array([net(overlap) for overlap in overlaps])
    assert -forces.min() == pytest.approx(1.5 * math.pi * ADHESION * RADIUS, rel=1e-5)
    overlap = np.interp(1e-5, forces[forces.argmin() :], overlaps[forces.argmin() :])
    assert mu * hertz(overlap) == pytest.approx(limit_force, rel=1e-3)


@pytest.mark.parametrize("name", ["lethe", "liggghts"])
def test_spheres_need_a_radius_and_no_adhesion(case, predicted, name):
    with pytest.raises(InputError, match="effective radius"):
        st.export(case, name)
    with pytest.raises(InputError) as refused:
        st.export(case, name, radius=["1 um", "2 um"])
    assert refused.value.field == "radius"
    text = st.export(case, name, radius="50 um").text
    coefficient = re.search(r"(?:friction coefficient particles =|stictionFriction equal) (\S+)", text)[1]
    assert float(coefficient) == pytest.approx(predicted[LOADS.index(10.0)], rel=1e-6)


def test_ansys_gets_the_stiffness_at_the_stated_load(case):
    table = st.export(case, "ansys", units="mm-N-MPa")
    told = re.search(r"FKT of the contact elements: (\S+), in N/mm\^3", table.text)
    expected = table.tangential_stiffness[table.attrs["working_row"]]
    assert float(told[1]) == pytest.approx(-float(expected), rel=1e-5)


def test_a_bound_is_an_end_of_the_interval(case):
    answer = st.predict(case, load=10.0, level=0.9)
    ends = {0.05: answer.friction_coefficient_low, 0.95: answer.friction_coefficient_high}
    for level, end in ends.items():
        found = json.loads(st.export(case, "kratos", level=level).text)["friction_coefficients"]["0"]
        assert found == pytest.approx(float(end), rel=1e-6)


def test_the_table_spans_the_loads_of_the_case(case):
    table = st.export(FILM, "csv")
    assert table["load"].values[[0, -1]] == pytest.approx([0.1, 10.0])
    assert "tangential_stiffness" not in table  # how film and body share a displacement is not known
    assert any(line.startswith("no stiffness") for line in table.attrs["comments"])
    assert st.export(case, "csv")["load"].values[[0, -1]] == pytest.approx([0.1, 1000.0])
    hard = st.export(case, "csv", load="1 MN")  # ten times that would flatten the faces
    assert hard["load"].values[[0, -1]] == pytest.approx([1e4, 1e6])


@pytest.mark.parametrize(
    ("given", "field"),
    [({"to": "nastran"}, "to"), ({"units": "cgs"}, "units"), ({"level": 1.0}, "level"), ({"out": "no/such/file"}, "out")],
)
def test_refusals(case, given, field, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as told:
        st.export(case, **{"to": "csv", **given})
    assert told.value.field == field


@pytest.mark.parametrize("name", ["calculix", "lugre"])
def test_formats_that_want_a_stiffness_refuse_a_film(name):
    with pytest.raises(InputError, match="no stiffness before sliding"):
        st.export(FILM, name)


@pytest.mark.parametrize("name", [name for name in export_formats() if name not in READERS])
def test_a_format_without_a_reader_holds_the_prediction(case, predicted, name):
    """The friction coefficient at 10 N, or the friction force."""
    text = st.export(case, name, radius="50 um").text
    numbers = np.array([float(number) for number in re.findall(r"\d+\.\d*(?:[eE][-+]?\d+)?", text)])
    mu = predicted[LOADS.index(10.0)]
    assert np.isclose(numbers, mu, rtol=1e-6).any() or np.isclose(numbers, 10.0 * mu, rtol=1e-6).any()


def test_command(case, tmp_path):
    words = ["export", case, "--to", "csv", "--out", tmp_path / "mu.csv", "--units", "mm-N-MPa", "--json"]
    done = subprocess.run([sys.executable, "-m", "stiction", *map(str, words)], text=True, capture_output=True, check=True)
    found = json.loads(done.stdout)
    rows = list(csv.reader(io.StringIO((tmp_path / "mu.csv").read_text(encoding="utf-8"))))
    assert rows[0][1] == "nominal_pressure [MPa]" and len(rows) - 1 == len(found["table"]["load"]["values"])
    assert found["table"]["nominal_pressure"]["unit"] == "MPa"
