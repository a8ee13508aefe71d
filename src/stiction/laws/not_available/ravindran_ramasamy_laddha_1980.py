"""Friction of soft metal films as the cube root of thickness over load: Ravindran, Ramasamy & Laddha 1980; abstract known."""

from stiction.laws.registry import Unavailable
from stiction.laws.sources import Source

RECORD = Unavailable(
    key="ravindran_ramasamy_laddha_1980",
    title="Friction of thin soft metal films, as the cube root of thickness over load",
    grade="C",
    sources=(Source("ravindran_ramasamy_laddha_1980", "abstract"),),
    unknown="the factor of mu = c (t/W)^(1/3), which has the dimension of the cube root of a pressure times a length, and what "
    "of hardness, shear strength and radius it holds. The relation is called empirical, for soft metal films in spherical "
    "contact where Amontons's law fails, with a substrate that takes part in the plastic deformation.",
    nearest="finkin_1969, also of powers: (t/W)^(1/2) if compressible, t W^(-2/3) if not. halling_1979 has a substrate that "
    "takes part, and a friction that rises with thickness and falls with load by no single power.",
)
