"""Write properties of a particle type and of walls for Lethe, with the JKR contact force.

Document: Lethe, "Lagrangian Physical Properties" and theory guide "Discrete Element Method", "Johnson-Kendall-Roberts force
model". Its Coulomb limit is mu (F + 2 F_po), where F_po = (3/2) pi gamma_e R_e. The coefficient mu is chosen so that this limit
equals the predicted friction force at the stated load. Two equal surface energies gamma have gamma_e = 2 gamma, so each is half
the work of adhesion. Both bodies get the same coefficient, so that any mean of both is the coefficient of the pair.
"""

from typing import TYPE_CHECKING

from stiction.report.spheres import sphere_comments, sphere_contact

if TYPE_CHECKING:
    import xarray


def content(table: "xarray.Dataset") -> str:
    """Return friction coefficient, surface energy and elastic constants of two spheres as text of a Lethe parameter file.

    table: dataset of `export` with spheres, in its consistent units. Raises InputError if it has no spheres.
    """
    spheres, load, mu, pull_off = sphere_contact(table)
    shared = {
        "friction coefficient": mu * load / (load + 2.0 * pull_off),
        "surface energy": spheres["work_of_adhesion"] / 2.0,
    }
    particle, wall = (
        {"young modulus": modulus, "poisson ratio": ratio} | shared
        for modulus, ratio in zip(spheres["youngs_modulus"], spheres["poissons_ratio"], strict=True)
    )
    lines = [f"# {text}" for text in sphere_comments(table)]
    lines += ["subsection lagrangian physical properties", "  subsection particle type 0"]
    lines += [f"    set {name} particles = {value:.8g}" for name, value in particle.items()]
    lines += ["  end", *(f"  set {name} wall = {value:.8g}" for name, value in wall.items()), "end"]
    lines += ["subsection model parameters", "  set particle particle contact force method = hertz_JKR"]
    return "\n".join([*lines, "  set particle wall contact force method = JKR", "end"]) + "\n"
