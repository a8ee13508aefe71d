"""Write friction coefficient and cohesion energy density of two spheres as variables of a LIGGGHTS input script.

Document: LIGGGHTS-PUBLIC, "gran cohesion sjkr2" and "gran tangential no_history". The cohesion force is k A, with the cohesion
energy density k, the area A = 2 pi delta 2 R*, the overlap delta and the effective radius R*. By default the tangential model
limits friction to mu times Hertz's force, without the cohesion force. Let P_c be the largest tension, and x^2 the overlap over
the overlap at this tension. The normal force is then P_c (2 x^3 - 3 x^2), and

    k^3 = 9 w E*^2/(32 pi^2 R*),    x = 1/2 + cosh(arcosh(1 + 2 P/P_c)/3),    Hertz's force 2 P_c x^3

if P_c is JKR's pull-off force. mu is chosen such that mu times Hertz's force is the predicted friction force at the stated load
P. For a sphere on a wall LIGGGHTS takes half of A, so k must be twice as large there.
"""

from math import acosh, cbrt, cosh, pi
from typing import TYPE_CHECKING

from stiction.report.spheres import sphere_comments, sphere_contact

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return friction coefficient and cohesion energy density of two spheres as variables of a LIGGGHTS input script.

    table: dataset of `export` with spheres, in its consistent units. Raises InputError if it has no spheres.
    """
    spheres, load, mu, pull_off = sphere_contact(table)
    moduli = zip(spheres["youngs_modulus"], spheres["poissons_ratio"], strict=True)
    compliance = sum((1.0 - ratio**2) / modulus for modulus, ratio in moduli)
    density = cbrt(9.0 * spheres["work_of_adhesion"] / (32.0 * pi**2 * spheres["radius"] * compliance**2))
    if pull_off > 0.0:
        x = 0.5 + cosh(acosh(1.0 + 2.0 * load / pull_off) / 3.0)
        mu *= (2.0 * x - 3.0) / (2.0 * x)  # load over Hertz's force
    lines = [f"# {text}" for text in sphere_comments(table)]
    lines += ["# pair_style gran model hertz tangential history cohesion sjkr2"]
    lines += [f"# cohesion for E* = {1.0 / compliance:.6g}; with softer spheres it is proportional to E*^(2/3)"]
    lines += ["# sphere on wall: twice the cohesion, the same friction"]
    values = {"stictionFriction": mu, "stictionCohesion": density}
    return "\n".join([*lines, *(f"variable {name} equal {value:.8g}" for name, value in values.items())]) + "\n"
