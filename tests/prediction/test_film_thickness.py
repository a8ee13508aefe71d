"""A film between nothing and a body: the area it makes has both as limits, and no step between them."""

import numpy as np

import stiction as st

LOAD = 1.0
SILVER = {"preset": "silver", "hardness": "0.4 GPa"}
ROUGH = {
    "asperity_height_deviation": "48 nm", "asperity_radius": "50 um", "asperity_density": "1.7e10 1/m^2", "kind": "gaussian",
}  # fmt: skip


def area(thickness=None, first="hardened_steel_52100", kind="gaussian", interface_strength="10 MPa"):
    """The prediction of steel on steel with a silver film of this thickness, or without."""
    film = {} if thickness is None else {"coating": {"material": SILVER, "bodies": "first", "thickness": thickness}}
    rough = {name: value for name, value in (ROUGH | {"kind": kind}).items() if value}
    contact = st.Contact(
        first=first, second="hardened_steel_52100", nominal_area="1 mm^2", roughness=rough,
        interfacial_shear_strength=interface_strength, **film,
    )  # fmt: skip
    return st.predict(contact, load=LOAD)


def test_a_thick_film_is_a_body_of_it():
    film, body = area("100 um"), area(first=SILVER)
    for name in ("contact_area_low", "contact_area", "contact_area_high"):
        assert abs(np.log(film[name] / body[name]).item()) < 0.04, name


def test_a_thin_film_has_no_less_area_than_the_bodies_without_it():
    """Before, squeezed out to the hardness of steel whose spots are elastic: a quarter of the area of bare steel."""
    film, bare = area("1 nm"), area()
    assert film.contact_area_low > 0.9 * bare.contact_area_low
    assert bare.contact_area < film.contact_area < area("100 um").contact_area


def test_no_step_where_the_film_leaves_what_was_solved():
    """Before, the upper end leapt twentyfold at .15 and at 5 shortest waves: 0.6 and 40 um here."""
    thickness = np.geomspace(3e-7, 8e-5, 60)
    found = area(st.axis("thickness", thickness), kind=None)
    for name in ("contact_area_low", "contact_area", "contact_area_high"):
        assert np.abs(np.diff(np.log(found[name].values.ravel()))).max() < np.log(1.25), name


def test_an_uncertain_hardness_of_the_film_counts_in_the_area():
    """Spots of a thick soft film are plastic, A = P/H, so that the interval of the area is that of the hardness."""
    film = {"preset": "silver", "hardness": "0.4 GPa +/- 20 %"}
    contact = {
        "first": "hardened_steel_52100", "second": "hardened_steel_52100", "nominal_area": "1 mm^2",
        "interfacial_shear_strength": "20 MPa", "work_of_adhesion": "0 J/m^2",
        "coating": {"material": film, "bodies": "first", "thickness": "20 um"},
        "roughness": {"asperity_height_deviation": "48 nm", "asperity_radius": "20 um", "asperity_density": "4e10 1/m^2",
                      "kind": "polished"},
    }  # fmt: skip
    answer = st.predict({"contact": contact, "solve": {"load": ["1 N"]}})
    width = (answer["contact_area_high"] / answer["contact_area_low"]).item()
    assert 0.9 * (1.329 / 0.671) < width < 1.3 * (1.329 / 0.671)


def test_junctions_of_clean_metal_grow_on_a_thick_film_only():
    """A film of gold much thicker than its spots are wide seizes as gold does; on a thin one tau_0/H is the most."""

    def friction(first, **more):
        rough = {**ROUGH, "asperity_height_deviation": "480 nm", "kind": "polished"}
        contact = st.Contact(
            first=first, second=first, nominal_area="1 mm^2", roughness=rough, interface="clean metal", **more,
        )  # fmt: skip
        return st.predict(contact, load=LOAD).friction_coefficient.item()

    film = {
        thickness: {"coating": {"material": "gold", "bodies": "both", "thickness": thickness}} for thickness in ("1 mm", "1 nm")
    }
    body = friction("gold")
    assert abs(friction("copper", **film["1 mm"]) / body - 1.0) < 0.1 and body > 0.7
    assert friction("copper", **film["1 nm"]) < 0.25
