"""Compute the plastic fraction of an asperity that changes gradually from elastic to fully plastic.

In Zhao, Maietta & Chang (2000) the contact area grows from pi R omega at omega_1 to 2 pi R omega at omega_2 = 54 omega_1 (R:
tip radius, omega: displacement). It follows the cubic step 3 xi^2 - 2 xi^3, where xi grows linearly with omega from 0 at
omega_1 to 1 at omega_2. omega_1 is the displacement at first yield, where the mean pressure is 0.4 times the hardness H.
Without adhesion omega is proportional to the square of the elastic mean pressure p, so p/H is 0.4 at omega_1 and sqrt(54) *
0.4 = 2.94 at omega_2.

This project's own change (grade C): xi grows linearly with (p/H)^2, a rule that also works if hardness and modulus change with
depth. The step starts at p = H, where the elastic asperity of soft_coating_2015 ends.
"""

from stiction.engine.compiled import formula

FIRST_YIELD = 0.4  # mean pressure over hardness at omega_1
SPAN = 54.0  # omega_2 / omega_1
FULLY_PLASTIC_SQUARED = SPAN * FIRST_YIELD * FIRST_YIELD
FULLY_PLASTIC = FULLY_PLASTIC_SQUARED**0.5  # p/H from which all of the asperity flows


@formula
def plastic_share(ratio):
    """Return the plastic fraction f of an asperity, from 0 (elastic) to 1 (fully plastic), and df/dratio.

    ratio: elastic mean pressure divided by hardness. The fraction is 0 for ratios up to 1, and 1 for ratios of
    FULLY_PLASTIC = 2.94 or more.
    """
    ratio = min(max(ratio, 1.0), FULLY_PLASTIC)
    done = min((ratio * ratio - 1.0) / (FULLY_PLASTIC_SQUARED - 1.0), 1.0)
    slope = 12.0 * ratio * done * (1.0 - done) / (FULLY_PLASTIC_SQUARED - 1.0)
    return done * done * (3.0 - 2.0 * done), slope
