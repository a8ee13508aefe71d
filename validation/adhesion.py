"""Compare the pull of adhesion in predictions with maps solved with adhesion.

python validation/adhesion.py     # a line for each map, energy ratio and load: solved and predicted rise of the area

Soft rough bodies (2 MPa) on rigid ones: self-affine maps of 256 x 256 points, 8 in the shortest wave, solved by boundary
elements with the shortest range of attraction that they resolve. U/w: elastic energy of flattening the map over the work of
adhesion. The rise is that of -ln(1 - A/A_n).
"""

import numpy as np

import stiction as st
from stiction.case.read import case_in
from stiction.studies.prediction.pull import pull_of
from stiction.studies.prediction.sampled_case import SampledCase

POINTS, SIDE, MODULUS = 256, 20e-6, 2e6 / (1.0 - 0.49**2)
MAPS = ((1, 5e-6), (2, 10e-6), (5, 2.5e-6))  # seed, roll-off [m]
RATIOS = (20.0, 7.0, 3.0, 1.0)
PRESSURES = (0.01, 0.03, 0.1)  # over E* h'

SOFT = {"youngs_modulus": 2e6, "poissons_ratio": 0.49, "hardness": 1e9, "material_class": "elastomer"}
RIGID = {"youngs_modulus": 1e12, "poissons_ratio": 0.3, "hardness": 1e12, "material_class": "ceramic"}


def energy_and_slope(heights: np.ndarray, side: float) -> tuple[float, float]:
    """Return the energy of flattening a square map per area [J/m2], (E*/4) sum q |h(q)|^2, and its rms gradient."""
    waves = 2.0 * np.pi * np.fft.fftfreq(len(heights), side / len(heights))
    q = np.hypot(waves[:, None], waves)
    power = np.abs(np.fft.fft2(heights) / heights.size) ** 2
    return float(MODULUS / 4.0 * np.sum(q * power)), float(np.sqrt(np.sum(q**2 * power)))


def rises(seed: int, rolloff: float, ratio: float, points: int = POINTS) -> tuple[np.ndarray, np.ndarray]:
    """Return the rise of the area by adhesion at PRESSURES, solved and predicted."""
    spectrum = st.SelfAffine(hurst=0.8, rolloff=rolloff, shortest=8.0 * SIDE / points, deviation=1e-7)
    surface = st.gaussian_surface((points, points), (SIDE, SIDE), spectrum, seed=seed)
    energy, slope = energy_and_slope(surface.heights, SIDE)
    loads = np.array(PRESSURES) * MODULUS * slope * SIDE**2
    common = {"first": SOFT, "second": RIGID, "roughness": surface, "nominal_area": SIDE**2, "interfacial_shear_strength": 1e4}
    sticky = st.Contact(**common, work_of_adhesion=energy / ratio)
    options = {"model": "boundary_elements", "yielding": "none"}
    dry = st.solve(st.Contact(**common), load=loads, **options).contact_area.values
    pulled = st.solve(sticky, load=loads, adhesion="shortest_range", **options).contact_area.values
    solved = np.log1p(-pulled / SIDE**2) / np.log1p(-dry / SIDE**2)
    case = case_in({"contact": sticky.as_numbers(), "solve": {"load": ["1 N"]}})
    return solved, pull_of(SampledCase(case, loads, np.zeros((1, 0)))).adhesion[1][0]


def main() -> None:
    errors = []
    for seed, rolloff in MAPS:
        for ratio in RATIOS:
            solved, predicted = rises(seed, rolloff, ratio)
            errors.append(np.log(predicted) / np.log(solved))
            print(f"map {seed}, U/w {ratio:4.0f}: solved {solved.round(2)}, predicted {predicted.round(2)}")
    print(f"ln of the rise, predicted over solved: {np.mean(errors):.2f} +/- {np.std(errors):.2f}")


if __name__ == "__main__":
    main()
