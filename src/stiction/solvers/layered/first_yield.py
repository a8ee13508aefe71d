"""Locate first yield (von Mises) in a film or the body below it, under a pressed and sheared sphere.

The square M of the von Mises stress at a point is a quadratic form in the mean pressure s and the mean traction q. At depth z,
radius r and angle theta from the direction of the traction it is

    M = A s^2 + 2 B s q cos(theta) + [C + (D - C) cos^2(theta)] q^2.

The maximum over theta has a closed form. The maximum over r and z is located on a grid that is dense where stresses vary, and
refined by parabolas. The root of the maximum, N(s, q), is the largest von Mises stress. It is a norm of (s, q). Film and body
each have their own N, and yield where N reaches their yield stress. For very small contacts the film acts as a half-space. For
contacts much wider than the film, the body acts as a half-space and stretches the film like its own surface.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from stiction.engine.one_thread import on_one_thread
from stiction.solvers.layered.compliance import Layer
from stiction.solvers.layered.stresses import Radial, Stresses
from stiction.solvers.layered.waves import CoatedBody

# Number of regions whose largest stress is computed separately, so that each is a smooth function of a/t: the film's surface,
# the contact edge, the inside of the film, its interface with the body, and the body.
PARTS = 5
# Coordinates of the tables: arctan(traction/pressure), and (p - 1)/(p + 1) with p = (a/t)^(1/2).
ANGLES = np.linspace(0.0, np.pi / 2.0, 61)
PLACES = np.linspace(-1.0, 1.0, 161)
_SOLVED = np.concatenate(
    [[-0.8, -0.65, -0.5, -0.4], np.linspace(-0.33, 0.33, 15), [0.42, 0.5, 0.58, 0.66, 0.74, 0.81, 0.87, 0.92]]
)
_REACH = 12.0
# Search grids: radii divided by the contact radius, dense at the contact edge; depths in the film, divided by its thickness;
# depths below the film in the body.
_RADII = np.concatenate([np.sin(np.linspace(0.0, np.pi / 2.0, 23)), 1.0 + 0.6 * np.linspace(0.0, 1.0, 9)[1:] ** 2])
_EDGE = 22  # index of the contact edge, where stresses on the surface have a cusp
_IN_FILM = (1.0 - np.cos(np.linspace(0.0, np.pi, 11))) / 2.0
_IN_BODY = 1.4 * np.linspace(0.0, 1.0, 15) ** 1.5
_WIDE = np.linspace(0.0, 1.5, 24)
# The coefficients A, B, D and C of the quadratic form M, in this order.
Forms = tuple[np.ndarray, ...]


class Yield(NamedTuple):
    """Store where a coated body first yields, and how high the stress there is, at mean pressure 1 and a given traction.

    excess: von Mises stress at this point, times the ratio of the yield stress of the body to the yield stress of the material
    at this point. where: "film", "interface" (either side) or "body". x: position ahead of the axis, in the direction of the
    traction. z: depth below the surface. x and z are divided by the contact radius.
    """

    excess: float
    where: str
    x: float
    z: float


def first_yield(stresses: Stresses, traction: float, film_strength: float = 1.0) -> Yield:
    """Return where a coated body first yields, and the stress there, under a pressure and `traction` times this pressure.

    stresses: stresses in the body under a sphere. traction: >= 0. film_strength: ratio of the yield stresses of film and body
    below.
    """
    candidates = []
    for name, (radial, r, z), strength in zip(("film", "body"), _fields(stresses), (film_strength, 1.0), strict=True):
        forms = forms_of(radial)
        square, cosine = _over_directions(forms, 1.0, traction)
        at = np.unravel_index(square.argmax(), square.shape)
        ahead = r[at[1]] * cosine[at] * (-1.0 if forms[1][at] < 0.0 else 1.0)
        between = abs(z[at[0]] - stresses.thickness) < 1e-9 * stresses.thickness
        largest = _refined(square[..., None], np.ones(square.shape, dtype=bool))[0] ** 0.5
        candidates.append(Yield(float(largest / strength), "interface" if between else name, float(ahead), float(z[at[0]])))
    return max(candidates)


def at_interface(stresses: Stresses, traction: float) -> tuple[float, float]:
    """Return the largest tension and the largest shear stress at the interface of film and body.

    Both stresses are divided by the mean pressure. stresses: stresses in the body under a sphere. traction: ratio of traction
    to pressure, >= 0. The tension is 0 if the interface is only compressed.
    """
    r = np.unique(np.concatenate([_RADII, 2.0 * _WIDE * max(1.0, stresses.thickness)]))
    radial = stresses.in_film(r, np.array([stresses.thickness]))
    _, _, zz, rz = radial.pressed
    _, _, zz_dragged, rz_dragged, _, tz = radial.dragged
    tension = float((zz + traction * np.abs(zz_dragged)).max())
    square, _ = _over_directions((rz * rz, rz * rz_dragged, rz_dragged**2, tz * tz), 1.0, traction)
    return max(tension, 0.0), float(square.max() ** 0.5)


def norms(stresses: Stresses, angles: np.ndarray) -> np.ndarray:
    """Return the largest von Mises stress in each of five regions of film and body: (PARTS, m).

    stresses: stresses in the body under a sphere. angles (m,): arctan(q/s), with q the mean traction, s the mean pressure and
    s^2 + q^2 = 1. The regions are the film's surface, the contact edge, the inside of the film, the film at its interface, and
    the body.
    """
    (film, _, _), (body, _, _) = _fields(stresses)
    return np.stack([*_of_film(forms_of(film), angles), _norm(forms_of(body), angles)])


@lru_cache(maxsize=64)
@on_one_thread
def table_of_norms(pair: tuple[Layer, ...], bodies: tuple[CoatedBody, ...]) -> np.ndarray:
    """Return ln of the largest von Mises stress in film and body: (2, PLACES, ANGLES).

    pair, bodies: layers and elastic constants of the coated bodies; for two coated bodies, the larger stress is returned.
    PLACES: contact sizes z = (p - 1)/(p + 1), p = (a/t)^(1/2), with the contact radius a and the film thickness t. ANGLES:
    arctan(q/s) for mean traction q and mean pressure s, s^2 + q^2 = 1. The stress in the body is multiplied by 1 + (t/a)^2
    before the logarithm is taken, so that the table stays finite for small contacts.
    """
    whole = np.stack([_table(pair, body) for body in bodies]).max(axis=0)
    with np.errstate(divide="ignore"):
        felt = -np.log1p(((1.0 - PLACES) / (1.0 + PLACES)) ** 4)[:, None]
    film = np.concatenate([whole[:3], whole[3:4] + felt]).max(axis=0)
    return np.stack([film, whole[4]])


def _table(pair: tuple[Layer, ...], body: CoatedBody) -> np.ndarray:
    """Return ln of the largest von Mises stress in all regions of one coated body: (PARTS, PLACES, ANGLES).

    In the last two regions, interface and body, the stress is multiplied by 1 + (t/a)^2, with t the film thickness and a the
    contact radius, so that the table stays finite for small contacts.
    """
    from scipy.interpolate import Akima1DInterpolator  # slow to import

    radii = ((1.0 + _SOLVED) / (1.0 - _SOLVED)) ** 2
    solved = np.stack([np.log(norms(Stresses(pair, body, radius, _REACH), ANGLES)) for radius in radii], axis=1)
    solved[3:] += np.log1p(radii**-2.0)[:, None]
    film, below = forms_of(_alone(body.nu)), _alone(body.nu_below)
    thick = np.stack([*np.log(_of_film(film, ANGLES)[:3]), *solved[3:, 0]])
    # The strain of a film of zero thickness is the same at all depths.
    skin = np.log(_of_film(forms_of(stretched(below, body)), ANGLES))
    thin = np.stack([*skin, skin.max(axis=0), skin.max(axis=0), np.log(_norm(forms_of(below), ANGLES))])
    whole = np.concatenate([thick[:, None], solved, thin[:, None]], axis=1)
    return Akima1DInterpolator(np.concatenate([[-1.0], _SOLVED, [1.0]]), whole, axis=1, method="makima")(PLACES)


def _of_film(forms: Forms, angles: np.ndarray) -> np.ndarray:
    """Return the largest von Mises stress in each region of a film: (4, m).

    forms: coefficients of the squared stress on the search grid (depths, radii). angles (m,): arctan(q/s) for mean traction q
    and mean pressure s, s^2 + q^2 = 1. The regions are the surface without the contact edge, the contact edge, the inside, and
    the largest depth. A grid with one depth only has the first two: (2, m).
    """
    rest = np.arange(len(_RADII)) != _EDGE
    depth, edge = np.arange(forms[0].shape[0])[:, None], ~rest[None, :]
    surface, last = depth == 0, depth == depth.size - 1
    places = surface & ~edge, surface & edge, ~surface & ~last & (edge | ~edge), last & (edge | ~edge)
    square, _ = _squares(forms, angles)
    return np.stack([np.sqrt(_refined(square, at)) for at in (places if depth.size > 1 else places[:2])])


def _fields(stresses: Stresses) -> list[tuple[Radial, np.ndarray, np.ndarray]]:
    """Return, for film and body, the stresses on a search grid, and its radii and depths divided by the contact radius."""
    t = stresses.thickness
    film_r, film_z = _RADII, t * np.minimum(_IN_FILM, 1.0) if t < 1.4 else _thick(t)
    body_r = _WIDE * max(1.0, t) if t > 0.3 else _RADII
    body_z = t + _IN_BODY * max(1.0, t)
    return [
        (stresses.in_film(film_r, film_z), film_r, film_z),
        (stresses.in_body(body_r, body_z), body_r, body_z),
    ]


def _thick(t: float) -> np.ndarray:
    """Return search depths in a film of thickness t, dense near the surface; lengths are divided by the contact radius."""
    return np.concatenate([_IN_BODY, np.geomspace(1.5, t, 4)[1:]]) if t > 1.6 else np.append(_IN_BODY, t)


@lru_cache(maxsize=64)
def _alone(nu: float) -> Radial:
    """Return the stresses on the search grid in a body without a film, under a pressed and sheared sphere.

    nu: Poisson's ratio of the body.
    """
    whole = Stresses((Layer.of(1.0, 1.0, nu, nu),), CoatedBody(1.0, nu, nu), 0.5)
    return whole.in_film(_RADII, _IN_BODY)


def stretched(below: Radial, body: CoatedBody) -> Radial:
    """Return the stresses in a very thin film, which is strained along the surface like the surface below it.

    below: stresses in the body without a film, at depths that begin with 0. body: elastic constants of film and body.
    """
    surface = Radial(*(tuple(one[:1] for one in part) for part in below))
    stiffer, nu = body.ratio * (1.0 - body.nu**2) / (1.0 - body.nu_below**2), body.nu

    def in_plane(rr, tt, zz):
        x, y = (stiffer * (one - body.nu_below * (other + zz)) + nu * zz for one, other in ((rr, tt), (tt, rr)))
        return (x + nu * y) / (1.0 - nu * nu), (y + nu * x) / (1.0 - nu * nu), zz

    (rr, tt, zz, rz), (drr, dtt, dzz, drz, drt, dtz) = surface
    return Radial((*in_plane(rr, tt, zz), rz), (*in_plane(drr, dtt, dzz), drz, body.shear_ratio * drt, dtz))


def forms_of(radial: Radial) -> Forms:
    """Return the coefficients (A, B, D, C) of the squared von Mises stress M at every point of a grid.

    radial: the stresses due to unit pressure and unit traction.
    """
    *along, rt, tz = radial.dragged
    return (
        _product(radial.pressed, radial.pressed),
        _product(radial.pressed, along),
        _product(along, along),
        3.0 * (rt * rt + tz * tz),
    )


def _product(first, second) -> np.ndarray:
    """Return 3/2 times the double contraction of the deviators of two stress tensors.

    first, second: components (rr, tt, zz, rz); the product of a tensor with itself is the squared von Mises stress.
    """
    mean = (first[0] + first[1] + first[2]) * (second[0] + second[1] + second[2]) / 3.0
    return 1.5 * (first[0] * second[0] + first[1] * second[1] + first[2] * second[2] - mean) + 3.0 * first[3] * second[3]


def _over_directions(forms: Forms, s, q) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest squared von Mises stress over all angles theta from the traction, and |cos(theta)| at the maximum.

    forms: coefficients (A, B, D, C) of the squared stress. s, q: mean pressure and mean traction, numbers or arrays that
    broadcast with the forms.
    """
    A, B, D, C = forms
    across = np.maximum(C - D, 1e-300) * q
    cosine = np.where(np.abs(B) * s < across, np.abs(B) * s / np.maximum(across, 1e-300), 1.0)
    cosine = np.where(C > D, cosine, 1.0)
    return A * s * s + 2.0 * np.abs(B) * s * q * cosine + (C + (D - C) * cosine * cosine) * q * q, cosine


