r"""The contact of the measured map itself, solved point by point by boundary elements.

*Assumes*: half-spaces without friction and with small slopes. There are no asperities and no statistics: the contact of the
measured map is solved. *Sources*: [polonsky_keer_1999] for the minimisation; [stanley_kato_1997] for displacements by Fourier
transforms of one period, or by cosine transforms of a window that is continued by its mirror images; [love_1929] for a map
that is not periodic, used to check single spheres; [almqvist_2007] for pressures limited to the hardness; [nogi_kato_1997]
for a film; [yastrebov_2017] for the correction of the area. With the pressure $p$ and the heights $h$ of the points, and the
compliance $C$ of both bodies:

$$
\min_p\ \tfrac12\langle p\,Cp\rangle-\langle p\,h\rangle,\qquad 0\le p\le H,\quad \langle p\rangle=P/A_n,\qquad
\hat C(k)=\frac2{E^*k}\ \text{(bare)}
$$

Angle brackets denote the mean over the points, $P/A_n$ the nominal pressure, $H$ the hardness, $E^*$ the contact modulus and
$\hat C(k)$ the compliance for a wave of the wavenumber $k$. The map carries the nominal pressure; its area, stiffness and
friction are multiplied by the ratio of the nominal area to the area of the map. The hardness is the softer body's. If one body
is coated, it is the smaller of the hardnesses of the film and the other body. If both bodies are coated, each has half of the
thickness. The substrate does not yield.

*Adhesion* (optional) of elastic bodies on a periodic map: at the gap $g$ the energy per area is $-\gamma\,e^{-g/\varrho}$ with
the work of adhesion $\gamma$ (method of [pastewka_robbins_2014]). The range $\varrho$ is 0.3 nm, or the shortest range that the
map resolves, for which $E^*\varrho^2/\gamma$ is twice the point spacing.

*Menisci* of a liquid: the suction $\gamma_\mathrm L/r$ (surface tension over radius of the meniscus) acts on every point with
a gap below the meniscus height $2rc$ of [`equilibrium_meniscus`](#equilibrium_meniscus), like the attraction of [maugis_1992].
Points in contact and wetted points are computed in turn, starting with the dry contact. With adhesion, menisci are not
included.

*Friction*: a law of the interface is applied to the pressure of every point. For the shear strength $\tau=\tau_0+\alpha p$ the
sum is exact, $T=\tau_0A+\alpha P$ with the contact area $A$. With `shear="lesser"` the strength of a point is the smaller of
$\alpha p$ and $\tau_0$ ([orowan_1943]). With `shear="junction_growth"`, points that flow under pressure and shear grow until
$p^2+9\tau_0^2=H^2$ ([tabor_1959]): $T=\tau_0\sum\max(A,\,P/\sqrt{H^2-9\tau_0^2})$ over the points. *Area*: the points in
contact overestimate the area; $A=A_\text{px}-c\,S\,\Delta x$, where $A_\text{px}$ is their area, $\Delta x$ the point spacing
and $S$ the length of the edges between points in contact and others. The form follows [yastrebov_2017]; the coefficient was
fitted to this solver: $c=.100+.090\,\epsilon^4$ with $\epsilon=|S_x-S_y|/(S_x+S_y)$, the imbalance of edges along $x$ and $y$.
*Check* (in the tests): Hertz, Westergaard, Johnson, Greenwood & Higginson, and the library ContactMechanics.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

from stiction.contact.contact import EQUILIBRIUM_DISTANCE, Contact
from stiction.contact.materials import Material
from stiction.contact.pair import Pair, compliance_of
from stiction.quantities.errors import InputError
from stiction.records.claims import Validity
from stiction.records.registry import RoughSurface
from stiction.records.sources import Source
from stiction.solvers.boundary_elements import limits
from stiction.solvers.boundary_elements.bodies import Bodies
from stiction.solvers.boundary_elements.compliance import Film
from stiction.solvers.boundary_elements.menisci import Menisci
from stiction.solvers.shear.compliance import HalfSpace, ShearCompliance
from stiction.solvers.shear.mode_mixity import MODE_MIXITIES

if TYPE_CHECKING:
    from stiction.quantities.arguments import NumberOrArray
    from stiction.solvers.boundary_elements.curve import MapCurve
    from stiction.surfaces.heightmap import HeightMap


def bodies_of(contact: Contact) -> Bodies:
    """Return elastic compliances and hardness of the bodies of a contact, for the boundary-element solver.

    Every input of the contact must be a single number, not an array.
    """
    coating = contact.coating
    if coating is None:
        return Bodies(1.0 / (compliance_of(contact.first) + compliance_of(contact.second)),
                      hardness=Pair(contact.first, contact.second).hardness)  # fmt: skip
    if coating.bodies == "both":
        film, counter = (_film(coating.material, 0.5 * coating.thickness, body) for body in (contact.first, contact.second))
        return Bodies(inf, film, counter, float(coating.material.hardness))
    coated, other = (contact.first, contact.second) if coating.bodies == "first" else (contact.second, contact.first)
    film = _film(coating.material, coating.thickness, coated)
    return Bodies(1.0 / compliance_of(other), film, hardness=Pair(coating.material, other).hardness)


def shear_compliance_of(contact: Contact) -> ShearCompliance:
    """Return the elastic compliance of the two bodies of a contact under shear, for the boundary-element solver.

    Every input of the contact must be a single number, not an array. The order of the bodies of the contact does not matter:
    the solver moves the body whose face is displaced more along x by a pressure.
    """
    upper, lower = sorted(_elastic_bodies(contact), key=_displaced_by_pressure, reverse=True)
    return ShearCompliance((upper, lower))


def _displaced_by_pressure(body: Film | HalfSpace) -> tuple[float, float]:
    """Return (1 - 2 nu)/G [1/Pa] of a body's surface material and of its substrate; both are equal without a film.

    A pressure displaces the face of a body tangentially in proportion to this value. nu: Poisson's ratio. G: shear modulus.
    """

    def share(modulus: float, poisson: float) -> float:
        return 2.0 * (1.0 + poisson) * (1.0 - 2.0 * poisson) / modulus

    below = (body.substrate_modulus, body.substrate_poisson) if isinstance(body, Film) else (body.modulus, body.poisson)
    return share(body.modulus, body.poisson), share(*below)


def _elastic_bodies(contact: Contact) -> tuple[Film | HalfSpace, Film | HalfSpace]:
    """Return the elastic constants of both bodies of a contact, as a Film for a coated body and a HalfSpace for a bare one."""
    coating = contact.coating
    bare = {
        name: HalfSpace(float(body.youngs_modulus), float(body.poissons_ratio))
        for name, body in (("first", contact.first), ("second", contact.second))
    }
    if coating is None:
        return bare["first"], bare["second"]
    if coating.bodies == "both":
        films = [_film(coating.material, 0.5 * coating.thickness, body) for body in (contact.first, contact.second)]
        return films[0], films[1]
    other = "second" if coating.bodies == "first" else "first"
    return _film(coating.material, coating.thickness, getattr(contact, coating.bodies)), bare[other]


def _film(material: Material, thickness: "NumberOrArray", substrate: Material) -> Film:
    elastic = (number for body in (material, substrate) for number in (body.youngs_modulus, body.poissons_ratio))
    return Film(*map(float, (thickness, *elastic)))


def of_map(
    surface: "HeightMap", contact: Contact, pressures: Sequence[float], *, points: str, yielding: str, shear: str,
    adhesion: str, mode_mixity: str,
) -> "MapCurve":  # fmt: skip
    """Solve the contact of a map at nominal pressures [Pa] and return the result as a MapCurve.

    surface: map that represents the roughness of both faces. points, yielding, adhesion: options of the model. With
    adhesion, all points are solved and menisci are left out. shear: not used here, because the option is applied later.
    mode_mixity: must be "none". Raises InputError for another mode_mixity, or if the map or a pressure cannot be solved
    with these options.
    """
    from stiction.solvers.boundary_elements.curve import curve_of_map  # slow to import, so only if a map is solved

    if mode_mixity != "none":
        raise InputError(
            "mode_mixity", mode_mixity, "none; only slide() accepts a law of mode mixity, as only shear changes the adhesion"
        )
    bodies = bodies_of(contact)
    if yielding == "none":
        bodies = replace(bodies, hardness=None)
    if adhesion != "left_out":
        return _sticking(surface, contact, bodies, pressures, adhesion)
    if contact.liquid is not None:
        bodies = replace(bodies, menisci=Menisci(float(contact.liquid.suction), float(contact.liquid.height)))
    return curve_of_map(surface, bodies, pressures, sampled=points == "sampled")


def _sticking(
    surface: "HeightMap", contact: Contact, bodies: Bodies, pressures: Sequence[float], adhesion: str
) -> "MapCurve":  # fmt: skip
    """Solve the contact of a map with adhesion at nominal pressures [Pa] and return the result as a MapCurve.

    The attraction decays with the gap over a finite range. bodies: elastic bodies of the contact, for the solver. adhesion:
    option "atomic_range" or "shortest_range", which sets the range.
    """
    from stiction.solvers.boundary_elements.adhesive_curve import adhesive_curve

    work, reach = attraction_of(surface, contact, bodies, adhesion)
    curve = adhesive_curve(surface, bodies, pressures, work=work, reach=reach)
    if adhesion == "atomic_range":
        return curve
    return replace(curve, of_map={**curve.of_map, "range_tabor": float(contact.tabor_parameter(reach))})


def attraction_of(surface: "HeightMap", contact: Contact, bodies: Bodies, adhesion: str) -> tuple[float, float]:
    """Return work of adhesion [J/m2] and range of the attraction [m] of a contact with a map.

    The work of adhesion is the coating's if the coating states one, else the contact's. adhesion: "atomic_range" takes the
    equilibrium distance. "shortest_range" takes the shortest range that the map resolves, or the equilibrium distance if that
    is longer. Raises InputError for a contact without adhesion.
    """
    from stiction.solvers.boundary_elements.adhesive_curve import shortest_range

    coating = contact.coating
    work = contact.work_of_adhesion if coating is None or coating.work_of_adhesion is None else coating.work_of_adhesion
    if not contact.adheres or work is None:
        raise InputError("work_of_adhesion", contact.work_of_adhesion, f"> 0 J/m^2 with adhesion = {adhesion}")
    if adhesion == "atomic_range":
        return float(work), EQUILIBRIUM_DISTANCE
    return float(work), max(shortest_range(surface, bodies, float(work)), EQUILIBRIUM_DISTANCE)


_UNSOLVED = "the solution did not converge, so mu is unreliable"

RECORD = RoughSurface(
    key="boundary_elements",
    title="The contact of the measured map itself, solved point by point",
    grade="B",
    sources=(
        Source("polonsky_keer_1999", "", "conjugate gradients; changed to converge also where points flow"),
        Source("stanley_kato_1997", "", "displacements by Fourier transforms"),
        Source("almqvist_2007", "", "pressures between 0 and the hardness"),
        Source("nogi_kato_1997", "", "compliance of a film; checked by the boundary conditions of a wave, not against print"),
        Source("love_1929", "", "displacement under a loaded point of a map that is not periodic, for the checks"),
        Source("pastewka_robbins_2014", "", "attraction with a finite range; solved here by another minimisation method"),
        Source("maugis_1992", "", "attraction by a constant stress up to a gap; here the liquid at every point of a map"),
        Source("orowan_1943", "", "shear = lesser; reconstructed, not compared with print"),
        Source("tabor_1959", "", "shear = junction_growth; reconstructed, not compared with print"),
        Source("yastrebov_2017", "", "correction of the area for the size of the pixels"),
    ),
    of_map=of_map,
    takes_surface_moments=True,
    accuracy=limits.TOLERANCE,
    up_to_full_contact=True,
    verified="Hertz, Westergaard, Johnson, Greenwood & Higginson; a quadratic program for few points; the library "
    "ContactMechanics",
    own_options={
        "points": ("all", "sampled"),
        "yielding": ("at_hardness", "none"),
        "shear": ("law", "lesser", "junction_growth"),
        "adhesion": ("left_out", "atomic_range", "shortest_range"),
        "mode_mixity": ("none", *MODE_MIXITIES),
    },
    validity=(
        Validity(
            "points_in_shortest_wave",
            limits.LEAST_PIXELS,
            inf,
            "the map has too few points, so its contact area is inaccurate",
            "fit",
        ),
        Validity("points_in_contact", limits.LEAST_CONTACT, inf, "the contact area is inaccurate with so few points"),
        Validity("map_gradient", 0.0, limits.STEEPEST, "slopes are too steep for half-spaces"),
        Validity("points_in_film", 1.0, inf, "the map does not resolve the film, so the contact area may be inaccurate"),
        Validity(
            "points_in_weakening",
            limits.LEAST_WEAKENING,
            inf,
            "the map does not resolve the loss of strength, so the friction force is too large",
        ),
        Validity("points_at_edge", limits.LEAST_POINTS, inf, "the map does not resolve the edge of adhesive contact", "effect"),
        Validity(
            "range_tabor",
            limits.LEAST_TABOR,
            inf,
            "the range of attraction is too long for the JKR limit; a finer map allows a shorter range, down to 0.3 nm",
        ),
        Validity("attraction_residual", 0.0, limits.MOST_ATTRACTION_LEFT, _UNSOLVED, "effect"),
        Validity("solution_residual", 0.0, limits.TOLERANCE, _UNSOLVED, "effect"),
        Validity("load_error", 0.0, limits.LEAST_LOAD_ERROR, "the computed pressures do not add up to the load", "effect"),
    ),
    notes=(
        "The map is prepared as its roughness specifies, then its contact is solved; a periodic map (periodic = true, and "
        "generated maps) keeps its form and has no ends. There is no adhesion by default. The hardness is the largest pressure "
        'of a point; the substrate of a film does not yield. points="sampled" uses the fewest points that give the area within '
        "1 to 2 %, or within 3 to 10 % for a surface with a lay."
    ),
)
