"""Where half or twice the load has another recommended model, and another mu, a comparison says so beside the number."""

import json

import pytest
from typer.testing import CliRunner

import stiction as st
from stiction.case.read import parse_case
from stiction.cli import app
from stiction.laws.validity import doubts_of
from stiction.quantities.units import to_si
from stiction.report.tables import comparison_summary

MU = "friction_coefficient_at_load"
# Ground soft metals, and hardened steel: body, surface, what is known of the interface, load, and whether mu leaps there.
SOFT = {"youngs_modulus": "107 GPa", "poissons_ratio": 0.35, "hardness": "0.46 GPa"}
SOFTER = {"youngs_modulus": "26 GPa", "poissons_ratio": 0.35, "hardness": "0.585 GPa"}
CONTACTS = {
    "strength of the bodies": (SOFT, ("6.7 nm", "2.6 um", "2.3e12 1/m^2"), {"work_of_adhesion": "0.27 J/m^2"}, "2 mN"),
    "strength of the interface": (
        SOFTER, ("5 nm", "1.5 um", "5.36e12 1/m^2"),
        {"work_of_adhesion": "68 mJ/m^2", "interfacial_shear_strength": "29 MPa"}, "1.09 mN",
    ),
    "none": ("hardened_steel_52100", ("48 nm", "50 um", "1.7e10 1/m^2"), {"interfacial_shear_strength": "0.2 GPa"}, "10 N"),
}  # fmt: skip


def case(body, surface, interface, load, area="4300 um^2", **solve):
    names = ("asperity_height_deviation", "asperity_radius", "asperity_density")
    rough = dict(zip(names, surface, strict=True))
    return {
        "contact": {"first": body, "second": body, "nominal_area": area, "roughness": rough} | interface,
        "solve": {"load": load} | solve,
    }


def compared(name, factor=1.0):
    *given, load = CONTACTS[name]
    area = "1 mm^2" if name == "none" else "4300 um^2" if name.endswith("bodies") else "1865 um^2"
    tables = case(*given, load, area)
    subject = parse_case(tables).subject
    return st.compare(subject, load=factor * to_si(load, "load")), subject, tables


@pytest.mark.parametrize("name", ["strength of the bodies", "strength of the interface"])
def test_a_leap_is_said_with_the_two_numbers(name):
    here, subject, _ = compared(name)
    said = here.attrs["leap"]
    assert said.startswith("the recommended model changes near this load: mu leaps from ")
    others = {factor: compared(name, factor)[0].attrs["recommended"] for factor in (0.5, 2.0)}
    best = here.attrs["recommended"]
    ends = []
    for factor, there in others.items():
        load = factor * here.attrs["working_load"]
        mu = [float(st.solve(subject, load=load, model=model)["friction_coefficient"]) for model in (best, there)]
        ends += [(max(mu) / min(mu), f"from {mu[0]:.3g} to {mu[1]:.3g} at ", there)]
    ratio, words, there = max(ends)
    assert ratio > 1.2 and words in said and said.endswith(f"({there})") and there != best
    assert said in [line.plain for line in comparison_summary(here)]


def test_no_leap_is_said_where_there_is_none():
    here, *_ = compared("none")
    assert here.attrs["leap"] == ""
    for factor in (0.5, 2.0):
        other, *_ = compared("none", factor)
        mu = [float(one[MU].sel(model=one.attrs["recommended"])) for one in (here, other)]
        assert max(mu) / min(mu) < 1.2


def test_the_recommended_model_warns_when_it_is_run():
    here, _, tables = compared("strength of the bodies")
    tables["solve"]["model"] = "recommended"
    run = st.solve_case(parse_case(tables))
    assert here.attrs["leap"] in [one.why for one in doubts_of(run)]
    tables["solve"]["model"] = here.attrs["recommended"]
    assert here.attrs["leap"] not in [one.why for one in doubts_of(st.solve_case(parse_case(tables)))]


def test_the_command_says_it_on_paper_and_as_data(tmp_path):
    here, subject, _ = compared("strength of the bodies")
    rough = subject.roughness
    (tmp_path / "case.toml").write_text(f"""
[contact]
first = {{ youngs_modulus = "107 GPa", poissons_ratio = 0.35, hardness = "0.46 GPa" }}
second = {{ youngs_modulus = "107 GPa", poissons_ratio = 0.35, hardness = "0.46 GPa" }}
nominal_area = "4300 um^2"
work_of_adhesion = "0.27 J/m^2"
[contact.roughness]
asperity_height_deviation = "{rough.asperity_height_deviation} m"
asperity_radius = "{rough.asperity_radius} m"
asperity_density = "{rough.asperity_density} 1/m^2"
[solve]
load = "2 mN"
""")
    shown = CliRunner().invoke(app, ["compare", str(tmp_path / "case.toml"), "--all"]).stdout
    assert here.attrs["leap"] in " ".join(shown.split())
    data = json.loads(CliRunner().invoke(app, ["compare", str(tmp_path / "case.toml"), "--json"]).stdout)
    assert data["leap"] == here.attrs["leap"]
