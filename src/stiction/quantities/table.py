"""The one table of quantities: units, bounds, symbols and meanings of everything that goes in or comes out.

Validators, docstrings, command-line help, result attributes and axis labels read it; nothing else states a
unit or a bound. The symbols are those of docs/theory.md.
"""

from dataclasses import dataclass, replace
from math import inf, isinf

__all__ = ["QUANTITIES", "Quantity"]


@dataclass(frozen=True)
class Quantity:
    """One row of the table.

    name: the key; symbol: plain text; latex: without dollar signs; unit: SI, "" if none; meaning: a phrase;
    lower, upper: bounds in the unit, with lower_included, upper_included (infinite values are never allowed);
    normalised_by: what the dimensionless form is divided by, "" if it has none; example: an accepted input; short: a name that
    fits on an axis of a plot together with its unit.
    """

    name: str
    symbol: str
    latex: str
    unit: str
    meaning: str
    lower: float = -inf
    upper: float = inf
    lower_included: bool = False
    upper_included: bool = False
    normalised_by: str = ""
    example: str = ""
    short: str = ""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of a variable: long_name, symbol and units; comment, the meaning in full where the name is short."""
        comment = {"comment": self.meaning} if self.short else {}
        return {"long_name": self.short or self.meaning, "symbol": self.symbol, "units": self.unit or "1"} | comment

    @property
    def allowed(self) -> str:
        """The allowed range with its unit, in words: "> 0 Pa", ">= 0 and < 0.5", "any finite number of m"."""
        unit = f" {self.unit}" if self.unit else ""
        ends = []
        if not isinf(self.lower):
            ends.append(f"{'>=' if self.lower_included else '>'} {self.lower:g}{unit}")
        if not isinf(self.upper):
            ends.append(f"{'<=' if self.upper_included else '<'} {self.upper:g}{unit}")
        return " and ".join(ends) or ("any finite number" + (f" in {self.unit}" if self.unit else ""))

    @property
    def wanted(self) -> str:
        """The allowed range with an example where a unit has to be written: '> 0 m, e.g. "200 nm"'."""
        return f'{self.allowed}, e.g. "{self.example}"' if self.unit and self.example else self.allowed

    @property
    def scale(self) -> str:
        """What results of a whole contact are scaled by (contact.subject.Scales): the SI unit, or "count" of asperities."""
        return "count" if self.normalised_by == _COUNT else self.unit

    @property
    def label(self) -> str:
        """The meaning with its unit, as on an axis: "asperity tip radius [m]"."""
        return f"{self.meaning} [{self.unit}]" if self.unit else self.meaning


# Bounds of the table below: lower, upper, whether each is included.
_ANY = (-inf, inf, False, False)
_POSITIVE = (0.0, inf, False, False)
_NOT_NEGATIVE = (0.0, inf, True, False)
_FROM_ONE = (1.0, inf, True, False)
_SHARE = (0.0, 1.0, True, True)
_SHARE_BELOW_ONE = (0.0, 1.0, True, False)
# Softer than any solid: a number meant in GPa, or mPa for MPa.
_SOLID = (1e3, inf, True, False)
# Dimensionless groups: beyond these no contact is, and sums and their limits lose their digits or all of their size.
_GROUP = (1e-12, 1e12, True, True)
_THETA = (1e-12, 1e40, True, True)
_LAMBDA = (1e-60, 1e120, True, True)
_LENGTH_RATIO = (0.0, 1e15, True, True)
_PART = (0.0, 1.0, False, True)
_ONE_OR_TWO = (1.0, 2.0, True, True)
# nu = 1/2 is left out: an incompressible film does not carry load as a half-space does.
# Below 0 nothing was checked.
_POISSON = (0.0, 0.5, True, False)

_LOAD = "K R^(1/2) sigma^(3/2) per asperity"
_AREA = "pi R sigma per asperity"
_COUNT = "number of asperities"

# fmt: off
_INPUTS = [  # name, symbol, latex, unit, bounds, example, meaning
    # materials
    ("youngs_modulus", "E", "E", "Pa", _SOLID, "210 GPa", "Young's modulus"),
    ("poissons_ratio", "nu", r"\nu", "", _POISSON, "0.3", "Poisson's ratio"),
    ("hardness", "H", "H", "Pa", _SOLID, "7.3 GPa",
     "hardness, the mean pressure of a fully plastic contact"),
    ("yield_stress", "Y", "Y", "Pa", _SOLID, "2.5 GPa", "yield stress in tension"),
    ("tangent_modulus", "E_t", r"E_\mathrm{t}", "Pa", _NOT_NEGATIVE, "2 GPa",
     "tangent modulus, the slope of stress over strain beyond yield"),
    ("surface_energy", "gamma_s", r"\gamma_s", "J/m^2", _POSITIVE, "1.25 J/m^2",
     "surface energy of one surface"),
    # contact
    ("asperity_height_deviation", "sigma", r"\sigma", "m", _POSITIVE, "48 nm",
     "standard deviation of the asperity heights"),
    ("asperity_radius", "R", "R", "m", _POSITIVE, "50 um", "asperity tip radius"),
    ("asperity_density", "N", "N", "1/m^2", _POSITIVE, "1.7e10 1/m^2", "asperities per nominal area"),
    ("nominal_area", "A_n", r"A_\mathrm{n}", "m^2", _POSITIVE, "1 mm^2", "nominal contact area"),
    ("work_of_adhesion", "gamma", r"\gamma", "J/m^2", _NOT_NEGATIVE, "50 mJ/m^2", "work of adhesion"),
    ("interfacial_energy", "gamma_12", r"\gamma_{12}", "J/m^2", _NOT_NEGATIVE, "0.5 J/m^2",
     "energy of the closed interface"),
    ("thickness", "t", "t", "m", _POSITIVE, "200 nm",
     "film thickness, of both films together if there are two"),
    ("friction_constant", "C", "C", "N/m", _POSITIVE, "2 N/m",
     "constant of the film's friction mu = (C t/W)^(1/3) of one asperity"),
    ("hardness_to_yield", "k", "k", "", _FROM_ONE, "2.8", "hardness over yield stress, H/Y"),
    ("interfacial_shear_strength", "tau_0", r"\tau_0", "Pa", _NOT_NEGATIVE, "20 MPa",
     "shear strength of the interface at no pressure"),
    ("equilibrium_distance", "epsilon", r"\varepsilon", "m", _POSITIVE, "0.3 nm",
     "equilibrium distance of two surfaces"),
    # dimensionless groups
    ("theta", "theta", r"\theta", "", _THETA, "40",
     "elastic adhesion index K sigma^(3/2) / (gamma R^(1/2))"),
    ("lam", "lambda", r"\lambda", "", _LAMBDA, "10",
     "plastic adhesion index pi^2 R H^4 sigma / (18 K^2 gamma^2)"),
    ("hardness_group", "eta", r"\eta", "", _POSITIVE, "2",
     "hardness group pi H R^(1/2) / (K sigma^(1/2)), in place of theta and lambda where nothing adheres"),
    ("nu", "nu", r"\nu", "", _POISSON, "0.3", "Poisson's ratio of the softer body"),
    ("K_beta", "K beta", r"K\beta", "", _GROUP, "6.476", "normal stiffness times tangential compliance"),
    ("n_E", "n_E", "n_E", "", _GROUP, "1.5", "film modulus over substrate modulus"),
    ("n_H", "n_H", "n_H", "", _GROUP, "0.5", "film hardness over substrate hardness"),
    ("tau", "tau", r"\tau", "", _LENGTH_RATIO, "2", "film thickness over sigma, t / sigma"),
    ("n_g", "n_g", "n_g", "", _GROUP, "1", "work of adhesion of the film over that of the substrate"),
    ("film_aspect", "t/sqrt(R sigma)", r"t/\sqrt{R\sigma}", "", _LENGTH_RATIO, "0.13",
     "film thickness over sqrt(R sigma)"),
    ("film_nu", "nu_c", r"\nu_\mathrm{c}", "", _POISSON, "0.3", "Poisson's ratio in the film's contact"),
    ("film_K_beta", "(K beta)_c", r"(K\beta)_\mathrm{c}", "", _GROUP, "6.476",
     "K beta of the film's contact"),
    ("films", "n_f", r"n_\mathrm{f}", "", _ONE_OR_TWO, "1",
     "coated bodies: 1, with all of the thickness, or 2, with half of it each"),
    ("layer_nu", "nu_l", r"\nu_\mathrm{l}", "", _POISSON, "0.3", "Poisson's ratio of the film itself"),
    ("coated_share", "s", "s", "", _PART, "1",
     "share of the coated body in the compliance of the bare contact: 1 if the other is rigid"),
    ("coated_nu", "nu_1", r"\nu_1", "", _POISSON, "0.3", "Poisson's ratio of the coated body"),
    ("counter_nu", "nu_2", r"\nu_2", "", _POISSON, "0.3", "Poisson's ratio of the body that meets the coated one"),
    ("film_friction_constant", "C/(K sqrt(R sigma))", r"C/(K\sqrt{R\sigma})", "", _POSITIVE, "1e-4",
     "constant of the film's friction (C t/W)^(1/3) over K sqrt(R sigma)"),
    ("tabor_parameter", "mu_T", r"\mu_\mathrm{T}", "", _POSITIVE, "2",
     "Tabor parameter (R gamma^2 / (E*^2 epsilon^3))^(1/3)"),
    ("sharpness", "sqrt(sigma/R)", r"\sqrt{\sigma/R}", "", _POSITIVE, "0.03", "sqrt(sigma/R)"),
    ("roughness_parameter", "N R sigma", r"NR\sigma", "", _POSITIVE, "0.04",
     "roughness parameter, asperity density times R sigma"),
    ("nominal_width", "sqrt(A_n)/sigma", r"\sqrt{A_\mathrm{n}}/\sigma", "", _POSITIVE, "20000",
     "square root of the nominal area over sigma"),
    ("shear_strength", "tau_0/H", r"\tau_0/H", "", _NOT_NEGATIVE, "0.1",
     "interfacial shear strength at no pressure over hardness"),
    ("pressure_coefficient", "alpha", r"\alpha", "", _NOT_NEGATIVE, "0.05",
     "rise of the interfacial shear strength with pressure"),
    ("peeling", "zeta", r"\zeta", "", _SHARE, "1",
     "share of the tangential energy release that peels: 1 after Savkoor and Briggs, 0 for none"),
    ("hardening", "E_t/E", r"E_\mathrm{t}/E", "", _SHARE_BELOW_ONE, "0.01",
     "tangent modulus over Young's modulus, of the softer body"),
    ("specific_contact_resistance", "rho_c", r"\rho_\mathrm{c}", "ohm m^2", _POSITIVE, "1e-12 ohm m^2",
     "electrical resistance of the interface times its real area"),
    # of a measurement; no example, so that it is not listed among the numbers of a case file
    ("contact_resistance", "R_c", r"R_\mathrm{c}", "ohm", _POSITIVE, "", "electrical resistance of the contact"),
    # of a measured surface; no example either
    ("scan_size", "L", "L", "m", _POSITIVE, "", "size of a scan, or another length along it"),
]

_OUTPUTS = [  # name, symbol, latex, unit, bounds, what its dimensionless form is divided by, meaning
    # of a material or a contact
    ("shear_modulus", "G", "G", "Pa", _POSITIVE, "", "shear modulus E / (2 (1 + nu))"),
    ("contact_modulus", "E*", r"E^*", "Pa", _POSITIVE, "", "contact modulus, 1/E* = sum of (1 - nu^2)/E"),
    ("normal_stiffness", "K", "K", "Pa", _POSITIVE, "", "K = (4/3) E*"),
    ("tangential_compliance", "beta", r"\beta", "1/Pa", _POSITIVE, "", "beta = sum of (2 - nu)/G"),
    ("plasticity_index", "psi", r"\psi", "", _POSITIVE, "", "plasticity index (E*/H) (sigma/R)^(1/2)"),
    ("film_plasticity_index", "psi_f", r"\psi_\mathrm{f}", "", _POSITIVE, "",
     "plasticity index of the film against what it meets"),
    ("film_stiffness", "n_E sqrt(R sigma)/t", r"n_E\sqrt{R\sigma}/t", "", _POSITIVE, "",
     "modulus over thickness of the film, over the substrate's modulus over sqrt(R sigma)"),
    # of a solution
    ("mean_separation", "d", "d", "m", _ANY, "sigma",
     "mean separation, from the mean of the asperity heights"),
    ("load", "P", "P", "N", _ANY, _LOAD, "net normal load, adhesion included"),
    ("load_elastic", "P_el", r"P_\mathrm{el}", "N", _ANY, _LOAD, "net load on elastic asperities"),
    ("load_plastic", "P_pl", r"P_\mathrm{pl}", "N", _ANY, _LOAD, "net load on plastic asperities"),
    ("load_elastic_plastic", "P_ep", r"P_\mathrm{ep}", "N", _ANY, _LOAD, "net load on elastic-plastic asperities"),
    ("load_film", "P_f", r"P_\mathrm{f}", "N", _ANY, _LOAD, "net load carried by the film"),
    ("load_substrate", "P_s", r"P_\mathrm{s}", "N", _ANY, _LOAD, "net load carried by the substrate"),
    ("contact_area", "A", "A", "m^2", _NOT_NEGATIVE, _AREA, "real contact area"),
    ("contact_area_elastic", "A_el", r"A_\mathrm{el}", "m^2", _NOT_NEGATIVE, _AREA,
     "real contact area of elastic asperities"),
    ("contact_area_plastic", "A_pl", r"A_\mathrm{pl}", "m^2", _NOT_NEGATIVE, _AREA,
     "real contact area of plastic asperities"),
    ("contact_area_elastic_plastic", "A_ep", r"A_\mathrm{ep}", "m^2", _NOT_NEGATIVE, _AREA,
     "real contact area of elastic-plastic asperities"),
    ("friction_force", "T", "T", "N", _NOT_NEGATIVE, _LOAD, "tangential force that shears the contact"),
    ("friction_slip_limited", "T_slip", r"T_\mathrm{slip}", "N", _NOT_NEGATIVE, _LOAD,
     "tangential force of asperities that slip before they yield"),
    ("friction_yield_limited", "T_yield", r"T_\mathrm{yield}", "N", _NOT_NEGATIVE, _LOAD,
     "tangential force of asperities that yield before they slip"),
    ("friction_film", "T_f", r"T_\mathrm{f}", "N", _NOT_NEGATIVE, _LOAD, "tangential force of the film"),
    ("friction_substrate", "T_s", r"T_\mathrm{s}", "N", _NOT_NEGATIVE, _LOAD,
     "tangential force of the substrate"),
    ("friction_coefficient", "mu", r"\mu", "", _NOT_NEGATIVE, "",
     "static friction coefficient T/P, undefined where P <= 0"),
    ("tangential_stiffness", "k_t", r"k_\mathrm{t}", "N/m", _NOT_NEGATIVE, "K R^(1/2) sigma^(1/2) per asperity",
     "tangential stiffness before anything slides"),
    ("area_fraction", "A/A_n", r"A/A_\mathrm{n}", "", _NOT_NEGATIVE, "", "real contact area over the nominal one"),
    ("nominal_pressure", "P/A_n", r"P/A_\mathrm{n}", "Pa", _ANY, _LOAD, "net load over the nominal contact area"),
    ("nominal_pressure_over_hardness", "P/(A_n H)", r"P/(A_\mathrm{n}H)", "", _ANY, "",
     "nominal pressure over the hardness of what is softest"),
    ("mean_pressure_over_hardness", "P/(A H)", r"P/(AH)", "", _ANY, "",
     "mean pressure in contacts over the hardness of what bears the load"),
    ("touching_share", "n/(N A_n)", r"n/(NA_\mathrm{n})", "", _SHARE, "", "share of the asperities that touch"),
    ("asperity_area_over_yield", "A/(n A_c)", r"A/(nA_\mathrm{c})", "", _NOT_NEGATIVE, "",
     "mean contact area of a touching asperity over that at first yield"),
    ("adhesion_share", "n P_0/P", r"nP_0/P", "", _NOT_NEGATIVE, "",
     "pull-off forces of the touching asperities over the load"),
    ("load_share_without_friction", "s_0", r"s_0", "", _SHARE, "",
     "share of the load on asperities that the model gives no friction"),
    ("load_share_yielded", "s_y", r"s_\mathrm{y}", "", _SHARE, "", "share of the load on asperities that have yielded"),
    ("load_share_substrate_yielded", "s_sy", r"s_\mathrm{s,y}", "", _SHARE, "",
     "share of the load on asperities whose substrate has yielded"),
    ("rms_slope", "h'", r"h'", "", _NOT_NEGATIVE, "", "rms slope of the Gaussian surface that has these asperities"),
    ("stickiness_ratio", "Q", "Q", "", _POSITIVE, "", "repulsion in contact spots over the attraction beside them"),
    ("range_over_gap", "rho/g_0", r"\varrho/g_0", "", _NOT_NEGATIVE, "",
     "range of the attraction over the gap beside contact spots, (16/3) h'^2/h''"),
    ("thickness_over_radius", "t/R", r"t/R", "", _NOT_NEGATIVE, "", "film thickness over asperity radius"),
    ("contact_over_thickness", "a/t", r"a/t", "", _NOT_NEGATIVE, "",
     "contact radius of the mean touching asperity over the thickness of a film"),
    ("stress_over_yield", "s_M/Y", r"\sigma_\mathrm{M}/Y", "", _NOT_NEGATIVE, "",
     "largest von Mises stress under the mean touching asperity over the yield stress there"),
    ("interface_tension", "s_i/Y", r"\sigma_\mathrm{i}/Y", "", _NOT_NEGATIVE, "",
     "largest tension between film and body over the yield stress of the weaker"),
    ("interface_shear", "tau_i/(Y/sqrt(3))", r"\sqrt{3}\tau_\mathrm{i}/Y", "", _NOT_NEGATIVE, "",
     "largest shear between film and body over the shear yield stress of the weaker"),
    ("stiff_film_over_wave", "t/lambda_s", r"t/\lambda_\mathrm{s}", "", _NOT_NEGATIVE, "",
     "thickness of a film of five times the modulus of the bodies or more, over the shortest wave of the surface"),
    ("touching_asperities", "n", "n", "", _NOT_NEGATIVE, _COUNT, "number of touching asperities"),
    ("pull_off_force", "P_off", r"P_\mathrm{off}", "N", _NOT_NEGATIVE, _LOAD,
     "largest tension that is carried"),
    ("pull_off_separation", "d_off", r"d_\mathrm{off}", "m", _ANY, "sigma",
     "mean separation at the largest tension, undefined where there is none"),
    # of the contact of a map, solved point by point
    ("plane_separation", "D", "D", "m", _ANY, "sigma", "separation of the mean planes of the faces as they were"),
    ("contact_area_pixels", "A_px", r"A_\mathrm{px}", "m^2", _NOT_NEGATIVE, _AREA,
     "real contact area as counted in points, not corrected for their edges"),
    ("load_share_plastic", "s_pl", r"s_\mathrm{pl}", "", _SHARE, "", "share of the load on points that bear the hardness"),
    ("contact_stiffness", "k_n", r"k_\mathrm{n}", "N/m", _NOT_NEGATIVE, "K R^(1/2) sigma^(1/2) per asperity",
     "normal stiffness of the contact, load over approach"),
    ("points_in_contact", "n_px", r"n_\mathrm{px}", "", _NOT_NEGATIVE, "", "points of the map in contact"),
    ("points_in_shortest_wave", "lambda_s/dx", r"\lambda_\mathrm{s}/\Delta x", "", _POSITIVE, "",
     "points of the map in its shortest waves"),
    ("longest_waves_on_a_side", "L/lambda_l", r"L/\lambda_\mathrm{l}", "", _POSITIVE, "",
     "longest waves of the map on its shorter side"),
    ("map_gradient", "h'_map", r"h'_\mathrm{map}", "", _POSITIVE, "", "rms gradient of the map"),
    ("points_in_film", "t/dx", r"t/\Delta x", "", _POSITIVE, "", "film thickness over the distance of the map's points"),
    ("film_over_side", "t/L", "t/L", "", _POSITIVE, "", "film thickness over the shorter side of a map that ends"),
    ("load_at_ends", "s_e", r"s_\mathrm{e}", "", _SHARE, "", "share of the load on the outermost points of the map"),
    ("solution_residual", "r", "r", "", _NOT_NEGATIVE, "",
     "gaps where there is contact, over the rms height difference of neighbouring points"),
    ("load_error", "e_P", r"e_P", "", _NOT_NEGATIVE, "", "relative error of the load that the pressures carry"),
    ("adhesion_range", "rho", r"\rho", "m", _POSITIVE, "", "range of the attraction of the faces"),
    ("range_tabor", "mu_rho", r"\mu_\rho", "", _NOT_NEGATIVE, "", "Tabor parameter with the range of attraction"),
    ("points_at_edge", "n_e", r"n_\mathrm{e}", "", _POSITIVE, "",
     "points along the length over which the edge of contact is pulled"),
    ("attraction_residual", "r_w", r"r_w", "", _NOT_NEGATIVE, "",
     "pressure left where faces do not touch, over the largest attraction"),
    ("point_spacing", "n_s", r"n_\mathrm{s}", "", _POSITIVE, "", "every how many-th point of the map is solved"),
    # of films
    ("load_share_beyond_film", "s_P", r"s_P", "", _SHARE, "",
     "share of the load on asperities wider than the film is thick (a > t)"),
    ("load_share_substrate", "s_s", r"s_\mathrm{s}", "", _SHARE, "", "share of the load that the substrate carries"),
    ("friction_share_beyond_film", "s_T", r"s_T", "", _SHARE, "",
     "share of the friction on asperities wider than the film is thick (a > t)"),
]
# fmt: on

_RESULT_EXAMPLES = {"mean_separation": "48 nm", "load": "1 N"}  # results that are also what is solved for

# Names for axes, where the meaning with its unit is longer than the 30 characters to which xarray's plots break their labels.
_SHORT = {
    "hardness_group": "hardness group",
    "films": "coated bodies",
    "layer_nu": "Poisson's ratio, layer",
    "coated_share": "compliance share",
    "coated_nu": "Poisson's ratio, coated",
    "counter_nu": "Poisson's ratio, counter",
    "film_stiffness": "film stiffness group",
    "load_share_substrate": "substrate's load share",
    "contact_over_thickness": "a over film thickness",
    "stress_over_yield": "stress over yield stress",
    "interface_tension": "tension at the interface",
    "interface_shear": "shear at the interface",
    "film_plasticity_index": "film plasticity index",
    "friction_constant": "film friction constant",
    "film_friction_constant": "film constant over K",
    "hardness": "hardness",
    "tangent_modulus": "tangent modulus",
    "surface_energy": "surface energy",
    "asperity_height_deviation": "asperity deviation",
    "asperity_density": "asperities per area",
    "interfacial_energy": "interfacial energy",
    "thickness": "film thickness",
    "hardness_to_yield": "hardness over yield",
    "interfacial_shear_strength": "shear strength",
    "equilibrium_distance": "equilibrium distance",
    "theta": "elastic adhesion index",
    "lam": "plastic adhesion index",
    "nu": "Poisson's ratio",
    "K_beta": "K beta",
    "n_E": "film modulus ratio",
    "n_H": "film hardness ratio",
    "tau": "thickness over sigma",
    "n_g": "film adhesion ratio",
    "film_aspect": "t over sqrt(R sigma)",
    "film_nu": "Poisson's ratio, film",
    "film_K_beta": "K beta of the film",
    "tabor_parameter": "Tabor parameter",
    "roughness_parameter": "N R sigma",
    "nominal_width": "sqrt(A_n) over sigma",
    "shear_strength": "shear strength over H",
    "pressure_coefficient": "pressure coefficient",
    "peeling": "peeling share",
    "hardening": "hardening E_t/E",
    "contact_resistance": "contact resistance",
    "specific_contact_resistance": "resistance times area",
    "scan_size": "scan size",
    "shear_modulus": "shear modulus",
    "contact_modulus": "contact modulus",
    "tangential_compliance": "compliance beta",
    "plasticity_index": "plasticity index",
    "mean_separation": "mean separation",
    "load": "net normal load",
    "load_elastic": "load, elastic",
    "load_plastic": "load, plastic",
    "load_elastic_plastic": "load, elastic-plastic",
    "load_film": "load on the film",
    "load_substrate": "load on the substrate",
    "contact_area_elastic": "real area, elastic",
    "contact_area_plastic": "real area, plastic",
    "contact_area_elastic_plastic": "area, elastic-plastic",
    "friction_force": "friction force",
    "friction_slip_limited": "friction, slip first",
    "friction_yield_limited": "friction, yield first",
    "friction_film": "friction of the film",
    "friction_substrate": "friction, substrate",
    "friction_coefficient": "friction coefficient",
    "tangential_stiffness": "tangential stiffness",
    "area_fraction": "real area fraction",
    "nominal_pressure": "nominal pressure",
    "nominal_pressure_over_hardness": "pressure over hardness",
    "mean_pressure_over_hardness": "contact pressure over H",
    "touching_share": "share that touches",
    "asperity_area_over_yield": "area over that at yield",
    "adhesion_share": "pull-off over load",
    "load_share_without_friction": "load without friction",
    "load_share_yielded": "load, yielded",
    "load_share_substrate_yielded": "load, substrate yielded",
    "rms_slope": "rms slope",
    "stickiness_ratio": "repulsion over attraction",
    "range_over_gap": "range over gap",
    "thickness_over_radius": "thickness over radius",
    "stiff_film_over_wave": "stiff film over wave",
    "touching_asperities": "touching asperities",
    "pull_off_force": "pull-off force",
    "pull_off_separation": "pull-off separation",
    "plane_separation": "plane separation",
    "contact_area_pixels": "area in points",
    "load_share_plastic": "load at the hardness",
    "contact_stiffness": "normal stiffness",
    "points_in_contact": "points in contact",
    "points_in_shortest_wave": "points in shortest waves",
    "longest_waves_on_a_side": "longest waves on a side",
    "map_gradient": "rms gradient",
    "points_in_film": "points in the film",
    "film_over_side": "film over side",
    "load_at_ends": "load at the ends",
    "solution_residual": "residual",
    "load_error": "error of the load",
    "point_spacing": "point spacing",
    "adhesion_range": "range of attraction",
    "range_tabor": "Tabor parameter of range",
    "points_at_edge": "points at the edge",
    "attraction_residual": "attraction left",
    "load_share_beyond_film": "load share with a > t",
    "friction_share_beyond_film": "friction share, a > t",
}

_ROWS: dict[str, Quantity] = {
    name: Quantity(name, symbol, latex, unit, meaning, *bounds, example=example)
    for name, symbol, latex, unit, bounds, example, meaning in _INPUTS
} | {
    name: Quantity(name, symbol, latex, unit, meaning, *bounds, divisor, _RESULT_EXAMPLES.get(name, ""))
    for name, symbol, latex, unit, bounds, divisor, meaning in _OUTPUTS
}

QUANTITIES: dict[str, Quantity] = {name: replace(row, short=_SHORT.get(name, "")) for name, row in _ROWS.items()}