def _squares(forms: Forms, angles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the results of `_over_directions` at every point of a grid and every ratio of traction to pressure.

    Both results are arrays (n, m, k). forms: coefficients on the grid (n, m). angles (k,): arctan(q/s) for the mean traction q
    = sin(angle) and the mean pressure s = cos(angle).
    """
    return _over_directions(tuple(one[..., None] for one in forms), np.cos(angles), np.sin(angles))


def _norm(forms: Forms, angles: np.ndarray) -> np.ndarray:
    return np.sqrt(_refined(_squares(forms, angles)[0], np.ones(forms[0].shape, dtype=bool)))


def _refined(square: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Return the largest squared stress (angles,) in the part of a grid selected by a mask.

    square: squared stresses (n, m, angles). among: mask (n, m). A parabola through each maximum and its neighbours refines the
    value.
    """
    n, m, count = square.shape
    where = np.where(among.reshape(-1, 1), square.reshape(-1, count), -1.0).argmax(axis=0)
    i, j, every = where // m, where % m, np.arange(count)
    best = square[i, j, every]
    rise = np.zeros(count)
    at_edge = (i == 0) & (j == _EDGE)
    for di, dj, last, at in ((1, 0, n, i), (0, 1, m, j)):
        before = square[np.maximum(i - di, 0), np.maximum(j - dj, 0), every]
        after = square[np.minimum(i + di, n - 1), np.minimum(j + dj, m - 1), every]
        peak = (at > 0) & (at < last - 1) & ~at_edge & (best >= before) & (best >= after)
        bend = np.maximum(2.0 * best - before - after, 1e-300)
        rise += np.where(peak, (after - before) ** 2 / (8.0 * bend), 0.0)
    return best + rise
