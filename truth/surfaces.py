"""The surfaces of the set: which there are, and how each is made from its seed.

All are periodic, of 256 x 256 points (two kinds of 512 x 512) and rms gradient 0.1. In the shortest wave of a Gaussian
surface are 8 points, of one that is transformed afterwards 10.7: a transform makes shorter waves. With z a Gaussian surface of
mean 0 and variance 1:

    skewed      e^(s z) up, -e^(-s z) down; Johnson's distributions on the spectrum of z; sinh(z) and tanh(z), which are peaked
                and flat
    worn        z up to a height c: sharp min(z, c); smooth by a soft minimum; rough again: sharp, with short waves added
    lay         z stretched 1.5 to 10 times along a direction; also skewed and worn
    periodic    a wave along x, with random roughness on it
    bimodal     two bands of waves, with a gap between them
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from stiction.surfaces.generate import gaussian_surface, non_gaussian_surface, with_slope
from stiction.surfaces.heightmap import HeightMap
from stiction.surfaces.targets import SelfAffine

__all__ = ["LOADS", "SIDE", "SLOPE", "Surface", "surfaces"]

SIDE = 10e-6
SLOPE = 0.1
# Mean pressures over E* h'.
LOADS = (0.002, 0.004, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.9)
# Hardness over E* h', besides none, where a surface is solved with it; loads up to this part of it.
HARDNESSES = (0.03, 0.08, 0.2, 0.5, 1.2)
MOST_OF_HARDNESS = 0.95
TOP = 0.05  # share of the points that are called highest
# Films: plane-strain modulus over that of the substrate, thickness over the shortest wave; loads over E* h', E* that which a
# shortest wave of pressure meets.
FILM_MODULI = (0.1, 0.3, 3.0, 10.0)
FILM_THICKNESSES = (0.1, 0.3, 1.0, 3.0)
FILM_LOADS = (0.005, 0.02, 0.06, 0.2)
_SHORTEST, _BEFORE_TRANSFORM = 32.0, 24.0  # shortest waves on a side of 256 points
_FIT = 2  # seeds up to this are for fits, those above held out
_BASES = ((0.8, 8.0), (0.5, 16.0), (1.0, 4.0))  # Hurst, roll-off over shortest wave


@dataclass(frozen=True)
class Surface:
    """One surface of the set. kind: of those above; design, seed: two of one design differ by their seeds only; hurst; ratio:
    roll-off over shortest wave; stretch, angle [rad]: of the lay; change: name of the transform with its numbers; points: along
    a side; fineness: of points in the shortest wave, over those of the set; with_hardness, with_films: also solved so.
    """

    kind: str
    seed: int
    hurst: float
    ratio: float
    stretch: float = 1.0
    angle: float = 0.0
    change: tuple = ()
    points: int = 256
    with_hardness: bool = False
    with_films: bool = False
    design: int = 0
    fineness: float = 1.0

    @property
    def name(self) -> str:
        """Unique, and what the surface is."""
        parts = [self.kind, f"H{self.hurst:g}", f"r{self.ratio:g}"]
        if self.stretch != 1.0:
            parts.append(f"x{self.stretch:g}@{math.degrees(self.angle):.0f}")
        parts += [str(part) for part in self.change]
        return "_".join([*parts, f"s{self.seed}"])

    @property
    def held_out(self) -> bool:
        """Whether it is for judging, not for fits."""
        return self.seed > _FIT

    @property
    def random(self) -> int:
        """What its random numbers begin from: no two surfaces of the set share them."""
        return 10 * self.design + self.seed

    def made(self) -> HeightMap:
        """The heights."""
        return with_slope(_MAKERS[self.change[0]](self) if self.change else _gaussian(self), SLOPE)


def _spectrum(one: Surface, waves: float) -> SelfAffine:
    shortest = SIDE / (waves * one.points / 256.0) * one.fineness
    return SelfAffine(hurst=one.hurst, rolloff=shortest * one.ratio, shortest=shortest, deviation=1e-8)


def _gaussian(one: Surface, waves: float = _SHORTEST) -> HeightMap:
    lay = {"stretch": one.stretch, "angle": one.angle}
    return gaussian_surface((one.points, one.points), (SIDE, SIDE), _spectrum(one, waves), one.random, **lay)


def _normal(one: Surface) -> tuple[np.ndarray, HeightMap]:
    surface = _gaussian(one, _BEFORE_TRANSFORM)
    z = surface.heights - surface.heights.mean()
    return z / z.std(), surface


def _with(surface: HeightMap, z: np.ndarray, said: str) -> HeightMap:
    return surface.with_heights(z * 1e-8, said)


def _exponential(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    s = one.change[1]
    return _with(surface, np.exp(s * z), f"exp({s:g} z)") if s > 0.0 else _with(surface, -np.exp(s * z), f"-exp({s:g} z)")


def _johnson(one: Surface) -> HeightMap:
    _, skewness, kurtosis = one.change
    lay = {"stretch": one.stretch, "angle": one.angle}
    return non_gaussian_surface(
        (one.points, one.points), (SIDE, SIDE), _spectrum(one, _SHORTEST), one.random,
        skewness=skewness, kurtosis=kurtosis, exact_spectrum=True, **lay,
    )  # fmt: skip


def _sinh(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    return _with(surface, np.sinh(z), "sinh(z)")


def _tanh(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    return _with(surface, np.tanh(z), "tanh(z)")


def _sharp(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    return _with(surface, np.minimum(z, one.change[1]), f"cut at {one.change[1]:g}")


def _smooth(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    _, c, width = one.change
    return _with(surface, z - width * np.logaddexp(0.0, (z - c) / width), f"cut softly at {c:g}")


def _rough_again(one: Surface) -> HeightMap:
    z, surface = _normal(one)
    _, c, part = one.change
    fine = gaussian_surface(z.shape, (SIDE, SIDE), _spectrum(replace(one, ratio=2.0), _SHORTEST), one.random + 5000).heights
    return _with(surface, np.minimum(z, c) + part * fine / fine.std(), f"cut at {c:g}, {part:g} rough again")


def _turned(one: Surface) -> HeightMap:
    """A wave of so many periods; roughness of that part of its rms height."""
    surface = _gaussian(one)
    _, periods, part = one.change
    x = np.arange(one.points) / one.points
    wave = math.sqrt(2.0) * np.cos(2.0 * math.pi * periods * x)[None, :]
    z = surface.heights - surface.heights.mean()
    return _with(surface, wave + part * z / z.std(), f"on a wave of {periods:g} periods")


def _two_bands(one: Surface) -> HeightMap:
    """Long waves of 4 to 6 periods beside the short ones, so many times as high."""
    surface = _gaussian(one)
    long = SelfAffine(hurst=one.hurst, rolloff=SIDE / 4.0, shortest=SIDE / 6.0, longest=SIDE / 3.9, deviation=1e-8)
    below = gaussian_surface((one.points, one.points), (SIDE, SIDE), long, one.random + 5000).heights
    z = surface.heights - surface.heights.mean()
    return _with(surface, z / z.std() + one.change[1] * below / below.std(), f"on long waves {one.change[1]:g} times as high")


_MAKERS = {
    "exp": _exponential, "johnson": _johnson, "sinh": _sinh, "tanh": _tanh, "sharp": _sharp, "smooth": _smooth,
    "again": _rough_again, "turned": _turned, "bands": _two_bands,
}  # fmt: skip


def surfaces() -> list[Surface]:
    """All of them; of each design seeds 1 and 2 are for fits, 3 and 4 held out."""
    found = []
    for number, (one, seeds) in enumerate(_designs()):
        for seed in seeds:
            hard = one.with_hardness and seed in (1, 3)
            films = one.with_films and seed in (1, 3)
            found.append(replace(one, seed=seed, with_hardness=hard, with_films=films, design=number))
    return found


def _designs() -> Iterator[tuple[Surface, tuple[int, ...]]]:
    yield from ((one, (1, 2, 3, 4)) for one in _gaussians())
    yield from ((one, (1, 2, 3)) for one in _large())
    yield from ((one, (1, 3)) for group in (_skewed(), _worn(), _lays(), _others()) for one in group)


def _gaussians():
    yield Surface("gaussian", 0, 0.8, 1.0, with_hardness=True, with_films=True)
    for hurst in (0.3, 0.6, 0.8, 1.0):
        for ratio in (2.0, 4.0, 10.0, 32.0):
            film = (hurst, ratio) in ((0.8, 4.0), (0.6, 32.0), (1.0, 10.0))
            yield Surface("gaussian", 0, hurst, ratio, with_hardness=True, with_films=film)


def _large():
    for hurst, ratio in ((0.8, 64.0), (1.0, 64.0)):
        yield Surface("gaussian", 0, hurst, ratio, points=512)


def _skewed():
    for number, (hurst, ratio) in enumerate(_BASES):
        base = Surface("skewed", 0, hurst, ratio, with_hardness=number < 2)
        for s in (0.2, 0.45, 0.7, -0.2, -0.45, -0.7):
            yield replace(base, change=("exp", s), with_films=number == 0 and abs(s) == 0.45)
        for skewness, kurtosis in ((0.7, 4.0), (1.4, 6.5), (-0.7, 4.0), (-1.4, 6.5)):
            yield replace(base, change=("johnson", skewness, kurtosis))
        yield replace(base, kind="peaked", change=("sinh",))
        yield replace(base, kind="flat", change=("tanh",))


def _worn():
    for number, (hurst, ratio) in enumerate(_BASES):
        base = Surface("worn", 0, hurst, ratio, with_hardness=number < 2)
        for c in (0.0, 0.7, 1.4):
            yield replace(base, change=("sharp", c))
            yield replace(base, change=("smooth", c, 0.15), with_films=number == 0 and c == 0.7)
            yield replace(base, change=("again", c, 0.02))
            yield replace(base, change=("again", c, 0.07), with_films=number == 0 and c == 0.7)
        yield replace(base, change=("again", 0.7, 0.2))


def _lays():
    for number, (hurst, ratio) in enumerate(((0.8, 2.0), (0.5, 4.0), (0.8, 1.0))):
        base = Surface("lay", 0, hurst, ratio, with_hardness=number < 2)
        for stretch, angle in ((1.5, 0.0), (2.0, 0.6), (3.0, 0.0), (3.0, math.pi / 4.0), (6.0, math.pi / 2.0), (10.0, 0.2)):
            yield replace(base, stretch=stretch, angle=angle, with_films=number == 0 and (stretch, angle) == (3.0, 0.0))
    for change in (("exp", 0.45), ("exp", -0.45), ("smooth", 0.7, 0.15), ("again", 0.7, 0.07)):
        yield Surface("mixed", 0, 0.8, 2.0, stretch=3.0, angle=0.3, change=change, with_hardness=True)


def _others():
    for periods, part in ((3, 0.1), (3, 0.4), (8, 0.2), (8, 0.8)):
        yield Surface("periodic", 0, 0.8, 4.0, change=("turned", periods, part), with_hardness=True)
    for times in (0.5, 2.0, 6.0):
        yield Surface("bimodal", 0, 0.8, 2.0, change=("bands", times), with_hardness=True)
