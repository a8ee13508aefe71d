"""The one table of quantities: units, bounds, symbols and meanings of everything that goes in or comes out.

Validators, docstrings, command-line help, result attributes and axis labels read it; nothing else states a
unit or a bound. The symbols are those of docs/theory.md.
"""

from dataclasses import replace
from math import inf, pi

from stiction.quantities.quantity import COUNT, Quantity
from stiction.quantities.short_names import SHORT

__all__ = ["QUANTITIES", "Quantity"]

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
_HEIGHT = (1e-9, 1e3, True, True)
_LENGTH_RATIO = (0.0, 1e15, True, True)
_PART = (0.0, 1.0, False, True)
_SHARE_INSIDE = (0.0, 1.0, False, False)
_ANGLE = (0.0, pi, True, False)
_ONE_OR_TWO = (1.0, 2.0, True, True)
# nu = 1/2 is left out: an incompressible film does not carry load as a half-space does.
# Below 0 nothing was checked.
_POISSON = (0.0, 0.5, True, False)

_LOAD = "K R^(1/2) sigma^(3/2) per asperity"
_AREA = "pi R sigma per asperity"

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
    ("characteristic_depth", "h*", "h^*", "m", _POSITIVE, "500 nm",
     "depth of a pyramid's imprint at which the hardness is sqrt(2) times that of large ones"),
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
    ("strength_variation", "c_tau", r"c_\tau", "", _NOT_NEGATIVE, "0.5",
     "standard deviation of the interface's strength from junction to junction, over its mean"),
    # rest
    ("waiting_time", "t_w", r"t_\mathrm{w}", "s", _NOT_NEGATIVE, "60 s", "time at rest under load before it is pulled"),
    ("cut_off_time", "t_c", r"t_\mathrm{c}", "s", _POSITIVE, "1 s", "time below which a contact does not strengthen at rest"),
    ("strengthening", "m", "m", "", _NOT_NEGATIVE, "0.02",
     "relative growth of area and strength at rest, for every factor of e in time"),
    # vapour
    ("relative_humidity", "p/p_s", r"p/p_\mathrm{s}", "", _SHARE_INSIDE, "0.5",
     "pressure of the vapour over that of saturation"),
    ("temperature", "T", "T", "K", _POSITIVE, "293.15 K", "temperature"),
    ("contact_angle_first", "theta_1", r"\theta_1", "rad", _ANGLE, "10 deg", "contact angle on the first body"),
    ("contact_angle_second", "theta_2", r"\theta_2", "rad", _ANGLE, "10 deg", "contact angle on the second body"),
    ("surface_tension", "gamma_L", r"\gamma_\mathrm{L}", "N/m", _POSITIVE, "72.7 mN/m", "surface tension of the liquid"),
    ("molar_volume", "V_L", r"V_\mathrm{L}", "m^3/mol", _POSITIVE, "18.05 cm^3/mol", "molar volume of the liquid"),
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
    ("strength_over_shear_modulus", "tau_0/G", r"\tau_0/G", "", _NOT_NEGATIVE, "0.02",
     "interfacial shear strength at no pressure over the shear modulus of the softer body"),
    ("pressure_coefficient", "alpha", r"\alpha", "", _NOT_NEGATIVE, "0.05",
     "rise of the interfacial shear strength with pressure"),
    ("peeling", "zeta", r"\zeta", "", _SHARE, "1",
     "share of the tangential energy release that peels: 1 after Savkoor and Briggs, 0 for none"),
    ("hardening", "E_t/E", r"E_\mathrm{t}/E", "", _SHARE_BELOW_ONE, "0.01",
     "tangent modulus over Young's modulus, of the softer body"),
    ("waiting", "t_w/t_c", r"t_\mathrm{w}/t_\mathrm{c}", "", _NOT_NEGATIVE, "60", "time at rest over the cut-off time"),
    ("meniscus_index", "theta_m", r"\theta_\mathrm{m}", "", _THETA, "40",
     "K sigma^(3/2) / (2 gamma_L c R^(1/2)) of menisci, c the mean cosine of the contact angles"),
    ("meniscus_height", "2 r c/sigma", r"2rc/\sigma", "", _HEIGHT, "0.05",
     "gap that a meniscus bridges, over sigma"),
    ("specific_contact_resistance", "rho_c", r"\rho_\mathrm{c}", "ohm m^2", _POSITIVE, "1e-12 ohm m^2",
     "electrical resistance of the interface times its real area"),
    # of a measurement; no example, so that it is not listed among the numbers of a case file
    ("contact_resistance", "R_c", r"R_\mathrm{c}", "ohm", _POSITIVE, "", "electrical resistance of the contact"),
    # of a measured surface; no example either
    ("scan_size", "L", "L", "m", _POSITIVE, "", "size of a scan, or another length along it"),
    ("rms_height", "Sq", r"S_\mathrm{q}", "m", _POSITIVE, "0.2 um", "root mean square height of a surface"),
    ("mean_height", "Ra", r"R_\mathrm{a}", "m", _POSITIVE, "0.16 um", "arithmetic mean height"),
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
    ("size_effect", "R*/R", "R^*/R", "", _NOT_NEGATIVE, "",
     "square of the hardness that asperities find over that of large imprints, less one"),
    ("kelvin_radius", "r", "r", "m", _POSITIVE, "", "radius of a meniscus in equilibrium with the vapour"),
    ("kelvin_radius_over_confirmed", "r/r_c", r"r/r_\mathrm{c}", "", _POSITIVE, "",
     "radius of a meniscus over the least at which Kelvin's equation was confirmed"),
    ("meniscus_tabor_parameter", "mu_m", r"\mu_\mathrm{m}", "", _POSITIVE, "",
     "Tabor parameter with work and height of a meniscus"),
    ("meniscus_over_radius", "2 r c/R", r"2rc/R", "", _NOT_NEGATIVE, "", "height of a meniscus over the asperity radius"),
    # of a solution
    ("mean_separation", "d", "d", "m", _ANY, "sigma",
     "mean separation, from the mean of the asperity heights"),
    ("load", "P", "P", "N", _ANY, _LOAD, "net normal load, adhesion included"),
    ("load_elastic", "P_el", r"P_\mathrm{el}", "N", _ANY, _LOAD, "net load on elastic asperities"),
    ("load_plastic", "P_pl", r"P_\mathrm{pl}", "N", _ANY, _LOAD, "net load on plastic asperities"),
    ("load_elastic_plastic", "P_ep", r"P_\mathrm{ep}", "N", _ANY, _LOAD, "net load on elastic-plastic asperities"),
    ("load_meniscus", "P_m", r"P_\mathrm{m}", "N", _ANY, _LOAD, "load on menisci, which pull: 0 or less"),
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
     "static friction coefficient, T/P, undefined where P <= 0"),
    ("friction_coefficient_spread", "s_mu", r"s_\mu", "", _NOT_NEGATIVE, "",
     "standard deviation of mu from contact to contact, by the strength of single junctions"),
    ("friction_coefficient_published", "mu_0", r"\mu_0", "", _NOT_NEGATIVE, "",
     "static friction coefficient of the law as published, which gives yielded junctions nothing"),
    ("tangential_stiffness", "k_t", r"k_\mathrm{t}", "N/m", _NOT_NEGATIVE, "K R^(1/2) sigma^(1/2) per asperity",
     "tangential stiffness before anything slides"),
    ("displacement", "delta", r"\delta", "m", _NOT_NEGATIVE, "sigma",
     "tangential displacement of the surfaces, from rest"),
    ("tangential_force", "F", "F", "N", _NOT_NEGATIVE, _LOAD, "tangential force that is carried at a displacement"),
    ("largest_tangential_force", "F_max", r"F_\mathrm{max}", "N", _NOT_NEGATIVE, _LOAD,
     "largest tangential force on the way to sliding"),
    ("largest_friction_coefficient", "F_max/P", r"F_\mathrm{max}/P", "", _NOT_NEGATIVE, "",
     "largest tangential force on the way to sliding over the load, undefined where P <= 0"),
    ("sliding_displacement", "delta_s", r"\delta_\mathrm{s}", "m", _NOT_NEGATIVE, "sigma",
     "displacement at the largest tangential force, or where the force has come to 99 % of what it tends to"),
    ("energy_loss", "Delta W", r"\Delta W", "J", _NOT_NEGATIVE, "K R^(1/2) sigma^(5/2) per asperity",
     "energy lost in a cycle between a displacement and its opposite"),
    ("area_fraction", "A/A_n", r"A/A_\mathrm{n}", "", _NOT_NEGATIVE, "", "real contact area over the nominal one"),
    ("nominal_pressure", "P/A_n", r"P/A_\mathrm{n}", "Pa", _ANY, _LOAD, "net load over the nominal contact area"),
    ("nominal_pressure_over_hardness", "P/(A_n H)", r"P/(A_\mathrm{n}H)", "", _ANY, "",
     "nominal pressure over the hardness of what is softest"),
    ("mean_pressure_over_hardness", "P/(A H)", r"P/(AH)", "", _ANY, "",
     "mean pressure in contacts over hardness (of a coated body by what film and body carry)"),
    ("strength_over_bodies", "tau_0/tau_b", r"\tau_0/\tau_\mathrm{b}", "", _NOT_NEGATIVE, "",
     "stated strength of the interface over the shear strength of the weaker body, Y/sqrt(3)"),
    ("yield_strain", "Y/E*", r"Y/E^*", "", _NOT_NEGATIVE, "", "yield stress of the softer body over the contact modulus"),
    ("pressure_over_body_below", "P/(A H_b)", r"P/(AH_\mathrm{b})", "", _NOT_NEGATIVE, "",
     "mean pressure in contacts on a hard film over what the body below carries at their radius over its thickness"),
    ("pressure_over_punching", "P/(A p_c)", r"P/(Ap_\mathrm{c})", "", _NOT_NEGATIVE, "",
     "mean pressure in contacts on a hard film over the largest that does not punch the film through"),
    ("grown_area_ratio", "A_s/A", r"A_\mathrm{s}/A", "", _NOT_NEGATIVE, "",
     "contact area grown under shear over that before (Tabor 1959)"),
    ("touching_share", "n/(N A_n)", r"n/(NA_\mathrm{n})", "", _SHARE, "", "share of the asperities that touch"),
    ("asperity_area_over_yield", "A/(n A_c)", r"A/(nA_\mathrm{c})", "", _NOT_NEGATIVE, "",
     "mean contact area of a touching asperity over that at first yield"),
    ("meniscus_coverage", "A_L/A_n", r"A_\mathrm{L}/A_\mathrm{n}", "", _NOT_NEGATIVE, "",
     "area of the menisci of all asperities, as if none met, over the nominal one"),
    ("penetration_over_meniscus", "w/(2 r c)", r"\bar w/(2rc)", "", _NOT_NEGATIVE, "",
     "contact area of the mean touching asperity over pi R times the height of its meniscus"),
    ("adhesion_share", "n P_0/P", r"nP_0/P", "", _NOT_NEGATIVE, "",
     "pull-off forces of the touching asperities over the load"),
    ("meniscus_share", "n P_m/P", r"nP_\mathrm{m}/P", "", _NOT_NEGATIVE, "",
     "pull that the menisci would have between the dry surfaces, over the load"),
    ("load_share_without_friction", "s_0", r"s_0", "", _SHARE, "",
     "share of the load on asperities that the model gives no friction"),
    ("load_share_yielded", "s_y", r"s_\mathrm{y}", "", _SHARE, "", "share of the load on asperities that have yielded"),
    ("load_share_substrate_yielded", "s_sy", r"s_\mathrm{s,y}", "", _SHARE, "",
     "share of the load on asperities whose substrate has yielded"),
    ("rms_slope", "h'", r"h'", "", _NOT_NEGATIVE, "", "rms slope of the Gaussian surface that has these asperities"),
    ("stickiness_ratio", "Q", "Q", "", _POSITIVE, "", "repulsion in contact spots over the attraction beside them"),
    ("elastic_over_adhesion", "U/gamma", r"U/\gamma", "", _POSITIVE, "",
     "elastic energy of flattening the roughness over the work of adhesion, at most"),
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
    ("touching_asperities", "n", "n", "", _NOT_NEGATIVE, COUNT, "number of touching asperities"),
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

_ROWS: dict[str, Quantity] = {
    name: Quantity(name, symbol, latex, unit, meaning, *bounds, example=example)
    for name, symbol, latex, unit, bounds, example, meaning in _INPUTS
} | {
    name: Quantity(name, symbol, latex, unit, meaning, *bounds, divisor, _RESULT_EXAMPLES.get(name, ""))
    for name, symbol, latex, unit, bounds, divisor, meaning in _OUTPUTS
}

QUANTITIES: dict[str, Quantity] = {name: replace(row, short=SHORT.get(name, "")) for name, row in _ROWS.items()}
