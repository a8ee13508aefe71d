"""Contacts of three small maps by the library ContactMechanics (1.8.3, MIT; not needed otherwise), for `library.csv`.

    python make_library.py > library.csv        in an environment of its own: pip install ContactMechanics==1.8.3

Maps: sums of waves of amplitudes q^-1.8 with phases of `numpy.random.default_rng(seed)`, as `heights` here; side 1, E* = 1.
Columns: seed; boundary; hardness (inf: elastic); mean: pressure; area: share of points in contact; square: mean of p^2;
largest: pressure. A case that the library does not converge on is left out (hardness .01, mean .005).
"""

import math

import numpy as np

COUNT = 64
CASES = [
    *((1, "periodic", math.inf, mean) for mean in (2e-4, 1e-3, 5e-3, 2e-2)),
    *((2, "periodic", hardness, mean) for hardness in (0.03, 0.01) for mean in (2e-4, 1e-3, 5e-3)),
    *((3, "free", math.inf, mean) for mean in (2e-4, 1e-3, 5e-3)),
]


def heights(seed):
    """(64, 64) of rms gradient near .1, waves of 2 to 9 periods along a side."""
    draw = np.random.default_rng(seed)
    step = 2.0 * math.pi * np.arange(COUNT) / COUNT
    total = np.zeros((COUNT, COUNT))
    for m in range(-9, 10):
        for n in range(10):
            phase = draw.uniform(0.0, 2.0 * math.pi)
            if 4 <= m * m + n * n <= 81:
                total += math.hypot(m, n) ** -1.8 * np.cos(m * step[:, None] + n * step + phase)
    return 1.5e-3 * total


def solved(seed, boundary, hardness, mean):
    """Pressure (64, 64); None where the library does not converge."""
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Factory import make_plastic_system, make_system
    from SurfaceTopography import PlasticTopography, Topography

    periodic = boundary == "periodic"
    half_space = PeriodicFFTElasticHalfSpace if periodic else FreeFFTElasticHalfSpace
    substrate = half_space((COUNT, COUNT), 1.0, physical_sizes=(1.0, 1.0))
    surface = Topography(heights(seed), physical_sizes=(1.0, 1.0), periodic=periodic)
    if math.isinf(hardness):
        system = make_system(substrate=substrate, surface=surface)
    else:
        system = make_plastic_system(substrate=substrate, surface=PlasticTopography(surface, hardness))
    found = system.minimize_proxy(external_force=mean, pentol=1e-8)
    if not found.success:
        return None
    return np.abs(np.asarray(found.jac))[:COUNT, :COUNT] * COUNT**2


def main():
    """Print the table."""
    print("seed,boundary,hardness,mean,area,square,largest")
    for case in CASES:
        pressure = solved(*case)
        if pressure is None:
            continue
        values = (pressure > 0.0).mean(), (pressure**2).mean(), pressure.max()
        print(",".join(str(entry) for entry in case) + "," + ",".join(f"{value:.10g}" for value in values))


if __name__ == "__main__":
    main()
